#include "runtime/report/alignment.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rt::report {
namespace {

constexpr double kTremble = 0.2;          // mm
constexpr double kSpacing = 2;            // mm between places, at least
constexpr std::size_t kMostCoarse = 2000; // places of one track, where each may belong to each
constexpr std::size_t kMostFine = 100000; // where only those near the coarse pairing may

enum Pairing : uint8_t { kBoth, kOnlyA, kOnlyB };

using Places = std::vector<robot::Vec3>;

Places evenPlaces(const Track& track, std::size_t most, double& spacing) {
    const double length = track.back().way;
    const double parts = std::clamp(std::ceil(length / kSpacing), 1.0, static_cast<double>(most - 1));
    spacing = length / parts;
    Places places;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(parts); ++i)
        places.push_back(positionAtWay(track, spacing * static_cast<double>(i)));
    return places;
}

/// The places of B that each place of A may belong to, from the first to the last; neither goes back from place to place.
struct Band {
    std::vector<std::size_t> first, last;

    static Band everything(std::size_t a, std::size_t b) {
        return {std::vector<std::size_t>(a, 0), std::vector<std::size_t>(a, b - 1)};
    }
    /// Within one coarse place of a coarse pairing.
    static Band around(const Alignment& coarse, std::size_t a, double spacingA, std::size_t b,
                       double spacingB) {
        Band band{std::vector<std::size_t>(a, b), std::vector<std::size_t>(a, 0)};
        const auto place = [](double way, double spacing, std::size_t count) {
            const double at =
                spacing > 0 ? std::clamp(way / spacing, 0.0, static_cast<double>(count - 1)) : 0;
            return static_cast<std::size_t>(std::lround(at));
        };
        for (const Alignment::Pair& pair : coarse.pairs) {
            const auto wayA = static_cast<double>(pair.a), wayB = static_cast<double>(pair.b);
            const std::size_t from = place((wayB - 1) * coarse.spacingB, spacingB, b);
            const std::size_t to = place((wayB + 1) * coarse.spacingB, spacingB, b);
            const std::size_t end = place((wayA + 1) * coarse.spacingA, spacingA, a);
            for (std::size_t i = place((wayA - 1) * coarse.spacingA, spacingA, a); i <= end; ++i) {
                band.first[i] = std::min(band.first[i], from);
                band.last[i] = std::max(band.last[i], to);
            }
        }
        return band;
    }
    std::size_t width(std::size_t i) const { return last[i] - first[i] + 1; }
};

/// The pairing within the band, from the end to the start.
std::vector<Alignment::Pair> bestPairs(const Places& a, const Places& b, const Band& band) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    std::vector<std::vector<Pairing>> steps(a.size()); // to each pair
    std::vector<double> before, row;
    const auto sumBefore = [&](std::size_t i, std::size_t j) {
        const bool inside = i > 0 && j >= band.first[i - 1] && j <= band.last[i - 1];
        return inside ? before[j - band.first[i - 1]] : kFar;
    };
    for (std::size_t i = 0; i < a.size(); ++i) {
        row.assign(band.width(i), kFar);
        steps[i].assign(band.width(i), kBoth);
        for (std::size_t j = band.first[i]; j <= band.last[i]; ++j) {
            const std::size_t k = j - band.first[i];
            const double both = j > 0 ? sumBefore(i, j - 1) : kFar, onlyA = sumBefore(i, j);
            const double onlyB = k > 0 ? row[k - 1] : kFar;
            const double least = i == 0 && j == 0 ? 0 : std::min({both, onlyA, onlyB});
            if (least < both || i == 0 || j == 0) steps[i][k] = least == onlyA ? kOnlyA : kOnlyB;
            row[k] = least + norm(a[i] - b[j]);
        }
        std::swap(before, row);
    }
    std::vector<Alignment::Pair> pairs{{a.size() - 1, b.size() - 1}};
    while (pairs.back().a > 0 || pairs.back().b > 0) {
        auto [i, j] = pairs.back();
        const Pairing step = steps[i][j - band.first[i]];
        if (step != kOnlyB && i > 0) --i;
        if (step != kOnlyA && j > 0) --j;
        if (i == pairs.back().a && j == pairs.back().b) break;
        pairs.push_back({i, j});
    }
    return pairs;
}

Alignment alignmentOf(std::vector<Alignment::Pair> pairs, double spacingA, double spacingB) {
    Alignment result{spacingA, spacingB, {}, std::move(pairs)};
    const std::size_t places = result.pairs.front().a + 1;
    std::vector<double> count(places, 0);
    result.wayB.assign(places, 0);
    for (const Alignment::Pair& pair :
         result.pairs) { // several places of B may belong to one of A: their mean
        result.wayB[pair.a] += spacingB * static_cast<double>(pair.b);
        count[pair.a] += 1;
    }
    for (std::size_t i = 0; i < places; ++i)
        if (count[i] > 0) result.wayB[i] /= count[i];
    return result;
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
    double spacingA = 0, spacingB = 0;
    Places placesA = evenPlaces(a, kMostCoarse, spacingA), placesB = evenPlaces(b, kMostCoarse, spacingB);
    Alignment coarse = alignmentOf(
        bestPairs(placesA, placesB, Band::everything(placesA.size(), placesB.size())), spacingA, spacingB);
    if (placesA.size() < kMostCoarse && placesB.size() < kMostCoarse) return coarse;
    placesA = evenPlaces(a, kMostFine, spacingA);
    placesB = evenPlaces(b, kMostFine, spacingB);
    const Band band = Band::around(coarse, placesA.size(), spacingA, placesB.size(), spacingB);
    return alignmentOf(bestPairs(placesA, placesB, band), spacingA, spacingB);
}

Passage passageAt(const Track& track, const robot::Vec3& place, double way, double window, double radius) {
    std::size_t from = indexAtWay(track, way - window), to = indexAtWay(track, way + window);
    while (from > 0 && track[from - 1].way == track[from].way)
        --from; // all the time that the arm rests there
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
