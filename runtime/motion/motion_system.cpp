// MotionSystem: orders and questions.

#include "runtime/motion/motion_system_impl.h"

#include <algorithm>

namespace motion {

namespace {

/// The start position of the model; else all axes at 0, as near as their ranges allow, axis 5 of six off its singularity.
Joints startPosture(const robot::RobotModel& model, std::size_t axes) {
    if (model.home.size() == axes) return model.home;
    Joints joints = Joints::zeros(axes);
    if (axes == 6) joints[4] = 30;
    for (std::size_t i = 0; i < axes; ++i)
        joints[i] = std::clamp(joints[i], model.lowerDeg[i], model.upperDeg[i]);
    return joints;
}

} // namespace

MotionSystem::MotionSystem(robot::RobotModel model, MotionOptions options) : impl_(std::make_unique<Impl>()) {
    impl_->model = std::move(model);
    impl_->options = options;
    impl_->kinematics = robot::Kinematics(impl_->model);
    if (impl_->kinematics.hasArmAngle()) options.external[0].present = false; // its place is taken by axis 7
    impl_->options.external[0] = options.external[0];
    ExternalAxes external = kNoExternalAxes;
    for (std::size_t i = 0; i < external.size(); ++i) {
        const ExternalAxisModel& axis = options.external[i];
        if (axis.present) external[i] = std::clamp(0.0, axis.lower, axis.upper);
    }
    const JointTarget start{startPosture(impl_->model, impl_->kinematics.jointCount()), external};
    impl_->level.path = impl_->newPath(start, 0);
    impl_->follow(impl_->level.path, 0);
}

MotionSystem::Hidden::Hidden(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MotionSystem::Hidden::~Hidden() = default;
MotionSystem::Hidden::Hidden(Hidden&&) noexcept = default;
MotionSystem::Hidden& MotionSystem::Hidden::operator=(Hidden&&) noexcept = default;

MotionSystem::Impl* MotionSystem::Hidden::operator->() {
    impl_->forgetNextEvent();
    return impl_.get();
}

MotionSystem::~MotionSystem() = default;
MotionSystem::MotionSystem(MotionSystem&&) noexcept = default;
MotionSystem& MotionSystem::operator=(MotionSystem&&) noexcept = default;

const robot::RobotModel& MotionSystem::model() const {
    return impl_->model;
}
Planner MotionSystem::planner() const {
    return impl_->options.planner;
}
const ExternalAxisModels& MotionSystem::externalAxes() const {
    return impl_->options.external;
}
const robot::Kinematics& MotionSystem::kinematics() const {
    return impl_->kinematics;
}

/// The first external axis that the target of the move leads out of its range.
std::optional<MotionError> MotionSystem::Impl::externalOutOfRange(const MoveCommand& command) const {
    const bool isAbsolute = command.kind == MoveKind::AbsJoint;
    const ExternalAxes& wanted = isAbsolute ? command.joints.extax : command.target.extax;
    const ExternalAxes axes = targetAxes(path().endTarget().extax, wanted);
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const ExternalAxisModel& axis = options.external[i];
        if (!isConnected(axes[i]) || (axes[i] >= axis.lower - 1e-9 && axes[i] <= axis.upper + 1e-9)) continue;
        MotionError error;
        error.kind = MotionErrorKind::JointOutOfRange;
        error.joint = robot::kFirstExternalAxis + static_cast<int>(i);
        error.value = axes[i];
        error.pathFraction = 1;
        error.position = isAbsolute
                             ? command.frames.fromFlange(kinematics.forward(command.joints.robax), axes).pos
                             : command.target.pose.pos;
        return error;
    }
    return {};
}

/// The move with its path from where the last one ends.
Expected<Trajectory::Ordered, MotionError> MotionSystem::Impl::prepared(const MoveCommand& command) const {
    MotionError error;
    if (level.queue.size() >= options.maxQueued) {
        error.kind = MotionErrorKind::QueueFull;
        error.value = static_cast<double>(level.queue.size());
        return Unexpected{error};
    }
    MoveCommand onBase = command;
    onBase.frames = based(command.frames);
    auto made = MotionPath::make(kinematics, path().endTarget(), onBase);
    const bool isOnTheWay =
        !made && made.error().pathFraction < 1 && made.error().kind != MotionErrorKind::BadArgument;
    if (made || isOnTheWay) { // the target is judged before the way to it, with its external axes
        if (const auto outside = externalOutOfRange(onBase)) return Unexpected{*outside};
    }
    if (!made) return Unexpected{made.error()};
    return Trajectory::Ordered{
        std::make_shared<const MotionPath>(std::move(*made)), std::move(onBase), {}, {}};
}

/// The move is on its way.
MoveId MotionSystem::Impl::registerMove(const MoveCommand& command, const Trajectory::Appended& appended) {
    const std::shared_ptr<Move> before = level.queue.empty() ? nullptr : level.queue.back();
    if (appended.isCornerLost) report(MotionEventKind::CornerLost, before.get());
    auto move = std::make_shared<Move>();
    move->id = nextId++;
    move->tag = command.tag;
    move->leg = appended.at;
    move->isPoint = appended.isPoint;
    move->isConcurrent = command.concurrent;
    move->isAwaited = command.stop.isAwaited;
    move->isFlyBy = !command.zone.finep;
    move->modifications = command.modifications;
    for (const PathTrigger& trigger : command.triggers)
        move->triggers.push_back({trigger, false});
    level.queue.push_back(move);
    if (before != nullptr && !std::exchange(before->isReleased, true) && !before->isConcurrent)
        report(MotionEventKind::Released, before.get());
    return move->id;
}

Expected<MoveId, MotionError> MotionSystem::enqueue(const MoveCommand& command) {
    Impl& s = *impl_;
    const auto ordered = s.prepared(command);
    if (!ordered) return Unexpected{ordered.error()};
    return s.registerMove(ordered->command, s.path().append(ordered->path, ordered->command, s.seconds()));
}

void MotionSystem::clear(StopKind kind) {
    Impl& s = *impl_;
    if (!s.level.queue.empty()) s.noteCleared(s.level.queue.front()->id);
    const bool hadMoves = !s.level.queue.empty();
    s.level.queue.clear();
    s.level.carried.clear();
    s.level.finished.clear();
    if (hadMoves || s.isHalted || s.detour != nullptr) s.abandonPath(kind);
    s.noteMotion();
}

void MotionSystem::rearmTriggers() {
    Impl& s = *impl_;
    if (s.level.queue.empty() || !s.level.queue.front()->isStarted) return;
    for (Trigger& trigger : s.level.queue.front()->triggers)
        trigger.fired = false;
}

void MotionSystem::returnToPath() {
    Impl& s = *impl_;
    if (s.isHalted && !s.isCoasting) s.startDetour();
    s.noteMotion();
}

bool MotionSystem::stepBack(double mm, double mmPerSecond) {
    Impl& s = *impl_;
    if (!s.isHeld() || s.isMoving() || s.isHalted || s.detour != nullptr) return false;
    const auto place = s.placeBack(mm);
    if (!place) return false;
    s.path().goBack(s.seconds(), *place, mmPerSecond);
    s.isStepping = true;
    s.noteMotion();
    return true;
}

bool MotionSystem::storePath() {
    Impl& s = *impl_;
    if (s.isMoving()) return false;
    s.isHalted = false;
    s.level.isStopRequested = s.isStopRequested;
    s.path().hold(s.seconds());
    const JointTarget here = s.standing();
    s.lastFrames = s.framesNow();
    s.stored.push_back(std::exchange(s.level, {}));
    s.modifiers.pathStored();
    s.isStopRequested = false;
    s.isStopAnnounced = true;
    s.level.path = s.newPath(here, s.seconds());
    s.follow(s.level.path, s.now);
    s.holdOrRelease();
    return true;
}

bool MotionSystem::restorePath() {
    Impl& s = *impl_;
    if (s.isMoving() || !s.level.queue.empty() || s.stored.empty()) return false;
    Level level = std::move(s.stored.back());
    s.stored.pop_back();
    const JointTarget here = s.standing();
    s.isStopRequested = level.isStopRequested;
    s.level = std::move(level);
    s.modifiers.pathRestored();
    s.follow(s.level.path, s.now);
    if (s.level.path->isEmpty() || s.level.queue.empty()) { // no move is left: the path begins here
        s.beginPath(s.newPath(here, s.seconds()));
        s.holdOrRelease();
        return true;
    }
    Span standing;
    standing.start = s.now;
    standing.still = s.stillAt(here);
    s.spans.back() = standing;
    s.isHalted = true; // the path may continue somewhere else
    if (s.isHeld())
        s.isStopAnnounced = true;
    else
        s.resume();
    return true;
}

void MotionSystem::clearStored() {
    Impl& s = *impl_;
    for (const Level& level : s.stored)
        if (!level.queue.empty()) s.noteCleared(level.queue.front()->id);
    s.stored.clear();
    s.modifiers.storedPathsCleared();
}

std::optional<MotionSystem::PathGap> MotionSystem::gapToPath() const {
    const Impl& s = *impl_;
    if (!s.isHalted || s.isCoasting || s.level.queue.empty() || s.path().isEmpty()) return {};
    const PathPlace place = s.path().at(s.seconds()).place;
    const FrameSetup frames = s.path().framesAt(place);
    const auto tcp = [&](const auto& at) {
        return frames.tcpInWorld(s.kinematics.forward(at.joints), at.extax);
    };
    const Pose goal = tcp(s.pathStateNow());
    const Pose here = tcp(s.stateAt(s.now));
    return PathGap{norm(goal.pos - here.pos), robot::angleBetween(goal.rot, here.rot)};
}

void MotionSystem::setExternalAxis(std::size_t axis, const ExternalAxisModel& model) {
    impl_->options.external[axis] = model;
}

bool MotionSystem::placeAt(const JointTarget& joints) {
    Impl& s = *impl_;
    if (!s.level.queue.empty() || s.isMoving()) return false;
    s.beginPath(s.newPath(joints, s.seconds()));
    s.holdOrRelease();
    return true;
}

void MotionSystem::stop(StopKind kind) {
    Impl& s = *impl_;
    if (std::exchange(s.isStopRequested, true)) {
        if (kind == StopKind::Quick && s.isMoving()) s.holdOrRelease(kind);
        return;
    }
    s.isStopAnnounced = false;
    s.holdOrRelease(kind);
    if (s.isMoving()) return;
    s.isStopAnnounced = true;
    s.report(MotionEventKind::Stopped, s.front());
}

void MotionSystem::halt() {
    Impl& s = *impl_;
    stop();
    if (!s.isMoving() || s.isStepping || s.isCoasting) return;
    s.isStopAnnounced = false;
    s.coastNow();
}

void MotionSystem::start() {
    impl_->isStopRequested = false;
    impl_->isStopAnnounced = true;
    impl_->resume();
    impl_->noteMotion();
}

void MotionSystem::setIndependent(GroupAxis axis, AxisCourse course) {
    for (auto& [known, present] : impl_->independents) {
        if (known != axis) continue;
        present = std::move(course);
        return;
    }
    impl_->independents.emplace_back(axis, std::move(course));
}

bool MotionSystem::endIndependent(GroupAxis axis, double position) {
    JointTarget joints = impl_->standing();
    (axis.isExternal ? joints.extax[axis.index] : joints.robax[axis.index]) = position;
    if (!placeAt(joints)) return false;
    std::erase_if(impl_->independents, [&](const auto& entry) { return entry.first == axis; });
    return true;
}

const AxisCourse* MotionSystem::independent(GroupAxis axis) const {
    for (const auto& [known, course] : impl_->independents)
        if (known == axis) return &course;
    return nullptr;
}

std::vector<GroupAxis> MotionSystem::independentAxes() const {
    std::vector<GroupAxis> axes;
    for (const auto& [axis, course] : impl_->independents)
        axes.push_back(axis);
    return axes;
}

bool MotionSystem::isStopRequested() const {
    return impl_->isStopRequested;
}

namespace {

double percentOf(double wanted) {
    return std::isfinite(wanted) ? std::clamp(wanted, 0.0, 100.0) : 100.0;
}

} // namespace

void MotionSystem::setOverride(double percent) {
    const double wanted = percentOf(percent);
    if (wanted != std::exchange(impl_->override, wanted)) impl_->obeyOverride();
}

void MotionSystem::setProgramOverride(double percent) {
    const double wanted = percentOf(percent);
    if (wanted != std::exchange(impl_->programOverride, wanted)) impl_->obeyOverride();
}

double MotionSystem::programOverride() const {
    return impl_->programOverride;
}

double MotionSystem::overrideShare() const {
    return impl_->overrideShare();
}

void MotionSystem::setSpeedLimits(const SpeedLimits& most) {
    Impl& s = *impl_;
    if (most == std::exchange(s.speedLimits, most)) return;
    s.path().setSpeedLimits(s.seconds(), most);
    if (s.detour != nullptr) s.detour->setSpeedLimits(s.seconds(), most);
    for (Level& level : s.stored)
        level.path->setSpeedLimits(s.seconds(), most);
    s.noteMotion();
}

double MotionSystem::speedOverride() const {
    return impl_->override;
}

void MotionSystem::advanceTo(TimeNs time) {
    Impl& s = impl_.keepingNextEvent();
    if (time < s.now) return;
    s.forgetBefore(s.now);
    for (;;) {
        const auto next = s.nextEvent();
        if (!next || *next > time) break;
        s.advanceModifiers(*next);
        s.now = std::max(s.now, *next);
        s.handleEventsNow();
    }
    s.advanceModifiers(time);
    s.now = time;
}

TimeNs MotionSystem::now() const {
    return impl_->now;
}
std::optional<TimeNs> MotionSystem::nextEventTime() const {
    return impl_->nextEvent();
}
std::vector<MotionEvent> MotionSystem::takeEvents() {
    return std::exchange(impl_.keepingNextEvent().events, {});
}

bool MotionSystem::isIdle() const {
    return impl_->level.queue.empty();
}
bool MotionSystem::isMoving() const {
    return impl_->isMoving();
}
bool MotionSystem::movesBesidesPath() const {
    return impl_->modifiers.areActive() || !impl_->independents.empty();
}
bool MotionSystem::hasRoom() const {
    return impl_->level.queue.size() < impl_->options.maxQueued;
}
std::size_t MotionSystem::unfinishedMoves() const {
    return impl_->level.queue.size();
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
    const auto& queue = s.level.queue;
    return !queue.empty() && queue.front()->isStarted ? queue.front()->id : s.lastDone;
}

std::optional<TimeNs> MotionSystem::reachTime(MoveId move) const {
    const Impl& s = *impl_;
    for (const auto& [id, time] : s.reached) {
        if (id == move) return time;
    }
    if (s.isHalted || s.detour != nullptr || s.isStepping) return {};
    for (const auto& unfinished : s.level.queue) {
        if (unfinished->id != move) continue;
        const auto time = s.reachTime(*unfinished);
        return time ? std::optional(toNs(*time)) : std::nullopt;
    }
    return {};
}

MotionState MotionSystem::sample(TimeNs time) const {
    return impl_->shown(impl_->stateAt(time), time);
}
MotionState MotionSystem::sampleStopped(TimeNs time) const {
    return impl_->shown(impl_->stateIfStopped(time), time);
}
JointTarget MotionSystem::currentJoints() const {
    return impl_->shown(impl_->standing());
}
JointTarget MotionSystem::plannedEnd() const {
    return impl_->path().endTarget();
}

Pose MotionSystem::flangeInWorld(const JointTarget& joints) const {
    return impl_->based({}).base(joints.extax) * impl_->kinematics.forward(joints.robax);
}

RobTarget MotionSystem::currentTarget(const FrameSetup& frames) const {
    return calcRobTarget(impl_->kinematics, currentJoints(), impl_->based(frames));
}

RobTarget MotionSystem::toRobTarget(const JointTarget& joints, const FrameSetup& frames) const {
    return calcRobTarget(impl_->kinematics, joints, impl_->based(frames));
}

Expected<JointTarget, MotionError> MotionSystem::toJointTarget(const RobTarget& target,
                                                               const FrameSetup& frames) const {
    const JointTarget here = impl_->standing();
    RobTarget placed = target; // external axes that it does not give remain where they are
    for (std::size_t i = 0; i < placed.extax.size(); ++i)
        if (!isConnected(placed.extax[i])) placed.extax[i] = here.extax[i];
    auto joints = calcJointTarget(impl_->kinematics, placed, impl_->based(frames), here.robax);
    if (joints) joints->extax = target.extax;
    return joints;
}

} // namespace motion
