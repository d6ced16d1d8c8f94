#pragma once
// StatementCounts: how often the statements of a program of the stepping profile are executed.

#include "runtime/host/controller.h"
#include "runtime/sched/step_hook.h"

#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace testing {

/// Asked before every statement, in front of the debugger.
class StatementCounts final : public rt::StepHook {
  public:
    void attach(rt::Controller& controller);
    int32_t beforeStatement(rt::Task& task, rt::Frame* at) override;
    bool isBackward(const rt::Task& task) const override { return inner_->isBackward(task); }
    rt::Status failed(rt::Task& task) override { return inner_->failed(task); }

    /// By the number of the routine in the program and that of the statement; those that were executed.
    std::map<std::pair<uint32_t, uint32_t>, uint64_t> executed(const rt::ProgramDesc& program) const;

  private:
    rt::StepHook* inner_ = nullptr;
    std::unordered_map<const rt::RoutineDesc*, std::vector<uint64_t>> counts_;
    const rt::RoutineDesc* last_ = nullptr; // and its row: most statements follow one of the same routine
    std::vector<uint64_t>* row_ = nullptr;
};

} // namespace testing
