#pragma once
// A plain folder with a SYS.cfg: CAB_TASKS and CAB_TASK_MODULES tell its tasks and which modules each of them loads, as
// they do in a backup.

#include "frontend/project/files.h"
#include "frontend/project/project.h"

#include <set>

namespace rapid::project {

/// Appends the tasks of a folder to `out`, the motion task first. False, with nothing done, when the folder has no SYS.cfg
/// that names tasks or modules. `elsewhere`: tasks in upper case whose modules the command line names.
bool loadConfiguredFolder(const std::filesystem::path& folder, const std::set<std::string>& elsewhere,
                          FileReader& files, diag::Sink& sink, ProjectInput& out);

} // namespace rapid::project
