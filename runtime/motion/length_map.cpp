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

double LengthMap::Measured::largest() const {
    return std::max(*std::max_element(rates.begin(), rates.end()),
                    *std::max_element(middles.begin(), middles.end()));
}

/// A cubic follows moderate changes only; near a reversal the rate changes fast.
bool LengthMap::Measured::changesLittle(bool isSmooth) const {
    const double moderate = isSmooth ? 1.02 : 1.15;
    const double little = 0.02 * largest();
    for (std::size_t i = 0; i + 1 < rates.size(); ++i) {
        const auto [low, high] = std::minmax(rates[i], rates[i + 1]);
        if (high > moderate * low && high > little) return false;
    }
    return true;
}

LengthMap::LengthMap(Measured measured, bool isSmooth)
    : step_(1.0 / static_cast<double>(measured.middles.size())) {
    auto& [rates, middles] = measured;
    // The map must stay invertible where the curve stops for a moment.
    const double least = 1e-3 * measured.largest();
    for (double& r : rates)
        r = std::max(r, least);
    if (isSmooth) bends_ = bendsOf(rates, middles, least);
    pieces_.resize(middles.size());
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        const double mean = (rates[i] + 4 * std::max(middles[i], least) + rates[i + 1]) / 6;
        const double end = length_ + mean * step_;
        Piece& piece = pieces_[i];
        piece.begin = length_;
        piece.width = end - length_;
        piece.mean = step_ / piece.width;
        constexpr double kSteep = 1.5;
        piece.isSmooth = isSmooth && std::max(1 / rates[i], 1 / rates[i + 1]) < kSteep * piece.mean;
        piece.first = std::min(1 / rates[i], 2.9 * piece.mean);
        piece.last = std::min(1 / rates[i + 1], 2.9 * piece.mean);
        length_ = end;
    }
    if (isSmooth) rates_ = std::move(rates);
}

/// Polynomial of the fifth degree with the exact first and second derivatives at both ends of a piece, as a share of it;
/// `x`: share of its length.
double LengthMap::smoothShare(std::size_t piece, double x) const {
    const auto pieces = static_cast<double>(pieces_.size());
    const double width = pieces_[piece].width;
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
    if (pieces_.empty()) return distance / length_;
    // Mostly the piece that even pieces would have there, or one beside it.
    const std::size_t count = pieces_.size();
    const auto even = static_cast<std::size_t>(distance / length_ * static_cast<double>(count));
    std::size_t i = even > 0 ? even - 1 : 0;
    const std::size_t end = std::min(i + 3, count);
    while (i < end && (pieces_[i].begin > distance || (i + 1 < count && pieces_[i + 1].begin <= distance)))
        ++i;
    if (i >= end) {
        const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), distance,
                                            [](double value, const Piece& p) { return value < p.begin; });
        i = static_cast<std::size_t>(after - pieces_.begin()) - 1;
    }
    const Piece& piece = pieces_[i];
    const double x = (distance - piece.begin) / piece.width;
    // Cubic with the exact slopes at both ends, where these are moderate enough to keep it growing.
    if (piece.isSmooth) return (static_cast<double>(i) + smoothShare(i, x)) * step_;
    const double rise = x * x * (3 - 2 * x);
    const double share =
        rise + ((x - 1) * (x - 1) * x * piece.first + x * x * (x - 1) * piece.last) / piece.mean;
    return (static_cast<double>(i) + share) * step_;
}

double LengthMap::distanceAt(double parameter) const {
    if (!(parameter > 0)) return 0;
    if (parameter >= 1) return length_;
    if (pieces_.empty()) return parameter * length_;
    // A cubic map grows everywhere, so halving has to look at the parameter near the distance only.
    constexpr double kClear = 1e-14; // of the parameter, far above its rounding
    const double margin = 1e-11 * length_;
    double near = 0;
    bool isNear = false;
    if (rates_.empty()) {
        const auto piece = std::min(static_cast<std::size_t>(parameter / step_), pieces_.size() - 1);
        near = pieces_[piece].begin;
        for (int i = 0; i < 8; ++i) { // Newton's method
            const double miss = parameter - parameterAt(near);
            if (std::abs(miss) < kClear) break;
            const double step = 1e-4 * pieces_[piece].width;
            const double rise = parameterAt(near + step) - parameterAt(near);
            if (!(rise > 0)) break;
            near = std::clamp(near + miss * step / rise, pieces_[piece].begin,
                              pieces_[piece].begin + pieces_[piece].width);
        }
        isNear = parameterAt(near - margin) < parameter - kClear &&
                 parameterAt(near + margin) > parameter + kClear;
    }
    const auto isBefore = [&](double distance) {
        if (isNear && std::abs(distance - near) > margin) return distance < near;
        return parameterAt(distance) < parameter;
    };
    double low = 0;
    double high = length_;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        const bool isLast = middle == low || middle == high;
        (isBefore(middle) ? low : high) = middle;
        if (isLast) break;
    }
    return 0.5 * (low + high);
}

} // namespace motion
