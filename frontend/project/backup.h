#pragma once
// A controller's backup: BACKINFO/backinfo.txt, RAPID/TASKn/{PROGMOD,SYSMOD}, SYSPAR/*.cfg, HOME. Becomes tasks, and
// what was found, what is missing and what follows from it becomes notes and warnings (605x, 606x).

#include "frontend/project/project.h"

#include "frontend/project/files.h"

namespace rapid::project {

/// True when the folder looks like a backup: it has RAPID with task folders or with PROGMOD, SYSMOD.
bool isBackup(const std::filesystem::path& folder);

/// Appends the backup's tasks (the first motion task first), configuration files, options and HOME folder to `out`.
void loadBackup(const std::filesystem::path& folder, FileReader& files, diag::Sink& sink, ProjectInput& out);

} // namespace rapid::project
