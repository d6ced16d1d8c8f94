#include "runtime/host/jogging.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rt {

namespace {

using motion::kModifierPeriod;
using motion::kModifierSeconds;

constexpr double kRampTime = 0.25; // s from rest to a share of 1
constexpr double kRamp = 1 / kRampTime;

bool isZero(const motion::Vec3& v) {
    return v.x == 0 && v.y == 0 && v.z == 0;
}

template <class Figures> double largestOf(const Figures& figures) {
    double most = 0;
    for (const double figure : figures)
        most = std::max(most, std::fabs(figure));
    return most;
}

/// Within what the computation of a posture may differ.
bool isSamePosture(const motion::JointTarget& a, const motion::JointTarget& b) {
    constexpr double kTolerance = 0.01; // degrees, mm
    for (std::size_t i = 0; i < a.robax.size(); ++i)
        if (i >= b.robax.size() || std::fabs(a.robax[i] - b.robax[i]) > kTolerance) return false;
    for (std::size_t i = 0; i < a.extax.size(); ++i)
        if (std::fabs(a.extax[i] - b.extax[i]) > kTolerance) return false;
    return true;
}

bool isSame(const JogOrder& a, const JogOrder& b) {
    if (a.goal || b.goal) return a.goal && b.goal && isSamePosture(*a.goal, *b.goal);
    return a.joints == b.joints && a.external == b.external && a.line == b.line && a.turn == b.turn &&
           a.frame == b.frame && a.increment == b.increment && sameTool(a.frames, b.frames) &&
           sameFrames(a.frames, b.frames);
}

} // namespace

bool JogOrder::isLinear() const {
    return !isZero(line) || !isZero(turn);
}

bool JogOrder::moves() const {
    return isLinear() || largestOf(joints) > 0 || largestOf(external) > 0;
}

JogOrder jogOrderTo(const motion::JointTarget& from, const motion::JointTarget& goal) {
    JogOrder order;
    double most = 0;
    for (std::size_t i = 0; i < from.robax.size() && i < goal.robax.size(); ++i)
        most = std::max(most, std::fabs(order.joints[i] = goal.robax[i] - from.robax[i]));
    for (std::size_t i = 0; i < from.extax.size(); ++i)
        if (motion::isConnected(from.extax[i]) && motion::isConnected(goal.extax[i]))
            most = std::max(most, std::fabs(order.external[i] = goal.extax[i] - from.extax[i]));
    order.goal = goal;
    if (most < 1e-6) return order; // there already
    for (double& share : order.joints)
        share /= most;
    for (double& share : order.external)
        share /= most;
    order.increment = most;
    return order;
}

Jogging::Jogging(Scheduler& scheduler, MotionDriver& motion) : scheduler_(scheduler), motion_(motion) {
    motion_.addListener([this, alive = std::weak_ptr(alive_)](ArmChange change) {
        if (alive.expired() || !isActive_) return;
        if (change == ArmChange::Start || change == ArmChange::MotorsOff) finish();
    });
}

Jogging::~Jogging() {
    if (isActive_) finish();
}

std::string Jogging::order(const JogOrder& order) {
    const auto isShare = [](double value) { return std::fabs(value) <= 1; };
    const bool inRange = std::all_of(order.joints.begin(), order.joints.end(), isShare) &&
                         std::all_of(order.external.begin(), order.external.end(), isShare) &&
                         isShare(order.line.x) && isShare(order.line.y) && isShare(order.line.z) &&
                         isShare(order.turn.x) && isShare(order.turn.y) && isShare(order.turn.z);
    if (!inRange) return "speeds of jogging are shares from -1 to 1"; // NaN is refused as well
    if (!order.moves()) {
        stop();
        return {};
    }
    if (order.isLinear() && (largestOf(order.joints) > 0 || largestOf(order.external) > 0))
        return "the TCP and single axes do not move together";
    if (order.increment && !(*order.increment > 0 && *order.increment <= 10'000))
        return "an increment is greater than 0 and at most 10000 mm or degrees";
    if (isActive_ && isSame(order, order_) && (!order.increment || order.goal) && !next_) {
        until_ = scheduler_.now() + order.holdTime;
        isStopping_ = false;
        return {};
    }
    if (isActive_) {
        next_ = order;
        return {};
    }
    if (motion_.system().isMoving()) return "the robot moves";
    order_ = order;
    begin();
    return isActive_ ? std::string() : limit_;
}

void Jogging::stop() {
    next_.reset();
    isStopping_ = true;
}

void Jogging::begin() {
    limit_.clear();
    axisSpeed_ = order_.isLinear() ? 0 : commonSpeed();
    hasStored_ = motion_.system().storePath();
    now_ = motion_.system().currentJoints();
    if (!hasStored_ || !after(kModifierSeconds * kModifierSeconds * kRamp)) {
        if (limit_.empty()) limit_ = "the robot cannot be moved now";
        finish();
        return;
    }
    isActive_ = true;
    isStopping_ = false;
    share_ = 0;
    remaining_ = HUGE_VAL;
    if (order_.increment) {
        const double tcpSpeed = isZero(order_.line) ? JogSpeeds::kTurn : JogSpeeds::kLine;
        remaining_ = *order_.increment / (order_.isLinear() ? tcpSpeed : axisSpeed_);
    }
    const bool lasts = order_.increment && !order_.goal;
    until_ = lasts ? kNever : scheduler_.now() + order_.holdTime;
    event_ = scheduler_.after(kModifierPeriod, [this] { step(); });
}

void Jogging::finish() {
    if (isActive_) scheduler_.cancel(event_);
    isActive_ = false;
    share_ = 0;
    motion::JointTarget rest = now_;
    rest.robax = motion::Joints::zeros(now_.robax.size());
    if (hasStored_) {
        (void)motion_.system().leadTo(now_, rest, kModifierPeriod); // at rest
        (void)motion_.system().restorePath();
        hasStored_ = false;
    }
    motion_.refresh();
}

/// The share of full speed that the next period begins with.
double Jogging::speedRequested(double dt) const {
    if (isStopping_ || next_ || scheduler_.now() >= until_) return 0;
    return std::min(1.0, std::sqrt(2 * kRamp * std::max(0.0, remaining_ - share_ * dt)));
}

void Jogging::step() {
    double wanted = speedRequested(kModifierSeconds);
    const double braking = share_ * share_ / (2 * kRamp) + 2 * share_ * kModifierSeconds;
    if (wanted > 0 && share_ > 0 && !after(braking)) wanted = 0; // a limit comes nearer
    const double before = share_;
    share_ += std::clamp(wanted - share_, -kRamp * kModifierSeconds, kRamp * kModifierSeconds);
    double way = share_ * kModifierSeconds;
    const bool isLast = way >= remaining_ || (order_.increment && wanted < kRamp * kModifierSeconds &&
                                              before > 0 && remaining_ < kModifierSeconds);
    if (isLast) way = remaining_;
    const bool isAtRest = share_ <= 0 || isLast;
    if (way > 0 && std::isfinite(way)) {
        const auto next = after(way);
        if (!next) return finish();
        motion::JointTarget speed = *next;
        for (std::size_t i = 0; i < speed.robax.size(); ++i)
            speed.robax[i] = (next->robax[i] - now_.robax[i]) / kModifierSeconds;
        for (std::size_t i = 0; i < speed.extax.size(); ++i)
            if (motion::isConnected(speed.extax[i]))
                speed.extax[i] = (next->extax[i] - now_.extax[i]) / kModifierSeconds;
        now_ = *next;
        remaining_ -= way;
        if (!motion_.system().leadTo(now_, speed, kModifierPeriod + kModifierPeriod / 2)) return finish();
        motion_.refresh();
    }
    if (!isAtRest) {
        event_ = scheduler_.after(kModifierPeriod, [this] { step(); });
        return;
    }
    const std::optional<JogOrder> next = std::exchange(next_, std::nullopt);
    finish();
    if (!next) return;
    order_ = *next;
    begin();
}

// ---- Where the arm goes --------------------------------------------------------------------------------------------

std::optional<motion::JointTarget> Jogging::after(double seconds) {
    auto there = order_.isLinear() ? afterLine(seconds) : afterAxes(seconds);
    if (!there || !isWithin(*there)) return std::nullopt;
    return there;
}

double Jogging::speedOfJoint(std::size_t i) const {
    return std::min(motion_.model().maxSpeed[i] * JogSpeeds::kJointShare, JogSpeeds::kMostJoint);
}

double Jogging::speedOfExternal(std::size_t i) const {
    return motion_.system().externalAxes()[i].maxSpeed * JogSpeeds::kJointShare;
}

/// The speed with which all axes of an increment move their amounts, deg/s or mm/s; the TCP keeps its limit.
double Jogging::commonSpeed() const {
    const motion::JointTarget here = motion_.system().currentJoints();
    motion::JointTarget there = here;
    double speed = HUGE_VAL;
    for (std::size_t i = 0; i < there.robax.size(); ++i) {
        if (order_.joints[i] != 0) speed = std::min(speed, speedOfJoint(i));
        there.robax[i] += order_.joints[i];
    }
    for (std::size_t i = 0; i < there.extax.size(); ++i)
        if (order_.external[i] != 0) speed = std::min(speed, speedOfExternal(i));
    const double way = tcpWay(here, there);
    return way > 0 ? std::min(speed, JogSpeeds::kLine / way) : speed;
}

std::optional<motion::JointTarget> Jogging::afterAxes(double seconds) {
    motion::JointTarget there = now_;
    for (std::size_t i = 0; i < there.robax.size(); ++i)
        there.robax[i] += order_.joints[i] * seconds * (order_.increment ? axisSpeed_ : speedOfJoint(i));
    for (std::size_t i = 0; i < there.extax.size(); ++i) {
        if (order_.external[i] == 0) continue;
        if (!motion::isConnected(there.extax[i])) {
            limit_ = fmt::format("external axis {} is not active", static_cast<char>('a' + i));
            return std::nullopt;
        }
        there.extax[i] += order_.external[i] * seconds * (order_.increment ? axisSpeed_ : speedOfExternal(i));
    }
    const double way = tcpWay(now_, there), most = JogSpeeds::kLine * seconds;
    if (order_.increment || way <= most) return there;
    for (std::size_t i = 0; i < there.robax.size(); ++i) // no faster than the TCP may be
        there.robax[i] = now_.robax[i] + (there.robax[i] - now_.robax[i]) * most / way;
    for (std::size_t i = 0; i < there.extax.size(); ++i)
        if (motion::isConnected(there.extax[i]))
            there.extax[i] = now_.extax[i] + (there.extax[i] - now_.extax[i]) * most / way;
    return there;
}

std::optional<motion::JointTarget> Jogging::afterLine(double seconds) {
    const motion::MotionSystem& system = motion_.system();
    const motion::Pose flange = system.flangeInWorld(now_);
    const motion::Pose base = flange * inverse(system.kinematics().forward(now_.robax));
    const motion::Pose tool = order_.frames.tool.robotHeld ? order_.frames.tool.tframe : motion::Pose();
    motion::Pose tcp = flange * tool;
    motion::Quat frame; // its axes in world
    const motion::WorkObjectFrame& object = order_.frames.workObject;
    switch (order_.frame) {
    case JogFrame::World: break;
    case JogFrame::Base: frame = base.rot; break;
    case JogFrame::Tool: frame = tcp.rot; break;
    case JogFrame::WorkObject:
        frame = object.robotHeld ? motion::Quat() : (object.uframe * object.oframe).rot;
        break;
    }
    tcp.pos = tcp.pos + rotate(frame, order_.line) * (JogSpeeds::kLine * seconds);
    if (const double size = norm(order_.turn); size > 0) {
        const motion::Vec3 axis = rotate(frame, order_.turn * (1 / size));
        tcp.rot = normalized(robot::fromAxisAngle(axis, size * JogSpeeds::kTurn * seconds) * tcp.rot);
    }
    motion::JointTarget there = now_;
    if (system.kinematics().inverseContinue(inverse(base) * tcp * inverse(tool), now_.robax, there.robax))
        return there;
    limit_ = "the position is out of reach";
    return std::nullopt;
}

bool Jogging::isWithin(const motion::JointTarget& joints) {
    const motion::MotionSystem& system = motion_.system();
    const robot::Kinematics& kinematics = system.kinematics();
    // An axis that is outside already may come back.
    if (const int axis = kinematics.jointOutsideLimits(joints.robax); axis != 0) {
        const auto i = static_cast<std::size_t>(axis - 1);
        const double middle = (kinematics.lowerDeg()[i] + kinematics.upperDeg()[i]) / 2;
        const bool comesBack = kinematics.jointOutsideLimits(now_.robax) == axis &&
                               std::fabs(joints.robax[i] - middle) < std::fabs(now_.robax[i] - middle);
        if (!comesBack) {
            limit_ = fmt::format("axis {} is at the limit of its range", kinematics.axisNumber(i));
            return false;
        }
    }
    const motion::ExternalAxisModels& axes = system.externalAxes();
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (!motion::isConnected(joints.extax[i]) || joints.extax[i] == now_.extax[i]) continue;
        if (joints.extax[i] >= axes[i].lower - 1e-9 && joints.extax[i] <= axes[i].upper + 1e-9) continue;
        limit_ = fmt::format("external axis {} is at the limit of its range", static_cast<char>('a' + i));
        return false;
    }
    if (!order_.isLinear()) return true;
    for (std::size_t i = 0; i < joints.robax.size(); ++i) {
        // near a singularity the wrist would have to be faster than it can
        const double most = motion_.model().maxSpeed[i] * std::max(kModifierSeconds, share_ * kRampTime);
        if (std::fabs(joints.robax[i] - now_.robax[i]) <= most) continue;
        limit_ =
            fmt::format("axis {} would be too fast: the arm is near a singularity", kinematics.axisNumber(i));
        return false;
    }
    return true;
}

double Jogging::tcpWay(const motion::JointTarget& from, const motion::JointTarget& to) const {
    const motion::MotionSystem& system = motion_.system();
    const motion::Pose tool = order_.frames.tool.robotHeld ? order_.frames.tool.tframe : motion::Pose();
    return norm((system.flangeInWorld(to) * tool).pos - (system.flangeInWorld(from) * tool).pos);
}

} // namespace rt
