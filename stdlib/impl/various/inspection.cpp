// Manual 1.6 and 1.17: modes, tasks, types of data.

#include "runtime/host/panel_switches.h"
#include "runtime/value/whole_limits.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/data_names.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/task_asked.h"

#include "natives/math.h"
#include "natives/multitasking.h"
#include "natives/support.h"
#include "natives/various.h"
#include "stdlib_constants.h"

#include <cmath>
#include <cstring>

using namespace rt;

extern "C" {

Status rt_TryInt(TaskCore* task, const float* DataObj, const double* DataObj2) {
    const double value = DataObj ? static_cast<double>(*DataObj) : *DataObj2;
    if (std::trunc(value) != value)
        return lib::fail(task, err::ERR_INT_NOTVAL, "the value is not a whole number");
    if (std::fabs(value) > (DataObj ? kNumInteger : kDnumInteger))
        return lib::fail(task, err::ERR_INT_MAXVAL, "the value is too large to be held as an exact integer");
    return kOk;
}

Status rt_Type(TaskCore*, String* result, void*, const TypeDesc* DataType, bool BaseName) {
    const TypeDesc* type = DataType->kind == DescKind::Array ? DataType->fields[0] : DataType;
    result->assign(BaseName ? type->baseName : type->name);
    return kOk;
}

Status rt_IsPers(TaskCore* task, bool* result, void* DatObj, const TypeDesc*) {
    *result = lib::isPersistent(taskOf(task).controller(), DatObj);
    return kOk;
}

Status rt_IsVar(TaskCore* task, bool* result, void* DatObj, const TypeDesc*) {
    *result = !lib::isPersistent(taskOf(task).controller(), DatObj);
    return kOk;
}

Status rt_ResetData(TaskCore*, void* Data, const TypeDesc* DataType) {
    std::memset(Data, 0, DataType->size); // zero, "" and FALSE are the default values of every value type
    return kOk;
}

Status rt_OpMode(TaskCore* task, float* result) {
    switch (taskOf(task).controller().service<PanelSwitches>().mode) {
    case OperatingMode::Auto: *result = k::OP_AUTO; break;
    case OperatingMode::ManualReduced: *result = k::OP_MAN_PROG; break;
    case OperatingMode::ManualFull: *result = k::OP_MAN_TEST; break;
    }
    return kOk;
}
/// Steps count as continuous execution.
Status rt_RunMode(TaskCore*, float* result, bool) {
    *result = k::RUN_CONT_CYCLE;
    return kOk;
}
Status rt_NonMotionMode(TaskCore*, float* result, bool) {
    *result = k::RUN_CONT_CYCLE;
    return kOk;
}
Status rt_RobOS(TaskCore*, bool* result) {
    *result = false;
    return kOk;
}

Status rt_GetTaskName(TaskCore* task, String* result, float* TaskNo, float* MecTaskNo) {
    const Task& owner = taskOf(task);
    const auto number = static_cast<float>(owner.index() + 1);
    if (TaskNo) *TaskNo = number;
    if (MecTaskNo) *MecTaskNo = static_cast<float>(owner.motionGroup() + 1);
    result->assign(owner.name());
    return kOk;
}
Status rt_TaskRunMec(TaskCore* task, bool* result) {
    *result = taskOf(task).isMotionTask();
    return kOk;
}
Status rt_TaskRunRob(TaskCore* task, bool* result) {
    *result = lib::movesRobot(taskOf(task));
    return kOk;
}
Status rt_TaskIsExecuting(TaskCore* task, bool* result, Handle* TaskRef, const String* TaskName) {
    Status status = kOk;
    const Task* other = lib::taskAsked(task, TaskRef, TaskName, status);
    if (other) *result = other->isExecuting();
    return status;
}
Status rt_TaskIsActive(TaskCore* task, bool* result, Handle* TaskRef, const String* TaskName) {
    Status status = kOk;
    const Task* other = lib::taskAsked(task, TaskRef, TaskName, status);
    if (other) *result = other->kind() == TaskKind::Normal;
    return status;
}
/// Tasks cannot be deselected on a virtual controller.
Status rt_GetTSPStatus(TaskCore* task, float* result, Handle* TaskRef, const String* TaskName) {
    Status status = kOk;
    const Task* other = lib::taskAsked(task, TaskRef, TaskName, status);
    if (other)
        *result = other->kind() == TaskKind::Normal ? k::TSP_STATUS_ACT : k::TSP_STATUS_NOT_NORMAL_TASK;
    return status;
}
Status rt_MotionPlannerNo(TaskCore* task, float* result) {
    *result = static_cast<float>(taskOf(task).motionGroup() + 1);
    return kOk;
}

Status rt_Rand(TaskCore* task, float* result) {
    // 24 bits: every value is exact in binary32 and below 1
    *result = static_cast<float>(taskOf(task).controller().random()() >> 8) * 0x1p-24f;
    return kOk;
}
}
