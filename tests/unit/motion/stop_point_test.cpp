// Movements that follow a stop point (docs/motion.md, "Stops, waits and the program"; decision 115).

#include "runtime/motion/motion_system.h"
#include "tests/unit/motion/motion_system_rig.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace motion_testing;

namespace {

MoveCommand lineBy(const MotionSystem& system, double mm) {
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.confL = false;
    command.speed.vTcp = 500;
    command.target = calcRobTarget(system.kinematics(), system.plannedEnd(), command.frames);
    command.target.pose = robot::offs(command.target.pose, 0, mm, 0);
    return command;
}

/// Two lines, the second one ordered that long after the program is released at the end of the first.
struct TwoLines {
    double seconds = 0;         ///< from the release to standstill at the end
    std::vector<double> places; ///< mm, of the TCP from the order on, each 0.1 ms
};

TwoLines twoLines(TimeNs wait) {
    MotionSystem system(robot::loadRobotModel("IRB 6640-180/2.55").value());
    system.placeAt({{0, 10, 10, 0, 60, 0}, kNoExternalAxes});
    const MoveId first = system.enqueue(lineBy(system, 100)).value();
    while (!system.isReleased(first))
        system.advanceTo(*system.nextEventTime());
    const TimeNs released = system.now();
    TwoLines result;
    system.advanceTo(released + wait);
    REQUIRE(system.enqueue(lineBy(system, 100)));
    while (!system.isIdle() || system.isMoving()) {
        system.advanceTo(system.now() + kMs / 10);
        if (result.places.size() < 400) result.places.push_back(system.current().tcp.pos.y);
    }
    result.seconds = 1e-9 * static_cast<double>(system.now() - released);
    return result;
}

} // namespace

TEST_CASE("the time of a movement after a stop point grows evenly with the time of its order",
          "[motion][stop]") {
    const double atOnce = twoLines(0).seconds;
    // A little later costs that time and a little more: no step.
    CHECK(twoLines(kMs / 10).seconds - atOnce == Approx(0.0002).margin(0.0002));
    CHECK(twoLines(kMs).seconds - atOnce == Approx(0.0018).margin(0.0004));
    // Ordered when the arm is at rest it begins 20 ms later; ordered at once when the last mm is left, about 10 ms before the release.
    CHECK(twoLines(100 * kMs).seconds - atOnce == Approx(0.13).margin(0.007));
    double before = atOnce;
    for (TimeNs wait = 5 * kMs; wait <= 80 * kMs; wait += 5 * kMs) {
        const double seconds = twoLines(wait).seconds;
        CHECK(seconds - before > 0.004);
        CHECK(seconds - before < 0.011);
        before = seconds;
    }
}

TEST_CASE("a movement after a stop point begins without a step of place or speed", "[motion][stop]") {
    for (const TimeNs wait : {TimeNs{0}, kMs, 10 * kMs, 30 * kMs}) {
        INFO("ordered after " << wait << " ns");
        const std::vector<double> y = twoLines(wait).places;
        double most = 0; // m/s^2
        for (std::size_t i = 2; i < y.size(); ++i)
            most = std::max(most, std::abs(y[i] - 2 * y[i - 1] + y[i - 2]) / 1e-8 / 1000);
        CHECK(most < 10); // this arm accelerates its TCP by about as much
    }
}

TEST_CASE("a turning movement is at its stop point when a quarter of a degree is left", "[motion][stop]") {
    // 0.5 mm are left; a degree counts as 2 mm (decision 118).
    MotionSystem system(robot::loadRobotModel("IRB 6640-180/2.55").value());
    system.placeAt({{0, 10, 10, 0, 60, 0}, kNoExternalAxes});
    for (const double speed : {30.0, 120.0}) {
        MoveCommand command = lineBy(system, 0);
        command.speed.vOri = speed;
        command.target.pose.rot = command.target.pose.rot * robot::fromAxisAngle({0, 0, 1}, 60);
        const MoveId move = system.enqueue(command).value();
        while (!system.isReleased(move))
            system.advanceTo(*system.nextEventTime());
        const double left = robot::angleBetween(system.current().tcp.rot, command.target.pose.rot);
        CHECK(left == Approx(0.25).margin(0.01));
        while (!system.isIdle() || system.isMoving())
            system.advanceTo(*system.nextEventTime());
    }
}

TEST_CASE("after a stop point at the end of a short move its place is read", "[motion][stop]") {
    // Reading a position after a stop point gives the point (decision 61), even if the arm is near it before the corner ahead
    // of the last move, 0.3 mm long, is passed.
    MotionSystem system(robot::loadRobotModel("IRB 6640-180/2.55").value());
    system.placeAt({{0, 10, 10, 0, 60, 0}, kNoExternalAxes});
    MoveCommand first = lineBy(system, 50);
    first.zone = {false, 10, 15, 15, 1.5, 15, 1.5};
    const MoveId passed = system.enqueue(first).value();
    MoveCommand second = lineBy(system, 0);
    second.target.pose = robot::offs(second.target.pose, 0.3, 0, 0);
    const MoveId last = system.enqueue(second).value();
    while (!system.isReleased(last))
        system.advanceTo(*system.nextEventTime());
    CHECK(system.status(passed) == MoveStatus::Done);
    const Vec3 read = system.currentTarget(second.frames).pose.pos;
    CHECK(norm(read - second.target.pose.pos) < 1e-6);
}
