// Manual 1.17: GetSysData and SetSysData: the tool, the work object and the payload that are in force.

#include "runtime/base/text_util.h"
#include "runtime/value/value_text.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/data_names.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/task_asked.h"

#include "natives/support.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cstring>

using namespace rt;

namespace {

/// The settings of the robot of a motion task: the one place where this folder asks for them.
lib::MotionState& stateOf(Task& owner) {
    return lib::motionState(&owner);
}

/// The names that SetSysData has given; they hold as long as the data have that value.
struct ActiveNames {
    std::string tool, workObject, payload;
};

/// The place of the value in force, its size, and its name; the predefined data that are in force until a program chooses
/// others.
struct Active {
    void* value = nullptr;
    std::size_t size = 0;
    std::string* name = nullptr;
    const void* standardValue = nullptr;
    const char* standardName = nullptr;
};

/// Without a value for a type that is never in force.
Active activeOf(Task& owner, const TypeDesc& type) {
    static const lib::MotionState standard;
    lib::MotionState& state = stateOf(owner);
    auto& names = owner.controller().service<ActiveNames>();
    const auto active = [](auto& value, std::string& name, const auto& standardValue,
                           const char* standardName) {
        return Active{&value, sizeof value, &name, &standardValue, standardName};
    };
    if (sameName(type.baseName, "tooldata")) return active(state.tool, names.tool, standard.tool, "tool0");
    if (sameName(type.baseName, "wobjdata"))
        return active(state.workObject, names.workObject, standard.workObject, "wobj0");
    if (sameName(type.baseName, "loaddata"))
        return active(state.gripLoad, names.payload, standard.gripLoad, "load0");
    return {};
}

Status wrongType(TaskCore* task, const TypeDesc& type) {
    return lib::fail(task, err::ERR_ARGVALERR,
                     std::string("data of type ") + type.name +
                         " is never in force here; use tooldata, wobjdata or loaddata");
}

/// Not byte by byte: records have gaps.
bool sameValue(const void* a, const void* b, const TypeDesc& type) {
    std::string first, second;
    return valueToSource(a, type, first) && valueToSource(b, type, second) && first == second;
}

bool isPersistent(const GlobalDesc* data, const TypeDesc& type) {
    return data && data->kind == kGlobalPersistent && data->type->kind == DescKind::Record &&
           sameName(data->type->baseName, type.baseName);
}

/// The persistent of this type that has the value in force; movements note the value, not the name. `asked`: not this one,
/// into which the value may have been copied before.
std::string nameOf(const Task& owner, const TypeDesc& type, const Active& active, const void* asked) {
    const Controller& controller = owner.controller();
    const auto hasValue = [&](const GlobalDesc& data) {
        return isPersistent(&data, type) && sameValue(data.address, active.value, type);
    };
    const GlobalDesc* named = controller.findGlobal(*active.name, {}, owner);
    if (named && hasValue(*named)) return *active.name;
    if (sameValue(active.value, active.standardValue, type)) return active.standardName;
    for (const GlobalDesc* data : controller.tables().globals())
        if (data->address != asked && hasValue(*data)) return data->name;
    return {};
}

} // namespace

extern "C" {

Status rt_GetSysData(TaskCore* task, Handle* TaskRef, const String* TaskName, void* DestObject,
                     const TypeDesc* DestObjectType, String* ObjectName) {
    Task* owner = &taskOf(task);
    Status status = kOk;
    if (TaskRef || TaskName) owner = lib::taskAsked(task, TaskRef, TaskName, status);
    if (status != kOk) return status;
    if (!owner->isMotionTask())
        return lib::fail(task, err::ERR_NOT_MOVETASK, "task " + owner->name() + " moves no robot");
    const Active active = activeOf(*owner, *DestObjectType);
    if (!active.value) return wrongType(task, *DestObjectType);
    if (ObjectName) ObjectName->assign(nameOf(*owner, *DestObjectType, active, DestObject));
    std::memcpy(DestObject, active.value, active.size);
    return kOk;
}

Status rt_SetSysData(TaskCore* task, void* SourceObject, const TypeDesc* SourceObjectType,
                     const String* ObjectName) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    const Active active = activeOf(taskOf(task), *SourceObjectType);
    if (!active.value) return wrongType(task, *SourceObjectType);
    const Task& owner = taskOf(task);
    const GlobalDesc* source = ObjectName ? owner.controller().findGlobal(ObjectName->view(), {}, owner)
                                          : lib::dataAt(owner.controller(), SourceObject);
    if (ObjectName && !isPersistent(source, *SourceObjectType))
        return lib::fail(task, err::ERR_ARGVALERR,
                         fmt::format("SetSysData: no persistent of type {} is named \"{}\"",
                                     SourceObjectType->baseName, ObjectName->view()));
    const void* value = ObjectName ? source->address : SourceObject;
    if (active.value == &stateOf(taskOf(task)).gripLoad &&
        static_cast<const data::Loaddata*>(value)->mass < 0)
        return lib::fail(task, err::ERR_ARGVALERR, "the mass of a payload must not be negative");
    std::memcpy(active.value, value, active.size);
    *active.name = source ? source->name : "";
    return kOk;
}
}
