#include "stdlib/impl/motion/torques.h"

#include "runtime/robot/angles.h"
#include "runtime/sim/surroundings.h"

#include <cmath>
#include <numbers>

namespace rt::lib {
namespace {

struct ArmReach {
    double ofWrist = 0;   ///< m, horizontally from axis 2 to the centre of the wrist
    double ofForearm = 0; ///< m, horizontally from axis 3 to there
};

ArmReach reachAt(const robot::OpwParameters& g, double axis2, double axis3) {
    const double q23 = (axis2 + axis3) * robot::kDeg;
    const double forearm = 0.001 * (g.c3 * std::cos(q23) - g.a2 * std::sin(q23));
    return {forearm + 0.001 * g.c2 * std::sin(axis2 * robot::kDeg), forearm};
}

/// Share of the torque of an axis that holds the arm against gravity, for an arm on the floor. The moved mass is the one
/// whose inertia the model's limits of acceleration contain, thought in the centre of the wrist.
double holdingShare(const robot::RobotModel& model, const motion::Joints& joints, std::size_t axis) {
    constexpr double kGravity = 9.81; // m/s^2
    const ArmReach reach = reachAt(model.geometry, joints[1], joints[2]);
    const robot::AccelerationLimit& limit = model.dynamics.axes[axis];
    if (axis == 1) return -kGravity * limit.reach / limit.scale * reach.ofWrist;
    if (axis != 2 || !(limit.cap > 0)) return 0;
    const double length = 0.001 * std::hypot(model.geometry.a2, model.geometry.c3);
    return length > 0 ? -kGravity * reach.ofForearm / (length * length * limit.cap * limit.scale) : 0;
}

} // namespace

double greatestTorque(const robot::RobotModel& model, std::size_t axis) {
    constexpr double kArmMass = 2;      // in rated payloads, as for the influence of loads (docs/motion.md)
    constexpr double kLoadOffset = 0.1; // m
    const robot::AccelerationLimit& limit = model.dynamics.axes[axis];
    const double mass = kArmMass * model.payloadKg;
    const double perDistance = axis == 0 ? limit.wrist : axis == 1 ? limit.reach : 0;
    if (perDistance > 0) return mass * limit.scale / perDistance;
    const double greatest =
        limit.cap > 0 ? limit.scale * limit.cap : robot::kDeg * model.maxAcceleration[axis];
    if (axis > 2) return model.payloadKg * kLoadOffset * kLoadOffset * greatest;
    const double length = axis == 2 ? 0.5 * model.reachM : model.reachM;
    return mass * length * length * greatest;
}

double accelerationOf(const motion::MotionSystem& arm, std::size_t axis) {
    constexpr Time kApart = kMillisecond;
    const Time now = arm.now();
    const double gained = arm.sample(now + kApart).jointSpeed[axis] - arm.sample(now).jointSpeed[axis];
    return gained / toSeconds(kApart);
}

double torqueShare(const motion::MotionSystem& arm, std::size_t axis) {
    const motion::MotionState state = arm.current();
    motion::Joints most = state.joints;
    robot::AccelerationMap(arm.model()).limitsAt(state.joints, most);
    return accelerationOf(arm, axis) / most[axis] + holdingShare(arm.model(), state.joints, axis);
}

double externalTorque(Controller& controller, const MotionDriver& motion, std::size_t axis) {
    return controller.service<Surroundings>().value(motion.unitName(), Surroundings::kExternalTorque,
                                                    static_cast<int>(axis) + 1, 0);
}

} // namespace rt::lib
