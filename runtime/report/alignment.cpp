#include "runtime/report/alignment.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rt::report {
namespace {

constexpr double kTremble = 0.2;          // mm
constexpr double kSpacing = 2;            // mm between places, at least
constexpr std::size_t kMostPlaces = 3000; // of one track

enum Step : uint8_t { kBoth, kOnlyA, kOnlyB };

std::vector<robot::Vec3> evenPlaces(const Track& track, double& spacing) {
    const double length = track.back().way;
    const auto parts =
        static_cast<std::size_t>(std::clamp(std::ceil(length / kSpacing), 1.0, kMostPlaces - 1.0));
    spacing = length / static_cast<double>(parts);
    std::vector<robot::Vec3> places;
    for (std::size_t i = 0; i <= parts; ++i)
        places.push_back(positionAtWay(track, spacing * static_cast<double>(i)));
    return places;
}

/// For each pair of places the step that leads to it on the best pairing.
std::vector<Step> bestSteps(const std::vector<robot::Vec3>& a, const std::vector<robot::Vec3>& b) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    std::vector<Step> steps(a.size() * b.size(), kBoth);
    std::vector<double> before(b.size(), kFar), row(b.size(), kFar);
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < b.size(); ++j) {
            double least = i == 0 && j == 0 ? 0 : kFar;
            Step step = kBoth;
            if (i > 0 && j > 0) least = before[j - 1];
            if (i > 0 && before[j] < least) {
                least = before[j];
                step = kOnlyA;
            }
            if (j > 0 && row[j - 1] < least) {
                least = row[j - 1];
                step = kOnlyB;
            }
            row[j] = least + norm(a[i] - b[j]);
            steps[i * b.size() + j] = step;
        }
        std::swap(before, row);
    }
    return steps;
}

} // namespace

void measureWay(Track& track) {
    double way = 0;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < track.size(); ++i) {
        const double step = norm(track[i].position - track[kept].position);
        if (step > kTremble) {
            way += step;
            kept = i;
        }
        track[i].way = way;
    }
}

std::size_t indexAtWay(const Track& track, double way) {
    const auto after = std::upper_bound(track.begin(), track.end(), way,
                                        [](double w, const TrackPoint& point) { return w < point.way; });
    return after == track.begin() ? 0 : static_cast<std::size_t>(after - track.begin()) - 1;
}

robot::Vec3 positionAtWay(const Track& track, double way) {
    const std::size_t i = indexAtWay(track, way);
    if (i + 1 >= track.size()) return track.back().position;
    const TrackPoint &a = track[i], &b = track[i + 1];
    const double share = b.way > a.way ? std::clamp((way - a.way) / (b.way - a.way), 0.0, 1.0) : 0;
    return a.position + (b.position - a.position) * share;
}

double Alignment::at(double wayA) const {
    if (wayB.empty() || spacingA <= 0) return 0;
    const double place = std::clamp(wayA / spacingA, 0.0, static_cast<double>(wayB.size() - 1));
    const auto i = std::min(static_cast<std::size_t>(place), wayB.size() - 1);
    const std::size_t next = std::min(i + 1, wayB.size() - 1);
    return wayB[i] + (wayB[next] - wayB[i]) * (place - static_cast<double>(i));
}

Alignment align(const Track& a, const Track& b) {
    Alignment result;
    const std::vector<robot::Vec3> placesA = evenPlaces(a, result.spacingA);
    const std::vector<robot::Vec3> placesB = evenPlaces(b, result.spacingB);
    const std::vector<Step> steps = bestSteps(placesA, placesB);
    std::vector<double> sum(placesA.size(), 0), count(placesA.size(), 0);
    std::size_t i = placesA.size() - 1, j = placesB.size() - 1;
    for (;;) { // several places of B may belong to one of A: their mean
        sum[i] += result.spacingB * static_cast<double>(j);
        count[i] += 1;
        result.pairs.push_back({i, j});
        if (i == 0 && j == 0) break;
        const Step step = steps[i * placesB.size() + j];
        if (step != kOnlyB && i > 0) --i;
        if (step != kOnlyA && j > 0) --j;
    }
    for (std::size_t k = 0; k < sum.size(); ++k)
        result.wayB.push_back(sum[k] / count[k]);
    return result;
}

Passage passageAt(const Track& track, const robot::Vec3& place, double way, double window, double radius) {
    std::size_t from = indexAtWay(track, way - window), to = indexAtWay(track, way + window);
    while (from > 0 && track[from - 1].way == track[from].way)
        --from; // all the time that the arm stands there
    Passage passage;
    passage.distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = from; i <= to && i < track.size(); ++i) {
        const double distance = norm(track[i].position - place);
        if (distance < passage.distance) {
            passage.distance = distance;
            passage.index = i;
        }
    }
    const double limit =
        std::hypot(passage.distance, radius); // `radius` along a track that passes beside the place
    // Between two samples the distance is taken as a straight line.
    const auto crossing = [&](std::size_t inside, std::size_t outside) {
        const double d0 = norm(track[inside].position - place), d1 = norm(track[outside].position - place);
        const double share = d1 > d0 ? std::clamp((limit - d0) / (d1 - d0), 0.0, 1.0) : 0;
        return track[inside].time + (track[outside].time - track[inside].time) * share;
    };
    std::size_t first = passage.index, last = passage.index;
    while (first > 0 && norm(track[first - 1].position - place) <= limit)
        --first;
    while (last + 1 < track.size() && norm(track[last + 1].position - place) <= limit)
        ++last;
    passage.in = first > 0 ? crossing(first, first - 1) : track[first].time;
    passage.out = last + 1 < track.size() ? crossing(last, last + 1) : track[last].time;
    return passage;
}

} // namespace rt::report
