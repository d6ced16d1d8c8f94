#include "stdlib/impl/motion/path_recorder.h"

#include "runtime/motion/path.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rt::lib {
namespace {

constexpr double kSamePlace = 1e-3; // deg or mm

bool isSamePlace(const motion::JointTarget& a, const motion::JointTarget& b) {
    for (std::size_t i = 0; i < a.robax.size(); ++i)
        if (std::abs(a.robax[i] - b.robax[i]) > kSamePlace) return false;
    for (std::size_t i = 0; i < a.extax.size(); ++i)
        if (motion::isConnected(a.extax[i]) && std::abs(a.extax[i] - b.extax[i]) > kSamePlace) return false;
    return true;
}

/// What all movements of the recorder have in common: geometry and manner of the recorded one, without what was to be done
/// on its path.
motion::MoveCommand likeRecorded(const motion::MoveCommand& recorded, const PathRecorder::Manner& manner) {
    motion::MoveCommand command = recorded;
    command.triggers.clear();
    command.concurrent = false;
    command.confL = false; // it has been there in this configuration
    if (manner.speed) {
        command.speed = *manner.speed;
        command.duration = 0;
    }
    return command;
}

/// To axis angles, as the recorded movement was made. Movements in axis angles stay such unless there is an offset.
void aimAt(motion::MoveCommand& command, const motion::MotionSystem& arm, const motion::JointTarget& joints,
           const motion::Pose& offset) {
    const bool isJoint =
        command.kind == motion::MoveKind::AbsJoint || command.kind == motion::MoveKind::Joint;
    const bool isOffset = norm(offset.pos) > 0;
    if (isJoint) command.kind = isOffset ? motion::MoveKind::Joint : motion::MoveKind::AbsJoint;
    command.confJ = true;
    command.joints = joints;
    command.target = arm.toRobTarget(joints, command.frames);
    command.target.pose = command.target.pose * offset;
}

/// The circle backward from where its arm is, without an offset.
motion::MoveCommand circleBack(const motion::MoveCommand& recorded, const motion::MotionSystem& arm,
                               const motion::JointTarget& from, const motion::JointTarget& here) {
    motion::MoveCommand command = recorded;
    command.target = arm.toRobTarget(from, command.frames);
    return motion::restOfCircle(command, recorded.target.pose, arm.toRobTarget(here, command.frames).pose);
}

} // namespace

void PathRecorder::start(TaskCore* task, Handle id) {
    task_ = task;
    MotionDriver& driver = lib::motionOf(task);
    if (!std::exchange(listening_, true))
        driver.addOrderListener([this](const MotionDriver::Ordered& ordered) { note(ordered); });
    if (!std::exchange(recording_, true)) joinTo(driver.system().plannedEnd());
    std::erase_if(names_, [id](const Named& name) { return name.id == id; });
    names_.push_back({id, moves_.size()});
}

void PathRecorder::clear() {
    recording_ = false;
    moves_.clear();
    names_.clear();
    replay_.reset();
}

void PathRecorder::truncate(std::size_t position) {
    moves_.resize(std::min(position, moves_.size()));
    std::erase_if(names_, [&](const Named& name) { return name.position > moves_.size(); });
}

/// The path continues at `from`: after a way back, or after movements that were thrown away, the movements that do not
/// lead there are dropped; all of them when none does.
void PathRecorder::joinTo(const motion::JointTarget& from) {
    if (replay_ && replay_->at < replay_->way.size() && isSamePlace(replay_->way[replay_->at].from, from))
        truncate(replay_->at);
    replay_.reset();
    if (moves_.empty() || isSamePlace(moves_.back().to, from)) return;
    const motion::MotionSystem& arm = lib::motionSystemOf(task_);
    std::size_t cleared = moves_.size();
    while (cleared > 0 && arm.status(moves_[cleared - 1].id) == motion::MoveStatus::Cleared)
        --cleared;
    if (cleared == moves_.size()) {
        moves_.clear();
        names_.clear();
        return;
    }
    truncate(cleared + 1);
    moves_.back().to = from;
    moves_.back().partial = true;
}

void PathRecorder::forgetOldest() {
    moves_.pop_front();
    std::erase_if(names_, [](const Named& name) { return name.position == 0; });
    for (Named& name : names_)
        --name.position;
}

void PathRecorder::note(const MotionDriver::Ordered& order) {
    if (!recording_ || replaying_) return;
    if (lib::motionOf(task_).pathLevel() > 1) return;
    joinTo(order.from);
    moves_.push_back({order.id, order.command, order.from, order.to, false});
    if (moves_.size() > kMost) forgetOldest();
}

/// The recorded movements up to where the arm is.
std::vector<PathRecorder::Recorded> PathRecorder::wayToHere(const motion::MotionSystem& arm) const {
    using motion::MoveStatus;
    std::size_t count = moves_.size();
    while (count > 0 && arm.status(moves_[count - 1].id) != MoveStatus::Done &&
           arm.status(moves_[count - 1].id) != MoveStatus::Moving)
        --count;
    const motion::JointTarget here = arm.currentJoints();
    const bool isLeft = count < moves_.size() && arm.status(moves_[count].id) == MoveStatus::Cleared &&
                        !isSamePlace(moves_[count].from, here);
    if (isLeft) ++count;
    std::vector<Recorded> way(moves_.begin(), moves_.begin() + static_cast<std::ptrdiff_t>(count));
    if (!way.empty() && arm.status(way.back().id) != MoveStatus::Done) {
        way.back().to = here;
        way.back().partial = true;
    }
    return way;
}

std::optional<std::size_t> PathRecorder::goalBack(const motion::MotionSystem& arm, Handle id) const {
    if (!recording_) return {};
    const std::size_t here = replay_ ? replay_->at : wayToHere(arm).size();
    std::optional<std::size_t> goal;
    for (const Named& name : names_)
        if (name.position < here && (id == 0 || name.id == id))
            goal = std::max(goal.value_or(0), name.position);
    return goal;
}

std::optional<std::size_t> PathRecorder::goalForward(Handle id) const {
    if (!recording_ || !replay_) return {};
    std::optional<std::size_t> goal;
    if (id == 0) goal = replay_->way.size();
    for (const Named& name : names_)
        if (id != 0 && name.id == id && name.position <= replay_->way.size()) goal = name.position;
    return goal && *goal > replay_->at ? goal : std::nullopt;
}

Status PathRecorder::order(Task& task, motion::MoveCommand command, motion::MoveId& id) {
    std::optional<motion::MotionError> error;
    replaying_ = true;
    const Status status = task.controller().motion(task).order(task, std::move(command), id, error);
    replaying_ = false;
    if (status != kOk) return status;
    return error ? failMotion(&task, *error) : kOk;
}

Status PathRecorder::moveBack(Task& task, std::size_t goal, const Manner& manner) {
    MotionDriver& driver = task.controller().motion(task);
    if (!replay_) {
        std::vector<Recorded> way = wayToHere(driver.system());
        const std::size_t end = way.size();
        replay_ = Replay{std::move(way), end};
    }
    motion::MoveId id = 0;
    while (replay_->at > goal) {
        const Recorded& move = replay_->way[replay_->at - 1];
        motion::MoveCommand command = move.command;
        if (command.kind == motion::MoveKind::Circular)
            command = circleBack(move.command, driver.system(), move.from, move.to);
        command = likeRecorded(command, manner);
        aimAt(command, driver.system(), move.from, manner.offset);
        command.circlePoint = command.circlePoint * manner.offset;
        // Corners are where they were: the zone of the point belongs to the movement that led to it.
        command.zone =
            replay_->at - 1 > goal ? replay_->way[replay_->at - 2].command.zone : motion::ZoneData{};
        if (const Status status = order(task, std::move(command), id)) return status;
        --replay_->at;
    }
    return driver.waitDone(task, id);
}

Status PathRecorder::moveForward(Task& task, std::size_t goal, const Manner& manner) {
    MotionDriver& driver = task.controller().motion(task);
    motion::MoveId id = 0;
    while (replay_->at < goal) {
        const Recorded& move = replay_->way[replay_->at];
        motion::MoveCommand command = likeRecorded(move.command, manner);
        if (move.partial && command.kind == motion::MoveKind::Circular)
            command.circlePoint = circleBack(move.command, driver.system(), move.from, move.to).circlePoint;
        aimAt(command, driver.system(), move.to, manner.offset);
        command.circlePoint = command.circlePoint * manner.offset;
        if (replay_->at + 1 == goal) command.zone = {};
        if (const Status status = order(task, std::move(command), id)) return status;
        ++replay_->at;
    }
    if (const Status status = driver.waitDone(task, id)) return status;
    if (replay_->at == replay_->way.size()) replay_.reset();
    return kOk;
}

void endPathRecording(MotionDriver& motion) {
    motion.service<PathRecorder>().clear();
}

} // namespace rt::lib
