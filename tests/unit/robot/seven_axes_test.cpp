// The arm with seven axes against RobotStudio: joints, flange and arm angle of ten postures as the test data of
// rpiRobotics/yumi-ik (compare_to_robotstudio.m) record them, rounded to hundredths there.

#include "runtime/robot/kinematics.h"
#include "runtime/robot/robot_model.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace robot;

namespace {

struct Recorded {
    double chain[7]; // axes 1, 2, 7, 3, 4, 5, 6
    Vec3 pos;
    double roll, pitch, yaw;     // about fixed x, y, z
    double armAngleZ, armAngleY; // with reference directions z and y
};

constexpr Recorded kRecorded[] = {
    {{0, 0, 0, 0, 0, 0, 0}, {341.5, 0, 598}, 0, 90, 0, 0, 90},
    {{20, 20, 20, 20, 20, 20, 20}, {292.46, 234.73, 348.75}, 148.67, 16.13, 175.45, 6.86, 105.54},
    {{30, 30, 30, 30, 30, 30, 30}, {165.49, 290.86, 255.37}, 157.34, -19.80, -175.99, 14.50, 99.26},
    {{-40, -40, -40, -40, -40, -40, -40}, {-219.17, 12.62, 796.12}, 13.67, -3.39, -152.29, 106.67, 15.68},
    {{-80, -80, -80, -80, -80, -80, -80}, {-126.60, 499.23, 441.88}, 5.30, 17.08, 34.27, 99.01, -26},
    {{104, -31, 1, -18, -55, 117, 69}, {32.02, 91.43, 763.94}, 157.59, 43.43, 170.70, 19.58, -165.56},
    {{162, 1, -23, -88, 241, 98, -44}, {45.84, 32.22, 846.74}, -98.58, 43.30, -76.21, 80.07, -131.03},
    {{-20, -139, -144, 77, -263, 128, -104},
     {-47.12, -136.89, 270.77},
     -106.88,
     -60.36,
     122.56,
     139.68,
     -15.92},
    {{67, -142, 121, 78, -38, 113, -194}, {-100.23, 3.25, 338.01}, 43.05, -59.81, 44.29, -146.69, 119.74},
    {{-58, -138, -35, 70, -283, 133, 207},
     {-123.66, 141.01, 425.04},
     -118.25,
     -37.89,
     -10.09,
     165.86,
     50.38}};

Joints jointsOf(const Recorded& r) {
    const double* c = r.chain;
    return {c[0], c[1], c[3], c[4], c[5], c[6], c[2]};
}

RobotModel yumi() {
    auto loaded = loadRobotModel("IRB 14050-0.5/0.559");
    REQUIRE(loaded.hasValue());
    return *loaded;
}

} // namespace

TEST_CASE("flange and arm angle of seven axes agree with RobotStudio", "[robot][kinematics]") {
    RobotModel model = yumi();
    const Kinematics byZ(model);
    model.sevenAxes.armAngleReference = {0, 1, 0};
    const Kinematics byY(model);
    for (const Recorded& r : kRecorded) {
        CAPTURE(r.chain[0]);
        const Joints joints = jointsOf(r);
        const Pose flange = byZ.forward(joints);
        CHECK(norm(flange.pos - r.pos) < 0.01); // half a hundredth per coordinate
        CHECK(angleBetween(flange.rot, fromEulerZyx(r.yaw, r.pitch, r.roll)) < 0.02);
        CHECK(std::fabs(std::remainder(byZ.armAngle(joints) - r.armAngleZ, 360.0)) < 0.011);
        CHECK(std::fabs(std::remainder(byY.armAngle(joints) - r.armAngleY, 360.0)) < 0.011);
    }
}

TEST_CASE("the arm angle moves the elbow and nothing else", "[robot][kinematics]") {
    const Kinematics kinematics(yumi());
    const Joints joints{20, -60, 20, 30, 50, 20, 30};
    const Pose flange = kinematics.forward(joints);
    Joints seed = joints;
    double moved = 0;
    for (double angle = kinematics.armAngle(joints); angle > kinematics.armAngle(joints) - 20; angle -= 0.5) {
        Joints found;
        REQUIRE(kinematics.inverseContinue(flange, seed, found, angle));
        const Pose again = kinematics.forward(found);
        CHECK(norm(again.pos - flange.pos) < 1e-7);
        CHECK(angleBetween(again.rot, flange.rot) < 1e-6);
        CHECK(kinematics.armAngle(found) == Approx(angle).margin(1e-7));
        moved = std::fabs(found[6] - joints[6]);
        seed = found;
    }
    CHECK(moved > 1);
}

TEST_CASE("without an arm angle that of the seed is kept", "[robot][kinematics]") {
    const Kinematics kinematics(yumi());
    const Joints seed{20, -60, 20, 30, 50, 20, 30};
    Pose flange = kinematics.forward(seed);
    flange.pos.z += 10;
    Joints found;
    REQUIRE(kinematics.inverseContinue(flange, seed, found));
    CHECK(kinematics.armAngle(found) == Approx(kinematics.armAngle(seed)).margin(1e-7));
    const auto near = kinematics.inverseNear(flange, seed);
    REQUIRE(near.hasValue());
    CHECK(kinematics.armAngle(*near) == Approx(kinematics.armAngle(seed)).margin(1e-7));
}

TEST_CASE("seven axes have singularities of shoulder and arm angle", "[robot][kinematics]") {
    const Kinematics kinematics(yumi());
    const Singularity zero = kinematics.singularity(Joints::zeros(7));
    CHECK(zero.shoulderDeg == 0);
    CHECK(zero.wristDeg == 0);
    CHECK(kinematics.singularity({0, -30, 0, 0, 40, 0, 0}).shoulderDeg == Approx(30));
    // Upper arm and forearm are in line with their skews when axis 3 is a quarter turn less these skews away.
    const double stretched =
        (std::atan2(40.5, 251.5) + std::atan2(40.5, 265.0)) * 180 / 3.14159265358979 - 90;
    CHECK(kinematics.singularity({0, -30, stretched, 0, 40, 0, 0}).elbowDeg == Approx(0).margin(1e-9));
    CHECK((kinematics.configuration({0, -30, stretched - 5, 0, 40, 0, 0}).cfx & 2) == 2);
    CHECK((kinematics.configuration({0, -30, stretched + 5, 0, 40, 0, 0}).cfx & 2) == 0);
}

TEST_CASE("upper arm and forearm may be parallel", "[robot][kinematics]") {
    const Kinematics kinematics(yumi());
    // Axis 3 at -90 and beyond: the forearm continues the direction of the upper arm.
    for (double axis1 : {-40.0, 25.0}) {
        Joints seed{axis1, -60, -80, 30, 50, 20, 30};
        for (double axis3 = -80; axis3 >= -100; axis3 -= 0.5) {
            const Joints joints{axis1, -60, axis3, 30, 50, 20, 30};
            Joints found;
            REQUIRE(kinematics.inverseContinue(kinematics.forward(joints), seed, found,
                                               kinematics.armAngle(joints)));
            for (std::size_t i = 0; i < 7; ++i)
                CHECK(found[i] == Approx(joints[i]).margin(1e-7));
            seed = found;
        }
    }
}
