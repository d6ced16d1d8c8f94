#pragma once
// From the command line to tasks: files, folders, program files (.pgf) and controller backups become lists of source
// files for each task, and the configuration files found beside them.

#include "frontend/project/open_texts.h"
#include "frontend/sema/checker.h"

#include <optional>
#include <string>
#include <vector>

namespace rapid::project {

/// A task beside the main one: `--task=NAME=INPUT,...`, `--task=NAME:STATIC=INPUT,...`.
struct TaskSpec {
    std::string name;
    std::string type = "NORMAL";     ///< NORMAL, STATIC, SEMISTATIC
    std::vector<std::string> inputs; ///< files, folders or .pgf
};

struct ProjectInput {
    std::vector<sema::TaskInput> tasks;
    std::vector<std::string> configFiles; ///< *.cfg files named or found, in the order of reading
    /// RobotWare options that a backup lists, e.g. "623-1 Multitasking"; not known without one.
    std::optional<std::vector<std::string>> robotWareOptions;
    std::vector<std::string> sharedFiles; ///< modules that a backup holds once for all tasks (TASK0), by path
    std::string robot;                    ///< model that a backup names only among its options; else empty
    std::string homeFolder;               ///< HOME of a backup; empty if there is none
    /// Set before: the folder of $HOME where one was chosen. Modules that the configuration loads from HOME: are sought
    /// there before the HOME of the input.
    std::string chosenHome;
    std::string folderWithoutModules; ///< its configuration names modules, and none of them exists
    bool isBackup = false;
    std::vector<std::string> filesRead; ///< modules, programs and what else was opened
};

/// Resolves `inputs` (they make up task T_ROB1, unless one of them is a backup, which brings its own tasks) and the
/// additional tasks. Unusable inputs are reported with their remedy. Returns false if something was an error; `out`
/// then holds what could be read. `texts` count before files.
bool loadProject(const std::vector<std::string>& inputs, const std::vector<TaskSpec>& extraTasks,
                 ProjectInput& out, diag::Sink& sink, const OpenTexts* texts = nullptr);

} // namespace rapid::project
