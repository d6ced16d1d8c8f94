// Manual 1.8: load identification. The robot makes its test movements; what it finds is the load that the stimulus says is
// there (load_mass ...), else the load that is declared already.

#include "stdlib/impl/motion/move_order.h"
#include "stdlib/impl/motion/units.h"
#include "stdlib/impl/support/fail.h"

#include "runtime/sim/surroundings.h"

#include "natives/axes.h"
#include "natives/motion_misc.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace rt;

namespace {

constexpr std::size_t kAxis3 = 2, kAxis5 = 4, kAxis6 = 5;
constexpr double kSwing = 10;                                          // deg to each side, axes 3 and 5
constexpr double kUsualAngle = 90, kLeastAngle = 30, kMostAngle = 180; // deg, axis 6
constexpr float kNothing = 0.001F;                                     // kg: the mass of load0
const data::Speeddata kTestSpeed{100, 50, 100, 20};
const data::Zonedata kFine{true, 0, 0, 0, 0, 0, 0};

/// The load on a unit as the stimulus has it; false when it says nothing of it.
bool trueLoad(Controller& controller, const std::string& unit, data::Loaddata& load) {
    const auto& around = controller.service<Surroundings>();
    const auto mass = around.find(unit, Surroundings::kLoadMass);
    if (!mass) return false;
    const auto part = [&](const char* quantity, int number) {
        return static_cast<float>(around.value(unit, quantity, number, 0));
    };
    load.mass = static_cast<float>(*mass);
    load.cog = {part(Surroundings::kLoadCentre, 1), part(Surroundings::kLoadCentre, 2),
                part(Surroundings::kLoadCentre, 3)};
    load.aom = {1, 0, 0, 0};
    load.ix = part(Surroundings::kLoadInertia, 1);
    load.iy = part(Surroundings::kLoadInertia, 2);
    load.iz = part(Surroundings::kLoadInertia, 3);
    return true;
}

bool isRobotLoad(float type) {
    return type == k::TOOL_LOAD_ID || type == k::PAY_LOAD_ID;
}

/// Robots with axes 3, 5 and 6 to swing.
bool canIdentify(const robot::RobotModel& model) {
    return model.kinematics == robot::KinematicsKind::SphericalWrist ||
           model.kinematics == robot::KinematicsKind::OffsetWrist;
}

/// Whether axes 3, 5 and 6 can make their test movements from there.
bool isAxisValid(const robot::RobotModel& model, const motion::Joints& joints, std::size_t axis,
                 double angle) {
    const auto within = [&](double place) {
        return place >= model.lowerDeg[axis] && place <= model.upperDeg[axis];
    };
    if (axis == kAxis3 || axis == kAxis5)
        return within(joints[axis] - kSwing) && within(joints[axis] + kSwing);
    if (axis == kAxis6) return within(joints[axis] + angle);
    return within(joints[axis]);
}

bool isAngle(double angle) {
    return std::abs(angle) >= kLeastAngle && std::abs(angle) <= kMostAngle;
}

Status moveStopped(TaskCore* task, Status status) {
    if (status <= 0) return status; // done, or the program is being left
    return lib::fail(task, err::ERR_PID_MOVESTOP,
                     "a test movement of the load identification cannot be made");
}

Status moveAxes(TaskCore* task, const motion::JointTarget& target) {
    const lib::MotionState& state = lib::motionState(task);
    const data::Tooldata tool = state.tool;
    const data::Wobjdata workObject = state.workObject;
    lib::MoveArguments move;
    move.speed = &kTestSpeed;
    move.zone = &kFine;
    move.tool = &tool;
    move.workObject = &workObject;
    motion::MoveCommand command;
    command.kind = motion::MoveKind::AbsJoint;
    command.joints = target;
    return moveStopped(task, lib::orderMove(task, command, move));
}

/// Axes 5 and 3 swing, then again with axis 6 turned, and back.
Status testMovements(TaskCore* task, double angle, bool withAxis3, bool slowOnly) {
    const motion::JointTarget from = lib::motionSystemOf(task).plannedEnd();
    for (const double turned : {0.0, angle}) {
        motion::JointTarget at = from;
        at.robax[kAxis6] += turned;
        for (const double side : {kSwing, -kSwing, 0.0}) {
            motion::JointTarget to = at;
            to.robax[kAxis5] += side;
            if (withAxis3) to.robax[kAxis3] += side;
            if (const Status status = moveAxes(task, to)) return status;
        }
        if (slowOnly) break;
    }
    return moveAxes(task, from);
}

/// An error of the user that a correct call removes.
Status refuse(TaskCore* task, std::string_view text) {
    return lib::fail(task, err::ERR_PID_RAISE_PP, text);
}

struct ManipulatorLoad {
    const float* type;
    Handle* unit;
    const String* unitName;
    const float* axis;
    data::Loaddata* load;
    const float* angle;
    bool deactivates, isActive;
    bool* defined;
    bool exits;
};

MechanicalUnit* unitAsked(TaskCore* task, const ManipulatorLoad& args, Status& status) {
    if (args.unit != nullptr) return lib::unitOf(task, *args.unit, status);
    MechanicalUnit* unit =
        args.unitName != nullptr ? taskOf(task).controller().units().find(args.unitName->view()) : nullptr;
    if (unit == nullptr)
        status =
            refuse(task, "ManLoadIdProc needs \\MechUnit or \\MechUnitName with a unit of the configuration");
    return unit;
}

Status activate(TaskCore* task, MechanicalUnit& unit, bool isActive) {
    if (unit.isActive) return kOk;
    if (isActive) return refuse(task, "ManLoadIdProc: \\AlreadyActive, but the unit is not active");
    MotionDriver& driver = lib::motionOf(task);
    motion::JointTarget here = driver.system().currentJoints();
    taskOf(task).controller().units().setActive(unit, true, here.extax);
    driver.system().placeAt(here);
    driver.refresh();
    return kOk;
}

/// The axis to its end of the test and back, within its bounds.
Status swingAxis(TaskCore* task, const MechanicalUnit::Axis& axis, double angle) {
    const motion::JointTarget from = lib::motionSystemOf(task).plannedEnd();
    motion::JointTarget to = from;
    to.extax[axis.index] += angle;
    if (const Status status = moveAxes(task, to)) return status;
    return moveAxes(task, from);
}

Status identifyManipulator(TaskCore* task, const ManipulatorLoad& args) {
    if (!taskOf(task).isMotionTask())
        return lib::fail(task, err::ERR_LOADID_FATAL, "the task moves no mechanical unit");
    Status status = kOk;
    MechanicalUnit* unit = unitAsked(task, args, status);
    if (unit == nullptr) return status;
    if (unit->isRobot || unit->group != lib::motionOf(task).group())
        return lib::fail(task, err::ERR_LOADID_FATAL,
                         unit->name + " is not an external mechanical unit of this task");
    const float number = args.axis != nullptr ? *args.axis : 1;
    if (!(number >= 1 && number <= static_cast<float>(unit->own.size()) && number == std::floor(number)))
        return refuse(task, "ManLoadIdProc: the mechanical unit has no such axis");
    if (args.type != nullptr && isRobotLoad(*args.type))
        return refuse(task, "ManLoadIdProc: \\ParIdType must be one of the IRBP_ constants");
    const double angle = args.angle != nullptr ? static_cast<double>(*args.angle) : kUsualAngle;
    if (!isAngle(angle))
        return refuse(task, "ManLoadIdProc: \\ConfigAngle must be 30 to 180 degrees, or negative");
    MotionDriver& driver = lib::motionOf(task);
    if ((status = driver.waitIdle(taskOf(task))) != kOk) return status;
    if ((status = activate(task, *unit, args.isActive)) != kOk) return status;
    const MechanicalUnit::Axis& axis = unit->own[static_cast<std::size_t>(number) - 1];
    if ((status = swingAxis(task, axis, angle)) != kOk) return status;
    data::Loaddata found{};
    const bool isKnown = trueLoad(taskOf(task).controller(), unit->name, found);
    if (args.load != nullptr && isKnown) *args.load = found;
    if (args.defined != nullptr)
        *args.defined = isKnown || (args.load != nullptr && args.load->mass > kNothing);
    return args.exits ? taskOf(task).requestExit() : kOk;
}

} // namespace

extern "C" {

/// Kept with the unit; its axes move alike with every load.
Status rt_MechUnitLoad(TaskCore* task, Handle* MechUnit, float AxisNo, data::Loaddata* Load) {
    Status status = kOk;
    const MechanicalUnit* unit = lib::unitOf(task, *MechUnit, status);
    if (unit == nullptr) return status;
    if (!(AxisNo >= 1 && AxisNo <= static_cast<float>(unit->axes) && AxisNo == std::floor(AxisNo)))
        return lib::fail(task, err::ERR_AXIS_PAR, "MechUnitLoad: the mechanical unit has no such axis");
    if (unit->isRobot)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "MechUnitLoad is for external units; GripLoad sets the load of a robot");
    if (!(Load->mass >= 0))
        return lib::fail(task, err::ERR_ARGVALERR, "MechUnitLoad: the mass must not be negative");
    return kOk;
}

/// Robots with axes 3, 5 and 6 that swing; for positioners, units of external axes.
Status rt_ParIdRobValid(TaskCore* task, float* result, float ParIdType, Handle* MechUnit,
                        const float* AxisNo) {
    const MechanicalUnit* unit = nullptr;
    if (MechUnit != nullptr) {
        Status status = kOk;
        unit = lib::unitOf(task, *MechUnit, status);
        if (unit == nullptr) return status;
    }
    bool isValid = false;
    if (isRobotLoad(ParIdType))
        isValid = (unit == nullptr || unit->isRobot) && lib::movesRobot(taskOf(task)) &&
                  canIdentify(lib::motionOf(task).model());
    else if (ParIdType >= k::IRBP_K && ParIdType <= k::IRBP_D && unit != nullptr && !unit->isRobot)
        isValid = AxisNo == nullptr || (*AxisNo >= 1 && *AxisNo <= static_cast<float>(unit->axes));
    *result = isValid ? k::ROB_LOAD_VAL : k::ROB_NOT_LOAD_VAL;
    return kOk;
}

/// AxValid has an element for each of the six axes of the robot and then the six external ones.
Status rt_ParIdPosValid(TaskCore* task, bool* result, float ParIdType, data::Jointtarget* Pos, bool* AxValid,
                        int32_t AxValidDim1, const float* ConfAngle) {
    const motion::MotionSystem& arm = lib::motionSystemOf(task);
    const robot::RobotModel& model = arm.model();
    const double angle = ConfAngle != nullptr ? static_cast<double>(*ConfAngle) : kUsualAngle;
    const bool isPossible = isRobotLoad(ParIdType) && canIdentify(model) && isAngle(angle);
    const motion::JointTarget joints = lib::toJoints(*Pos, arm.kinematics());
    *result = isPossible;
    for (int32_t i = 0; i < AxValidDim1; ++i) {
        const auto axis = static_cast<std::size_t>(i);
        const bool isValid = isPossible && (axis >= joints.robax.size() || axis > kAxis6 ||
                                            isAxisValid(model, joints.robax, axis, angle));
        AxValid[i] = isValid;
        if (!isValid) *result = false;
    }
    return kOk;
}

Status rt_LoadId(TaskCore* task, float ParIdType, float LoadIdType, data::Tooldata* Tool,
                 data::Loaddata* PayLoad, data::Wobjdata*, const float* ConfAngle, bool SlowTest,
                 float* Accuracy) {
    if (!lib::movesRobot(taskOf(task)) || !canIdentify(lib::motionOf(task).model()))
        return lib::fail(task, err::ERR_LOADID_FATAL,
                         "the task does not move a robot that can identify loads");
    if (!isRobotLoad(ParIdType)) return refuse(task, "LoadId: ParIdType must be TOOL_LOAD_ID or PAY_LOAD_ID");
    const bool isTool = ParIdType == k::TOOL_LOAD_ID;
    if (!isTool && PayLoad == nullptr) return refuse(task, "LoadId: PAY_LOAD_ID needs \\PayLoad");
    if (LoadIdType != k::MASS_KNOWN && LoadIdType != k::MASS_WITH_AX3)
        return refuse(task, "LoadId: LoadIdType must be MASS_KNOWN or MASS_WITH_AX3");
    data::Loaddata& load = isTool ? Tool->tload : *PayLoad;
    if (LoadIdType == k::MASS_KNOWN && !(load.mass > kNothing))
        return refuse(task, "LoadId: MASS_KNOWN needs the mass in the load data");
    const double angle = ConfAngle != nullptr ? static_cast<double>(*ConfAngle) : kUsualAngle;
    if (!isAngle(angle)) return refuse(task, "LoadId: \\ConfAngle must be 30 to 180 degrees, or negative");
    MotionDriver& driver = lib::motionOf(task);
    if (driver.isStopMoveActive())
        return lib::fail(task, err::ERR_PID_MOVESTOP, "LoadId: StopMove holds the robot");
    if (const Status status = driver.waitIdle(taskOf(task))) return status;
    const motion::JointTarget here = driver.system().plannedEnd();
    for (std::size_t axis = 0; axis < here.robax.size(); ++axis)
        if (!isAxisValid(driver.model(), here.robax, axis, angle))
            return refuse(task,
                          fmt::format("LoadId: axis {} cannot make its test movement from here", axis + 1));
    const bool withAxis3 = LoadIdType == k::MASS_WITH_AX3;
    if (const Status status = testMovements(task, angle, withAxis3, SlowTest)) return status;
    if (SlowTest) return kOk;
    const float mass = load.mass;
    if (trueLoad(taskOf(task).controller(), driver.unitName(), load) && !withAxis3) load.mass = mass;
    if (Accuracy != nullptr) *Accuracy = 100;
    return kOk;
}

Status rt_ManLoadIdProc(TaskCore* task, const float* ParIdType, Handle* MechUnit, const String* MechUnitName,
                        const float* AxisNumber, data::Loaddata* PayLoad, const float* ConfigAngle,
                        bool DeactAll, bool AlreadyActive, bool* DefinedFlag, const bool* DoExit) {
    return identifyManipulator(task, {ParIdType, MechUnit, MechUnitName, AxisNumber, PayLoad, ConfigAngle,
                                      DeactAll, AlreadyActive, DefinedFlag, DoExit != nullptr && *DoExit});
}

Status rt_ManLoadId(TaskCore* task, const float* ParIdType, Handle* MechUnit, const String* MechUnitName,
                    const float* AxisNumber, data::Loaddata* PayLoad, const float* ConfigAngle, bool DeactAll,
                    bool AlreadyActive, bool* DefinedFlag, const bool* DoExit) {
    return rt_ManLoadIdProc(task, ParIdType, MechUnit, MechUnitName, AxisNumber, PayLoad, ConfigAngle,
                            DeactAll, AlreadyActive, DefinedFlag, DoExit);
}
}
