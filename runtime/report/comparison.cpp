#include "runtime/report/comparison.h"

#include "runtime/robot/kinematics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace rt::report {
namespace {

constexpr double kNear = 1;           // mm: times are measured from there
constexpr double kWorthNaming = 1e-3; // s

/// Of the samples of a run, or of a recording.
template <class AnySample>
Track trackOf(const std::vector<AnySample>& samples, const robot::Kinematics& arm, bool atFlange) {
    Track track;
    for (const AnySample& sample : samples)
        track.push_back({sample.time, atFlange ? arm.forward(sample.joints).pos : sample.position, 0});
    return track;
}

/// A run begins with the TCP of tool0; the first movement brings its own. That change of tool does not belong to the path: what
/// comes before it gets the place after it.
template <class AnySample> void leaveOutFirstTool(Track& track, const std::vector<AnySample>& samples) {
    constexpr double kStill = 0.01; // deg: less than 1 mm at any reach
    std::size_t first = 0;
    const auto isStill = [&](std::size_t i) {
        for (std::size_t axis = 0; axis < samples[i].joints.size(); ++axis)
            if (std::fabs(samples[i].joints[axis] - samples[0].joints[axis]) > kStill) return false;
        return true;
    };
    for (std::size_t i = 1; i < track.size() && isStill(i); ++i)
        if (norm(track[i].position - track[i - 1].position) > kNear) first = i;
    for (std::size_t i = 0; i < first; ++i)
        track[i].position = track[first].position;
}

/// From the last moment within 1 mm of the start pose, before leaving it first, to the first from which on the arm stays
/// within 1 mm of the end pose.
struct Span {
    double from = 0, to = 0;
};
Span spanOf(const Track& track) {
    const auto crossing = [&](std::size_t in, std::size_t out, const robot::Vec3& pose) {
        const double d0 = norm(track[in].position - pose), d1 = norm(track[out].position - pose);
        const double share = d1 > d0 ? (kNear - d0) / (d1 - d0) : 0;
        return track[in].time + (track[out].time - track[in].time) * share;
    };
    const robot::Vec3 start = track.front().position, end = track.back().position;
    std::size_t leaves = 0, arrives = track.size() - 1;
    while (leaves + 1 < track.size() && norm(track[leaves].position - start) <= kNear)
        ++leaves;
    while (arrives > 0 && norm(track[arrives].position - end) <= kNear)
        --arrives;
    if (leaves == 0 || arrives + 1 >= track.size()) return {track.front().time, track.back().time};
    return {crossing(leaves - 1, leaves, start), crossing(arrives + 1, arrives, end)};
}

double distanceToSegment(const robot::Vec3& p, const robot::Vec3& a, const robot::Vec3& b) {
    const robot::Vec3 way = b - a;
    const double square = dot(way, way);
    const double share = square > 0 ? std::clamp(dot(p - a, way) / square, 0.0, 1.0) : 0;
    return norm(p - (a + way * share));
}

/// From a place to the part of a track within `window` of `way`.
double distanceToTrack(const Track& track, const robot::Vec3& place, double way, double window) {
    const std::size_t from = indexAtWay(track, way - window), to = indexAtWay(track, way + window);
    double nearest = norm(track[from].position - place);
    for (std::size_t i = from; i < to && i + 1 < track.size(); ++i)
        nearest = std::min(nearest, distanceToSegment(place, track[i].position, track[i + 1].position));
    if (to + 1 < track.size())
        nearest = std::min(nearest, distanceToSegment(place, track[to].position, track[to + 1].position));
    return nearest;
}

class Comparer {
  public:
    Comparer(const Analysis& analysis, Track here, Track there, Comparison& result)
        : analysis_(analysis), here_(std::move(here)), there_(std::move(there)),
          alignment_(align(here_, there_)), result_(result) {
        window_ = std::max(10.0, 4 * std::max(alignment_.spacingA, alignment_.spacingB));
    }

    void run() {
        const Span here = spanOf(here_), there = spanOf(there_);
        result_.here = here.to - here.from;
        result_.there = there.to - there.from;
        result_.offset = here.from - there.from;
        measureDistances(here, there);
        measureMoves();
        result_.track = there_;
        for (TrackPoint& point : result_.track)
            point.time += result_.offset;
    }

  private:
    /// Distances of the places of the run from the recording, and of the places of the recording that belong to them.
    std::vector<double> distances() const {
        constexpr double kFar = std::numeric_limits<double>::infinity();
        std::vector<double> nearest(alignment_.wayB.size(), kFar), farthest(alignment_.wayB.size(), 0);
        for (const Alignment::Pair& pair : alignment_.pairs) {
            const double wayHere = alignment_.spacingA * static_cast<double>(pair.a);
            const double wayThere = alignment_.spacingB * static_cast<double>(pair.b);
            nearest[pair.a] = std::min(
                nearest[pair.a], distanceToTrack(there_, positionAtWay(here_, wayHere), wayThere, window_));
            farthest[pair.a] = std::max(
                farthest[pair.a], distanceToTrack(here_, positionAtWay(there_, wayThere), wayHere, window_));
        }
        for (std::size_t i = 0; i < nearest.size(); ++i)
            nearest[i] = std::max(nearest[i], farthest[i]);
        return nearest;
    }

    /// Even along the path, so that times at rest do not count.
    void measureDistances(const Span& here, const Span& there) {
        std::vector<double> all = distances();
        for (std::size_t i = 0; i < all.size(); ++i) {
            const double way = alignment_.spacingA * static_cast<double>(i);
            PathPoint point;
            point.time = std::max(here.from, arrivalAt(here_, way));
            point.distance = all[i];
            point.delay = point.time - here.from -
                          (std::max(there.from, arrivalAt(there_, alignment_.wayB[i])) - there.from);
            if (point.distance > result_.worst || i == 0) {
                result_.worst = point.distance;
                result_.worstTime = point.time;
                result_.worstPlace = positionAtWay(here_, way);
                result_.worstMove = moveAt(point.time);
            }
            result_.points.push_back(point);
        }
        smoothDelays();
        std::sort(all.begin(), all.end());
        const auto share = [&all](double part) {
            return all[static_cast<std::size_t>(part * static_cast<double>(all.size() - 1))];
        };
        result_.median = share(0.5);
        result_.most = share(0.95);
    }

    /// Near a rest of the arm, a place just before it may be paired with one just after it: the median of five has no such peaks.
    void smoothDelays() {
        const std::vector<PathPoint> points = result_.points;
        for (std::size_t i = 2; i + 2 < points.size(); ++i) {
            std::array<double, 5> delays{};
            for (std::size_t k = 0; k < delays.size(); ++k)
                delays[k] = points[i + k - 2].delay;
            std::sort(delays.begin(), delays.end());
            result_.points[i].delay = delays[2];
        }
    }

    static double arrivalAt(const Track& track, double way) {
        const auto at = std::lower_bound(track.begin(), track.end(), way,
                                         [](const TrackPoint& point, double w) { return point.way < w; });
        if (at == track.begin()) return track.front().time;
        if (at == track.end()) return track.back().time;
        const TrackPoint& before = *(at - 1);
        const double share = std::clamp((way - before.way) / (at->way - before.way), 0.0, 1.0);
        return before.time + (at->time - before.time) * share;
    }

    const MoveResult* moveAt(double time) const {
        for (const MoveResult& move : analysis_.moves)
            if (time <= move.end) return &move;
        return analysis_.moves.empty() ? nullptr : &analysis_.moves.back();
    }

    /// The end of a movement is where the run changes to the next one; the recording passes there, or near to it.
    void measureMoves() {
        Passage here = passageAt(here_, here_.front().position, 0, kNear, kNear);
        Passage there = passageAt(there_, there_.front().position, 0, kNear, kNear);
        for (const MoveResult& move : analysis_.moves) {
            const TrackPoint& end = here_[move.last];
            const Passage endHere = passageAt(here_, end.position, end.way, kNear, kNear);
            const Passage endThere = passageAt(there_, end.position, alignment_.at(end.way), window_, kNear);
            const bool isLast = &move == &analysis_.moves.back();
            result_.differences.push_back(
                {&move, false, std::max(0.0, endHere.in - here.out), std::max(0.0, endThere.in - there.out)});
            if (!isLast)
                result_.differences.push_back(
                    {&move, true, endHere.out - endHere.in, endThere.out - endThere.in});
            here = endHere;
            there = endThere;
        }
    }

    const Analysis& analysis_;
    Track here_, there_;
    Alignment alignment_;
    double window_ = 0;
    Comparison& result_;
};

} // namespace

std::vector<TimeDifference> Comparison::largest(std::size_t number) const {
    std::vector<TimeDifference> result = differences;
    std::erase_if(result, [](const TimeDifference& d) { return std::fabs(d.difference()) < kWorthNaming; });
    std::sort(result.begin(), result.end(), [](const TimeDifference& a, const TimeDifference& b) {
        const double sizeA = std::fabs(a.difference()), sizeB = std::fabs(b.difference());
        return std::tie(sizeB, a.move, a.waiting) < std::tie(sizeA, b.move, b.waiting);
    });
    if (result.size() > number) result.resize(number);
    return result;
}

Comparison compare(const RobotRecord& record, const Analysis& analysis, const Recording& recording) {
    Comparison result;
    if (!record.hasArm) {
        result.problem = "external axes alone have no TCP that could be compared";
        return result;
    }
    result.atFlange = !recording.hasPositions;
    if (result.atFlange && record.robot.kinematics != robot::KinematicsKind::SphericalWrist) {
        result.problem =
            "the positions of this robot cannot be computed from axis angles; record x, y, z as well";
        return result;
    }
    const bool hasArm = record.robot.kinematics == robot::KinematicsKind::SphericalWrist;
    const robot::Kinematics arm = hasArm ? robot::Kinematics(record.robot) : robot::Kinematics();
    Track here = trackOf(record.samples, arm, result.atFlange);
    Track there = trackOf(recording.samples, arm, result.atFlange);
    leaveOutFirstTool(here, record.samples);
    if (recording.hasJoints) leaveOutFirstTool(there, recording.samples);
    measureWay(here);
    measureWay(there);
    if (here.size() < 2 || here.back().way < kNear || analysis.moves.empty())
        result.problem = "the TCP does not move in this run";
    else if (there.back().way < kNear)
        result.problem = "the TCP does not move in the recording";
    else
        Comparer(analysis, std::move(here), std::move(there), result).run();
    return result;
}

} // namespace rt::report
