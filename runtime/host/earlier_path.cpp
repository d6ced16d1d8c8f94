// MotionDriver: what remains of the path, between two processes (--state).

#include "runtime/host/motion_driver.h"
#include "runtime/motion/path.h"

#include <utility>

namespace rt {

MotionDriver::EarlierPath MotionDriver::remainingPath() {
    const motion::MotionSystem& arm = system();
    EarlierPath path;
    for (const StoredLevel& level : levels_)
        path.stored.push_back({{}, {}, level.left, level.stopMove, level.wasSuspended});
    bool first = true;
    for (const UnfinishedMove& move : ordered_) {
        if (arm.isDone(move.id)) continue;
        if (move.level < pathLevel()) {
            EarlierLevel& level = path.stored[static_cast<std::size_t>(move.level - 1)];
            if (level.moves.empty() && arm.isStarted(move.id)) level.begun = move.start;
            level.moves.push_back(move.command);
            continue;
        }
        if (std::exchange(first, false) && arm.isStarted(move.id)) path.begun = move.start;
        if (move.id == awaited_)
            path.awaited = move.command;
        else
            path.moves.push_back(move.command);
    }
    if (!path.awaited && earlier_.awaited) path.awaited = earlier_.awaited; // not ordered again yet
    if (first) path.begun = earlier_.begun;
    path.stopMove = stopMove_;
    path.levelHold = levelHold_;
    path.isSuspended = isSuspended_;
    return path;
}

void MotionDriver::orderEarlier(const std::vector<motion::MoveCommand>& moves) {
    for (motion::MoveCommand command : moves) {
        continueEarlier(command);
        command.tag = ++instructions_;
        const motion::Pose start = startOf(command);
        if (const auto id = system_.enqueue(command)) enqueued(*id, command, start, nullptr);
    }
}

/// Its path begins where the arm left it; the arm itself stays where it is.
void MotionDriver::storeEarlier(const EarlierLevel& level) {
    const motion::JointTarget here = system_.currentJoints();
    system_.placeAt(level.left);
    system_.stop();
    earlier_ = {};
    earlier_.begun = level.begun;
    orderEarlier(level.moves);
    system_.storePath();
    system_.placeAt(here);
    levels_.push_back({level.stopMove, {}, level.left, level.isSuspended});
}

void MotionDriver::continuePath(const EarlierPath& path) {
    for (const EarlierLevel& level : path.stored)
        storeEarlier(level);
    earlier_ = path;
    earlier_.awaited.reset();
    orderEarlier(path.moves);
    holdEarlier(path);
}

void MotionDriver::holdEarlier(const EarlierPath& path) {
    earlier_.awaited = path.awaited;
    stopMove_ = path.stopMove;
    levelHold_ = path.levelHold;
    isSuspended_ = path.isSuspended && synchronised_ != nullptr;
    applyStops();
}

void MotionDriver::continueEarlier(motion::MoveCommand& command) {
    if (const auto awaited = std::exchange(earlier_.awaited, {})) {
        auto triggers = std::move(command.triggers);
        const uint64_t tag = command.tag;
        command = *awaited;
        command.triggers = std::move(triggers);
        command.tag = tag;
    }
    const auto begun = std::exchange(earlier_.begun, {});
    if (begun && command.kind == motion::MoveKind::Circular)
        command = motion::restOfCircle(command, *begun, system_.currentTarget(command.frames).pose);
}

} // namespace rt
