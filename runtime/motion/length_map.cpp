#include "runtime/motion/length_map.h"

#include <algorithm>
#include <cmath>

namespace motion {

LengthMap LengthMap::even(double length) {
    LengthMap map;
    map.length_ = length;
    return map;
}

namespace {

/// Derivatives of the rates by the parameter, from their values at nodes and between them.
std::vector<double> bendsOf(const std::vector<double>& rates, const std::vector<double>& middles,
                            double least) {
    const std::size_t count = middles.size();
    const auto inverseStep = static_cast<double>(count);
    std::vector<double> bends(count + 1);
    bends[0] = (4 * middles[0] - 3 * rates[0] - rates[1]) * inverseStep;
    bends[count] = (3 * rates[count] + rates[count - 1] - 4 * middles[count - 1]) * inverseStep;
    for (std::size_t i = 1; i < count; ++i)
        bends[i] = (8 * (middles[i] - middles[i - 1]) - (rates[i + 1] - rates[i - 1])) / 6 * inverseStep;
    for (std::size_t i = 0; i <= count; ++i)
        if (rates[i] <= least) bends[i] = 0;
    return bends;
}

} // namespace

LengthMap LengthMap::measured(const std::function<double(double)>& rate, int pieces, bool isSmooth) {
    LengthMap map;
    const auto count = static_cast<std::size_t>(pieces);
    const double step = 1.0 / pieces;
    double largest = 0;
    std::vector<double> middles(count);
    map.rates_.resize(count + 1);
    for (std::size_t i = 0; i <= count; ++i) {
        map.rates_[i] = rate(static_cast<double>(i) * step);
        if (i < count) middles[i] = rate((static_cast<double>(i) + 0.5) * step);
        largest = std::max({largest, map.rates_[i], i < count ? middles[i] : 0});
    }
    // A cubic follows moderate changes only; near a reversal the rate changes fast.
    const double kModerate = isSmooth ? 1.02 : 1.15;
    constexpr int kMostPieces = 2000;
    for (std::size_t i = 0; i < count && 4 * pieces <= kMostPieces; ++i) {
        const auto [low, high] = std::minmax(map.rates_[i], map.rates_[i + 1]);
        if (high > kModerate * low && high > 0.02 * largest) return measured(rate, 4 * pieces, isSmooth);
    }
    // The map must stay invertible where the curve stops for a moment.
    const double least = 1e-3 * largest;
    for (double& r : map.rates_)
        r = std::max(r, least);
    if (isSmooth) map.bends_ = bendsOf(map.rates_, middles, least);
    map.distances_.resize(count + 1);
    for (std::size_t i = 0; i < count; ++i) {
        const double mean = (map.rates_[i] + 4 * std::max(middles[i], least) + map.rates_[i + 1]) / 6;
        map.distances_[i + 1] = map.distances_[i] + mean * step;
    }
    map.length_ = map.distances_.back();
    return map;
}

/// Polynomial of the fifth degree with the exact first and second derivatives at both ends of a piece, as a share of it;
/// `x`: share of its length.
double LengthMap::smoothShare(std::size_t piece, double x) const {
    const double pieces = static_cast<double>(distances_.size() - 1);
    const double width = distances_[piece + 1] - distances_[piece];
    const auto slope = [&](std::size_t i) { return width * pieces / rates_[i]; };
    const auto bend = [&](std::size_t i) {
        const double square = width / rates_[i];
        return -bends_[i] * pieces / rates_[i] * square * square;
    };
    const double s0 = slope(piece), s1 = slope(piece + 1);
    const double b0 = bend(piece), b1 = bend(piece + 1);
    const double rest = 1 - s0 - 0.5 * b0; // what the three highest powers have to add up to
    const double slopeRest = s1 - s0 - b0;
    const double bendRest = b1 - b0;
    const double third = 10 * rest - 4 * slopeRest + 0.5 * bendRest;
    const double fourth = -15 * rest + 7 * slopeRest - bendRest;
    const double fifth = 6 * rest - 3 * slopeRest + 0.5 * bendRest;
    return x * (s0 + x * (0.5 * b0 + x * (third + x * (fourth + x * fifth))));
}

double LengthMap::parameterAt(double distance) const {
    if (!(distance > 0) || !(length_ > 0)) return 0;
    if (distance >= length_) return 1;
    if (distances_.empty()) return distance / length_;
    const auto after = std::upper_bound(distances_.begin(), distances_.end(), distance);
    const auto i = static_cast<std::size_t>(after - distances_.begin()) - 1;
    const double step = 1.0 / static_cast<double>(distances_.size() - 1);
    const double width = distances_[i + 1] - distances_[i];
    const double x = (distance - distances_[i]) / width;
    // Cubic with the exact slopes at both ends, where these are moderate enough to keep it growing.
    const double mean = step / width;
    constexpr double kSteep = 1.5;
    if (!bends_.empty() && std::max(1 / rates_[i], 1 / rates_[i + 1]) < kSteep * mean)
        return (static_cast<double>(i) + smoothShare(i, x)) * step;
    const double left = std::min(1 / rates_[i], 2.9 * mean);
    const double right = std::min(1 / rates_[i + 1], 2.9 * mean);
    const double rise = x * x * (3 - 2 * x);
    const double share = rise + ((x - 1) * (x - 1) * x * left + x * x * (x - 1) * right) / mean;
    return (static_cast<double>(i) + share) * step;
}

double LengthMap::distanceAt(double parameter) const {
    if (!(parameter > 0)) return 0;
    if (parameter >= 1) return length_;
    if (distances_.empty()) return parameter * length_;
    double low = 0;
    double high = length_;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (parameterAt(middle) < parameter ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace motion
