#pragma once
// How much of a program can be executed at most, by its control flow alone.

#include "ir/core/ir.h"

namespace ir {

/// Instructions that one execution of the program's only task can execute at most; infinity when something may be repeated
/// without such a bound: a loop, a retry, recursion, a routine that is called from outside, a second task.
double mostExecuted(const Module& module);

} // namespace ir
