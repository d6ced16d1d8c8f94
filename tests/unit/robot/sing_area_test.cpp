// The inverses that SingArea needs: wrist axes given, and axis 4 locked.

#include "tests/unit/robot/posture_rig.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace robot_testing;

namespace {

const Pose kTool{{30, -20, 150}, fromEulerZyx(20, 30, -10)};

constexpr const char* kSixAxes[] = {"IRB 120-3/0.58", "IRB 2400-16/1.55", "CRB 15000-5/0.95"};

} // namespace

TEST_CASE("with the wrist axes given the tool centre point is reached exactly", "[robot][kinematics]") {
    for (const char* name : kSixAxes) {
        CAPTURE(name);
        const Kinematics kinematics(model(name));
        const Joints from{10, 20, -10, 30, 40, 50};
        const Joints to{25, 35, -20, -60, -30, 90}; // axis 5 changes its sign on the way
        const Vec3 start = (kinematics.forward(from) * kTool).pos;
        const Vec3 end = (kinematics.forward(to) * kTool).pos;
        Joints seed = from;
        for (int step = 0; step <= 100; ++step) {
            const double k = step / 100.0;
            Joints wrist;
            for (std::size_t i = 3; i < 6; ++i)
                wrist[i] = from[i] + (to[i] - from[i]) * k;
            const Vec3 tcp = start + (end - start) * k;
            Joints found;
            REQUIRE(kinematics.inverseWithWrist(tcp, kTool, wrist, seed, found));
            CHECK(norm((kinematics.forward(found) * kTool).pos - tcp) < 1e-9);
            for (std::size_t i = 3; i < 6; ++i)
                CHECK(found[i] == wrist[i]);
            CHECK(distance(found, seed) < 10); // no jump to another branch
            seed = found;
        }
        CHECK(distance(seed, to) < 1e-9); // the programmed orientation at the end
    }
}

TEST_CASE("the wrist-given inverse says what it cannot reach", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 120-3/0.58"));
    Joints out;
    CHECK_FALSE(kinematics.inverseWithWrist({3000, 0, 0}, kTool, {}, {}, out));
    CHECK_FALSE(kinematics.inverseWithWrist({std::nan(""), 0, 0}, kTool, {}, {}, out));
    CHECK_FALSE(Kinematics(model("IRB 460")).inverseWithWrist({1500, 0, 1000}, kTool, {}, {}, out));
}

TEST_CASE("with axis 4 locked a pose that five axes can give is kept", "[robot][kinematics]") {
    for (const char* name : kSixAxes) {
        CAPTURE(name);
        const Kinematics kinematics(model(name));
        std::mt19937_64 random(4);
        std::uniform_real_distribution<double> angle(-60, 60);
        for (int n = 0; n < 200; ++n) {
            const double locked = n % 2 == 0 ? 0.0 : 180.0;
            const Joints joints{angle(random), angle(random) / 2, angle(random) / 2,
                                locked,        angle(random),     angle(random)};
            if (kinematics.singularity(joints).armMm < 50) continue;
            const Pose tcp = kinematics.forward(joints) * kTool;
            Joints seed = joints;
            for (double& value : seed)
                value += 1;
            Joints found;
            REQUIRE(kinematics.inverseLockedAxis4(tcp, kTool, locked, seed, found));
            CHECK(distance(found, joints) < 1e-6);
        }
    }
}

TEST_CASE("with axis 4 locked the tool is turned no further than it must be", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 2400-16/1.55"));
    const Joints joints{15, 20, -10, 25, 50, 30}; // axis 4 is not at 0
    const Pose tcp = kinematics.forward(joints) * kTool;
    Joints found;
    REQUIRE(kinematics.inverseLockedAxis4(tcp, kTool, 0, joints, found));
    const Pose reached = kinematics.forward(found) * kTool;
    CHECK(found[3] == 0);
    CHECK(norm(reached.pos - tcp.pos) < 1e-7);
    const double error = angleBetween(reached.rot, tcp.rot);
    CHECK(error > 1);
    // For this axis 1, no other pair of pitch and axis 6 is nearer.
    for (std::size_t axis : {4U, 5U}) {
        for (double step : {-0.5, 0.5}) {
            Joints other = found;
            other[axis] += step;
            CHECK(angleBetween((kinematics.forward(other) * kTool).rot, tcp.rot) > error);
        }
    }
    // A path from a pose with axis 4 at 0 has no jumps.
    Joints seed = found;
    for (int step = 0; step <= 50; ++step) {
        Pose next = reached;
        next.pos.y += 2.0 * step;
        Joints here;
        REQUIRE(kinematics.inverseLockedAxis4(next, kTool, 0, seed, here));
        CHECK(norm((kinematics.forward(here) * kTool).pos - next.pos) < 1e-7);
        CHECK(distance(here, seed) < 2);
        seed = here;
    }
}

TEST_CASE("axis 4 is locked at half turns only", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 120-3/0.58"));
    const Joints joints{10, 10, 10, 0, 30, 0};
    const Pose tcp = kinematics.forward(joints) * kTool;
    Joints out;
    CHECK(kinematics.inverseLockedAxis4(tcp, kTool, -180, {10, 10, 10, -180, -30, 180}, out));
    CHECK(out[3] == -180);
    CHECK(norm((kinematics.forward(out) * kTool).pos - tcp.pos) < 1e-7);
    CHECK_FALSE(kinematics.inverseLockedAxis4(tcp, kTool, 90, joints, out));
    CHECK_FALSE(kinematics.inverseLockedAxis4(tcp, kTool, std::nan(""), joints, out));
    CHECK_FALSE(kinematics.inverseLockedAxis4({{5000, 0, 0}, {}}, kTool, 0, joints, out));
    CHECK_FALSE(kinematics.inverseLockedAxis4({{std::nan(""), 0, 0}, {}}, kTool, 0, joints, out));
    CHECK_FALSE(Kinematics(model("IRB 14050")).inverseLockedAxis4(tcp, kTool, 0, joints, out));
}
