#pragma once
// Inputs of a command -> checked program -> IR. Shared by check, build, run and emit.

#include "config/output_guard.h"
#include "frontend/lint/warnings.h"
#include "frontend/sema/checker.h"
#include "ir/core/ir.h"
#include "ir/passes/passes.h"
#include "tools/rapidc/signal_uses.h"

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

struct Inputs {
    std::vector<std::string> paths;       ///< files, folders, programs
    std::vector<std::string> tasks;       ///< NAME[:TYPE]=INPUT[,INPUT]
    std::vector<std::string> configFiles; ///< --config
    std::vector<std::string> robots;      ///< --robot, [UNIT=]MODEL; an unknown one is wrong usage
    std::vector<std::string> conveyors;   ///< --conveyor, UNIT=KEY:VALUE,...
    std::vector<std::string> cameras;     ///< --camera, NAME=FILE
    bool requireMain = false;
    std::vector<std::string> warnings; ///< -W
    bool lint = false;                 ///< with the warnings of 8xxx, also where -W does not name them
    bool onlyDiagnostics = false;      ///< nothing is lowered: the inside of routines need not be kept
    bool assumeSignals = false; ///< define the signals that the configuration lacks as the program uses them
};

/// Result of the front end, with everything the later stages need.
struct Compilation {
    rapid::diag::Sink sink;
    std::unique_ptr<rapid::sema::CheckedProgram> program;
    std::vector<rapid::sema::TaskInput> tasks; ///< what was checked,
    rapid::sema::CheckOptions options;         ///< and how; commands that change files check again
    std::vector<rapid::sema::LibraryText> library;
    rapid::lint::WarningLevels warningLevels;
    std::vector<std::string> configNames; ///< what --config and the folders gave
    std::vector<std::string> configTexts;
    std::vector<UsedSignal> assumedSignals; ///< with Inputs::assumeSignals: what the configuration lacked
    std::set<std::string> sharedModules;    ///< installed once for all tasks; lower case
    std::set<std::string> eventRoutines;    ///< that the configuration names; lower case
    std::vector<std::string> usageErrors;   ///< e.g. a --task that cannot be read
    bool callsByName = false;               ///< a debugger will evaluate expressions that call routines
    bool overflowChecks = true;             ///< off in benchmarks that measure what they cost
    std::string folder;                     ///< kept in the program: where relative paths begin; may be empty
    std::string homeFolder;                 ///< HOME of a backup; empty if there is none
    std::vector<std::string> filesRead;     ///< which no output may overwrite
};

/// Adds the option --assume-signals to a command.
void addAssumeSignalsOption(const rt::Command& command, Inputs& inputs);

/// Adds the options that say what is compiled: -W, --task, --config, --robot.
void addWarningOption(const rt::Command& command, Inputs& inputs);
void addTaskOption(const rt::Command& command, Inputs& inputs);
void addConfigOption(const rt::Command& command, Inputs& inputs);
void addRobotOption(const rt::Command& command, Inputs& inputs);

/// Loads, parses and checks. Look at `sink` and `usageErrors` before going on; there is no program when the options
/// cannot be read.
std::unique_ptr<Compilation> checkInputs(const Inputs& inputs);

/// Lowers and runs the IR passes. False with diagnostics in the sink when something stands against it. `passesBelow`: a
/// program of as many IR instructions is only verified outside its routines; whoever compiles it runs the passes (irPasses).
bool lowerToIr(Compilation& compilation, const std::string& name, bool stepping, ir::Module& out,
               size_t passesBelow = SIZE_MAX);

/// The program looks at every statement (SpyStart): it has to be compiled for the stepping profile.
bool timesStatements(const Compilation& compilation);

/// The passes of the profile.
ir::PassOptions irPasses(const Compilation& compilation, bool stepping);

/// Verifies a module and runs the passes of the profile; findings are internal errors in the sink.
bool runIrPasses(ir::Module& module, const ir::PassOptions& options, rapid::diag::Sink& sink);

/// Writes all diagnostics to stderr in the form for people, and a closing line when there are errors. What a backup
/// holds (notes 605x) is told only by `check`.
void printDiagnostics(const Compilation& compilation, bool withReport = false);

/// Why the outputs of a command cannot be written without loss; "" when they can. `outputs`: option and path.
std::string outputConflict(const Compilation& compilation,
                           std::initializer_list<std::pair<const char*, std::string>> outputs,
                           rapid::config::OutputGuard guard = {});

} // namespace rapidc
