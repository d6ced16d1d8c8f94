#include "stdlib/impl/motion/speed_outputs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace rt::lib {
namespace {

/// How often an output is set while the arm moves: the period of the trace.
constexpr Time kPeriod = 4 * kMillisecond;

/// The speed of a movement is exact to some millionths: a part of the range of an output that is no excess.
constexpr double kNoise = 1e-5;

/// Speed of the TCP `lag` from now. What comes behind the end of the movement in progress is not planned yet: the arm stops
/// there.
double speedIn(const motion::MotionSystem& arm, Time lag) {
    if (!arm.isMoving()) return 0;
    const auto end = arm.reachTime(arm.currentMove());
    if (lag == 0 || !end) return arm.current().tcpSpeed; // nothing is known ahead of an arm that brakes
    const Time then = addTime(arm.now(), lag);
    return then >= *end ? 0 : arm.sample(then).tcpSpeed;
}

class SpeedOutputs {
  public:
    void follow(Controller& controller, MotionDriver& motion, Handle output, const SpeedScale& scale) {
        if (std::exchange(motion_, &motion) == nullptr)
            motion.addListener([this, &controller](ArmNews) { update(controller); });
        outputs_[output] = scale;
        update(controller);
        if (scale.scale == 0) outputs_.erase(output);
    }

    void end(Controller& controller) {
        for (auto& [output, scale] : outputs_)
            set(controller, output, {0, 0, scale.errorSignal});
        outputs_.clear();
    }

  private:
    void update(Controller& controller) {
        for (const auto& [output, scale] : outputs_)
            set(controller, output, scale);
        if (outputs_.empty() || tick_ != 0 || !motion_->system().isMoving()) return;
        const Time now = controller.scheduler().now();
        tick_ = controller.scheduler().at((now / kPeriod + 1) * kPeriod, [this, &controller] {
            tick_ = 0;
            update(controller);
        });
    }

    void set(Controller& controller, Handle output, const SpeedScale& scale) const {
        IoSystem& io = controller.io();
        const SignalConfig& limits = io.config(io.idOf(output));
        const double wanted = scale.scale * speedIn(motion_->system(), scale.dipLag);
        const double value = std::clamp(wanted, limits.minValue, limits.maxValue);
        (void)io.set(output, value); // checked when the trigger was defined
        const bool outside = std::fabs(value - wanted) > kNoise * (limits.maxValue - limits.minValue);
        if (scale.errorSignal != 0) (void)io.set(scale.errorSignal, outside ? 1 : 0);
    }

    std::map<Handle, SpeedScale> outputs_;
    EventToken tick_ = 0;
    MotionDriver* motion_ = nullptr; // known when the first output follows it
};

} // namespace

void followSpeed(Task& task, Handle output, const SpeedScale& scale) {
    MotionDriver& motion = task.controller().motion(task);
    motion.service<SpeedOutputs>().follow(task.controller(), motion, output, scale);
}

void endSpeedOutputs(Task& task) {
    task.controller().motion(task).service<SpeedOutputs>().end(task.controller());
}

} // namespace rt::lib
