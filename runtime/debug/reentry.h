#pragma once
// Reentry: leads a task back to where an earlier process stood (--state; manual 1.2.2, column "Power on"). Each routine of
// the saved chain is entered by executing the statement that called it, its data get the values they had, and the
// innermost one continues with its statement. The step hook of the task meanwhile (Task::reenter).

#include "runtime/debug/call_chain.h"
#include "runtime/debug/debug_host.h"
#include "runtime/sched/step_hook.h"

namespace rt {

class Reentry final : public StepHook {
  public:
    /// `data` must outlive it. The task is to be given to begin().
    /// `place`: where the task stood, for people.
    Reentry(DebugHost& host, CallChain chain, std::string place, const DataIndex& data)
        : host_(host), chain_(std::move(chain)), place_(std::move(place)), data_(data) {}

    /// "" or why the chain does not fit the program. Then nothing has changed.
    std::string begin(Task& task);

    int32_t beforeStatement(Task& task, Frame* at) override;
    bool isBackward(const Task&) const override { return false; }
    Status failed(Task& task) override;

  private:
    std::string entered(Task& task, Frame* at);
    std::string restoreLocal(const SteppingFrame& frame, uint32_t index, const SavedLocal& saved,
                             const Task& task);
    Status giveUp(Task& task, const std::string& why);
    const RoutineEntry* find(const SavedFrame& frame, const Task& task) const;

    DebugHost& host_;
    CallChain chain_;
    std::string place_;
    const DataIndex& data_;
    std::size_t depth_ = 0;    ///< routines entered
    Frame* current_ = nullptr; ///< the innermost of them
    bool jumped_ = false;      ///< it has been sent to its statement, whose own question comes next
    bool reached_ = false;     ///< and is there
};

} // namespace rt
