#pragma once
// Prototypes of support_natives.def, and their signatures as compiled code sees them.

#include "runtime/abi/native_signature.h"

namespace rt {

/// An argument of rt_lateCall.
struct LateCallArg {
    void* data; ///< null: a conditional argument that is absent; a switch: any address
    const TypeDesc* type;
    const String* objectName; ///< of the data object it is (ArgName), null: none
    const String* parameter;  ///< null: the next required one
    int32_t flags;            ///< LateFlag
};
enum LateFlag : int32_t { kLateReference = 1, kLateConstant = 2, kLateSwitch = 4 };

namespace support {
/// Prototype of a support native: Status(TaskCore*, [Result*,] Params...).
template <class F> struct Prototype;
template <class Result, class... Params> struct Prototype<Result(Params...)> {
    using Type = Status(TaskCore*, Result*, Params...);
};
template <class... Params> struct Prototype<void(Params...)> {
    using Type = Status(TaskCore*, Params...);
};

#define SUPPORT_NATIVE(symbol, value, ...) using symbol##_type = Prototype<value(__VA_ARGS__)>::Type;
#define SUPPORT_VALUE(symbol, value, ...) using symbol##_type = value(__VA_ARGS__);
#include "runtime/abi/support_natives.def"

/// Which one; indices into kSignatures.
enum class Native : uint8_t {
#define SUPPORT_NATIVE(symbol, ...) symbol,
#define SUPPORT_VALUE(symbol, ...) symbol,
#include "runtime/abi/support_natives.def"
};

inline constexpr NativeSignature kSignatures[] = {
#define SUPPORT_NATIVE(symbol, value, ...)                                                                   \
    {#symbol, false, SignatureOf<value(__VA_ARGS__)>::result, SignatureOf<value(__VA_ARGS__)>::params},
#define SUPPORT_VALUE(symbol, value, ...)                                                                    \
    {#symbol, true, SignatureOf<value(__VA_ARGS__)>::result, SignatureOf<value(__VA_ARGS__)>::params},
#include "runtime/abi/support_natives.def"
};

constexpr const NativeSignature& signatureOf(Native native) {
    return kSignatures[static_cast<size_t>(native)];
}
} // namespace support
} // namespace rt

extern "C" {
#define SUPPORT_NATIVE(symbol, ...) rt::support::symbol##_type symbol;
#define SUPPORT_VALUE(symbol, ...) rt::support::symbol##_type symbol;
#include "runtime/abi/support_natives.def"
}
