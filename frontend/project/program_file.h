#pragma once
// Readers of the small files that describe programs and backups: .pgf, backinfo.txt and the tasks in SYS.cfg. They are
// tolerant: what they do not know they skip.

#include <string>
#include <string_view>
#include <vector>

namespace rapid::project {

/// Module file names in a program file (controller format, XML), in order. False: it is no program file.
bool readProgramFile(std::string_view text, std::vector<std::string>& modules);

struct BackupTask {
    std::string folder; ///< "TASK1"
    std::string name;   ///< "T_ROB1"
};
/// The tasks that backinfo.txt lists: `>>TASK1: (T_ROB1,ProgramName,)`.
std::vector<BackupTask> readBackupTasks(std::string_view backinfo);

struct ConfiguredTask {
    std::string name;
    std::string type = "SEMISTATIC"; ///< what an absent Type means
    std::string entry = "main";
};
/// The instances of CAB_TASKS in a SYS configuration file.
std::vector<ConfiguredTask> readConfiguredTasks(std::string_view sysConfiguration);

} // namespace rapid::project
