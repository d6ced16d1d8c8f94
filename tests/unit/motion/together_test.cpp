// Synchronised movements of several robots (MultiMove): one common place, times and limits of all.

#include "runtime/motion/motion_system.h"
#include "runtime/robot/dynamics.h"
#include "tests/unit/motion/motion_system_rig.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

using namespace motion_testing;

namespace {

MotionSystem robotOf(const char* model) {
    auto loaded = robot::loadRobotModel(model);
    REQUIRE(loaded.hasValue());
    return MotionSystem(*loaded);
}

MoveCommand lineTo(const MotionSystem& system, double x, double y, double z, double speed, bool isFlyBy) {
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.target = calcRobTarget(system.kinematics(), system.plannedEnd(), command.frames);
    command.target.pose = robot::offs(command.target.pose, x, y, z);
    command.speed.vTcp = speed;
    command.confL = false;
    if (isFlyBy) command.zone = {false, 10, 15, 15, 1.5, 15, 1.5};
    return command;
}

/// Two robots of different sizes that have begun to move together.
struct Pair {
    MotionSystem first = robotOf("IRB 120-3/0.58"), second = robotOf("IRB 1600-6/1.45");
    std::vector<MotionSystem*> both{&first, &second};
    Pair() { REQUIRE(MotionSystem::beginTogether(both)); }

    void order(const MoveCommand& a, const MoveCommand& b) {
        REQUIRE(MotionSystem::enqueueTogether(both, {a, b}).hasValue());
    }
    /// One event of either of them; false when there is none.
    bool step() {
        std::optional<TimeNs> next;
        for (const MotionSystem* system : both)
            if (const auto time = system->nextEventTime()) next = std::min(next.value_or(*time), *time);
        if (!next) return false;
        for (MotionSystem* system : both)
            system->advanceTo(*next);
        return true;
    }
};

} // namespace

TEST_CASE("robots that move together begin and end together, in proportion on the way",
          "[motion][together]") {
    Pair pair;
    const Vec3 from = pair.first.current().tcp.pos;
    const Vec3 otherFrom = pair.second.current().tcp.pos;
    pair.order(lineTo(pair.first, 0, 100, -50, 500, false),
               lineTo(pair.second, -100, -200, -100, 500, false));
    std::vector<MotionEvent> events;
    std::vector<MotionEvent> otherEvents;
    double worst = 0;
    double fastest = 0;
    for (TimeNs time = 0; pair.first.nextEventTime() || pair.second.nextEventTime(); time += kMs) {
        for (MotionSystem* system : pair.both)
            system->advanceTo(time);
        for (const MotionEvent& event : pair.first.takeEvents())
            events.push_back(event);
        for (const MotionEvent& event : pair.second.takeEvents())
            otherEvents.push_back(event);
        const MotionState a = pair.first.current();
        const MotionState b = pair.second.current();
        const double way = norm(a.tcp.pos - from) / norm(Vec3{0, 100, -50});
        const double otherWay = norm(b.tcp.pos - otherFrom) / norm(Vec3{-100, -200, -100});
        worst = std::max(worst, std::abs(way - otherWay));
        fastest = std::max(fastest, b.tcpSpeed);
    }
    CHECK(worst < 1e-6);
    CHECK(timeOf(events, MotionEventKind::Started, 1) == timeOf(otherEvents, MotionEventKind::Started, 1));
    CHECK(timeOf(events, MotionEventKind::Reached, 1) == timeOf(otherEvents, MotionEventKind::Reached, 1));
    CHECK(timeOf(events, MotionEventKind::Reached, 1) > 0);
    // The longer way takes its programmed speed; it is the one that sets the time.
    CHECK(fastest == Approx(500).epsilon(0.01));
    MotionSystem::endTogether(pair.both);
    CHECK(pair.second.enqueue(lineTo(pair.second, 0, 50, 0, 500, false)).hasValue());
}

TEST_CASE("fly-by points of synchronised movements are passed together", "[motion][together]") {
    Pair pair;
    const double limits[2] = {400, 300};
    const Vec3 ways[2][4] = {{{0, 100, 0}, {0, 0, -100}, {0, -100, 0}, {0, 0, 100}},
                             {{0, 0, -40}, {0, 90, 0}, {-200, 0, 0}, {0, -30, 30}}};
    for (int i = 0; i < 4; ++i) {
        const auto move = [&](int robot) {
            const Vec3& way = ways[robot][i];
            return lineTo(*pair.both[static_cast<std::size_t>(robot)], way.x, way.y, way.z, limits[robot],
                          i < 3);
        };
        pair.order(move(0), move(1));
    }
    std::array<std::vector<MotionEvent>, 2> events;
    std::array<double, 2> fastest{}, slowest{1e9, 1e9}, largestJump{};
    std::array<MotionState, 2> last{pair.first.current(), pair.second.current()};
    for (TimeNs time = 0; pair.first.nextEventTime() || pair.second.nextEventTime(); time += kMs) {
        for (std::size_t r = 0; r < 2; ++r) {
            pair.both[r]->advanceTo(time);
            for (const MotionEvent& event : pair.both[r]->takeEvents())
                events[r].push_back(event);
            const MotionState now = pair.both[r]->current();
            fastest[r] = std::max(fastest[r], now.tcpSpeed);
            if (now.move > 1 && now.move < 4) slowest[r] = std::min(slowest[r], now.tcpSpeed);
            const robot::RobotModel& model = pair.both[r]->model();
            for (std::size_t axis = 0; axis < 6; ++axis) {
                CHECK(std::abs(now.jointSpeed[axis]) < 1.03 * model.maxSpeed[axis]);
                largestJump[r] = std::max(largestJump[r], std::abs(now.joints[axis] - last[r].joints[axis]));
            }
            last[r] = now;
        }
    }
    for (MoveId move = 1; move <= 4; ++move) {
        const TimeNs reached = timeOf(events[0], MotionEventKind::Reached, move);
        CHECK(reached > 0);
        CHECK(std::llabs(reached - timeOf(events[1], MotionEventKind::Reached, move)) <= 1);
    }
    for (std::size_t r = 0; r < 2; ++r) {
        CHECK(fastest[r] <= limits[r] * 1.002); // shares are looked at twice a mm
        CHECK(slowest[r] > 5);                  // no stop on the way
        CHECK(largestJump[r] < 1);              // deg in a ms
    }
}

TEST_CASE("one robot keeps its place while the other moves", "[motion][together]") {
    Pair pair;
    const MotionState before = pair.first.current();
    pair.order(lineTo(pair.first, 0, 0, 0, 100, false), lineTo(pair.second, 0, 100, 0, 200, false));
    while (pair.step())
        CHECK(norm(pair.first.current().tcp.pos - before.tcp.pos) < 1e-9);
    CHECK(pair.second.lastOrdered() == 1);
    CHECK(pair.first.isDone(1));
    CHECK(pair.second.isDone(1));
    pair.order(lineTo(pair.first, 0, 50, 0, 100, false), lineTo(pair.second, 0, 0, 0, 200, false));
    while (pair.step()) {
    }
    CHECK(norm(pair.first.current().tcp.pos - before.tcp.pos) == Approx(50).margin(1e-6));
}

TEST_CASE("a stop holds synchronised robots on their paths", "[motion][together]") {
    Pair pair;
    pair.order(lineTo(pair.first, 0, 150, 0, 200, false), lineTo(pair.second, 0, 300, 0, 400, false));
    for (MotionSystem* system : pair.both)
        system->advanceTo(300 * kMs);
    for (MotionSystem* system : pair.both)
        system->stop();
    while (pair.step()) {
    }
    const double way = pair.first.current().tcp.pos.y;
    CHECK(way > 5);
    CHECK(way < 145);
    CHECK(pair.second.current().tcp.pos.y == Approx(2 * way).margin(1e-5));
    for (MotionSystem* system : pair.both)
        system->start();
    while (pair.step()) {
    }
    CHECK(pair.first.current().tcp.pos.y == Approx(150).margin(1e-6));
    CHECK(pair.second.current().tcp.pos.y == Approx(300).margin(1e-6));
}

TEST_CASE("a long chain of synchronised movements keeps to its points", "[motion][together]") {
    // Legs that have been passed are forgotten on the way; the places of the others stay where they are.
    Pair pair;
    constexpr int kMoves = 40;
    const Vec3 from = pair.second.current().tcp.pos;
    std::array<std::vector<TimeNs>, 2> reached;
    double farthest = 0;
    int ordered = 0;
    for (TimeNs time = 0; ordered < kMoves || pair.first.nextEventTime() || pair.second.nextEventTime();
         time += kMs) {
        while (ordered < kMoves && pair.first.unfinishedMoves() < 3) {
            const double side = ordered % 2 == 0 ? 1 : -1;
            const bool isFlyBy = ++ordered < kMoves;
            pair.order(lineTo(pair.first, 0, 40 * side, 0, 300, isFlyBy),
                       lineTo(pair.second, 0, 0, 60 * side, 300, isFlyBy));
        }
        for (std::size_t r = 0; r < 2; ++r) {
            pair.both[r]->advanceTo(time);
            for (const MotionEvent& event : pair.both[r]->takeEvents())
                if (event.kind == MotionEventKind::Reached) reached[r].push_back(event.time);
        }
        const Vec3 here = pair.second.current().tcp.pos;
        farthest = std::max({farthest, std::abs(here.x - from.x), std::abs(here.y - from.y)});
        REQUIRE(here.z > from.z - 1e-3);
        REQUIRE(here.z < from.z + 60 + 1e-3);
    }
    CHECK(farthest < 1e-3);
    REQUIRE(reached[0].size() == kMoves);
    REQUIRE(reached[1].size() == kMoves);
    for (std::size_t i = 0; i < kMoves; ++i)
        CHECK(std::llabs(reached[0][i] - reached[1][i]) <= 1);
}

TEST_CASE("robots that still move together can be separated", "[motion][together]") {
    Pair pair;
    pair.order(lineTo(pair.first, 0, 150, 0, 200, false), lineTo(pair.second, 0, 300, 0, 400, false));
    for (MotionSystem* system : pair.both)
        system->advanceTo(300 * kMs);
    MotionSystem::endTogether(pair.both);
    while (pair.step()) {
    }
    const double way = pair.second.current().tcp.pos.y;
    CHECK(way > 10);
    CHECK(way < 290);
    CHECK(pair.first.isDone(1)); // cleared
    // Each one moves for itself from where it is.
    REQUIRE(pair.second.enqueue(lineTo(pair.second, 0, -20, 0, 400, false)).hasValue());
    while (pair.step()) {
    }
    CHECK(pair.second.current().tcp.pos.y == Approx(way - 20).margin(1e-5));
    REQUIRE(pair.first.enqueue(lineTo(pair.first, 0, 10, 0, 100, false)).hasValue());
    const double before = pair.first.current().tcp.pos.y;
    while (pair.step()) {
    }
    CHECK(pair.first.current().tcp.pos.y == Approx(before + 10).margin(1e-5));
}

TEST_CASE("an unreachable target of one robot orders nothing for the others", "[motion][together]") {
    Pair pair;
    const auto result = MotionSystem::enqueueTogether(
        pair.both, {lineTo(pair.first, 0, 10, 0, 200, false), lineTo(pair.second, 5000, 0, 0, 400, false)});
    REQUIRE_FALSE(result.hasValue());
    CHECK(result.error().command == 1);
    CHECK(result.error().error.kind == MotionErrorKind::Unreachable);
    CHECK(pair.first.isIdle());
    CHECK(pair.second.isIdle());
}

namespace {

/// The targets of the first robot are given in the flange frame of the second one.
struct CarriedPair : Pair {
    const Pose held = inOther();
    Pose inOther() const {
        const MotionState other = second.current();
        const Pose flange = second.flangeInWorld({other.joints, other.extax});
        return robot::inverse(flange) * first.current().tcp;
    }
    void orderIn(const Pose& target, double y, double z, bool isFlyBy) {
        MoveCommand command = lineTo(first, 0, 0, 0, 400, isFlyBy);
        command.frames.workObject.uframe = second.flangeInWorld(second.plannedEnd());
        command.frames.carrier = &second;
        command.target.pose = target;
        order(command, lineTo(second, 0, y, z, 400, isFlyBy));
    }
};

} // namespace

TEST_CASE("a robot follows the work object that the other one carries", "[motion][together]") {
    CarriedPair pair;
    SECTION("at rest in it") {
        pair.orderIn(pair.held, 40, 0, true);
        pair.orderIn(pair.held, 0, 40, true);
        pair.orderIn(pair.held, -40, 0, false);
        double worst = 0;
        for (TimeNs time = 0; pair.first.nextEventTime() || pair.second.nextEventTime(); time += kMs) {
            for (MotionSystem* system : pair.both)
                system->advanceTo(time);
            worst = std::max(worst, norm(pair.inOther().pos - pair.held.pos));
        }
        CHECK(worst < 1e-3);
        CHECK(pair.first.currentTarget({}).pose.pos.y == Approx(0).margin(1e-3));
    }
    SECTION("on a line in it") {
        pair.orderIn(robot::offs(pair.held, 0, 0, 60), 60, -30, false);
        double worst = 0;
        double fastest = 0;
        for (TimeNs time = 0; pair.first.nextEventTime() || pair.second.nextEventTime(); time += kMs) {
            for (MotionSystem* system : pair.both)
                system->advanceTo(time);
            const Pose now = pair.inOther();
            worst = std::max(worst, std::hypot(now.pos.x - pair.held.pos.x, now.pos.y - pair.held.pos.y));
            fastest = std::max(fastest, pair.first.current().tcpSpeed);
        }
        CHECK(worst < 1e-3);
        CHECK(pair.inOther().pos.z - pair.held.pos.z == Approx(60).margin(1e-6));
        CHECK(fastest <= 400.5); // relative to the work object
    }
}

TEST_CASE("corners in a work object that another robot carries", "[motion][together]") {
    CarriedPair pair;
    // The path relative to the work object is the same as without a carrier: two lines and a curve in their plane that
    // keeps within their angle, and no jump of the place in it.
    const auto order2 = [&](double x, double y, double z, bool isFlyBy) {
        pair.orderIn(robot::offs(pair.held, 0, x, y), 30, z, isFlyBy);
    };
    order2(0, 60, -30, true);
    order2(60, 60, 20, false);
    double aside = 0, fastest = 0, beyond = 0;
    std::optional<Vec3> last;
    for (TimeNs time = 0; pair.first.nextEventTime() || pair.second.nextEventTime(); time += kMs) {
        for (MotionSystem* system : pair.both)
            system->advanceTo(time);
        const Vec3 now = pair.inOther().pos - pair.held.pos;
        aside = std::max(aside, std::abs(now.x));
        beyond = std::max({beyond, -now.y, now.z - 60});
        if (last) fastest = std::max(fastest, norm(now - *last) / 1e-3);
        last = now;
    }
    CHECK(aside < 1e-3);
    CHECK(beyond < 1e-3);
    CHECK(fastest <= 404);
    CHECK(norm(pair.inOther().pos - pair.held.pos - Vec3{0, 60, 60}) < 1e-6);
}

TEST_CASE("a robot finds its places on a path that the first robot has left already", "[motion][together]") {
    constexpr TimeNs kBlock = 300 * kMs;
    Pair inSteps, inBlocks;
    for (Pair* pair : {&inSteps, &inBlocks}) {
        for (int i = 0; i < 40; ++i) { // a plan is forgotten in large parts
            const double way = i % 2 == 0 ? 80 : -80;
            MoveCommand first = lineTo(pair->first, 0, way, 0, 500, i < 39);
            MoveCommand second = lineTo(pair->second, 0, 0.7 * way, -0.5 * way, 500, i < 39);
            if (i < 39) first.zone = second.zone = {false, 50, 75, 75, 7.5, 75, 7.5};
            pair->order(first, second);
        }
    }
    double worst = 0;
    for (TimeNs block = kBlock; inSteps.first.nextEventTime(); block += kBlock) {
        while (inBlocks.first.nextEventTime().value_or(block) < block)
            inBlocks.first.advanceTo(*inBlocks.first.nextEventTime());
        inBlocks.first.advanceTo(block);
        for (TimeNs time = block - kBlock; time <= block; time += kMs) {
            for (MotionSystem* system : inSteps.both)
                system->advanceTo(time);
            const Joints expected = inSteps.second.current().joints,
                         found = inBlocks.second.sample(time).joints;
            for (std::size_t axis = 0; axis < expected.size(); ++axis)
                worst = std::max(worst, std::abs(found[axis] - expected[axis]));
        }
        inBlocks.second.advanceTo(block);
    }
    CHECK(worst < 1e-6); // deg
}
