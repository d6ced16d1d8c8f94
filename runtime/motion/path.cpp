// Resolves a move into a path in joint space and lays a grid over it that is fine where the axes turn fast.

#include "runtime/motion/path.h"

#include "runtime/motion/tolerances.h"
#include "runtime/robot/angles.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

constexpr double kRounding = 2e-4; // mm and deg: a target read from the arm and kept in single precision
constexpr double kCoarseMm = 10;   // grid of a curve
constexpr double kCoarseDeg = 2;
constexpr double kLargestStep = 3;    // deg an axis may turn between two nodes
constexpr double kLargestBend = 0.01; // deg an axis may be off the straight at half a step
constexpr double kFinestMm = 2e-3;    // a path that still jumps within this is singular
constexpr double kFinestDeg = 2e-3;
constexpr int kJointGrid = 48;
constexpr std::size_t kMostNodes = 200000;

bool isFinite(const Pose& pose) {
    return std::isfinite(pose.pos.x + pose.pos.y + pose.pos.z + pose.rot.w + pose.rot.x + pose.rot.y +
                         pose.rot.z);
}

double largestDifference(const Joints& a, const Joints& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::fabs(a[i] - b[i]));
    return largest;
}

int mostDifferent(const Joints& a, const Joints& b) {
    std::size_t axis = 0;
    for (std::size_t i = 1; i < a.size(); ++i) {
        if (std::fabs(a[i] - b[i]) > std::fabs(a[axis] - b[axis])) axis = i;
    }
    return static_cast<int>(axis) + 1;
}

Joints between(const Joints& a, const Joints& b, double k) {
    Joints result = a;
    for (std::size_t i = 0; i < a.size(); ++i)
        result[i] = a[i] + (b[i] - a[i]) * k;
    return result;
}

MotionError badArgument(const char* what, double value) {
    MotionError error;
    error.what = what;
    error.value = value;
    return error;
}

/// First figure of a command that cannot be worked with.
std::optional<MotionError> checkArguments(const MoveCommand& command) {
    const FrameSetup& f = command.frames;
    if (!f.isConsistent()) {
        return badArgument("a tool and a work object of which not exactly one is held by the robot", 0);
    }
    for (const Pose& pose : {f.tool.tframe, f.workObject.uframe, f.workObject.oframe, f.displacement,
                             f.baseFrame, command.target.pose, command.circlePoint}) {
        if (!isFinite(pose)) return badArgument("a frame or target that is not a number", NAN);
        if (std::fabs(norm(pose.rot) - 1) > kUnitTolerance)
            return badArgument(kNoOrientation, norm(pose.rot));
    }
    for (double angle : command.joints.robax) {
        if (!std::isfinite(angle)) return badArgument("an axis angle that is not a number", angle);
    }
    for (const ExternalAxes* axes : {&command.joints.extax, &command.target.extax}) {
        for (double value : *axes) {
            if (!std::isfinite(value))
                return badArgument("an external axis value that is not a number", value);
        }
    }
    if (std::isinf(command.target.armAngle))
        return badArgument("an arm angle that is not a number", command.target.armAngle);
    const SpeedData& speed = command.speed;
    for (double value : {speed.vTcp, speed.vOri, speed.vLeax, speed.vReax}) {
        if (!(value >= 0) || std::isinf(value)) return badArgument("a negative speed", value);
    }
    const ZoneData& zone = command.zone;
    for (double value :
         {zone.pzoneTcp, zone.pzoneOri, zone.pzoneEax, zone.zoneOri, zone.zoneLeax, zone.zoneReax}) {
        if (!(value >= 0) || std::isinf(value)) return badArgument("a negative zone", value);
    }
    if (!(command.duration >= 0) || std::isinf(command.duration))
        return badArgument("a negative time", command.duration);
    return {};
}

} // namespace

ExternalAxes targetAxes(const ExternalAxes& start, const ExternalAxes& target) {
    ExternalAxes result = start;
    for (std::size_t i = 0; i < result.size(); ++i) {
        if (isConnected(start[i]) && isConnected(target[i])) result[i] = target[i];
    }
    return result;
}

Expected<MotionPath, MotionError> MotionPath::make(const robot::Kinematics& kinematics,
                                                   const JointTarget& start, const MoveCommand& command) {
    if (auto error = checkArguments(command)) return Unexpected{*error};
    const bool isOfOther =
        command.kind == MoveKind::AbsJoint && command.joints.robax.size() != start.robax.size();
    if (isOfOther) {
        return Unexpected{badArgument("a posture of an arm with a different number of axes",
                                      static_cast<double>(command.joints.robax.size()))};
    }
    MotionPath path;
    path.kinematics_ = kinematics;
    path.setFrames(command.frames);
    path.start_ = start;
    path.end_ = start;
    const bool isAbsolute = command.kind == MoveKind::AbsJoint;
    path.end_.extax = targetAxes(start.extax, isAbsolute ? command.joints.extax : command.target.extax);
    path.isCartesian_ = command.kind == MoveKind::Linear || command.kind == MoveKind::Circular;
    const auto error = path.isCartesian_ ? path.resolveCurve(command) : path.resolveJointTarget(command);
    if (error) return Unexpected{*error};
    path.isEmpty_ = path.isEmpty_ && path.end_.extax == start.extax;
    return path;
}

std::optional<MotionError> MotionPath::resolveJointTarget(const MoveCommand& command) {
    if (command.kind == MoveKind::AbsJoint) {
        end_.robax = command.joints.robax;
        constexpr std::size_t kAxis7 = 6;
        if (kinematics_.hasArmAngle() && !isConnected(end_.robax[kAxis7]))
            end_.robax[kAxis7] = start_.robax[kAxis7];
    } else {
        const auto joints = solveTarget(kinematics_, flangeFor(command.target.pose, 1), command.target,
                                        command.confJ, start_.robax);
        if (!joints) return targetError(joints.error(), command.target.pose.pos);
        end_.robax = *joints;
    }
    layStraightGrid();
    isEmpty_ = largestDifference(start_.robax, end_.robax) < kNothing;
    // Between two postures within limits a straight joint path stays within them.
    return checkNode({1, end_.robax, 0});
}

void MotionPath::layStraightGrid() {
    nodes_.reserve(kJointGrid + 1);
    Vec3 last{};
    double distance = 0;
    for (int i = 0; i <= kJointGrid; ++i) {
        const double s = static_cast<double>(i) / kJointGrid;
        const Joints joints = between(start_.robax, end_.robax, s);
        const Vec3 tcp = tcpOf(joints, s).pos;
        if (i > 0) distance += norm(tcp - last);
        last = tcp;
        nodes_.push_back({s, joints, distance});
    }
}

std::optional<MotionError> MotionPath::resolveCurve(const MoveCommand& command) {
    const Pose from = tcpOf(start_.robax, 0);
    const Pose to{command.target.pose.pos, robot::normalized(command.target.pose.rot)};
    if (command.kind == MoveKind::Linear) {
        curve_ = CartesianCurve::line(from, to);
    } else {
        auto arc = CartesianCurve::arc(from, command.circlePoint, to, command.circleOrientation);
        if (!arc) return arc.error();
        curve_ = *arc;
        if (isByWrist(command.circleOrientation) && curve_.isArc())
            if (auto error = takeWristAxes(command.circleOrientation)) return error;
    }
    resolveArmAngle(command);
    const bool isCarried =
        (frames_.dependsOnAxes() && end_.extax != start_.extax) || frames_.userCourse != nullptr;
    isEmpty_ = curve_.length() < kRounding && curve_.rotationDeg() < kRounding &&
               std::fabs(armTravel_) < kRounding && !isCarried;
    if (isEmpty_) {
        nodes_ = {{0, start_.robax, 0}, {1, start_.robax, 0}};
        return checkArrival(command);
    }
    if (auto error = checkTarget(command)) return error;
    if (auto error = marchWithMode(command)) return error;
    end_.robax = nodes_.back().joints;
    return checkArrival(command);
}

/// From the arm angle of the start to that of the target, the short way. One that is free stays as it is unless the target
/// can be reached with another one only.
void MotionPath::resolveArmAngle(const MoveCommand& command) {
    if (!kinematics_.hasArmAngle()) return;
    armStart_ = kinematics_.armAngle(start_.robax);
    double end = command.target.armAngle;
    if (std::isnan(end)) {
        const auto joints =
            solveTarget(kinematics_, flangeFor(curve_.at(1), 1), command.target, command.confL, start_.robax);
        if (!joints) return;
        end = kinematics_.armAngle(*joints);
    }
    armTravel_ = std::remainder(end - armStart_, 360.0);
}

/// Before the way to it: a target that no posture reaches is what has to be corrected, not the place on the way at which the arm
/// would have to give up. Only the way shows whether the movement ends with another orientation than the programmed one.
std::optional<MotionError> MotionPath::checkTarget(const MoveCommand& command) const {
    if (isByWrist_ || command.singularity == SingularityMode::LockAxis4) return {};
    const auto joints =
        solveTarget(kinematics_, flangeFor(curve_.at(1), 1), command.target, false, start_.robax);
    if (joints) return {};
    const robot::IkError& problem = joints.error();
    return errorAt(targetError(problem, {}).kind, 1, problem.joint, problem.angleDeg);
}

/// With the orientation as programmed, or by the mode of SingArea. A tool that the robot does not hold has no such mode.
std::optional<MotionError> MotionPath::marchWithMode(const MoveCommand& command) {
    const bool isPossible = frames_.tool.robotHeld && kinematics_.jointCount() == 6 && !isByWrist_;
    constexpr double kTurn = 180; // deg, between the places at which axis 4 can be locked
    lockedAxis4_ = kTurn * std::round(start_.robax[3] / kTurn);
    constexpr double kLocked = 0.01; // deg
    if (isPossible && command.singularity == SingularityMode::LockAxis4 &&
        std::fabs(start_.robax[3] - lockedAxis4_) < kLocked)
        mode_ = SingularityMode::LockAxis4;
    if (isPossible && command.singularity == SingularityMode::Wrist && canInterpolateWrist())
        if (auto error = interpolateWrist(command)) return error;
    return march();
}

/// Whether the arm has a wrist whose axes can turn for themselves.
bool MotionPath::canInterpolateWrist() const {
    Joints joints;
    const Pose tcp = kinematics_.forward(start_.robax) * frames_.tool.tframe;
    return kinematics_.inverseWithWrist(tcp.pos, frames_.tool.tframe, start_.robax, start_.robax, joints);
}

/// From the axes of the wrist at the start to those at the end, on a circle through those at its circle point.
std::optional<MotionError> MotionPath::interpolateWrist(const MoveCommand& command) {
    constexpr double kLeastShare =
        0.1; // a circle point nearer to an end of the circle would make the axes swing
    const Joints* near = &start_.robax;
    if (curve_.isArc()) {
        const Vec3 from = curve_.at(0).pos - curve_.centre();
        const Vec3 via = command.circlePoint.pos - curve_.centre();
        double angle =
            std::atan2(dot(curve_.axis(), cross(from, via)), dot(from, via)) * robot::kDegreesPerRadian;
        if (angle < 0) angle += 360;
        const double share = angle / curve_.sweepDeg();
        const Pose pose{command.circlePoint.pos, robot::normalized(command.circlePoint.rot)};
        const auto joints = kinematics_.inverseNear(flangeFor(pose, share), start_.robax);
        if (joints && share > kLeastShare && share < 1 - kLeastShare) {
            wristVia_ = *joints;
            wristViaShare_ = share;
            near = &wristVia_;
        }
    }
    const Pose flange = flangeFor(curve_.at(1), 1);
    const auto end = command.confL ? kinematics_.inverse(flange, command.target.conf, *near)
                                   : kinematics_.inverseNear(flange, *near);
    if (!end) {
        const int joint = end.error().joint;
        return errorAt(MotionErrorKind::ConfigurationMismatch, 1, joint, end.error().angleDeg);
    }
    end_.robax = *end;
    mode_ = SingularityMode::Wrist;
    return {};
}

Joints MotionPath::wristAt(double s) const {
    Joints joints = between(start_.robax, end_.robax, s);
    if (wristViaShare_ == 0) return joints;
    const Joints chord = between(start_.robax, end_.robax, wristViaShare_);
    const double bend =
        s * (1 - s) / (wristViaShare_ * (1 - wristViaShare_)); // the parabola through three places
    for (std::size_t i = 0; i < joints.size(); ++i)
        joints[i] += bend * (wristVia_[i] - chord[i]);
    return joints;
}

MotionError MotionPath::errorAt(MotionErrorKind kind, double s, int joint, double value) const {
    MotionError error;
    error.kind = kind;
    error.pathFraction = s;
    error.joint = joint;
    error.value = value;
    error.position =
        isCartesian_
            ? curve_.at(s).pos
            : frames_.fromFlange(kinematics_.forward(between(start_.robax, end_.robax, s)), externalAt(s))
                  .pos;
    return error;
}

bool MotionPath::solve(double s, const Joints& seed, Joints& out, std::optional<Pose>* tcp) const {
    if (isByWrist_) return solveByWrist(s, seed, out);
    if (mode_ != SingularityMode::Off) {
        const Pose base_tcp = flangeFor(curve_.at(s), s) * frames_.tool.tframe;
        return mode_ == SingularityMode::Wrist
                   ? kinematics_.inverseWithWrist(base_tcp.pos, frames_.tool.tframe, wristAt(s), seed, out)
                   : kinematics_.inverseLockedAxis4(base_tcp, frames_.tool.tframe, lockedAxis4_, seed, out);
    }
    const Pose pose = curve_.at(s);
    if (!kinematics_.inverseContinue(flangeFor(pose, s), seed, out, armStart_ + armTravel_ * s)) return false;
    if (tcp != nullptr) *tcp = pose;
    return true;
}

std::optional<MotionError> MotionPath::checkNode(const PathNode& node) const {
    const int joint = kinematics_.jointOutsideLimits(node.joints);
    if (joint == 0) return {};
    const robot::IkError problem = kinematics_.limitError(node.joints, joint);
    return errorAt(targetError(problem, {}).kind, node.s, joint, problem.angleDeg);
}

/// No jump between two nodes: the axes go nearly straight from one to the other. Where the branch of the
/// inverse changes (axis 5 through 0, wrist centre through axis 1) the place of the change is closed in on,
/// since a turn of half a revolution can hide in a tenth of a millimetre there.
bool MotionPath::isSmoothStep(const PathNode& from, const PathNode& to) const {
    if (largestDifference(from.joints, to.joints) > kLargestStep) return false;
    Joints middle;
    if (!solve(0.5 * (from.s + to.s), from.joints, middle)) return false;
    if (largestDifference(middle, between(from.joints, to.joints, 0.5)) > kLargestBend) return false;
    const int branch = kinematics_.configuration(from.joints).cfx;
    if (branch == kinematics_.configuration(to.joints).cfx) return true;
    double low = 0;
    double high = 1;
    for (int i = 0; i < 24; ++i) {
        const double k = 0.5 * (low + high);
        const double s = from.s + (to.s - from.s) * k;
        if (!solve(s, between(from.joints, to.joints, k), middle)) return false;
        if (largestDifference(middle, between(from.joints, to.joints, k)) > kLargestBend) return false;
        (kinematics_.configuration(middle).cfx == branch ? low : high) = k;
    }
    return true;
}

/// Shoulder and wrist lie along the reference direction of the arm angle, which means nothing there.
bool MotionPath::isArmAngleLost(const Joints& joints) const {
    constexpr double kAlong = 0.05; // deg
    return kinematics_.hasArmAngle() && kinematics_.singularity(joints).armAngleDeg < kAlong;
}

std::optional<MotionError> MotionPath::march() {
    const double turn = std::max(curve_.rotationDeg(), std::fabs(armTravel_));
    constexpr double kCarriedPieces = 64; // of a movement that another robot carries along
    const double carried = frames_.userCourse != nullptr ? kCarriedPieces
                           : frames_.dependsOnAxes()     ? externalTravel() / kCoarseDeg
                                                         : 0;
    const double size = std::max({curve_.length() / kCoarseMm, turn / kCoarseDeg, carried});
    const double coarse = 1.0 / std::ceil(std::clamp(size, 8.0, 4000.0));
    const double finest =
        std::min(coarse, std::max(1e-10, std::min(kFinestMm / std::max(curve_.length(), 1e-12),
                                                  kFinestDeg / std::max(turn, 1e-12))));
    PathNode node{0, start_.robax, 0};
    nodes_.push_back(node);
    double step = coarse;
    while (node.s < 1) {
        PathNode next;
        next.s = node.s + step > 1 - 0.5 * finest ? 1 : node.s + step;
        next.distance = next.s * curve_.length();
        const bool isReached = solve(next.s, node.joints, next.joints);
        if (isReached && isSmoothStep(node, next)) {
            if (auto error = checkNode(next)) return error;
            if (nodes_.size() >= kMostNodes) return errorAt(MotionErrorKind::Singularity, next.s, 0, 0);
            nodes_.push_back(next);
            node = next;
            step = std::min(coarse, 2 * step);
        } else if (step > finest) {
            step *= 0.5;
        } else if (!isReached && !isByWrist_ && !isArmAngleLost(node.joints)) {
            return errorAt(MotionErrorKind::Unreachable, next.s, 0, 0);
        } else if (!isReached) {
            return errorAt(MotionErrorKind::Singularity, next.s, 0, 0);
        } else {
            const int joint = mostDifferent(node.joints, next.joints);
            return errorAt(MotionErrorKind::Singularity, next.s, joint,
                           node.joints[static_cast<std::size_t>(joint) - 1]);
        }
    }
    return {};
}

std::optional<MotionError> MotionPath::checkArrival(const MoveCommand& command) const {
    if (!command.confL || mode_ == SingularityMode::LockAxis4) return {};
    if (isByWrist_) return checkWristArrival(command);
    const robot::Singularity near = kinematics_.singularity(end_.robax);
    const bool isUndecided = near.wristDeg < 0.1 || near.armMm < 0.1 || near.elbowDeg < 0.1 ||
                             near.shoulderDeg < 0.1 || near.armAngleDeg < 0.1 || near.foldDeg < 0.1;
    if (isUndecided) return {}; // two configurations meet here
    const auto wanted = kinematics_.inverse(flangeFor(command.target.pose, 1), command.target.conf,
                                            end_.robax, armAngleAt(1));
    if (wanted && largestDifference(*wanted, end_.robax) < 0.01) return {};
    const int joint = wanted ? mostDifferent(*wanted, end_.robax) : wanted.error().joint;
    return errorAt(MotionErrorKind::ConfigurationMismatch, 1, joint,
                   joint == 0 ? 0 : end_.robax[static_cast<std::size_t>(joint) - 1]);
}

const PathNode& MotionPath::nodeNear(double s) const {
    const auto after = std::upper_bound(nodes_.begin(), nodes_.end(), s,
                                        [](double value, const PathNode& n) { return value < n.s; });
    if (after == nodes_.begin()) return nodes_.front();
    if (after == nodes_.end()) return nodes_.back();
    return s - (after - 1)->s < after->s - s ? *(after - 1) : *after;
}

Joints MotionPath::jointsAt(double s, std::optional<Pose>* tcp) const {
    if (s <= 0) return start_.robax;
    if (s >= 1) return end_.robax;
    if (!isCartesian_ || isEmpty_ || nodes_.size() < 2) return between(start_.robax, end_.robax, s);
    const PathNode& near = nodeNear(s);
    Joints joints;
    return solve(s, near.joints, joints, tcp) ? joints : near.joints;
}

bool MotionPath::seeksJoints(double s, robot::InverseTask& task, std::optional<Pose>& tcp) const {
    const bool isBetween = s > 0 && s < 1 && isCartesian_ && !isEmpty_ && nodes_.size() >= 2;
    if (!isBetween || isByWrist_ || mode_ != SingularityMode::Off) return false;
    const Pose pose = curve_.at(s);
    task.flange = flangeFor(pose, s);
    task.seed = &nodeNear(s).joints;
    task.armAngleDeg = armStart_ + armTravel_ * s;
    tcp = pose;
    return true;
}

ExternalAxes MotionPath::externalAt(double s) const {
    return s >= 1 ? end_.extax : externalNear(std::max(s, 0.0));
}

void MotionPath::setFrames(const FrameSetup& frames) {
    frames_ = frames;
    if (frames_.isMoved()) return;
    const WorkObjectFrame& work = frames_.workObject;
    const Pose object = work.uframe * work.oframe * frames_.displacement;
    const Pose base = robot::inverse(frames_.baseFrame);
    beforeTarget_ = base * (frames_.tool.robotHeld ? object : frames_.tool.tframe);
    afterTarget_ = robot::inverse(frames_.tool.robotHeld ? frames_.tool.tframe : object);
    isBeforeTarget_ = !robot::isIdentity(beforeTarget_);
    isAfterTarget_ = !robot::isIdentity(afterTarget_);
}

Pose MotionPath::flangeOf(const Pose& target, const ExternalAxes& axes, const Pose* user) const {
    if (user != nullptr || frames_.isMoved()) return frames_.toFlange(target, axes, user);
    const Pose held = frames_.tool.robotHeld ? target : robot::inverse(target);
    const Pose placed = isBeforeTarget_ ? chained(beforeTarget_, held) : held;
    return isAfterTarget_ ? chained(placed, afterTarget_) : placed;
}

Pose MotionPath::flangeFor(const Pose& target, double s) const {
    if (!frames_.isMoved()) return flangeOf(target, start_.extax);
    if (frames_.userCourse == nullptr) return frames_.toFlange(target, externalAt(s));
    const Pose user = (*frames_.userCourse)(s);
    return frames_.toFlange(target, externalAt(s), &user);
}

/// Beyond the ends of the path as well.
Pose MotionPath::tcpOf(const Joints& joints, double s) const {
    if (!frames_.isMoved()) return frames_.fromFlange(kinematics_.forward(joints), start_.extax);
    const ExternalAxes axes = externalNear(s);
    if (frames_.userCourse == nullptr) return frames_.fromFlange(kinematics_.forward(joints), axes);
    const Pose user = (*frames_.userCourse)(s);
    return frames_.fromFlange(kinematics_.forward(joints), axes, &user);
}

/// Beyond the ends of the path as well.
ExternalAxes MotionPath::externalNear(double s) const {
    ExternalAxes result = start_.extax;
    for (std::size_t i = 0; i < result.size(); ++i)
        if (isConnected(result[i])) result[i] += (end_.extax[i] - result[i]) * s;
    return result;
}

double MotionPath::externalTravel() const {
    double sum = 0;
    for (std::size_t i = 0; i < start_.extax.size(); ++i)
        if (isConnected(start_.extax[i])) sum += std::abs(end_.extax[i] - start_.extax[i]);
    return sum;
}

double MotionPath::armAngleAt(double s) const {
    if (!kinematics_.hasArmAngle()) return 0;
    return isCartesian_ ? armStart_ + armTravel_ * s : kinematics_.armAngle(jointsAt(s));
}

Pose MotionPath::tcpAt(double s) const {
    const bool isAsProgrammed = mode_ == SingularityMode::Off && !isByWrist_;
    if (isCartesian_ && !isEmpty_ && isAsProgrammed) return curve_.at(std::clamp(s, 0.0, 1.0));
    return tcpOf(jointsAt(s), s);
}

void MotionPath::tcpRatesAt(double s, double& mm, double& deg) const {
    if (isCartesian_) {
        mm = curve_.length();
        deg = curve_.rotationDeg();
        return;
    }
    constexpr double kStep = 1e-4;
    const auto tcp = [&](double at) { return tcpOf(between(start_.robax, end_.robax, at), at); };
    const Pose from = tcp(s - kStep);
    const Pose to = tcp(s + kStep);
    mm = norm(to.pos - from.pos) / (2 * kStep);
    deg = robot::angleBetween(from.rot, to.rot) / (2 * kStep);
}

} // namespace motion
