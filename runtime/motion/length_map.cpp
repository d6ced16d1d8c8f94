#include "runtime/motion/length_map.h"

#include <algorithm>
#include <cmath>

namespace motion {

LengthMap LengthMap::even(double length) {
    LengthMap map;
    map.length_ = length;
    return map;
}

LengthMap LengthMap::measured(const std::function<double(double)>& rate, int pieces) {
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
    constexpr double kModerate = 1.15;
    constexpr int kMostPieces = 2000;
    for (std::size_t i = 0; i < count && 4 * pieces <= kMostPieces; ++i) {
        const auto [low, high] = std::minmax(map.rates_[i], map.rates_[i + 1]);
        if (high > kModerate * low && high > 0.02 * largest) return measured(rate, 4 * pieces);
    }
    // The map must stay invertible where the curve stops for a moment.
    const double least = 1e-3 * largest;
    for (double& r : map.rates_)
        r = std::max(r, least);
    map.distances_.resize(count + 1);
    for (std::size_t i = 0; i < count; ++i) {
        const double mean = (map.rates_[i] + 4 * std::max(middles[i], least) + map.rates_[i + 1]) / 6;
        map.distances_[i + 1] = map.distances_[i] + mean * step;
    }
    map.length_ = map.distances_.back();
    return map;
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
