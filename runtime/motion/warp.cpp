// Clamped cubic spline s(u).

#include "runtime/motion/warp.h"

#include <algorithm>
#include <cmath>

namespace motion {

Warp Warp::fromSlowness(const std::vector<double>& s, const std::vector<double>& slowness) {
    const std::size_t n = s.size();
    Warp warp;
    if (n < 3 || slowness.size() != n) return warp;
    warp.knots_.resize(n);
    double u = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (i > 0) u += 0.5 * (slowness[i] + slowness[i - 1]) * (s[i] - s[i - 1]);
        warp.knots_[i] = {u, s[i], 0};
    }
    if (!(u > 0) || !std::isfinite(u)) return {};
    for (Knot& knot : warp.knots_)
        knot.u /= u;
    warp.knots_.back().u = 1;

    // Second derivatives: a tridiagonal system, the slopes at both ends given.
    std::vector<double> diagonal(n);
    std::vector<double> right(n);
    const auto width = [&](std::size_t i) { return warp.knots_[i + 1].u - warp.knots_[i].u; };
    const auto slope = [&](std::size_t i) { return (s[i + 1] - s[i]) / width(i); };
    const double firstSlope = u / slowness.front();
    const double lastSlope = u / slowness.back();
    diagonal[0] = 2 * width(0);
    right[0] = 6 * (slope(0) - firstSlope);
    for (std::size_t i = 1; i < n; ++i) {
        const double below = width(i - 1);
        const bool isLast = i + 1 == n;
        const double factor = below / diagonal[i - 1];
        diagonal[i] = (isLast ? 2 * below : 2 * (below + width(i))) - factor * below;
        right[i] = 6 * ((isLast ? lastSlope : slope(i)) - slope(i - 1)) - factor * right[i - 1];
    }
    for (std::size_t i = n; i-- > 0;) {
        const double above = i + 1 < n ? width(i) * warp.knots_[i + 1].curvature : 0;
        warp.knots_[i].curvature = (right[i] - above) / diagonal[i];
    }
    return warp.isGrowing() ? warp : Warp{};
}

bool Warp::isGrowing() const {
    for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
        const double width = knots_[i + 1].u - knots_[i].u;
        if (!(width > 0)) return false;
        for (double k : {0.0, 0.25, 0.5, 0.75, 1.0}) {
            if (!(inside(i, knots_[i].u + k * width).first > 0)) return false;
        }
    }
    return true;
}

Warp::Point Warp::inside(std::size_t left, double u) const {
    const Knot& a = knots_[left];
    const Knot& b = knots_[left + 1];
    const double h = b.u - a.u;
    const double x = u - a.u;
    const double third = (b.curvature - a.curvature) / h;
    const double first = (b.s - a.s) / h - h * (2 * a.curvature + b.curvature) / 6;
    return {a.s + x * (first + x * (0.5 * a.curvature + x * third / 6)),
            first + x * (a.curvature + x * 0.5 * third), a.curvature + x * third};
}

Warp::Point Warp::at(double u) const {
    if (isIdentity()) return {std::clamp(u, 0.0, 1.0), 1, 0};
    const double clamped = std::clamp(u, 0.0, 1.0);
    const auto after = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, clamped,
                                        [](double value, const Knot& knot) { return value < knot.u; });
    Point point = inside(static_cast<std::size_t>(after - knots_.begin()) - 1, clamped);
    point.s = clamped == 1 ? 1 : std::clamp(point.s, 0.0, 1.0);
    return point;
}

Warp::Point Warp::atPlace(std::size_t k) const {
    return k + 1 < knots_.size() ? inside(k, knots_[k].u) : inside(k - 1, knots_[k].u);
}

double Warp::inverse(double s) const {
    if (isIdentity()) return std::clamp(s, 0.0, 1.0);
    if (s <= 0) return 0;
    if (s >= 1) return 1;
    double low = 0;
    double high = 1;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (at(middle).s < s ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace motion
