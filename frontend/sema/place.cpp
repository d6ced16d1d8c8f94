// References to data: entire data, array elements, record components (manual 1.3.2).

#include "frontend/sema/place.h"
#include "frontend/diag/messages/expressions.h"
#include "frontend/diag/messages/names.h"
#include "frontend/sema/expr.h"
#include "frontend/sema/fold.h"
#include "frontend/sema/parameters.h"
#include "frontend/sema/resolve_data.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/suggestions.h"
#include "frontend/sema/unknown.h"
#include "frontend/sema/wording.h"

#include <algorithm>
#include <cmath>

namespace rapid::sema {

using namespace syntax;

bool isPlaceExpr(const Expr& e) {
    return e.kind == NodeKind::Name || e.kind == NodeKind::Index || e.kind == NodeKind::Component;
}

Places::Places(State& state, const Parts& parts)
    : CheckerPart(state), data_(parts.data), expressions_(parts.expressions), folding_(parts.folding),
      scopes_(parts.scopes), suggestions_(parts.suggestions), unknown_(parts.unknown) {}

// `handle`: a signal or mechanical unit is expected here, an undeclared name is taken as one.
Place Places::place(const Expr& e, const Type* handle) {
    if (e.kind == NodeKind::Name) return namePlace(as<NameExpr>(e), handle);
    if (e.kind == NodeKind::Index) return indexPlace(as<IndexExpr>(e), handle);
    return componentPlace(as<ComponentExpr>(e), handle);
}

Place Places::namePlace(const NameExpr& e, const Type* handle) {
    ExprInfo& result = info(e);
    result.setType(*program_.errorType);
    Place place;
    place.name = &e;
    if (!isName(e.name)) return place;
    const NameId name = idOf(e.name);
    Symbol* symbol = scopes_.lookup(name);
    if (!symbol) symbol = unknown_.reportUnknownData(e.name, name, handle);
    if (!symbol) return place;
    DataSymbol* data = asData(symbol);
    if (!data) {
        const RoutineSymbol* routine = asRoutine(symbol);
        const bool function = routine && routine->routineKind == RoutineKind::Func;
        if (function && context_.tree->tokens[e.name + 1].kind == TokenKind::LeftBracket)
            return place; // reported
        auto& d = function ? report(say::FunctionWithoutParentheses, range(e), {text(e)})
                           : report(say::NotData, range(e), {text(e), describe(*symbol)});
        if (function && nextRequired(*routine, 0) >= routine->params.size()) {
            const uint32_t end = range(e).end;
            d.fix({end, end}, "()");
        }
        noteDeclared(d, *symbol);
        return place;
    }
    if (data->assumed) facts().open = true;
    if (scopes_.markUsed(*data) && data->storage == Storage::Signal)
        facts().signals.emplace_back(data, e.name);
    data_.ensureData(*data);
    if (data->optional && !data->isSwitch && data->routine == context_.routine && !state_.presenceOnly) {
        OptionalUse& use = routine_.optionalUses[data->index];
        if (!use.first) use.first = &e;
    }
    place.root = data;
    result.symbol = data;
    setType(e, data->type);
    if (data->dataKind == DataKind::Const && data->storage != Storage::Parameter &&
        data->storage != Storage::Signal) {
        data_.ensureValue(*data);
        if (state_.valueUnused && data->isLiteralConstant()) return place;
        const ConstValue& value = data->value();
        if (value.kind != ConstValue::Kind::None) result.constant = &value;
    }
    return place;
}

// The value of a constant index in `value`, 0 if it is not known.
void Places::checkIndex(const Expr& index, int32_t dimension, int64_t& value) {
    const Typed t = expressions_.expr(index);
    value = 0;
    if (t.isError()) return;
    if (t.flex != Flex::None) expressions_.settle(index, program_.num);
    if (!t.isScalar(TypeKind::Num)) {
        report(say::IndexType, range(index), {typeName(*t.info)}, {Misfit::Type, index});
        return;
    }
    const ConstValue* constant = t.info->constant;
    if (!constant || constant->kind != ConstValue::Kind::Number) return;
    const double number = constant->number;
    const bool integer = number == std::floor(number);
    if (dimension > 0 && (!integer || number < 1 || number > dimension))
        report(say::IndexOutOfRange, range(index), {valueText(index), std::to_string(dimension)});
    else if (!integer || number < 1)
        report(say::IndexBelowOne, range(index), {valueText(index)});
    else if (number < 2e9)
        value = static_cast<int64_t>(number);
}

Place Places::indexPlace(const IndexExpr& e, const Type* handle) {
    ExprInfo& result = info(e);
    result.setType(*program_.errorType);
    Place place;
    if (!isPlaceExpr(*e.base)) {
        expressions_.visitLoose(*e.base);
        for (const Expr* i : e.indices)
            expressions_.visitLoose(*i);
        return place;
    }
    if (context_.tree->tokens[e.base->last + 1].kind == TokenKind::LeftParen &&
        e.base->kind == NodeKind::Name &&
        asRoutine(scopes_.lookup(idOf(as<NameExpr>(*e.base).name)))) { // `f(1) := 2`, a syntax error
        for (const Expr* i : e.indices)
            expressions_.visitLoose(*i);
        return place;
    }
    place = this->place(*e.base, handle);
    place.whole = false;
    const DataType type = info(*e.base).type();
    const bool error = type.type->kind == TypeKind::Error;
    const ConstValue* constant = info(*e.base).constant;
    const bool countOk = type.rank == e.indices.size();
    const bool broken = std::any_of(e.indices.begin(), e.indices.end(),
                                    [](const Expr* index) { return index->kind == NodeKind::ErrorExpr; });
    for (size_t i = 0; i < e.indices.size(); ++i) {
        int64_t value = 0;
        checkIndex(*e.indices[i], countOk && !error ? type.dims[i] : 0, value);
        const bool inside =
            constant && value >= 1 && static_cast<size_t>(value) <= constant->members().size();
        constant = inside ? &constant->members()[static_cast<size_t>(value - 1)] : nullptr;
    }
    if (error || e.base->kind != NodeKind::Name) return {}; // an index on a part is a syntax error
    if (type.rank == 0)
        report(say::IndexNotArray, range(e), {text(*e.base), typeName(type)}, {Misfit::NotArray, e});
    else if (!countOk && !broken) {
        const SourceRange where = {range(*e.indices.front()).begin, range(*e.indices.back()).end};
        report(
            say::IndexCount, where,
            {text(*e.base), counted(e.indices.size(), "index", "indexes"), counted(type.rank, "dimension")});
    }
    if (!countOk) return {};
    result.setType(*type.type);
    if (constant && constant->kind != ConstValue::Kind::None) result.constant = folding_.partOf(*constant);
    return place;
}

Place Places::componentPlace(const ComponentExpr& e, const Type*) {
    ExprInfo& result = info(e);
    result.setType(*program_.errorType);
    Place place;
    if (!isPlaceExpr(*e.base)) {
        expressions_.visitLoose(*e.base);
        return place;
    }
    place = this->place(*e.base);
    place.whole = false;
    const ExprInfo& base = info(*e.base);
    if (base.type().type->kind == TypeKind::Error || !isName(e.name)) return {};
    if (base.type().rank > 0) {
        report(say::ComponentOfArray, range(e.name), {text(e.name)});
        return {};
    }
    if (base.type().type->kind != TypeKind::Record) {
        report(say::ComponentOfNonRecord, range(e.name), {text(e.name), typeName(base)},
               {Misfit::NotRecord, e});
        return {};
    }
    const std::string_view name = context_.tree->text(e.name);
    const int component = base.type().type->findComponent(name);
    if (component < 0 && base.type().type->base()->unclear)
        return {}; // it may be among what could not be read
    if (component < 0) {
        std::string meant = suggestions_.deeperComponent(*base.type().type, name);
        if (const Type::Component* near = suggestions_.nearComponent(*base.type().type, name);
            near && meant.empty())
            meant = near->name;
        diag::Diagnostic& d =
            report(say::UnknownComponent, range(e.name),
                   {text(e.name), base.type().type->name, meant.empty() ? meant : didYouMean(meant)});
        if (!meant.empty()) d.fix(range(e.name), meant, false);
        return {};
    }
    const auto index = static_cast<size_t>(component);
    result.setType(*base.type().type->base()->components[index].type);
    if (base.constant && index < base.constant->members().size())
        result.constant = folding_.partOf(base.constant->members()[index]);
    return place;
}

} // namespace rapid::sema
