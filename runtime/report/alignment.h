#pragma once
// Two tracks of one path brought together: which place of one belongs to which of the other, whatever their times.

#include "runtime/robot/frames.h"

#include <cstddef>
#include <vector>

namespace rt::report {

struct TrackPoint {
    double time = 0;      ///< s
    robot::Vec3 position; ///< mm
    double way = 0;       ///< mm of path since the start; trembling of an arm at rest does not count
};
using Track = std::vector<TrackPoint>;

/// Fills in TrackPoint::way.
void measureWay(Track& track);

/// Index of the last point whose way is not beyond `way`.
std::size_t indexAtWay(const Track& track, double way);
robot::Vec3 positionAtWay(const Track& track, double way);

/// The place of one track for places of the other that lie evenly along its path.
struct Alignment {
    double spacingA = 0, spacingB = 0; ///< mm between the places
    std::vector<double> wayB;          ///< in B, for place i * spacingA in A; never goes back
    struct Pair {
        std::size_t a = 0, b = 0; ///< places at a * spacingA, b * spacingB
    };
    std::vector<Pair> pairs; ///< from the end to the start; each place of either track is in one at least

    /// In B, for any place in A.
    double at(double wayA) const;
};

/// The pairing with the least sum of distances in which neither track goes back (dynamic time warping).
Alignment align(const Track& a, const Track& b);

/// When a track passes a place: from `radius` before its nearest point to `radius` after it, near `way` on its path.
struct Passage {
    double in = 0, out = 0; ///< s
    double distance = 0;    ///< mm at the nearest
    std::size_t index = 0;  ///< of the nearest point
};
Passage passageAt(const Track& track, const robot::Vec3& place, double way, double window, double radius);

} // namespace rt::report
