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
