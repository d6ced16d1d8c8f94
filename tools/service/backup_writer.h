#pragma once
// Backup: the whole system as controllers save it: BACKINFO, HOME, RAPID/TASKn, SYSPAR, system.xml. `rapidc serve` and `rapidc run` take it
// as they take one of a controller.

#include "frontend/edit/save_values.h"
#include "frontend/source/source_file.h"
#include "tools/service/configuration_store.h"
#include "tools/service/system_facts.h"
#include "tools/service/virtual_controller.h"

#include <memory>
#include <string>
#include <vector>

namespace rapidc::service {

/// Contents of a backup, taken at one moment. Writing it needs nothing else.
struct BackupContent {
    struct Module {
        std::shared_ptr<const rapid::SourceFile> source;
        std::vector<rapid::edit::DataValue> values; ///< of its persistents
        std::string name;                           ///< of the file, without its ending
    };
    struct Task {
        std::string name, type, entry, program;
        bool isMotionTask = false;
        bool isConfigured = false; ///< CAB_TASKS has it
        std::vector<Module> modules;
        std::vector<std::string> opaqueFiles; ///< of the backup that was loaded: encrypted, kept as they are
    };
    std::vector<Task> tasks;
    std::vector<Module> shared;                                  ///< installed once for all tasks: TASK0
    std::vector<std::pair<std::string, std::string>> parameters; ///< files of SYSPAR: name, bytes
    SystemFacts system;
    RobotWareVersion robotWare;
    std::string homeFolder;  ///< on the host
    bool namesRobot = false; ///< MOC.cfg has it
    int64_t calendarSeconds = 0;
};

/// On the controller's thread.
BackupContent takeBackup(VirtualController& controller, const ConfigurationStore& configuration);

/// From any thread. Writes into a new folder, which is complete or absent at any moment. "" or what went wrong.
std::string writeBackup(const BackupContent& content, const std::string& folder);

} // namespace rapidc::service
