#include "runtime/host/jogging.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace rt;

namespace {

/// An arm on a clock of its own.
struct JogBench {
    Scheduler scheduler{{}};
    MotionDriver motion{scheduler, *robot::loadRobotModel("IRB 120-3/0.58")};
    Jogging jogging{scheduler, motion};

    void runFor(Time span) {
        const Time end = scheduler.now() + span;
        scheduler.at(end, [] {});
        scheduler.run([&] { return scheduler.now() >= end; });
    }
    motion::Joints joints() { return motion.system().currentJoints().robax; }
    motion::Pose flange() { return motion.system().flangeInWorld(motion.system().currentJoints()); }
    void place(const motion::Joints& joints) {
        motion::JointTarget there = motion.system().currentJoints();
        there.robax = joints;
        REQUIRE(motion.system().placeAt(there));
        motion.refresh();
    }
};

JogOrder axis(std::size_t i, double share) {
    JogOrder order;
    order.joints[i] = share;
    return order;
}

} // namespace

TEST_CASE("an axis moves while the order is repeated and stops by itself", "[jogging]") {
    JogBench bench;
    REQUIRE(bench.jogging.order(axis(0, 0.5)).empty());
    bench.runFor(200 * kMillisecond);
    CHECK(bench.jogging.isMoving());
    const double between = bench.joints()[0];
    CHECK(between > 0);
    REQUIRE(bench.jogging.order(axis(0, 0.5)).empty());
    bench.runFor(2 * kSecond);
    CHECK_FALSE(bench.jogging.isMoving());
    CHECK(bench.joints()[0] > between);
    CHECK(bench.joints()[1] == 0);
    CHECK_FALSE(bench.motion.isMoving());
}

TEST_CASE("an increment is exact", "[jogging]") {
    JogBench bench;
    bench.place({0, 0, 0, 0, 60, 0});
    const motion::Pose begin = bench.flange();
    JogOrder order;
    order.line = {0, 0, -1};
    order.increment = 5; // mm
    REQUIRE(bench.jogging.order(order).empty());
    bench.runFor(3 * kSecond);
    CHECK_FALSE(bench.jogging.isMoving());
    CHECK(bench.flange().pos.z == Approx(begin.pos.z - 5).margin(1e-6));
    CHECK(bench.flange().pos.x == Approx(begin.pos.x).margin(1e-6));
    CHECK(robot::angleBetween(bench.flange().rot, begin.rot) == Approx(0).margin(1e-4));

    JogOrder turn = axis(3, -1);
    turn.increment = 2; // degrees
    REQUIRE(bench.jogging.order(turn).empty());
    const double before = bench.joints()[3];
    bench.runFor(3 * kSecond);
    CHECK(bench.joints()[3] == Approx(before - 2).margin(1e-9));
}

TEST_CASE("jogging stays within ranges, speeds and reach", "[jogging]") {
    JogBench bench;
    bench.place({0, 0, 0, 0, 115, 0});
    const robot::Kinematics& kinematics = bench.motion.system().kinematics();
    const double upper = kinematics.upperDeg()[4];
    JogOrder order = axis(4, 1);
    order.holdTime = 60 * kSecond;
    REQUIRE(bench.jogging.order(order).empty());
    for (int i = 0; i < 500 && bench.jogging.isMoving(); ++i) {
        bench.runFor(4 * kMillisecond);
        CHECK(bench.joints()[4] <= upper + 1e-6);
        CHECK(bench.motion.system().current().tcpSpeed <= JogSpeeds::kLine * 1.02);
    }
    CHECK_FALSE(bench.jogging.isMoving());
    CHECK(bench.joints()[4] > upper - 0.5);
    CHECK(bench.jogging.limit().find("axis 5") != std::string::npos);
    for (int i = 0; i < 20; ++i) { // nearer and nearer, but not beyond
        (void)bench.jogging.order(order);
        bench.runFor(kSecond);
        CHECK(bench.joints()[4] <= upper + 1e-6);
    }
    CHECK(bench.jogging.order(axis(4, -1)).empty()); // but back

    JogBench reach;
    reach.place({0, 0, 0, 0, 30, 0});
    JogOrder out;
    out.line = {1, 0, 0};
    out.holdTime = 60 * kSecond;
    REQUIRE(reach.jogging.order(out).empty());
    reach.runFor(10 * kSecond);
    CHECK_FALSE(reach.jogging.isMoving());
    CHECK_FALSE(reach.jogging.limit().empty());
    CHECK(reach.motion.system().kinematics().jointOutsideLimits(reach.joints()) == 0);
}

TEST_CASE("reorientation keeps the TCP, in the frame asked for", "[jogging]") {
    JogBench bench;
    bench.place({0, 0, 0, 0, 60, 0});
    JogOrder order;
    order.frames.tool.tframe.pos = {0, 0, 100};
    order.frame = JogFrame::Tool;
    order.turn = {0, 0, 1};
    order.increment = 10; // degrees
    const motion::Pose begin = bench.flange() * order.frames.tool.tframe;
    REQUIRE(bench.jogging.order(order).empty());
    bench.runFor(3 * kSecond);
    const motion::Pose end = bench.flange() * order.frames.tool.tframe;
    CHECK(norm(end.pos - begin.pos) == Approx(0).margin(1e-6));
    CHECK(robot::angleBetween(begin.rot, end.rot) == Approx(10).margin(1e-6));
    // about z of the tool: that axis stays where it is
    CHECK(norm(rotate(end.rot, {0, 0, 1}) - rotate(begin.rot, {0, 0, 1})) == Approx(0).margin(1e-6));
}

TEST_CASE("another direction begins once the arm is at rest", "[jogging]") {
    JogBench bench;
    REQUIRE(bench.jogging.order(axis(0, 1)).empty());
    bench.runFor(100 * kMillisecond);
    REQUIRE(bench.jogging.order(axis(1, 1)).empty());
    bench.runFor(3 * kSecond);
    CHECK(bench.joints()[0] > 0);
    CHECK(bench.joints()[1] > 0);
    CHECK_FALSE(bench.jogging.isMoving());
}

TEST_CASE("orders that make no sense are refused", "[jogging]") {
    JogBench bench;
    JogOrder both = axis(0, 1);
    both.line = {1, 0, 0};
    CHECK_FALSE(bench.jogging.order(both).empty());
    CHECK_FALSE(bench.jogging.order(axis(0, 2)).empty());
    CHECK_FALSE(bench.jogging.order(axis(0, std::nan(""))).empty());
    JogOrder step = axis(0, 1);
    step.increment = -1;
    CHECK_FALSE(bench.jogging.order(step).empty());
    CHECK(bench.jogging.order({}).empty()); // zeros stop
    CHECK_FALSE(bench.jogging.isMoving());
}
