// The arm on the clock: stopping on the path and starting again, stepping back.

#include "runtime/motion/path.h"
#include "runtime/robot/dynamics.h"
#include "tests/unit/motion/motion_system_rig.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace motion_testing;

TEST_CASE("stop brakes on the path and start continues from there", "[motion][system]") {
    MotionSystem straight = makeSystem();
    MotionSystem system = makeSystem();
    const MoveCommand line = lineFrom(system, 50, 100, -150);
    REQUIRE(straight.enqueue(line).hasValue());
    REQUIRE(system.enqueue(line).hasValue());
    const Vec3 from = system.current().tcp.pos;
    const Vec3 way = line.target.pose.pos - from;
    const TimeNs whole = *system.reachTime(1);
    system.advanceTo(whole / 2);
    system.stop();
    CHECK(system.isStopRequested());
    CHECK_FALSE(system.reachTime(1).has_value());
    CHECK(system.isMoving()); // braking
    const TimeNs standing = *system.nextEventTime();
    CHECK(standing < whole);
    system.advanceTo(standing + 500 * kMs);
    CHECK_FALSE(system.isMoving());
    CHECK(system.status(1) == MoveStatus::Moving);
    CHECK_FALSE(system.nextEventTime().has_value());
    auto events = system.takeEvents();
    CHECK(kinds(events) == std::vector{MotionEventKind::Started, MotionEventKind::Stopped});
    CHECK(events[1].time == standing);
    const Vec3 there = system.current().tcp.pos;
    const double share = dot(there - from, way) / dot(way, way);
    CHECK(norm(there - (from + way * share)) < 1e-6);
    CHECK(share > 0.45);
    CHECK(share < 0.8);
    // Ordering continues while stopped; nothing starts.
    REQUIRE(system.enqueue(jointsTo({0, 0, 0, 0, 30, 0})).hasValue());
    CHECK(system.status(2) == MoveStatus::Queued);

    system.start();
    run(system, &events);
    CHECK(system.isIdle());
    CHECK(timeOf(events, MotionEventKind::Reached, 1) > standing + 500 * kMs);
    CHECK(system.currentJoints().robax == Joints{0, 0, 0, 0, 30, 0});
}

TEST_CASE("a stop in the last moment lets the move end", "[motion][system]") {
    MotionSystem system = makeSystem();
    REQUIRE(system.enqueue(jointsTo({20, 0, 0, 0, 30, 0})).hasValue());
    REQUIRE(system.enqueue(jointsTo({0, 0, 0, 0, 30, 0})).hasValue());
    const TimeNs end = *system.reachTime(1);
    system.advanceTo(end - kMs);
    system.stop();
    std::vector<MotionEvent> events;
    run(system, &events);
    CHECK(timeOf(events, MotionEventKind::Reached, 1) == end);
    CHECK(timeOf(events, MotionEventKind::Stopped, 2) > end);
    CHECK(timeOf(events, MotionEventKind::Stopped, 2) < end + 100 * kMs);
    CHECK_FALSE(system.isDone(2));
    system.start();
    system.advanceTo(system.now() + kMs);
    CHECK(system.status(2) == MoveStatus::Moving);
    run(system);
    CHECK(system.isIdle());
}

TEST_CASE("stop while standing is answered at once and holds later moves", "[motion][system]") {
    MotionSystem system = makeSystem();
    system.stop();
    CHECK(kinds(system.takeEvents()) == std::vector{MotionEventKind::Stopped});
    REQUIRE(system.enqueue(jointsTo({20, 0, 0, 0, 30, 0})).hasValue());
    CHECK_FALSE(system.nextEventTime().has_value());
    system.advanceTo(1000 * kMs);
    system.start();
    CHECK(system.isMoving());
    system.advanceTo(1001 * kMs);
    CHECK(timeOf(system.takeEvents(), MotionEventKind::Started, 1) == 1000 * kMs);
}

// Manual 1.7, ClearPath: the path is thrown away, and the next movement begins where the arm is.
TEST_CASE("a move ordered while the arm is stopped can be cleared before it begins", "[motion][system]") {
    MotionSystem system = makeSystem();
    system.stop();
    system.takeEvents();
    REQUIRE(system.enqueue(jointsTo({20, 0, 0, 0, 30, 0})).hasValue());
    system.advanceTo(100 * kMs);
    system.clear();
    CHECK(system.current().joints[0] == 0);
    CHECK(system.plannedEnd().robax[0] == 0);
    system.start();
    run(system);
    CHECK(system.isIdle());
    CHECK(system.current().joints[0] == 0);
}

TEST_CASE("stopping and starting at random never leaves the path or the limits", "[motion][system]") {
    std::mt19937_64 random(6);
    for (int n = 0; n < 20; ++n) {
        MotionSystem system = makeSystem();
        const MoveCommand line = lineFrom(system, 60, 120, -160);
        REQUIRE(system.enqueue(line).hasValue());
        const robot::RobotModel& model = system.model();
        const Vec3 from = system.current().tcp.pos;
        const Vec3 way = line.target.pose.pos - from;
        const robot::AccelerationMap accelerations(model);
        Joints before = system.currentJoints().robax;
        Joints here = before;
        double last = 0;
        int steps = 0;
        while (!system.isIdle() && steps < 60000) {
            ++steps;
            const unsigned dice = random() % 200;
            if (dice == 0) system.stop();
            if (dice == 1 || (dice < 12 && system.isStopRequested())) system.start();
            if (dice == 20) system.setOverride(static_cast<double>(random() % 5) * 25);
            if (dice == 21) system.setOverride(100);
            system.advanceTo(system.now() + kMs);
            const Joints after = system.current().joints;
            Joints most = after;
            accelerations.limitsAt(here, most);
            for (std::size_t i = 0; i < 6; ++i) {
                REQUIRE(std::fabs(after[i] - here[i]) <= model.maxSpeed[i] * 1e-3 * (1 + 1e-6));
                REQUIRE(std::fabs(after[i] - 2 * here[i] + before[i]) <= most[i] * 1e-6 * 1.05 + 1e-9);
            }
            const Vec3 tcp = system.current().tcp.pos;
            const double share = dot(tcp - from, way) / dot(way, way);
            REQUIRE(norm(tcp - (from + way * share)) < 1e-6);
            REQUIRE(share >= last - 1e-9);
            last = share;
            before = here;
            here = after;
        }
        CHECK(system.isIdle());
        run(system);
        CHECK(norm(system.current().tcp.pos - line.target.pose.pos) < 1e-6);
    }
}

TEST_CASE("stopped on its path the arm steps back on it", "[motion][system]") {
    MotionSystem system = makeSystem();
    const Vec3 from = system.current().tcp.pos;
    const auto place = [&] { return norm(system.current().tcp.pos - from); };
    const auto settle = [&] {
        while (const auto next = system.nextEventTime()) {
            system.advanceTo(*next);
            CHECK(system.current().tcpSpeed < 110);
        }
        system.takeEvents();
    };
    REQUIRE(system.enqueue(lineFrom(system, 0, 0, -50)).hasValue());
    REQUIRE(system.enqueue(lineFrom(system, 0, 0, -150)).hasValue());
    system.advanceTo(*system.reachTime(1) + 500'000'000);
    CHECK_FALSE(system.stepBack(10, 50)); // it moves
    system.stop();
    settle();
    const double stopped = place();
    REQUIRE(stopped > 70);
    const TimeNs before = system.now();
    REQUIRE(system.stepBack(20, 10));
    settle();
    CHECK(place() == Approx(stopped - 20).margin(1e-6));
    CHECK(system.now() - before > 2'000'000'000); // 20 mm at 10 mm/s, and ramps
    REQUIRE(system.stepBack(1000, 100));
    settle();
    CHECK(place() == Approx(50).margin(1e-6)); // to the beginning of the move
    REQUIRE(system.stepBack(30, 100));
    settle();
    CHECK(place() == Approx(20).margin(1e-6)); // on the move before
    REQUIRE(system.stepBack(1000, 100));
    settle();
    CHECK(place() == Approx(0).margin(1e-6));
    CHECK_FALSE(system.stepBack(1, 100));
    CHECK(system.status(1) == MoveStatus::Done);
    CHECK(system.status(2) == MoveStatus::Moving);
    system.start();
    std::vector<MotionEvent> events;
    run(system, &events);
    CHECK(place() == Approx(200).margin(1e-6));
    CHECK(timeOf(events, MotionEventKind::Reached, 2) > 0);
    CHECK(std::none_of(events.begin(), events.end(), [](const MotionEvent& e) { return e.move == 1; }));
    CHECK(system.isIdle());
}

TEST_CASE("a finished move is stepped back on and run to its end again", "[motion][system]") {
    MotionSystem system = makeSystem();
    const Vec3 from = system.current().tcp.pos;
    REQUIRE(system.enqueue(lineFrom(system, 0, 0, -50)).hasValue());
    std::vector<MotionEvent> events;
    run(system, &events);
    system.advanceTo(system.now() + 1'000'000'000);
    system.stop();
    REQUIRE(system.stepBack(20, 50));
    run(system, &events);
    CHECK(norm(system.current().tcp.pos - from) == Approx(30).margin(1e-6));
    system.start();
    run(system, &events);
    CHECK(norm(system.current().tcp.pos - from) == Approx(50).margin(1e-6));
    CHECK(system.isIdle());
}
