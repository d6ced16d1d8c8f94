#pragma once
// Sine, cosine and arc tangent in degrees, of one angle or of several at once, written without branches so that the compiler can
// keep two or more in one register. Error below 2 ulp for the angles a robot has, and the same bits on every machine: nothing
// depends on the mathematical library. For runtime/robot and the natives of programs.

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "runtime/robot/angles.h"

namespace robot::trig {

/// Adding and subtracting this rounds a double below 2^51 to the nearest integer.
inline constexpr double kRounder = 6755399441055744.0;

/// Taylor series within +-pi/4 rad; the first term left out is below 1e-17 there. `z`: the square of `x`.
inline double sineNearZero(double x, double z) {
    double s = -1.0 / 1307674368000.0;
    s = s * z + 1.0 / 6227020800.0;
    s = s * z - 1.0 / 39916800.0;
    s = s * z + 1.0 / 362880.0;
    s = s * z - 1.0 / 5040.0;
    s = s * z + 1.0 / 120.0;
    s = s * z - 1.0 / 6.0;
    return x + x * z * s;
}
inline double cosineNearZero(double z) {
    double c = 1.0 / 20922789888000.0;
    c = c * z - 1.0 / 87178291200.0;
    c = c * z + 1.0 / 479001600.0;
    c = c * z - 1.0 / 3628800.0;
    c = c * z + 1.0 / 40320.0;
    c = c * z - 1.0 / 720.0;
    c = c * z + 1.0 / 24.0;
    return 1.0 - 0.5 * z + z * z * c;
}

struct SineCosine {
    double sine, cosine;
};
/// Of one angle in degrees. Multiples of 90 degrees come out exact, and no zero is negative.
inline SineCosine sinCosDeg(double degrees) {
    if (!(std::fabs(degrees) < 1e9)) [[unlikely]]
        degrees = std::fmod(degrees, 360.0);
    const double rounded = degrees * (1.0 / 90.0) + kRounder;
    const double x = (degrees - (rounded - kRounder) * 90.0) * kDeg; // in [-pi/4, pi/4]
    const double z = x * x;
    const auto quarter = std::bit_cast<std::uint64_t>(rounded); // its last two bits
    // Exchanged in odd quarters, negated in two of four. Bits instead of branches, which angles at random would mispredict.
    auto sine = std::bit_cast<std::uint64_t>(sineNearZero(x, z));
    auto cosine = std::bit_cast<std::uint64_t>(cosineNearZero(z));
    const std::uint64_t exchanged = (sine ^ cosine) & -(quarter & 1);
    sine ^= exchanged ^ ((quarter & 2) << 62);
    cosine ^= exchanged ^ (((quarter + 1) & 2) << 62);
    return {std::bit_cast<double>(sine) + 0.0, std::bit_cast<double>(cosine) + 0.0};
}

/// Sine and cosine of angles in degrees, |angle| < 1e9. Multiples of 90 degrees come out exact.
template <std::size_t N>
inline void sinCosDeg(const double (&degrees)[N], double (&sine)[N], double (&cosine)[N]) {
    for (std::size_t i = 0; i < N; ++i) {
        const double quarters = (degrees[i] * (1.0 / 90.0) + kRounder) - kRounder;
        const double x = (degrees[i] - quarters * 90.0) * kDeg; // in [-pi/4, pi/4]
        const double z = x * x;
        const double s = sineNearZero(x, z);
        const double c = cosineNearZero(z);
        // quarter 0: s, c; 1: c, -s; 2: -s, -c; 3: -c, s. Arithmetic on 0 and 1 instead of branches.
        const double odd = quarters - 2.0 * ((quarters * 0.5 + kRounder) - kRounder); // -1, 0 or 1
        const double isOdd = odd * odd;
        const double pair = (quarters - isOdd) * 0.5;
        const double oddPair = pair - 2.0 * ((pair * 0.5 + kRounder) - kRounder);
        const double flip = 1.0 - 2.0 * oddPair * oddPair;
        sine[i] = flip * ((1.0 - isOdd) * s + isOdd * c);
        cosine[i] = flip * ((1.0 - isOdd) * c - isOdd * s);
    }
}

/// Angles of the vectors (x, y) from the x axis, degrees in [-180, 180]; the null vector gives 0.
template <std::size_t N>
inline void atan2Deg(const double (&y)[N], const double (&x)[N], double (&degrees)[N]) {
    for (std::size_t i = 0; i < N; ++i) {
        const double ax = std::fabs(x[i]);
        const double ay = std::fabs(y[i]);
        const double longer = ax > ay ? ax : ay;
        const double shorter = ax > ay ? ay : ax;
        // Above tan(pi/8) the angle is measured from pi/4, so that the series sees |t| <= tan(pi/8) only.
        const bool isWide = shorter > 0.41421356237309503 * longer;
        const double numerator = isWide ? shorter - longer : shorter;
        const double denominator = isWide ? shorter + longer : longer;
        const double t = numerator / (denominator == 0 ? 1.0 : denominator);
        const double z = t * t;
        // Polynomial through the Chebyshev points of (atan(t)/t - 1)/z on that range; error below 5e-18.
        double p = -0.01917688711906226;
        p = p * z + 0.03923165829558719;
        p = p * z - 0.0508544973794026;
        p = p * z + 0.0585814891280221;
        p = p * z - 0.06664511447381948;
        p = p * z + 0.07692183190826087;
        p = p * z - 0.09090904578123903;
        p = p * z + 0.11111111015256361;
        p = p * z - 0.14285714284666542;
        p = p * z + 0.1999999999999552;
        p = p * z - 0.3333333333333333;
        double angle = (t + t * z * p) * (1.0 / kDeg) + (isWide ? 45.0 : 0.0);
        angle = ay > ax ? 90.0 - angle : angle;
        angle = x[i] < 0 ? 180.0 - angle : angle;
        degrees[i] = std::copysign(angle, y[i]);
    }
}

/// Of one vector.
inline double atan2Deg(double y, double x) {
    const double ys[] = {y}, xs[] = {x};
    double degrees[1];
    atan2Deg(ys, xs, degrees);
    return degrees[0];
}
/// Arc sine and arc cosine in degrees, |value| <= 1.
inline double asinDeg(double value) {
    return atan2Deg(value, std::sqrt((1 - value) * (1 + value)));
}
inline double acosDeg(double value) {
    return atan2Deg(std::sqrt((1 - value) * (1 + value)), value);
}

} // namespace robot::trig
