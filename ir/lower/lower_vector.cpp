// pos and orient arithmetic (manual 1.3.1), component by component in registers.

#include "ir/lower/routine_lowering.h"

namespace rapid::lower {

using namespace syntax;
using ir::Op;
using sema::LanguageError;
using sema::TypeKind;

bool RoutineLowering::isVectorOp(const Expr& outer) const {
    const Expr& expr = unparen(outer);
    if (expr.kind != NodeKind::Binary && expr.kind != NodeKind::Unary) return false;
    const sema::Type* type = baseType(expr);
    return type->known == sema::KnownType::Position || type->known == sema::KnownType::Orientation;
}

std::vector<ir::ValueId> RoutineLowering::lowerComponents(const Expr& outer) {
    const Expr& expr = unparen(outer);
    std::vector<ValueId> out;
    const sema::Type* type = baseType(expr);
    if (!isVectorOp(expr) || info(expr).constant) {
        const ValueId addr = lowerAddr(expr);
        const ir::TypeId record = program_.irType(type);
        for (uint32_t i = 0; i < type->components.size(); ++i)
            out.push_back(b_.load(ir::kF32, b_.fieldAddr(record, addr, i)));
        return out;
    }
    if (expr.kind == NodeKind::Unary) {
        out = lowerComponents(*as<UnaryExpr>(expr).operand);
        if (as<UnaryExpr>(expr).op == UnaryOp::Minus)
            for (ValueId& v : out)
                v = b_.unary(Op::FNeg, v);
        return out;
    }
    const auto& binary = as<BinaryExpr>(expr);
    auto mul = [&](ValueId a, ValueId b) { return b_.binary(Op::FMul, a, b); };
    auto add = [&](ValueId a, ValueId b) { return b_.binary(Op::FAdd, a, b); };
    auto sub = [&](ValueId a, ValueId b) { return b_.binary(Op::FSub, a, b); };
    const bool leftScalar = baseType(*binary.left)->kind != TypeKind::Record;
    const bool rightScalar = baseType(*binary.right)->kind != TypeKind::Record;
    if (leftScalar || rightScalar) {
        const ValueId first = leftScalar ? lowerValueAs(*binary.left, program_.program().num) : ir::kNone;
        out = lowerComponents(leftScalar ? *binary.right : *binary.left);
        const ValueId scalar = leftScalar ? first : lowerValueAs(*binary.right, program_.program().num);
        const bool division = binary.op == BinaryOp::Div;
        if (division)
            b_.check(b_.binary(Op::FNe, scalar, b_.constF32(0)),
                     program_.errorNumber(LanguageError::Divisor));
        for (ValueId& v : out)
            v = b_.binary(division ? Op::FDiv : Op::FMul, v, scalar);
        return out;
    }
    const std::vector<ValueId> a = lowerComponents(*binary.left);
    const std::vector<ValueId> b = lowerComponents(*binary.right);
    if (binary.op != BinaryOp::Mul) {
        for (size_t i = 0; i < a.size(); ++i)
            out.push_back(binary.op == BinaryOp::Add ? add(a[i], b[i]) : sub(a[i], b[i]));
        return out;
    }
    if (a.size() == 3) { // vector product
        for (size_t i = 0; i < 3; ++i) {
            const size_t j = (i + 1) % 3, k = (i + 2) % 3;
            out.push_back(sub(mul(a[j], b[k]), mul(a[k], b[j])));
        }
        return out;
    }
    // Linking of rotations: quaternion product, q1 is the real part.
    auto sum = [&](ValueId p, ValueId q, ValueId r, ValueId s) { return add(add(add(p, q), r), s); };
    auto neg = [&](ValueId v) { return b_.unary(Op::FNeg, v); };
    out.push_back(sum(mul(a[0], b[0]), neg(mul(a[1], b[1])), neg(mul(a[2], b[2])), neg(mul(a[3], b[3]))));
    out.push_back(sum(mul(a[0], b[1]), mul(a[1], b[0]), mul(a[2], b[3]), neg(mul(a[3], b[2]))));
    out.push_back(sum(mul(a[0], b[2]), neg(mul(a[1], b[3])), mul(a[2], b[0]), mul(a[3], b[1])));
    out.push_back(sum(mul(a[0], b[3]), mul(a[1], b[2]), neg(mul(a[2], b[1])), mul(a[3], b[0])));
    return out;
}

void RoutineLowering::lowerVectorInto(const Expr& expr, ValueId dst) {
    const std::vector<ValueId> components = lowerComponents(expr);
    const ir::TypeId record = program_.irType(baseType(expr));
    for (uint32_t i = 0; i < components.size(); ++i)
        b_.store(ir::kF32, components[i], b_.fieldAddr(record, dst, i));
}

} // namespace rapid::lower
