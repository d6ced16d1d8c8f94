// Manual 1.18: test signals; GetJointData. Every reading is the value of the moment: means over the last samples, which a
// controller gives for short sample times, differ from it by a few milliseconds of movement.

#include "runtime/robot/angles.h"
#include "stdlib/impl/axis_service/axis_values.h"
#include "stdlib/impl/support/fail.h"

#include "runtime/sim/surroundings.h"

#include "natives/additional.h"
#include "natives/calibration.h"
#include "stdlib_constants.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

using namespace rt;

namespace {

constexpr std::size_t kChannels = 12;
constexpr float kLongestSample = 0.1F; // s
// Numbers that published programs use beside the documented ones.
// RAPID's constant speed is not declared: programs use that name for data of their own.
constexpr int kMotorSpeed = 6;
constexpr int kJointPosition = 4000, kJointSpeed = 4001, kJointTorque = 4002, kExternalTorque = 4003;
constexpr int kFirstForce = 201, kSecondForce = 207, kForces = 6;

struct SignalChannel {
    int signal = 0;
    lib::AxisPlace place;
};

/// A service of the controller.
struct Channels {
    std::array<std::optional<SignalChannel>, kChannels> all;
};

std::optional<SignalChannel>* channelOf(TaskCore* task, float number, Status& status) {
    auto& channels = taskOf(task).controller().service<Channels>().all;
    if (number >= 1 && number <= static_cast<float>(kChannels) && number == std::floor(number))
        return &channels[static_cast<std::size_t>(number) - 1];
    status = lib::failWith(task, err::ERR_ARGVALERR, "test signals have channels {} to {}", 1, kChannels);
    return nullptr;
}

bool isKnown(int signal) {
    switch (signal) {
    case static_cast<int>(k::resolver_angle):
    case static_cast<int>(k::speed_ref):
    case kMotorSpeed:
    case static_cast<int>(k::torque_ref):
    case static_cast<int>(k::dig_input1):
    case static_cast<int>(k::dig_input2):
    case kJointPosition:
    case kJointSpeed:
    case kJointTorque:
    case kExternalTorque: return true;
    default: return signal >= kFirstForce && signal < kSecondForce + kForces;
    }
}

/// Transmissions are not known: a motor turns as far as its axis.
double read(Controller& controller, const SignalChannel& channel) {
    const lib::AxisValues values = lib::axisValues(controller, channel.place);
    switch (channel.signal) {
    case static_cast<int>(k::resolver_angle): return values.position * robot::kDeg;
    case static_cast<int>(k::speed_ref):
    case kMotorSpeed: return values.speed * robot::kDeg;
    case static_cast<int>(k::torque_ref):
    case kJointTorque: return values.torque;
    case kJointPosition: return values.position;
    case kJointSpeed: return values.speed;
    case kExternalTorque: return values.externalTorque;
    case static_cast<int>(k::dig_input1):
    case static_cast<int>(k::dig_input2): return 0; // the simulated drives have no inputs
    default:
        return controller.service<Surroundings>().value(channel.place.motion->unitName(),
                                                        Surroundings::kForce,
                                                        (channel.signal - kFirstForce) % kForces + 1, 0);
    }
}

void give(float* result, double value) {
    if (result != nullptr) *result = static_cast<float>(value);
}

} // namespace

extern "C" {

Status rt_TestSignDefine(TaskCore* task, float Channel, float SignalId, Handle* MechUnit, float Axis,
                         float SampleTime) {
    Status status = kOk;
    auto* channel = channelOf(task, Channel, status);
    if (channel == nullptr) return status;
    if (!isKnown(static_cast<int>(SignalId)) || SignalId != std::floor(SignalId))
        return lib::fail(
            task, err::ERR_ARGVALERR,
            "the test signal is not known: use one of the testsignal constants, 201 to 212 (force "
            "sensor) or 4000 to 4003 (position, speed, torque, external torque of the axis)");
    if (!(SampleTime >= 0 && SampleTime <= kLongestSample))
        return lib::failWith(task, err::ERR_ARGVALERR, "the sample time must lie between {} and {} s", 0,
                             kLongestSample);
    SignalChannel made;
    made.signal = static_cast<int>(SignalId);
    if (!lib::axisPlace(task, MechUnit, Axis, err::ERR_UNIT_PAR, made.place, status)) return status;
    *channel = made;
    return kOk;
}

Status rt_TestSignReset(TaskCore* task) {
    taskOf(task).controller().service<Channels>().all.fill(std::nullopt);
    return kOk;
}

/// 0 of a channel that is not defined.
Status rt_TestSignRead(TaskCore* task, float* result, float Channel) {
    Status status = kOk;
    const auto* channel = channelOf(task, Channel, status);
    if (channel == nullptr) return status;
    *result = *channel ? static_cast<float>(read(taskOf(task).controller(), **channel)) : 0.0F;
    return kOk;
}

Status rt_GetJointData(TaskCore* task, Handle* MechUnit, float Axis, float* Position, float* Speed,
                       float* Torque, float* ExtTorque) {
    lib::AxisPlace place;
    Status status = kOk;
    if (!lib::axisPlace(task, MechUnit, Axis, err::ERR_REFUNKDAT, place, status)) return status;
    const lib::AxisValues values = lib::axisValues(taskOf(task).controller(), place);
    give(Position, values.position);
    give(Speed, values.speed);
    give(Torque, values.torque);
    give(ExtTorque, values.externalTorque);
    return kOk;
}
}
