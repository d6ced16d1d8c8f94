#include "tools/program/constant_calls.h"

#include "stdlib/constant_calls.h"

#include <array>
#include <cmath>
#include <unordered_map>
#include <variant>

namespace rapidc {

namespace {

using rapid::sema::ConstValue;
using rapid::sema::TypeKind;
using Value = std::variant<std::monostate, float, double, bool, rt::String>; ///< as the functions take it

const rt::ConstantCall* find(const std::string& symbol) {
    static const auto calls = [] {
        std::unordered_map<std::string_view, const rt::ConstantCall*> result;
        for (const rt::ConstantCall& call : rt::constantCalls())
            result.emplace(call.symbol, &call);
        return result;
    }();
    const auto found = calls.find(symbol);
    return found == calls.end() ? nullptr : found->second;
}

Value emptyOf(const rapid::sema::Type& type) {
    switch (type.base()->kind) {
    case TypeKind::Num: return 0.0F;
    case TypeKind::Dnum: return 0.0;
    case TypeKind::Bool: return false;
    case TypeKind::String: return rt::String();
    default: return {};
    }
}

void give(const ConstValue& from, Value& to) {
    if (float* number = std::get_if<float>(&to)) *number = static_cast<float>(from.number);
    if (double* number = std::get_if<double>(&to)) *number = from.number;
    if (bool* truth = std::get_if<bool>(&to)) *truth = from.boolean;
    rt::String* text = std::get_if<rt::String>(&to);
    if (text && !from.text().empty()) text->assign(from.text()); // an empty one may have no bytes at all
}

void* addressOf(Value& value) {
    return std::visit([](auto& held) -> void* { return &held; }, value);
}

std::optional<ConstValue> taken(const Value& from, rapid::Arena& arena) {
    ConstValue to;
    if (const float* number = std::get_if<float>(&from)) {
        if (!std::isfinite(*number)) return {};
        to.kind = ConstValue::Kind::Number;
        to.number = static_cast<double>(*number);
    } else if (const bool* truth = std::get_if<bool>(&from)) {
        to.kind = ConstValue::Kind::Bool;
        to.boolean = *truth;
    } else if (const rt::String* text = std::get_if<rt::String>(&from)) {
        to.setText(text->view(), arena);
    } else {
        return {};
    }
    return to;
}

std::optional<ConstValue> evaluate(const rapid::sema::RoutineSymbol& routine,
                                   std::span<const ConstValue* const> arguments, rapid::Arena& arena) {
    const rt::ConstantCall* call = find("rt_" + routine.name);
    std::array<Value, 8> values;
    std::array<const void*, 8> addresses{};
    if (!call || arguments.size() > values.size()) return {};
    for (size_t i = 0; i < arguments.size(); ++i) {
        if (!arguments[i]) continue;
        const rapid::sema::DataSymbol& parameter = *routine.params[i];
        values[i] = parameter.isSwitch ? Value(true) : emptyOf(*parameter.type.type);
        give(*arguments[i], values[i]);
        addresses[i] = addressOf(values[i]);
    }
    Value result = emptyOf(*routine.returnType.type);
    return call->call(addressOf(result), addresses.data()) == rt::kOk ? taken(result, arena) : std::nullopt;
}

} // namespace

decltype(rapid::lower::Options::evaluate) constantCalls() {
    return evaluate;
}

} // namespace rapidc
