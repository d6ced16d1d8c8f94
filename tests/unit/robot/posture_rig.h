#pragma once
// Models of the catalogue and random postures of them, for tests of kinematics.

#include "runtime/robot/kinematics.h"
#include "runtime/robot/robot_model.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace robot_testing {

using namespace robot;

inline RobotModel model(const char* name) {
    auto loaded = loadRobotModel(name);
    REQUIRE(loaded.hasValue());
    return *loaded;
}

/// Random postures inside the limits; a delta robot only with its elbows outward, the one posture it can be built in.
class Postures {
  public:
    explicit Postures(const RobotModel& robot, unsigned seed = 7)
        : model_(robot), kinematics_(robot), random_(seed) {}
    Joints next() {
        Joints joints = draw();
        while (kinematics_.jointOutsideLimits(joints) != 0) // the rods of palletizers
            joints = draw();
        return joints;
    }

  private:
    Joints draw() {
        Joints joints = Joints::zeros(model_.lowerDeg.size());
        for (std::size_t i = 0; i < joints.size(); ++i) {
            const bool isArm = model_.kinematics == KinematicsKind::Delta && i < 3;
            const double lower = isArm ? -20 : model_.lowerDeg[i];
            const double upper = isArm ? 60 : model_.upperDeg[i];
            joints[i] = std::uniform_real_distribution<double>(lower, upper)(random_);
        }
        return joints;
    }

    const RobotModel& model_;
    Kinematics kinematics_;
    std::mt19937_64 random_;
};

/// The largest difference of an axis, deg or mm.
inline double distance(const Joints& a, const Joints& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, std::fabs(a[i] - b[i]));
    return largest;
}

} // namespace robot_testing
