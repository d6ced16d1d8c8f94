#include "runtime/motion/profile_solver.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

constexpr double kCellJerkShare = 0.997; // in a cell the speed may be a little higher than at its ends

using Three = ProfileTerms::Three;
constexpr double kMargin = ProfileTerms::kMargin;

/// Accelerations that keep a row at a square of the speed.
struct Range {
    double low = -kNoLimit, high = kNoLimit;
    bool contains(const Range& other) const { return low <= other.low && high >= other.high; }
};

/// `inverse`: of the factor; 0 = the acceleration does not count.
Range rangeOf(double inverse, double constant, double up, double down) {
    if (inverse == 0) return {};
    const double a = (up - constant) * inverse;
    const double b = (-down - constant) * inverse;
    return {std::min(a, b), std::max(a, b)};
}

double inverseOf(double factor) {
    return std::abs(factor) < 1e-14 ? 0 : 1 / factor;
}

} // namespace

ProfileSolver::Result ProfileSolver::solve(const std::vector<ProfileCell>& cells, const ProfileStart& start,
                                           double endWidth) {
    prepare(cells, start, endWidth);
    Result result;
    const double* coefficients = coefficient_.data();
    terms_.begin(coefficients, terms_.duration(coefficients));
    constexpr int kMostIterations = 90;
    constexpr double kGapShare = 6e-4; // of the duration
    constexpr double kBalanceShare = 1e-2;
    const auto pairs = static_cast<double>(terms_.pairs());
    double share = 0.2;
    for (; result.iterations < kMostIterations; ++result.iterations) {
        const double duration = terms_.duration(coefficients);
        const double target = std::max(share * terms_.gap(), 0.2 * kGapShare * duration) / pairs;
        terms_.assemble(coefficients, target, matrix_);
        if (terms_.gap() < kGapShare * duration && terms_.worstExcess(coefficients) <= 0 &&
            terms_.imbalance(coefficients) < kBalanceShare * duration)
            break;
        if (!factorAndSolve()) return result;
        const ProfileTerms::Lengths lengths = terms_.stepLengths(coefficients, step_.data());
        const double length = std::min(lengths.speeds, lengths.forces);
        if (!(length > 1e-9)) return result;
        terms_.advance(lengths);
        for (std::size_t i = 0; i < cells_ + 2; ++i)
            coefficient_[i] += lengths.speeds * step_[i];
        if (startsAtRest_) coefficient_[0] = firstRatio_ * coefficient_[1];
        coefficient_[cells_ + 1] = lastRatio_ * coefficient_[cells_];
        share = length > 0.8 ? 0.05 : length > 0.4 ? 0.3 : 1.0;
    }
    result.excess = terms_.worstExcess(coefficients);
    result.isSolved = result.excess <= 1e-9;
    double place = 0;
    for (std::size_t i = 0; i <= cells_; ++i) {
        const double before = width_[i == 0 ? 0 : i - 1];
        const double after = width_[i == cells_ ? cells_ - 1 : i];
        const double square = (after * coefficient_[i] + before * coefficient_[i + 1]) / (before + after);
        if (!(square > 0)) result.isSolved = false;
        result.knots.push_back({place, std::sqrt(std::max(square, 0.0)),
                                (coefficient_[i + 1] - coefficient_[i]) / (before + after)});
        if (i < cells_) place += width_[i];
    }
    return result;
}

void ProfileSolver::prepare(const std::vector<ProfileCell>& cells, const ProfileStart& start,
                            double endWidth) {
    cells_ = cells.size();
    startsAtRest_ = !(start.v > 0);
    const std::size_t count = cells_ + 2;
    width_.resize(cells_);
    for (std::size_t i = 0; i < cells_; ++i)
        width_[i] = cells[i].width;
    const std::size_t padded = ProfileTerms::paddedCount(count);
    coefficient_.assign(padded, 1);
    fixed_.assign(count, 0);
    for (auto* values : {&matrix_.diagonal, &matrix_.next, &matrix_.second, &matrix_.right, &step_})
        values->assign(padded, 0);
    const auto ratio = [](double width, double rest) {
        const double r = 2 * width / (3 * rest); // the square grows with the power 4/3 of the place
        return (1 - r) / (1 + r);
    };
    firstRatio_ = startsAtRest_ ? ratio(width_.front(), start.restWidth) : 0;
    lastRatio_ = ratio(width_.back(), endWidth);
    fixed_[0] = fixed_[count - 1] = 1;
    const double square = start.v * start.v;
    coefficient_[1] = square + start.a * width_.front();
    setCaps(cells, start, endWidth);
    tightenCaps(cells);
    setGuess(cells, start, endWidth);
    if (startsAtRest_) {
        coefficient_[0] = firstRatio_ * coefficient_[1];
    } else {
        fixed_[1] = 1;
        coefficient_[0] = square - start.a * width_.front();
        coefficient_[1] = square + start.a * width_.front();
    }
    coefficient_[count - 1] = lastRatio_ * coefficient_[count - 2];
    weight_.assign(count, 0);
    std::copy(width_.begin(), width_.end(), weight_.begin() + 1);
    terms_.reset(cap_, weight_, fixed_);
    for (std::size_t i = 0; i < cells_; ++i)
        addTerms(i, cells[i]);
}

/// Largest coefficients: a quadratic spline lies below its three coefficients.
void ProfileSolver::setCaps(const std::vector<ProfileCell>& cells, const ProfileStart& start,
                            double endWidth) {
    cap_.assign(cells_ + 2, 1e8);
    const auto lower = [&](std::size_t i, double square) { cap_[i] = std::min(cap_[i], square); };
    for (std::size_t i = 0; i < cells_; ++i)
        for (std::size_t k = i; k < i + 3; ++k)
            lower(k, cells[i].mostSquare * (1 - kMargin));
    // On the way from and to rest the jerk is constant.
    const auto restSquare = [](const ProfileRows& rows, double width, double sign) {
        double most = 1e8;
        for (std::size_t i = 0; i < rows.count; ++i) {
            const ProfileRow& row = rows.rows[i];
            if (row.jerk > kNoLimit) continue;
            const double factor = std::max(
                std::abs(row.first) * 2 / (9 * width * width),
                std::abs(row.first * 2 / (9 * width * width) + sign * 2 * row.second / width + row.third));
            if (factor > 0) most = std::min(most, std::cbrt(row.jerk / factor * row.jerk / factor));
        }
        return most * (1 - kMargin);
    };
    if (startsAtRest_) lower(1, restSquare(cells.front().first, start.restWidth, 1) * 2 / (1 + firstRatio_));
    lower(cells_, restSquare(cells.back().last, endWidth, -1) * 2 / (1 + lastRatio_));
}

/// Lowers the largest squares of the speed to what acceleration from the beginning and to the end can reach.
void ProfileSolver::tightenCaps(const std::vector<ProfileCell>& cells) {
    const auto gain = [&](std::size_t i) {
        double most = 1e7;
        for (const ProfileRows* rows : {&cells[i].first, &cells[i].last})
            for (std::size_t k = 0; k < rows->count; ++k) {
                const ProfileRow& row = rows->rows[k];
                const double bent = std::abs(row.second) * std::min(cap_[i + 1], 1e8);
                if (std::abs(row.first) > 1e-12)
                    most = std::min(most, (std::max(row.up, row.down) + bent) / std::abs(row.first));
            }
        return 3 * width_[i] * most; // a coefficient is half a cell further on
    };
    for (std::size_t i = 1; i <= cells_; ++i) {
        const double before = i > 1 || startsAtRest_ ? i > 1 ? cap_[i - 1] : 0 : coefficient_[1];
        const double gained = gain(i - 1);
        cap_[i] = std::min(cap_[i], before + gained + (i > 1 ? 0.5 : 4) * gained);
    }
    for (std::size_t i = cells_; i >= 1; --i) {
        const double gained = gain(i - 1);
        cap_[i] = std::min(cap_[i], (i < cells_ ? cap_[i + 1] : 4 * gained) + 1.5 * gained);
    }
}

/// A speed that nearly keeps accelerations and jerks.
void ProfileSolver::setGuess(const std::vector<ProfileCell>& cells, const ProfileStart& start,
                             double endWidth) {
    double before = start.restWidth;
    double after = endWidth;
    for (const double width : width_)
        after += width;
    for (std::size_t i = 1; i <= cells_; ++i) {
        double most = cap_[i];
        double jerk = 1e12;
        for (const ProfileRows* rows : {&cells[i - 1].first, &cells[i - 1].last})
            for (std::size_t k = 0; k < rows->count; ++k) {
                const ProfileRow& row = rows->rows[k];
                jerk = std::min(jerk, row.jerk / std::max(std::abs(row.first), 1e-12));
                most = std::min(most, std::min(row.up, row.down) / std::max(std::abs(row.second), 1e-12));
            }
        // From rest with constant jerk the square of the speed is (4.5 jerk way^2)^(2/3).
        const auto fromRest = [&](double way) { return std::cbrt(20 * jerk * way * way * jerk * way * way); };
        if (startsAtRest_) most = std::min(most, fromRest(before + 0.5 * width_[i - 1]));
        most = std::min(most, fromRest(after - 0.5 * width_[i - 1]));
        coefficient_[i] = 0.5 * most;
        before += width_[i - 1];
        after -= width_[i - 1];
    }
}

void ProfileSolver::addTerms(std::size_t cell, const ProfileCell& data) {
    const double h = width_[cell];
    const double before = width_[cell == 0 ? 0 : cell - 1];
    const double after = width_[cell + 1 == cells_ ? cell : cell + 1];
    const Lines first{{h / (before + h), before / (before + h), 0}, {-1 / (before + h), 1 / (before + h), 0}};
    const Lines last{{0, after / (h + after), h / (h + after)}, {0, -1 / (h + after), 1 / (h + after)}};
    Three change{};
    for (std::size_t k = 0; k < 3; ++k)
        change[k] = (last.slope[k] - first.slope[k]) / h;
    const double cap = data.mostSquare < 1e8 ? data.mostSquare : 1e8;
    if (cell == 0 || !data.isSmooth) addAccelerations(cell, data.first, first, cap);
    addAccelerations(cell, data.last, last, cap);
    addJerks(cell, false, data.first, first, change, cap);
    addJerks(cell, true, data.last, last, change, cap);
}

void ProfileSolver::addAccelerations(std::size_t cell, const ProfileRows& rows, const Lines& at, double cap) {
    std::array<Range, ProfileRows::kMost> slow;
    std::array<Range, ProfileRows::kMost> fast;
    std::size_t tightSlow = 0;
    std::size_t tightFast = 0;
    for (std::size_t i = 0; i < rows.count; ++i) {
        const ProfileRow& row = rows.rows[i];
        const double inverse = inverseOf(row.first);
        slow[i] = rangeOf(inverse, 0, row.up, row.down);
        fast[i] = rangeOf(inverse, row.second * cap, row.up, row.down);
        if (slow[i].high - slow[i].low < slow[tightSlow].high - slow[tightSlow].low) tightSlow = i;
        if (fast[i].high - fast[i].low < fast[tightFast].high - fast[tightFast].low) tightFast = i;
    }
    for (std::size_t i = 0; i < rows.count; ++i) {
        const ProfileRow& row = rows.rows[i];
        if (row.up > kNoLimit && row.down > kNoLimit) continue;
        const auto covers = [&](std::size_t other) {
            return i != other && slow[i].contains(slow[other]) && fast[i].contains(fast[other]) &&
                   (other < i || !(slow[other].contains(slow[i]) && fast[other].contains(fast[i])));
        };
        const bool isFlat = std::abs(row.first) < 1e-14;
        if (isFlat ? std::abs(row.second) * cap < std::min(row.up, row.down)
                   : covers(tightSlow) || covers(tightFast))
            continue;
        const double unit = 1 / std::min(row.up, row.down);
        Three line{};
        for (std::size_t k = 0; k < 3; ++k)
            line[k] = (row.first * at.slope[k] + row.second * at.place[k]) * unit;
        terms_.addAcceleration(cell, folded(cell, line), std::min(row.up * unit, 1e6) * (1 - kMargin),
                               std::min(row.down * unit, 1e6) * (1 - kMargin));
    }
}

void ProfileSolver::addJerks(std::size_t cell, bool isLast, const ProfileRows& rows, const Lines& at,
                             const Three& change, double cap) {
    const double root = std::sqrt(cap);
    terms_.setEnd(cell, isLast, folded(cell, at.place), root * kCellJerkShare);
    double most = 1e7; // largest acceleration along the path
    for (std::size_t i = 0; i < rows.count; ++i)
        if (std::abs(rows.rows[i].first) > 1e-14)
            most = std::min(
                most, (std::max(rows.rows[i].up, rows.rows[i].down) + std::abs(rows.rows[i].second) * cap) /
                          std::abs(rows.rows[i].first));
    // Changes of acceleration that keep a row lie around a middle that depends on acceleration and square of the speed, closest
    // at the cap. A row is covered when those of the tightest row do not reach beyond them.
    struct Middle {
        double bySlope = 0, bySquare = 0, half = 0;
    };
    std::array<Middle, ProfileRows::kMost> middles;
    std::size_t tight = 0;
    double least = 0;
    for (std::size_t i = 0; i < rows.count; ++i) {
        const ProfileRow& row = rows.rows[i];
        if (row.jerk > kNoLimit) continue;
        const double inverse = inverseOf(row.first);
        middles[i] = {3 * row.second * inverse, row.third * inverse, row.jerk / root * std::abs(inverse)};
        const double stiffness = std::abs(row.first) / row.jerk;
        if (stiffness > least) {
            least = stiffness;
            tight = i;
        }
    }
    for (std::size_t i = 0; i < rows.count; ++i) {
        const ProfileRow& row = rows.rows[i];
        if (row.jerk > kNoLimit) continue;
        if (i != tight && least > 0) {
            const double apart = std::abs(middles[i].bySlope - middles[tight].bySlope) * most +
                                 std::abs(middles[i].bySquare - middles[tight].bySquare) * cap;
            if (middles[i].half > 0 && apart + middles[tight].half <= middles[i].half) continue;
        }
        const double unit = row.jerk / root;
        if (std::abs(row.first) < 1e-14 && 3 * std::abs(row.second) * most + std::abs(row.third) * cap < unit)
            continue;
        const double share = 1 / unit;
        Three line{};
        for (std::size_t k = 0; k < 3; ++k)
            line[k] =
                (row.first * change[k] + 3 * row.second * at.slope[k] + row.third * at.place[k]) * share;
        terms_.addJerk(cell, isLast, folded(cell, line));
    }
}

/// The outermost coefficients follow their neighbours when the path begins or ends at rest.
Three ProfileSolver::folded(std::size_t cell, Three line) const {
    if (cell == 0 && startsAtRest_) {
        line[1] += firstRatio_ * line[0];
        line[0] = 0;
    }
    if (cell + 1 == cells_) {
        line[1] += lastRatio_ * line[2];
        line[2] = 0;
    }
    return line;
}

/// Five diagonals, positive definite.
bool ProfileSolver::factorAndSolve() {
    auto& [diagonal, next, second, right] = matrix_;
    const std::size_t count = cells_ + 2;
    for (std::size_t i = 0; i < count; ++i) {
        const double pivot = diagonal[i];
        if (!(pivot > 0) || !std::isfinite(pivot)) return false;
        const double inverse = 1 / pivot;
        const double one = next[i] * inverse;
        const double two = second[i] * inverse;
        if (i + 1 < count) {
            diagonal[i + 1] -= one * next[i];
            next[i + 1] -= one * second[i];
            right[i + 1] -= one * right[i];
        }
        if (i + 2 < count) {
            diagonal[i + 2] -= two * second[i];
            right[i + 2] -= two * right[i];
        }
        next[i] = one;
        second[i] = two;
        right[i] *= inverse;
    }
    for (std::size_t i = count; i-- > 0;) {
        step_[i] = right[i];
        if (i + 1 < count) step_[i] -= next[i] * step_[i + 1];
        if (i + 2 < count) step_[i] -= second[i] * step_[i + 2];
    }
    return true;
}

} // namespace motion
