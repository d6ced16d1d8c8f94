// Operators: which operands they take and what they give (manual 1.3.1).

#include "frontend/diag/messages/expressions.h"
#include "frontend/sema/expr.h"
#include "frontend/sema/fold.h"
#include "frontend/sema/place.h"
#include "frontend/sema/remedies.h"
#include "frontend/sema/type_rules.h"
#include "frontend/sema/wording.h"
#include "frontend/syntax/tree_walk.h"

#include <cmath>

namespace rapid::sema {

using namespace syntax;

Typed Expressions::unary(const UnaryExpr& e, const DataType* want, ConstValue* slot) {
    const Typed operand = expr(*e.operand, e.op == UnaryOp::Not ? nullptr : want);
    if (operand.isError()) return errorExpr(e);
    const char* name = e.op == UnaryOp::Not ? "NOT" : e.op == UnaryOp::Plus ? "+" : "-";
    const DataType& type = operand.info->type();
    const bool scalar = type.rank == 0;
    if (e.op == UnaryOp::Not && scalar && type.type->kind == TypeKind::Bool) {
        const Typed t = result(e, program_.boolean);
        folding_.foldUnary(e, slot);
        return t;
    }
    if (e.op != UnaryOp::Not && scalar && type.type->isNumeric()) {
        const Typed t = result(e, operand.base(), operand.flex);
        folding_.foldUnary(e, slot);
        return t;
    }
    if (e.op != UnaryOp::Not && scalar && isKnown(*operand.base(), KnownType::Position)) {
        const Typed t = result(e, operand.base());
        folding_.foldUnary(e, slot);
        return t;
    }
    report(say::UnaryOperatorType, range(e.first), {name, typeName(*operand.info)}, {Misfit::Operator, e});
    return errorExpr(e);
}

namespace {

bool isAggregate(const Expr& e) {
    return bare(e).kind == NodeKind::Aggregate;
}

/// The partner of a comparison gives an aggregate its type, and so does a vector that something is added to or multiplied
/// with: `p.trans + [0, 0, 10]`.
bool givesType(BinaryOp op, const DataType& partner) {
    if (op == BinaryOp::Eq || op == BinaryOp::Ne) return true;
    const bool vector = op == BinaryOp::Add || op == BinaryOp::Sub || op == BinaryOp::Mul;
    return vector && partner.rank == 0 &&
           (partner.type->kind == TypeKind::Record || partner.type->kind == TypeKind::Error);
}

} // namespace

// Long chains of operators lean to the left: a loop instead of recursion.
Typed Expressions::binaryChain(const BinaryExpr& top, const DataType* want) {
    const size_t begin = spine_.size();
    const Expr* leaf = &top;
    for (; leaf->kind == NodeKind::Binary; leaf = as<BinaryExpr>(*leaf).left)
        spine_.push_back(&as<BinaryExpr>(*leaf));
    Typed left;
    bool first = true;
    // Literals are folded as dnum from the start where the context says so.
    const bool dnum = top.op < BinaryOp::Lt && want && want->rank == 0 && want->type->kind == TypeKind::Dnum;
    const DataType* numeric = dnum ? want : nullptr;
    while (spine_.size() > begin) {
        const BinaryExpr& e = *spine_.back();
        spine_.pop_back();
        const bool equal = e.op == BinaryOp::Eq || e.op == BinaryOp::Ne;
        if (first && isAggregate(*leaf) && !isAggregate(*e.right)) {
            const Typed right = expr(*e.right);
            if (refusesAggregate(e, right.info->type())) {
                visitLoose(*leaf);
                left = errorExpr(e);
            } else {
                const DataType* given = givesType(e.op, right.info->type()) ? &right.info->type() : nullptr;
                left = combine(e, expr(*leaf, given), right);
            }
        } else {
            if (first) nonValueReported_ = false, left = expr(*leaf, numeric);
            // One aggregate without a type is enough.
            if (left.isError() && isAggregate(*e.left) && isAggregate(*e.right)) {
                visitLoose(*e.right);
                left = combine(e, left, left);
                first = false;
                continue;
            }
            const bool said = first && std::exchange(nonValueReported_, false) && isPlaceExpr(*e.right);
            if (said) visitLoose(*e.right); // "clock1 = clock2" is one mistake
            const bool typed = equal || (isAggregate(*e.right) && givesType(e.op, left.info->type()));
            if (isAggregate(*e.right) && refusesAggregate(e, left.info->type())) {
                visitLoose(*e.right);
                left = errorExpr(e);
            } else {
                const Typed right = said ? left : expr(*e.right, typed ? &left.info->type() : numeric);
                left = combine(e, left, right);
            }
        }
        first = false;
    }
    return left;
}

// "p10 + [0,0,50]": a record that no operator takes gives the aggregate no type.
bool Expressions::refusesAggregate(const BinaryExpr& e, const DataType& partner) {
    const Type* type = partner.type->base();
    if (e.op >= BinaryOp::Lt || partner.rank > 0 || type->kind != TypeKind::Record ||
        isKnown(*type, KnownType::Position) || isKnown(*type, KnownType::Orientation))
        return false;
    const bool left = isAggregate(*e.left);
    report(say::OperatorTypes, range(e.opToken),
           {text(e.opToken), left ? text(*e.left) : typeName(partner),
            left ? typeName(partner) : text(*e.right), targetRemedy(e.op, partner)},
           {Misfit::Operator, e});
    return true;
}

Typed Expressions::combine(const BinaryExpr& e, Typed left, Typed right) {
    const auto isRelation = [](BinaryOp op) { return op >= BinaryOp::Lt && op <= BinaryOp::Ne; };
    if (isRelation(e.op) && e.left->kind == NodeKind::Binary && isRelation(as<BinaryExpr>(*e.left).op))
        return result(e, program_.boolean); // a chain of relations is a syntax error
    if (left.isError() || right.isError()) {
        // The result type of a comparison is known all the same, as are the operands of a logical operator.
        const bool gives = e.op >= BinaryOp::Lt;
        const Typed known = left.isError() ? right : left;
        const bool takes = e.op < BinaryOp::And || known.isError() || known.isScalar(TypeKind::Bool);
        if (!takes && text(e.opToken)[0] != '&')
            report(say::UnaryOperatorType, range(e.opToken), {text(e.opToken), typeName(*known.info)});
        return gives ? result(e, program_.boolean) : errorExpr(e);
    }
    switch (e.op) {
    case BinaryOp::Add:
    case BinaryOp::Sub:
    case BinaryOp::Mul:
    case BinaryOp::Div:
    case BinaryOp::IntDiv:
    case BinaryOp::Mod: return arithmetic(e, left, right);
    case BinaryOp::Lt:
    case BinaryOp::Le:
    case BinaryOp::Gt:
    case BinaryOp::Ge: return comparison(e, left, right);
    case BinaryOp::Eq:
    case BinaryOp::Ne: return equality(e, left, right);
    case BinaryOp::And:
    case BinaryOp::Or:
    case BinaryOp::Xor: return logic(e, left, right);
    }
    return errorExpr(e);
}

void Expressions::reportMixed(const BinaryExpr& e) {
    report(say::NumDnumMixed, range(e.opToken), {text(e.opToken)}, {Misfit::Operator, e});
}

Typed Expressions::operatorError(const BinaryExpr& e, Typed left, Typed right) {
    if (context_.tree->text(e.opToken)[0] == '&') return errorExpr(e); // of another language, reported
    report(say::OperatorTypes, range(e.opToken),
           {text(e.opToken), typeName(*left.info), typeName(*right.info), operatorRemedy(e.op, left, right)},
           {Misfit::Operator, e});
    return errorExpr(e);
}

// Brings two numbers to one type; `flex` says whether it is still open.
Expressions::Numeric Expressions::unify(const BinaryExpr& e, Typed& left, Typed& right, Flex& flex) {
    const DataType &a = left.info->type(), &b = right.info->type();
    if (a.rank > 0 || b.rank > 0 || !a.type->isNumeric() || !b.type->isNumeric()) return Numeric::NotNumeric;
    flex = Flex::None;
    if (left.flex != Flex::None && right.flex != Flex::None) {
        flex = left.flex == Flex::Group || right.flex == Flex::Group ? Flex::Group : Flex::Literal;
        const bool dnum =
            flex == Flex::Group || left.base() == program_.dnum || right.base() == program_.dnum;
        const Type* common = dnum ? program_.dnum : program_.num;
        settle(*e.left, common);
        settle(*e.right, common);
    } else if (left.flex != Flex::None)
        settle(*e.left, right.base());
    else if (right.flex != Flex::None)
        settle(*e.right, left.base());
    else if (left.base() != right.base())
        return Numeric::Mixed;
    return Numeric::Ok;
}

Typed Expressions::arithmetic(const BinaryExpr& e, Typed left, Typed right) {
    Flex flex = Flex::None;
    switch (unify(e, left, right, flex)) {
    case Numeric::Mixed: reportMixed(e); return errorExpr(e);
    case Numeric::NotNumeric: return vectorArithmetic(e, left, right);
    case Numeric::Ok: break;
    }
    const Typed t = result(e, left.base(), flex);
    folding_.foldBinary(e);
    if (e.op == BinaryOp::IntDiv || e.op == BinaryOp::Mod) checkIntegerOperands(e);
    return t;
}

// DIV and MOD of data and a fraction (manual 1.3.1); two constants are judged when they are folded.
void Expressions::checkIntegerOperands(const BinaryExpr& e) {
    const ConstValue *a = info(*e.left).constant, *b = info(*e.right).constant;
    if ((a != nullptr) == (b != nullptr)) return;
    const Expr& known = a ? *e.left : *e.right;
    const ConstValue& value = a ? *a : *b;
    if (value.kind == ConstValue::Kind::Number && std::isfinite(value.number) &&
        value.number != std::floor(value.number))
        report(say::IntegerOperands, range(known), {text(e.opToken)});
}

// Strings, vectors and rotations.
Typed Expressions::vectorArithmetic(const BinaryExpr& e, Typed left, Typed right) {
    if (left.info->type().rank > 0 || right.info->type().rank > 0) return operatorError(e, left, right);
    // A group signal in a product with a vector counts as num; so does a literal already.
    const auto asNum = [&](const Expr& side, Typed t) {
        if (t.flex != Flex::None) settle(side, program_.num);
        return t.base() == program_.num;
    };
    const auto folded = [&](const Type* type) {
        const Typed t = result(e, type);
        folding_.foldBinary(e);
        return t;
    };
    const Type* pos = program_.typeOf(KnownType::Position);
    const bool leftPos = isKnown(*left.base(), KnownType::Position);
    const bool rightPos = isKnown(*right.base(), KnownType::Position);
    const bool rotations =
        isKnown(*left.base(), KnownType::Orientation) && isKnown(*right.base(), KnownType::Orientation);
    switch (e.op) {
    case BinaryOp::Add:
        if (left.isScalar(TypeKind::String) && right.isScalar(TypeKind::String))
            return folded(program_.string);
        if (leftPos && rightPos) return folded(pos);
        break;
    case BinaryOp::Sub:
        if (leftPos && rightPos) return folded(pos);
        break;
    case BinaryOp::Mul:
        if (leftPos && rightPos) return folded(pos);
        if (leftPos && asNum(*e.right, right)) return folded(pos);
        if (rightPos && asNum(*e.left, left)) return folded(pos);
        if (rotations) return folded(program_.typeOf(KnownType::Orientation));
        break;
    case BinaryOp::Div:
        if (leftPos && asNum(*e.right, right)) return folded(pos);
        break;
    default: break;
    }
    return operatorError(e, left, right);
}

Typed Expressions::comparison(const BinaryExpr& e, Typed left, Typed right) {
    Flex flex = Flex::None;
    switch (unify(e, left, right, flex)) {
    case Numeric::Mixed: reportMixed(e); break;
    case Numeric::NotNumeric: operatorError(e, left, right); break;
    case Numeric::Ok: {
        const Typed t = result(e, program_.boolean);
        folding_.foldBinary(e);
        return t;
    }
    }
    return result(e, program_.boolean);
}

namespace {

/// Arrays of the same dimensions; `known`: all of them are, on both sides.
bool sameDimensions(const DataType& a, const DataType& b, bool& known) {
    known = true;
    if (a.rank != b.rank) return false;
    for (unsigned i = 0; i < a.rank && i < std::size(a.dims); ++i) {
        if (a.dims[i] == 0 || b.dims[i] == 0)
            known = false;
        else if (a.dims[i] != b.dims[i])
            return false;
    }
    return true;
}

} // namespace

// Whole arrays of known, equal size are compared as they are assigned (manual 1.3.2).
Typed Expressions::equality(const BinaryExpr& e, Typed left, Typed right) {
    Flex flex = Flex::None;
    const Numeric numeric = unify(e, left, right, flex);
    const Typed t = result(e, program_.boolean);
    const DataType &a = left.info->type(), &b = right.info->type();
    if (numeric == Numeric::Ok)
        folding_.foldBinary(e);
    else if (numeric == Numeric::Mixed)
        reportMixed(e);
    else if (bool known = true; a.type->base() != b.type->base() || !sameDimensions(a, b, known)) {
        const auto names = typeNames(a, b);
        const bool literalLeft = e.left->kind == NodeKind::NumLiteral ||
                                 e.left->kind == NodeKind::StringLiteral ||
                                 e.left->kind == NodeKind::BoolLiteral;
        const Expr& odd = literalLeft ? *e.left : *e.right;
        const Remedy remedy = literalLeft ? remedies_.remedyFor(odd, a, b) : remedies_.remedyFor(odd, b, a);
        remedies_.offer(report(say::CompareTypes, range(e.opToken), {text(e.opToken), names[0], names[1]},
                               {Misfit::Operator, e}),
                        odd, remedy);
    } else if (!known)
        report(say::CompareArrays, range(e.opToken), {text(e.opToken)});
    else
        folding_.foldBinary(e);
    return t;
}

Typed Expressions::logic(const BinaryExpr& e, Typed left, Typed right) {
    if (!left.isScalar(TypeKind::Bool) || !right.isScalar(TypeKind::Bool)) {
        return operatorError(e, left, right);
    }
    const Typed t = result(e, program_.boolean);
    folding_.foldBinary(e);
    return t;
}

} // namespace rapid::sema
