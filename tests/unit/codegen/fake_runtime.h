#pragma once
// A runtime of a few lines for tests of compiled code: it reports what is called and decides nothing.

#include <memory>
#include <string>
#include <vector>

#include "codegen/codegen.h"
#include "ir/core/ir.h"
#include "runtime/abi/rt_abi.h"

namespace codegen_testing {

/// The calls, in order, e.g. "raise 11 at 0 in trynext", "note 3".
extern std::vector<std::string> events;

/// The statuses of the native rt_fallible, call by call; after the last one: status 0 and the argument.
extern std::vector<rt::Status> fallibleStatuses;

struct Task {
    rt::TaskCore core{};
    Task();
};

/// The addresses of the fake runtime.
std::vector<codegen::NativeSymbol> symbols();

/// Runs all passes and compiles. Fails the test when something is wrong. `interpreted`: every routine is; it must not call the
/// runtime then, since the interpreter calls the real one.
std::unique_ptr<codegen::JitProgram> compile(ir::Module module, bool optimise = true,
                                             bool interpreted = false);

/// C entry of an exported routine.
void* entry(const codegen::JitProgram& program, const std::string& name);
void* global(const codegen::JitProgram& program, const std::string& name);

} // namespace codegen_testing
