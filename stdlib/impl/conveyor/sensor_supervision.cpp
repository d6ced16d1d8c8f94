#include "stdlib/impl/conveyor/sensor_supervision.h"

#include "stdlib/impl/conveyor/tracking.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "natives/conveyor.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>

namespace rt::lib {

void SensorSupervision::set(const Limits& limits) {
    limits_ = limits;
    tag_ = 0;
    beyond_ = 0;
}

void SensorSupervision::advance(const motion::PlannedMoment& planned) {
    const auto* span = planned.find<SensorSpan>();
    if (span == nullptr || !planned.isMoving || limits_.sensor == nullptr) return;
    if (std::exchange(tag_, planned.tag) != planned.tag) length_ = planned.toEnd;
    if (length_ <= 0) return;
    const double expected = span->to - (span->to - span->from) * planned.toEnd / length_;
    const double position = limits_.sensor->connectedPosition();
    const bool isSupervised = expected >= limits_.from && expected <= limits_.to;
    const bool isBeyond = isSupervised && std::fabs(position - expected) > limits_.allowed;
    beyond_ = isBeyond ? beyond_ + motion::kModifierSeconds : 0;
    if (beyond_ <= limits_.delay) return;
    limits_.sensor = nullptr;
    report_(position, expected);
}

namespace {

struct RobotSupervision {
    std::shared_ptr<SensorSupervision> modifier;
};

/// The program stops when the arm has been brought up to now: this is called in the middle of that.
SensorSupervision& supervisionOf(TaskCore* task) {
    MotionDriver& motion = motionOf(task);
    Controller& controller = taskOf(task).controller();
    auto& own = motion.service<RobotSupervision>();
    if (own.modifier) return *own.modifier;
    own.modifier =
        std::make_shared<SensorSupervision>([&controller, &motion](double position, double expected) {
            const std::string why = fmt::format(
                "the sensor is at {:.1f} mm, but the robot expects it at {:.1f} mm", position, expected);
            controller.scheduler().after(0, [&controller, &motion, why] {
                controller.log().write(EventId::SensorSupervision, nullptr, {motion.unitName(), why});
                controller.actionStop();
            });
        });
    motion.system().addModifier(own.modifier);
    return *own.modifier;
}

} // namespace

} // namespace rt::lib

using namespace rt;

extern "C" {

Status rt_SupSyncSensorOn(TaskCore* task, Handle* MechUnit, float MaxSyncSup, float SafetyDist,
                          float MinSyncSup, const float* SafetyDelay) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    Status status = kOk;
    const Conveyor* sensor = lib::conveyorUnit(task, *MechUnit, status);
    if (sensor == nullptr) return status;
    if (!sensor->isActive())
        return lib::fail(task, err::ERR_CNV_NOT_ACT, sensor->name() + " is not activated; use ActUnit first");
    const float delay = SafetyDelay != nullptr ? *SafetyDelay : 0;
    if (!(MinSyncSup <= MaxSyncSup) || !(delay >= 0))
        return lib::fail(task, err::ERR_ARGVALERR,
                         "SupSyncSensorOn: MinSyncSup must not be greater than MaxSyncSup, and "
                         "SafetyDelay must not be negative");
    lib::supervisionOf(task).set({sensor, MinSyncSup, MaxSyncSup, std::fabs(SafetyDist), delay});
    return kOk;
}

Status rt_SupSyncSensorOff(TaskCore* task, Handle* MechUnit) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    Status status = kOk;
    if (lib::conveyorUnit(task, *MechUnit, status) == nullptr) return status;
    lib::supervisionOf(task).set({});
    return kOk;
}
}
