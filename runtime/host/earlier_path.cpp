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
    path.corner = earlier_.corner ? earlier_.corner : cornerLeft();
    return path;
}

/// The curve that the arm is on. Robots that move together continue straight to the next point.
std::optional<MotionDriver::EarlierCorner> MotionDriver::cornerLeft() {
    if (synchronised_ != nullptr) return {};
    const auto place = system().cornerPlace();
    if (!place) return {};
    for (const UnfinishedMove& move : ordered_)
        if (move.id == place->move)
            return EarlierCorner{move.command, system_.isDone(move.id), place->from, place->covered};
    return {};
}

void MotionDriver::orderEarlier(const std::vector<motion::MoveCommand>& moves) {
    for (motion::MoveCommand command : moves) {
        continueEarlier(command);
        command.tag = ++instructions_;
        const motion::Pose start = startOf(command);
        if (const auto id = system_.enqueue(command))
            enqueued(*id, command, start, system_.plannedEnd(), nullptr);
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
    orderEarlier(orderEarlierCorner(path));
    holdEarlier(path);
}

/// Orders the moves that meet in the corner which the arm is on. The moves that are left to be ordered: none while the second
/// one of the corner is that of the instruction which the program executes again.
std::vector<motion::MoveCommand> MotionDriver::orderEarlierCorner(const EarlierPath& path) {
    if (!path.corner) return path.moves;
    const std::size_t second = path.corner->isPassed ? 0 : 1;
    if (path.moves.size() <= second) {
        if (path.awaited) return {};
        earlier_.corner.reset();
        return path.moves;
    }
    motion::MoveCommand command = path.moves[second];
    Beginning beginning;
    const auto id = orderInCorner(command, beginning);
    if (!id) return path.moves;
    noteOrdered(nullptr, command, *id, beginning);
    earlier_.begun.reset();
    return {path.moves.begin() + static_cast<std::ptrdiff_t>(second) + 1, path.moves.end()};
}

/// Orders the move before the corner and this one, which begins on its curve; nothing when there is none left to be taken over.
std::optional<motion::MoveId> MotionDriver::orderInCorner(motion::MoveCommand& command,
                                                          Beginning& beginning) {
    const auto corner = std::exchange(earlier_.corner, {});
    if (!corner) return {};
    motion::MoveCommand before = corner->before;
    before.tag = instructions_ + 1;
    command.tag = instructions_ + 2;
    const auto ordered = system_.enqueueInCorner(corner->from, corner->covered, before, command);
    if (!ordered) { // it is elsewhere: straight to the points that are left
        if (!corner->isPassed) orderEarlier({corner->before});
        command.tag = instructions_ + 1;
        beginning = {startOf(command), system_.plannedEnd()};
        return {};
    }
    ++instructions_;
    const motion::Pose start = system_.toRobTarget(corner->from, before.frames).pose;
    enqueued(ordered->before, before, start, ordered->point, nullptr);
    beginning = {system_.toRobTarget(ordered->point, command.frames).pose, ordered->point};
    return ordered->after;
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
    if (begun && !earlier_.corner && command.kind == motion::MoveKind::Circular)
        command = motion::restOfCircle(command, *begun, system_.currentTarget(command.frames).pose);
}

} // namespace rt
