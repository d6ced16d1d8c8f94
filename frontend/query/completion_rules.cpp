#include "frontend/query/completion_rules.h"

#include "frontend/query/meaning.h"
#include "frontend/sema/type_rules.h"

namespace rapid::query {

using namespace sema;
using syntax::DataKind;
using syntax::ParamMode;

Fit FitRules::of(const Symbol& symbol) const {
    if (const DataSymbol* data = dataOf(&symbol)) return ofData(*data);
    const RoutineSymbol* routine = routineOf(&symbol);
    if (!routine || routine->routineKind != syntax::RoutineKind::Func || cursor_.mode != ParamMode::In ||
        cursor_.expect == Expect::Target)
        return Fit::Misfit;
    const Fit fit = ofType(routine->returnType);
    return fit == Fit::Reach && hasPart(*routine->returnType.type, 0) ? Fit::Misfit
                                                                      : fit; // f(x).part is not RAPID
}

Fit FitRules::ofData(const DataSymbol& data) const {
    if (!data.type.type || data.type.type->kind == TypeKind::Error || data.isSwitch) return Fit::Misfit;
    const bool variable = data.storage != Storage::LoopVariable && data.dataKind == DataKind::Var &&
                          data.storage != Storage::Signal && data.storage != Storage::SystemVariable;
    const bool persistent = data.dataKind == DataKind::Pers && data.storage != Storage::Parameter;
    const bool parameter = data.storage == Storage::Parameter;
    switch (cursor_.mode) {
    case ParamMode::In: break;
    case ParamMode::Var:
        if (parameter ? data.mode == ParamMode::Pers : !variable && data.storage != Storage::Signal)
            return Fit::Misfit;
        break;
    case ParamMode::Pers:
        if (parameter ? data.mode != ParamMode::Pers : !persistent) return Fit::Misfit;
        break;
    case ParamMode::Inout:
    case ParamMode::Ref:
        if (!parameter && !variable && !persistent) return Fit::Misfit;
        break;
    }
    return ofType(data.type);
}

Fit FitRules::ofAny(const DataType& type) const {
    const bool value = isValueType(*type.type);
    const bool signal = type.type->base()->kind == TypeKind::SemiValue;
    switch (cursor_.accepts) {
    case ParamClass::Any: return Fit::Alike;
    case ParamClass::Value: return value ? Fit::Alike : Fit::Misfit;
    case ParamClass::ValueOrSignal: return value || signal ? Fit::Alike : Fit::Misfit;
    case ParamClass::Atomic:
        return value && type.type->base()->kind != TypeKind::Record ? Fit::Alike
               : value                                              ? Fit::Reach
                                                                    : Fit::Misfit;
    case ParamClass::Numeric:
        return type.type->base()->isNumeric() ? Fit::Alike : value ? Fit::Reach : Fit::Misfit;
    case ParamClass::Signal: return signal ? Fit::Alike : Fit::Misfit;
    case ParamClass::SignalOrString:
        return signal || type.type->base()->kind == TypeKind::String ? Fit::Alike : Fit::Misfit;
    case ParamClass::Array: return type.isArray() ? Fit::Alike : Fit::Misfit;
    }
    return Fit::Alike;
}

Fit FitRules::ofType(const DataType& type) const {
    if (!type.type) return Fit::Misfit;
    if (cursor_.anyType) return ofAny(type);
    if (!cursor_.type.type || cursor_.type.type->kind == TypeKind::Error) return Fit::Alike;
    const Type* wanted = cursor_.type.type;
    const Type *base = type.type->base(), *wantedBase = wanted->base();
    if (cursor_.type.isArray())
        return base == wantedBase && type.rank == cursor_.type.rank ? Fit::Exact : Fit::Misfit;
    if (base == wantedBase) {
        if (type.isArray()) return Fit::Reach;
        return type.type == wanted ? Fit::Exact : Fit::Alike;
    }
    // In a condition everything may be compared.
    if (wantedBase->kind == TypeKind::Bool)
        return isValueType(*base) || base->kind == TypeKind::SemiValue ? Fit::Reach : Fit::Misfit;
    if (wantedBase->isNumeric() && (base->isNumeric() || base->kind == TypeKind::SemiValue))
        return Fit::Reach;
    return hasPart(*type.type, 0) ? Fit::Reach : Fit::Misfit;
}

bool FitRules::hasPart(const Type& type, int depth) const {
    if (depth > 8 || type.base()->kind != TypeKind::Record || !cursor_.type.type) return false;
    const auto [known, isNew] = parts_.try_emplace(&type, false);
    if (!isNew) return known->second;
    bool found = false;
    for (const Type::Component& component : type.base()->components)
        if (component.type &&
            (component.type->base() == cursor_.type.type->base() || hasPart(*component.type, depth + 1)))
            found = true;
    return parts_[&type] = found;
}

} // namespace rapid::query
