// Distance and time that axes have moved: GetAxisDistance, GetAxisMoveTime and their resets. Counted in the period of the trace while
// the arm moves, from the first of these instructions on: programs that use none of them pay nothing.

#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/units.h"

#include "stdlib_natives.h"

#include <cmath>
#include <optional>

using namespace rt;

namespace {

constexpr Time kPeriod = 4 * kMillisecond;
constexpr double kStill = 1e-6; // deg or mm in a period: less does not count as movement

struct AxisCount {
    double distance = 0; // deg or mm
    Time moved = 0;
};

class AxisCounters {
  public:
    AxisCount& of(Controller& controller, MotionDriver& motion, std::size_t axis) {
        if (motion_ == nullptr) {
            motion_ = &motion;
            motion.addListener([this, &controller](ArmNews) { count(controller); });
        }
        count(controller);
        return counts_[axis];
    }

  private:
    void count(Controller& controller) {
        const motion::MotionSystem& arm = motion_->system();
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
        if (tick_ != 0 || !arm.isMoving()) return;
        tick_ = controller.scheduler().at((controller.scheduler().now() / kPeriod + 1) * kPeriod,
                                          [this, &controller] {
                                              tick_ = 0;
                                              count(controller);
                                          });
    }

    std::array<AxisCount, robot::kMostJoints> counts_{};
    std::optional<motion::Joints> last_;
    Time when_ = 0;
    EventToken tick_ = 0;
    MotionDriver* motion_ = nullptr; // known from the first use on
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
