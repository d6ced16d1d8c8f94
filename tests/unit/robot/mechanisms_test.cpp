// Properties that hold for every mechanism, on random postures, and places of the flange worked out by hand.

#include "tests/unit/robot/posture_rig.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <random>
#include <span>
#include <vector>

using namespace robot_testing;

namespace {

constexpr const char* kMechanisms[] = {
    "CRB 15000-5/0.95", "CRB 15000-10/1.52", "IRB 14050-0.5/0.559", "IRB 460-110/2.4",      "IRB 260-30/1.56",
    "IRB 660-180/3.15", "IRB 760-450/3.18",  "IRB 910SC-3/0.65",    "IRB 920T-6/0.55",      "IRB 360-1/1600",
    "IRB 360-3/1130",   "IRB 2400-16/1.55",  "IRB 390-15/1300",     "IRB 14000-0.5/0.559-L"};

bool isRegular(const Kinematics& kinematics, const Joints& joints) {
    const Singularity near = kinematics.singularity(joints);
    return near.wristDeg > 1 && near.armMm > 1 && near.elbowDeg > 1 && near.shoulderDeg > 1 &&
           near.armAngleDeg > 1 && near.foldDeg > 0.2;
}

/// Largest difference of an axis; whole turns do not count.
double distanceModuloTurns(const Kinematics& kinematics, const Joints& a, const Joints& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double difference = a[i] - b[i];
        largest = std::max(
            largest, std::fabs(kinematics.isLinear(i) ? difference : std::remainder(difference, 360.0)));
    }
    return largest;
}

void checkPoint(const Vec3& found, const Vec3& expected) {
    CHECK(found.x == Approx(expected.x).margin(1e-9));
    CHECK(found.y == Approx(expected.y).margin(1e-9));
    CHECK(found.z == Approx(expected.z).margin(1e-9));
}

Vec3 flangeZ(const Pose& flange) {
    return rotate(flange.rot, {0, 0, 1});
}

} // namespace

TEST_CASE("Joints holds as many axes as the arm has", "[robot][kinematics]") {
    CHECK(Joints{}.size() == 6);
    CHECK(Joints{1, 2, 3, 4}.size() == 4);
    CHECK(Joints::zeros(9).size() == kMostJoints);
    CHECK(Joints{1, 2, 3, 4, 5, 6, 7, 8}.size() == kMostJoints);
    CHECK(Joints{0, 0, 0, 0} != Joints{0, 0, 0, 0, 0});
    CHECK(Joints::zeros(4) == Joints{0, 0, 0, 0});
    double sum = 0;
    for (double value : Joints{1, 2, 3})
        sum += value;
    CHECK(sum == 6);
}

TEST_CASE("axes have the numbers that RAPID gives them", "[robot][kinematics]") {
    const Kinematics palletizer(model("IRB 660-180/3.15"));
    CHECK(palletizer.jointCount() == 4);
    CHECK(palletizer.axisNumber(2) == 3);
    CHECK(palletizer.axisNumber(3) == 6);
    CHECK(palletizer.axisNumber(4) == 0);
    CHECK_FALSE(palletizer.hasArmAngle());
    const Kinematics scara(model("IRB 910SC-3/0.65"));
    CHECK(scara.isLinear(2));
    CHECK_FALSE(scara.isLinear(3));
    CHECK(Kinematics(model("IRB 14050")).hasArmAngle());
    CHECK(Kinematics(model("IRB 14050")).axisNumber(6) == 7);
}

TEST_CASE("an offset wrist puts axis 6 beside axis 5", "[robot][kinematics]") {
    const Kinematics kinematics(model("CRB 15000-5/0.95")); // 265 444 470 101, -110, offset 80
    checkPoint(kinematics.forward({0, 0, 0, 0, 0, 0}).pos, {470 + 101, 0, 265 + 444 + 110 + 80});
    checkPoint(kinematics.forward({0, 0, 0, 0, 90, 0}).pos, {470 + 80, 0, 265 + 444 + 110 - 101});
    checkPoint(kinematics.forward({0, 0, 0, 90, 0, 0}).pos, {470 + 101, -80, 265 + 444 + 110});
    checkPoint(kinematics.forward({0, 0, 0, 0, 0, 70}).pos, {470 + 101, 0, 265 + 444 + 110 + 80});
}

TEST_CASE("rods keep the flange of a palletizer level", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 460-110/2.4")); // 260 745 945 1025, 225 out, 251.5 down
    const Pose zero = kinematics.forward({0, 0, 0, 0});
    checkPoint(zero.pos, {260 + 1025 + 225, 0, 745 + 945 - 251.5});
    checkPoint(flangeZ(zero), {0, 0, -1});
    // Axis 2 does not turn the upper arm, axis 3 does not move the lower one.
    checkPoint(kinematics.forward({0, 90, 0, 0}).pos, {260 + 945 + 1025 + 225, 0, 745 - 251.5});
    const Pose down = kinematics.forward({0, 0, 90, 0});
    checkPoint(down.pos, {260 + 225, 0, 745 + 945 - 1025 - 251.5});
    checkPoint(flangeZ(down), {0, 0, -1});
    checkPoint(kinematics.forward({90, 0, 0, 0}).pos, {0, 260 + 1025 + 225, 745 + 945 - 251.5});
    // Turning axis 1 and axis 6 alike leaves the orientation as it was: they turn about opposite directions.
    CHECK(angleBetween(kinematics.forward({30, 0, 0, 30}).rot, zero.rot) == Approx(0).margin(1e-6));
}

TEST_CASE("a SCARA moves down with axis 3 and turns with the sum of the others", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 910SC-3/0.65")); // 400, 250
    const Pose zero = kinematics.forward({0, 0, 0, 0});
    checkPoint(zero.pos, {650, 0, zero.pos.z});
    checkPoint(kinematics.forward({90, -90, -50, 0}).pos, {250, 400, zero.pos.z - 50});
    CHECK(angleBetween(kinematics.forward({40, 30, -10, -70}).rot, zero.rot) == Approx(0).margin(1e-6));
    CHECK(kinematics.configuration({10, 20, 0, 100}) == ConfData{0, 1, 0, 0});
    CHECK(kinematics.configuration({10, -20, 0, 100}) == ConfData{0, 1, 0, 1});
}

TEST_CASE("a delta robot with equal arms hangs on its centre line", "[robot][kinematics]") {
    const Kinematics kinematics(model("IRB 360-1/1600")); // 164, 524, 1244, 44
    // Level arms: the rods reach from radius 164 + 524 to radius 44.
    const double across = 164 + 524 - 44;
    const Pose flange = kinematics.forward({0, 0, 0, 0});
    checkPoint(flange.pos, {0, 0, -std::sqrt(1244.0 * 1244 - across * across)});
    checkPoint(flangeZ(flange), {0, 0, -1});
    // Arms straight down.
    const double inner = 164 - 44;
    checkPoint(kinematics.forward({90, 90, 90, 0}).pos,
               {0, 0, -524 - std::sqrt(1244.0 * 1244 - inner * inner)});
    // Lifting arm 1 pulls the platform up and towards it.
    const Pose pulled = kinematics.forward({-5, 0, 0, 0});
    CHECK(pulled.pos.x > 1);
    CHECK(pulled.pos.y == Approx(0).margin(1e-9));
    CHECK(pulled.pos.z > flange.pos.z);
}

TEST_CASE("every solution of every mechanism gives the pose, and the posture is among them",
          "[robot][kinematics][slow]") {
    for (const char* name : kMechanisms) {
        CAPTURE(name);
        const RobotModel robot = model(name);
        const Kinematics kinematics(robot);
        Postures postures(robot);
        double worstPosition = 0;
        double worstTurn = 0;
        double worstArmAngle = 0;
        int missing = 0;
        const int count = kinematics.jointCount() == 7 ? 5000 : 20000;
        for (int n = 0; n < count; ++n) {
            const Joints joints = postures.next();
            if (!isRegular(kinematics, joints)) continue;
            const Pose flange = kinematics.forward(joints);
            const double armAngle = kinematics.armAngle(joints);
            IkBranches branches;
            kinematics.inverseAll(flange, joints, branches, armAngle);
            double best = 1e9;
            for (int k = 0; k < static_cast<int>(kMostBranches); ++k) {
                if (!branches.has(k)) continue;
                const Joints& found = branches.joints[static_cast<std::size_t>(k)];
                const Pose again = kinematics.forward(found);
                worstPosition = std::max(worstPosition, norm(again.pos - flange.pos));
                worstTurn = std::max(worstTurn, angleBetween(again.rot, flange.rot));
                worstArmAngle = std::max(
                    worstArmAngle, std::fabs(std::remainder(kinematics.armAngle(found) - armAngle, 360.0)));
                best = std::min(best, distanceModuloTurns(kinematics, found, joints));
            }
            if (best > 1e-7) ++missing;
        }
        CHECK(worstPosition < 1e-7); // mm
        CHECK(worstTurn < 1e-6);
        CHECK(worstArmAngle < 1e-6);
        CHECK(missing == 0);
    }
}

TEST_CASE("solutions of an offset wrist come in pairs", "[robot][kinematics]") {
    // The condition on axis 6 is continuous and closes over a turn, within the reach: its roots are even in number.
    const RobotModel robot = model("CRB 15000-10/1.52");
    const Kinematics kinematics(robot);
    Postures postures(robot, 13);
    int odd = 0;
    int most = 0;
    for (int n = 0; n < 5000; ++n) {
        const Joints joints = postures.next();
        if (!isRegular(kinematics, joints)) continue;
        IkBranches branches;
        kinematics.inverseAll(kinematics.forward(joints), Joints{}, branches);
        if (branches.count() % 2 != 0) ++odd;
        most = std::max(most, branches.count());
    }
    CHECK(odd == 0);
    CHECK(most > 8); // more than a spherical wrist can have
}

TEST_CASE("configuration data of every mechanism name the posture they were read from",
          "[robot][kinematics][slow]") {
    for (const char* name : kMechanisms) {
        CAPTURE(name);
        const RobotModel robot = model(name);
        const Kinematics kinematics(robot);
        Postures postures(robot, 3);
        int wrong = 0;
        int otherFigures = 0;
        for (int n = 0; n < 3000; ++n) {
            const Joints joints = postures.next();
            if (!isRegular(kinematics, joints)) continue;
            const ConfData conf = kinematics.configuration(joints);
            const Pose flange = kinematics.forward(joints);
            const double armAngle = kinematics.armAngle(joints);
            const auto near = kinematics.inverse(flange, conf, joints, armAngle);
            if (!near || distance(*near, joints) > 1e-6) ++wrong;
            // Without a hint another solution may come that has the same four figures, but none with others.
            const auto any = kinematics.inverse(flange, conf, Joints::zeros(joints.size()), armAngle);
            if (any && kinematics.configuration(*any) != conf) ++otherFigures;
        }
        CHECK(wrong == 0);
        CHECK(otherFigures == 0);
    }
}

/// Rule: solving poses together changes no result by a bit, even if one of them cannot be reached, passes a singularity, or begins from
/// the solution of another one.
TEST_CASE("poses that are solved together have the solutions of each alone", "[robot][kinematics]") {
    std::vector<const char*> names(std::begin(kMechanisms), std::end(kMechanisms));
    names.insert(names.end(), {"IRB 120-3/0.58", "IRB 6640-180/2.55"});
    for (const char* name : names) {
        CAPTURE(name);
        const RobotModel robot = model(name);
        const Kinematics kinematics(robot);
        Postures postures(robot, 11);
        std::mt19937_64 random(3);
        int solved = 0, different = 0;
        for (int round = 0; round < 1500; ++round) {
            const Joints seed = postures.next();
            std::array<InverseTask, 5> tasks;
            const std::size_t count = 1 + random() % tasks.size();
            for (std::size_t i = 0; i < count; ++i) {
                InverseTask& task = tasks[i];
                const double most = random() % 8 == 0 ? 40 : 2; // deg from the seed
                Joints joints = seed;
                for (double& angle : joints)
                    angle += std::uniform_real_distribution<double>(-most, most)(random);
                if (random() % 8 == 0 && joints.size() > 4) joints[4] = 0;
                task.flange = kinematics.forward(joints);
                if (random() % 16 == 0) task.flange.pos.x += 20000;
                task.armAngleDeg = kinematics.armAngle(joints);
                task.seed = i > 0 && random() % 2 == 0 ? &tasks[random() % i].joints : &seed;
            }
            kinematics.inverseContinueEach(std::span(tasks).first(count));
            for (std::size_t i = 0; i < count; ++i) {
                Joints alone = *tasks[i].seed;
                const bool isSolved =
                    kinematics.inverseContinue(tasks[i].flange, *tasks[i].seed, alone, tasks[i].armAngleDeg);
                if (isSolved != tasks[i].isSolved || !(alone == tasks[i].joints)) ++different;
                if (isSolved) ++solved;
            }
        }
        CHECK(different == 0);
        CHECK(solved > 1000);
    }
}

TEST_CASE("every mechanism follows a path through joint space", "[robot][kinematics]") {
    for (const char* name : kMechanisms) {
        CAPTURE(name);
        const RobotModel robot = model(name);
        const Kinematics kinematics(robot);
        Postures postures(robot, 5);
        int lost = 0;
        for (int path = 0; path < 20; ++path) {
            const Joints from = postures.next();
            const Joints to = postures.next();
            Joints seed = from;
            Joints joints = from;
            for (int step = 0; step <= 400; ++step) {
                for (std::size_t i = 0; i < joints.size(); ++i)
                    joints[i] = from[i] + (to[i] - from[i]) * step / 400;
                // A singularity between two steps would leave two ways to continue.
                if (!isRegular(kinematics, joints) || kinematics.singularity(joints).wristDeg < 6) break;
                Joints found;
                const bool isFound = kinematics.inverseContinue(kinematics.forward(joints), seed, found,
                                                                kinematics.armAngle(joints));
                if (!isFound || distance(found, joints) > 1e-6) {
                    ++lost;
                    break;
                }
                seed = found;
            }
        }
        CHECK(lost == 0);
    }
}

TEST_CASE("the Jacobian of every mechanism is the derivative of its forward kinematics",
          "[robot][kinematics]") {
    for (const char* name : kMechanisms) {
        CAPTURE(name);
        const RobotModel robot = model(name);
        const Kinematics kinematics(robot);
        Postures postures(robot, 9);
        for (int n = 0; n < 100; ++n) {
            const Joints joints = postures.next();
            if (!isRegular(kinematics, joints)) continue;
            const JacobianMatrix jacobian = kinematics.jacobian(joints);
            REQUIRE(jacobian.columns == joints.size());
            for (std::size_t i = 0; i < joints.size(); ++i) {
                constexpr double kStep = 1e-3; // deg or mm
                Joints before = joints;
                Joints after = joints;
                before[i] -= kStep;
                after[i] += kStep;
                const Pose from = kinematics.forward(before);
                const Pose to = kinematics.forward(after);
                const double step = 2 * kStep * (kinematics.isLinear(i) ? 1 : std::numbers::pi / 180);
                const Vec3 speed = (to.pos - from.pos) * (1 / step);
                const Vec3 turn = rotationVector(to.rot * conjugate(from.rot)) * (1 / step);
                const double expected[6] = {speed.x, speed.y, speed.z, turn.x, turn.y, turn.z};
                for (std::size_t row = 0; row < 6; ++row)
                    CHECK(jacobian(row, i) == Approx(expected[row]).margin(row < 3 ? 1e-3 : 1e-6));
            }
        }
    }
}

TEST_CASE("limits, reach and nonsense give reasons and never a crash", "[robot][kinematics]") {
    for (const char* name : kMechanisms) {
        CAPTURE(name);
        const RobotModel robot = model(name);
        const Kinematics kinematics(robot);
        const Joints zero = Joints::zeros(kinematics.jointCount());
        Joints outside = zero;
        outside[3] = robot.upperDeg[3] + 5;
        CHECK(kinematics.jointOutsideLimits(outside) == 4);
        CHECK(kinematics.jointOutsideLimits(zero) == 0);

        Pose pose = kinematics.forward(zero);
        const double armAngle = kinematics.armAngle(zero);
        Joints out;
        pose.pos.x += 20000;
        CHECK(kinematics.inverseNear(pose, zero, armAngle).error().kind == IkErrorKind::Unreachable);
        CHECK_FALSE(kinematics.inverse(pose, {}, zero, armAngle).hasValue());
        CHECK_FALSE(kinematics.inverseContinue(pose, zero, out, armAngle));
        const double nan = std::nan("");
        for (const Pose& bad : {Pose{{nan, 0, 500}, {}}, Pose{{300, 0, 500}, {nan, 0, 0, 1}},
                                Pose{{HUGE_VAL, 0, 500}, {0, 0, 1, 0}}, Pose{{300, 0, nan}, {0, 0, 1, 0}}}) {
            IkBranches branches;
            kinematics.inverseAll(bad, zero, branches, armAngle);
            CHECK(branches.valid == 0);
            CHECK_FALSE(kinematics.inverseNear(bad, zero, armAngle).hasValue());
            CHECK_FALSE(kinematics.inverseContinue(bad, zero, out, armAngle));
        }
        Joints badSeed = zero;
        badSeed.fill(nan);
        (void)kinematics.inverse(kinematics.forward(zero), {}, badSeed);
        (void)kinematics.inverseContinue(kinematics.forward(zero), badSeed, out);
        (void)kinematics.configuration(badSeed);
        (void)kinematics.forward(Joints{1, 2}); // a different number of axes
    }
    CHECK_FALSE(Kinematics().inverseNear({{100, 0, 0}, {}}, {}).hasValue()); // no arm at all
}

TEST_CASE("the rods of a palletizer limit the angle between its arms", "[robot][kinematics]") {
    const Kinematics kinematics(
        model("IRB 460-110/2.4")); // elbow 20 to 153; axis 2 -40 to 85, axis 3 -20 to 120
    // Upright lower arm and level upper arm: a right angle. Axis 2 stretches, axis 3 folds.
    CHECK(kinematics.elbowAngle({0, 0, 0, 0}) == Approx(90));
    CHECK(kinematics.elbowAngle({0, 30, -10, 0}) == Approx(130));
    CHECK(kinematics.jointOutsideLimits({0, 60, -2, 0}) == 0); // 152 degrees
    CHECK(kinematics.jointOutsideLimits({0, 60, -4, 0}) ==
          3); // 154 degrees, both axes within their own ranges
    CHECK(kinematics.jointOutsideLimits({0, 0, 69, 0}) == 0);
    CHECK(kinematics.jointOutsideLimits({0, 0, 71, 0}) == 3);
    const Joints folded{0, 0, 75, 0};
    const auto refused =
        kinematics.inverse(kinematics.forward(folded), kinematics.configuration(folded), folded);
    REQUIRE_FALSE(refused.hasValue());
    CHECK(refused.error().kind == IkErrorKind::OutOfElbowLimits);
    CHECK(refused.error().angleDeg == Approx(15));
    CHECK(refused.error().message().find("15.00 degrees to each other") != std::string::npos);
    const Joints bent{0, 0, 121, 0};
    CHECK(kinematics.limitError(bent, 3).kind ==
          IkErrorKind::OutOfJointLimits); // axis 3 alone is outside already
}

TEST_CASE("an arm of four axes cannot tilt its flange", "[robot][kinematics]") {
    for (const char* name : {"IRB 460-110/2.4", "IRB 910SC-3/0.65", "IRB 360-1/1600"}) {
        CAPTURE(name);
        const RobotModel robot = model(name);
        const Kinematics kinematics(robot);
        const Joints joints = Postures(robot).next();
        Pose flange = kinematics.forward(joints);
        REQUIRE(kinematics.inverseNear(flange, joints).hasValue());
        const Quat level = flange.rot;
        flange.rot = level * fromAxisAngle({1, 0, 0}, 0.01); // the digits of a program
        CHECK(kinematics.inverseNear(flange, joints).hasValue());
        flange.rot = level * fromAxisAngle({1, 0, 0}, 1);
        REQUIRE_FALSE(kinematics.inverseNear(flange, joints).hasValue());
        CHECK(kinematics.inverseNear(flange, joints).error().kind == IkErrorKind::Unreachable);
    }
}
