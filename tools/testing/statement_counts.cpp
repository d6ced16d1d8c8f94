#include "tools/testing/statement_counts.h"

namespace testing {
namespace {
constexpr int32_t kAsksForCounts = 8; // beside what a debugger asks
}

void StatementCounts::attach(rt::Controller& controller) {
    inner_ = controller.tasks().front()->stepHook();
    for (const auto& task : controller.tasks()) {
        task->setStepHook(this);
        task->askSteps += kAsksForCounts;
    }
}

int32_t StatementCounts::beforeStatement(rt::Task& task, rt::Frame* at) {
    if (at->routine != last_) {
        last_ = at->routine;
        row_ = &counts_[last_];
        if (row_->empty()) row_->resize(last_->statementCount);
    }
    if (const auto index = static_cast<std::size_t>(at->statement); index < row_->size()) ++(*row_)[index];
    return inner_->beforeStatement(task, at);
}

std::map<std::pair<uint32_t, uint32_t>, uint64_t>
StatementCounts::executed(const rt::ProgramDesc& program) const {
    std::map<std::pair<uint32_t, uint32_t>, uint64_t> result;
    for (uint32_t i = 0; i < program.routineCount; ++i) {
        const auto found = counts_.find(program.routines[i].desc);
        if (found == counts_.end()) continue;
        for (uint32_t s = 0; s < found->second.size(); ++s)
            if (found->second[s] > 0) result[{i, s}] = found->second[s];
    }
    return result;
}

} // namespace testing
