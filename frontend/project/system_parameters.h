#pragma once
// The tasks in SYS.cfg: CAB_TASKS and CAB_TASK_MODULES. The runtime reads everything else in it.

#include <string>
#include <string_view>
#include <vector>

namespace rapid::project {

struct ConfiguredTask {
    std::string name;
    std::string type = "SEMISTATIC"; ///< what an absent Type means
    std::string entry = "main";
    bool motion = false;
    bool bindsReferences = true; ///< BindRef: names that nothing declares are errors
};

/// A module that the controller loads at start-up. Part of a task, or of all of them.
struct ConfiguredModule {
    std::string file; ///< "HOME:/x.sys", "RELEASE:/options/...", "STATEMACHINE:/RAPID/..."
    std::string name; ///< of the module; that of the file when it is not given
    std::string task; ///< empty: see allTasks, allMotionTasks
    bool allTasks = false;
    bool allMotionTasks = false;
    bool shared = false; ///< one copy for all tasks
};

struct TaskParameters {
    std::vector<ConfiguredTask> tasks;
    std::vector<ConfiguredModule> modules;
};

/// Reads a SYS configuration; its mistakes are reported by those who use all of it.
TaskParameters readTaskParameters(std::string_view text);

} // namespace rapid::project
