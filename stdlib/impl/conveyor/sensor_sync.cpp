#include "stdlib/impl/conveyor/sensor_sync.h"

#include "stdlib/impl/conveyor/sensor_supervision.h"
#include "stdlib/impl/conveyor/tracking.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "natives/conveyor.h"
#include "stdlib_constants.h"

#include <optional>

using namespace rt;

namespace {

constexpr double kStartDelay =
    0.020; // s, from the order of a movement to its start when the robot is at rest
constexpr double kEverywhere = 100'000; // mm, of a SyncToSensor without \MaxSync

/// Of a robot, between SyncToSensor \On and \Off.
struct SensorSync {
    Conveyor* sensor = nullptr;
    double most = kEverywhere;      ///< no synchronisation with targets beyond this position
    std::optional<double> previous; ///< position of the sensor at the end of the movement ordered before
};

/// The position of the sensor that the target names: in the place of its axis, else the first one that no external axis of the
/// robot has.
std::optional<double> sensorPosition(MotionDriver& motion, const Conveyor& sensor,
                                     const motion::MoveCommand& command) {
    const bool isAbsolute = command.kind == motion::MoveKind::AbsJoint;
    const motion::ExternalAxes& wanted = isAbsolute ? command.joints.extax : command.target.extax;
    const motion::ExternalAxes own = motion.system().currentJoints().extax;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const bool isMeant = sensor.settings().axis < 0
                                 ? !motion::isConnected(own[i])
                                 : i == static_cast<std::size_t>(sensor.settings().axis);
        if (isMeant && motion::isConnected(wanted[i])) return wanted[i];
    }
    return {};
}

Status notActive(TaskCore* task, const Conveyor& sensor) {
    return lib::fail(task, err::ERR_CNV_NOT_ACT, sensor.name() + " is not activated; use ActUnit first");
}

Status waitMoving(TaskCore* task, Conveyor& sensor) {
    const auto isOver = [&sensor] { return sensor.orderedSpeed() != 0 || sensor.connected() == nullptr; };
    if (isOver()) return kOk;
    WaitResult result{};
    return taskOf(task).waitFor({{&sensor.changed()}, isOver}, result);
}

} // namespace

namespace rt::lib {

Status followSensor(TaskCore* task, motion::MoveCommand& command) {
    MotionDriver& motion = motionOf(task);
    auto& sync = motion.service<SensorSync>();
    if (sync.sensor == nullptr) return kOk;
    Conveyor& sensor = *sync.sensor;
    const std::optional<double> goal = sensorPosition(motion, sensor, command);
    if (!goal || *goal > sync.most) {
        sync.previous.reset();
        return kOk;
    }
    if (!sensor.isActive()) return notActive(task, sensor);
    if (const Status status = waitMoving(task, sensor)) return status;
    if (sensor.connected() == nullptr)
        return fail(task, err::ERR_CNV_DROPPED,
                    "no object of " + sensor.name() + " is connected; use WaitSensor first");
    const double speed = sensor.orderedSpeed();
    const double from = motion.system().isIdle() || !sync.previous
                            ? sensor.connectedPosition() + kStartDelay * speed
                            : *sync.previous;
    sync.previous = goal;
    auto span = std::make_shared<SensorSpan>();
    span->from = from;
    span->to = *goal;
    command.modifications.push_back(std::move(span));
    const double seconds = (*goal - from) / speed;
    if (seconds > 0)
        command.duration = seconds; // else the sensor has passed the place: at the programmed speed
    return kOk;
}

void endSensorSync(Task& task) {
    if (task.isMotionTask()) task.controller().motion(task).service<SensorSync>() = {};
}

} // namespace rt::lib

extern "C" {

Status rt_SyncToSensor(TaskCore* task, Handle* MechUnit, const float* MaxSync, bool On, bool Off) {
    if (const Status status = lib::requireMotionTask(task)) return status;
    Status status = kOk;
    Conveyor* sensor = lib::conveyorUnit(task, *MechUnit, status);
    if (sensor == nullptr) return status;
    if (On == Off) return lib::fail(task, err::ERR_ARGVALERR, "SyncToSensor needs one of \\On and \\Off");
    if (On && !sensor->isActive()) return notActive(task, *sensor);
    auto& sync = lib::motionOf(task).service<SensorSync>();
    sync = {};
    if (!On) return kOk;
    sync.sensor = sensor;
    if (MaxSync != nullptr) sync.most = *MaxSync;
    return kOk;
}
}
