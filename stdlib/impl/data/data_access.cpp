// Manual 1.17: GetDataVal, SetDataVal.

#include "stdlib/impl/data/data_access.h"

#include "runtime/base/text_util.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/task_asked.h"
#include "stdlib/impl/support/type_match.h"

#include "natives/support.h"
#include "stdlib_constants.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace rt::lib {

Handle DataPositions::handleOf(const DataPosition& position) {
    const auto found = std::find(positions_.begin(), positions_.end(), position);
    const auto index = found - positions_.begin();
    if (found == positions_.end()) positions_.push_back(position);
    return static_cast<Handle>(index) + 1;
}

const DataPosition* DataPositions::find(Handle handle) const {
    if (handle < 1 || handle > static_cast<Handle>(positions_.size())) return nullptr;
    return &positions_[static_cast<std::size_t>(handle - 1)];
}

std::vector<DebugVariable> routineData(const Task& task, bool all) {
    const Debugger& debugger = task.controller().debugger();
    std::vector<DebugVariable> result;
    for (const DebugFrame& frame : debugger.frames(task)) {
        const std::vector<DebugVariable> data = debugger.locals(frame);
        result.insert(result.end(), data.begin(), data.end());
        if (!all) break;
    }
    return result;
}

std::string writeProtection(const DebugVariable& variable) {
    if (variable.isConstant) return "it is a constant";
    const bool system = sameName(variable.module, "data_system");
    const bool fixed = sameName(variable.name, "tool0") || sameName(variable.name, "wobj0") ||
                       sameName(variable.name, "load0");
    return system && fixed ? "it belongs to the system and cannot be changed" : "";
}

Status copyData(TaskCore* task, const DebugVariable& object, void* value, const TypeDesc& type, bool write) {
    const TypeDesc& element = object.rank > 0 ? *object.type : elementOf(*object.type);
    if (!sameType(element, elementOf(type)))
        return fail(task, err::ERR_SYMBOL_TYPE,
                    fmt::format("'{}' is of type {}, the argument of type {}", object.name, element.name,
                                elementOf(type).name));
    const int rank = object.rank > 0 ? object.rank : rankOf(*object.type);
    const int32_t* dims = object.rank > 0 ? object.dims : object.type->dims;
    bool same = rank == rankOf(type);
    for (int k = 0; same && k < rank; ++k)
        same = dims[k] == type.dims[k];
    if (!same)
        return fail(task, err::ERR_INVDIM,
                    fmt::format("'{}' and the argument have different dimensions", object.name));
    std::memmove(write ? object.data : value, write ? value : object.data, type.size);
    return kOk;
}

namespace {

/// A data object that is looked up by name, from the program pointer.
class Lookup {
  public:
    Lookup(TaskCore* core, const String& object)
        : core_(core), task_(taskOf(core)), object_(trimmed(object.view())) {}

    Status find(const Handle* block, const Handle* taskRef, const String* taskName, DebugVariable& out) {
        const std::size_t end = std::min(object_.find_first_of("{. "), object_.size());
        std::string_view name = object_.substr(0, end);
        const std::size_t colon = name.find(':');
        const std::string_view module = colon == std::string_view::npos ? "" : name.substr(0, colon);
        if (colon != std::string_view::npos) name.remove_prefix(colon + 1);
        Status status = kOk;
        if (block != nullptr)
            status = inBlock(*block, name);
        else if (taskRef != nullptr || taskName != nullptr)
            status = inTask(taskRef, taskName, module, name);
        else
            visible(module, name);
        if (status != kOk) return status;
        if (found_.data == nullptr)
            return refuse("there is no such data object that can be reached from here");
        std::string error;
        out = partOf(found_, object_.substr(end), error);
        return error.empty() ? kOk : refuse(error);
    }

    Status refuse(std::string_view why) const {
        return fail(core_, err::ERR_SYM_ACCESS, fmt::format("\"{}\": {}", object_, why));
    }

  private:
    int32_t ownTask() const { return static_cast<int32_t>(task_.index()); }
    void take(const GlobalDesc* global) {
        if (global != nullptr) found_ = dataOf(*global);
    }
    void ofRoutine(std::string_view name) {
        for (const DebugVariable& variable : routineData(task_, false))
            if (found_.data == nullptr && sameName(variable.name, name)) found_ = variable;
    }

    void visible(std::string_view module, std::string_view name) {
        const ProgramTables& tables = task_.controller().tables();
        const std::string_view own = core_->frame != nullptr ? core_->frame->routine->module : "";
        if (module.empty()) ofRoutine(name);
        if (found_.data == nullptr && (module.empty() || sameName(module, own)))
            take(tables.findGlobal(name, own, ownTask(), true));
        if (found_.data != nullptr) return;
        const GlobalDesc* global = tables.findGlobal(name, module, ownTask(), false);
        if (global != nullptr && (global->flags & kDataLocal) == 0) take(global);
    }

    Status inBlock(Handle block, std::string_view name) {
        const DataPosition* position = task_.controller().service<DataPositions>().find(block);
        if (position == nullptr)
            return refuse("the datapos variable holds no position; it gets one from GetNextSym");
        if (position->routine.empty()) {
            take(task_.controller().tables().findGlobal(name, position->module, position->task, true));
            return kOk;
        }
        const Frame* frame = core_->frame;
        if (frame == nullptr || !sameName(frame->routine->name, position->routine) ||
            !sameName(frame->routine->module, position->module))
            return refuse(fmt::format("it belongs to routine {}, which is not the one that executes",
                                      position->routine));
        ofRoutine(name);
        return kOk;
    }

    Status inTask(const Handle* taskRef, const String* taskName, std::string_view module,
                  std::string_view name) {
        Status status = kOk;
        const Task* other = taskAsked(core_, taskRef, taskName, status);
        if (other == nullptr) return status;
        const GlobalDesc* global =
            task_.controller().tables().findGlobal(name, module, static_cast<int32_t>(other->index()), false);
        if (global != nullptr && (global->flags & kDataLocal) == 0) take(global);
        return kOk;
    }

    TaskCore* core_;
    Task& task_;
    std::string_view object_;
    DebugVariable found_;
};

} // namespace
} // namespace rt::lib

using namespace rt;

namespace {

/// A signal variable gets the configured signal of that name, which is not a data object.
bool readSignal(TaskCore* task, const String& name, void* value, const TypeDesc& type) {
    const std::string_view kind(type.baseName);
    if (type.kind != DescKind::Handle || !kind.starts_with("signal")) return false;
    const IoSystem& io = taskOf(task).controller().io();
    const SignalId id = io.find(name.view());
    if (id < 0 || !sameName(kind.substr(6), signalTypeName(io.config(id).type))) return false;
    const Handle handle = IoSystem::handleOf(id);
    std::memcpy(value, &handle, sizeof handle);
    return true;
}

} // namespace

extern "C" {

Status rt_GetDataVal(TaskCore* task, const String* Object, Handle* Block, Handle* TaskRef,
                     const String* TaskName, void* Value, const TypeDesc* ValueType) {
    if (readSignal(task, *Object, Value, *ValueType)) return kOk;
    DebugVariable object;
    const Status status = lib::Lookup(task, *Object).find(Block, TaskRef, TaskName, object);
    return status != kOk ? status : lib::copyData(task, object, Value, *ValueType, false);
}

Status rt_SetDataVal(TaskCore* task, const String* Object, Handle* Block, Handle* TaskRef,
                     const String* TaskName, const void* Value, const TypeDesc* ValueType) {
    DebugVariable object;
    lib::Lookup lookup(task, *Object);
    const Status status = lookup.find(Block, TaskRef, TaskName, object);
    if (status != kOk) return status;
    if (const std::string why = lib::writeProtection(object); !why.empty()) return lookup.refuse(why);
    return lib::copyData(task, object, const_cast<void*>(Value), *ValueType, true);
}
}
