#include "runtime/robot/external_unit.h"

namespace robot {

Pose ExternalUnit::carry(const Pose& frameAtZero, const ExternalAxes& axes) const {
    Pose moved; // of everything the axes so far carry, in world
    for (const ExternalJoint& joint : joints) {
        const double position =
            !joint.isParked && isConnected(axes[joint.axis]) ? axes[joint.axis] : joint.parked;
        const Pose step =
            joint.rotating ? Pose{{}, fromAxisAngle({0, 0, 1}, position)} : Pose{{position, 0, 0}, {}};
        moved = moved * joint.base * step * inverse(joint.base);
    }
    return moved * frameAtZero;
}

Pose ExternalUnit::frame(const ExternalAxes& axes) const {
    return carry(joints.empty() ? Pose{} : joints.back().base, axes);
}

} // namespace robot
