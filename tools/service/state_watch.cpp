#include "tools/service/state_watch.h"

#include "tools/service/virtual_controller.h"

#include <algorithm>
#include <utility>

namespace rapidc::service {

/// True when the state of execution of the task has changed. The program pointer of an executing task is looked at when
/// `often` is false only.
bool StateWatch::lookAt(const rt::Task& task, bool often) {
    const auto found = tasks_.find(&task);
    const bool isNew = found == tasks_.end();
    Seen& seen = isNew ? tasks_[&task] : found->second;
    const bool executes = task.isExecuting();
    const bool changed = isNew || seen.cause != task.stopCause() ||
                         (seen.state == rt::TaskState::Finished) != (task.state() == rt::TaskState::Finished);
    seen.cause = task.stopCause();
    seen.state = task.state();
    if (!changed && executes && often) return false;
    const rt::RoutineDesc* const routine = task.frame == nullptr ? nullptr : task.frame->routine;
    const int32_t statement = task.frame == nullptr ? -1 : task.frame->statement;
    if (changed || seen.entry != task.nextEntry() || seen.frame != task.frame || seen.routine != routine ||
        seen.statement != statement) {
        seen.entry = task.nextEntry();
        seen.frame = task.frame;
        seen.routine = routine;
        seen.statement = statement;
        controller_.observers().changed(Change::ProgramPointer, &task);
    }
    if (task.isMotionTask()) {
        const auto& pointer = controller_.core().motion(task).pointer();
        const int32_t move = pointer.valid ? pointer.statement : -1;
        if (std::exchange(seen.move, move) != move || isNew)
            controller_.observers().changed(Change::MotionPointer, &task);
    }
    return changed;
}

void StateWatch::lookAtDialogs() {
    const rt::OperatorPanel& panel = controller_.core().panel();
    const auto open = panel.openDialogs();
    const bool message = panel.message().has_value();
    const bool same = message == message_ && open.size() == dialogs_.size() &&
                      std::equal(open.begin(), open.end(), dialogs_.begin(),
                                 [](const auto& dialog, uint64_t number) { return dialog.number == number; });
    if (same) return;
    message_ = message;
    dialogs_.clear();
    for (const auto& dialog : open)
        dialogs_.push_back(dialog.number);
    controller_.observers().changed(Change::Dialog);
}

void StateWatch::look() {
    constexpr std::chrono::milliseconds kPeriod{100};
    const auto now = std::chrono::steady_clock::now();
    const bool often = now - pointers_ < kPeriod;
    if (!often) pointers_ = now;
    bool changed = false;
    for (const auto& task : controller_.core().tasks())
        changed = lookAt(*task, often) || changed;
    if (changed) controller_.observers().changed(Change::Tasks);
    if (const bool running = controller_.isRunning(); std::exchange(running_, running) != running)
        controller_.observers().changed(Change::Execution);
    if (const MotorState motors = controller_.panel().motors; std::exchange(motors_, motors) != motors)
        controller_.observers().changed(Change::MotorState);
    lookAtDialogs();
}

} // namespace rapidc::service
