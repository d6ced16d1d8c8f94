// Speed override changed while the arm moves: operator's and program's, path and time (docs/motion.md).

#include "motion_system_rig.h"

#include <algorithm>

using namespace motion_testing;

namespace {

constexpr double kWindows =
    0.156; // s, of the arm's two averages: no ramp takes longer beyond its acceleration

void enqueueCorners(MotionSystem& system) {
    for (const auto& [x, y] : {std::pair{0.0, 120.0}, {80.0, 120.0}, {80.0, 0.0}}) {
        MoveCommand line = lineFrom(system, 0, 0, 0);
        line.target = calcRobTarget(system.kinematics(), JointTarget{{0, 0, 0, 0, 30, 0}, kNoExternalAxes},
                                    line.frames);
        line.target.pose = robot::offs(line.target.pose, x, y, -100);
        line.zone = {false, 30, 45, 45, 4.5, 45, 4.5};
        line.zone.finep = x > 0 && y == 0;
        REQUIRE(system.enqueue(line).hasValue());
    }
}

std::vector<Vec3> pathWith(std::vector<double> percents, bool ofProgram) {
    MotionSystem system = makeSystem();
    enqueueCorners(system);
    std::vector<Vec3> path;
    for (int ms = 1; ms < 60'000 && !(system.isIdle() && !system.isMoving()); ++ms) {
        system.advanceTo(ms * kMs);
        if (ms % 90 == 0) {
            const double percent = percents[static_cast<std::size_t>(ms / 90) % percents.size()];
            ofProgram ? system.setProgramOverride(percent) : system.setOverride(percent);
        }
        path.push_back(system.current().tcp.pos);
    }
    CHECK(system.isIdle());
    return path;
}

double distanceTo(const Vec3& point, const std::vector<Vec3>& path) {
    double least = 1e9;
    for (std::size_t i = 1; i < path.size(); ++i) {
        const Vec3 way = path[i] - path[i - 1];
        const double square = dot(way, way);
        const double share = square > 0 ? std::clamp(dot(point - path[i - 1], way) / square, 0.0, 1.0) : 0.0;
        least = std::min(least, norm(point - (path[i - 1] + way * share)));
    }
    return least;
}

} // namespace

TEST_CASE("overrides that change on lines and in corners leave the curve as it is",
          "[motion][override][slow]") {
    const std::vector<Vec3> slow = pathWith({10}, false);
    for (const bool ofProgram : {false, true}) {
        double worst = 0;
        for (const Vec3& point : pathWith({30, 100, 0, 70, 5}, ofProgram))
            worst = std::max(worst, distanceTo(point, slow));
        CHECK(worst < 0.01); // chords of the slow run
    }
}

TEST_CASE("a changed override is in force after the ramp of the two windows", "[motion][override]") {
    MotionSystem system = makeSystem();
    REQUIRE(system.enqueue(lineFrom(system, 0, 150, -150)).hasValue());
    const auto speedAt = [&](TimeNs time) {
        system.advanceTo(time);
        return system.current().tcpSpeed;
    };
    const double acceleration = 1000; // mm/s^2, which the arm exceeds there
    const auto ramp = [&](double change) {
        return static_cast<TimeNs>((change / acceleration + kWindows) * 1e9);
    };
    CHECK(speedAt(400 * kMs) == Approx(200).epsilon(1e-3));
    system.setOverride(40);
    CHECK(system.current().tcpSpeed == Approx(200).epsilon(1e-3)); // no step
    CHECK(speedAt(system.now() + ramp(120)) == Approx(80).epsilon(1e-3));
    system.setProgramOverride(50); // the product of both counts
    CHECK(speedAt(system.now() + ramp(40)) == Approx(40).epsilon(1e-3));
    system.setOverride(100);
    CHECK(speedAt(system.now() + ramp(60)) == Approx(100).epsilon(1e-3));
    system.setProgramOverride(0);
    CHECK(speedAt(system.now() + ramp(100)) == 0);
    CHECK(system.overrideShare() == 0);
    system.setOverride(60); // one of them still holds the arm
    CHECK_FALSE(system.nextEventTime().has_value());
    system.setProgramOverride(100);
    CHECK(speedAt(system.now() + ramp(120)) == Approx(120).epsilon(1e-3));
}

TEST_CASE("a move with a duration takes that at full override", "[motion][override]") {
    for (const Planner planner : {Planner::Measured, Planner::Optimal}) {
        MotionOptions options;
        options.planner = planner;
        const auto duration = [&](double before, double after) {
            MotionSystem system = makeSystem(options);
            system.setOverride(before);
            MoveCommand command = lineFrom(system, 0, 150, -150);
            command.duration = 4;
            REQUIRE(system.enqueue(command).hasValue());
            system.setOverride(after);
            std::vector<MotionEvent> events;
            run(system, &events);
            return static_cast<double>(timeOf(events, MotionEventKind::Reached, 1)) * 1e-9;
        };
        CHECK(duration(100, 100) == Approx(4).margin(0.1));
        CHECK(duration(50, 50) == Approx(8).margin(2 * kWindows));
        // The speed on the way is the same, and it is reached as fast as ever: the ramps of both windows.
        CHECK(duration(50, 100) == Approx(4).margin(kWindows));
        CHECK(duration(100, 50) == Approx(8).margin(2 * kWindows));
    }
}
