#include "lint_testing.h"

#include "unit/sema/sema_testing.h"

namespace rapid::lint::testing {

namespace {

std::unique_ptr<sema::testing::Checked> judged(const std::vector<std::vector<std::string>>& tasks,
                                               const WarningLevels& levels) {
    auto checked = sema::testing::checkTasks(tasks);
    for (const auto& task : checked->program->tasks)
        for (const sema::Module* module : task->modules)
            checkDirectives(module->tree->source, checked->sink);
    lint(*checked->program, levels, checked->sink);
    applyLevels(levels, checked->sink);
    return checked;
}

} // namespace

std::vector<std::string> messages(const std::vector<std::string>& texts, const WarningLevels& levels) {
    return judged({texts}, levels)->messages();
}

std::vector<std::string> codes(const std::vector<std::string>& texts, const WarningLevels& levels) {
    return judged({texts}, levels)->codes();
}

std::vector<std::string> codesOfTasks(const std::vector<std::vector<std::string>>& tasks) {
    return judged(tasks, {})->codes();
}

} // namespace rapid::lint::testing
