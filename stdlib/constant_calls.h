#pragma once
// Functions whose result depends on their arguments alone, as the compiler calls them where these are constants; generated
// from the declarations.

#include "runtime/abi/rt_abi.h"

#include <span>

namespace rt {

struct ConstantCall {
    const char* symbol; ///< "rt_" + name
    /// `arguments`: the address of each value (float, double, bool, String), null for an absent optional argument and for a
    /// switch that is not given; `result`: where the result goes. Returns the error number that the function raises, or kOk.
    Status (*call)(void* result, const void* const* arguments);
};

/// In the order of the declarations. Functions of type dnum are not among them.
std::span<const ConstantCall> constantCalls();

} // namespace rt
