#include "ir/passes/call_native.h"

namespace ir {
namespace {

constexpr size_t kMostParams = 3;

bool isNumber(TypeId type) {
    return type == kF32 || type == kF64 || type == kBool;
}

/// Calls a function whose parameters so far are `Params`, with `values`; the types of the others come from the signature.
template <class Result, class... Params>
double callWith(void* code, const Native& native, std::span<const double> arguments, Params... values) {
    constexpr size_t count = sizeof...(Params);
    if (count == native.params.size()) {
        const auto function = reinterpret_cast<Result (*)(Params...)>(code);
        return static_cast<double>(function(values...));
    }
    if constexpr (count < kMostParams) {
        const double next = arguments[count];
        if (native.params[count] == kF32)
            return callWith<Result, Params..., float>(code, native, arguments, values...,
                                                      static_cast<float>(next));
        if (native.params[count] == kF64)
            return callWith<Result, Params..., double>(code, native, arguments, values..., next);
        return callWith<Result, Params..., bool>(code, native, arguments, values..., next != 0);
    }
    return 0; // not reached: the caller has counted
}

} // namespace

std::optional<double> callConstNative(const Native& native, NativeCode code,
                                      std::span<const double> arguments) {
    if (code == nullptr || native.nativeClass != NativeClass::Const) return {};
    if (native.result != kF32 && native.result != kBool) return {};
    if (native.params.size() > kMostParams || native.params.size() != arguments.size()) return {};
    for (const TypeId type : native.params)
        if (!isNumber(type)) return {};
    void* const address = code(native.symbol);
    if (address == nullptr) return {};
    if (native.result == kF32) return callWith<float>(address, native, arguments);
    return callWith<bool>(address, native, arguments);
}

} // namespace ir
