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
std::vector<double> sizesOf(const std::vector<ProfileCell>& path, const ProfileGrid& grid,
                            double firstShare) {
    std::vector<double> sizes(path.size() + 1, 1e300);
    const bool isMoving = grid.start.v > 0;
    sizes.front() = kGrowth * grid.start.restWidth;
    if (isMoving) {
        const double v = grid.start.v;
        sizes.front() = kResolution * limitsOf(path.front().first, path.front().mostSquare).riseAt(v);
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
        sizes[i] = std::min(sizes[i], sizes[i - 1] + kGrowth * path[i - 1].width);
    for (std::size_t i = sizes.size() - 1; i-- > 0;)
        sizes[i] = std::min(sizes[i], sizes[i + 1] + kGrowth * path[i].width);
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
    std::vector<ProfileCell> pieces = path;
    const bool isMoving = start.v > 0;
    double length = 0;
    for (const ProfileCell& cell : path)
        length += cell.width;
    grid.start.restWidth = isMoving ? 0 : restWidthOf(pieces.front(), pieces.front().first, length);
    grid.endWidth = restWidthOf(pieces.back(), pieces.back().last, length);
    if (!isMoving) pieces.front() = partOf(pieces.front(), grid.start.restWidth / pieces.front().width, 1);
    pieces.back() = partOf(pieces.back(), 0, 1 - grid.endWidth / pieces.back().width);
    const std::vector<double> sizes = sizesOf(pieces, grid, firstShare);
    std::vector<double> borders;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const double width = pieces[i].width;
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
                partOf(pieces[i], borders[k - 1] * scale, k + 1 == borders.size() ? 1 : borders[k] * scale));
    }
    return grid;
}

} // namespace motion
