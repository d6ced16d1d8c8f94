#include "runtime/program/program_tables.h"

#include "runtime/base/text_util.h"

#include <algorithm>
#include <sys/stat.h>

namespace rt {
namespace {

std::string folded(std::string_view name) {
    std::string out(name);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return out;
}

bool seenBy(int32_t owner, int32_t task) {
    return owner < 0 || owner == task;
}

int64_t timeOf(const std::string& file) {
    struct stat status{};
    return ::stat(file.c_str(), &status) == 0 ? static_cast<int64_t>(status.st_mtime) : -1;
}

} // namespace

void ProgramTables::setProgram(const ProgramDesc& program) {
    for (uint32_t i = 0; i < program.moduleCount; ++i) {
        const ModuleDesc& desc = program.modules[i];
        LoadedModule module;
        module.name = desc.name;
        module.task = desc.task;
        if (desc.file != nullptr) module.file = desc.file;
        module.fileTime = timeOf(module.file);
        module.gone = desc.gone;
        modules_.push_back(std::move(module));
    }
    take(program);
}

void ProgramTables::addUnit(const ProgramDesc& unit, LoadedModule module) {
    module.unit = &unit;
    modules_.push_back(std::move(module));
    take(unit);
}

void ProgramTables::take(const ProgramDesc& unit) {
    // Data of the language in a unit stay when its module leaves memory: others may refer to them.
    const bool isNew = taken_.insert(&unit).second;
    for (uint32_t i = 0; i < unit.globalCount; ++i)
        if (isNew || (unit.globals[i].flags & kDataPredefined) == 0) globals_.push_back(&unit.globals[i]);
    for (uint32_t i = 0; i < unit.aliasCount; ++i)
        globals_.push_back(&unit.aliases[i]);
    for (uint32_t i = 0; i < unit.routineCount; ++i)
        routines_.push_back(&unit.routines[i]);
    for (uint32_t i = 0; i < unit.routineDataCount; ++i)
        routineData_.push_back(&unit.routineData[i]);
    for (uint32_t i = 0; i < unit.typeCount; ++i)
        types_.push_back(unit.types[i]);
    index();
}

void ProgramTables::index() {
    calls_.clear();
    globalByName_.clear();
    routineByName_.clear();
    for (const GlobalDesc* global : globals_)
        globalByName_.emplace(folded(global->name), global);
    for (const RoutineEntry* routine : routines_)
        routineByName_.emplace(folded(routine->name), routine);
}

bool ProgramTables::remove(int32_t task, std::string_view module) {
    const auto found = std::find_if(modules_.begin(), modules_.end(), [&](const LoadedModule& m) {
        return m.task == task && sameName(m.name, module);
    });
    if (found == modules_.end()) return false;
    if (const ProgramDesc* unit = found->unit; unit != nullptr) {
        // All it brought, persistents as well: those that others declare are in their tables, too.
        const auto within = [](const auto* entry, const auto* first, uint32_t count) {
            return entry >= first && entry < first + count;
        };
        std::erase_if(globals_, [&](const GlobalDesc* entry) {
            return (entry->flags & kDataPredefined) == 0 && within(entry, unit->globals, unit->globalCount);
        });
        std::erase_if(routines_, [&](const RoutineEntry* entry) {
            return within(entry, unit->routines, unit->routineCount);
        });
        std::erase_if(routineData_, [&](const RoutineDataDesc* entry) {
            return within(entry, unit->routineData, unit->routineDataCount);
        });
        const std::unordered_set<const TypeDesc*> types(unit->types, unit->types + unit->typeCount);
        std::erase_if(types_, [&](const TypeDesc* type) { return types.contains(type); });
    } else {
        if (found->gone != nullptr) *found->gone = 1;
        const auto inModule = [&](const auto* entry) {
            return entry->task == task && sameName(entry->module, module);
        };
        std::erase_if(globals_, inModule);
        std::erase_if(routines_, inModule);
        std::erase_if(routineData_, inModule);
    }
    modules_.erase(found);
    index();
    return true;
}

bool ProgramTables::isDeclaredIn(const GlobalDesc& data, int32_t task) const {
    if (data.task >= 0) return data.task == task;
    if ((data.flags & kDataPredefined) != 0) return true;
    // A shared object: the row has module and file of the first declaration, not its task.
    const LoadedModule* module = findModule(task, data.module);
    if (module == nullptr) return false;
    // Units name their file otherwise; no other module of the task has that name.
    return module->unit != nullptr || data.file == nullptr || module->file.empty() ||
           module->file == data.file;
}

const LoadedModule* ProgramTables::findModule(int32_t task, std::string_view name) const {
    for (const LoadedModule& module : modules_)
        if (module.task == task && sameName(module.name, name)) return &module;
    return nullptr;
}

const LoadedModule* ProgramTables::findFile(int32_t task, const std::string& hostPath) const {
    for (const LoadedModule& module : modules_)
        if (module.task == task && module.unit != nullptr && module.file == hostPath) return &module;
    return nullptr;
}

const GlobalDesc* ProgramTables::findGlobal(std::string_view name, std::string_view module, int32_t task,
                                            bool withLocal) const {
    const GlobalDesc* best = nullptr;
    const auto rank = [](const GlobalDesc& global) {
        return ((global.flags & kDataPredefined) != 0 ? 2 : 0) + (global.task < 0 ? 1 : 0);
    };
    const auto [first, last] = globalByName_.equal_range(folded(name));
    for (auto it = first; it != last; ++it) {
        const GlobalDesc& global = *it->second;
        if (!seenBy(global.task, task) || (!module.empty() && !sameName(global.module, module))) continue;
        if (module.empty() && !withLocal && (global.flags & kDataLocal) != 0) continue;
        if (best == nullptr || rank(global) < rank(*best)) best = &global;
    }
    return best;
}

const RoutineEntry* ProgramTables::findRoutine(std::string_view name, std::string_view module,
                                               std::string_view from, int32_t task) const {
    const RoutineEntry* best = nullptr;
    const auto [first, last] = routineByName_.equal_range(folded(name));
    for (auto it = first; it != last; ++it) {
        const RoutineEntry& routine = *it->second;
        if (!seenBy(routine.task, task) || (!module.empty() && !sameName(routine.module, module))) continue;
        const bool own = sameName(routine.module, from);
        if (routine.isLocal != 0 && !own && !from.empty()) continue;
        if (own) return &routine;
        if (best == nullptr) best = &routine;
    }
    return best;
}

} // namespace rt
