// Circles that two axes of the wrist run (CirPathMode \Wrist45, \Wrist46, \Wrist56, manual 1.7): all other axes stand still, and
// the z axis of the tool meets the plane of the circle on the circle. The TCP leaves the plane by what the tilt of the tool
// makes of it, so the sheet has to be thin and the circle small.

#include "runtime/motion/path.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace motion {

namespace {

constexpr double kMostTilt = 60;   // deg, of the tool against the normal of the plane
constexpr double kSolved = 1e-10;  // mm
constexpr double kStep = 1e-3;     // deg, of the difference quotients
constexpr double kLargestTurn = 5; // deg in one step of the search

} // namespace

std::optional<MotionError> MotionPath::takeWristAxes(CircleOrientation orientation) {
    constexpr std::size_t kWithWrist = 6;
    MotionError error;
    if (!frames_.tool.robotHeld) {
        error.what = "a circle by the wrist with a tool that the robot does not hold";
        return error;
    }
    if (kinematics_.jointCount() != kWithWrist) {
        error.what = "a circle by two of the axes 4, 5 and 6 with an arm of this number of axes";
        error.value = static_cast<double>(kinematics_.jointCount());
        return error;
    }
    const Vec3 tool =
        rotate(frames_.fromFlange(kinematics_.forward(start_.robax), start_.extax).rot, {0, 0, 1});
    const double tilt =
        std::atan2(norm(cross(tool, curve_.axis())), dot(tool, curve_.axis())) * 180 / std::numbers::pi;
    if (!(std::min(tilt, 180 - tilt) < kMostTilt)) {
        error.what = "a circle by the wrist in a plane that the tool is tilted against by this many degrees";
        error.value = std::min(tilt, 180 - tilt);
        return error;
    }
    const std::size_t first = orientation == CircleOrientation::Wrist56 ? 4 : 3;
    const std::size_t second = orientation == CircleOrientation::Wrist45 ? 4 : 5;
    wristAxes_ = {first, second};
    isByWrist_ = true;
    return {};
}

/// mm in the plane of the circle from `goal` to where the z axis of the tool meets it. False when it is too flat.
bool MotionPath::missByWrist(const Joints& joints, const ExternalAxes& axes, const Vec3& goal,
                             double (&miss)[2]) const {
    const Pose tcp = frames_.fromFlange(kinematics_.forward(joints), axes);
    const Vec3 tool = rotate(tcp.rot, {0, 0, 1});
    const Vec3 normal = curve_.axis();
    const double cosine = dot(normal, tool);
    static const double kLeastCosine = std::cos(kMostTilt * std::numbers::pi / 180);
    if (!(std::fabs(cosine) >= kLeastCosine)) return false;
    const Vec3 met = tcp.pos + tool * (dot(normal, curve_.centre() - tcp.pos) / cosine);
    const Vec3 spoke = curve_.at(0).pos - curve_.centre();
    const Vec3 across = spoke * (1 / norm(spoke));
    miss[0] = dot(met - goal, across);
    miss[1] = dot(met - goal, cross(normal, across));
    return std::isfinite(miss[0] + miss[1]);
}

bool MotionPath::solveByWrist(double s, const Joints& seed, Joints& out) const {
    out = start_.robax;
    for (const std::size_t axis : wristAxes_)
        out[axis] = seed[axis];
    const Vec3 goal = curve_.at(s).pos;
    double miss[2];
    if (!missByWrist(out, externalAt(s), goal, miss)) return false;
    for (int n = 0; n < 30; ++n) {
        double slope[2][2]; // of the miss by the axes
        for (std::size_t k = 0; k < 2; ++k) {
            Joints low = out;
            Joints high = out;
            low[wristAxes_[k]] -= kStep;
            high[wristAxes_[k]] += kStep;
            double before[2];
            double after[2];
            if (!missByWrist(low, externalAt(s), goal, before) ||
                !missByWrist(high, externalAt(s), goal, after))
                return false;
            for (std::size_t row = 0; row < 2; ++row)
                slope[row][k] = (after[row] - before[row]) / (2 * kStep);
        }
        const double determinant = slope[0][0] * slope[1][1] - slope[0][1] * slope[1][0];
        if (!(std::fabs(determinant) > 1e-9)) return false;
        const double turn[2] = {(slope[1][1] * miss[0] - slope[0][1] * miss[1]) / determinant,
                                (slope[0][0] * miss[1] - slope[1][0] * miss[0]) / determinant};
        const double largest = std::max(std::fabs(turn[0]), std::fabs(turn[1]));
        if (!std::isfinite(largest)) return false;
        const double share = largest > kLargestTurn ? kLargestTurn / largest : 1;
        for (std::size_t k = 0; k < 2; ++k)
            out[wristAxes_[k]] -= share * turn[k];
        const double size = std::hypot(miss[0], miss[1]);
        if (!missByWrist(out, externalAt(s), goal, miss)) return false;
        const double now = std::hypot(miss[0], miss[1]);
        if (now < kSolved || (now < 1e-7 && now > 0.5 * size)) return true; // the rest is rounding
    }
    return false;
}

/// The orientation is not the programmed one, so the axes are not those of the target: each configuration axis may be in the
/// neighbouring quarter.
std::optional<MotionError> MotionPath::checkWristArrival(const MoveCommand& command) const {
    const ConfData here = kinematics_.configuration(end_.robax);
    const ConfData& wanted = command.target.conf;
    int joint = 0;
    if (std::abs(here.cf6 - wanted.cf6) > 1) joint = 6;
    if (std::abs(here.cf4 - wanted.cf4) > 1) joint = 4;
    if (std::abs(here.cf1 - wanted.cf1) > 1) joint = 1;
    if (joint == 0 && here.cfx == wanted.cfx) return {};
    return errorAt(MotionErrorKind::ConfigurationMismatch, 1, joint,
                   joint == 0 ? 0 : end_.robax[static_cast<std::size_t>(joint) - 1]);
}

} // namespace motion
