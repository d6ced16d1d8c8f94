// One test for each kind of limit: the movement is made so that this limit alone slows it. The limit is reached, and kept.

#include "runtime/motion/motion_system.h"
#include "runtime/robot/dynamics.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

using namespace motion;

namespace {

constexpr TimeNs kStep = 1'000'000;
constexpr double kStepSeconds = 1e-9 * static_cast<double>(kStep);
constexpr double kDegrees = 57.295779513082323;

MotionSystem robotWithExternalAxes(Planner planner = Planner::Measured) {
    MotionOptions options;
    options.planner = planner;
    options.external[0] = {true, false, -1000, 1000, 1000, 5000}; // linear
    options.external[1] = {true, true, -360, 360, 500, 5000};     // rotating
    MotionSystem system(robot::loadRobotModel("IRB 120-3/0.58").value(), options);
    JointTarget start = system.currentJoints();
    start.robax = {0, 10, 10, 0, 60, 0};
    system.placeAt(start);
    return system;
}

/// Nothing but the limits of the robot.
MoveCommand fast(const MotionSystem& system, MoveKind kind) {
    MoveCommand command;
    command.kind = kind;
    command.joints = system.plannedEnd();
    command.target = system.toRobTarget(command.joints, command.frames);
    command.speed = {1e5, 1e5, 1e5, 1e5};
    command.confL = false;
    return command;
}

MoveCommand line(const MotionSystem& system, double mm) {
    MoveCommand command = fast(system, MoveKind::Linear);
    command.target.pose = robot::offs(command.target.pose, 0, mm, 0);
    return command;
}

/// Axis 1 alone: its greatest acceleration is the same all the way.
MoveCommand axisOne(const MotionSystem& system, double degrees) {
    MoveCommand command = fast(system, MoveKind::AbsJoint);
    command.joints.robax[0] += degrees;
    return command;
}

/// The highest figures of a movement.
struct Most {
    double tcp = 0, turn = 0;             ///< mm/s, deg/s
    double gain = 0, drop = 0, world = 0; ///< mm/s^2, along the path, and in any direction
    double axis = 0, axisGain = 0;        ///< axis 1: deg/s, deg/s^2
    std::array<double, 2> external{};     ///< mm/s, deg/s
    double seconds = 0;
};

Most measured(MotionSystem& system, const MoveCommand& command,
              const std::function<void(double)>& atSecond = nullptr) {
    Most most;
    REQUIRE(system.enqueue(command));
    std::array<MotionState, 3> last;
    last.fill(system.current());
    const TimeNs begin = system.now();
    double previous = 0;
    for (int i = 0; i < 100'000 && !(system.isIdle() && !system.isMoving()); ++i) {
        system.advanceTo(system.now() + kStep);
        if (atSecond) atSecond(1e-9 * static_cast<double>(system.now() - begin));
        std::rotate(last.begin(), last.begin() + 1, last.end());
        last[2] = system.current();
        const auto rate = [](double a, double b) { return std::abs(b - a) / kStepSeconds; };
        const Vec3 way = last[2].tcp.pos - last[1].tcp.pos;
        const double speed = norm(way) / kStepSeconds;
        most.tcp = std::max(most.tcp, speed);
        most.gain = std::max(most.gain, (speed - previous) / kStepSeconds);
        most.drop = std::max(most.drop, (previous - speed) / kStepSeconds);
        previous = speed;
        const Vec3 bend = way - (last[1].tcp.pos - last[0].tcp.pos);
        most.world = std::max(most.world, norm(bend) / (kStepSeconds * kStepSeconds));
        const double turn = std::min(1.0, std::abs(dot(last[1].tcp.rot, last[2].tcp.rot)));
        most.turn = std::max(most.turn, 2 * std::acos(turn) * kDegrees / kStepSeconds);
        most.axis = std::max(most.axis, rate(last[1].joints[0], last[2].joints[0]));
        const double change = last[2].joints[0] - 2 * last[1].joints[0] + last[0].joints[0];
        most.axisGain = std::max(most.axisGain, std::abs(change) / (kStepSeconds * kStepSeconds));
        for (std::size_t k = 0; k < most.external.size(); ++k)
            most.external[k] = std::max(most.external[k], rate(last[1].extax[k], last[2].extax[k]));
    }
    most.seconds = 1e-9 * static_cast<double>(system.now() - begin);
    return most;
}

/// Reached up to a share of it, and kept.
void checkBinds(double value, double limit, double share = 0.99) {
    CHECK(value <= limit * 1.002);
    CHECK(value >= limit * share);
}

double accelerationOfAxisOne(const MotionSystem& system) {
    Joints most = system.currentJoints().robax;
    robot::AccelerationMap(system.model()).limitsAt(system.currentJoints().robax, most);
    return most[0];
}

} // namespace

TEST_CASE("v_tcp, VelSet and the override limit the TCP", "[motion][limits]") {
    MotionSystem system = robotWithExternalAxes();
    MoveCommand command = line(system, 200);
    double limit = 200;
    command.speed.vTcp = 200;
    SECTION("v_tcp") {}
    SECTION("VelSet, override") {
        command.settings.velocityPercent = 50;
        limit = 100;
    }
    SECTION("VelSet, highest speed") {
        command.settings.maxTcpSpeed = 80;
        limit = 80;
    }
    SECTION("speed override") {
        system.setOverride(25);
        limit = 50;
    }
    checkBinds(measured(system, command).tcp, limit);
}

TEST_CASE("v_ori limits a reorientation", "[motion][limits]") {
    MotionSystem system = robotWithExternalAxes();
    MoveCommand command = fast(system, MoveKind::Linear);
    command.target.pose.rot = command.target.pose.rot * robot::fromEulerZyx(60, 0, 0);
    command.speed.vOri = 40;
    checkBinds(measured(system, command).turn, 40, 0.98);
}

TEST_CASE("an external axis out of range is judged before the way", "[motion][limits]") {
    // docs/motion.md, Path. The way through the foot of the robot is impossible, too.
    MotionSystem system = robotWithExternalAxes();
    JointTarget start = system.currentJoints();
    start.robax = {0, 0, 0, 0, 30, 0};
    REQUIRE(system.placeAt(start));
    MoveCommand command = fast(system, MoveKind::Linear);
    command.target = system.toRobTarget({{160, 0, 0, 0, 30, 0}, command.joints.extax}, command.frames);
    REQUIRE_FALSE(system.enqueue(command).hasValue());
    command.target.extax[0] = 2000;
    const auto refused = system.enqueue(command);
    REQUIRE_FALSE(refused.hasValue());
    CHECK(refused.error().kind == MotionErrorKind::JointOutOfRange);
    CHECK(refused.error().joint == robot::kFirstExternalAxis);
}

TEST_CASE("v_leax and v_reax limit external axes", "[motion][limits]") {
    MotionSystem system = robotWithExternalAxes();
    MoveCommand command = fast(system, MoveKind::AbsJoint);
    SECTION("linear") {
        command.joints.extax[0] += 300;
        command.speed.vLeax = 120;
        checkBinds(measured(system, command).external[0], 120);
    }
    SECTION("rotating") {
        command.joints.extax[1] += 120;
        command.speed.vReax = 45;
        checkBinds(measured(system, command).external[1], 45);
    }
    SECTION("the axis itself") {
        command.joints.extax[1] += 350;
        checkBinds(measured(system, command).external[1], 500);
    }
}

TEST_CASE("the speed of an axis is limited", "[motion][limits]") {
    MotionSystem system = robotWithExternalAxes();
    checkBinds(measured(system, axisOne(system, 160)).axis, system.model().maxSpeed[0]);
}

TEST_CASE("the acceleration of an axis is limited", "[motion][limits]") {
    MotionSystem system = robotWithExternalAxes();
    MoveCommand command = axisOne(system, 160);
    double limit = accelerationOfAxisOne(system);
    SECTION("AccSet") { // 40 % make the ramp long enough for the averaging to show the whole of it
        command.settings.accelerationPercent = 40;
        limit *= 0.4;
    }
    SECTION("AccSet below 20 acts as 20") {
        command.settings.accelerationPercent = 1;
        limit *= 0.2;
    }
    SECTION("load: at the rated payload two thirds remain") {
        command.settings.accelerationPercent = 40;
        command.load.mass = system.model().payloadKg;
        limit *= 0.4 / 1.5;
    }
    checkBinds(measured(system, command).axisGain, limit, 0.97);
}

// The accelerations of this robot were identified with 1 kg (docs/motion.md): these are the accelerations with it.
TEST_CASE("the load of the recordings is part of what they gave", "[motion][limits]") {
    MotionSystem system(robot::loadRobotModel("IRB 6640-180/2.55").value(), {});
    MoveCommand command = axisOne(system, 40);
    command.settings.accelerationPercent = 40;
    const double free = measured(system, command).axisGain;
    command = axisOne(system, -40);
    command.settings.accelerationPercent = 40;
    command.load.mass = 1;
    command.load.inertia = 0.3;
    CHECK(measured(system, command).axisGain == Approx(free).epsilon(1e-6));
    command = axisOne(system, 40);
    command.settings.accelerationPercent = 40;
    command.load.mass = 181; // 180 kg more, the rated payload
    CHECK(measured(system, command).axisGain == Approx(free / 1.5).epsilon(0.03));
}

// In the corner between two joint moves the tool turns back: slow at the turn, it must not be faster beside it.
TEST_CASE("v_tcp holds where the tool turns back in a corner of axes", "[motion][limits]") {
    MotionSystem system = robotWithExternalAxes();
    MoveCommand command = fast(system, MoveKind::AbsJoint);
    command.speed.vTcp = 100;
    command.zone = {false, 50, 75, 75, 7.5, 75, 7.5};
    command.joints.robax = {-3.30, 5.26, 26.03, 7.40, 52.26, -22.51};
    REQUIRE(system.enqueue(command));
    command.zone = {};
    command.joints.robax = {-1.92, 9.71, -3.27, 24.31, 47.02, -18.88};
    const double fastest = measured(system, command).tcp;
    CHECK(fastest <= 100.5);
    CHECK(fastest >= 99);
}

TEST_CASE("PathAccLim limits both changes of speed apart", "[motion][limits]") {
    MotionSystem system = robotWithExternalAxes();
    MoveCommand command = line(system, 250);
    command.speed.vTcp = 600;
    command.settings.pathAcceleration = 1;
    command.settings.pathDeceleration = 1.5;
    const Most most = measured(system, command);
    checkBinds(most.gain, 1000, 0.97);
    checkBinds(most.drop, 1500, 0.97);
}

TEST_CASE("WorldAccLim limits the TCP in every direction", "[motion][limits]") {
    MotionSystem system = robotWithExternalAxes();
    MoveCommand command = line(system, 150);
    command.settings.worldAcceleration = 1;
    double share = 0.97; // nothing across a line
    SECTION("along a line") {}
    SECTION("on a circle") {
        share = 0.68; // along and across share it: 0.71 each
        command.kind = MoveKind::Circular;
        command.circlePoint = robot::offs(system.toRobTarget(system.plannedEnd(), {}).pose, -75, 75, 0);
    }
    checkBinds(measured(system, command).world, 1000, share);
}

TEST_CASE("a duration is kept, and limits hold all the same", "[motion][limits]") {
    MotionSystem system = robotWithExternalAxes();
    MoveCommand command = axisOne(system, 100);
    SECTION("long enough") {
        command.duration = 3;
        const Most most = measured(system, command);
        CHECK(most.seconds == Approx(3.02).margin(0.005)); // it begins 0.02 s after the order
    }
    SECTION("too short") {
        command.duration = 0.01;
        checkBinds(measured(system, command).axis, system.model().maxSpeed[0]);
    }
}

TEST_CASE("speed limits of a system input hold at once", "[motion][limits]") {
    MotionSystem system = robotWithExternalAxes();
    SpeedLimits limits;
    SECTION("TCP") {
        MoveCommand command = line(system, 250);
        command.speed.vTcp = 400;
        limits.tcp = 50;
        system.setSpeedLimits(limits);
        checkBinds(measured(system, command).tcp, 50);
    }
    SECTION("axis") {
        limits.joints[0] = 30;
        system.setSpeedLimits(limits);
        checkBinds(measured(system, axisOne(system, 90)).axis, 30);
    }
    SECTION("external axis") {
        limits.external[0] = 70;
        system.setSpeedLimits(limits);
        MoveCommand command = fast(system, MoveKind::AbsJoint);
        command.joints.extax[0] += 200;
        checkBinds(measured(system, command).external[0], 70);
    }
    SECTION("also a movement with a duration") {
        MoveCommand command = axisOne(system, 90);
        command.duration = 1;
        limits.joints[0] = 30;
        system.setSpeedLimits(limits);
        checkBinds(measured(system, command).axis, 30);
    }
}

TEST_CASE("a speed limit changes the movement in progress", "[motion][limits]") {
    for (const Planner planner : {Planner::Measured, Planner::Optimal}) {
        MotionSystem system = robotWithExternalAxes(planner);
        MoveCommand command = line(system, 250);
        command.speed.vTcp = 100;
        SpeedLimits limits;
        limits.tcp = 20;
        double slowest = 1e9;
        double after = 0;
        const Most most = measured(system, command, [&](double second) {
            if (std::abs(second - 0.8) < 1e-6) system.setSpeedLimits(limits);
            if (second > 1.2 && second < 2) slowest = std::min(slowest, system.current().tcpSpeed);
            if (std::abs(second - 2) < 1e-6) system.setSpeedLimits({});
            if (std::abs(second - 2.4) < 1e-6) after = system.current().tcpSpeed;
        });
        CHECK(most.tcp == Approx(100).epsilon(0.002));
        CHECK(slowest == Approx(20).epsilon(0.001));
        CHECK(after == Approx(100).epsilon(0.001));
    }
}

TEST_CASE("a limited movement with a duration keeps its pace when the limit goes", "[motion][limits]") {
    for (const Planner planner : {Planner::Measured, Planner::Optimal}) {
        MotionSystem system = robotWithExternalAxes(planner);
        MoveCommand command = axisOne(system, 90);
        command.duration = 3; // about 32 deg/s
        SpeedLimits limits;
        limits.joints[0] = 10;
        const Most most = measured(system, command, [&](double second) {
            if (std::abs(second - 0.8) < 1e-6) system.setSpeedLimits(limits);
            if (std::abs(second - 1.8) < 1e-6) system.setSpeedLimits({});
        });
        CHECK(most.axis < 33);
        CHECK(most.seconds == Approx(3.7).margin(0.1)); // a second at a third of the speed
    }
}
