// Controller: what SYS.cfg says about tasks: foreground, trust level, event routines (manual 1.20).

#include "runtime/base/text_util.h"
#include "runtime/host/controller.h"

#include <algorithm>
#include <map>

namespace rt {
namespace {

/// -SeqNo, 0 when it is not given.
double sequenceOf(const CfgInstance& hook) {
    double number = 0;
    hook.number("SeqNo", number);
    return number;
}

bool lists(const CfgInstance& instance, std::string_view attribute, const std::string& name) {
    const CfgAttribute* found = instance.find(attribute);
    return found != nullptr && std::any_of(found->values.begin(), found->values.end(),
                                           [&](const std::string& value) { return sameName(value, name); });
}

} // namespace

void Controller::applyTaskParameters() {
    for (const CfgInstance* instance : instances("SYS", "CAB_TASKS"))
        setForeground(*instance);
    addEventRoutines();
}

void Controller::setForeground(const CfgInstance& instance) {
    std::string name = instance.text("Task_in_forground");
    if (name.empty()) name = instance.text("TaskInForeground");
    Task* const task = findTask(instance.text("Name"));
    if (name.empty() || task == nullptr) return;
    Task* const foreground = findTask(name);
    if (foreground == nullptr) {
        log_.write(EventId::ForegroundIgnored, task, {task->name(), name, "there is no such task"});
        return;
    }
    for (const Task* at = foreground; at != nullptr; at = at->foreground()) {
        if (at != task) continue;
        log_.write(EventId::ForegroundIgnored, task,
                   {task->name(), name, "the tasks would be in the background of each other"});
        return;
    }
    task->setForeground(foreground);
}

bool Controller::hookConcerns(const CfgInstance& hook, const Task& task) const {
    if (hook.flag("AllTask")) return true;
    if (hook.flag("AllMotionTask")) return task.isMotionTask();
    // Attributes with their default value are not written: T_ROB1, the first task.
    return hook.find("Task") == nullptr ? task.index() == 0 : lists(hook, "Task", task.name());
}

void Controller::addEventRoutines() {
    std::multimap<double, const CfgInstance*> bySequence; // equals in the order of the file
    for (const CfgInstance* hook : instances("SYS", "CAB_EXEC_HOOKS"))
        bySequence.emplace(sequenceOf(*hook), hook);
    for (const auto& [number, hook] : bySequence) {
        const std::string name = hook->text("Routine", "(without a name)");
        const SystemEvent event = systemEventOf(hook->text("Shelf"));
        if (event == SystemEvent::None) {
            log_.write(EventId::EventUnknown, nullptr, {name, hook->text("Shelf")});
            continue;
        }
        const CfgAttribute* listed = hook->find("Task");
        for (const std::string& task : listed != nullptr ? listed->values : std::vector<std::string>()) {
            if (findTask(task) == nullptr)
                log_.write(EventId::EventRoutineMissing, nullptr, {name, nameOf(event), task});
        }
        for (const auto& task : tasks_) {
            if (!hookConcerns(*hook, *task)) continue;
            const RoutineEntry* routine = findRoutine(name, "", *task);
            if (routine == nullptr || routine->desc->callable == 0)
                log_.write(EventId::EventRoutineMissing, task.get(), {name, nameOf(event), task->name()});
            else
                task->events().add(event, reinterpret_cast<EntryFunction>(routine->address));
        }
    }
}

// ---- Trust level ---------------------------------------------------------------------------------------------------

std::string Controller::trustLevel(const Task& task) const {
    for (const CfgInstance* instance : instances("SYS", "CAB_TASKS")) {
        if (sameName(instance->text("Name"), task.name())) return instance->text("TrustLevel", "SysFail");
    }
    return "SysFail";
}

/// A STATIC or SEMISTATIC task does not execute any more.
void Controller::backgroundStopped(Task& task) {
    const std::string level = trustLevel(task);
    if (sameName(level, "NoSafety") || sameName(level, "None")) return;
    const char* type = task.kind() == TaskKind::Static ? "STATIC" : "SEMISTATIC";
    log_.write(EventId::SystemFailure, &task, {task.name(), type, level});
    if (sameName(level, "SysStop")) {
        backgroundStopped_ = true;
    } else {
        systemFailed_ = true;
        motorsOn_ = motorsOn_ && !sameName(level, "SysHalt");
    }
    stopNormalTasks(StopCause::Order);
    forEachArm([](SteppedArm& arm) { arm.programStop(); });
}

} // namespace rt
