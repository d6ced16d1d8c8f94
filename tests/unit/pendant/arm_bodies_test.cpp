#include "tools/pendant/arm_bodies.h"

#include "runtime/robot/kinematics.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace rapidc::pendant;

namespace {

robot::Joints randomJoints(const robot::Kinematics& kinematics, std::mt19937& random) {
    robot::Joints joints = robot::Joints::zeros(kinematics.jointCount());
    for (std::size_t i = 0; i < joints.size(); ++i)
        joints[i] = std::uniform_real_distribution<double>(kinematics.lowerDeg()[i],
                                                           kinematics.upperDeg()[i])(random);
    return joints;
}

} // namespace

TEST_CASE(
    "pendant: the bodies of every robot end where its kinematics have the flange (docs/pendant.md, Units)",
    "[pendant]") {
    std::mt19937 random(7);
    for (const std::string& name : robot::robotModelNames()) {
        const auto model = robot::loadRobotModel(name);
        REQUIRE(model.hasValue());
        const robot::Kinematics kinematics(*model);
        const std::vector<Body> bodies = bodiesOf(*model);
        REQUIRE(!bodies.empty());
        REQUIRE(bodies.back().name == "flange");
        for (int n = 0; n < 20; ++n) {
            const robot::Joints joints = randomJoints(kinematics, random);
            const robot::Pose wanted = kinematics.forward(joints);
            const robot::Pose pose = posesOf(bodies, joints, wanted).back();
            INFO(name << ", posture " << n);
            CHECK(norm(pose.pos - wanted.pos) < 1e-3); // mm
            CHECK(robot::angleBetween(pose.rot, wanted.rot) < 1e-3);
        }
    }
}

TEST_CASE(
    "pendant: bodies refer to earlier bodies and existing joints, and something can be seen of each robot",
    "[pendant]") {
    for (const std::string& name : robot::robotModelNames()) {
        const auto model = robot::loadRobotModel(name);
        REQUIRE(model.hasValue());
        const auto count = static_cast<int>(robot::Kinematics(*model).jointCount());
        const std::vector<Body> bodies = bodiesOf(*model);
        std::size_t solids = 0;
        INFO(name);
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            CHECK(bodies[i].parent < static_cast<int>(i));
            CHECK(std::fabs(norm(bodies[i].axis) - 1) < 1e-9);
            for (const auto& [joint, factor] : bodies[i].terms)
                CHECK((joint >= 0 && joint < count));
            for (const Solid& solid : bodies[i].solids) {
                CHECK(solid.radius > 0);
                CHECK((solid.kind != Solid::Kind::Rod ||
                       (solid.toBody >= 0 && solid.toBody < static_cast<int>(bodies.size()))));
            }
            solids += bodies[i].solids.size();
        }
        CHECK(solids >= 5);
    }
}

TEST_CASE("pendant: the rods of a delta robot have their length", "[pendant]") {
    int deltas = 0;
    for (const std::string& name : robot::robotModelNames()) {
        const auto model = robot::loadRobotModel(name);
        REQUIRE(model.hasValue());
        if (model->kinematics != robot::KinematicsKind::Delta) continue;
        ++deltas;
        const std::vector<Body> bodies = bodiesOf(*model);
        const robot::Joints joints{10, 20, 5,
                                   30}; // the platform is beside the centre line, and the flange turned
        const auto poses = posesOf(bodies, joints, robot::Kinematics(*model).forward(joints));
        for (std::size_t i = 0; i < bodies.size(); ++i)
            for (const Solid& solid : bodies[i].solids) {
                if (solid.kind != Solid::Kind::Rod) continue;
                const auto end = static_cast<std::size_t>(solid.toBody);
                const double length = norm(apply(poses[end], solid.to) - apply(poses[i], solid.from));
                INFO(name << ", body " << i);
                CHECK(std::fabs(length - model->delta.rod) < 1e-6);
            }
    }
    CHECK(deltas > 0);
}

TEST_CASE("pendant: a model without an arm has no bodies", "[pendant]") {
    CHECK(bodiesOf(robot::armlessModel()).empty());
}
