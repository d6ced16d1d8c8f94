#include "runtime/host/module_units.h"

#include "runtime/host/controller.h"

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
} // namespace

void addModule(Controller& controller, const ProgramDesc& unit, LoadedModule module) {
    controller.tables().addUnit(unit, std::move(module));
    memoryChanged(controller);
}

void removeModule(Controller& controller, int32_t task, const std::string& module) {
    controller.tables().remove(task, module);
    memoryChanged(controller);
}

bool connectUnit(Controller& controller, const ProgramDesc& unit) {
    bool all = true;
    for (uint32_t i = 0; i < unit.externalCount; ++i)
        all = connectExternal(controller, unit.externals[i]) && all;
    return all;
}

Status resetUnits(Controller& controller, Task& task) {
    const auto index = static_cast<int32_t>(task.index());
    std::vector<std::string> gone;
    Status status = kOk;
    for (const LoadedModule& module : controller.tables().modules()) {
        if (module.unit == nullptr || module.task != index) continue;
        if (module.dynamic)
            gone.push_back(module.name);
        else if (status == kOk && module.unit->reset != nullptr)
            status = module.unit->reset(&task, nullptr);
    }
    for (const std::string& name : gone)
        removeModule(controller, index, name);
    return status;
}

} // namespace rt
