#pragma once
// Inputs of a command -> checked program -> IR. Shared by check, build, run and emit.

#include "config/output_guard.h"
#include "frontend/workspace/compilation.h"
#include "ir/core/ir.h"
#include "ir/passes/passes.h"

#include <functional>
#include <initializer_list>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rt {
class Command;
}

namespace rapidc {

using rapid::workspace::Compilation;
using rapid::workspace::Inputs;

/// Adds the argument that names modules, folders, programs and backups. It may be left out when --task names some.
void addInputArgument(const rt::Command& command, Inputs& inputs);

/// The name of the first input without folders and ending; without one the name of the first task.
std::string nameOfProgram(const Inputs& inputs);

/// Adds the option --assume-signals to a command.
void addAssumeSignalsOption(const rt::Command& command, Inputs& inputs);

/// Adds the options that say what is compiled: -W, --task, --config, --robot.
void addWarningOption(const rt::Command& command, Inputs& inputs);
void addTaskOption(const rt::Command& command, Inputs& inputs);
void addConfigOption(const rt::Command& command, Inputs& inputs);
void addRobotOption(const rt::Command& command, Inputs& inputs);

/// Loads, parses and checks. Look at `sink` and `usageErrors` before continuing; there is no program when the options
/// cannot be read.
std::unique_ptr<Compilation> checkInputs(const Inputs& inputs);

/// Lowers and runs the IR passes. False with diagnostics in the sink when something prevents it. `passesBelow`: a
/// program of as many IR instructions is only verified outside its routines; whoever compiles it runs the passes (irPasses).
/// `calledFromOutside`: procedures that are found by name (tests); may be empty.
bool lowerToIr(Compilation& compilation, const std::string& name, bool stepping, ir::Module& out,
               size_t passesBelow = SIZE_MAX,
               const std::function<bool(const rapid::sema::RoutineSymbol&)>& calledFromOutside = {});

/// The program looks at every statement (SpyStart): it has to be compiled for the stepping profile.
bool timesStatements(const Compilation& compilation);

/// The passes of the profile.
ir::PassOptions irPasses(const Compilation& compilation, bool stepping);

/// Verifies a module and runs the passes of the profile; findings are internal errors in the sink.
bool runIrPasses(ir::Module& module, const ir::PassOptions& options, rapid::diag::Sink& sink);

/// Writes all diagnostics to stderr in the form for people, and a closing line when there are errors. What a backup
/// holds (notes 605x) is reported only by `check`.
void printDiagnostics(const Compilation& compilation, bool withReport = false);

/// Why the outputs of a command cannot be written without loss; "" when they can. `outputs`: option and path.
std::string outputConflict(const Compilation& compilation,
                           std::initializer_list<std::pair<const char*, std::string>> outputs,
                           rapid::config::OutputGuard guard = {});

} // namespace rapidc
