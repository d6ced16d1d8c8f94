#include "frontend/project/system_parameters.h"

#include "config/cfg_parser.h"
#include "config/text_util.h"

namespace rapid::project {

namespace {

/// "HOME:/lib/x.sys" -> "x"
std::string stemOf(std::string_view file) {
    const size_t slash = file.find_last_of("/\\:");
    if (slash != std::string_view::npos) file.remove_prefix(slash + 1);
    return std::string(file.substr(0, file.rfind('.')));
}

} // namespace

TaskParameters readTaskParameters(std::string_view text) {
    TaskParameters parameters;
    std::vector<config::CfgProblem> ignored;
    const config::CfgFile file = config::parseCfg(text, "SYS.cfg", ignored);
    for (const config::CfgSection* section : file.find("CAB_TASKS")) {
        for (const config::CfgInstance& instance : section->instances) {
            ConfiguredTask task;
            task.name = instance.text("Name");
            task.type = config::upperCase(instance.text("Type", task.type));
            if (task.type != "NORMAL" && task.type != "STATIC") task.type = "SEMISTATIC";
            if (const std::string entry = instance.text("Entry"); !entry.empty()) task.entry = entry;
            task.motion = instance.flag("MotionTask");
            task.bindsReferences = instance.find("BindRef") == nullptr || instance.flag("BindRef");
            if (!task.name.empty()) parameters.tasks.push_back(std::move(task));
        }
    }
    for (const config::CfgSection* section : file.find("CAB_TASK_MODULES")) {
        for (const config::CfgInstance& instance : section->instances) {
            ConfiguredModule module;
            module.file = instance.text("File");
            module.name = instance.text("ModName", stemOf(module.file));
            module.task = instance.text("Task");
            module.shared = instance.flag("Shared");
            module.allMotionTasks = instance.flag("AllMotionTask");
            // The copy of a shared module that belongs to no task is part of each.
            module.allTasks =
                instance.flag("AllTask") || (module.shared && module.task.empty() && !module.allMotionTasks);
            if (!module.file.empty()) parameters.modules.push_back(std::move(module));
        }
    }
    return parameters;
}

} // namespace rapid::project
