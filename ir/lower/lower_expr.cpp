// Expressions (manual 1.3).

#include "ir/lower/routine_lowering.h"

#include <cmath>

namespace rapid::lower {

using namespace syntax;
using ir::Op;
using sema::LanguageError;
using sema::TypeKind;

ir::ValueId RoutineLowering::constantScalar(const sema::ConstValue& value, ir::TypeId type) {
    if (type == ir::kBool) return b_.constBool(value.boolean);
    if (type == ir::kF64) return b_.constF64(value.number);
    return b_.constF32(value.number);
}

/// A signal or an element of a signal array; whether its value or the signal itself is meant, the context says.
bool RoutineLowering::namesSignal(const Expr& expr) const {
    const sema::DataSymbol* root = rootSymbol(expr);
    return root && root->type.type->base()->kind == TypeKind::SemiValue;
}

/// The value of a signal in an expression: num, or dnum for groups (manual 1.9).
ir::ValueId RoutineLowering::readSignal(const Expr& expr, bool asDnum) {
    const Place signal = reference(expr);
    const uint32_t native = program_.support(asDnum ? Support::rt_readSignalDnum : Support::rt_readSignalNum);
    return b_.callNative(native, {signal.addr});
}

ir::ValueId RoutineLowering::lowerValueAs(const Expr& expr, const sema::Type* wanted) {
    const ir::TypeId type = program_.irType(wanted);
    const Expr& inner = unparen(expr);
    if (isIncomplete(inner)) {
        reachPlaceholder(inner);
        return zeroOf(type);
    }
    const sema::ExprInfo& facts = info(inner);
    if (facts.constant && facts.constant->kind != sema::ConstValue::Kind::Aggregate)
        return constantScalar(*facts.constant, type);
    if (namesSignal(inner)) return readSignal(inner, type == ir::kF64);
    const ValueId value = lowerValue(inner);
    const ir::TypeId have = routine_.insts[value].type;
    if (have == ir::kF32 && type == ir::kF64) return b_.convert(Op::FWiden, ir::kF64, value);
    if (have == ir::kF64 && type == ir::kF32) return b_.convert(Op::FNarrow, ir::kF32, value);
    return value;
}

ir::ValueId RoutineLowering::lowerBool(const Expr& expr) {
    return lowerValueAs(expr, program_.program().boolean);
}

ir::ValueId RoutineLowering::lowerValue(const Expr& outer) {
    const Expr& expr = unparen(outer);
    const sema::ExprInfo& facts = info(expr);
    const ir::TypeId type = program_.irType(facts.type());
    if (facts.constant && facts.constant->kind != sema::ConstValue::Kind::Aggregate)
        return constantScalar(*facts.constant, type);
    switch (expr.kind) {
    case NodeKind::Name: {
        if (intRange(expr)) return b_.convert(Op::SIntToFloat, ir::kF32, lowerInt(expr));
        if (namesSignal(expr)) return readSignal(expr, type == ir::kF64);
        const auto* symbol = static_cast<const sema::DataSymbol*>(facts.symbol);
        if (symbol->isSwitch) {
            const Slot* slot = findSlot(*symbol);
            return parameter(slot->param);
        }
        return b_.load(type, placeOf(*symbol).addr);
    }
    case NodeKind::Index:
    case NodeKind::Component:
        if (namesSignal(expr)) return readSignal(expr, type == ir::kF64);
        return b_.load(type, place(expr).addr);
    case NodeKind::Call: return lowerCall(expr, ir::kNone);
    case NodeKind::Unary: {
        const auto& unary = as<UnaryExpr>(expr);
        if (unary.op == UnaryOp::Not) return b_.unary(Op::Not, lowerBool(*unary.operand));
        if (intRange(expr)) return b_.convert(Op::SIntToFloat, ir::kF32, lowerInt(expr));
        const ValueId value = lowerValueAs(*unary.operand, facts.type().type);
        return unary.op == UnaryOp::Minus ? b_.unary(Op::FNeg, value) : value;
    }
    case NodeKind::Binary: return lowerBinary(as<BinaryExpr>(expr));
    default: return b_.constF32(0); // placeholders and errors do not get here
    }
}

ir::ValueId RoutineLowering::lowerBinary(const BinaryExpr& expr) {
    switch (expr.op) {
    case BinaryOp::And:
    case BinaryOp::Or:
        if (!isCheap(*expr.right)) return lowerShortCircuit(expr);
        return b_.binary(expr.op == BinaryOp::And ? Op::And : Op::Or, lowerBool(*expr.left),
                         lowerBool(*expr.right));
    case BinaryOp::Xor: {
        const ValueId left = lowerBool(*expr.left);
        return b_.binary(Op::Xor, left, lowerBool(*expr.right));
    }
    case BinaryOp::Eq: return lowerEquality(*expr.left, *expr.right);
    case BinaryOp::Ne: return b_.unary(Op::Not, lowerEquality(*expr.left, *expr.right));
    case BinaryOp::Lt:
    case BinaryOp::Le:
    case BinaryOp::Gt:
    case BinaryOp::Ge: return lowerComparison(expr);
    default: break;
    }
    if (intRange(expr)) return b_.convert(Op::SIntToFloat, ir::kF32, lowerInt(expr));
    const sema::Type* type = info(expr).type().type;
    const ValueId a = lowerValueAs(*expr.left, type);
    const ValueId b = lowerValueAs(*expr.right, type);
    return lowerArithmetic(expr.op, a, b, type->base()->kind == TypeKind::Dnum);
}

ir::ValueId RoutineLowering::lowerArithmetic(BinaryOp op, ValueId a, ValueId b, bool isDnum) {
    switch (op) {
    case BinaryOp::Add: return b_.binary(Op::FAdd, a, b);
    case BinaryOp::Sub: return b_.binary(Op::FSub, a, b);
    case BinaryOp::Mul: return b_.binary(Op::FMul, a, b);
    case BinaryOp::Div: {
        const ir::Inst& divisor = routine_.insts[b];
        if (divisor.op != Op::Const || divisor.number() == 0) {
            const ValueId zero = isDnum ? b_.constF64(0) : b_.constF32(0);
            b_.check(b_.binary(Op::FNe, b, zero), program_.errorNumber(LanguageError::Divisor));
        }
        return b_.binary(Op::FDiv, a, b);
    }
    case BinaryOp::IntDiv: return lowerIntegerDivision(false, a, b, isDnum);
    default: return lowerIntegerDivision(true, a, b, isDnum);
    }
}

/// DIV and MOD: integer operands only (manual 1.3.1, note 3).
ir::ValueId RoutineLowering::lowerIntegerDivision(bool modulo, ValueId a, ValueId b, bool isDnum) {
    const ValueId zero = isDnum ? b_.constF64(0) : b_.constF32(0);
    const int32_t notInteger = program_.errorNumber(LanguageError::NotWhole);
    b_.check(b_.binary(Op::FNe, b, zero), program_.errorNumber(LanguageError::Divisor));
    if (routine_.insts[b].op != Op::Const)
        b_.check(b_.binary(Op::FEq, b_.unary(Op::FTrunc, b), b), notInteger);
    b_.check(b_.binary(Op::FEq, b_.unary(Op::FTrunc, a), a), notInteger);
    return b_.binary(modulo ? Op::FRem : Op::FQuot, a, b);
}

ir::ValueId RoutineLowering::lowerComparison(const BinaryExpr& expr) {
    Op f = Op::FLt, i = Op::ILt;
    switch (expr.op) {
    case BinaryOp::Le: f = Op::FLe, i = Op::ILe; break;
    case BinaryOp::Gt: f = Op::FGt, i = Op::IGt; break;
    case BinaryOp::Ge: f = Op::FGe, i = Op::IGe; break;
    default: break;
    }
    if (intRange(*expr.left) && intRange(*expr.right))
        return b_.binary(i, lowerInt(*expr.left), lowerInt(*expr.right));
    const bool isDnum =
        baseType(*expr.left)->kind == TypeKind::Dnum || baseType(*expr.right)->kind == TypeKind::Dnum;
    const sema::Type* type = isDnum ? program_.program().dnum : program_.program().num;
    const ValueId a = lowerValueAs(*expr.left, type);
    return b_.binary(f, a, lowerValueAs(*expr.right, type));
}

ir::ValueId RoutineLowering::lowerEquality(const Expr& left, const Expr& right) {
    if (intRange(left) && intRange(right)) return b_.binary(Op::IEq, lowerInt(left), lowerInt(right));
    sema::DataType type = info(left).type();
    if (type.type->kind == TypeKind::Error || unparen(left).kind == NodeKind::Aggregate)
        type = info(right).type();
    const TypeKind kind = type.type->base()->kind;
    const TypeKind otherKind = baseType(right)->kind;
    const bool numeric = kind == TypeKind::Num || kind == TypeKind::Dnum || kind == TypeKind::SemiValue;
    if (numeric && !type.isArray()) {
        const bool isDnum = kind == TypeKind::Dnum || otherKind == TypeKind::Dnum;
        const sema::Type* wanted = isDnum ? program_.program().dnum : program_.program().num;
        const ValueId a = lowerValueAs(left, wanted);
        return b_.binary(Op::FEq, a, lowerValueAs(right, wanted));
    }
    if (kind == TypeKind::Bool && !type.isArray())
        return b_.binary(Op::IEq, lowerValue(left), lowerValue(right));
    auto address = [&](const Expr& e) {
        if (unparen(e).kind != NodeKind::Aggregate) return lowerAddr(e);
        const ValueId buffer = tempAddr(program_.irType(type));
        lowerInto(e, type, buffer);
        return buffer;
    };
    const ValueId a = keptUntil(right, left, type, address(left));
    return equalPlaces(a, address(right), type);
}

/// The value at `address`, which is that of `expr`, must not change while `later` is evaluated.
ir::ValueId RoutineLowering::keptUntil(const Expr& later, const Expr& expr, const sema::DataType& type,
                                       ValueId address) {
    const sema::DataSymbol* root = referredData(&expr, *module_);
    if (!root || !callsRoutine(later) || !(isShared(*root) || mentions(later, *root))) return address;
    const ValueId kept = tempAddr(program_.irType(type));
    b_.copy(program_.irType(type), kept, address);
    return kept;
}

ir::ValueId RoutineLowering::equalPlaces(ValueId a, ValueId b, const sema::DataType& type) {
    if (!type.isArray() && type.type->base()->kind == TypeKind::String)
        return b_.callNative(program_.support(Support::rt_strEqual), {a, b});
    return b_.callNative(program_.support(Support::rt_anyEqual),
                         {a, b, b_.typeDescAddr(program_.typeDesc(type))});
}

/// Division by zero, overflow. A small constant changes no number so much that it leaves the range of its type.
bool RoutineLowering::mayFail(const BinaryExpr& expr) const {
    const auto atMost = [&](const Expr& operand, double limit) {
        const sema::ConstValue* value = info(operand).constant;
        return value && value->kind == sema::ConstValue::Kind::Number && std::abs(value->number) <= limit;
    };
    switch (expr.op) {
    case BinaryOp::Add:
    case BinaryOp::Sub: return !atMost(*expr.left, 1e30) && !atMost(*expr.right, 1e30) && !intRange(expr);
    case BinaryOp::Mul: return !atMost(*expr.left, 1) && !atMost(*expr.right, 1) && !intRange(expr);
    case BinaryOp::Div:
    case BinaryOp::IntDiv:
    case BinaryOp::Mod: return true;
    default: return false;
    }
}

/// Cheap: may be evaluated although its value is not needed (no call, no error, no wait).
bool RoutineLowering::isCheap(const Expr& outer) const {
    const Expr& expr = unparen(outer);
    const sema::ExprInfo& facts = info(expr);
    if (facts.constant) return true;
    if (facts.type().isArray() || containsPlaceholder(expr)) return false;
    switch (expr.kind) {
    case NodeKind::Name: {
        const auto* symbol = static_cast<const sema::DataSymbol*>(facts.symbol);
        const Slot* slot = findSlot(*symbol);
        const TypeKind kind = symbol->type.type->base()->kind;
        return kind != TypeKind::SemiValue && kind != TypeKind::String && !(slot && slot->optional);
    }
    case NodeKind::Component: return isCheap(*as<ComponentExpr>(expr).base);
    case NodeKind::Unary: return isCheap(*as<UnaryExpr>(expr).operand);
    case NodeKind::Binary: {
        const auto& binary = as<BinaryExpr>(expr);
        if (mayFail(binary)) return false;
        const TypeKind kind = baseType(*binary.left)->kind;
        const bool scalar = kind == TypeKind::Num || kind == TypeKind::Dnum || kind == TypeKind::Bool;
        return scalar && isCheap(*binary.left) && isCheap(*binary.right);
    }
    default: return false;
    }
}

/// AND and OR do not evaluate the right operand when the left one decides (decision 16).
ir::ValueId RoutineLowering::lowerShortCircuit(const BinaryExpr& expr) {
    const uint32_t result = temp(ir::kBool);
    const ir::BlockId more = b_.addBlock("right");
    const ir::BlockId end = b_.addBlock("decided");
    const ValueId left = lowerBool(*expr.left);
    b_.store(ir::kBool, left, b_.localAddr(result));
    const bool isAnd = expr.op == BinaryOp::And;
    b_.condBr(left, isAnd ? more : end, isAnd ? end : more);
    b_.setBlock(more);
    const ValueId right = lowerBool(*expr.right);
    b_.store(ir::kBool, right, b_.localAddr(result));
    b_.br(end);
    b_.setBlock(end);
    return b_.load(ir::kBool, b_.localAddr(result));
}

void RoutineLowering::lowerCond(const Expr& outer, ir::BlockId ifTrue, ir::BlockId ifFalse) {
    const Expr& expr = unparen(outer);
    if (expr.kind == NodeKind::Unary && as<UnaryExpr>(expr).op == UnaryOp::Not)
        return lowerCond(*as<UnaryExpr>(expr).operand, ifFalse, ifTrue);
    if (expr.kind == NodeKind::Binary && !info(expr).constant) {
        const auto& binary = as<BinaryExpr>(expr);
        const bool isAnd = binary.op == BinaryOp::And;
        if ((isAnd || binary.op == BinaryOp::Or) && !isCheap(*binary.right)) {
            const ir::BlockId more = b_.addBlock("right");
            lowerCond(*binary.left, isAnd ? more : ifTrue, isAnd ? ifFalse : more);
            b_.setBlock(more);
            return lowerCond(*binary.right, ifTrue, ifFalse);
        }
    }
    b_.condBr(lowerBool(expr), ifTrue, ifFalse);
}

/// An aggregate is stored element by element; when one of them fails, nothing must have been stored yet.
bool RoutineLowering::mayFailHalfway(const Expr& outer) const {
    const Expr& expr = unparen(outer);
    if (expr.kind != NodeKind::Aggregate || info(expr).constant) return false;
    for (const Expr* element : as<AggregateExpr>(expr).elements()) {
        const Expr& inner = unparen(*element);
        if (inner.kind == NodeKind::Aggregate ? mayFailHalfway(inner) : !isCheap(inner)) return true;
    }
    return false;
}

ir::ValueId RoutineLowering::lowerAddr(const Expr& outer) {
    const Expr& expr = unparen(outer);
    return place(expr).addr;
}

ir::ValueId RoutineLowering::constantAddress(const sema::ConstValue& value, const sema::DataType& type) {
    ir::ConstData data;
    if (value.kind != sema::ConstValue::Kind::None) program_.flatten(value, type, data);
    return b_.globalAddr(program_.constGlobal(program_.irType(type), std::move(data)));
}

void RoutineLowering::storeExpr(const Expr& expr, const sema::DataType& type, ValueId dst) {
    const ir::TypeId irType = program_.irType(type);
    if (!type.isArray() && program_.module().isScalar(irType) && irType != ir::kI64)
        b_.store(irType, lowerValueAs(expr, type.type), dst);
    else
        lowerInto(expr, type, dst);
}

void RoutineLowering::lowerInto(const Expr& outer, const sema::DataType& type, ValueId dst) {
    const Expr& expr = unparen(outer);
    const ir::TypeId irType = program_.irType(type);
    if (isIncomplete(expr) && expr.kind != NodeKind::Aggregate) return reachPlaceholder(expr);
    if (!type.isArray() && program_.module().isScalar(irType) && irType != ir::kI64)
        return b_.store(irType, lowerValueAs(expr, type.type), dst);
    if (const auto* constant = info(expr).constant)
        return b_.copy(irType, dst, constantAddress(*constant, type));
    switch (expr.kind) {
    case NodeKind::Aggregate: {
        const std::span<Expr*> elements = as<AggregateExpr>(expr).elements();
        if (type.isArray()) {
            sema::DataType inner{
                type.type, static_cast<uint8_t>(type.rank - 1), {type.dims[1], type.dims[2], 0}};
            const ir::TypeId elementType = program_.irType(type.type);
            const int32_t stride =
                (inner.rank > 0 ? inner.dims[0] : 1) * (inner.rank > 1 ? inner.dims[1] : 1);
            for (size_t i = 0; i < elements.size(); ++i) {
                const ValueId at =
                    b_.elemAddr(elementType, dst, b_.constI32(static_cast<int32_t>(i) * stride));
                storeExpr(*elements[i], inner, at);
            }
            return;
        }
        const auto& components = type.type->base()->components;
        for (size_t i = 0; i < elements.size() && i < components.size(); ++i)
            storeExpr(*elements[i], scalarType(components[i].type),
                      b_.fieldAddr(irType, dst, static_cast<uint32_t>(i)));
        return;
    }
    case NodeKind::Call: lowerCall(expr, dst); return;
    case NodeKind::Unary:
    case NodeKind::Binary:
        if (isVectorOp(expr)) return lowerVectorInto(expr, dst);
        return joinInto(as<BinaryExpr>(expr), type, dst, ir::kNone);
    default: {
        const Place source = place(expr);
        if (type.isArray()) checkSameSize({dst, type, {}}, source);
        b_.copy(irType, dst, source.addr);
    }
    }
}

bool RoutineLowering::isJoin(const Expr& outer) const {
    const Expr& expr = unparen(outer);
    return expr.kind == NodeKind::Binary && !info(expr).constant && !info(expr).type().isArray() &&
           info(expr).type().type->base()->kind == TypeKind::String;
}

/// Strings joined by +. `a + b + c` grows in one temporary string (`buffer`, once there is one); the native writes the
/// result last, and it may be one of the operands.
void RoutineLowering::joinInto(const BinaryExpr& expr, const sema::DataType& type, ValueId dst,
                               ValueId buffer) {
    ValueId a = buffer;
    if (isJoin(*expr.left)) {
        if (a == ir::kNone) a = tempAddr(program_.irType(type));
        joinInto(as<BinaryExpr>(unparen(*expr.left)), type, a, a);
    } else {
        a = keptUntil(*expr.right, *expr.left, type, lowerAddr(*expr.left));
    }
    const ValueId b = lowerAddr(*expr.right);
    b_.callNative(program_.support(Support::rt_strConcat), {dst, a, b});
}

} // namespace rapid::lower
