// MotionSystem: orders and questions.

#include "runtime/motion/motion_system_impl.h"

#include <algorithm>

namespace motion {

namespace {

Joints startPosture() {
    return {0, 0, 0, 0, 30, 0};
}

} // namespace

MotionSystem::MotionSystem(robot::RobotModel model, MotionOptions options) : impl_(std::make_unique<Impl>()) {
    impl_->model = std::move(model);
    impl_->options = options;
    impl_->kinematics = robot::Kinematics(impl_->model);
    ExternalAxes external = kNoExternalAxes;
    for (std::size_t i = 0; i < external.size(); ++i) {
        const ExternalAxisModel& axis = options.external[i];
        if (axis.present) external[i] = std::clamp(0.0, axis.lower, axis.upper);
    }
    impl_->stretches.emplace_back();
    placeAt({startPosture(), external});
}

MotionSystem::~MotionSystem() = default;
MotionSystem::MotionSystem(MotionSystem&&) noexcept = default;
MotionSystem& MotionSystem::operator=(MotionSystem&&) noexcept = default;

const robot::RobotModel& MotionSystem::model() const {
    return impl_->model;
}
const robot::Kinematics& MotionSystem::kinematics() const {
    return impl_->kinematics;
}

Expected<MoveId, MotionError> MotionSystem::enqueue(const MoveCommand& command) {
    MotionError error;
    if (impl_->model.kinematics != robot::KinematicsKind::SphericalWrist) {
        error.kind = MotionErrorKind::UnsupportedRobot;
        return Unexpected{error};
    }
    if (impl_->queue.size() >= impl_->options.maxQueued) {
        error.kind = MotionErrorKind::QueueFull;
        error.value = static_cast<double>(impl_->queue.size());
        return Unexpected{error};
    }
    MoveCommand based = command;
    based.frames.baseFrame = impl_->model.baseFrame;
    auto path = MotionPath::make(impl_->kinematics, impl_->plannedEnd(), based);
    if (!path) return Unexpected{path.error()};
    for (std::size_t i = 0; i < static_cast<std::size_t>(kExternalCount); ++i) {
        const ExternalAxisModel& axis = impl_->options.external[i];
        const double value = path->end().extax[i];
        if (!isConnected(value) || (value >= axis.lower - 1e-9 && value <= axis.upper + 1e-9)) continue;
        error.kind = MotionErrorKind::JointOutOfRange;
        error.joint = robot::kFirstExternalAxis + static_cast<int>(i);
        error.value = value;
        error.pathFraction = 1;
        error.position = path->tcpAt(1).pos;
        return Unexpected{error};
    }
    auto move = std::make_shared<Move>();
    move->id = impl_->nextId++;
    move->tag = command.tag;
    move->isConcurrent = command.concurrent;
    move->isFlyBy = !command.zone.finep;
    move->zone = std::max({command.zone.pzoneTcp, command.zone.pzoneOri, command.zone.pzoneEax});
    for (const PathTrigger& trigger : command.triggers)
        move->triggers.push_back({trigger, false});
    move->plan = PlannedMotion::plan(std::move(*path), impl_->model, impl_->options.external, based);
    impl_->queue.push_back(move);
    impl_->startNext();
    return move->id;
}

void MotionSystem::clear() {
    Impl& s = *impl_;
    s.carried.clear();
    s.finished = nullptr;
    if (s.queue.empty()) return;
    if (s.isExcursion) { // it comes to its end
        s.noteCleared(s.queue.front()->id);
        s.queue.clear();
        s.isBraking = false;
        return;
    }
    if (s.isHalted) { // what remains is not the arm's any more
        s.noteCleared(s.queue.front()->id);
        s.queue.clear();
        s.isHalted = false;
        return;
    }
    const bool isUnderWay = s.queue.front()->isStarted;
    const bool isFinishing = isUnderWay && s.isMoving() && !s.isBraking && !s.replaceProfile(true);
    const MoveId first = s.queue.front()->id + (isFinishing ? 1 : 0);
    if (first < s.nextId) s.noteCleared(first);
    if (isUnderWay && s.isMoving()) {
        s.queue.resize(1); // it comes to rest first
        s.isAbandoned = !isFinishing;
    } else {
        s.queue.clear();
        s.isBraking = false;
        s.isAbandoned = false;
    }
}

void MotionSystem::rearmTriggers() {
    Impl& s = *impl_;
    if (s.queue.empty() || !s.queue.front()->isStarted) return;
    for (Trigger& trigger : s.queue.front()->triggers)
        trigger.fired = false;
}

void MotionSystem::returnToPath() {
    Impl& s = *impl_;
    if (!s.isHalted || s.isCoasting) return;
    s.isHalted = false;
    if (s.queue.empty() || !s.queue.front()->isStarted) return;
    s.orderReturnToPath();
    if (!s.queue.front()->isReturn) return; // it stands there
    s.queue.front()->isStarted = true;
    s.begin(s.queue.front(), s.queue.front()->plan.profile());
    s.isExcursion = true;
}

bool MotionSystem::stepBack(double mm, double mmPerSecond) {
    Impl& s = *impl_;
    if (!s.isHeld() || s.isMoving() || s.isHalted) return false;
    const bool isBegun = !s.queue.empty() && s.queue.front()->isStarted;
    const bool isReturn = isBegun && s.queue.front()->isReturn;
    if (isReturn && !s.queue.front()->isRetraced) return false;
    const double from = isBegun ? s.pausedAt() : 0;
    if (from > 1e-9) {
        s.stepBackOnFront(from, mm, mmPerSecond);
        return true;
    }
    if (isReturn || s.finished == nullptr) return false;
    const auto before = std::make_shared<Move>(*s.finished);
    before->isReturn = before->isRetraced = before->isReleased = true;
    before->triggers.clear();
    s.queue.push_front(before);
    s.stepBackOnFront(1, mm, mmPerSecond);
    return true;
}

bool MotionSystem::storePath() {
    Impl& s = *impl_;
    if (s.isMoving()) return false;
    if (!std::exchange(s.isHalted, false) && !s.queue.empty() && s.queue.front()->isStarted) {
        s.queue.front()->pausedAt = s.pausedAt();
    }
    s.finished = nullptr;
    s.levels.push_back(
        {std::exchange(s.queue, {}), std::exchange(s.carried, {}), s.isStopRequested, s.isBraking});
    s.isStopRequested = false;
    s.isBraking = false;
    s.isStopAnnounced = true;
    return true;
}

bool MotionSystem::restorePath() {
    Impl& s = *impl_;
    if (s.isMoving() || !s.queue.empty() || s.levels.empty()) return false;
    Level level = std::move(s.levels.back());
    s.levels.pop_back();
    s.finished = nullptr;
    s.queue = std::move(level.queue);
    s.carried = std::move(level.carried);
    s.isStopRequested = level.isStopRequested;
    s.isBraking = level.isBraking;
    if (!s.queue.empty()) s.orderReturnToPath();
    s.goOn();
    return true;
}

bool MotionSystem::placeAt(const JointTarget& joints) {
    Impl& s = *impl_;
    if (!s.queue.empty() || s.isMoving()) return false;
    s.finished = nullptr;
    Stretch still;
    still.start = s.now;
    still.end = s.now;
    still.still = s.stateAt(s.now);
    still.still.joints = joints.robax;
    still.still.extax = joints.extax;
    still.still.jointSpeed = {};
    still.still.tcpSpeed = 0;
    still.still.moving = false;
    FrameSetup frames;
    if (s.stretch().move != nullptr) frames = s.stretch().move->plan.path().frames();
    frames.baseFrame = s.model.baseFrame;
    still.still.tcp = frames.tcpInWorld(s.kinematics.forward(joints.robax));
    s.stretches.push_back(std::move(still));
    return true;
}

void MotionSystem::stop() {
    Impl& s = *impl_;
    if (std::exchange(s.isStopRequested, true)) return;
    s.isStopAnnounced = false;
    s.hold();
    if (s.isMoving()) return;
    s.isStopAnnounced = true;
    s.report(MotionEventKind::Stopped, s.queue.empty() ? nullptr : s.queue.front().get(), s.now);
}

void MotionSystem::halt() {
    Impl& s = *impl_;
    stop();
    const bool onPath =
        s.isOnPath() && !s.isExcursion && s.stretch().move->plan.limits().speed > 0; // not in a pause
    if (!onPath) return;
    s.isStopAnnounced = false;
    s.coastNow();
}

void MotionSystem::start() {
    impl_->isStopRequested = false;
    impl_->isStopAnnounced = true;
    impl_->resume();
}

bool MotionSystem::isStopRequested() const {
    return impl_->isStopRequested;
}

void MotionSystem::setOverride(double percent) {
    Impl& s = *impl_;
    const double wanted = std::isfinite(percent) ? std::clamp(percent, 0.0, 100.0) : 100.0;
    if (wanted == std::exchange(s.override, wanted)) return;
    if (s.isHeld()) return s.hold();
    if (s.isAbandoned) return;
    if (s.isOnPath() && !s.isBraking)
        s.replaceProfile(false);
    else
        s.goOn();
}

double MotionSystem::speedOverride() const {
    return impl_->override;
}

void MotionSystem::advanceTo(TimeNs time) {
    Impl& s = *impl_;
    if (time < s.now) return;
    s.forgetBefore(s.now);
    for (;;) {
        const auto next = s.nextEvent();
        if (!next || *next > time) break;
        s.now = std::max(s.now, *next);
        s.handleEventsNow();
    }
    s.now = time;
}

TimeNs MotionSystem::now() const {
    return impl_->now;
}
std::optional<TimeNs> MotionSystem::nextEventTime() const {
    return impl_->nextEvent();
}
std::vector<MotionEvent> MotionSystem::takeEvents() {
    return std::exchange(impl_->events, {});
}

bool MotionSystem::isIdle() const {
    return impl_->queue.empty();
}
bool MotionSystem::isMoving() const {
    return impl_->isMoving();
}
std::size_t MotionSystem::unfinishedMoves() const {
    return impl_->queue.size();
}

MoveStatus MotionSystem::status(MoveId move) const {
    const Impl& s = *impl_;
    if (move <= 0 || move >= s.nextId) return MoveStatus::Unknown;
    for (const auto& [first, last] : s.cleared) {
        if (move >= first && move <= last) return MoveStatus::Cleared;
    }
    const Move* unfinished = s.findUnfinished(move);
    if (unfinished == nullptr) return MoveStatus::Done;
    return unfinished->isStarted ? MoveStatus::Moving : MoveStatus::Queued;
}

bool MotionSystem::isStarted(MoveId move) const {
    const MoveStatus state = status(move);
    return state == MoveStatus::Moving || state == MoveStatus::Done;
}

bool MotionSystem::isReleased(MoveId move) const {
    if (isDone(move)) return true;
    const Move* unfinished = impl_->findUnfinished(move);
    return unfinished != nullptr && unfinished->isReleased;
}

bool MotionSystem::isDone(MoveId move) const {
    const MoveStatus state = status(move);
    return state == MoveStatus::Done || state == MoveStatus::Cleared;
}

MoveId MotionSystem::lastOrdered() const {
    return impl_->nextId - 1;
}

MoveId MotionSystem::currentMove() const {
    const Impl& s = *impl_;
    return !s.queue.empty() && s.queue.front()->isStarted ? s.queue.front()->id : s.lastDone;
}

std::optional<TimeNs> MotionSystem::reachTime(MoveId move) const {
    const Impl& s = *impl_;
    for (const auto& [id, time] : s.reached) {
        if (id == move) return time;
    }
    const bool isCurrent = !s.queue.empty() && s.queue.front()->id == move && s.queue.front()->isStarted;
    if (!isCurrent || s.isBraking || s.isHalted || s.queue.front()->isReturn) return {};
    return s.stretch().end;
}

MotionState MotionSystem::sample(TimeNs time) const {
    return impl_->stateAt(time);
}
JointTarget MotionSystem::currentJoints() const {
    return impl_->standing();
}
JointTarget MotionSystem::plannedEnd() const {
    return impl_->plannedEnd();
}

RobTarget MotionSystem::currentTarget(const FrameSetup& frames) const {
    FrameSetup based = frames;
    based.baseFrame = impl_->model.baseFrame;
    return calcRobTarget(impl_->kinematics, impl_->standing(), based);
}

RobTarget MotionSystem::toRobTarget(const JointTarget& joints, const FrameSetup& frames) const {
    FrameSetup based = frames;
    based.baseFrame = impl_->model.baseFrame;
    return calcRobTarget(impl_->kinematics, joints, based);
}

Expected<JointTarget, MotionError> MotionSystem::toJointTarget(const RobTarget& target,
                                                               const FrameSetup& frames) const {
    FrameSetup based = frames;
    based.baseFrame = impl_->model.baseFrame;
    return calcJointTarget(impl_->kinematics, target, based, impl_->standing().robax);
}

} // namespace motion
