// Lines and circles in a work object that the robot holds, the tool standing in world, by every mechanism (manual 2.1: a
// stationary tool). The tool moves along the line or circle as seen from the work object.

#include "runtime/motion/motion_system.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace motion;

namespace {

struct Arm {
    const char* name;
    Joints posture;
};
const Arm kArms[] = {{"IRB 120-3/0.58", {0, 10, 10, 20, 60, 30}},
                     {"CRB 15000-5/0.95", {10, 10, 20, 30, 60, 30}},
                     {"IRB 14050-0.5/0.559", {0, -130, 30, 0, 40, 0, 135}},
                     {"IRB 14000-0.5/0.559-R", {0, -130, 30, 0, 40, 0, -135}},
                     {"IRB 460-110/2.4", {10, 20, 30, 40}},
                     {"IRB 910SC-3/0.65", {20, 60, -60, 10}},
                     {"IRB 360-1/1600", {20, 25, 30, 40}},
                     {"IRB 390-15/1300", {20, 25, 30, 40}}};

/// The tool where the flange is now, turned to it so that arms of four axes can follow; the object somewhere on the flange.
FrameSetup framesAt(const MotionSystem& system) {
    FrameSetup frames;
    frames.tool.robotHeld = false;
    frames.tool.tframe = robot::offs(system.current().tcp, 20, 10, 0);
    frames.workObject.robotHeld = true;
    frames.workObject.uframe = {{5, -10, 30}, robot::fromAxisAngle({0, 0, 1}, 25)};
    frames.workObject.oframe = {{1, 2, 3}, robot::fromAxisAngle({0, 0, 1}, -10)};
    return frames;
}

MotionSystem armAt(const Arm& arm) {
    MotionSystem system(robot::loadRobotModel(arm.name).value());
    REQUIRE(system.placeAt({arm.posture, kNoExternalAxes}));
    return system;
}

/// Calls `each` with the tool as seen from the work object, each 4 ms of the movement.
template <class Each> void runFrom(MotionSystem& system, const FrameSetup& frames, Each each) {
    int samples = 0;
    while (!system.isIdle() || system.isMoving()) {
        system.advanceTo(system.now() + 4'000'000);
        each(system.toRobTarget({system.current().joints, kNoExternalAxes}, frames).pose);
        CHECK(norm(system.current().tcp.pos - frames.tool.tframe.pos) < 1e-9); // the tool does not move
        ++samples;
    }
    CHECK(samples > 20);
}

MoveCommand moveOf(MoveKind kind, const MotionSystem& system, const FrameSetup& frames) {
    MoveCommand command;
    command.kind = kind;
    command.frames = frames;
    command.target = system.toRobTarget(system.plannedEnd(), frames);
    command.speed.vTcp = 100;
    return command;
}

} // namespace

TEST_CASE("every mechanism moves a held work object along a line at a stationary tool",
          "[motion][stationary]") {
    for (const Arm& arm : kArms) {
        CAPTURE(arm.name);
        MotionSystem system = armAt(arm);
        const FrameSetup frames = framesAt(system);
        MoveCommand line = moveOf(MoveKind::Linear, system, frames);
        const Pose from = line.target.pose;
        const Vec3 way{12, -15, 9};
        line.target.pose = robot::offs(from, way.x, way.y, way.z);
        const auto ordered = system.enqueue(line);
        INFO((ordered ? std::string() : ordered.error().message()));
        REQUIRE(ordered.hasValue());
        double fastest = 0;
        runFrom(system, frames, [&](const Pose& seen) {
            const Vec3 gone = seen.pos - from.pos;
            CHECK(norm(gone - way * (dot(gone, way) / dot(way, way))) < 1e-6);
            CHECK(robot::angleBetween(seen.rot, from.rot) < 1e-5);
            fastest = std::max(fastest, system.current().tcpSpeed);
        });
        CHECK(fastest <= 100.5); // relative to the work object
        CHECK(norm(system.toRobTarget(system.currentJoints(), frames).pose.pos - line.target.pose.pos) <
              1e-6);
    }
}

TEST_CASE("every mechanism moves a held work object on a circle at a stationary tool",
          "[motion][stationary]") {
    for (const Arm& arm : kArms) {
        for (const CircleOrientation mode :
             {CircleOrientation::PathFrame, CircleOrientation::ObjectFrame, CircleOrientation::CirclePoint}) {
            CAPTURE(arm.name, static_cast<int>(mode));
            MotionSystem system = armAt(arm);
            const FrameSetup frames = framesAt(system);
            MoveCommand circle = moveOf(MoveKind::Circular, system, frames);
            const Pose from = circle.target.pose;
            circle.circleOrientation = mode;
            circle.confL = false;
            circle.circlePoint = robot::offs(from, 15, 15, 0); // a half circle about (15, 0)
            circle.target.pose = robot::offs(from, 30, 0, 0);
            const auto ordered = system.enqueue(circle);
            INFO((ordered ? std::string() : ordered.error().message()));
            REQUIRE(ordered.hasValue());
            const Vec3 centre = from.pos + Vec3{15, 0, 0};
            runFrom(system, frames, [&](const Pose& seen) {
                CHECK(norm(seen.pos - centre) == Approx(15).margin(1e-6));
                CHECK(seen.pos.z == Approx(from.pos.z).margin(1e-6));
            });
            const Pose end = system.toRobTarget(system.currentJoints(), frames).pose;
            CHECK(norm(end.pos - circle.target.pose.pos) < 1e-6);
            CHECK(robot::angleBetween(end.rot, from.rot) < 1e-5);
        }
    }
}
