#include "stdlib/impl/guided_motion/guided_arm.h"

#include "stdlib/impl/motion/world_zones.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rt::lib {
namespace {

constexpr double kSeconds = static_cast<double>(GuidedArm::kPeriod) * 1e-9;
constexpr double kNear = 1e-6; // deg: an axis that is so near to its goal is put there
constexpr double kFar = 1e-3;  // deg: a limit that cuts off less is not reported

/// The limits of one axis: deg or mm, s.
struct AxisLimits {
    double lower, upper, speed, acceleration;
};

/// The speed with which an axis comes nearer to its goal: in proportion to the distance where that needs no more than its
/// acceleration, further away as fast as it can still brake.
double approach(double difference, double gain, double acceleration) {
    constexpr double kReserve = 0.95; // periods are steps
    if (gain <= 0) return 0;
    const double braking = kReserve * acceleration, near = braking / (gain * gain);
    const double distance = std::fabs(difference);
    if (distance <= near) return gain * difference;
    return std::copysign(std::sqrt(2 * braking * (distance - near / 2)), difference);
}

/// One period of an axis towards its goal, with `gain` times its distance a second and a speed that is asked for besides;
/// `pace` of that when all axes slow down.
void follow(double& position, double& speed, double goal, double gain, double speedRequested,
            const AxisLimits& limits, double pace = 1) {
    const double difference = goal - position;
    if (speedRequested == 0 && std::fabs(difference) < kNear && std::fabs(speed) * kSeconds < kNear) {
        if (gain > 0) position = goal;
        speed = 0;
        return;
    }
    const double wanted =
        std::clamp(pace * (approach(difference, gain, limits.acceleration) + speedRequested), -limits.speed,
                   limits.speed);
    const double change = limits.acceleration * kSeconds;
    speed = std::clamp(wanted, speed - change, speed + change);
    position = std::clamp(position + speed * kSeconds, std::min(limits.lower, position),
                          std::max(limits.upper, position));
}

} // namespace

motion::FrameSetup basedFrames(MotionDriver& motion, motion::FrameSetup frames) {
    const motion::MotionSystem& arm = motion.system();
    const motion::JointTarget joints = arm.currentJoints();
    frames.baseFrame = arm.flangeInWorld(joints) * inverse(arm.kinematics().forward(joints.robax));
    frames.baseMover = nullptr; // additional axes do not move meanwhile
    return frames;
}

motion::Pose guidedTcp(MotionDriver& motion, const motion::FrameSetup& frames,
                       const motion::JointTarget& joints) {
    return frames.tcpInWorld(motion.system().kinematics().forward(joints.robax), joints.extax);
}

motion::Pose guidanceFrame(MotionDriver& motion, const motion::FrameSetup& frames, int type) {
    const motion::JointTarget joints = motion.system().currentJoints();
    const motion::Pose tcp = guidedTcp(motion, frames, joints);
    switch (type) {
    case 0: return frames.baseFrame;
    case kToolFrame: return tcp;
    case 2:
        return tcp *
               inverse(frames.fromFlange(motion.system().kinematics().forward(joints.robax), joints.extax));
    default: return {};
    }
}

bool GuidanceOrder::movesRobot() const {
    return std::find(named.begin(), named.end(), true) != named.end();
}

GuidedArm::GuidedArm(MotionDriver& motion, const GuidanceSettings& settings, const GuidanceOrder& order)
    : motion_(motion), settings_(settings), order_(order), start_(motion.system().currentJoints()),
      now_(start_), speed_(motion::Joints::zeros(start_.robax.size())), filtered_(start_.robax),
      wanted_(start_.robax) {
    settings_.frames = basedFrames(motion, settings_.frames);
    sensorInWorld_ = guidanceFrame(motion, settings_.frames, settings.sensorType) * settings.sensorFrame;
    objectInWorld_ = guidanceFrame(motion, settings_.frames, 2);
    wantedPose_ = inverse(sensorInWorld_) * guidedTcp(motion, settings_.frames, start_);
}

/// The axes that the instruction names and the data ask for; the others stay where they began.
motion::Joints GuidedArm::target(const SensorData& data) {
    if (settings_.mode == GuidanceMode::Pose) return targetOfPose(data);
    motion::Joints wanted = start_.robax;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const auto number = static_cast<std::size_t>(motion_.system().kinematics().axisNumber(i));
        if (order_.named[number - 1] && data.joints[number - 1]) wanted[i] = *data.joints[number - 1];
    }
    return wanted;
}

motion::Joints GuidedArm::targetOfPose(const SensorData& data) {
    const motion::Pose from = inverse(sensorInWorld_) * guidedTcp(motion_, settings_.frames, start_);
    motion::Vec3 pos = from.pos, angles = robot::eulerZyx(from.rot);
    double* const places[] = {&pos.x, &pos.y, &pos.z, &angles.x, &angles.y, &angles.z};
    std::array<std::optional<double>, 6> asked = data.pose;
    const auto& named = order_.named;
    const bool turnsFreely = named[3] && named[4] && named[5];
    if (data.orientation && !turnsFreely) {
        const motion::Vec3 turned = robot::eulerZyx(*data.orientation);
        asked[3] = turned.x;
        asked[4] = turned.y;
        asked[5] = turned.z;
    }
    bool turns = false;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        if (!named[i] || !asked[i]) continue;
        *places[i] = *asked[i];
        turns = turns || i >= 3;
    }
    const motion::Quat rot = turnsFreely && data.orientation ? *data.orientation
                             : turns ? robot::fromEulerZyx(angles.z, angles.y, angles.x)
                                     : from.rot;
    wantedPose_ = motion::Pose{pos, rot} * order_.offset;
    motion::RobTarget robTarget;
    robTarget.pose = inverse(objectInWorld_) * sensorInWorld_ * wantedPose_;
    robTarget.extax = now_.extax;
    const motion::Pose flange = settings_.frames.toFlange(robTarget.pose, now_.extax);
    const auto joints =
        motion::solveTarget(motion_.system().kinematics(), flange, robTarget, false, now_.robax);
    if (joints) return *joints;
    limit_ = motion::targetError(joints.error(), robTarget.pose.pos).message();
    return wanted_; // the last one that could be reached
}

/// The speed of each axis with which the TCP moves as asked for from where it is, deg/s.
motion::Joints GuidedArm::speedOfPose(const SensorData& data) const {
    motion::Joints speed = motion::Joints::zeros(now_.robax.size());
    auto asked = data.poseSpeed;
    for (std::size_t i = 0; i < asked.size(); ++i)
        if (!order_.named[i]) asked[i] = 0;
    if (std::all_of(asked.begin(), asked.end(), [](double value) { return value == 0; })) return speed;
    motion::Pose next = inverse(sensorInWorld_) * guidedTcp(motion_, settings_.frames, now_);
    next.pos = next.pos + motion::Vec3{asked[0], asked[1], asked[2]} * kSeconds;
    const motion::Vec3 turn = motion::Vec3{asked[3], asked[4], asked[5]} * kSeconds;
    if (const double angle = norm(turn); angle > 0)
        next.rot = robot::fromAxisAngle(turn * (1 / angle), angle) * next.rot;
    motion::RobTarget target;
    target.pose = inverse(objectInWorld_) * sensorInWorld_ * next;
    target.extax = now_.extax;
    const motion::Pose flange = settings_.frames.toFlange(target.pose, now_.extax);
    const auto joints = motion::solveTarget(motion_.system().kinematics(), flange, target, false, now_.robax);
    if (!joints) return speed; // at the border of what can be reached
    for (std::size_t i = 0; i < speed.size(); ++i)
        speed[i] = ((*joints)[i] - now_.robax[i]) / kSeconds;
    return speed;
}

/// The range of an axis and the deviation that is allowed.
Window GuidedArm::rangeOf(std::size_t axis) const {
    const robot::RobotModel& model = motion_.model();
    const double high = std::min(model.upperDeg[axis], start_.robax[axis] + settings_.maxDeviation);
    const double low = std::max(model.lowerDeg[axis], start_.robax[axis] - settings_.maxDeviation);
    return {std::min(low, high), high};
}

motion::Joints GuidedArm::limited(motion::Joints wanted) {
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const auto [low, high] = rangeOf(i);
        const double inside = std::clamp(wanted[i], low, high);
        if (std::fabs(inside - wanted[i]) > kFar && limit_.empty())
            limit_ =
                fmt::format("axis {} is asked to go to {:.2f} and may go from {:.2f} to {:.2f}. Send other "
                            "values, or give \\MaxPosDeviation a larger one",
                            motion_.system().kinematics().axisNumber(i), wanted[i], low, high);
        wanted[i] = inside;
    }
    return wanted;
}

void GuidedArm::follow(const SensorData& data, double share) {
    limit_.clear();
    const auto moves = [](double speed) { return speed != 0; };
    if (std::any_of(additionalSpeed_.begin(), additionalSpeed_.end(), moves))
        settings_.frames = basedFrames(motion_, settings_.frames); // an additional axis may carry the base
    wanted_ = limited(target(data));
    const double part =
        settings_.filterHz > 0 ? 1 - std::exp(-2 * std::numbers::pi * settings_.filterHz * kSeconds) : 1;
    isSteady_ = share >= 1;
    const motion::Joints asked = speedRequested(data);
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
        filtered_[i] += part * (wanted_[i] - filtered_[i]);
        if (std::fabs(wanted_[i] - filtered_[i]) < kNear) filtered_[i] = wanted_[i];
    }
    const double pace = paceTowards(filtered_, order_.gain * share, asked);
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
        moveAxis(i, filtered_[i], order_.gain * share, asked[i], pace);
        isSteady_ = isSteady_ && speed_[i] == 0 && (filtered_[i] == wanted_[i]);
    }
    moveAdditional(data, order_.gain * share);
    place(speedNow());
}

/// The speed of each axis that the data ask for, deg/s.
motion::Joints GuidedArm::speedRequested(const SensorData& data) const {
    if (settings_.mode == GuidanceMode::Pose) return speedOfPose(data);
    motion::Joints speed = motion::Joints::zeros(now_.robax.size());
    for (std::size_t i = 0; i < speed.size(); ++i) {
        const auto number = static_cast<std::size_t>(motion_.system().kinematics().axisNumber(i));
        if (!order_.named[number - 1]) continue;
        speed[i] = number <= data.jointSpeed.size() ? data.jointSpeed[number - 1] : data.additionalSpeed[0];
    }
    return speed;
}

double GuidedArm::highestSpeed(std::size_t axis) const {
    return std::min(settings_.maxSpeed, motion_.model().maxSpeed[axis]);
}

double GuidedArm::paceTowards(const motion::Joints& goal, double gain, const motion::Joints& asked) const {
    double pace = 1;
    if (settings_.mode != GuidanceMode::Pose) return pace;
    for (std::size_t i = 0; i < goal.size(); ++i) {
        const double wanted =
            approach(goal[i] - now_.robax[i], gain, motion_.model().maxAcceleration[i]) + asked[i];
        if (const double highest = highestSpeed(i); std::fabs(wanted) * pace > highest)
            pace = highest / std::fabs(wanted);
    }
    return pace;
}

void GuidedArm::moveAxis(std::size_t axis, double goal, double gain, double speedRequested, double pace) {
    const Window range = rangeOf(axis);
    const AxisLimits limits{range.low, range.high, highestSpeed(axis), motion_.model().maxAcceleration[axis]};
    ::rt::lib::follow(now_.robax[axis], speed_[axis], goal, gain, speedRequested, limits, pace);
}

/// Additional axes, within their ranges.
void GuidedArm::moveAdditional(const SensorData& data, double gain) {
    const motion::ExternalAxisModels& axes = motion_.system().externalAxes();
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (!axes[i].present || !motion::isConnected(now_.extax[i]) || !data.additional[i]) continue;
        const double low = std::max(axes[i].lower, start_.extax[i] - settings_.maxDeviation);
        const double high = std::min(axes[i].upper, start_.extax[i] + settings_.maxDeviation);
        const double wanted = *data.additional[i];
        const double goal = std::clamp(wanted, std::min(low, high), high);
        if (std::fabs(goal - wanted) > kFar && limit_.empty())
            limit_ =
                fmt::format("additional axis {} is asked to go to {:.2f} and may go from {:.2f} to {:.2f}. "
                            "Send other values, or give \\MaxPosDeviation a larger one",
                            static_cast<char>('a' + i), wanted, low, high);
        ::rt::lib::follow(
            now_.extax[i], additionalSpeed_[i], goal, gain, data.additionalSpeed[i],
            {low, high, std::min(settings_.maxSpeed, axes[i].maxSpeed), axes[i].maxAcceleration});
        isSteady_ = isSteady_ && additionalSpeed_[i] == 0;
    }
}

void GuidedArm::brake() {
    for (std::size_t i = 0; i < speed_.size(); ++i) {
        const double change = motion_.model().maxAcceleration[i] * kSeconds;
        speed_[i] -= std::clamp(speed_[i], -change, change);
        now_.robax[i] += speed_[i] * kSeconds;
    }
    const motion::ExternalAxisModels& axes = motion_.system().externalAxes();
    for (std::size_t i = 0; i < additionalSpeed_.size(); ++i) {
        const double change = axes[i].maxAcceleration * kSeconds;
        additionalSpeed_[i] -= std::clamp(additionalSpeed_[i], -change, change);
        if (additionalSpeed_[i] != 0) now_.extax[i] += additionalSpeed_[i] * kSeconds;
    }
    filtered_ = now_.robax;
    place(speedNow());
}

bool GuidedArm::isStanding() const {
    const auto stands = [](double speed) { return speed == 0; };
    return std::all_of(speed_.begin(), speed_.end(), stands) &&
           std::all_of(additionalSpeed_.begin(), additionalSpeed_.end(), stands);
}

/// The way is passed evenly at its middle with 1.5 times the mean speed.
double GuidedArm::beginWayBack() {
    wayBackFrom_ = now_;
    double seconds = 0;
    const motion::ExternalAxisModels& axes = motion_.system().externalAxes();
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (!motion::isConnected(now_.extax[i])) continue;
        const double way = std::fabs(now_.extax[i] - start_.extax[i]);
        seconds =
            std::max({seconds, 1.5 * way / axes[i].maxSpeed, std::sqrt(6 * way / axes[i].maxAcceleration)});
    }
    for (std::size_t i = 0; i < start_.robax.size(); ++i) {
        const double way = std::fabs(wayBackFrom_.robax[i] - start_.robax[i]);
        seconds = std::max({seconds, 1.5 * way / motion_.model().maxSpeed[i],
                            std::sqrt(6 * way / motion_.model().maxAcceleration[i])});
    }
    return seconds;
}

void GuidedArm::placeOnWayBack(double share) {
    const double s = std::clamp(share, 0.0, 1.0), done = s * s * (3 - 2 * s);
    const motion::JointTarget before = now_;
    motion::JointTarget speed;
    speed.robax = motion::Joints::zeros(now_.robax.size());
    const auto pass = [&](double from, double to, double was, double& now, double& rate) {
        now = from + (to - from) * done;
        rate = s < 1 ? (now - was) / kSeconds : 0;
    };
    for (std::size_t i = 0; i < start_.robax.size(); ++i)
        pass(wayBackFrom_.robax[i], start_.robax[i], before.robax[i], now_.robax[i], speed.robax[i]);
    for (std::size_t i = 0; i < start_.extax.size(); ++i)
        if (motion::isConnected(now_.extax[i]))
            pass(wayBackFrom_.extax[i], start_.extax[i], before.extax[i], now_.extax[i], speed.extax[i]);
    place(speed);
}

/// The speeds last a little longer than a period, so that the arm does not come to rest between two of them.
void GuidedArm::place(const motion::JointTarget& speed) {
    if (lost_) return;
    if (!motion_.system().isIdle() || !motion_.system().leadTo(now_, speed, kPeriod + kPeriod / 2)) {
        lost_ = true;
        return;
    }
    motion_.refresh();
    motion_.service<WorldZones>().noteMotion();
}

bool GuidedArm::isConverged() const {
    if (!order_.movesRobot()) return false;
    std::array<double, 7> difference{};
    if (settings_.mode == GuidanceMode::Pose) {
        const motion::Pose is = inverse(sensorInWorld_) * guidedTcp(motion_, settings_.frames, now_);
        const motion::Vec3 way = wantedPose_.pos - is.pos;
        const motion::Vec3 turn = robot::eulerZyx(conjugate(is.rot) * wantedPose_.rot);
        difference = {way.x, way.y, way.z, turn.x, turn.y, turn.z, 0};
    } else {
        for (std::size_t i = 0; i < wanted_.size(); ++i) {
            const auto number = static_cast<std::size_t>(motion_.system().kinematics().axisNumber(i));
            difference[number - 1] = wanted_[i] - now_.robax[i];
        }
    }
    for (std::size_t i = 0; i < difference.size(); ++i) {
        const Window& window = settings_.windows[i];
        if (order_.named[i] && !(difference[i] >= window.low && difference[i] <= window.high)) return false;
    }
    return true;
}

} // namespace rt::lib
