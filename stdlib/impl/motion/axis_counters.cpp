// Distance and time that axes have moved: GetAxisDistance, GetAxisMoveTime and their resets. Counted in the period of the trace while
// the arm moves, from the first of these instructions on: programs that use none of them pay nothing.

#include "stdlib/impl/motion/motion_ticker.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/units.h"

#include "natives/additional.h"

#include <cmath>
#include <optional>

using namespace rt;

namespace {

constexpr double kStill = 1e-6; // deg or mm in a period: less does not count as movement

struct AxisCount {
    double distance = 0; // deg or mm
    Time moved = 0;
};

class AxisCounters {
  public:
    AxisCount& of(Controller& controller, MotionDriver& motion, std::size_t axis) {
        ticker_.start(controller, motion, [this, &motion] {
            count(motion.system());
            return true;
        });
        ticker_.look();
        return counts_[axis];
    }

  private:
    void count(const motion::MotionSystem& arm) {
        const Time now = arm.now();
        const motion::Joints joints = arm.current().joints;
        if (last_) {
            for (std::size_t i = 0; i < joints.size(); ++i) {
                const double way = std::abs(joints[i] - (*last_)[i]);
                counts_[i].distance += way;
                if (way > kStill) counts_[i].moved += now - when_;
            }
        }
        last_ = joints;
        when_ = now;
    }

    std::array<AxisCount, robot::kMostJoints> counts_{};
    std::optional<motion::Joints> last_;
    Time when_ = 0;
    lib::MotionTicker ticker_;
};

/// The counter of an axis of the task's robot; null, with the error raised in `status`, when it has none.
AxisCount* countOf(TaskCore* task, Handle* unit, float number, Status& status) {
    const int axis = lib::robotAxis(task, unit, number, status);
    if (axis < 0) return nullptr;
    MotionDriver& motion = lib::motionOf(task);
    return &motion.service<AxisCounters>().of(taskOf(task).controller(), motion,
                                              static_cast<std::size_t>(axis));
}

} // namespace

extern "C" {

Status rt_GetAxisDistance(TaskCore* task, double* result, Handle* MechUnit, float AxisNo) {
    Status status = kOk;
    if (const AxisCount* count = countOf(task, MechUnit, AxisNo, status)) *result = count->distance;
    return status;
}

Status rt_GetAxisMoveTime(TaskCore* task, double* result, Handle* MechUnit, float AxisNo) {
    constexpr double kHour = 3600.0 * kSecond;
    Status status = kOk;
    if (const AxisCount* count = countOf(task, MechUnit, AxisNo, status))
        *result = static_cast<double>(count->moved) / kHour;
    return status;
}

Status rt_ResetAxisDistance(TaskCore* task, Handle* MechUnit, float AxisNo) {
    Status status = kOk;
    if (AxisCount* count = countOf(task, MechUnit, AxisNo, status)) count->distance = 0;
    return status;
}

Status rt_ResetAxisMoveTime(TaskCore* task, Handle* MechUnit, float AxisNo) {
    Status status = kOk;
    if (AxisCount* count = countOf(task, MechUnit, AxisNo, status)) count->moved = 0;
    return status;
}
}
