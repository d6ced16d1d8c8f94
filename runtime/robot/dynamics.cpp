#include "runtime/robot/dynamics.h"

#include "runtime/robot/angles.h"
#include "runtime/robot/robot_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace robot {

namespace {

/// Seconds from rest to full speed, of the small and the large robot that were measured.
struct RiseTime {
    double small, large;
    double at(double share) const { return small + (large - small) * share; }
};

constexpr double kSmallReach = 0.9; // m
constexpr double kLargeReach = 2.55;
constexpr RiseTime kFirstFolded{0.07, 0.17}, kFirstStretched{0.21, 0.56};
constexpr RiseTime kSecondFolded{0.09, 0.18}, kSecondStretched{0.26, 0.39};
constexpr RiseTime kThird{0.08, 0.15};
constexpr RiseTime kWrist[] = {{0.103, 0.13}, {0.078, 0.11}, {0.109, 0.11}, {0.109, 0.11}};

double square(double x) {
    return x * x;
}

} // namespace

Dynamics estimatedDynamics(const RobotModel& model) {
    Dynamics result;
    const double share = std::clamp((model.reachM - kSmallReach) / (kLargeReach - kSmallReach), -0.25, 1.5);
    const OpwParameters& g = model.geometry;
    const double elbow = 0.001 * (g.a1 + g.c2);
    const double wrist = elbow + 0.001 * std::hypot(g.a2, g.c3);
    const double reach = 0.001 * (g.c2 + std::hypot(g.a2, g.c3));
    const auto speed = [&](std::size_t axis) { return model.maxSpeed[axis] * kDeg; };
    const auto falling = [](double folded, double stretched) {
        AccelerationLimit limit;
        limit.cap = folded;
        limit.base = 1 / folded;
        // The share of stretching: what the inertia gains from folded to stretched.
        limit.reach = 1 / stretched - 1 / folded;
        return limit;
    };
    AccelerationLimit first =
        falling(speed(0) / kFirstFolded.at(share), speed(0) / kFirstStretched.at(share));
    // Elbow and wrist share the gain in the proportion identified on the measured robots.
    constexpr double kElbowShare = 0.0623, kWristShare = 0.0189;
    const double sum = kElbowShare * square(elbow) + kWristShare * square(wrist);
    first.elbow = sum > 0 ? first.reach * kElbowShare / sum : 0;
    first.wrist = sum > 0 ? first.reach * kWristShare / sum : 0;
    first.reach = 0;
    AccelerationLimit second =
        falling(speed(1) / kSecondFolded.at(share), speed(1) / kSecondStretched.at(share));
    second.reach = reach > 0 ? second.reach / square(reach) : 0;
    result.axes[0] = first;
    result.axes[1] = second;
    const std::size_t count = model.maxSpeed.size();
    if (count > 2) result.axes[2].cap = speed(2) / kThird.at(share);
    for (std::size_t i = 3; i < count; ++i)
        result.axes[i].cap = speed(i) / kWrist[i - 3].at(std::clamp(share, 0.0, 1.0));
    // No recording of a small robot alone is known; shorter windows in proportion to its size are assumed.
    result.longWindow = 0.108 - 0.0247 * (kLargeReach - std::clamp(model.reachM, 0.4, kLargeReach));
    result.shortWindow = result.longWindow * 0.048 / 0.108;
    return result;
}

AccelerationMap::AccelerationMap(const RobotModel& model)
    : dynamics_(model.dynamics), a1_(0.001 * model.geometry.a1), a2_(0.001 * model.geometry.a2),
      c2_(0.001 * model.geometry.c2), c3_(0.001 * model.geometry.c3) {}

AccelerationMap::Arm AccelerationMap::armAt(double axis2, double axis3) const {
    const double q2 = axis2 * kDeg;
    const double q23 = (axis2 + axis3) * kDeg;
    const double sine = std::sin(q23);
    const double cosine = std::cos(q23);
    const double elbow = a1_ + c2_ * std::sin(q2);
    const double wrist = elbow - a2_ * sine + c3_ * cosine;
    const double height = c2_ * std::cos(q2) - a2_ * cosine - c3_ * sine;
    return {square(elbow), square(wrist), square(wrist - a1_) + square(height)};
}

} // namespace robot
