#pragma once
// Modules that come and go while a program runs: who compiles them, and what the controller does with them.

#include "runtime/host/module_loader.h"
#include "runtime/program/program_tables.h"
#include "runtime/sched/task.h"

#include <map>
#include <string>
#include <vector>

namespace rt {

class Controller;

/// Bytes of the largest module file: the program memory of a controller takes some 20 MB of source.
inline constexpr std::size_t kLargestModule = std::size_t{20} << 20;

struct ModuleUnits {
    ModuleLoader* loader = nullptr; ///< null: none has been needed yet
    /// Bytes that the persistents of a unit had when it was loaded.
    std::map<const ProgramDesc*, std::vector<std::string>> declared;
};

ModuleUnits& units(Controller& controller);
/// The loader must outlive the controller.
void setModuleLoader(Controller& controller, ModuleLoader* loader);
/// Gives a signal or unit that a program names its handle; false, with a message on stderr, when it is not configured.
bool connectExternal(Controller& controller, const ExternalDesc& external);
/// Brings a unit into memory, takes a module out of it: its name, and what others have bound to its data.
void addModule(Controller& controller, const ProgramDesc& unit, LoadedModule module);
void removeModule(Controller& controller, int32_t task, const std::string& module);
/// All those of a unit.
bool connectUnit(Controller& controller, const ProgramDesc& unit);
/// Compiles a module and brings it into memory. When it is refused (any verdict but Made), nothing has changed.
LoadResult linkUnit(Controller& controller, ModuleLoader& loader, const LoadRequest& request, bool dynamic,
                    int64_t fileTime);
/// The values of the persistents of a unit, as bytes.
std::vector<std::string> persistentsOf(const ProgramDesc& unit);
/// Some task executes a routine of the module.
bool executes(const Controller& controller, const LoadedModule& module);

} // namespace rt
