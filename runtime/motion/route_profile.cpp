#include "runtime/motion/route_profile.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

/// Shares of the limits that planning uses: derivatives are known at the ends of stretches only.
constexpr double kSpeedShare = 1 - 2e-6;
constexpr double kShare = 0.995;
constexpr double kJerkShare = 0.986;
constexpr int kSamples = 5;

using Samples = std::array<double, kSamples>;

/// Derivatives of the polynomial through five values at even steps.
struct Derivatives {
    double first = 0, second = 0, third = 0;
};

Derivatives atBegin(const Samples& f, double h) {
    return {(-25 * f[0] + 48 * f[1] - 36 * f[2] + 16 * f[3] - 3 * f[4]) / (12 * h),
            (35 * f[0] - 104 * f[1] + 114 * f[2] - 56 * f[3] + 11 * f[4]) / (12 * h * h),
            (-5 * f[0] + 18 * f[1] - 24 * f[2] + 14 * f[3] - 3 * f[4]) / (2 * h * h * h)};
}

Derivatives atEnd(const Samples& f, double h) {
    const Derivatives mirrored = atBegin({f[4], f[3], f[2], f[1], f[0]}, h);
    return {-mirrored.first, mirrored.second, -mirrored.third};
}

/// Largest rate on the stretch.
double mostRate(const Samples& f, double h) {
    const double middle = (f[0] - 8 * f[1] + 8 * f[3] - f[4]) / (12 * h);
    const double low = (-3 * f[0] - 10 * f[1] + 18 * f[2] - 6 * f[3] + f[4]) / (12 * h);
    const double high = (3 * f[4] + 10 * f[3] - 18 * f[2] + 6 * f[1] - f[0]) / (12 * h);
    return std::max({std::abs(atBegin(f, h).first), std::abs(low), std::abs(middle), std::abs(high),
                     std::abs(atEnd(f, h).first)});
}

double squareOf(double limit, double rate) {
    const double size = std::abs(rate);
    if (size < 1e-12 || limit > kNoLimit) return kNoLimit;
    const double speed = kSpeedShare * limit / size;
    return speed * speed;
}

/// The stretch as it was sampled.
struct Sampled {
    std::array<RoutePoint, kSamples> points;
    std::array<Pose, kSamples> tcp;
    double step = 0;
    Samples axis(std::size_t i) const {
        Samples values{};
        for (std::size_t k = 0; k < kSamples; ++k)
            values[k] = points[k].joints[i];
        return values;
    }
    Samples external(std::size_t i) const {
        Samples values{};
        for (std::size_t k = 0; k < kSamples; ++k)
            values[k] = points[k].extax[i];
        return values;
    }
};

/// Less than the rounding of axis angles does not count as a change.
void dropNoise(Derivatives& d, double width) {
    if (std::abs(d.second) * width * width < 2e-10) d.second = 0;
    if (std::abs(d.third) * width * width * width < 5e-9) d.third = 0;
}

void addRow(ProfileCell& cell, const Samples& f, double h, const std::array<double, 2>& acceleration,
            double jerk) {
    for (const bool isLast : {false, true}) {
        Derivatives d = isLast ? atEnd(f, h) : atBegin(f, h);
        dropNoise(d, cell.width);
        const double most = kShare * acceleration[isLast ? 1 : 0];
        (isLast ? cell.last : cell.first).add({d.first, d.second, d.third, most, most, kJerkShare * jerk});
    }
}

/// Limits of the TCP's own acceleration.
void addTcp(ProfileCell& cell, const Sampled& sampled, const MoveLimits& most) {
    constexpr double kEach = 0.7071; // along and across the path together; each takes its share
    const double world = kEach * most.worldAcceleration;
    const double up = kShare * std::min(most.pathAcceleration, world);
    const double down = kShare * std::min(most.pathDeceleration, world);
    if (up > kNoLimit && down > kNoLimit) return;
    std::array<Samples, 3> way{};
    for (std::size_t k = 0; k < kSamples; ++k) {
        const Vec3& p = sampled.tcp[k].pos;
        way[0][k] = p.x, way[1][k] = p.y, way[2][k] = p.z;
    }
    for (const bool isLast : {false, true}) {
        Vec3 first, second;
        double* const firsts[] = {&first.x, &first.y, &first.z};
        double* const seconds[] = {&second.x, &second.y, &second.z};
        for (std::size_t i = 0; i < 3; ++i) {
            Derivatives d = isLast ? atEnd(way[i], sampled.step) : atBegin(way[i], sampled.step);
            dropNoise(d, cell.width);
            *firsts[i] = d.first;
            *seconds[i] = d.second;
        }
        const double rate = norm(first);
        if (rate < 1e-9) continue;
        const double along = dot(first, second) / rate;
        const double across = norm(second - first * (along / rate));
        (isLast ? cell.last : cell.first).add({rate, along, 0, up, down, 1e300});
        if (across > 1e-12) cell.mostSquare = std::min(cell.mostSquare, kShare * world / across);
    }
}

void limitSpeed(ProfileCell& cell, const Sampled& sampled, const MoveLimits& most) {
    double tcp = 0;
    double turn = 0;
    const double h = sampled.step;
    std::array<Samples, 3> way{};
    for (std::size_t k = 0; k < kSamples; ++k) {
        const Vec3& p = sampled.tcp[k].pos;
        way[0][k] = p.x, way[1][k] = p.y, way[2][k] = p.z;
        if (k > 0) turn = std::max(turn, robot::angleBetween(sampled.tcp[k - 1].rot, sampled.tcp[k].rot) / h);
    }
    for (const bool isLast : {false, true}) {
        double square = 0;
        for (const Samples& line : way) {
            const double rate = (isLast ? atEnd(line, h) : atBegin(line, h)).first;
            square += rate * rate;
        }
        tcp = std::max(tcp, std::sqrt(square));
    }
    double middle = 0;
    for (const Samples& f : way) {
        const double rate = (f[0] - 8 * f[1] + 8 * f[3] - f[4]) / (12 * h);
        middle += rate * rate;
    }
    tcp = std::max(tcp, std::sqrt(middle));
    cell.mostSquare = std::min({cell.mostSquare, squareOf(most.tcpSpeed, tcp),
                                squareOf(most.orientationSpeed, turn), squareOf(most.pathSpeed, 1)});
}

} // namespace

ProfileCell measuredCell(const Route& route, const RouteStretch& stretch, const ArmLimits& limits) {
    ProfileCell cell;
    cell.width = stretch.end - stretch.begin;
    cell.mostSquare = 1e8;
    const Leg& leg = route.leg(stretch.leg);
    const MoveLimits& most = leg.limits;
    Sampled sampled;
    sampled.step = cell.width / (kSamples - 1);
    std::array<double, kSamples> places{};
    for (std::size_t k = 0; k < kSamples; ++k) {
        // Just inside: what counts beyond the border belongs to the neighbour.
        const double inside = k == 0 ? 1e-9 : k + 1 == kSamples ? -1e-9 : 0;
        places[k] = stretch.begin + sampled.step * (static_cast<double>(k) + inside);
    }
    route.at(places, sampled.points);
    for (std::size_t k = 0; k < kSamples; ++k) {
        sampled.tcp[k] = leg.path->frames().fromFlange(
            leg.path->kinematics().forward(sampled.points[k].joints), sampled.points[k].extax);
    }
    limitSpeed(cell, sampled, most);
    std::array<Joints, 2> accelerations{sampled.points[0].joints, sampled.points[0].joints};
    limits.accelerations->limitsAt(sampled.points.front().joints, accelerations[0]);
    limits.accelerations->limitsAt(sampled.points.back().joints, accelerations[1]);
    for (std::size_t i = 0; i < stretch.first.size(); ++i) {
        const Samples f = sampled.axis(i);
        const double rate = mostRate(f, sampled.step);
        if (rate < 1e-10) continue;
        cell.mostSquare = std::min(cell.mostSquare, squareOf(most.jointSpeed[i], rate));
        addRow(cell, f, sampled.step,
               {most.accelerationShare[i] * accelerations[0][i],
                most.accelerationShare[i] * accelerations[1][i]},
               most.rampShare * limits.jerk[i]);
    }
    for (std::size_t i = 0; i < stretch.externalFirst.size(); ++i) {
        if (!isConnected(stretch.middle.extax[i]) || most.externalAcceleration[i] <= 0) continue;
        const Samples f = sampled.external(i);
        const double rate = mostRate(f, sampled.step);
        if (rate < 1e-10) continue;
        constexpr double kSecondsToFull = 0.05; // no figure for their jerk is configured
        cell.mostSquare = std::min(cell.mostSquare, squareOf(most.externalSpeed[i], rate));
        const double acceleration = most.externalAcceleration[i];
        addRow(cell, f, sampled.step, {acceleration, acceleration},
               most.rampShare * acceleration / kSecondsToFull);
    }
    addTcp(cell, sampled, most);
    return cell;
}

void joinCells(const ProfileCell& before, ProfileCell& cell) {
    cell.isSmooth = before.last.count == cell.first.count;
    const double square = std::min(before.mostSquare, cell.mostSquare);
    for (std::size_t i = 0; i < cell.first.count && cell.isSmooth; ++i) {
        const ProfileRow& a = before.last.rows[i];
        const ProfileRow& b = cell.first.rows[i];
        const double most = std::min(b.up, b.down);
        const double jump = std::abs(a.second - b.second) * square;
        const double turn = std::abs(a.first - b.first) * std::sqrt(square) / 0.01;
        cell.isSmooth = jump < 0.02 * most && turn < 0.02 * most;
    }
}

} // namespace motion
