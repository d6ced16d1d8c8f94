// Values of constant expressions. num results are rounded to binary32 after each operation, as the controller does.

#include "frontend/sema/analysis.h"

#include <cmath>

namespace rapid::sema {

using namespace syntax;

namespace {

constexpr size_t kMaxStringBytes = 80;

double roundTo(bool isDnum, double value) {
    return isDnum ? value : static_cast<double>(static_cast<float>(value));
}

bool equalValues(const ConstValue& a, const ConstValue& b) {
    if (a.kind != b.kind || a.members().size() != b.members().size()) return false;
    switch (a.kind) {
    case ConstValue::Kind::None: return false;
    case ConstValue::Kind::Number: return a.number == b.number;
    case ConstValue::Kind::Bool: return a.boolean == b.boolean;
    case ConstValue::Kind::String: return a.text() == b.text();
    case ConstValue::Kind::Aggregate: break;
    }
    for (size_t i = 0; i < a.members().size(); ++i)
        if (!equalValues(a.members()[i], b.members()[i])) return false;
    return true;
}

bool compare(BinaryOp op, double a, double b) {
    switch (op) {
    case BinaryOp::Lt: return a < b;
    case BinaryOp::Le: return a <= b;
    case BinaryOp::Gt: return a > b;
    default: return a >= b;
    }
}

} // namespace

// A value that stays when the file of `value` is checked again.
ConstValue Analyzer::owned(const ConstValue& value) {
    ConstValue copy = value;
    if (!keeps_) return copy;
    if (value.kind == ConstValue::Kind::String) copy.setText(value.text(), valueArena());
    if (value.kind == ConstValue::Kind::Aggregate) {
        const std::span<ConstValue> members = valueArena().makeArray<ConstValue>(value.members().size());
        for (size_t i = 0; i < members.size(); ++i)
            members[i] = owned(value.members()[i]);
        copy.setMembers(members);
    }
    return copy;
}

// An element or component of a constant, which may be that of another file.
const ConstValue* Analyzer::partOf(const ConstValue& value) {
    if (!keeps_) return &value;
    ConstValue* copy = newConst();
    *copy = owned(value);
    return copy;
}

void Analyzer::foldBool(ExprInfo& out, bool value) {
    ConstValue* constant = newConst();
    constant->kind = ConstValue::Kind::Bool;
    constant->boolean = value;
    out.constant = constant;
}

void Analyzer::foldUnary(const UnaryExpr& e, ConstValue* slot) {
    ExprInfo& out = info(e);
    const ConstValue* operand = info(*e.operand).constant;
    out.constant = nullptr;
    if (!operand) return;
    if (e.op == UnaryOp::Not) {
        foldBool(out, !operand->boolean);
        return;
    }
    ConstValue* value = slot ? slot : newConst();
    value->kind = ConstValue::Kind::Number;
    value->number = e.op == UnaryOp::Minus ? -operand->number : operand->number;
    out.constant = value;
}

// A routine with an ERROR handler may well mean it.
void Analyzer::warnDivision(const BinaryExpr& e) {
    if (!hasErrorHandler()) report(Code::DivisionByZero, range(e.opToken), {text(e.opToken)});
}

// False: there is no such value. An error where a constant is demanded; elsewhere it is left to run time.
bool Analyzer::foldArithmetic(const BinaryExpr& e, double a, double b, bool isDnum, double& out) {
    switch (e.op) {
    case BinaryOp::Add: out = a + b; break;
    case BinaryOp::Sub: out = a - b; break;
    case BinaryOp::Mul: out = a * b; break;
    default: {
        if (b == 0) {
            if (context_.constant)
                report(Code::ConstantDivision, range(e.opToken), {text(e.opToken)});
            else
                warnDivision(e);
            return false;
        }
        if (e.op == BinaryOp::Div) {
            out = a / b;
            break;
        }
        if (a != std::floor(a) || b != std::floor(b)) {
            report(Code::IntegerOperands, range(e.opToken), {text(e.opToken)});
            return false;
        }
        out = e.op == BinaryOp::IntDiv ? std::trunc(a / b) : std::fmod(a, b);
        break;
    }
    }
    out = roundTo(isDnum, out);
    if (std::isfinite(out)) return true;
    const bool literalTooLarge = !std::isfinite(a) || !std::isfinite(b); // reported as a literal
    if (context_.constant && !literalTooLarge)
        report(Code::ConstantOverflow, range(e.opToken), {isDnum ? "dnum" : "num"});
    return false;
}

void Analyzer::foldBinary(const BinaryExpr& e) {
    ExprInfo& out = info(e);
    const ConstValue *a = info(*e.left).constant, *b = info(*e.right).constant;
    out.constant = nullptr;
    if (!a || !b) {
        const bool divides = e.op == BinaryOp::Div || e.op == BinaryOp::IntDiv || e.op == BinaryOp::Mod;
        if (divides && b && b->kind == ConstValue::Kind::Number && b->number == 0) warnDivision(e);
        return;
    }
    switch (e.op) {
    case BinaryOp::And: foldBool(out, a->boolean && b->boolean); return;
    case BinaryOp::Or: foldBool(out, a->boolean || b->boolean); return;
    case BinaryOp::Xor: foldBool(out, a->boolean != b->boolean); return;
    case BinaryOp::Eq: foldBool(out, equalValues(*a, *b)); return;
    case BinaryOp::Ne: foldBool(out, !equalValues(*a, *b)); return;
    case BinaryOp::Lt:
    case BinaryOp::Le:
    case BinaryOp::Gt:
    case BinaryOp::Ge: foldBool(out, compare(e.op, a->number, b->number)); return;
    default: break;
    }
    if (a->kind == ConstValue::Kind::String) {
        const size_t size = a->text().size() + b->text().size();
        if (size > kMaxStringBytes) {
            if (context_.constant) report(Code::ConstantStringTooLong, range(e), {std::to_string(size)});
            return;
        }
        ConstValue* value = newConst();
        value->setText(std::string(a->text()) += b->text(), valueArena());
        out.constant = value;
        return;
    }
    double number = 0;
    if (!foldArithmetic(e, a->number, b->number, out.type.type->kind == TypeKind::Dnum, number)) return;
    ConstValue* value = newConst();
    value->kind = ConstValue::Kind::Number;
    value->number = number;
    out.constant = value;
}

} // namespace rapid::sema
