#include "runtime/motion/profile_solver.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

constexpr double kUnlimited = 1e200;
constexpr double kLeastSlack = 0.02; // of a bound, at the beginning
constexpr double kMargin = 1e-7;     // of each limit, kept free for rounding
constexpr double kJerkShare = 0.997; // in a cell the speed may be a little higher than at its ends

using Three = std::array<double, 3>;

double dot(const Three& a, const double* b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Accelerations that keep a row at a square of the speed.
struct Range {
    double low = -kUnlimited, high = kUnlimited;
    bool contains(const Range& other) const { return low <= other.low && high >= other.high; }
};

Range rangeOf(double factor, double constant, double up, double down) {
    if (std::abs(factor) < 1e-14) return {};
    const double a = (up - constant) / factor;
    const double b = (-down - constant) / factor;
    return {std::min(a, b), std::max(a, b)};
}

/// Of the terms of a cell: parts of the matrix, and of the right side with the sign reversed.
struct TermSums {
    std::array<double, 3> diagonal{}, right{};
    std::array<double, 2> next{};
    double second = 0;
};

/// Adds what a term contributes to the three coefficients of its cell.
template <class Term> void addTo(TermSums& sums, Term& term, double target) {
    term.inverse = 1.0 / term.slack;
    const auto ratio = term.force * term.inverse;
    const auto pull = target * term.inverse + ratio * (term.value + term.slack);
    // The gradients of both sides are row + fall * square and -row + fall * square.
    const double both = ratio[0] + ratio[1];
    const double odd = pull[0] - pull[1];
    const Three& r = term.row;
    Three even{both * r[0], both * r[1], both * r[2]}; // times row
    Three shift{odd * r[0], odd * r[1], odd * r[2]};
    if (term.isJerk) {
        const double difference = ratio[0] - ratio[1];
        const double push = pull[0] + pull[1];
        Three q{}, cross{};
        for (std::size_t k = 0; k < 3; ++k) {
            q[k] = term.fall * term.square[k];
            even[k] += difference * q[k];
            cross[k] = difference * r[k] + both * q[k];
            shift[k] += push * q[k];
        }
        for (std::size_t k = 0; k < 3; ++k)
            sums.diagonal[k] += cross[k] * q[k];
        sums.next[0] += cross[0] * q[1];
        sums.next[1] += cross[1] * q[2];
        sums.second += cross[0] * q[2];
    }
    for (std::size_t k = 0; k < 3; ++k) {
        sums.diagonal[k] += even[k] * r[k];
        sums.right[k] += shift[k];
    }
    sums.next[0] += even[0] * r[1];
    sums.next[1] += even[1] * r[2];
    sums.second += even[0] * r[2];
}

} // namespace

ProfileSolver::Result ProfileSolver::solve(const std::vector<ProfileCell>& cells, const ProfileStart& start,
                                           double endWidth) {
    prepare(cells, start, endWidth);
    Result result;
    begin();
    constexpr int kMostIterations = 90;
    constexpr double kGapShare = 6e-4; // of the duration
    constexpr double kBalanceShare = 1e-2;
    const auto pairs = static_cast<double>(2 * terms_.size() + cap_.size());
    double share = 0.2;
    for (; result.iterations < kMostIterations; ++result.iterations) {
        double duration = 0;
        for (std::size_t i = 0; i < cells_; ++i)
            duration += width_[i] / std::sqrt(coefficient_[i + 1]);
        const bool isKept = evaluateTerms();
        if (gap_ < kGapShare * duration && isKept && imbalance() < kBalanceShare * duration) break;
        assemble(std::max(share * gap_, 0.2 * kGapShare * duration) / pairs);
        if (!factorAndSolve()) return result;
        const Lengths lengths = stepLengths();
        const double length = std::min(lengths.speeds, lengths.forces);
        if (!(length > 1e-9)) return result;
        advance(lengths);
        share = length > 0.8 ? 0.05 : length > 0.4 ? 0.3 : 1.0;
    }
    result.excess = worstExcess();
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
    coefficient_.assign(count, 0);
    fixed_.assign(count, 0);
    for (auto* values : {&diagonal_, &next_, &second_, &right_, &step_})
        values->assign(count, 0);
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
    terms_.clear();
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
            if (row.jerk > kUnlimited) continue;
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
        cap_[i] = std::min(cap_[i], before + gain(i - 1) + (i > 1 ? 0.5 : 4) * gain(i - 1));
    }
    for (std::size_t i = cells_; i >= 1; --i)
        cap_[i] = std::min(cap_[i], (i < cells_ ? cap_[i + 1] : 4 * gain(i - 1)) + 1.5 * gain(i - 1));
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
    addJerks(cell, data.first, first, change, cap);
    addJerks(cell, data.last, last, change, cap);
}

void ProfileSolver::addAccelerations(std::size_t cell, const ProfileRows& rows, const Lines& at, double cap) {
    std::array<Range, ProfileRows::kMost> slow;
    std::array<Range, ProfileRows::kMost> fast;
    std::size_t tightSlow = 0;
    std::size_t tightFast = 0;
    for (std::size_t i = 0; i < rows.count; ++i) {
        const ProfileRow& row = rows.rows[i];
        slow[i] = rangeOf(row.first, 0, row.up, row.down);
        fast[i] = rangeOf(row.first, row.second * cap, row.up, row.down);
        if (slow[i].high - slow[i].low < slow[tightSlow].high - slow[tightSlow].low) tightSlow = i;
        if (fast[i].high - fast[i].low < fast[tightFast].high - fast[tightFast].low) tightFast = i;
    }
    for (std::size_t i = 0; i < rows.count; ++i) {
        const ProfileRow& row = rows.rows[i];
        if (row.up > kUnlimited && row.down > kUnlimited) continue;
        const auto covers = [&](std::size_t other) {
            return i != other && slow[i].contains(slow[other]) && fast[i].contains(fast[other]) &&
                   (other < i || !(slow[other].contains(slow[i]) && fast[other].contains(fast[i])));
        };
        const bool isFlat = std::abs(row.first) < 1e-14;
        if (isFlat ? std::abs(row.second) * cap < std::min(row.up, row.down)
                   : covers(tightSlow) || covers(tightFast))
            continue;
        Term term;
        term.at = cell;
        const double unit = std::min(row.up, row.down);
        for (std::size_t k = 0; k < 3; ++k)
            term.row[k] = (row.first * at.slope[k] + row.second * at.place[k]) / unit;
        term.most = {std::min(row.up / unit, 1e6) * (1 - kMargin),
                     std::min(row.down / unit, 1e6) * (1 - kMargin)};
        term.limit = term.most;
        addTerm(term);
    }
}

void ProfileSolver::addJerks(std::size_t cell, const ProfileRows& rows, const Lines& at, const Three& change,
                             double cap) {
    double most = 1e7; // largest acceleration along the path
    for (std::size_t i = 0; i < rows.count; ++i)
        if (std::abs(rows.rows[i].first) > 1e-14)
            most = std::min(
                most, (std::max(rows.rows[i].up, rows.rows[i].down) + std::abs(rows.rows[i].second) * cap) /
                          std::abs(rows.rows[i].first));
    constexpr std::size_t kCorners = 6;
    std::array<std::array<Range, kCorners>, ProfileRows::kMost> ranges;
    std::size_t tight = 0;
    double least = 0;
    // With the square of the speed its bound falls; at the cap it is lowest.
    for (std::size_t i = 0; i < rows.count; ++i) {
        const ProfileRow& row = rows.rows[i];
        if (row.jerk > kUnlimited) continue;
        const double bound = row.jerk / std::sqrt(cap);
        for (std::size_t c = 0; c < kCorners; ++c) {
            const double a = most * (static_cast<double>(c % 3) - 1);
            const double square = c < 3 ? 0 : cap;
            ranges[i][c] = rangeOf(row.first, 3 * row.second * a + row.third * square, bound, bound);
        }
        const double stiffness = std::abs(row.first) / row.jerk;
        if (stiffness > least) {
            least = stiffness;
            tight = i;
        }
    }
    for (std::size_t i = 0; i < rows.count; ++i) {
        const ProfileRow& row = rows.rows[i];
        if (row.jerk > kUnlimited) continue;
        if (i != tight && least > 0) {
            bool isCovered = std::abs(row.first) > 1e-14;
            for (std::size_t c = 0; c < kCorners && isCovered; ++c)
                isCovered = ranges[i][c].contains(ranges[tight][c]);
            if (isCovered) continue;
        }
        const double unit = row.jerk / std::sqrt(cap);
        if (std::abs(row.first) < 1e-14 && 3 * std::abs(row.second) * most + std::abs(row.third) * cap < unit)
            continue;
        Term term;
        term.at = cell;
        term.isJerk = true;
        for (std::size_t k = 0; k < 3; ++k)
            term.row[k] =
                (row.first * change[k] + 3 * row.second * at.slope[k] + row.third * at.place[k]) / unit;
        term.square = at.place;
        const double bound = std::sqrt(cap) * kJerkShare;
        term.most = {bound, bound};
        addTerm(term);
    }
}

/// The outermost coefficients follow their neighbours when the path begins or ends at rest.
void ProfileSolver::addTerm(Term term) {
    for (auto* line : {&term.row, &term.square}) {
        if (term.at == 0 && startsAtRest_) {
            (*line)[1] += firstRatio_ * (*line)[0];
            (*line)[0] = 0;
        }
        if (term.at + 1 == cells_) {
            (*line)[1] += lastRatio_ * (*line)[2];
            (*line)[2] = 0;
        }
    }
    terms_.push_back(term);
}

void ProfileSolver::evaluate(Term& term) const {
    const double* c = &coefficient_[term.at];
    const double value = dot(term.row, c);
    if (term.isJerk) {
        const double inverse = 1 / std::sqrt(std::max(dot(term.square, c), 1e-12));
        term.limit = term.most * inverse;
        term.fall = 0.5 * term.limit[0] * inverse * inverse;
    }
    term.value = Pair{value, -value} - term.limit;
}

/// Whether all limits are kept.
bool ProfileSolver::evaluateTerms() {
    Pair worst{-1, -1};
    Pair sum{};
    for (Term& term : terms_) {
        evaluate(term);
        const Pair excess = term.value - term.limit * (kMargin / 2);
        worst = excess > worst ? excess : worst;
        sum += term.slack * term.force;
    }
    gap_ = sum[0] + sum[1];
    bool isKept = worst[0] <= 0 && worst[1] <= 0;
    for (std::size_t i = 0; i < cap_.size(); ++i) {
        gap_ += capSlack_[i] * capForce_[i];
        if (fixed_[i] == 0 && coefficient_[i] - cap_[i] > cap_[i] * kMargin / 2) isKept = false;
    }
    return isKept;
}

void ProfileSolver::begin() {
    const std::size_t count = coefficient_.size();
    for (auto* values : {&capSlack_, &capForce_, &capSlackStep_, &capForceStep_})
        values->assign(count, 0);
    double duration = 0;
    for (std::size_t i = 0; i < cells_; ++i)
        duration += width_[i] / std::sqrt(coefficient_[i + 1]);
    const double target = 0.5 * duration / static_cast<double>(2 * terms_.size() + count);
    for (std::size_t i = 0; i < count; ++i) {
        capSlack_[i] = std::max(cap_[i] - coefficient_[i], kLeastSlack * cap_[i]);
        capForce_[i] = fixed_[i] != 0 ? 0 : target / capSlack_[i];
    }
    for (Term& term : terms_) {
        evaluate(term);
        for (std::size_t side = 0; side < 2; ++side) {
            term.slack[side] = std::max(std::abs(term.value[side]), 0.1);
            term.force[side] = target / term.slack[side];
        }
    }
}

void ProfileSolver::assemble(double target) {
    target_ = target;
    const std::size_t count = coefficient_.size();
    for (std::size_t i = 0; i < count; ++i) {
        next_[i] = second_[i] = 0;
        if (fixed_[i] != 0) {
            diagonal_[i] = right_[i] = 0;
            continue;
        }
        const double weight = width_[std::min(i, cells_) - 1];
        const double root = std::sqrt(coefficient_[i]);
        const double slope = -0.5 * weight / (coefficient_[i] * root);
        const double ratio = capForce_[i] / capSlack_[i];
        const double miss = coefficient_[i] - cap_[i] + capSlack_[i];
        diagonal_[i] = -1.5 * slope / coefficient_[i] + ratio;
        right_[i] = -slope - target / capSlack_[i] - ratio * miss;
    }
    // The terms of a cell follow each other: their sums are added once.
    for (std::size_t i = 0; i < terms_.size();) {
        const std::size_t at = terms_[i].at;
        TermSums sums;
        for (; i < terms_.size() && terms_[i].at == at; ++i)
            addTo(sums, terms_[i], target);
        for (std::size_t k = 0; k < 3; ++k) {
            diagonal_[at + k] += sums.diagonal[k];
            right_[at + k] -= sums.right[k];
        }
        next_[at] += sums.next[0];
        next_[at + 1] += sums.next[1];
        second_[at] += sums.second;
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (fixed_[i] == 0) continue;
        diagonal_[i] = 1;
        right_[i] = next_[i] = second_[i] = 0;
        if (i > 0) next_[i - 1] = 0;
        if (i > 1) second_[i - 2] = 0;
    }
}

/// Five diagonals, positive definite.
bool ProfileSolver::factorAndSolve() {
    const std::size_t count = diagonal_.size();
    for (std::size_t i = 0; i < count; ++i) {
        const double pivot = diagonal_[i];
        if (!(pivot > 0) || !std::isfinite(pivot)) return false;
        const double one = next_[i] / pivot;
        const double two = second_[i] / pivot;
        if (i + 1 < count) {
            diagonal_[i + 1] -= one * next_[i];
            next_[i + 1] -= one * second_[i];
            right_[i + 1] -= one * right_[i];
        }
        if (i + 2 < count) {
            diagonal_[i + 2] -= two * second_[i];
            right_[i + 2] -= two * right_[i];
        }
        next_[i] = one;
        second_[i] = two;
        right_[i] /= pivot;
    }
    for (std::size_t i = count; i-- > 0;) {
        step_[i] = right_[i];
        if (i + 1 < count) step_[i] -= next_[i] * step_[i + 1];
        if (i + 2 < count) step_[i] -= second_[i] * step_[i + 2];
    }
    return true;
}

/// The longest step, at most 1, that keeps slacks, forces and squares of speeds positive.
ProfileSolver::Lengths ProfileSolver::stepLengths() {
    constexpr double kToBorder = 0.97;
    Lengths lengths{1 / kToBorder, 1 / kToBorder};
    const auto keep = [&](double& length, double value, double step) {
        if (step < 0) length = std::min(length, -value / step);
    };
    const std::size_t count = coefficient_.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (fixed_[i] != 0) continue;
        keep(lengths.speeds, coefficient_[i], step_[i]);
        keep(lengths.speeds, capSlack_[i],
             capSlackStep_[i] = cap_[i] - coefficient_[i] - capSlack_[i] - step_[i]);
        keep(lengths.forces, capForce_[i],
             capForceStep_[i] =
                 target_ / capSlack_[i] - capForce_[i] - capForce_[i] / capSlack_[i] * capSlackStep_[i]);
    }
    Pair slackShrink{}, forceShrink{}; // largest shares that are lost
    for (Term& term : terms_) {
        const double* step = &step_[term.at];
        const double along = dot(term.row, step);
        Pair change{along, -along};
        if (term.isJerk) change += term.fall * dot(term.square, step);
        term.slackStep = -(term.value + term.slack) - change;
        term.forceStep = (target_ - term.force * term.slackStep) * term.inverse - term.force;
        const Pair slackLoss = -term.slackStep * term.inverse;
        const Pair forceLoss = -term.forceStep / term.force;
        slackShrink = slackLoss > slackShrink ? slackLoss : slackShrink;
        forceShrink = forceLoss > forceShrink ? forceLoss : forceShrink;
    }
    const auto most = [](double length, const Pair& shrink) {
        return std::min(1.0, kToBorder * std::min(length, 1 / std::max({shrink[0], shrink[1], 1e-300})));
    };
    return {most(lengths.speeds, slackShrink), most(lengths.forces, forceShrink)};
}

void ProfileSolver::advance(const Lengths& lengths) {
    const std::size_t count = coefficient_.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (fixed_[i] != 0) continue;
        coefficient_[i] += lengths.speeds * step_[i];
        capSlack_[i] += lengths.speeds * capSlackStep_[i];
        capForce_[i] += lengths.forces * capForceStep_[i];
    }
    for (Term& term : terms_) {
        term.slack += lengths.speeds * term.slackStep;
        term.force += lengths.forces * term.forceStep;
    }
    if (startsAtRest_) coefficient_[0] = firstRatio_ * coefficient_[1];
    coefficient_[count - 1] = lastRatio_ * coefficient_[count - 2];
}

/// How far the forces are from holding the coefficients in balance, as the time that a change by their own size gains, s.
double ProfileSolver::imbalance() {
    const std::size_t count = coefficient_.size();
    step_.assign(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
        if (fixed_[i] != 0) continue;
        const double weight = width_[std::min(i, cells_) - 1];
        step_[i] = capForce_[i] - 0.5 * weight / (coefficient_[i] * std::sqrt(coefficient_[i]));
    }
    for (const Term& term : terms_) {
        const double odd = term.force[0] - term.force[1];
        const double even = term.isJerk ? term.fall * (term.force[0] + term.force[1]) : 0;
        for (std::size_t k = 0; k < 3; ++k)
            step_[term.at + k] += odd * term.row[k] + even * term.square[k];
    }
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i)
        if (fixed_[i] == 0) sum += std::abs(step_[i]) * coefficient_[i];
    return sum;
}

/// Largest limit that is passed, as a share of it.
double ProfileSolver::worstExcess() const {
    double worst = -1;
    for (std::size_t i = 0; i < cap_.size(); ++i)
        if (fixed_[i] == 0) worst = std::max(worst, (coefficient_[i] - cap_[i]) / cap_[i] - kMargin / 2);
    for (const Term& term : terms_) {
        const Pair excess = term.value / term.limit;
        worst = std::max({worst, excess[0] - kMargin / 2, excess[1] - kMargin / 2});
    }
    return worst;
}

} // namespace motion
