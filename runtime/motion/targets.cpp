// Frames between a programmed pose and the flange, and the words for what can go wrong.

#include "runtime/motion/targets.h"

#include <fmt/format.h>

#include <cmath>

namespace motion {

namespace {

std::string axisName(int joint) {
    if (joint == 0) return "an axis";
    if (joint < robot::kFirstExternalAxis) return fmt::format("axis {}", joint);
    return fmt::format("external axis {}", static_cast<char>('a' + joint - robot::kFirstExternalAxis));
}

} // namespace

MotionError targetError(const robot::IkError& error, const Vec3& position) {
    MotionError result;
    switch (error.kind) {
    case robot::IkErrorKind::Unreachable: result.kind = MotionErrorKind::Unreachable; break;
    case robot::IkErrorKind::OutOfJointLimits: result.kind = MotionErrorKind::JointOutOfRange; break;
    case robot::IkErrorKind::OutOfElbowLimits: result.kind = MotionErrorKind::ElbowOutOfRange; break;
    case robot::IkErrorKind::NoSuchConfiguration: result.kind = MotionErrorKind::NoSuchConfiguration; break;
    }
    result.joint = error.joint;
    result.value = error.angleDeg;
    result.pathFraction = 1;
    result.position = position;
    return result;
}

Pose FrameSetup::object(const ExternalAxes& axes, const Pose* user) const {
    const Pose frame = user != nullptr        ? *user
                       : userMover == nullptr ? workObject.uframe
                                              : userMover->frame(axes);
    return chained(chained(frame, workObject.oframe), displacement);
}

Pose FrameSetup::toFlange(const Pose& target, const ExternalAxes& axes, const Pose* user) const {
    const Pose place = chained(object(axes, user), target);
    const Pose world = inverse(base(axes));
    if (tool.robotHeld) return chained(chained(world, place), inverse(tool.tframe));
    // The robot holds the work object: uframe counts from the flange and the tool is fixed in world.
    return chained(chained(world, tool.tframe), inverse(place));
}

Pose FrameSetup::fromFlange(const Pose& flange, const ExternalAxes& axes, const Pose* user) const {
    const Pose world = chained(base(axes), flange);
    const Pose object = inverse(this->object(axes, user));
    return chained(chained(object, tool.robotHeld ? world : inverse(world)), tool.tframe);
}

Pose FrameSetup::tcpInWorld(const Pose& flange, const ExternalAxes& axes) const {
    return tool.robotHeld ? chained(chained(base(axes), flange), tool.tframe) : tool.tframe;
}

bool sameTool(const FrameSetup& a, const FrameSetup& b) {
    return a.tool.robotHeld == b.tool.robotHeld && a.tool.tframe == b.tool.tframe &&
           a.workObject.robotHeld == b.workObject.robotHeld && a.userMover == b.userMover &&
           a.carrier == b.carrier && a.carrierUnit == b.carrierUnit;
}

bool sameFrames(const FrameSetup& a, const FrameSetup& b) {
    // A user frame that something moves is where that is, and its own pose does not count.
    const bool isUserMoved = a.carrier != nullptr || a.userMover != nullptr;
    return sameTool(a, b) && (isUserMoved || a.workObject.uframe == b.workObject.uframe) &&
           a.workObject.oframe == b.workObject.oframe && a.displacement == b.displacement &&
           a.baseFrame == b.baseFrame && a.baseMover == b.baseMover;
}

Pose poseFromFloats(const float* trans, const float* rot) {
    const Quat q{rot[0], rot[1], rot[2], rot[3]};
    return {{trans[0], trans[1], trans[2]}, robot::normalized(q)};
}

void poseToFloats(const Pose& pose, float* trans, float* rot) {
    trans[0] = static_cast<float>(pose.pos.x);
    trans[1] = static_cast<float>(pose.pos.y);
    trans[2] = static_cast<float>(pose.pos.z);
    rot[0] = static_cast<float>(pose.rot.w);
    rot[1] = static_cast<float>(pose.rot.x);
    rot[2] = static_cast<float>(pose.rot.y);
    rot[3] = static_cast<float>(pose.rot.z);
}

std::string MotionError::message() const {
    const std::string share =
        pathFraction < 1 ? fmt::format("at {:.1f} % of the path", 100 * pathFraction) : "at the target";
    const std::string place =
        fmt::format("{}, [{:.2f}, {:.2f}, {:.2f}]", share, position.x, position.y, position.z);
    switch (kind) {
    case MotionErrorKind::BadArgument:
        return fmt::format("{} ({:.6g}) cannot be used for a move", what, value);
    case MotionErrorKind::Unreachable:
        return fmt::format("position outside the reach of the robot {}; move the target or the work object",
                           place);
    case MotionErrorKind::JointOutOfRange:
        return fmt::format(
            "{} would have to go to {:.2f}, outside its range, {}; change the target or its configuration",
            axisName(joint), value, place);
    case MotionErrorKind::ElbowOutOfRange:
        return fmt::format(
            "lower and upper arm would be at {:.2f} degrees to each other, outside the range of the "
            "rods, {}; move the target or the work object",
            value, place);
    case MotionErrorKind::NoSuchConfiguration:
        return fmt::format(
            "the position does not have the programmed configuration ({}); correct its confdata",
            joint == 0 ? std::string("cfx") : fmt::format("axis {} at {:.2f} degrees", joint, value));
    case MotionErrorKind::ConfigurationMismatch:
        return fmt::format(
            "the path would arrive in another configuration than programmed ({} at {:.2f} degrees); "
            "correct the confdata or use ConfL\\Off",
            axisName(joint), value);
    case MotionErrorKind::Singularity:
        return fmt::format("too close to a singularity ({}) {}; keep away from it or move axis by axis",
                           axisName(joint), place);
    case MotionErrorKind::CirclePointsTooClose:
        return fmt::format("points of the circle are only {:.3f} mm apart; 0.1 mm is the least", value);
    case MotionErrorKind::CirclePointsCollinear:
        return "the circle point lies on the line through start and end, but not between them";
    case MotionErrorKind::CircleTooLarge:
        return fmt::format("circle of {:.1f} degrees in one move; 240 is the most, divide it", value);
    case MotionErrorKind::QueueFull:
        return fmt::format("{:.0f} moves are ordered already; wait for one to end", value);
    }
    return {};
}

Expected<Joints, robot::IkError> solveTarget(const robot::Kinematics& kinematics, const Pose& flange,
                                             const RobTarget& target, bool exactConf, const Joints& seed) {
    const auto at = [&](double armAngle) {
        return exactConf ? kinematics.inverse(flange, target.conf, seed, armAngle)
                         : kinematics.inverseNear(flange, seed, armAngle);
    };
    const auto first = at(target.armAngle);
    if (first || !kinematics.hasArmAngle() || !std::isnan(target.armAngle)) return first;
    const double kept = kinematics.armAngle(seed);
    constexpr int kStep = 5; // deg
    for (int away = kStep; away <= 180; away += kStep) {
        for (const int side : {1, -1}) {
            auto other = at(std::remainder(kept + side * away, 360.0));
            if (other) return other;
        }
    }
    return first;
}

Expected<JointTarget, MotionError> calcJointTarget(const robot::Kinematics& kinematics,
                                                   const RobTarget& target, const FrameSetup& frames,
                                                   const Joints& seed) {
    if (!frames.isConsistent()) {
        MotionError error;
        error.what = "a tool and a work object of which not exactly one is held by the robot";
        return Unexpected{error};
    }
    if (!(std::fabs(norm(target.pose.rot) - 1) < kUnitTolerance)) {
        MotionError error;
        error.what = kNoOrientation;
        error.value = norm(target.pose.rot);
        return Unexpected{error};
    }
    const auto joints =
        solveTarget(kinematics, frames.toFlange(target.pose, target.extax), target, true, seed);
    if (!joints) return Unexpected{targetError(joints.error(), target.pose.pos)};
    return JointTarget{*joints, target.extax};
}

RobTarget calcRobTarget(const robot::Kinematics& kinematics, const JointTarget& joints,
                        const FrameSetup& frames) {
    Pose pose = frames.fromFlange(kinematics.forward(joints.robax), joints.extax);
    // Of the two quaternions of an orientation controllers show the one with q1 >= 0.
    if (pose.rot.w < 0) pose.rot = {-pose.rot.w, -pose.rot.x, -pose.rot.y, -pose.rot.z};
    RobTarget target{pose, kinematics.configuration(joints.robax), joints.extax};
    if (kinematics.hasArmAngle()) target.armAngle = kinematics.armAngle(joints.robax);
    return target;
}

} // namespace motion
