// Cyclically evaluated logical conditions.

#include "runtime/abi/support_natives.h"
#include "runtime/base/text_util.h"
#include "stdlib/impl/io/cyclic_bools.h"
#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/support/data_names.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/task_asked.h"

#include "natives/io_signals.h"
#include "stdlib_constants.h"

#include <map>

using namespace rt;

namespace {

/// Conditions between rt_beginCondition and the SetupCyclicBool that takes them.
struct BegunConditions {
    std::map<const Task*, lib::Condition> byTask;
};

lib::Condition& begun(TaskCore* task) {
    Task& owner = taskOf(task);
    return owner.controller().service<BegunConditions>().byTask[&owner];
}

lib::CyclicBools& bools(TaskCore* task) {
    return taskOf(task).controller().service<lib::CyclicBools>();
}

/// The persistent that `asker` sees by this name; null when there is none of type bool.
bool* flagNamed(const Task& asker, std::string_view name) {
    const GlobalDesc* data = asker.controller().findGlobal(name, "", asker);
    if (data == nullptr || data->kind != kGlobalPersistent || !sameName(data->type->baseName, "bool"))
        return nullptr;
    return static_cast<bool*>(data->address);
}

/// A LOCAL persistent can be named as well, as long as it is a cyclic bool of the task.
bool* cyclicNamed(TaskCore* task, const Task& asker, std::string_view name) {
    for (const auto& entry : bools(task).all())
        if (entry->task == asker.index() && sameName(entry->name, name)) return entry->flag;
    return flagNamed(asker, name);
}

} // namespace

extern "C" {

Status rt_beginCondition(TaskCore* task) {
    begun(task) = {};
    return kOk;
}

Status rt_conditionValue(TaskCore* task, double value) {
    begun(task).pushValue(value);
    return kOk;
}

Status rt_conditionData(TaskCore* task, const void* data, int32_t kind) {
    begun(task).pushData(data, static_cast<lib::Condition::Form>(kind));
    return kOk;
}

Status rt_conditionSignal(TaskCore* task, const Handle* signal, bool asDnum) {
    begun(task).pushSignal(*signal, asDnum);
    return kOk;
}

Status rt_conditionOperator(TaskCore* task, int32_t operation, bool asDnum) {
    begun(task).pushOperator(static_cast<ConditionOperator>(operation), asDnum);
    return kOk;
}

/// The value of the condition now is not needed; computing it has raised the errors that it has.
Status rt_SetupCyclicBool(TaskCore* task, bool* Flag, bool, Handle* Signal) {
    Task& owner = taskOf(task);
    Controller& controller = owner.controller();
    if (Signal != nullptr) {
        IoResult result = controller.io().check(*Signal, 0, true);
        if (result == IoResult::Ok) controller.io().read(*Signal, result); // its device may be off
        if (const Status status = lib::ioStatus(task, result, *Signal)) return status;
    }
    const GlobalDesc* data = lib::dataAt(controller, Flag);
    lib::CyclicBool entry;
    entry.name = data == nullptr ? "" : data->name;
    entry.flag = Flag;
    entry.output = Signal == nullptr ? 0 : *Signal;
    entry.task = owner.index();
    entry.condition = std::move(begun(task));
    if (bools(task).add(controller, std::move(entry))) return kOk;
    return owner.fatal(
        static_cast<int>(EventId::CyclicBoolMisused),
        "60 cyclic bools are set up already, which is the most. Remove one with RemoveCyclicBool.");
}

Status rt_RemoveCyclicBool(TaskCore* task, bool* Flag, const String* Name) {
    const bool* flag = Flag != nullptr ? Flag : cyclicNamed(task, taskOf(task), Name->view());
    if (flag == nullptr)
        return lib::fail(task, err::ERR_REFUNKDAT,
                         "there is no persistent of type bool named " + std::string(Name->view()));
    bools(task).remove(flag);
    return kOk;
}

Status rt_RemoveAllCyclicBool(TaskCore* task, bool AllTasks) {
    if (AllTasks)
        bools(task).removeAll();
    else
        bools(task).removeOf(taskOf(task).index());
    return kOk;
}

Status rt_IsCyclicBool(TaskCore* task, bool* result, bool* Flag, const String* Name, Handle* TaskRef,
                       const String* TaskName) {
    const Task* asker = &taskOf(task);
    if (TaskRef != nullptr || TaskName != nullptr) {
        Status status = kOk;
        asker = lib::taskAsked(task, TaskRef, TaskName, status);
        if (asker == nullptr) return status;
    }
    const bool* flag = Flag != nullptr ? Flag : cyclicNamed(task, *asker, Name->view());
    *result = flag != nullptr && bools(task).find(flag) != nullptr;
    return kOk;
}

Status rt_GetNumberOfCyclicBool(TaskCore* task, float* result) {
    *result = static_cast<float>(bools(task).all().size());
    return kOk;
}

Status rt_GetMaxNumberOfCyclicBool(TaskCore*, float* result) {
    *result = static_cast<float>(lib::CyclicBools::kMost);
    return kOk;
}

Status rt_GetNextCyclicBool(TaskCore* task, bool* result, float* ListNumber, String* Name) {
    const auto& all = bools(task).all();
    *result = *ListNumber >= 0 && *ListNumber < static_cast<float>(all.size());
    if (!*result) return kOk;
    Name->assign(all[static_cast<std::size_t>(*ListNumber)]->name);
    *ListNumber += 1;
    return kOk;
}
}
