#pragma once
// Calls natives while compiling, where their arguments are constants.

#include <optional>
#include <span>
#include <string_view>

#include "ir/core/ir.h"

namespace ir {

/// The code of a native in this process, by symbol; null: none, so its calls are left to the program.
using NativeCode = void* (*)(std::string_view symbol);

/// Returns the result of a native of class Const for constants, given as Inst::number (f32, f64) or Inst::integer (bool) hold them.
/// Empty when `code` has none, and for other signatures than at most three f32, f64 and bool that give f32 or bool: the last
/// digit of an f64 may depend on the math library of the machine that executes the program.
std::optional<double> callConstNative(const Native& native, NativeCode code,
                                      std::span<const double> arguments);

} // namespace ir
