#pragma once
// How routines are called, decided in one place: the C++ prototypes of the natives (stdlib/gen) and the signatures that compiled
// code uses (ir/lower) are both made from these rules.

#include "runtime/abi/rt_abi.h"

#include <array>
#include <span>
#include <type_traits>

namespace rt {

/// How an argument gets to a routine.
enum class Passing : uint8_t {
    Value,   ///< required IN num, dnum, bool
    Switch,  ///< bool
    Pointer, ///< address, null when an optional argument is absent; with arrays the dimensions follow
    Any      ///< address of data of any type; its description follows
};

/// The properties of a parameter that decide its class.
struct ParamShape {
    bool isSwitch = false;
    bool isAny = false;    ///< of type anytype
    bool isScalar = false; ///< num, dnum or bool
    bool isIn = false;
    bool optional = false; ///< or one of several required alternatives
    int rank = 0;          ///< number of dimensions, 0 = not an array
};

constexpr Passing passingOf(const ParamShape& param) {
    if (param.isSwitch) return Passing::Switch;
    if (param.isAny) return Passing::Any;
    const bool byValue = param.isIn && !param.optional && param.rank == 0 && param.isScalar;
    return byValue ? Passing::Value : Passing::Pointer;
}

/// One machine argument. A parameter takes one or more of them.
enum class Slot : uint8_t { Value, Switch, Address, Type, Dimension };

/// Calls `add(slot)` for each machine argument of a parameter, in order.
template <class Add> constexpr void forEachSlot(const ParamShape& param, Add add) {
    switch (passingOf(param)) {
    case Passing::Value: return add(Slot::Value);
    case Passing::Switch: return add(Slot::Switch);
    case Passing::Any: add(Slot::Address); return add(Slot::Type);
    case Passing::Pointer:
        add(Slot::Address);
        for (int i = 0; i < param.rank; ++i)
            add(Slot::Dimension);
        return;
    }
}

constexpr uint32_t slotCount(const ParamShape& param) {
    uint32_t count = 0;
    forEachSlot(param, [&](Slot) { ++count; });
    return count;
}

/// Natives that return their value and get no task: functions without effects (`effects: const`) whose result and parameters
/// all are scalar values. All others return a Status and store the result through a pointer.
constexpr bool returnsItsValue(bool isConstFunction, bool scalarResult, bool allValues) {
    return isConstFunction && scalarResult && allValues;
}

/// Types of machine arguments and results.
enum class AbiType : uint8_t { Void, Bool, I32, I64, F32, F64, String, Pointer };

template <class T> constexpr AbiType abiTypeOf() {
    if constexpr (std::is_void_v<T>)
        return AbiType::Void;
    else if constexpr (std::is_pointer_v<T>)
        return AbiType::Pointer;
    else if constexpr (std::is_same_v<T, bool>)
        return AbiType::Bool;
    else if constexpr (std::is_same_v<T, int32_t>)
        return AbiType::I32;
    else if constexpr (std::is_same_v<T, int64_t>)
        return AbiType::I64;
    else if constexpr (std::is_same_v<T, float>)
        return AbiType::F32;
    else if constexpr (std::is_same_v<T, double>)
        return AbiType::F64;
    else {
        static_assert(std::is_same_v<T, String>, "a type that compiled code does not pass");
        return AbiType::String;
    }
}

/// Signature of a support native as compiled code calls it.
struct NativeSignature {
    const char* symbol = nullptr;
    bool returnsValue = false; ///< returnsItsValue(); otherwise Status symbol(TaskCore*, [Result*,] params)
    AbiType result = AbiType::Void;
    std::span<const AbiType> params; ///< without task and result
};

/// The signature of `Result(Params...)`.
template <class F> struct SignatureOf;
template <class Result, class... Params> struct SignatureOf<Result(Params...)> {
    static constexpr AbiType result = abiTypeOf<Result>();
    static constexpr std::array<AbiType, sizeof...(Params)> params{abiTypeOf<Params>()...};
};

} // namespace rt
