// Motors off: the arm brakes off its path, comes back to it, and continues (manual 2.2.6).

#include "runtime/motion/motion_system.h"
#include "tests/unit/motion/motion_system_rig.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace motion_testing;

namespace {

MoveCommand line(const MotionSystem& system, double x, double y, double z) {
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.target = calcRobTarget(system.kinematics(), system.plannedEnd(), command.frames);
    command.target.pose = robot::offs(command.target.pose, x, y, z);
    command.speed.vTcp = 400;
    command.confL = false;
    return command;
}

/// Distance of a point from the straight line a to b.
double offLine(const robot::Vec3& p, const robot::Vec3& a, const robot::Vec3& b) {
    const robot::Vec3 d = b - a;
    const double t = std::clamp(
        ((p.x - a.x) * d.x + (p.y - a.y) * d.y + (p.z - a.z) * d.z) / (norm(d) * norm(d)), 0.0, 1.0);
    return norm(p - (a + d * t));
}

/// Until nothing more happens; how often each kind of event came for the move.
int finish(MotionSystem& system, MotionEventKind kind, MoveId move) {
    int count = 0;
    while (const auto next = system.nextEventTime()) {
        system.advanceTo(*next);
        for (const MotionEvent& event : system.takeEvents())
            count += event.kind == kind && event.move == move;
    }
    return count;
}

bool isAt(const MotionSystem& system, const Joints& goal) {
    const Joints here = system.currentJoints().robax;
    for (std::size_t i = 0; i < goal.size(); ++i)
        if (std::fabs(here[i] - goal[i]) > 1e-6) return false;
    return true;
}

} // namespace

TEST_CASE("a halt takes the arm off its path, a start brings it back", "[motion][halt]") {
    MotionSystem system = makeSystem();
    system.enqueue(line(system, 0, 150, -100)).value();
    const robot::Vec3 from = system.current().tcp.pos;
    const Joints goal = system.plannedEnd().robax;
    const MoveId move = system.lastOrdered();
    system.advanceTo(250 * kMs);
    REQUIRE(system.isMoving());
    const robot::Vec3 at = system.current().tcp.pos;
    system.halt();
    CHECK(system.isStopRequested());
    const TimeNs rest = system.nextEventTime().value();
    system.advanceTo(rest);
    CHECK_FALSE(system.isMoving());
    const auto events = system.takeEvents();
    REQUIRE_FALSE(events.empty());
    CHECK(events.back().kind == MotionEventKind::Stopped);
    CHECK_FALSE(system.isIdle());
    CHECK(norm(system.current().tcp.pos - at) > 0.1); // not on the spot
    CHECK(system.current().tcpSpeed == 0);
    // Nothing moves until the start.
    system.advanceTo(rest + 5000 * kMs);
    CHECK_FALSE(system.nextEventTime().has_value());
    system.start();
    CHECK(finish(system, MotionEventKind::Reached, move) == 1);
    CHECK(isAt(system, goal));
    CHECK(system.isIdle());
    CHECK(offLine(system.current().tcp.pos, from, from + robot::Vec3{0, 150, -100}) < 1e-6);
}

TEST_CASE("braking axes: steady, within their limits, at rest after speed over acceleration",
          "[motion][halt]") {
    MotionSystem system = makeSystem();
    system.enqueue(jointsTo({80, 20, -30, 60, 70, -90})).value();
    system.advanceTo(300 * kMs);
    const MotionState before = system.current();
    const robot::RobotModel& model = system.model();
    system.halt();
    const TimeNs start = system.now(), rest = system.nextEventTime().value();
    double longest = 0;
    for (std::size_t i = 0; i < before.joints.size(); ++i)
        longest = std::max(longest, std::fabs(before.jointSpeed[i]) / model.maxAcceleration[i]);
    CHECK(static_cast<double>(rest - start) * 1e-9 == Approx(longest).epsilon(1e-6));
    MotionState last = before;
    for (TimeNs time = start; time < rest; time += kMs) {
        system.advanceTo(time);
        const MotionState now = system.current();
        for (std::size_t i = 0; i < now.joints.size(); ++i) {
            CHECK(std::fabs(now.jointSpeed[i]) <= std::fabs(last.jointSpeed[i]) + 1e-9);
            CHECK(std::fabs(now.joints[i] - last.joints[i]) <= model.maxSpeed[i] * 1.1e-3);
            CHECK(now.jointSpeed[i] * before.jointSpeed[i] >= 0); // never back
        }
        last = now;
    }
}

TEST_CASE("halts, stops and starts at random: every move is reached, once", "[motion][halt]") {
    std::mt19937 random(3);
    for (int round = 0; round < 30; ++round) {
        MotionSystem system = makeSystem();
        std::vector<MoveId> moves;
        moves.push_back(system.enqueue(jointsTo({30, 10, -10, 20, 50, 10})).value());
        moves.push_back(system.enqueue(line(system, 20, -60, 40)).value());
        moves.push_back(system.enqueue(jointsTo({-20, 0, 5, 0, 40, 0})).value());
        const Joints goal = system.plannedEnd().robax;
        std::vector<int> reached(moves.size());
        const auto advance = [&](TimeNs time) {
            system.advanceTo(time);
            for (const MotionEvent& event : system.takeEvents())
                for (std::size_t i = 0; i < moves.size(); ++i)
                    reached[i] += event.kind == MotionEventKind::Reached && event.move == moves[i];
        };
        robot::Joints last = system.currentJoints().robax;
        for (int step = 0; step < 60; ++step) {
            const TimeNs until = system.now() + static_cast<TimeNs>(random() % 60) * kMs;
            while (system.now() < until) { // no jump, whatever happens
                advance(system.now() + kMs);
                const Joints here = system.currentJoints().robax;
                for (std::size_t i = 0; i < here.size(); ++i)
                    REQUIRE(std::fabs(here[i] - last[i]) <= system.model().maxSpeed[i] * 1.1e-3);
                last = here;
            }
            switch (random() % 4) {
            case 0: system.halt(); break;
            case 1: system.stop(); break;
            default: system.start(); break;
            }
        }
        system.start();
        while (const auto next = system.nextEventTime())
            advance(*next);
        INFO("round " << round);
        CHECK(reached == std::vector<int>{1, 1, 1});
        CHECK(isAt(system, goal));
        CHECK(system.isIdle());
    }
}

TEST_CASE("a path can be thrown away after a halt", "[motion][halt]") {
    MotionSystem system = makeSystem();
    const MoveId first = system.enqueue(jointsTo({60, 0, 0, 0, 30, 0})).value();
    const MoveId second = system.enqueue(jointsTo({70, 0, 0, 0, 30, 0})).value();
    system.advanceTo(200 * kMs);
    system.halt();
    system.clear(); // while it brakes
    CHECK(system.status(first) == MoveStatus::Cleared);
    CHECK(system.status(second) == MoveStatus::Cleared);
    const MoveId third = system.enqueue(jointsTo({5, 0, 0, 0, 30, 0})).value();
    system.start();
    CHECK(finish(system, MotionEventKind::Reached, third) == 1);
    CHECK(isAt(system, {5, 0, 0, 0, 30, 0}));
}

TEST_CASE("a halt while standing is a stop", "[motion][halt]") {
    MotionSystem system = makeSystem();
    system.halt();
    CHECK(system.isStopRequested());
    const MoveId move = system.enqueue(jointsTo({5, 0, 0, 0, 30, 0})).value();
    CHECK_FALSE(system.isMoving());
    system.start();
    CHECK(finish(system, MotionEventKind::Reached, move) == 1);
}
