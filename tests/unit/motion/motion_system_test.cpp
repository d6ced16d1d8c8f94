// The arm on the clock: order of events, looking ahead, override, clearing, sampling.

#include "runtime/motion/path.h"
#include "runtime/robot/dynamics.h"
#include "tests/unit/motion/motion_system_rig.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace motion_testing;

TEST_CASE("the arm starts where it should and is idle", "[motion][system]") {
    MotionSystem system = makeSystem();
    CHECK(system.isIdle());
    CHECK_FALSE(system.isMoving());
    CHECK_FALSE(system.nextEventTime().has_value());
    CHECK(system.currentJoints().robax == Joints{0, 0, 0, 0, 30, 0});
    CHECK(system.current().move == 0);
    CHECK(system.status(1) == MoveStatus::Unknown);
    const RobTarget here = system.currentTarget({});
    CHECK(here.pose.pos.x == Approx(302 + 72 * std::cos(M_PI / 6)));
    CHECK(norm(system.current().tcp.pos - here.pose.pos) < 1e-9);
    CHECK(here.conf == ConfData{0, 0, 0, 0});
}

TEST_CASE("a move starts 20 ms after its order, is released and reached in position, and then comes to rest",
          "[motion][system]") {
    MotionSystem system = makeSystem();
    system.advanceTo(5 * kMs);
    const auto id = system.enqueue(jointsTo({30, 0, 0, 0, 30, 0}, 77));
    REQUIRE(id.hasValue());
    CHECK(*id == 1);
    CHECK(system.status(1) == MoveStatus::Queued);
    CHECK(system.nextEventTime() == 25 * kMs);
    system.advanceTo(25 * kMs);
    CHECK(system.status(1) == MoveStatus::Moving);
    CHECK(system.isStarted(1));
    CHECK_FALSE(system.isReleased(1));
    const auto end = system.reachTime(1);
    REQUIRE(end.has_value());
    CHECK(system.nextEventTime() == end);
    system.advanceTo(*end);
    CHECK(system.isMoving()); // the last half mm
    const Vec3 goal = system.kinematics().forward({30, 0, 0, 0, 30, 0}).pos;
    CHECK(norm(system.current().tcp.pos - goal) == Approx(0.5).margin(1e-3));
    CHECK(system.isIdle());
    const TimeNs rest = *system.nextEventTime();
    CHECK(rest - *end > 20 * kMs);
    CHECK(rest - *end < 100 * kMs);
    system.advanceTo(rest);
    CHECK_FALSE(system.isMoving());
    CHECK(norm(system.current().tcp.pos - goal) < 1e-6);
    CHECK(system.isDone(1));
    CHECK(system.isReleased(1));
    CHECK(system.currentJoints().robax == Joints{30, 0, 0, 0, 30, 0});
    const auto events = system.takeEvents();
    CHECK(kinds(events) == std::vector{MotionEventKind::Started, MotionEventKind::Released,
                                       MotionEventKind::Reached, MotionEventKind::AtRest});
    CHECK(events[0].time == 25 * kMs);
    CHECK(events[2].time == *end);
    CHECK(events[2].tag == 77);
    CHECK(system.takeEvents().empty());
    CHECK(system.current().tag == 77);
    CHECK(system.reachTime(1) == end);
}

TEST_CASE("moves ordered ahead run one after another without a gap", "[motion][system]") {
    MotionSystem system = makeSystem();
    std::vector<MotionEvent> events;
    const Joints targets[] = {{20, 0, 0, 0, 30, 0}, {20, 20, 0, 0, 30, 0}, {0, 0, 0, 0, 30, 0}};
    for (const Joints& target : targets)
        REQUIRE(system.enqueue(jointsTo(target)).hasValue());
    CHECK(system.unfinishedMoves() == 3);
    CHECK(system.status(2) == MoveStatus::Queued);
    CHECK(system.plannedEnd().robax == targets[2]);
    run(system, &events);
    // A stop point takes no time of its own: the next move begins while the last mm is covered.
    for (const MoveId move : {2, 3}) {
        const TimeNs gap = timeOf(events, MotionEventKind::Started, move) -
                           timeOf(events, MotionEventKind::Reached, move - 1);
        CHECK(gap >= 0);
        CHECK(gap < 30 * kMs);
    }
    CHECK(system.isIdle());
    CHECK(system.currentJoints().robax == targets[2]);
}

TEST_CASE("an error leaves the queue as it was", "[motion][system]") {
    MotionSystem system = makeSystem();
    REQUIRE(system.enqueue(jointsTo({20, 0, 0, 0, 30, 0})).hasValue());
    const auto bad = system.enqueue(jointsTo({20, 0, 500, 0, 30, 0}));
    REQUIRE_FALSE(bad.hasValue());
    CHECK(bad.error().kind == MotionErrorKind::JointOutOfRange);
    CHECK(system.unfinishedMoves() == 1);
    CHECK(*system.enqueue(jointsTo({0, 0, 0, 0, 30, 0})) == 2);

    MotionOptions options;
    options.maxQueued = 2;
    MotionSystem small = makeSystem(options);
    REQUIRE(small.enqueue(jointsTo({1, 0, 0, 0, 30, 0})).hasValue());
    REQUIRE(small.enqueue(jointsTo({2, 0, 0, 0, 30, 0})).hasValue());
    CHECK(small.enqueue(jointsTo({3, 0, 0, 0, 30, 0})).error().kind == MotionErrorKind::QueueFull);

    auto collaborative = robot::loadRobotModel("IRB 14050-0.5/0.559");
    REQUIRE(collaborative.hasValue());
    MotionSystem sevenAxes(*collaborative);
    CHECK(sevenAxes.enqueue(jointsTo({1, 0, 0, 0, 30, 0})).error().kind == MotionErrorKind::BadArgument);
}

TEST_CASE("a fly-by move releases its program before the zone, a concurrent one at its start",
          "[motion][system]") {
    MotionSystem system = makeSystem();
    const Vec3 from = system.current().tcp.pos;
    MoveCommand flying = lineFrom(system, 0, 0, -150);
    flying.zone = {false, 50, 75, 75, 7.5, 75, 7.5};
    REQUIRE(system.enqueue(flying).hasValue());
    std::vector<MotionEvent> events;
    run(system, &events);
    const TimeNs released = timeOf(events, MotionEventKind::Released, 1);
    const TimeNs reached = timeOf(events, MotionEventKind::Reached, 1);
    CHECK(released > timeOf(events, MotionEventKind::Started, 1));
    // The largest zone, 75 mm, is half of the way; the program continues 0.1 s before it.
    const TimeNs entry = released + 100 * kMs;
    CHECK(norm(system.sample(entry).tcp.pos - from) == Approx(75).margin(1e-3));
    CHECK(reached > entry);

    MoveCommand concurrent = lineFrom(system, 0, 0, 100);
    concurrent.concurrent = true;
    REQUIRE(system.enqueue(concurrent).hasValue());
    events.clear();
    run(system, &events);
    CHECK(timeOf(events, MotionEventKind::Released, 2) == timeOf(events, MotionEventKind::Started, 2));
    CHECK(timeOf(events, MotionEventKind::Reached, 2) > timeOf(events, MotionEventKind::Started, 2));
}

TEST_CASE("triggers fire where and when they are asked to", "[motion][system]") {
    MotionSystem system = makeSystem();
    MoveCommand line = lineFrom(system, 0, 0, -150);
    line.triggers = {{1, false, false, 30, 0},   {2, true, false, 20, 0},     {3, false, true, 0.2, 0},
                     {4, true, true, 0.25, 0},   {5, false, false, 30, 0.05}, {6, false, false, 0, 0},
                     {7, false, false, 0, -0.5}, {8, false, false, 400, 0}};
    REQUIRE(system.enqueue(line).hasValue());
    std::vector<MotionEvent> events;
    std::vector<double> fired(9, -1);
    const Vec3 from = system.current().tcp.pos;
    std::vector<double> travelled(9, -1);
    while (const auto next = system.nextEventTime()) {
        system.advanceTo(*next);
        for (const MotionEvent& event : system.takeEvents()) {
            events.push_back(event);
            if (event.kind != MotionEventKind::Trigger) continue;
            fired[event.trigger] = static_cast<double>(event.time) * 1e-9;
            travelled[event.trigger] = norm(system.sample(event.time).tcp.pos - from);
        }
    }
    const double end = static_cast<double>(timeOf(events, MotionEventKind::Reached, 1)) * 1e-9;
    CHECK(travelled[1] == Approx(120).margin(1e-4));
    CHECK(travelled[2] == Approx(20).margin(1e-4));
    CHECK(fired[3] == Approx(end - 0.2).margin(1e-8));
    CHECK(fired[4] == Approx(0.27).margin(1e-8)); // it starts after 20 ms
    CHECK(fired[5] == Approx(fired[1] - 0.05).margin(1e-8));
    CHECK(fired[6] == Approx(end).margin(1e-8));
    CHECK(fired[7] == Approx(end).margin(1e-8));  // later than the end: with it
    CHECK(fired[8] == Approx(0.02).margin(1e-8)); // before the start: with it
    CHECK(std::is_sorted(events.begin(), events.end(),
                         [](const auto& a, const auto& b) { return a.time < b.time; }));
}

namespace {

/// TCP of every trigger that fired, by its id, mm from `from`; -1: it did not.
std::vector<double> placesOfTriggers(MotionSystem& system, const Vec3& from,
                                     std::vector<MotionEvent>& events) {
    std::vector<double> places(9, -1);
    while (const auto next = system.nextEventTime()) {
        system.advanceTo(*next);
        for (const MotionEvent& event : system.takeEvents()) {
            events.push_back(event);
            if (event.kind == MotionEventKind::Trigger)
                places[event.trigger] = norm(system.sample(event.time).tcp.pos - from);
        }
    }
    return places;
}

} // namespace

TEST_CASE("triggers reach into the move before and the one that follows", "[motion][system]") {
    MotionSystem system = makeSystem();
    const Vec3 from = system.current().tcp.pos;
    MoveCommand first = lineFrom(system, 0, 0, -50);
    first.triggers.resize(1);
    first.triggers[0].id = 1;
    first.triggers[0].amount = 20;
    first.triggers[0].nextMove = true; // 20 mm into the second
    MoveCommand second = lineFrom(system, 0, 0, -100);
    second.triggers.resize(1);
    second.triggers[0].id = 2;
    second.triggers[0].fromStart = true;
    second.triggers[0].lag = 0.1; // s before its start
    REQUIRE(system.enqueue(first).hasValue());
    REQUIRE(system.enqueue(second).hasValue());
    std::vector<MotionEvent> events;
    const std::vector<double> places = placesOfTriggers(system, from, events);
    CHECK(places[1] == Approx(70).margin(1e-4));
    CHECK(places[2] > 0);
    CHECK(places[2] < 50);
    const auto fired =
        std::find_if(events.begin(), events.end(), [](const auto& e) { return e.trigger == 2; });
    REQUIRE(fired != events.end());
    CHECK(timeOf(events, MotionEventKind::Started, 2) - fired->time == Approx(1e8).margin(10));
}

TEST_CASE("after a power failure triggers fire again on the rest of the path", "[motion][system]") {
    MotionSystem system = makeSystem();
    const Vec3 from = system.current().tcp.pos;
    MoveCommand line = lineFrom(system, 0, 0, -100);
    line.triggers.resize(2);
    line.triggers[0].id = 1;
    line.triggers[0].fromStart = true;
    line.triggers[0].amount = 10;
    line.triggers[1].id = 2;
    line.triggers[1].amount = 10;
    REQUIRE(system.enqueue(line).hasValue());
    system.advanceTo(*system.reachTime(1) / 2);
    REQUIRE(system.takeEvents().size() == 2); // started, and the first trigger
    system.halt();
    while (const auto next = system.nextEventTime())
        system.advanceTo(*next);
    system.takeEvents();
    system.rearmTriggers();
    system.start();
    std::vector<MotionEvent> events;
    const std::vector<double> places = placesOfTriggers(system, from, events);
    CHECK(places[1] > 20); // its place has been passed: at once
    CHECK(places[1] < 90);
    CHECK(places[2] == Approx(90).margin(1e-4));
}

TEST_CASE("an arm off its path returns to it and is held there", "[motion][system]") {
    MotionSystem system = makeSystem();
    const Vec3 from = system.current().tcp.pos;
    REQUIRE(system.enqueue(lineFrom(system, 0, 0, -150)).hasValue());
    system.advanceTo(500'000'000);
    system.halt();
    while (const auto next = system.nextEventTime())
        system.advanceTo(*next);
    CHECK_FALSE(system.stepBack(10, 50)); // not on the path
    system.returnToPath();
    while (const auto next = system.nextEventTime())
        system.advanceTo(*next);
    const double held = norm(system.current().tcp.pos - from);
    REQUIRE(system.stepBack(10, 50));
    system.clear(); // comes to its end and is idle
    while (const auto next = system.nextEventTime())
        system.advanceTo(*next);
    CHECK(norm(system.current().tcp.pos - from) == Approx(held - 10).margin(1e-6));
    CHECK(system.isIdle());
}

TEST_CASE("the triggers of a circle in two parts stay where they are", "[motion][path]") {
    MoveCommand circle;
    circle.kind = MoveKind::Circular;
    circle.circlePoint.pos = {0, 100, 0};
    circle.target.pose.pos = {-100, 0, 0};
    circle.triggers = {{1, true, false, 50, 0},
                       {2, false, false, 50, 0},
                       {3, true, false, 200, 0},
                       {4, false, false, 200, 0},
                       {5, false, true, 0.1, 0}};
    Pose start;
    start.pos = {100, 0, 0};
    const std::vector<MoveCommand> parts =
        splitAtCirclePoint(circle, {start, {}, kNoExternalAxes}); // two quarters of 157.08 mm
    REQUIRE(parts.size() == 2);
    REQUIRE(parts[0].triggers.size() == 2);
    CHECK(parts[0].triggers[0].id == 1);
    CHECK(parts[0].triggers[0].amount == 50);
    CHECK(parts[0].triggers[1].id == 4); // 200 mm before the end
    CHECK_FALSE(parts[0].triggers[1].fromStart);
    CHECK(parts[0].triggers[1].amount == Approx(200 - 157.0796));
    REQUIRE(parts[1].triggers.size() == 3);
    CHECK(parts[1].triggers[0].amount == 50);
    CHECK(parts[1].triggers[1].id == 3); // 200 mm after the start
    CHECK(parts[1].triggers[1].fromStart);
    CHECK(parts[1].triggers[1].amount == Approx(200 - 157.0796));
    CHECK(parts[1].triggers[2].id == 5);
}

TEST_CASE("a circle in two parts turns as CirPathMode says", "[motion][path]") {
    // A quarter of a circle; relative to the object the tool turns by 60 degrees about x, half of it up to the circle point.
    MoveCommand circle;
    circle.kind = MoveKind::Circular;
    circle.circleOrientation = CircleOrientation::ObjectFrame;
    circle.circlePoint.pos = {100 * std::sqrt(0.5), 100 * std::sqrt(0.5), 0};
    circle.target.pose = {{0, 100, 0}, robot::fromAxisAngle({1, 0, 0}, 60)};
    Pose start;
    start.pos = {100, 0, 0};
    const std::vector<MoveCommand> parts = splitAtCirclePoint(circle, {start, {}, kNoExternalAxes});
    REQUIRE(parts.size() == 2);
    CHECK(robot::angleBetween(parts[0].target.pose.rot, robot::fromAxisAngle({1, 0, 0}, 30)) < 1e-6);
}

TEST_CASE("override changes the pace, not the path", "[motion][system]") {
    MotionSystem full = makeSystem();
    MotionSystem half = makeSystem();
    half.setOverride(50);
    CHECK(half.speedOverride() == 50);
    const MoveCommand line = lineFrom(full, 0, 100, -150);
    REQUIRE(full.enqueue(line).hasValue());
    REQUIRE(half.enqueue(line).hasValue());
    CHECK(*half.reachTime(1) > *full.reachTime(1));
    half.advanceTo(*half.reachTime(1) / 2);
    CHECK(half.current().tcpSpeed == Approx(100).epsilon(1e-3));
    half.setOverride(0); // stops on the path
    const auto standing = half.nextEventTime();
    REQUIRE(standing.has_value());
    half.advanceTo(*standing + 10 * kMs);
    CHECK_FALSE(half.isMoving());
    CHECK_FALSE(half.nextEventTime().has_value());
    CHECK(half.status(1) == MoveStatus::Moving);
    half.setOverride(100);
    run(half);
    CHECK(half.isIdle());
    CHECK(norm(half.current().tcp.pos - line.target.pose.pos) < 1e-6);
}

TEST_CASE("clearing throws away what is not finished", "[motion][system]") {
    MotionSystem system = makeSystem();
    REQUIRE(system.enqueue(jointsTo({60, 0, 0, 0, 30, 0})).hasValue());
    REQUIRE(system.enqueue(jointsTo({0, 0, 0, 0, 30, 0})).hasValue());
    system.advanceTo(*system.reachTime(1) / 2);
    system.takeEvents();
    system.clear();
    CHECK(system.status(1) == MoveStatus::Cleared);
    CHECK(system.status(2) == MoveStatus::Cleared);
    CHECK(system.isDone(1));
    CHECK(system.isReleased(2));
    CHECK(system.isMoving()); // still braking
    // A new move starts from the place of rest, when the arm is at rest.
    const Joints stop = system.plannedEnd().robax;
    CHECK(stop[0] > 10);
    CHECK(stop[0] < 60);
    REQUIRE(*system.enqueue(jointsTo({5, 0, 0, 0, 30, 0})) == 3);
    CHECK(system.status(3) == MoveStatus::Queued);
    std::vector<MotionEvent> events;
    system.advanceTo(*system.nextEventTime());
    const double startOfThird = system.current().joints[0];
    events = system.takeEvents();
    run(system, &events);
    CHECK(kinds(events) == std::vector{MotionEventKind::Started, MotionEventKind::Released,
                                       MotionEventKind::Reached, MotionEventKind::AtRest});
    CHECK(events[0].move == 3);
    CHECK(system.currentJoints().robax[0] == 5);
    CHECK(startOfThird == Approx(stop[0]).margin(1e-9));

    // After a stop the path is gone at once.
    REQUIRE(system.enqueue(jointsTo({60, 0, 0, 0, 30, 0})).hasValue());
    system.advanceTo(system.now() + 200 * kMs);
    system.stop();
    while (system.isMoving())
        system.advanceTo(*system.nextEventTime());
    system.clear();
    CHECK(system.isIdle());
    CHECK(system.isStopRequested());
    const Joints rest = system.currentJoints().robax;
    CHECK(system.plannedEnd().robax == rest);
    CHECK_FALSE(system.nextEventTime().has_value());
    system.start();
    REQUIRE(system.enqueue(jointsTo(rest)).hasValue());
    run(system);
    CHECK(system.currentJoints().robax == rest);
}

TEST_CASE("how far the arm is from a path that was taken back", "[motion][system]") {
    MotionSystem system = makeSystem();
    REQUIRE(system.enqueue(lineFrom(system, 50, 100, -150)).hasValue());
    system.advanceTo(*system.reachTime(1) / 2);
    system.stop();
    while (system.isMoving())
        system.advanceTo(*system.nextEventTime());
    const Vec3 left = system.current().tcp.pos;
    CHECK_FALSE(system.gapToPath().has_value()); // stopped on its path
    REQUIRE(system.storePath());
    CHECK_FALSE(system.gapToPath().has_value()); // nothing to continue on this level
    Joints aside = system.currentJoints().robax;
    aside[5] += 15; // turns the tool, which has no length, about its own axis
    REQUIRE(system.enqueue(jointsTo(aside)).hasValue());
    run(system);
    REQUIRE(system.restorePath());
    REQUIRE(system.gapToPath().has_value());
    CHECK(system.gapToPath()->mm == Approx(norm(system.current().tcp.pos - left)).margin(1e-6));
    CHECK(system.gapToPath()->degrees == Approx(15).margin(1e-3));
}

TEST_CASE("paths that were put aside can be thrown away", "[motion][system]") {
    MotionSystem system = makeSystem();
    REQUIRE(system.enqueue(lineFrom(system, 50, 100, -150)).hasValue());
    system.advanceTo(*system.reachTime(1) / 2);
    system.stop();
    while (system.isMoving())
        system.advanceTo(*system.nextEventTime());
    REQUIRE(system.storePath());
    system.clearStored();
    CHECK(system.status(1) == MoveStatus::Cleared);
    CHECK_FALSE(system.restorePath());
    REQUIRE(system.enqueue(jointsTo({0, 0, 0, 0, 30, 0})).hasValue());
    run(system);
    CHECK(system.currentJoints().robax == Joints{0, 0, 0, 0, 30, 0});
}

TEST_CASE("a path can be put aside for an errand and taken up again", "[motion][system]") {
    for (bool returnsByProgram : {true, false}) {
        MotionSystem system = makeSystem();
        const MoveCommand line = lineFrom(system, 50, 100, -150);
        REQUIRE(system.enqueue(line).hasValue());
        REQUIRE(system.enqueue(jointsTo({0, 0, 0, 0, 30, 0})).hasValue());
        const Vec3 from = system.current().tcp.pos;
        const Vec3 way = line.target.pose.pos - from;
        system.advanceTo(*system.reachTime(1) / 2);
        CHECK_FALSE(system.storePath()); // still moving
        system.stop();
        while (system.isMoving())
            system.advanceTo(*system.nextEventTime());
        const Joints left = system.currentJoints().robax;
        REQUIRE(system.storePath());
        CHECK(system.isIdle());
        CHECK_FALSE(system.isStopRequested());
        CHECK(system.status(1) == MoveStatus::Moving);
        CHECK(system.status(2) == MoveStatus::Queued);
        REQUIRE(*system.enqueue(jointsTo({40, -20, 0, 0, 60, 0})) == 3);
        CHECK_FALSE(system.restorePath()); // the errand is not over
        if (returnsByProgram) REQUIRE(system.enqueue(jointsTo(left)).hasValue());
        run(system);
        REQUIRE(system.restorePath());
        CHECK_FALSE(system.restorePath());
        CHECK(system.isStopRequested());
        CHECK_FALSE(system.nextEventTime().has_value());
        system.takeEvents();
        system.start();
        // Back on the line it continues along it to the end.
        bool isOnLine = returnsByProgram;
        std::vector<MotionEvent> events;
        while (system.status(1) != MoveStatus::Done) {
            REQUIRE(system.nextEventTime().has_value());
            system.advanceTo(std::min(system.now() + kMs, *system.nextEventTime()));
            const Vec3 tcp = system.current().tcp.pos;
            const double share = dot(tcp - from, way) / dot(way, way);
            const double distance = norm(tcp - (from + way * share));
            if (distance < 1e-6) isOnLine = true;
            if (isOnLine && returnsByProgram) REQUIRE(distance < 1e-6);
        }
        CHECK(isOnLine);
        CHECK(norm(system.current().tcp.pos - line.target.pose.pos) < 0.5 + 1e-6); // in position
        run(system);
        CHECK(system.isIdle());
        CHECK(system.currentJoints().robax == Joints{0, 0, 0, 0, 30, 0});
    }
}

TEST_CASE("the past since the last step can be sampled for a trace", "[motion][system]") {
    MotionSystem fine = makeSystem();
    MotionSystem coarse = makeSystem();
    for (MotionSystem* system : {&fine, &coarse}) {
        REQUIRE(system->enqueue(jointsTo({20, 10, 0, 0, 30, 0}, 1)).hasValue());
        REQUIRE(system->enqueue(jointsTo({0, 0, 0, 50, 30, 0}, 2)).hasValue());
    }
    std::vector<MotionState> trace;
    for (TimeNs time = 4 * kMs; time <= 3000 * kMs; time += 4 * kMs) {
        fine.advanceTo(time);
        trace.push_back(fine.sample(time));
    }
    // In one leap, and everything in between asked afterwards.
    coarse.advanceTo(3000 * kMs);
    for (std::size_t i = 0; i < trace.size(); ++i) {
        const MotionState state = coarse.sample(static_cast<TimeNs>(i + 1) * 4 * kMs);
        CHECK(state.joints == trace[i].joints);
        CHECK(state.move == trace[i].move);
        CHECK(state.tag == trace[i].tag);
        CHECK(state.moving == trace[i].moving);
    }
    CHECK(fine.takeEvents().size() == coarse.takeEvents().size());
}

TEST_CASE("the arm can be placed only when idle", "[motion][system]") {
    MotionSystem system = makeSystem();
    REQUIRE(system.placeAt({{10, 20, 30, 0, 40, 0}, kNoExternalAxes}));
    CHECK(system.currentJoints().robax == Joints{10, 20, 30, 0, 40, 0});
    CHECK(norm(system.current().tcp.pos - system.kinematics().forward({10, 20, 30, 0, 40, 0}).pos) < 1e-9);
    REQUIRE(system.enqueue(jointsTo({20, 0, 0, 0, 30, 0})).hasValue());
    CHECK_FALSE(system.placeAt({{0, 0, 0, 0, 30, 0}, kNoExternalAxes}));
    run(system);
    CHECK(system.placeAt({{0, 0, 0, 0, 30, 0}, kNoExternalAxes}));
    CHECK(system.currentJoints().robax == Joints{0, 0, 0, 0, 30, 0});
    CHECK(system.currentMove() == 1);
}

TEST_CASE("an external axis outside its range is refused by its number", "[motion][system]") {
    MotionOptions options;
    options.external[1] = {true, true, -90, 90, 100, 500};
    MotionSystem system = makeSystem(options);
    CHECK(system.currentJoints().extax[1] == 0);
    MoveCommand command = jointsTo({10, 0, 0, 0, 30, 0});
    command.joints.extax[1] = 120;
    const auto refused = system.enqueue(command);
    REQUIRE_FALSE(refused.hasValue());
    CHECK(refused.error().kind == MotionErrorKind::JointOutOfRange);
    CHECK(refused.error().joint == 9);
    command.joints.extax[1] = 80;
    REQUIRE(system.enqueue(command).hasValue());
    run(system);
    CHECK(system.currentJoints().extax[1] == 80);
}

TEST_CASE("moves to the present position take 73 ms each, in order", "[motion][system]") {
    MotionSystem system = makeSystem();
    for (int i = 0; i < 5; ++i)
        REQUIRE(system.enqueue(jointsTo({0, 0, 0, 0, 30, 0})).hasValue());
    std::vector<MotionEvent> events;
    run(system, &events);
    CHECK(system.isIdle());
    CHECK(system.now() == 5 * 73 * kMs); // from the order
    CHECK(events.size() == 5 * 3 + 1);
}

TEST_CASE("the base frame moves world, not the arm", "[motion][system]") {
    auto model = robot::loadRobotModel("IRB 120-3/0.58");
    REQUIRE(model.hasValue());
    model->baseFrame = {{1000, 0, 500}, robot::fromEulerZyx(90, 0, 0)};
    MotionSystem system(*model);
    const Vec3 inBase = system.kinematics().forward({0, 0, 0, 0, 30, 0}).pos;
    const Vec3 tcp = system.current().tcp.pos;
    CHECK(tcp.x == Approx(1000 - inBase.y).margin(1e-9));
    CHECK(tcp.y == Approx(inBase.x));
    CHECK(tcp.z == Approx(500 + inBase.z));
    CHECK(norm(system.currentTarget({}).pose.pos - tcp) < 1e-9);
    MoveCommand line = lineFrom(system, 0, 0, 0);
    line.target.pose = system.currentTarget({}).pose;
    line.target.pose.pos.z -= 100;
    REQUIRE(system.enqueue(line).hasValue());
    run(system);
    CHECK(system.current().tcp.pos.z == Approx(tcp.z - 100));
}
