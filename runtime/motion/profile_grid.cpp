#include "runtime/motion/profile_grid.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

constexpr double kGrowth = 0.22; // of the width of cells, by the distance from where they are finest
constexpr double kRestShare = 0.15;
constexpr double kResolution = 0.35; // of the way on which acceleration comes to its limit

/// How fast the place itself may accelerate, and acceleration change.
struct PathLimits {
    double acceleration = 1e7, jerk = 1e9, square = 1e8;
    /// mm on which full acceleration or the highest speed is reached from rest with constant jerk.
    double riseFromRest() const {
        const double toAcceleration = acceleration * acceleration * acceleration / (6 * jerk * jerk);
        const double toSpeed = std::pow(square, 0.75) / (6 * std::sqrt(jerk));
        return std::min(toAcceleration, toSpeed);
    }
    /// mm on which acceleration may change between 0 and its limit at this speed.
    double riseAt(double speed) const {
        return speed * std::min(acceleration / jerk, std::sqrt(0.2 * speed / jerk));
    }
};

PathLimits limitsOf(const ProfileRows& rows, double square) {
    PathLimits limits;
    limits.square = std::min(limits.square, square);
    for (std::size_t i = 0; i < rows.count; ++i) {
        const ProfileRow& row = rows.rows[i];
        const double rate = std::max(std::abs(row.first), 1e-12);
        limits.acceleration = std::min(limits.acceleration, std::min(row.up, row.down) / rate);
        limits.jerk = std::min(limits.jerk, row.jerk / rate);
    }
    return limits;
}

double restWidthOf(const ProfileCell& cell, const ProfileRows& rows, double length) {
    constexpr double kMostOfPath = 0.01; // a short path never comes to full acceleration
    return std::min({kRestShare * limitsOf(rows, cell.mostSquare).riseFromRest(), 0.3 * cell.width,
                     kMostOfPath * length});
}

/// Widths of cells at the borders of the path's pieces.
std::vector<double> sizesOf(const std::vector<ProfileCell>& path, const ProfileCell& first,
                            const ProfileCell& last, const ProfileGrid& grid, double firstShare) {
    std::vector<double> sizes(path.size() + 1, 1e300);
    const auto width = [&](std::size_t i) {
        return i + 1 == path.size() ? last.width : i == 0 ? first.width : path[i].width;
    };
    const bool isMoving = grid.start.v > 0;
    sizes.front() = kGrowth * grid.start.restWidth;
    if (isMoving) {
        const double v = grid.start.v;
        sizes.front() = kResolution * limitsOf(first.first, first.mostSquare).riseAt(v);
        if (grid.start.a != 0) sizes.front() = std::min(sizes.front(), 0.3 * v * v / std::abs(grid.start.a));
        sizes.front() = std::max(firstShare * sizes.front(), 1e-6);
    }
    sizes.back() = kGrowth * grid.endWidth;
    for (std::size_t i = 1; i < path.size(); ++i) {
        const double low = std::min(path[i - 1].mostSquare, path[i].mostSquare);
        const double high = std::max(path[i - 1].mostSquare, path[i].mostSquare);
        if (path[i].isSmooth && high < 1.3 * low) continue;
        sizes[i] =
            std::max(kResolution * limitsOf(path[i].first, low).riseAt(std::sqrt(std::min(low, 1e8))), 1e-3);
    }
    for (std::size_t i = 1; i < sizes.size(); ++i)
        sizes[i] = std::min(sizes[i], sizes[i - 1] + kGrowth * width(i - 1));
    for (std::size_t i = sizes.size() - 1; i-- > 0;)
        sizes[i] = std::min(sizes[i], sizes[i + 1] + kGrowth * width(i));
    return sizes;
}

} // namespace

ProfileRows rowsAt(const ProfileCell& cell, double share) {
    ProfileRows rows = share < 0.5 ? cell.first : cell.last;
    const auto mix = [share](double a, double b) { return a + share * (b - a); };
    for (std::size_t i = 0; i < rows.count; ++i) {
        const ProfileRow& a = cell.first.rows[i];
        const ProfileRow& b = cell.last.rows[i];
        rows.rows[i] = {mix(a.first, b.first), mix(a.second, b.second), mix(a.third, b.third),
                        mix(a.up, b.up),       mix(a.down, b.down),     mix(a.jerk, b.jerk)};
    }
    return rows;
}

ProfileCell partOf(const ProfileCell& cell, double from, double to) {
    if (from <= 0 && to >= 1) return cell;
    ProfileCell part;
    part.width = cell.width * (to - from);
    part.mostSquare = cell.mostSquare;
    part.isSmooth = from > 0 || cell.isSmooth;
    part.first = rowsAt(cell, from);
    part.last = rowsAt(cell, to);
    return part;
}

ProfileGrid gridOf(const std::vector<ProfileCell>& path, const ProfileStart& start, double firstShare) {
    ProfileGrid grid;
    grid.start = start;
    const bool isMoving = start.v > 0;
    double length = 0;
    for (const ProfileCell& cell : path)
        length += cell.width;
    grid.start.restWidth = isMoving ? 0 : restWidthOf(path.front(), path.front().first, length);
    grid.endWidth = restWidthOf(path.back(), path.back().last, length);
    // Without the ways from and to rest.
    ProfileCell first = path.front();
    if (!isMoving) first = partOf(first, grid.start.restWidth / first.width, 1);
    ProfileCell last = path.size() == 1 ? first : path.back();
    last = partOf(last, 0, 1 - grid.endWidth / last.width);
    const auto piece = [&](std::size_t i) -> const ProfileCell& {
        return i + 1 == path.size() ? last : i == 0 ? first : path[i];
    };
    const std::vector<double> sizes = sizesOf(path, first, last, grid, firstShare);
    std::vector<double> borders;
    grid.cells.reserve(path.size() + path.size() / 4 + 64);
    for (std::size_t i = 0; i < path.size(); ++i) {
        const double width = piece(i).width;
        borders.assign(1, 0);
        for (;;) {
            const double at = borders.back();
            const double size =
                std::min(sizes[i] + kGrowth * at, (sizes[i + 1] + kGrowth * (width - at)) / (1 + kGrowth));
            borders.push_back(at + size);
            if (at + 1.5 * size >= width) break;
        }
        const double scale = 1 / borders.back();
        for (std::size_t k = 1; k < borders.size(); ++k)
            grid.cells.push_back(
                partOf(piece(i), borders[k - 1] * scale, k + 1 == borders.size() ? 1 : borders[k] * scale));
    }
    return grid;
}

} // namespace motion
