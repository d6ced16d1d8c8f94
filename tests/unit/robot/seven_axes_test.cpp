// The arm with seven axes against RobotStudio: joints, flange and arm angle of ten postures as the test data of
// rpiRobotics/yumi-ik (compare_to_robotstudio.m) record them, rounded to hundredths there.

#include "runtime/robot/kinematics.h"
#include "runtime/robot/robot_model.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

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

namespace {

/// Targets of programs published for the IRB 14000, in tool0 and world. They show how ABB counts: the arm angle from world y
/// (on the left arm from -y), cf1, cf4 and cf6 in the nearest quarter, cfx 4 for axis 2 below 0 and 5 for axis 5 below 0, too.
struct Programmed {
    Pose tcp;
    ConfData conf;
    double armAngle;
};
const Programmed kRightHome = {
    {{-9.578368507, -182.609892723, 198.627808149}, {0.066010726, -0.842420918, -0.111214912, -0.523068661}},
    {0, 0, 0, 4},
    -101.964427132};
const Programmed kLeftHome = {
    {{-9.578368507, 182.609892723, 198.627808149}, {0.066010726, 0.842420918, -0.111214912, 0.523068661}},
    {0, 0, 0, 4},
    101.964427132};
const Programmed kOnRight[] = {
    {{{392.730652263, -203.618347541, 231.446357113}, {0.707106023, -0.707107539, 0, 0}},
     {1, -1, 2, 4},
     -120.93495026},
    {{{248.277963535, 198.887339769, 218.840343011}, {0.707106378, -0.707107184, 0, 0}},
     {2, 1, 0, 4},
     129.272916704},
    {{{399.619288661, 197.139901275, 231.4464029}, {0.707105918, -0.707107645, 0, 0}},
     {2, -1, 2, 4},
     -87.032967033},
    {{{406.101117022, -203.61817432, 231.446744669}, {0.70710606, -0.707107503, 0, 0}},
     {1, -1, 2, 4},
     -87.032967033},
    {{{399.059788774, 198.886850444, 215.299873739}, {0.707106042, -0.70710752, 0, 0}},
     {2, -1, 2, 4},
     -123.275938492},
    {{{248.278007928, 198.886990611, 215.299982769}, {0.707106103, -0.707107459, 0, 0}},
     {1, -1, 2, 4},
     -123.275939736}};

RobotModel armOf14000(const char* name) {
    auto loaded = loadRobotModel(name);
    REQUIRE(loaded.hasValue());
    return *loaded;
}

} // namespace

TEST_CASE("both arms of the IRB 14000 stand at the home target of their programs", "[robot][kinematics]") {
    for (const auto& [name, home, axis7] : {std::tuple{"IRB 14000-0.5/0.559-R", kRightHome, -135.0},
                                            std::tuple{"IRB 14000-0.5/0.559-L", kLeftHome, 135.0}}) {
        CAPTURE(name);
        const RobotModel model = armOf14000(name);
        const Kinematics kinematics(model);
        const Joints joints{0, -130, 30, 0, 40, 0, axis7};
        CHECK(model.home == joints);
        const Pose tcp = model.baseFrame * kinematics.forward(joints);
        CHECK(norm(tcp.pos - home.tcp.pos) < 0.002);
        CHECK(angleBetween(tcp.rot, normalized(home.tcp.rot)) < 1e-4);
        CHECK(kinematics.armAngle(joints) == Approx(home.armAngle).margin(1e-4));
        CHECK(kinematics.configuration(joints) == home.conf);
    }
}

TEST_CASE("targets of programs for the IRB 14000 have the configuration that they name",
          "[robot][kinematics]") {
    const RobotModel model = armOf14000("IRB 14000-0.5/0.559-R");
    const Kinematics kinematics(model);
    for (const Programmed& target : kOnRight) {
        CAPTURE(target.tcp.pos.x, target.armAngle);
        const Pose flange = inverse(model.baseFrame) * Pose{target.tcp.pos, normalized(target.tcp.rot)};
        const auto joints = kinematics.inverse(flange, target.conf, model.home, target.armAngle);
        REQUIRE(joints.hasValue());
        CHECK(kinematics.configuration(*joints) == target.conf);
        CHECK(kinematics.jointOutsideLimits(*joints) == 0);
    }
}

TEST_CASE("a hundred thousand postures of seven axes come back from pose, configuration and arm angle",
          "[robot][kinematics][slow]") {
#ifdef RAPIDC_SANITIZE
    constexpr int kPostures = 5000; // the sanitizers make each one slow
#else
    constexpr int kPostures = 100000;
#endif
    const RobotModel model = yumi();
    const Kinematics kinematics(model);
    std::mt19937_64 random(11);
    int regular = 0;
    int lost = 0;
    int missed = 0; // without a hint where the solution lies
    double worst = 0;
    for (int n = 0; n < kPostures; ++n) {
        Joints joints = Joints::zeros(7);
        Joints elsewhere = joints;
        for (std::size_t i = 0; i < 7; ++i) {
            std::uniform_real_distribution<double> range(model.lowerDeg[i], model.upperDeg[i]);
            joints[i] = range(random);
            elsewhere[i] = range(random);
        }
        const Singularity near = kinematics.singularity(joints);
        if (std::min({near.wristDeg, near.elbowDeg, near.shoulderDeg, near.armAngleDeg}) < 1 ||
            near.foldDeg < 0.2)
            continue;
        ++regular;
        const Pose flange = kinematics.forward(joints);
        const double armAngle = kinematics.armAngle(joints);
        const auto back = kinematics.inverse(flange, kinematics.configuration(joints), joints, armAngle);
        if (!back) {
            ++lost;
            continue;
        }
        for (std::size_t i = 0; i < 7; ++i)
            worst = std::max(worst, std::fabs((*back)[i] - joints[i]));
        if (n % 3 != 0 && n != 23218 && n != 71275)
            continue; // those two lie beside two singularities at once
        IkBranches branches;
        kinematics.inverseAll(flange, elsewhere, branches, armAngle);
        double nearest = 360;
        for (int k = 0; k < static_cast<int>(kMostBranches); ++k) {
            if (!branches.has(k)) continue;
            double largest = 0;
            for (std::size_t i = 0; i < 7; ++i)
                largest = std::max(largest,
                                   std::fabs(std::remainder(
                                       branches.joints[static_cast<std::size_t>(k)][i] - joints[i], 360.0)));
            nearest = std::min(nearest, largest);
        }
        if (nearest > 1e-6) ++missed;
    }
    CHECK(regular > kPostures * 9 / 10);
    CHECK(lost == 0);
    CHECK(worst < 1e-6);
    CHECK(missed == 0);
}
