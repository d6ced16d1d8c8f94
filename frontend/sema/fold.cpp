// Values of constant expressions. num results are rounded to binary32 after each operation, as the controller does.

#include "frontend/sema/fold.h"
#include "frontend/diag/messages/expressions.h"
#include "frontend/syntax/limits.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rapid::sema {

using namespace syntax;

namespace {

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

/// The components of a pos or an orient.
struct Vector {
    std::array<double, 4> at{};
    size_t size = 0;
};

/// False: a component has no value.
bool components(const ConstValue& value, Vector& out) {
    for (const ConstValue& member : value.members()) {
        if (member.kind != ConstValue::Kind::Number || out.size == out.at.size()) return false;
        out.at[out.size++] = member.number;
    }
    return true;
}

/// Vector product, or linking of rotations; rounds in the same steps as the running program (ir/lower/lower_vector.cpp).
Vector product(const Vector& a, const Vector& b) {
    const auto mul = [&](size_t i, size_t j) { return roundTo(false, a.at[i] * b.at[j]); };
    const auto add = [](double x, double y) { return roundTo(false, x + y); };
    if (a.size == 3)
        return {{add(mul(1, 2), -mul(2, 1)), add(mul(2, 0), -mul(0, 2)), add(mul(0, 1), -mul(1, 0))}, 3};
    const auto sum = [&](double p, double q, double r, double s) { return add(add(add(p, q), r), s); };
    return {
        {sum(mul(0, 0), -mul(1, 1), -mul(2, 2), -mul(3, 3)), sum(mul(0, 1), mul(1, 0), mul(2, 3), -mul(3, 2)),
         sum(mul(0, 2), -mul(1, 3), mul(2, 0), mul(3, 1)), sum(mul(0, 3), mul(1, 2), -mul(2, 1), mul(3, 0))},
        4};
}

ConstValue aggregateOf(const Vector& vector, Arena& arena) {
    const std::span<ConstValue> members = arena.makeArray<ConstValue>(vector.size);
    for (size_t i = 0; i < vector.size; ++i) {
        members[i].kind = ConstValue::Kind::Number;
        members[i].number = vector.at[i];
    }
    ConstValue value;
    value.setMembers(members);
    return value;
}

} // namespace

Folding::Folding(State& state) : CheckerPart(state) {}

void Folding::setDefault(ConstValue& value, const Type& type) {
    switch (type.base()->kind) {
    case TypeKind::Bool: value.kind = ConstValue::Kind::Bool; break;
    case TypeKind::String: value.setText("", valueArena()); break;
    case TypeKind::Record: {
        const std::vector<Type::Component>& components = type.base()->components;
        const std::span<ConstValue> members = valueArena().makeArray<ConstValue>(components.size());
        for (size_t i = 0; i < components.size(); ++i)
            setDefault(members[i], *components[i].type);
        value.setMembers(members);
        break;
    }
    default: value.kind = ConstValue::Kind::Number; break;
    }
}

// A value that stays when the file of `value` is checked again.
ConstValue Folding::owned(const ConstValue& value) {
    ConstValue copy = value;
    if (!state_.keepsFacts) return copy;
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
const ConstValue* Folding::partOf(const ConstValue& value) {
    if (!state_.keepsFacts) return &value;
    ConstValue* copy = newConst();
    *copy = owned(value);
    return copy;
}

void Folding::foldBool(ExprInfo& out, bool value) {
    ConstValue* constant = newConst();
    constant->kind = ConstValue::Kind::Bool;
    constant->boolean = value;
    out.constant = constant;
}

void Folding::foldUnary(const UnaryExpr& e, ConstValue* slot) {
    ExprInfo& out = info(e);
    const ConstValue* operand = info(*e.operand).constant;
    out.constant = nullptr;
    if (!operand) return;
    if (e.op == UnaryOp::Not) {
        foldBool(out, !operand->boolean);
        return;
    }
    ConstValue* value = slot ? slot : newConst();
    out.constant = value;
    if (operand->kind == ConstValue::Kind::Aggregate) {
        Vector vector;
        if (!components(*operand, vector)) out.constant = nullptr;
        for (size_t i = 0; i < vector.size && e.op == UnaryOp::Minus; ++i)
            vector.at[i] = -vector.at[i];
        *value = aggregateOf(vector, valueArena());
        return;
    }
    value->kind = ConstValue::Kind::Number;
    value->number = e.op == UnaryOp::Minus ? -operand->number : operand->number;
}

// A routine with an ERROR handler may well mean it.
void Folding::warnDivision(const BinaryExpr& e) {
    if (!hasErrorHandler()) report(say::DivisionByZero, range(e.opToken), {text(e.opToken)});
}

// False: there is no such value. An error where a constant is demanded; elsewhere it is left to run time.
bool Folding::foldArithmetic(const BinaryExpr& e, double a, double b, bool isDnum, double& out) {
    switch (e.op) {
    case BinaryOp::Add: out = a + b; break;
    case BinaryOp::Sub: out = a - b; break;
    case BinaryOp::Mul: out = a * b; break;
    default: {
        if (b == 0) {
            if (context_.constant)
                report(say::ConstantDivision, range(e.opToken), {text(e.opToken)});
            else
                warnDivision(e);
            return false;
        }
        if (e.op == BinaryOp::Div) {
            out = a / b;
            break;
        }
        if (a != std::floor(a) || b != std::floor(b)) {
            report(say::IntegerOperands, range(e.opToken), {text(e.opToken)});
            return false;
        }
        out = std::fmod(a, b); // exact, as the multiple of b that it leaves
        if (e.op == BinaryOp::IntDiv)
            out = static_cast<double>(std::round((static_cast<long double>(a) - out) / b));
        break;
    }
    }
    out = roundTo(isDnum, out);
    if (std::isfinite(out)) return true;
    const bool literalTooLarge = !std::isfinite(a) || !std::isfinite(b); // reported as a literal
    if (context_.constant && !literalTooLarge)
        report(say::ConstantOverflow, range(e.opToken), {isDnum ? "dnum" : "num"});
    return false;
}

// Of two vectors, or of a vector and a number.
const ConstValue* Folding::foldVectors(const BinaryExpr& e, const ConstValue& a, const ConstValue& b) {
    const bool scalars[] = {a.kind == ConstValue::Kind::Number, b.kind == ConstValue::Kind::Number};
    Vector left, right;
    if (!components(a, left) || !components(b, right)) return nullptr;
    Vector vector = scalars[0] ? right : left;
    if (!scalars[0] && !scalars[1] && e.op == BinaryOp::Mul) {
        vector = product(left, right);
    } else {
        for (size_t i = 0; i < vector.size; ++i)
            if (!foldArithmetic(e, scalars[0] ? a.number : left.at[i], scalars[1] ? b.number : right.at[i],
                                false, vector.at[i]))
                return nullptr;
    }
    if (!std::all_of(vector.at.begin(), vector.at.end(), [](double v) { return std::isfinite(v); })) {
        if (context_.constant) report(say::ConstantOverflow, range(e.opToken), {"num"});
        return nullptr;
    }
    ConstValue* value = newConst();
    *value = aggregateOf(vector, valueArena());
    return value;
}

void Folding::foldBinary(const BinaryExpr& e) {
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
        if (size > kStringCapacity) {
            if (context_.constant) report(say::ConstantStringTooLong, range(e), {std::to_string(size)});
            return;
        }
        ConstValue* value = newConst();
        value->setText(std::string(a->text()) += b->text(), valueArena());
        out.constant = value;
        return;
    }
    if (a->kind != ConstValue::Kind::Number || b->kind != ConstValue::Kind::Number) {
        out.constant = foldVectors(e, *a, *b);
        return;
    }
    double number = 0;
    if (!foldArithmetic(e, a->number, b->number, out.type().type->kind == TypeKind::Dnum, number)) return;
    ConstValue* value = newConst();
    value->kind = ConstValue::Kind::Number;
    value->number = number;
    out.constant = value;
}

} // namespace rapid::sema
