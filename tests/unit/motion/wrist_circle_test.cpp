// Circles by two axes of the wrist (CirPathMode \Wrist45, \Wrist46, \Wrist56): the axes that move, the circle that the tool
// cuts, what is refused.

#include "runtime/motion/motion_system.h"
#include "tests/unit/motion/motion_system_rig.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace motion_testing;

namespace {

const Joints kBent{0, 10, 10, 20, 50, 60};

MotionSystem armAt(const Joints& joints, const char* name = "IRB 120-3/0.58") {
    MotionSystem system(robot::loadRobotModel(name).value());
    system.placeAt({joints, kNoExternalAxes});
    return system;
}

FrameSetup longTool() {
    FrameSetup frames;
    frames.tool.tframe = {{20, 0, 150}, {1, 0, 0, 0}};
    return frames;
}

/// A half circle of this radius in the plane across the tool, beginning where the TCP is.
MoveCommand halfCircle(const MotionSystem& system, double radius, CircleOrientation by) {
    MoveCommand command;
    command.kind = MoveKind::Circular;
    command.frames = longTool();
    command.target = system.toRobTarget(system.plannedEnd(), command.frames);
    const Pose tcp = command.target.pose;
    command.circlePoint = robot::relTool(tcp, radius, radius, 0, 0, 0, 0);
    command.target.pose = robot::relTool(tcp, 2 * radius, 0, 0, 0, 0, 0);
    command.circleOrientation = by;
    command.speed.vTcp = 20;
    return command;
}

} // namespace

TEST_CASE("two axes of the wrist cut the circle, the others stand still", "[motion][wrist]") {
    struct Case {
        CircleOrientation by;
        std::size_t first, second;
        double axis6; // so that the two axes move the TCP in different directions
    };
    for (const Case& c :
         {Case{CircleOrientation::Wrist45, 3, 4, 60}, Case{CircleOrientation::Wrist46, 3, 5, 60},
          Case{CircleOrientation::Wrist56, 4, 5, 0}}) {
        CAPTURE(c.first, c.second);
        Joints bent = kBent;
        bent[5] = c.axis6;
        MotionSystem system = armAt(bent);
        const MoveCommand command = halfCircle(system, 3, c.by);
        const Pose start = system.toRobTarget(system.plannedEnd(), command.frames).pose;
        const auto ordered = system.enqueue(command);
        INFO((ordered ? std::string() : ordered.error().message()));
        REQUIRE(ordered.hasValue());
        const Vec3 centre = robot::relTool(start, 3, 0, 0, 0, 0, 0).pos;
        const Vec3 normal = rotate(start.rot, {0, 0, 1});
        double tilt = 0;
        int samples = 0;
        while (!system.isIdle() || system.isMoving()) {
            system.advanceTo(system.now() + 4 * kMs);
            const MotionState state = system.current();
            for (std::size_t i = 0; i < 6; ++i)
                if (i != c.first && i != c.second) CHECK(state.joints[i] == bent[i]);
            const Vec3 tool = rotate(state.tcp.rot, {0, 0, 1});
            const Vec3 cut = state.tcp.pos + tool * (dot(normal, centre - state.tcp.pos) / dot(normal, tool));
            CHECK(norm(cut - centre) == Approx(3).margin(1e-6)); // the tool cuts the circle
            CHECK(norm(state.tcp.pos - cut) < 1);                // the TCP stays near the sheet
            tilt = std::max(tilt, robot::angleBetween(state.tcp.rot, start.rot));
            ++samples;
        }
        CHECK(samples > 50);
        const Vec3 end = system.current().tcp.pos;
        CHECK(norm(end - command.target.pose.pos) < 1);
        CHECK(tilt > 1); // the orientation is what comes of it
    }
}

TEST_CASE("a move after a circle by the wrist begins where that ended", "[motion][wrist]") {
    MotionSystem system = armAt(kBent);
    const MoveCommand command = halfCircle(system, 3, CircleOrientation::Wrist45);
    REQUIRE(system.enqueue(command).hasValue());
    MoveCommand line = command;
    line.kind = MoveKind::Linear; // with the programmed orientation again
    line.target.pose = robot::relTool(command.target.pose, 0, 0, -20, 0, 0, 0);
    REQUIRE(system.enqueue(line).hasValue());
    for (int i = 0; i < 10'000 && system.nextEventTime(); ++i)
        system.advanceTo(*system.nextEventTime());
    const Pose end = system.toRobTarget(system.currentJoints(), command.frames).pose;
    CHECK(norm(end.pos - line.target.pose.pos) < 1e-6);
    CHECK(robot::angleBetween(end.rot, line.target.pose.rot) < 1e-5);
}

TEST_CASE("three points on a line run as a line in the modes of the wrist, too", "[motion][wrist]") {
    MotionSystem system = armAt(kBent);
    MoveCommand command = halfCircle(system, 3, CircleOrientation::Wrist45);
    const Pose start = system.toRobTarget(system.plannedEnd(), command.frames).pose;
    command.circlePoint = robot::relTool(start, 3, 0, 0, 0, 0, 0);
    REQUIRE(system.enqueue(command).hasValue());
    for (int i = 0; i < 10'000 && system.nextEventTime(); ++i)
        system.advanceTo(*system.nextEventTime());
    const Pose end = system.toRobTarget(system.currentJoints(), command.frames).pose;
    CHECK(norm(end.pos - command.target.pose.pos) < 1e-6);
    CHECK(robot::angleBetween(end.rot, start.rot) < 1e-5);
}

TEST_CASE("circles that the wrist cannot run are refused", "[motion][wrist]") {
    const auto kindOf = [](MotionSystem& system, const MoveCommand& command) {
        const auto result = system.enqueue(command);
        REQUIRE_FALSE(result.hasValue());
        CHECK_FALSE(result.error().message().empty());
        return result.error().kind;
    };
    MotionSystem system = armAt(kBent);
    MoveCommand large = halfCircle(system, 300, CircleOrientation::Wrist45);
    const MotionErrorKind kind = kindOf(system, large);
    CHECK((kind == MotionErrorKind::Unreachable || kind == MotionErrorKind::Singularity ||
           kind == MotionErrorKind::JointOutOfRange));
    MoveCommand upright = halfCircle(system, 3, CircleOrientation::Wrist45);
    const Pose start = system.toRobTarget(system.plannedEnd(), upright.frames).pose;
    upright.circlePoint = robot::relTool(start, 3, 0, 3, 0, 0, 0); // the tool lies in the plane of the circle
    CHECK(kindOf(system, upright) == MotionErrorKind::BadArgument);
    // Axes 4 and 6 both move this TCP across the plane through them: they cannot cut a circle together.
    MotionSystem straight = armAt({0, 10, 10, 20, 50, 0});
    CHECK(kindOf(straight, halfCircle(straight, 3, CircleOrientation::Wrist46)) ==
          MotionErrorKind::Singularity);
    MoveCommand stationary = halfCircle(system, 3, CircleOrientation::Wrist46);
    stationary.frames.tool.robotHeld = false;
    stationary.frames.workObject.robotHeld = true;
    stationary.frames.tool.tframe = {{400, 0, 300}, {0, 0, 1, 0}};
    const Pose there = system.toRobTarget(system.plannedEnd(), stationary.frames).pose;
    stationary.target.pose = robot::offs(there, 6, 0, 0);
    stationary.circlePoint = robot::offs(there, 3, 3, 0);
    CHECK(kindOf(system, stationary) == MotionErrorKind::BadArgument);
    MotionSystem palletizer = armAt({0, 10, 20, 0}, "IRB 460-110/2.4");
    MoveCommand four = halfCircle(palletizer, 30, CircleOrientation::Wrist56);
    CHECK(kindOf(palletizer, four) == MotionErrorKind::BadArgument);
    MoveCommand conf = halfCircle(system, 3, CircleOrientation::Wrist45);
    conf.target.conf.cf6 += 2;
    CHECK(kindOf(system, conf) == MotionErrorKind::ConfigurationMismatch);
    conf.confL = false;
    CHECK(system.enqueue(conf).hasValue());
}
