// MotionSystem::sampleStopped: where stop() would leave the arm, asked while it moves.

#include "runtime/motion/motion_system.h"
#include "runtime/motion/path.h"
#include "tests/unit/motion/motion_system_rig.h"

#include <catch2/catch.hpp>

using namespace motion_testing;

namespace {

/// A joint move, then two lines with a corner between them.
MotionSystem underWay() {
    auto model = robot::loadRobotModel("IRB 120-3/0.58");
    REQUIRE(model.hasValue());
    MotionSystem system(*model);
    MoveCommand joints;
    joints.joints.robax = {20, 10, -10, 0, 40, 0};
    joints.speed.vTcp = 1000;
    REQUIRE(system.enqueue(joints));
    for (const bool isFlyBy : {true, false}) {
        MoveCommand line;
        line.kind = MoveKind::Linear;
        line.target = calcRobTarget(system.kinematics(), system.plannedEnd(), line.frames);
        line.target.pose = robot::offs(line.target.pose, 0, isFlyBy ? -120 : 0, isFlyBy ? 0 : 100);
        line.speed.vTcp = 300;
        line.confL = false;
        line.zone.finep = !isFlyBy;
        line.zone.pzoneTcp = 20;
        line.zone.pzoneOri = 30;
        REQUIRE(system.enqueue(line));
    }
    return system;
}

MotionState stoppedAt(TimeNs time) {
    MotionSystem system = underWay();
    system.advanceTo(time);
    system.stop();
    while (const auto next = system.nextEventTime())
        system.advanceTo(*next);
    return system.current();
}

void checkSame(const MotionState& expected, const MotionState& actual) {
    for (std::size_t i = 0; i < expected.joints.size(); ++i)
        CHECK(actual.joints[i] == Approx(expected.joints[i]).margin(1e-6));
    CHECK(robot::norm(actual.tcp.pos - expected.tcp.pos) < 1e-5);
}

} // namespace

TEST_CASE("the place where a stop would leave the arm is known beforehand", "[motion]") {
    for (TimeNs time = 0; time < 2000 * kMs; time += 37 * kMs) {
        CAPTURE(time);
        MotionSystem system = underWay();
        system.advanceTo(time);
        const MotionState here = system.sampleStopped(time);
        const MotionState ahead = system.sampleStopped(time + kMs);
        checkSame(stoppedAt(time), here);
        checkSame(stoppedAt(time + kMs), ahead);
    }
}

TEST_CASE("an arm that brakes already stops where it is going to", "[motion]") {
    MotionSystem system = underWay();
    system.advanceTo(900 * kMs);
    system.stop();
    system.advanceTo(920 * kMs);
    checkSame(stoppedAt(900 * kMs), system.sampleStopped(920 * kMs));
}

TEST_CASE("an arm off its path stops where its axes have braked", "[motion]") {
    MotionSystem system = underWay();
    system.advanceTo(900 * kMs);
    system.halt();
    const MotionState predicted = system.sampleStopped(900 * kMs);
    while (const auto next = system.nextEventTime())
        system.advanceTo(*next);
    checkSame(system.current(), predicted);
}
