#pragma once
// Entry to semantic analysis: files of all tasks in, checked program and diagnostics out.

#include "frontend/sema/checked.h"

#include <functional>
#include <optional>
#include <set>

namespace rapid::sema {

/// One declaration file of the standard library, embedded text.
struct LibraryText {
    std::string_view name;
    std::string_view text;
};

struct TaskInput {
    std::string name = "T_ROB1";
    std::string type = "NORMAL"; ///< NORMAL, STATIC, SEMISTATIC
    std::string entry = "main";
    std::vector<std::shared_ptr<const SourceFile>> files;
    /// Modules that belong to the task but cannot be read: encrypted, not saved with the backup, missing. As named by
    /// the backup, e.g. "secret.sys"; what they declare is not known.
    std::vector<std::string> missingModules;
    /// Names that nothing declares may be declared elsewhere: some `missingModules`, or modules that were not named, as the
    /// system modules of a controller are that a program file never lists.
    bool incomplete = false;
    /// BindRef of SYS.cfg is off: a name that nothing declares is an error of execution, which the program may handle.
    bool bindsLate = false;
    /// Without an entry routine the task is left out of a program, with a warning, instead of being an error: tasks of
    /// options and add-ins, whose modules a backup does not hold.
    bool optional = false;
};

struct CheckOptions {
    bool requireMain = false;        ///< build and run: a task without entry routine is an error
    bool configurationKnown = false; ///< some EIO configuration was given: an unknown signal name is an error
    bool assumeSignals = false;      ///< signals that the configuration lacks exist as they are used
    std::vector<SignalInfo> signals; ///< from the configuration; mechanical units as well
    /// RobotWare options of the controller, e.g. "623-1 Multitasking", when a backup lists them; else unknown.
    std::optional<std::vector<std::string>> robotWareOptions;
    /// Modules that are installed once for all tasks (CAB_TASK_MODULES), names in lower case.
    std::set<std::string> sharedModules;
    std::span<const LibraryText> library;
    /// Called by check() for each file of a task, with its modules, as soon as everything in it is checked.
    std::function<void(const CheckedProgram&, const Task&, std::span<Module* const>)> onFile;
    /// For who only wants the diagnostics: half the memory, and it stays in the cache. Trees come with whole aggregates
    /// (syntax::ParseOptions), and what is known of the inside of a file's routines is forgotten after onFile: the
    /// expressions, calls, data and labels of FileFacts.
    bool onlyDiagnostics = false;
};

/// Parses and checks. Always returns a program; lower it only when `sink` has no errors.
std::unique_ptr<CheckedProgram> check(const std::vector<TaskInput>& tasks, const CheckOptions& options,
                                      diag::Sink& sink);

} // namespace rapid::sema
