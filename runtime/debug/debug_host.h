#pragma once
// DebugHost: what the debugger and the way back into a program (Reentry) ask of the controller they belong to.

#include "runtime/debug/stepped_arm.h"
#include "runtime/program/program_tables.h"
#include "runtime/sched/task.h"

#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace rt {

struct StateKeepers;

/// The controller, as runtime/debug sees it.
class DebugHost : public TaskHost {
  public:
    /// The modules that were compiled or linked in.
    virtual const ProgramDesc& program() const = 0;
    /// Everything in program memory, modules loaded at run time included.
    virtual const ProgramTables& tables() const = 0;
    /// In the order of ProgramDesc::tasks.
    virtual const std::vector<std::unique_ptr<Task>>& tasks() const = 0;
    /// Module data visible in the task: its own, then shared; `module` may be empty. Null when there is none.
    virtual const GlobalDesc* findGlobal(std::string_view name, std::string_view module,
                                         const Task& task) const = 0;
    /// Routine for late binding; `module` may be empty.
    virtual const RoutineEntry* findRoutine(std::string_view name, std::string_view module,
                                            const Task& task) const = 0;
    /// A deselected task is not started.
    virtual bool isTaskActive(const Task& task) const = 0;
    /// The arm that the task moves. Present as soon as the program can run.
    virtual SteppedArm& arm(const Task& task) = 0;
    virtual void forEachArm(const std::function<void(SteppedArm&)>& action) = 0;
    /// The keepers of the objects that variables name by handles.
    virtual const StateKeepers& stateKeepers() = 0;
    /// Program pointer to main in all NORMAL tasks; refused with an event unless the program is stopped.
    virtual void actionPpToMain() = 0;
    /// The stopped task is about to execute continuously: START at main, else RESTART becomes due.
    virtual void orderStartEvent(Task& task) = 0;

  protected:
    ~DebugHost() = default;
};

} // namespace rt
