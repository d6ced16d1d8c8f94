#pragma once
// Decides, before every statement of the stepping profile, whether a task continues (runtime/debug).

#include "runtime/abi/rt_abi.h"

namespace rt {

class Task;

class StepHook {
  public:
    /// Called on the task's fibre with at->statement about to be executed. May stop the task. Returns the number of
    /// the statement of `at` to execute next, or a negative status.
    virtual int32_t beforeStatement(Task& task, Frame* at) = 0;
    /// An error in a statement that is executed backwards cannot be handled (manual 1.21).
    virtual bool isBackward(const Task& task) const = 0;
    /// Called on the task's fibre when an error has been raised and a handler will take it, before anything is unwound. May
    /// stop the task; a negative status unwinds it.
    virtual Status handledErrorRaised(Task&, int) { return kOk; }
    /// A movement that the task executes backwards has no \ID, or a different one than those of the other tasks. True: the step is
    /// over, and the task is to return kAgain; its program pointer stays.
    virtual bool refuseBackward(Task&) { return false; }
    /// An error while this hook leads a task back to where an earlier process stood (Task::reenter). A negative status.
    virtual Status failed(Task&) { return kUnwind; }

  protected:
    ~StepHook() = default;
};

} // namespace rt
