// AccSet \FinePointRamp (docs/motion.md, "How a movement is timed"): deceleration decreases more slowly towards a stop
// point, and nothing else changes.

#include "runtime/motion/motion_system.h"
#include "tests/unit/motion/motion_system_rig.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace motion_testing;

namespace {

struct Motion {
    std::vector<double> places; ///< mm from the start, at each ms
    double duration() const { return 1e-3 * static_cast<double>(places.size()); }
};

/// A line of 300 mm at 500 mm/s that brakes with 1 m/s^2; then, with a zone, 100 mm more.
Motion lineWith(Planner planner, double ramp, double finePointRamp, bool isFlyBy = false) {
    MotionOptions options;
    options.planner = planner;
    MotionSystem system(robot::loadRobotModel("IRB 120-3/0.58").value(), options);
    system.placeAt({{0, 10, 10, 0, 60, 0}, kNoExternalAxes});
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.confL = false;
    command.speed.vTcp = 500;
    command.settings.pathDeceleration = 1;
    command.settings.rampPercent = ramp;
    command.settings.finePointRampPercent = finePointRamp;
    command.target = calcRobTarget(system.kinematics(), system.plannedEnd(), command.frames);
    command.target.pose = robot::offs(command.target.pose, 0, -150, 0);
    command.speed.vTcp = 500;
    system.placeAt({system.kinematics().inverseNear(command.target.pose, system.current().joints).value(),
                    kNoExternalAxes});
    const double begin = command.target.pose.pos.y;
    command.target.pose = robot::offs(command.target.pose, 0, 300, 0);
    if (isFlyBy) command.zone = {false, 10, 15, 15, 1, 15, 1};
    REQUIRE(system.enqueue(command).hasValue());
    if (isFlyBy) {
        command.target.pose = robot::offs(command.target.pose, 0, 50, 0);
        command.zone = {};
        command.settings.finePointRampPercent = 100;
        REQUIRE(system.enqueue(command).hasValue());
    }
    Motion motion;
    while (!system.isIdle() || system.isMoving()) {
        system.advanceTo(system.now() + kMs);
        motion.places.push_back(system.current().tcp.pos.y - begin);
    }
    CHECK(motion.places.back() == Approx(isFlyBy ? 350 : 300).margin(1e-6));
    return motion;
}

} // namespace

TEST_CASE("FinePointRamp lengthens the end of the braking for a stop point", "[motion][accset]") {
    const robot::RobotModel model = robot::loadRobotModel("IRB 120-3/0.58").value();
    const double windows = model.dynamics.longWindow + model.dynamics.shortWindow;
    const Motion normal = lineWith(Planner::Measured, 100, 100);
    for (const double percent : {80.0, 50.0, 25.0}) {
        const Motion soft = lineWith(Planner::Measured, 100, percent);
        // Deceleration a falls evenly to zero in T besides the windows: it takes T / 2 longer than at the full one, and
        // covers a T^2 / 24 more, which is missing at the speed v before.
        const double taper = windows * (100 / percent - 1);
        const double longer = taper / 2 - 1000 * taper * taper / (24 * 500);
        INFO(percent << " percent");
        CHECK(soft.duration() - normal.duration() ==
              Approx(longer).margin(0.002 + taper / 72)); // in 24 parts
        for (std::size_t k = 0; k < 300; ++k)             // nothing changes while it accelerates
            CHECK(soft.places[k] == Approx(normal.places[k]).margin(1e-9));
    }
    CHECK(lineWith(Planner::Measured, 100, 5).duration() == lineWith(Planner::Measured, 100, 10).duration());
}

TEST_CASE("FinePointRamp counts where it is below Ramp only, and not at fly-by points", "[motion][accset]") {
    for (const Planner planner : {Planner::Measured, Planner::Optimal}) {
        CHECK(lineWith(planner, 50, 100).places == lineWith(planner, 50, 50).places);
        CHECK(lineWith(planner, 50, 25).duration() > lineWith(planner, 50, 50).duration() + 0.004);
        CHECK(lineWith(planner, 100, 25, true).duration() ==
              Approx(lineWith(planner, 100, 100, true).duration()).margin(1e-9));
    }
}

TEST_CASE("FinePointRamp lowers the jerk at the end of the optimal planner's movements", "[motion][accset]") {
    const Motion normal = lineWith(Planner::Optimal, 100, 100);
    const Motion soft = lineWith(Planner::Optimal, 100, 30);
    CHECK(soft.duration() > normal.duration() + 0.004);
    CHECK(soft.places[300] ==
          Approx(normal.places[300]).margin(0.5)); // the optimum is found to 0.1 % of the time
    // 20 ms before the end deceleration still decreases: the speed is lower there.
    const auto speedBefore = [](const Motion& motion) {
        return motion.places[motion.places.size() - 20] - motion.places[motion.places.size() - 21];
    };
    CHECK(speedBefore(soft) < 0.7 * speedBefore(normal));
}
