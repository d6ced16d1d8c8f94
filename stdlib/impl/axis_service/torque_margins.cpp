// Manual 1.8: the torque that the axes had left at least since ResetTorqueMargin, in percent of their greatest torque.

#include "stdlib/impl/axis_service/axis_values.h"
#include "stdlib/impl/motion/motion_ticker.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/torques.h"
#include "stdlib/impl/motion/units.h"

#include "natives/axes.h"

#include <algorithm>
#include <array>
#include <cmath>

using namespace rt;

namespace {

constexpr double kAll = 100; // percent

class TorqueMargins {
  public:
    TorqueMargins() { least_.fill(kAll); }
    /// Measures from now on.
    void reset(Controller& controller, MotionDriver& motion, int axis) {
        motion_ = &motion;
        if (axis < 0)
            least_.fill(kAll);
        else
            least_[static_cast<std::size_t>(axis)] = kAll;
        isOn_ = true;
        ticker_.start(controller, motion, [this] {
            measure();
            return true;
        });
        ticker_.look();
    }
    /// Of one axis, or the least of all; measured since the reset, or now when there was none.
    double least(MotionDriver& motion, int axis) {
        motion_ = &motion;
        if (!isOn_) least_.fill(kAll);
        measure();
        if (axis >= 0) return least_[static_cast<std::size_t>(axis)];
        return *std::min_element(least_.begin(), least_.end());
    }

  private:
    void measure() {
        const motion::MotionSystem& arm = motion_->system();
        for (std::size_t i = 0; i < arm.model().lowerDeg.size(); ++i)
            least_[i] = std::min(least_[i], kAll * (1 - std::abs(lib::torqueShare(arm, i))));
    }

    std::array<double, robot::kMostJoints> least_{};
    MotionDriver* motion_ = nullptr;
    bool isOn_ = false;
    lib::MotionTicker ticker_;
};

/// Number of the axis from 0; -1 for all. False with the error in `status`.
bool axisAsked(TaskCore* task, Handle* unit, const float* number, int& axis, Status& status) {
    axis = lib::robotAxis(task, unit, number != nullptr ? *number : 1, status);
    if (number == nullptr) axis = -1;
    return status == kOk;
}

TorqueMargins& marginsOf(TaskCore* task) {
    return lib::motionOf(task).service<TorqueMargins>();
}

} // namespace

extern "C" {

Status rt_ResetTorqueMargin(TaskCore* task, Handle* MechUnit, const float* AxisNo) {
    Status status = kOk;
    int axis = -1;
    if (!axisAsked(task, MechUnit, AxisNo, axis, status)) return status;
    marginsOf(task).reset(taskOf(task).controller(), lib::motionOf(task), axis);
    return kOk;
}

Status rt_GetTorqueMargin(TaskCore* task, Handle* MechUnit, const float* AxisNo, float* Margin) {
    Status status = kOk;
    int axis = -1;
    if (!axisAsked(task, MechUnit, AxisNo, axis, status)) return status;
    if (Margin != nullptr) *Margin = static_cast<float>(marginsOf(task).least(lib::motionOf(task), axis));
    return kOk;
}
}
