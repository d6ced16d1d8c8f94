#pragma once
// Reader of BACKINFO/backinfo.txt: what a controller says about its own backup. Tolerant: what it does not know it skips.

#include <string>
#include <string_view>
#include <vector>

namespace rapid::project {

/// A module that a backup lists: `PROGMOD/main.mod @ `.
struct ListedModule {
    std::string folder;  ///< "PROGMOD", "SYSMOD"
    std::string file;    ///< "main.mod"; the file on disk may differ in case
    bool hidden = false; ///< RobotWare's own: listed, but not saved
};

struct ListedTask {
    std::string folder;  ///< "TASK1"
    std::string name;    ///< "T_ROB1"
    std::string program; ///< name of the program, may be empty
    std::vector<ListedModule> modules;
};

struct BackupInfo {
    std::string systemId;
    std::string robotWare;            ///< "6.16.02.00"; empty if not known
    std::vector<std::string> addIns;  ///< "StateMachine Add-In 1.1"
    std::vector<std::string> options; ///< "616-1 PC Interface", "IRB 1660ID-4/1.55"
    std::vector<ListedTask> tasks;
};

/// Reads the text in any of its spellings (slash or backslash, LF or CRLF, RobotWare 5 to 7).
BackupInfo readBackupInfo(std::string_view text);

} // namespace rapid::project
