#pragma once
// ProgramTables: what the modules in program memory declare, by name: those the program was compiled with and those
// loaded while it runs. Names are compared without regard to case.

#include "runtime/abi/rt_abi.h"
#include "runtime/program/call_cache.h"

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace rt {

/// A module of a task in program memory.
struct LoadedModule {
    std::string name;
    int32_t task = -1;
    std::string file;                  ///< on the host; "" when it is not known
    const ProgramDesc* unit = nullptr; ///< loaded while the program runs: what it consists of
    bool dynamic = false;              ///< leaves memory when the program pointer is moved to main
    int64_t fileTime =
        -1; ///< when its file was modified last before loading; seconds since 1970, -1: unknown
    int32_t* gone = nullptr; ///< compiled code wants to know when it leaves memory
};

class ProgramTables {
  public:
    /// The program itself, once; `program` stays valid for the life of the tables.
    void setProgram(const ProgramDesc& program);
    /// A unit loaded at run time: its module, and what it declares. `unit` stays valid for the life of the tables.
    void addUnit(const ProgramDesc& unit, LoadedModule module);
    /// Takes a module and all it declares out. False when the task has none of this name.
    bool remove(int32_t task, std::string_view module);

    const std::deque<LoadedModule>& modules() const { return modules_; }
    const LoadedModule* findModule(int32_t task, std::string_view name) const;
    /// The module loaded from a file, null when there is none.
    const LoadedModule* findFile(int32_t task, const std::string& hostPath) const;

    /// Module data by their declarations: a persistent that modules share has a row for each of them.
    const std::vector<const GlobalDesc*>& globals() const { return globals_; }
    /// Does the row stand for a declaration in a module of the task? Of shared persistents only one row is the task's
    /// own, the others belong to other tasks' modules.
    bool isDeclaredIn(const GlobalDesc& data, int32_t task) const;
    const std::vector<const RoutineEntry*>& routines() const { return routines_; }
    const std::vector<const RoutineDataDesc*>& routineData() const { return routineData_; }
    const std::vector<const TypeDesc*>& types() const { return types_; }

    /// Module data that `task` sees: its own before shared ones. `module` may be empty; then `withLocal` says whether
    /// LOCAL data of any module count. Null when there is none.
    const GlobalDesc* findGlobal(std::string_view name, std::string_view module, int32_t task,
                                 bool withLocal) const;
    /// A routine; `module` may be empty: then a LOCAL one counts only for its own module `from`, and comes first.
    const RoutineEntry* findRoutine(std::string_view name, std::string_view module, std::string_view from,
                                    int32_t task) const;
    /// The routines that names in calls meant with the present modules; empty after each change.
    CallCache& calls() { return calls_; }

  private:
    void take(const ProgramDesc& unit);
    void index();
    std::deque<LoadedModule> modules_; // addresses stay
    std::vector<const GlobalDesc*> globals_;
    std::vector<const RoutineEntry*> routines_;
    std::vector<const RoutineDataDesc*> routineData_;
    std::vector<const TypeDesc*> types_;
    std::unordered_set<const ProgramDesc*> taken_; ///< the program, and units that are or were in memory
    std::unordered_multimap<std::string, const GlobalDesc*> globalByName_;
    std::unordered_multimap<std::string, const RoutineEntry*> routineByName_;
    CallCache calls_;
};

} // namespace rt
