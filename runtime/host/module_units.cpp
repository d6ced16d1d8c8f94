#include "runtime/host/module_units.h"

#include "runtime/base/text_util.h"
#include "runtime/host/controller.h"

#include <fmt/format.h>

#include <map>

namespace rt {

ModuleUnits& units(Controller& controller) {
    return controller.service<ModuleUnits>();
}

void setModuleLoader(Controller& controller, ModuleLoader* loader) {
    units(controller).loader = loader;
}

namespace {
void memoryChanged(Controller& controller) {
    if (ModuleLoader* loader = units(controller).loader; loader != nullptr)
        loader->memoryChanged(controller.tables());
    controller.debugger().memoryChanged();
}

std::string nameOf(const RoutineEntry& trap) {
    return fmt::format("{}:{}", trap.module, trap.name);
}

/// Interrupts whose trap routine is in the module have none until a module with it comes.
void forgetTraps(Controller& controller, const Task& owner, const std::string& module) {
    std::map<EntryFunction, const RoutineEntry*> leaving;
    for (const RoutineEntry* entry : controller.tables().routines())
        if (entry->kind == kRoutineTrap && entry->task == static_cast<int32_t>(owner.index()) &&
            sameName(entry->module, module))
            leaving[reinterpret_cast<EntryFunction>(entry->address)] = entry;
    if (leaving.empty()) return;
    controller.tasks()[owner.index()]->interrupts().forEachTrap([&leaving](Trap& trap) {
        const auto found = trap.function == nullptr ? leaving.end() : leaving.find(trap.function);
        if (found != leaving.end()) trap = {nullptr, nullptr, nameOf(*found->second)};
    });
}

void findTraps(Controller& controller, Task& owner) {
    owner.interrupts().forEachTrap([&](Trap& trap) {
        const std::size_t colon = trap.absent.find(':');
        if (colon == std::string::npos) return;
        const RoutineEntry* entry =
            controller.findRoutine(trap.absent.substr(colon + 1), trap.absent.substr(0, colon), owner);
        if (entry != nullptr && entry->kind == kRoutineTrap && entry->address != nullptr)
            trap = {reinterpret_cast<EntryFunction>(entry->address), nullptr, {}};
    });
}

} // namespace

void addModule(Controller& controller, const ProgramDesc& unit, LoadedModule module) {
    const auto task = static_cast<std::size_t>(module.task);
    controller.tables().addUnit(unit, std::move(module));
    if (task < controller.tasks().size()) findTraps(controller, *controller.tasks()[task]);
    memoryChanged(controller);
}

void removeModule(Controller& controller, int32_t task, const std::string& module) {
    const auto index = static_cast<std::size_t>(task);
    if (index < controller.tasks().size()) forgetTraps(controller, *controller.tasks()[index], module);
    controller.tables().remove(task, module);
    memoryChanged(controller);
}

bool connectUnit(Controller& controller, const ProgramDesc& unit) {
    bool all = true;
    for (uint32_t i = 0; i < unit.externalCount; ++i)
        all = connectExternal(controller, unit.externals[i]) && all;
    return all;
}

/// Some task executes a routine of the module.
bool executes(const Controller& controller, const LoadedModule& module) {
    for (const auto& task : controller.tasks()) {
        if (module.task >= 0 && static_cast<int32_t>(task->index()) != module.task) continue;
        for (const Frame* at = task->frame; at != nullptr; at = at->caller)
            if (at->routine != nullptr && sameName(at->routine->module, module.name)) return true;
    }
    return false;
}

std::vector<std::string> persistentsOf(const ProgramDesc& unit) {
    std::vector<std::string> values;
    for (uint32_t i = 0; i < unit.globalCount; ++i)
        if (const GlobalDesc& data = unit.globals[i];
            data.kind == kGlobalPersistent && (data.flags & kDataPredefined) == 0)
            values.emplace_back(static_cast<const char*>(data.address), data.type->size);
    return values;
}

LoadResult linkUnit(Controller& controller, ModuleLoader& loader, const LoadRequest& request, bool dynamic,
                    int64_t fileTime) {
    LoadResult result = loader.make(request, controller.tables());
    if (result.verdict != LoadResult::Verdict::Made) return result;
    if (!connectUnit(controller, *result.unit)) {
        result.verdict = LoadResult::Verdict::Wrong;
        result.problems = "it names a signal or unit that is not configured";
        return result;
    }
    LoadedModule module;
    module.name = result.module;
    module.task = request.taskIndex;
    module.file = request.path;
    module.dynamic = dynamic;
    module.fileTime = fileTime;
    units(controller).declared[result.unit] = persistentsOf(*result.unit);
    addModule(controller, *result.unit, std::move(module));
    return result;
}

Status Controller::resetUnits(Task& task) {
    const auto index = static_cast<int32_t>(task.index());
    std::vector<std::string> gone;
    Status status = kOk;
    for (const LoadedModule& module : tables_.modules()) {
        if (module.unit == nullptr || module.task != index) continue;
        if (module.dynamic)
            gone.push_back(module.name);
        else if (status == kOk && module.unit->reset != nullptr)
            status = module.unit->reset(&task, nullptr);
    }
    for (const std::string& name : gone)
        removeModule(*this, index, name);
    return status;
}

} // namespace rt
