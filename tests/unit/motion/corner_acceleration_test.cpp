// Accelerations of the axes in corners (docs/motion.md, "The time").

#include "runtime/motion/motion_system.h"
#include "runtime/robot/dynamics.h"
#include "tests/unit/motion/motion_system_rig.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace motion_testing;

namespace {

constexpr double kSamplePeriod = 1e-3;

/// Two lines with a corner between them.
struct SharpCorner {
    double turn = 0;            ///< deg between the directions
    double tilt = 0;            ///< deg, of the plane of both lines
    double first = 0, last = 0; ///< mm
    double zone = 0;            ///< mm
    double speed = 0;           ///< mm/s
};

SharpCorner randomSharpCorner(std::mt19937_64& random) {
    return {between(random, 90, 150),  between(random, 0, 180), between(random, 100, 300),
            between(random, 100, 300), between(random, 5, 100), between(random, 200, 2000)};
}

/// The largest acceleration of an axis inside the corner, as a share of its limit in that pose.
struct Peak {
    double seconds = 0; ///< inside the corner
    double share = 0;
};

Peak peakInCorner(const SharpCorner& corner) {
    MotionSystem system(robot::loadRobotModel("IRB 6640-180/2.55").value());
    system.placeAt({{0, 10, 10, 0, 60, 0}, kNoExternalAxes});
    const double angle = corner.turn * M_PI / 180, tilt = corner.tilt * M_PI / 180;
    MoveCommand move = lineFrom(system, 0, corner.first, 0);
    move.speed.vTcp = corner.speed;
    const double zone = corner.zone;
    move.zone = {false, zone, 1.5 * zone, 1.5 * zone, 0.15 * zone, 1.5 * zone, 0.15 * zone};
    const Vec3 point = move.target.pose.pos;
    REQUIRE(system.enqueue(move));
    const double across = corner.last * std::sin(angle);
    move.target.pose = robot::offs(move.target.pose, -across * std::cos(tilt), corner.last * std::cos(angle),
                                   -across * std::sin(tilt));
    move.zone = {};
    REQUIRE(system.enqueue(move));
    // The corner's curve leaves and rejoins the lines at this distance from the point (manual 2.2.3).
    const double radius = std::min({corner.zone, 0.5 * corner.first, 0.5 * corner.last});
    const robot::AccelerationMap accelerations(system.model());
    std::array<MotionState, 3> last;
    last.fill(system.current());
    Peak peak;
    while (!system.isIdle() || system.isMoving()) {
        system.advanceTo(system.now() + kMs);
        std::rotate(last.begin(), last.begin() + 1, last.end());
        last[2] = system.current();
        if (norm(last[1].tcp.pos - point) > radius) continue;
        peak.seconds += kSamplePeriod;
        Joints most = last[1].joints;
        accelerations.limitsAt(last[1].joints, most);
        for (std::size_t i = 0; i < most.size(); ++i) {
            const double change = last[2].joints[i] - 2 * last[1].joints[i] + last[0].joints[i];
            peak.share = std::max(peak.share, std::abs(change) / (kSamplePeriod * kSamplePeriod * most[i]));
        }
    }
    return peak;
}

} // namespace

TEST_CASE("in corners of 90 to 150 degrees the axes accelerate at most 3 times their limits",
          "[motion][limits]") {
    // Rule of decision 127: from 90 degrees on a corner is slower than the average in time makes it, so that the
    // accelerations of axes stay below 3 times the limit of the pose, as where the path turns back on itself (decision 138).
    // In a zone that takes dt they may exceed that by the factor 1 + 0.02 s / dt of the recordings.
    std::mt19937_64 random(25);
    for (int n = 0; n < 200; ++n) {
        const SharpCorner corner = randomSharpCorner(random);
        const Peak peak = peakInCorner(corner);
        CAPTURE(n, corner.turn, corner.tilt, corner.first, corner.last, corner.zone, corner.speed,
                peak.seconds);
        CHECK(peak.share <= 3 * (1 + 0.02 / peak.seconds));
    }
}
