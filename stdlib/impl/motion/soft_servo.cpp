// Manual 1.7, 2.2.5: SoftAct, SoftDeact, TuneServo, TuneReset.

#include "stdlib/impl/motion/soft_servo.h"
#include "config/json_text.h"
#include "runtime/debug/state_keepers.h"
#include "runtime/motion/soft_servo.h"
#include "runtime/sim/surroundings.h"
#include "stdlib/impl/motion/kept_per_group.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/torques.h"
#include "stdlib/impl/motion/units.h"
#include "stdlib/impl/support/fail.h"

#include "natives/motion_settings.h"
#include "stdlib_constants.h"

#include <array>

using namespace rt;

namespace {

constexpr double kSeconds = 0.5; // a change of softness with \Ramp 100

struct SoftServoState {
    std::array<double, robot::kMostJoints> softness{};
    std::array<double, robot::kMostJoints> gain{}; ///< TUNE_KP; 0: as configured
    std::shared_ptr<motion::SoftServo> servo;      ///< null until an axis is soft
};

/// Half the position gain lets a soft axis give way twice as far.
double compliance(const SoftServoState& state, std::size_t axis) {
    const double gain = state.gain[axis] > 0 ? state.gain[axis] : 100;
    return 100 * state.softness[axis] / gain;
}

void takeTorques(Controller& controller, MotionDriver& motion) {
    const robot::RobotModel& model = motion.system().model();
    motion::SoftServo& servo = *motion.service<SoftServoState>().servo;
    for (std::size_t i = 0; i < model.lowerDeg.size(); ++i)
        servo.setOutsideTorque(i, lib::externalTorque(controller, motion, i) / lib::greatestTorque(model, i));
}

motion::SoftServo& servoOf(Controller& controller, MotionDriver& motion) {
    auto& state = motion.service<SoftServoState>();
    if (state.servo != nullptr) return *state.servo;
    state.servo = std::make_shared<motion::SoftServo>(motion.system().kinematics(),
                                                      robot::AccelerationMap(motion.system().model()));
    motion.system().addModifier(state.servo);
    takeTorques(controller, motion);
    controller.service<Surroundings>().addListener([&controller, &motion](const Surroundings::Name&, double) {
        motion.refresh(); // with the torques before
        takeTorques(controller, motion);
        motion.refresh();
    });
    return *state.servo;
}

/// Brings softness and tuning to the arm, within so many seconds.
void apply(Controller& controller, MotionDriver& motion, double seconds) {
    const auto& state = motion.service<SoftServoState>();
    motion.refresh();
    for (std::size_t i = 0; i < state.softness.size(); ++i) {
        const double percent = compliance(state, i);
        if (percent > 0 || state.servo != nullptr)
            servoOf(controller, motion).setCompliance(motion.system().now(), i, percent, seconds);
    }
    motion.refresh();
}

Status checkPercent(TaskCore* task, float value, double least, double most, const char* text) {
    if (value >= least && value <= most) return kOk;
    return lib::failWith(task, err::ERR_ARGVALERR, text, least, most);
}

Status rampSeconds(TaskCore* task, const float* ramp, double& seconds) {
    seconds = kSeconds * (ramp != nullptr ? 0.01 * static_cast<double>(*ramp) : 1);
    if (seconds > 0 && seconds <= 1000 * kSeconds) return kOk;
    return lib::fail(task, err::ERR_ARGVALERR, "the ramp must be above 0 and at most 100000 percent");
}

} // namespace

namespace rt::lib {

void endSoftServo(Controller& controller, MotionDriver& motion) {
    auto& state = motion.service<SoftServoState>();
    state.softness = {};
    state.gain = {};
    apply(controller, motion, kSeconds);
}

void keepSoftServo(Controller& controller, StateKeepers& kept) {
    kept.keepers["softServo"] = keptPerGroup(
        controller,
        [](MotionDriver& motion) {
            const auto& state = motion.service<SoftServoState>();
            return nlohmann::json{{"softness", state.softness}, {"gain", state.gain}};
        },
        [&controller](MotionDriver& motion, const nlohmann::json& json) {
            auto& state = motion.service<SoftServoState>();
            json.at("softness").get_to(state.softness);
            json.at("gain").get_to(state.gain);
            apply(controller, motion, 0);
        });
}

} // namespace rt::lib

extern "C" {

Status rt_SoftAct(TaskCore* task, Handle* MechUnit, float Axis, float Softness, const float* Ramp) {
    Status status = kOk;
    const int axis = lib::robotAxis(task, MechUnit, Axis, status);
    if (axis < 0) return status;
    double seconds = 0;
    status = rampSeconds(task, Ramp, seconds);
    if (status != kOk) return status;
    status = checkPercent(task, Softness, 0, 100, "SoftAct: the softness must lie between {} and {} percent");
    if (status != kOk) return status;
    MotionDriver& motion = lib::motionOf(task);
    motion.service<SoftServoState>().softness[static_cast<std::size_t>(axis)] = static_cast<double>(Softness);
    apply(taskOf(task).controller(), motion, seconds);
    return kOk;
}

Status rt_SoftDeact(TaskCore* task, const float* Ramp) {
    double seconds = 0;
    const Status status = rampSeconds(task, Ramp, seconds);
    if (status != kOk) return status;
    MotionDriver& motion = lib::motionOf(task);
    motion.service<SoftServoState>().softness = {};
    apply(taskOf(task).controller(), motion, seconds);
    return kOk;
}

// Axes that are not soft follow their path exactly, without oscillation: of all tunings the position gain of a soft axis alone
// has something to act on.
Status rt_TuneServo(TaskCore* task, Handle* MecUnit, float Axis, float TuneValue, const float* Type) {
    Status status = kOk;
    const int axis = lib::robotAxis(task, MecUnit, Axis, status);
    if (axis < 0) return status;
    if (Type != nullptr) {
        status = checkPercent(task, *Type, k::TUNE_DF, k::TUNE_DL, "TuneServo: types of tuning are {} to {}");
        if (status != kOk) return status;
    }
    status = checkPercent(task, TuneValue, 1, 500, "TuneServo: the value must lie between {} and {} percent");
    if (status != kOk || Type == nullptr || *Type != k::TUNE_KP) return status;
    MotionDriver& motion = lib::motionOf(task);
    motion.service<SoftServoState>().gain[static_cast<std::size_t>(axis)] = static_cast<double>(TuneValue);
    apply(taskOf(task).controller(), motion, kSeconds);
    return kOk;
}

Status rt_TuneReset(TaskCore* task) {
    MotionDriver& motion = lib::motionOf(task);
    motion.service<SoftServoState>().gain = {};
    apply(taskOf(task).controller(), motion, kSeconds);
    return kOk;
}
}
