// Expressions: literals, values of data, aggregates, and how a value fits the type its context wants
// (manual 1.3.1 to 1.3.3).

#include "frontend/sema/expr.h"
#include "frontend/diag/messages/expressions.h"
#include "frontend/sema/call.h"
#include "frontend/sema/fold.h"
#include "frontend/sema/place.h"
#include "frontend/sema/remedies.h"
#include "frontend/sema/type_rules.h"
#include "frontend/sema/wording.h"
#include "frontend/syntax/lexer.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace rapid::sema {

using namespace syntax;

Expressions::Expressions(State& state, const Parts& parts)
    : CheckerPart(state), calls_(parts.calls), folding_(parts.folding), places_(parts.places),
      remedies_(parts.remedies) {}

Typed Expressions::result(const Expr& e, const Type* type, Flex flex) {
    ExprInfo& out = info(e);
    out.setType(*type);
    return {&out, flex};
}

Typed Expressions::errorExpr(const Expr& e) {
    return result(e, program_.errorType);
}

Typed Expressions::expr(const Expr& e, const DataType* want, ConstValue* slot) {
    switch (e.kind) {
    case NodeKind::NumLiteral: return literal(as<NumLiteralExpr>(e), want, slot);
    case NodeKind::StringLiteral: {
        const Typed t = result(e, program_.string);
        ConstValue* value = slot ? slot : folding_.newConst();
        value->setText(decodeStringLiteral(context_.tree->text(e.first)), folding_.valueArena());
        t.info->constant = value;
        return t;
    }
    case NodeKind::BoolLiteral: {
        const Typed t = result(e, program_.boolean);
        ConstValue* value = slot ? slot : folding_.newConst();
        value->kind = ConstValue::Kind::Bool;
        value->boolean = as<BoolLiteralExpr>(e).value;
        t.info->constant = value;
        return t;
    }
    case NodeKind::Name:
    case NodeKind::Index:
    case NodeKind::Component: return placeValue(e);
    case NodeKind::Call: return calls_.functionCall(as<CallExpr>(e));
    case NodeKind::Aggregate: return aggregate(as<AggregateExpr>(e), want, slot);
    case NodeKind::Paren: return paren(as<ParenExpr>(e), want, slot);
    case NodeKind::Unary: return unary(as<UnaryExpr>(e), want, slot);
    case NodeKind::Binary: return binaryChain(as<BinaryExpr>(e), want);
    default: return errorExpr(e);
    }
}

Typed Expressions::literal(const NumLiteralExpr& e, const DataType* want, ConstValue* slot) {
    const bool known = want && want->rank == 0 && want->type->isNumeric();
    // A whole number that num cannot hold exactly is a dnum where the context leaves the choice.
    const bool dnum = known ? want->type->kind == TypeKind::Dnum
                            : isWholeLiteral(context_.tree->text(e.first)) &&
                                  static_cast<double>(static_cast<float>(e.value)) != e.value;
    const Typed t = result(e, dnum ? program_.dnum : program_.num, Flex::Literal);
    ConstValue* value = slot ? slot : folding_.newConst();
    value->kind = ConstValue::Kind::Number;
    value->number = dnum ? e.value : static_cast<double>(static_cast<float>(e.value));
    t.info->constant = value;
    if (!std::isfinite(static_cast<float>(e.value))) bigLiterals_.push_back(&e);
    return t;
}

// Literals that ended up as num although they do not fit it.
void Expressions::checkBigLiterals(size_t first) {
    for (const Expr* e : std::span(bigLiterals_).subspan(first))
        if (info(*e).type().type->kind == TypeKind::Num) report(say::NumberBeyondNum, range(*e), {text(*e)});
    bigLiterals_.resize(first);
}

// Data as a value: signals are read, handles have no value.
Typed Expressions::placeValue(const Expr& e) {
    const Place found = places_.place(e);
    ExprInfo& out = info(e);
    if (!found.root) return {&out};
    const Type& type = *out.type().type;
    switch (type.kind) {
    case TypeKind::SemiValue: {
        if (out.type().rank > 0) return {&out};
        const bool group = isKnown(type, KnownType::GroupInput) || isKnown(type, KnownType::GroupOutput);
        return result(e, group ? program_.dnum : program_.num, group ? Flex::Group : Flex::None);
    }
    case TypeKind::Switch:
        remedies_.fixCall(report(say::SwitchAsValue, range(e), {text(e)}), e, "Present", true);
        return errorExpr(e);
    case TypeKind::AnyType: return errorExpr(e);
    case TypeKind::NonValue: break;
    case TypeKind::Record:
        if (!type.containsNonValue) return {&out};
        break;
    default: return {&out};
    }
    report(say::NonValueInExpression, range(e), {text(e), type.name}, {Misfit::Kind, e});
    nonValueReported_ = true;
    return errorExpr(e);
}

Typed Expressions::paren(const ParenExpr& e, const DataType* want, ConstValue* slot) {
    const Typed inner = expr(*e.inner, want, slot);
    ExprInfo& out = info(e);
    out = *inner.info;
    out.symbol = nullptr;
    return {&out, inner.flex};
}

// Can it be of type `want`? Says why not.
bool Expressions::aggregateFits(const AggregateExpr& e, const DataType& want) {
    const size_t count = e.elements().size();
    if (want.type->kind == TypeKind::AnyType)
        report(say::AggregateWithoutType, range(e));
    else if (want.type->kind == TypeKind::Error)
        return false;
    else if (want.rank == 0 && want.type->kind != TypeKind::Record)
        report(say::AggregateForAtomic, range(e), {typeName(want)}, {Misfit::Aggregate, e});
    else {
        const size_t expected = want.rank == 0     ? want.type->base()->components.size()
                                : want.dims[0] > 0 ? static_cast<size_t>(want.dims[0])
                                                   : count;
        if (count == expected) return true;
        if (want.rank == 0 && want.type->base()->unclear) return false;
        for (const Expr* element : e.elements())
            if (element->kind == NodeKind::ErrorExpr) return false;
        report(say::AggregateCount, range(e),
               {counted(count, "member"), std::to_string(expected), typeName(want)});
    }
    return false;
}

// Programs and backups of other versions have values of other forms: they can be read, the value has no use.
Typed Expressions::aggregateOfVersion(const AggregateExpr& e, const DataType& want, ConstValue* slot) {
    report(say::AggregateOfVersion, range(e),
           {counted(e.elements().size(), "member"), std::to_string(want.type->base()->components.size()),
            typeName(want)});
    for (const Expr* element : e.elements())
        visitLoose(*element);
    ConstValue* value = slot ? slot : folding_.newConst();
    folding_.setDefault(*value, *want.type);
    ExprInfo& out = info(e);
    setType(e, want);
    out.constant = value;
    return {&out};
}

// Members get their constants in the place where the whole value keeps them.
Typed Expressions::aggregate(const AggregateExpr& e, const DataType* want, ConstValue* slot) {
    if (want && want->rank == 0 && want->type->base()->uncertain &&
        e.elements().size() != want->type->base()->components.size())
        return aggregateOfVersion(e, *want, slot);
    if (!want) report(say::AggregateWithoutType, range(e));
    if (!want || !aggregateFits(e, *want)) {
        for (const Expr* element : e.elements())
            visitLoose(*element);
        return errorExpr(e);
    }
    const bool array = want->rank > 0;
    const std::vector<Type::Component>& components = want->type->base()->components;
    const size_t count = e.elements().size();
    ConstValue* value = slot ? slot : folding_.newConst();
    const std::span<ConstValue> members = folding_.valueArena().makeArray<ConstValue>(count);
    bool constant = true;
    bool wrong = false;
    DataType member = {
        want->type, static_cast<uint8_t>(array ? want->rank - 1 : 0), {want->dims[1], want->dims[2], 0}};
    DataType own = *want;
    if (array) own.dims[0] = static_cast<int32_t>(count);
    for (size_t i = 0; i < count; ++i) {
        const Expr& element = *e.elements()[i];
        if (!array) member = {components[i].type, 0, {}};
        const Typed t = expr(element, &member, &members[i]);
        const bool fit = fits(element, t, member);
        if (!fit) {
            const auto names = typeNames(t.info->type(), member);
            const Remedy remedy = remedies_.remedyFor(element, t.info->type(), member);
            remedies_.offer(
                report(say::AggregateMember, range(element), {names[0], names[1]}, {Misfit::Type, element}),
                element, remedy);
        }
        if (!array &&
            member.type->kind == TypeKind::Error) { // of a type that is not here: what is said is left out
            members[i] = {};
            continue;
        }
        wrong |= !fit || t.isError();
        // The first row of an array of unknown size gives the length of the others.
        if (array && i == 0) std::copy_n(t.info->type().dims, member.rank, own.dims + 1);
        if (array) std::copy_n(own.dims + 1, member.rank, member.dims);
        if (!t.info->constant)
            constant = false;
        else if (t.info->constant != &members[i])
            members[i] = folding_.owned(*t.info->constant);
    }
    ExprInfo& out = info(e);
    if (wrong) own.type = program_.errorType;
    setType(e, own);
    if (constant && !wrong) {
        value->setMembers(members);
        out.constant = value;
    }
    return {&out};
}

// Looks at an expression whose context is wrong already: own mistakes only, no type is asked for.
void Expressions::visitLoose(const Expr& e) {
    const DataType any = {program_.errorType, 0, {}};
    if (isPlaceExpr(e))
        places_.place(e);
    else
        expr(e, &any);
}

void Expressions::settle(const Expr& top, const Type* to) {
    const Expr* e = &top;
    std::vector<const Expr*> parents; // operators, folded again from the inside out
    for (;;) {
        ExprInfo& out = info(*e);
        if (out.type().type == to) break;
        out.setType(*to);
        if (e->kind == NodeKind::NumLiteral) {
            const double value = as<NumLiteralExpr>(*e).value;
            const bool dnum = to->kind == TypeKind::Dnum;
            if (out.constant)
                const_cast<ConstValue*>(out.constant)->number =
                    dnum ? value : static_cast<double>(static_cast<float>(value));
            break;
        }
        if (e->kind == NodeKind::Paren) {
            parents.push_back(e);
            e = as<ParenExpr>(*e).inner;
        } else if (e->kind == NodeKind::Unary) {
            parents.push_back(e);
            e = as<UnaryExpr>(*e).operand;
        } else if (e->kind == NodeKind::Binary) {
            parents.push_back(e);
            settle(*as<BinaryExpr>(*e).right, to);
            e = as<BinaryExpr>(*e).left;
        } else
            break; // a group signal
    }
    for (; !parents.empty(); parents.pop_back()) {
        const Expr& parent = *parents.back();
        ConstValue* slot = const_cast<ConstValue*>(info(parent).constant);
        if (!slot) continue; // it has no value, and that was judged already
        if (parent.kind == NodeKind::Paren)
            info(parent).constant = info(*as<ParenExpr>(parent).inner).constant;
        else if (parent.kind == NodeKind::Unary)
            folding_.foldUnary(as<UnaryExpr>(parent), slot);
        else
            folding_.foldBinary(as<BinaryExpr>(parent));
    }
}

bool Expressions::fits(const Expr& e, Typed t, const DataType& want) {
    const Type& type = *want.type;
    if (t.flex != Flex::None && want.rank == 0 && type.isNumeric()) {
        settle(e, type.base());
        return true;
    }
    return equivalent(t.info->type(), want);
}

bool Expressions::condition(const Expr& e, const char* what) {
    const Typed t = expr(e);
    if (t.isError() || t.isScalar(TypeKind::Bool)) return true;
    const DataSymbol* data = e.kind == NodeKind::Name ? asData(info(e).symbol) : nullptr;
    const bool signal = data && data->type.type->kind == TypeKind::SemiValue;
    const Remedy remedy = signal ? Remedy{": compare the signal, " + data->name + " = 1", data->name + " = 1"}
                                 : remedies_.remedyFor(e, t.info->type(), {program_.boolean, 0, {}});
    auto& d =
        report(say::ConditionNotBool, range(e), {what, typeName(*t.info), remedy.words}, {Misfit::Type, e});
    if (!remedy.instead.empty()) d.fix(range(e), remedy.instead, false);
    return false;
}

} // namespace rapid::sema
