// MotionDriver: what remains of the path, between two processes (--state).

#include "runtime/host/motion_driver.h"
#include "runtime/motion/path.h"

#include <utility>

namespace rt {

MotionDriver::EarlierPath MotionDriver::remainingPath() {
    const motion::MotionSystem& arm = system();
    EarlierPath path;
    for (const StoredLevel& level : levels_)
        path.stored.push_back({{}, {}, level.left, level.stopMove, level.wasSuspended, level.place});
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
    path.place = earlier_.place ? earlier_.place : placeLeft();
    return path;
}

std::optional<MotionDriver::EarlierPlace> MotionDriver::placeLeft() {
    const auto place = system().placeUnderWay();
    if (!place) return {};
    for (const UnfinishedMove& move : ordered_) {
        if (move.id != place->move) continue;
        EarlierPlace left{{}, system_.isDone(move.id), place->from, place->covered};
        if (place->isInZone) left.before = move.command;
        return left;
    }
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
    earlier_.place = level.place;
    orderRest(level.moves, false);
    system_.storePath();
    system_.placeAt(here);
    levels_.push_back({level.stopMove, {}, level.left, level.isSuspended, level.place});
}

void MotionDriver::continuePath(const EarlierPath& path) {
    for (const EarlierLevel& level : path.stored)
        storeEarlier(level);
    earlier_ = path;
    earlier_.awaited.reset();
    orderRest(path.moves, path.awaited.has_value());
    holdEarlier(path);
}

/// Orders what is left, the move that the arm has covered a part of first; of a zone both moves. Nothing while that one belongs to
/// the instruction that the program executes again (`hasAwaited`).
void MotionDriver::orderRest(std::vector<motion::MoveCommand> moves, bool hasAwaited) {
    const std::size_t first = earlier_.place && earlier_.place->before && !earlier_.place->isPassed ? 1 : 0;
    if (moves.size() <= first) {
        if (earlier_.place && hasAwaited) return;
        earlier_.place.reset();
    }
    if (earlier_.place) {
        motion::MoveCommand& command = moves[first];
        Beginning beginning;
        const auto id = orderUnderWay(command, beginning);
        if (id) noteOrdered(nullptr, command, *id, beginning);
        moves.erase(moves.begin(), moves.begin() + static_cast<std::ptrdiff_t>(first + (id ? 1 : 0)));
    }
    orderEarlier(moves);
}

/// Nothing when no move is left to be taken over, or when the arm is elsewhere: then the rest is ordered from where it is.
std::optional<motion::MoveId> MotionDriver::orderUnderWay(motion::MoveCommand& command,
                                                          Beginning& beginning) {
    const auto place = std::exchange(earlier_.place, {});
    if (!place) return {};
    std::optional<motion::MoveCommand> before = place->before;
    if (before) before->tag = instructions_ + 1;
    command.tag = instructions_ + (before ? 2 : 1);
    const auto ordered =
        system_.enqueueUnderWay(place->from, place->covered, before ? &*before : nullptr, command);
    if (!ordered) {
        if (before && !place->isPassed)
            orderEarlier({*before});
        else
            continueEarlier(command);
        command.tag = instructions_ + 1;
        beginning = {startOf(command), system_.plannedEnd()};
        return {};
    }
    beginning = takeUnderWay(*place, *ordered, command);
    return ordered->move;
}

/// The arm is on its way again, on `command` or in the zone before it. The result: the beginning of `command`.
MotionDriver::Beginning MotionDriver::takeUnderWay(const EarlierPlace& place,
                                                   const motion::MotionSystem::OrderedUnderWay& ordered,
                                                   const motion::MoveCommand& command) {
    earlier_.begun.reset();
    if (place.before) {
        motion::MoveCommand before = *place.before;
        before.tag = ++instructions_;
        const motion::Pose start = system_.toRobTarget(place.from, before.frames).pose;
        enqueued(ordered.before, before, start, ordered.start, nullptr);
    }
    return {system_.toRobTarget(ordered.start, command.frames).pose, ordered.start};
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
    if (earlier_.place) return; // ordered as a whole
    const auto begun = std::exchange(earlier_.begun, {});
    if (begun && command.kind == motion::MoveKind::Circular)
        command = motion::restOfCircle(command, *begun, system_.currentTarget(command.frames).pose);
}

} // namespace rt
