#pragma once
// Inputs of a command -> checked program. Shared by check, build, run, emit, rename and the language server.

#include "frontend/lint/warnings.h"
#include "frontend/project/project.h"
#include "frontend/sema/checker.h"
#include "frontend/workspace/environment.h"
#include "frontend/workspace/signal_uses.h"

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace rapid::workspace {

struct Inputs {
    std::vector<std::string> paths;       ///< files, folders, programs
    std::vector<std::string> tasks;       ///< NAME[:TYPE]=INPUT[,INPUT]
    std::vector<std::string> configFiles; ///< --config
    std::vector<std::string> robots;      ///< --robot, [UNIT=]MODEL; an unknown one is wrong usage
    std::vector<std::string> conveyors;   ///< --conveyor, UNIT=KEY:VALUE,...
    std::vector<std::string> cameras;     ///< --camera, NAME=FILE
    std::string home;                     ///< --home; "" when none was chosen
    bool requireMain =
        false; ///< the program is executed: NORMAL tasks need main, and the controller reports robots without model
    std::vector<std::string> warnings; ///< -W
    bool lint = false;                 ///< with the warnings of 8xxx, even where -W does not name them
    bool onlyDiagnostics = false;      ///< nothing is lowered: the inside of routines need not be kept
    bool documented = false;    ///< with the documentation of what is predefined, for people who read it
    bool assumeSignals = false; ///< define the signals that the configuration lacks as the program uses them
    const project::OpenTexts* texts = nullptr; ///< count before the files; may be null
    /// Called with what was read, before it is checked; may change, add and remove files. Empty: nothing is changed.
    std::function<void(std::vector<sema::TaskInput>&)> adjust;
};

/// Result of the front end, with everything the later stages need.
struct Compilation {
    diag::Sink sink;
    std::unique_ptr<sema::CheckedProgram> program;
    std::vector<sema::TaskInput> tasks; ///< what was checked,
    sema::CheckOptions options;         ///< and how; commands that change files check again
    std::vector<sema::LibraryText> library;
    lint::WarningLevels warningLevels;
    std::vector<std::string> configNames; ///< what --config and the folders gave
    std::vector<std::string> configTexts;
    std::vector<UsedSignal> assumedSignals; ///< with Inputs::assumeSignals: what the configuration lacked
    std::set<std::string> sharedModules;    ///< installed once for all tasks; lower case
    std::set<std::string> eventRoutines;    ///< that the configuration names; lower case
    std::vector<std::string> usageErrors;   ///< e.g. a --task that cannot be read
    bool loaded = false;                    ///< options could be read: there is something to check
    bool callsByName = false;               ///< a debugger will evaluate expressions that call routines
    bool keepsPredefined = false;           ///< clients will read and write predefined data by name
    bool overflowChecks = true;             ///< off in benchmarks that measure what they cost
    std::string folder;                     ///< kept in the program: where relative paths begin; may be empty
    std::string homeFolder;                 ///< HOME of a backup; empty if there is none
    std::vector<std::string> filesRead;     ///< which no output may overwrite
    std::vector<std::string> sharedFiles;   ///< modules that a backup holds once for all tasks, by path
};

/// Everything before the check: tasks, options, configuration, warning levels, and in `sink` what is wrong with them.
/// Look at `loaded`.
std::unique_ptr<Compilation> loadInputs(const Inputs& inputs, const Environment& environment);

/// Loads, parses and checks. Look at `sink` and `usageErrors` before anything else; there is no program when the options
/// cannot be read.
std::unique_ptr<Compilation> checkInputs(const Inputs& inputs, const Environment& environment);

} // namespace rapid::workspace
