// Properties of the closed-form kinematics: what the geometry demands, checked on random postures of several
// models.

#include "tests/unit/robot/posture_rig.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace robot_testing;

namespace {

constexpr const char* kModels[] = {"IRB 120-3/0.58",   "IRB 140-6/0.81",   "IRB 1300-10/1.15",
                                   "IRB 2400-16/1.55", "IRB 4600-60/2.05", "IRB 6700-150/3.2"};

double angleDistance(double a, double b) {
    return std::fabs(std::remainder(a - b, 360.0));
}

bool isInvertible(const Kinematics& kinematics, const Joints& joints) {
    const Singularity near = kinematics.singularity(joints);
    return near.wristDeg > 0.5 && near.armMm > 1 && near.elbowDeg > 0.5;
}

double poseDistance(const Pose& a, const Pose& b) {
    return norm(a.pos - b.pos) + angleBetween(a.rot, b.rot);
}

} // namespace

TEST_CASE("the zero posture of the IRB 120 has the flange where the drawing puts it", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 120-3/0.58"));
    const Pose flange = kinematics.forward({0, 0, 0, 0, 0, 0});
    CHECK(flange.pos.x == Approx(302 + 72).margin(1e-12));
    CHECK(flange.pos.y == Approx(0).margin(1e-12));
    CHECK(flange.pos.z == Approx(290 + 270 + 70).margin(1e-12));
    const Vec3 z = rotate(flange.rot, {0, 0, 1});
    CHECK(z.x == Approx(1).margin(1e-12));
    const Vec3 x = rotate(flange.rot, {1, 0, 0}); // a quarter turn about y
    CHECK(x.z == Approx(-1).margin(1e-12));
}

TEST_CASE("each axis turns in the documented direction", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 120-3/0.58"));
    // Axis 1 about +z.
    CHECK(kinematics.forward({90, 0, 0, 0, 0, 0}).pos.y == Approx(374).margin(1e-9));
    // Axis 2 about +y: upper arm and forearm lean forward; forearm along -z at 90 degrees.
    const Pose leaning = kinematics.forward({0, 90, 0, 0, 0, 0});
    CHECK(leaning.pos.x == Approx(270 + 70).margin(1e-9));
    CHECK(leaning.pos.z == Approx(290 - 302 - 72).margin(1e-9));
    // Axis 3 about +y: forearm straight down at 90 degrees.
    const Pose bent = kinematics.forward({0, 0, 90, 0, 0, 0});
    CHECK(bent.pos.x == Approx(70).margin(1e-9));
    CHECK(bent.pos.z == Approx(290 + 270 - 302 - 72).margin(1e-9));
    // Axis 5 about +y: flange down at 90 degrees.
    const Pose down = kinematics.forward({0, 0, 0, 0, 90, 0});
    CHECK(down.pos.x == Approx(302).margin(1e-9));
    CHECK(down.pos.z == Approx(630 - 72).margin(1e-9));
    // Axes 4 and 6 about +x: with axis 5 down, axis 4 at 90 turns the flange from -z to... +y.
    const Pose turned = kinematics.forward({0, 0, 0, 90, 90, 0});
    CHECK(turned.pos.y == Approx(72).margin(1e-9));
    const Vec3 y = rotate(kinematics.forward({0, 0, 0, 0, 0, 90}).rot, {0, 1, 0});
    CHECK(y.z == Approx(1).margin(1e-12));
}

TEST_CASE("forward of inverse gives the pose, and every posture is found again",
          "[robot][kinematics][slow]") {
    for (const char* name : kModels) {
        CAPTURE(name);
        const RobotModel robot = model(name);
        const Kinematics kinematics(robot);
        Postures postures(robot);
        double worstPosition = 0;
        double worstTurn = 0;
        double worstJoint = 0;
        int missing = 0;
        int branchesWrong = 0;
        for (int n = 0; n < 100000; ++n) {
            const Joints joints = postures.next();
            const Pose flange = kinematics.forward(joints);
            IkBranches branches;
            kinematics.inverseAll(flange, joints, branches);
            double best = 1e9;
            for (int cfx = 0; cfx < 8; ++cfx) {
                if (!branches.has(cfx)) continue;
                const Joints& found = branches.joints[static_cast<std::size_t>(cfx)];
                const Pose again = kinematics.forward(found);
                worstPosition = std::max(worstPosition, norm(again.pos - flange.pos));
                worstTurn = std::max(worstTurn, angleBetween(again.rot, flange.rot));
                double distance = 0;
                for (std::size_t i = 0; i < 6; ++i)
                    distance = std::max(distance, angleDistance(found[i], joints[i]));
                best = std::min(best, distance);
                if (isInvertible(kinematics, found) && kinematics.configuration(found).cfx != cfx)
                    ++branchesWrong;
            }
            if (!isInvertible(kinematics, joints)) continue;
            worstJoint = std::max(worstJoint, best < 1 ? best : 0.0);
            if (best > 1e-6) ++missing;
        }
        CHECK(worstPosition < 1e-8); // mm, even at the edge of reach, where the root loses half of its digits
        CHECK(worstTurn < 1e-6);
        CHECK(worstJoint < 1e-8);
        CHECK(missing == 0);
        CHECK(branchesWrong == 0);
    }
}

TEST_CASE("away from singularities the inverse is exact to rounding", "[robot][kinematics]") {
    const RobotModel robot = model("IRB 120-3/0.58");
    const Kinematics kinematics(robot);
    Postures postures(robot, 11);
    double worst = 0;
    for (int n = 0; n < 20000; ++n) {
        const Joints joints = postures.next();
        if (!isInvertible(kinematics, joints)) continue;
        const Pose flange = kinematics.forward(joints);
        const auto found = kinematics.inverse(flange, kinematics.configuration(joints), joints);
        REQUIRE(found.hasValue());
        worst = std::max(worst, poseDistance(kinematics.forward(*found), flange));
    }
    CHECK(worst < 1e-10);
}

TEST_CASE("configuration data name the posture they were read from", "[robot][kinematics]") {
    for (const char* name : kModels) {
        CAPTURE(name);
        const RobotModel robot = model(name);
        const Kinematics kinematics(robot);
        Postures postures(robot, 3);
        int wrong = 0;
        for (int n = 0; n < 20000; ++n) {
            const Joints joints = postures.next();
            if (!isInvertible(kinematics, joints)) continue;
            const ConfData conf = kinematics.configuration(joints);
            const auto found = kinematics.inverse(kinematics.forward(joints), conf, Joints{});
            double distance = 1e9;
            if (found) {
                distance = 0;
                for (std::size_t i = 0; i < 6; ++i)
                    distance = std::max(distance, std::fabs((*found)[i] - joints[i]));
            }
            if (distance > 1e-6) ++wrong; // including the right turn of axes that have more than one
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("quarter revolutions count from zero upwards and from minus one downwards", "[robot][kinematics]") {
    CHECK(quarterRevolution(0) == 0);
    CHECK(quarterRevolution(89.99) == 0);
    CHECK(quarterRevolution(90) == 1);
    CHECK(quarterRevolution(399) == 4);
    CHECK(quarterRevolution(-0.01) == -1);
    CHECK(quarterRevolution(-90) == -1);
    CHECK(quarterRevolution(-90.01) == -2);
    CHECK(quarterRevolution(-1e-12) == 0); // rounding
}

TEST_CASE("cfx follows wrist, elbow and shoulder", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 140-6/0.81"));
    CHECK(kinematics.configuration({0, 0, 0, 0, 30, 0}).cfx == 0);
    CHECK(kinematics.configuration({0, 0, 0, 0, -30, 0}).cfx == 1);
    CHECK(kinematics.configuration({0, 45, -170, 0, 30, 0}).cfx == 2);
    // Upper arm leaning back far enough to carry the wrist centre behind axis 1.
    CHECK(kinematics.configuration({0, -80, -30, 0, 30, 0}).cfx == 4);
}

TEST_CASE("joint limits are kept and reported with the axis", "[robot][kinematics]") {
    const RobotModel robot = model("IRB 120-3/0.58");
    const Kinematics kinematics(robot);
    CHECK(kinematics.jointOutsideLimits({0, 0, 0, 0, 0, 400}) == 0);
    CHECK(kinematics.jointOutsideLimits({0, 0, 0, 0, 0, 401}) == 6);
    CHECK(kinematics.jointOutsideLimits({0, 0, 71, 0, 0, 0}) == 3);
    const Joints outside{0, 20, 0, 0, 125, 0};
    const auto found =
        kinematics.inverse(kinematics.forward(outside), kinematics.configuration(outside), outside);
    REQUIRE_FALSE(found.hasValue());
    CHECK(found.error().kind == IkErrorKind::OutOfJointLimits);
    CHECK(found.error().joint == 5);
    CHECK(found.error().angleDeg == Approx(125));

    Postures postures(robot, 5);
    for (int n = 0; n < 5000; ++n) {
        const Joints joints = postures.next();
        const auto near = kinematics.inverseNear(kinematics.forward(joints), postures.next());
        REQUIRE(near.hasValue()); // the posture itself is one solution
        CHECK(kinematics.jointOutsideLimits(*near) == 0);
    }
}

TEST_CASE("what cannot be reached is said so", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 120-3/0.58"));
    const Pose far{{2000, 0, 500}, {}};
    IkBranches branches;
    kinematics.inverseAll(far, {}, branches);
    CHECK(branches.valid == 0);
    REQUIRE_FALSE(kinematics.inverseNear(far, {}).hasValue());
    CHECK(kinematics.inverseNear(far, {}).error().kind == IkErrorKind::Unreachable);
    CHECK(kinematics.inverse(far, {}, {}).error().kind == IkErrorKind::Unreachable);
    const Pose nonsense{{std::nan(""), 0, 500}, {}};
    CHECK_FALSE(kinematics.inverseNear(nonsense, {}).hasValue());
    CHECK_FALSE(kinematics.inverse(nonsense, {}, {}).hasValue());

    // Reachable, but axis 4 is half a turn and more away from the quarter asked for.
    const Joints joints{10, 10, 10, 10, 40, 10};
    const auto found = kinematics.inverse(kinematics.forward(joints), {0, -2, 0, 0}, joints);
    REQUIRE_FALSE(found.hasValue());
    CHECK(found.error().kind == IkErrorKind::NoSuchConfiguration);
    CHECK(found.error().joint == 4);
    CHECK_FALSE(kinematics.inverse(kinematics.forward(joints), {0, 0, 0, 9}, joints).hasValue());
}

TEST_CASE("a close configuration is accepted, one quarter off", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 120-3/0.58"));
    const Joints joints{10, 10, 10, 10, 40, 10};
    const auto found = kinematics.inverse(kinematics.forward(joints), {-1, 1, -1, 0}, joints);
    REQUIRE(found.hasValue());
    CHECK((*found)[0] == Approx(10));
    CHECK((*found)[3] == Approx(10));
}

TEST_CASE("axis 6 takes the revolution that confdata asks for", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 120-3/0.58"));
    const Joints joints{0, 0, 0, 0, 30, 20};
    const Pose flange = kinematics.forward(joints);
    CHECK((*kinematics.inverse(flange, {0, 0, 0, 0}, {}))[5] == Approx(20));
    CHECK((*kinematics.inverse(flange, {0, 0, 4, 0}, {}))[5] == Approx(380));
    CHECK((*kinematics.inverse(flange, {0, 0, -4, 0}, {}))[5] == Approx(-340));
}

TEST_CASE("axis 4 stays where it is when axis 5 passes through zero", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 120-3/0.58"));
    for (double axis4 : {0.0, 35.0, -120.0}) {
        Joints joints{15, 20, -10, axis4, 30, 40};
        Joints seed = joints;
        for (double axis5 = 30; axis5 >= -30; axis5 -= 0.5) {
            joints[4] = axis5;
            Joints found;
            REQUIRE(kinematics.inverseContinue(kinematics.forward(joints), seed, found));
            for (std::size_t i = 0; i < 6; ++i)
                CHECK(found[i] == Approx(joints[i]).margin(1e-9));
            seed = found;
        }
    }
}

TEST_CASE("axis 1 stays where it is when the wrist centre passes over it", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 120-3/0.58"));
    // Axis 2 leans the arm back until the wrist centre is behind axis 1.
    Joints seed{25, -20, -60, 10, 40, 0};
    for (double axis2 = -20; axis2 >= -60; axis2 -= 0.25) {
        const Joints joints{25, axis2, -60, 10, 40, 0};
        Joints found;
        REQUIRE(kinematics.inverseContinue(kinematics.forward(joints), seed, found));
        CHECK(found[0] == Approx(25).margin(1e-7));
        CHECK(found[1] == Approx(axis2).margin(1e-7));
        seed = found;
    }
    CHECK(kinematics.configuration(seed).cfx == 4);
}

TEST_CASE("the Jacobian is the derivative of the forward kinematics", "[robot][kinematics]") {
    for (const char* name : {"IRB 120-3/0.58", "IRB 6700-150/3.2"}) {
        const RobotModel robot = model(name);
        const Kinematics kinematics(robot);
        Postures postures(robot, 9);
        for (int n = 0; n < 200; ++n) {
            const Joints joints = postures.next();
            const JacobianMatrix jacobian = kinematics.jacobian(joints);
            for (std::size_t i = 0; i < 6; ++i) {
                constexpr double kStepDeg = 1e-3;
                Joints before = joints;
                Joints after = joints;
                before[i] -= kStepDeg;
                after[i] += kStepDeg;
                const Pose from = kinematics.forward(before);
                const Pose to = kinematics.forward(after);
                const double step = 2 * kStepDeg * std::numbers::pi / 180;
                const Vec3 speed = (to.pos - from.pos) * (1 / step);
                const Vec3 turn = rotationVector(to.rot * conjugate(from.rot)) * (1 / step);
                const double expected[6] = {speed.x, speed.y, speed.z, turn.x, turn.y, turn.z};
                for (std::size_t row = 0; row < 6; ++row) {
                    CHECK(jacobian[6 * row + i] == Approx(expected[row]).margin(row < 3 ? 1e-4 : 1e-6));
                }
            }
        }
    }
}
