// MotionDriver: path levels (manual 1.8: StorePath, RestoPath).

#include "runtime/host/motion_driver.h"
#include "runtime/sched/task.h"

#include <utility>

namespace rt {

Status MotionDriver::storePath(Task& task, bool keepSync) {
    levelHold_ = !system().isIdle();
    applyStops();
    const Status status = waitZeroSpeed(task);
    levelHold_ = false;
    const auto place = status == kOk ? placeLeft() : std::nullopt;
    if (status != kOk || !system().storePath()) {
        applyStops();
        return status;
    }
    levels_.push_back({std::exchange(stopMove_, {}), std::exchange(interrupted_, {}), system_.currentJoints(),
                       isSuspended_, place});
    if (synchronised_ != nullptr && !keepSync) isSuspended_ = true;
    applyStops();
    return kOk;
}

Status MotionDriver::restorePath(Task& task) {
    const auto isOver = [this] { return !system().isMoving() && (stopMove_.isSet() || system().isIdle()); };
    WaitResult result{};
    if (const Status status = task.waitFor({{&changed_}, isOver}, result); status != kOk) return status;
    clearLevel();
    if (!system().restorePath()) return kOk;
    const StoredLevel level = levels_.back();
    levels_.pop_back();
    stopMove_ = level.stopMove;
    interrupted_ = level.interrupted;
    isSuspended_ = level.wasSuspended;
    levelHold_ = !system_.isIdle();
    applyStops();
    return kOk;
}

void MotionDriver::noteRetry() {
    if (std::exchange(levelHold_, false)) applyStops();
}

bool MotionDriver::pathInterrupted(int level) {
    if (brokenPath_ != 0 && system().isDone(brokenPath_)) brokenPath_ = 0;
    return brokenPath_ != 0 && brokenLevel_ == level;
}

} // namespace rt
