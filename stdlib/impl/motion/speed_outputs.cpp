#include "stdlib/impl/motion/speed_outputs.h"

#include "stdlib/impl/motion/motion_ticker.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace rt::lib {
namespace {

/// The speed of a movement is exact to some millionths: a part of the range of an output that is not an excess.
constexpr double kNoise = 1e-5;

/// Speed of the TCP `lag` from now. The path after the movement in progress is not planned yet: the arm stops
/// there.
double speedIn(const motion::MotionSystem& arm, Time lag) {
    if (!arm.isMoving()) return 0;
    const auto end = arm.reachTime(arm.currentMove());
    if (lag == 0 || !end) return arm.current().tcpSpeed; // the future of a braking arm is not known
    const Time then = addTime(arm.now(), lag);
    return then >= *end ? 0 : arm.sample(then).tcpSpeed;
}

class SpeedOutputs {
  public:
    void follow(Controller& controller, MotionDriver& motion, Handle output, const SpeedScale& scale) {
        motion_ = &motion;
        ticker_.start(controller, motion, [this, &controller] {
            for (const auto& [followed, factor] : outputs_)
                set(controller, followed, factor);
            return !outputs_.empty();
        });
        outputs_[output] = scale;
        ticker_.look();
        if (scale.scale == 0) outputs_.erase(output);
    }

    void end(Controller& controller) {
        for (auto& [output, scale] : outputs_)
            set(controller, output, {0, 0, scale.errorSignal});
        outputs_.clear();
    }

  private:
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
    MotionTicker ticker_;
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
