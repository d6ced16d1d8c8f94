// ProfileSolver: the fastest speed along a path. Compared with exact courses, with a fine grid without limits of jerk
// (largest speeds backward from the end, then forward), and with a converged optimum on another, finer grid.

#include "runtime/motion/axis_profile.h"
#include "runtime/motion/course.h"
#include "runtime/motion/profile_grid.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <random>

using namespace motion;

namespace {

/// Derivatives of the axes at a place.
struct Bend {
    std::array<std::array<double, 3>, 3> axes; ///< first to third derivative of each axis
};
using Path = std::function<Bend(double)>;

struct Problem {
    Path path;
    double length = 0, speed = 0, acceleration = 0, jerk = 0;
};

ProfileRows rowsOf(const Problem& problem, double place) {
    ProfileRows rows;
    for (const auto& d : problem.path(place).axes)
        rows.add({d[0], d[1], d[2], problem.acceleration, problem.acceleration, problem.jerk});
    return rows;
}

std::vector<ProfileCell> cellsOf(const Problem& problem, int count) {
    std::vector<ProfileCell> cells(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        ProfileCell& cell = cells[static_cast<std::size_t>(i)];
        cell.width = problem.length / count;
        cell.mostSquare = problem.speed * problem.speed;
        cell.first = rowsOf(problem, cell.width * i);
        cell.last = rowsOf(problem, cell.width * (i + 1));
    }
    return cells;
}

struct Solved {
    ProfileGrid grid;
    ProfileSolver::Result result;
    double duration = 0;
};

Solved solve(const Problem& problem, int count) {
    Solved solved;
    solved.grid = gridOf(cellsOf(problem, count), {});
    solved.result = ProfileSolver().solve(solved.grid.cells, solved.grid.start, solved.grid.endWidth);
    REQUIRE(solved.result.isSolved);
    const auto& knots = solved.result.knots;
    solved.duration =
        3 * solved.grid.start.restWidth / knots.front().v + 3 * solved.grid.endWidth / knots.back().v;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        const double way = knots[i + 1].s - knots[i].s;
        solved.duration +=
            Course::secondsFor(way, knots[i].v, knots[i + 1].v, (knots[i + 1].a - knots[i].a) / way);
    }
    return solved;
}

/// Largest use of a limit inside the cells, with the derivatives of the path itself.
double worstUse(const Problem& problem, const Solved& solved) {
    double worst = 0;
    const auto& knots = solved.result.knots;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        const double way = knots[i + 1].s - knots[i].s;
        const double bend = (knots[i + 1].a - knots[i].a) / way;
        for (int k = 0; k <= 4; ++k) {
            const double x = way * k / 4;
            const double square = knots[i].v * knots[i].v + x * (2 * knots[i].a + bend * x);
            const double a = knots[i].a + bend * x;
            const double v = std::sqrt(square);
            worst = std::max(worst, v / problem.speed);
            const double place = solved.grid.start.restWidth + knots[i].s + x;
            for (const auto& d : problem.path(place).axes) {
                worst = std::max(worst, std::abs(d[0] * a + d[1] * square) / problem.acceleration);
                const double jerk = v * (d[0] * bend + 3 * d[1] * a + d[2] * square);
                worst = std::max(worst, std::abs(jerk) / problem.jerk);
            }
        }
    }
    return worst;
}

double squareAt(const Solved& solved, double place) {
    const auto& knots = solved.result.knots;
    const double s = place - solved.grid.start.restWidth;
    if (s < 0) return std::pow(knots.front().v, 2) * std::pow(place / solved.grid.start.restWidth, 4.0 / 3);
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        if (s > knots[i + 1].s) continue;
        const double way = knots[i + 1].s - knots[i].s;
        const double x = s - knots[i].s;
        return knots[i].v * knots[i].v + x * (2 * knots[i].a + (knots[i + 1].a - knots[i].a) / way * x);
    }
    const double left = std::max(0.0, 1 - (s - knots.back().s) / solved.grid.endWidth);
    return std::pow(knots.back().v, 2) * std::pow(left, 4.0 / 3);
}

/// Waves of three axes.
Path waves(std::array<double, 3> size, std::array<double, 3> rate, std::array<double, 3> phase) {
    return [=](double s) {
        Bend bend{};
        for (std::size_t i = 0; i < 3; ++i) {
            const double x = rate[i] * s + phase[i];
            bend.axes[i] = {size[i] * rate[i] * std::cos(x), -size[i] * rate[i] * rate[i] * std::sin(x),
                            -size[i] * std::pow(rate[i], 3) * std::cos(x)};
        }
        return bend;
    };
}

Problem randomProblem(std::mt19937_64& random) {
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::array<double, 3> size{}, rate{}, phase{};
    for (std::size_t i = 0; i < 3; ++i) {
        rate[i] = between(0.005, 0.03);
        size[i] = between(0.3, 1) / rate[i];
        phase[i] = between(0, 6);
    }
    return {waves(size, rate, phase), between(100, 300), between(200, 1500), between(1000, 6000),
            between(20'000, 120'000)};
}

constexpr int kSteps = 4000;

/// The shortest time without limits of jerk, on a fine grid: backward from rest, forward from rest.
double durationWithoutJerk(const Problem& problem) {
    const double h = problem.length / kSteps;
    const double cap = problem.speed * problem.speed;
    std::vector<std::array<std::array<double, 2>, 3>> rows(kSteps);
    for (int i = 0; i < kSteps; ++i) {
        const Bend bend = problem.path(h * (i + 0.5));
        for (std::size_t k = 0; k < 3; ++k)
            rows[static_cast<std::size_t>(i)][k] = {bend.axes[k][0], bend.axes[k][1]};
    }
    // Squares x and y at both ends of a step keep first (y - x) / 2h + second (x + y) / 2 within the acceleration. The largest
    // of one of them for which the other is possible up to `bound` lies where two of these lines meet.
    const auto largest = [&](std::size_t i, double bound, bool backward) {
        std::vector<std::array<double, 3>> lines{
            {1, 0, cap}, {-1, 0, 0}, {0, 1, bound}, {0, -1, 0}}; // sought, other
        for (const auto& [first, second] : rows[i]) {
            const double change = first / (2 * h), mean = 0.5 * second;
            const double sought = backward ? mean - change : mean + change;
            const double other = backward ? mean + change : mean - change;
            lines.push_back({sought, other, problem.acceleration});
            lines.push_back({-sought, -other, problem.acceleration});
        }
        double most = 0;
        for (std::size_t a = 0; a < lines.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                const double det = lines[a][0] * lines[b][1] - lines[a][1] * lines[b][0];
                if (std::abs(det) < 1e-14) continue;
                const double x = (lines[a][2] * lines[b][1] - lines[a][1] * lines[b][2]) / det;
                const double y = (lines[a][0] * lines[b][2] - lines[a][2] * lines[b][0]) / det;
                if (x <= most) continue;
                bool isPossible = true;
                for (const auto& line : lines)
                    isPossible = isPossible && line[0] * x + line[1] * y <= line[2] * (1 + 1e-9) + 1e-9;
                if (isPossible) most = x;
            }
        }
        return most;
    };
    // Forward from one known square: rows are intervals for the next one.
    const auto next = [&](std::size_t i, double known) {
        double most = cap;
        for (const auto& [first, second] : rows[i]) {
            const double other = 0.5 * second + first / (2 * h);
            const double own = 0.5 * second - first / (2 * h);
            if (std::abs(other) < 1e-14) continue;
            most = std::min(most, std::max((problem.acceleration - own * known) / other,
                                           (-problem.acceleration - own * known) / other));
        }
        return std::max(0.0, most);
    };
    std::vector<double> squares(kSteps + 1, 0);
    for (std::size_t i = kSteps; i-- > 0;)
        squares[i] = largest(i, squares[i + 1], true);
    squares[0] = 0;
    double duration = 0;
    for (std::size_t i = 0; i < kSteps; ++i) {
        squares[i + 1] = std::min(squares[i + 1], next(i, squares[i]));
        duration += 2 * h / (std::sqrt(squares[i]) + std::sqrt(squares[i + 1]));
    }
    return duration;
}

/// The optimum with limits of jerk by a different way: squares of the speed at places that are dense near rest, differences
/// between them, and a barrier with Newton steps on full matrices.
class Reference {
  public:
    explicit Reference(const Problem& problem) : problem_(problem) {
        constexpr int kPoints = 160;
        for (int i = 0; i <= kPoints; ++i) {
            const double u = static_cast<double>(i) / kPoints;
            places_.push_back(problem.length * u * u * u * (10 + u * (-15 + 6 * u)));
        }
        for (const double place : places_)
            bends_.push_back(problem.path(place));
    }

    /// The shortest time near a profile, whose squares of the speed `squareOf` gives.
    double durationNear(const std::function<double(double)>& squareOf) {
        const auto count = static_cast<Eigen::Index>(places_.size()) - 2;
        Eigen::VectorXd x(count);
        for (Eigen::Index i = 0; i < count; ++i) {
            x[i] = squareOf(places_[static_cast<std::size_t>(i) + 1]);
        }
        x *= 0.9;
        while (!std::isfinite(value(x, 1)))
            x *= 0.9;
        for (double weight = 3e-5; weight > 2e-7; weight *= 0.4)
            for (int k = 0; k < 30 && newton(x, weight); ++k) {
            }
        return time(x);
    }

  private:
    struct Row {
        std::array<double, 3> w; // of the squares before, at and after the place
        double bound;
        bool isJerk;
    };

    std::vector<Row> rowsAt(std::size_t i) const {
        const double before = places_[i] - places_[i - 1];
        const double after = places_[i + 1] - places_[i];
        const double sum = before + after;
        const std::array<double, 3> a{-0.5 * after / (before * sum),
                                      0.5 * (after - before) / (before * after),
                                      0.5 * before / (after * sum)};
        const std::array<double, 3> bend{1 / (before * sum), -1 / (before * after), 1 / (after * sum)};
        std::vector<Row> rows;
        for (const auto& d : bends_[i].axes) {
            Row acceleration{{}, problem_.acceleration, false};
            Row jerk{{}, problem_.jerk, true};
            for (std::size_t k = 0; k < 3; ++k) {
                const double at = k == 1 ? 1 : 0;
                acceleration.w[k] = d[0] * a[k] + d[1] * at;
                jerk.w[k] = d[0] * bend[k] + 3 * d[1] * a[k] + d[2] * at;
            }
            rows.push_back(acceleration);
            rows.push_back(jerk);
        }
        return rows;
    }

    /// Largest square of the speed; near rest that which constant jerk reaches: jerk = 2/9 square^(3/2) / way^2.
    double capAt(std::size_t i) const {
        double most = problem_.speed * problem_.speed;
        const double fromEnd = std::min(places_[i], problem_.length - places_[i]);
        if (i > 1 && i + 2 < places_.size()) return most;
        for (const auto& d : bends_[i].axes) {
            const double root = 4.5 * problem_.jerk / std::max(std::abs(d[0]), 1e-9) * fromEnd * fromEnd;
            most = std::min(most, std::cbrt(root * root));
        }
        return most;
    }

    double squareAt(const Eigen::VectorXd& x, std::size_t i) const {
        return i == 0 || i + 1 == places_.size() ? 0 : x[static_cast<Eigen::Index>(i) - 1];
    }

    double time(const Eigen::VectorXd& x) const {
        double sum = 0;
        for (std::size_t i = 0; i + 1 < places_.size(); ++i) {
            // From and to rest with constant jerk it takes half as long again as at the mean of the speeds.
            const bool isRest = i == 0 || i + 2 == places_.size();
            sum += (isRest ? 1.5 : 1) * 2 * (places_[i + 1] - places_[i]) /
                   (std::sqrt(squareAt(x, i)) + std::sqrt(squareAt(x, i + 1)));
        }
        return sum;
    }

    double value(const Eigen::VectorXd& x, double weight) const {
        double sum = time(x);
        for (std::size_t i = 1; i + 1 < places_.size(); ++i) {
            const double square = squareAt(x, i);
            const double room = capAt(i) - square;
            if (!(square > 0) || !(room > 0)) return HUGE_VAL;
            sum -= weight * std::log(room / capAt(i));
            for (const Row& row : rowsAt(i)) {
                const double use =
                    row.w[0] * squareAt(x, i - 1) + row.w[1] * square + row.w[2] * squareAt(x, i + 1);
                const double bound = row.isJerk ? row.bound / std::sqrt(square) : row.bound;
                if (!(std::abs(use) < bound)) return HUGE_VAL;
                sum -= weight * std::log((bound - use) * (bound + use) / (row.bound * row.bound));
            }
        }
        return sum;
    }

    bool newton(Eigen::VectorXd& x, double weight) const {
        const Eigen::Index count = x.size();
        Eigen::MatrixXd second = Eigen::MatrixXd::Zero(count, count);
        Eigen::VectorXd first = Eigen::VectorXd::Zero(count);
        for (Eigen::Index i = 0; i < count; ++i) { // the time, by differences of its two terms
            const double step = 1e-4 * x[i];
            const auto near = [&](double change) {
                const std::size_t at = static_cast<std::size_t>(i) + 1;
                const double root = std::sqrt(x[i] + change);
                const double left = std::sqrt(squareAt(x, at - 1)), right = std::sqrt(squareAt(x, at + 1));
                return (at == 1 ? 3 : 2) * (places_[at] - places_[at - 1]) / (left + root) +
                       (at + 2 == places_.size() ? 3 : 2) * (places_[at + 1] - places_[at]) / (root + right);
            };
            const double low = near(-step), mid = near(0), high = near(step);
            first[i] += (high - low) / (2 * step);
            second(i, i) += std::max(0.0, (high - 2 * mid + low) / (step * step));
        }
        for (std::size_t i = 1; i + 1 < places_.size(); ++i) {
            const Eigen::Index own = static_cast<Eigen::Index>(i) - 1;
            const double square = x[own];
            const double room = capAt(i) - square;
            first[own] += weight / room;
            second(own, own) += weight / (room * room);
            for (const Row& row : rowsAt(i)) {
                const double use =
                    row.w[0] * squareAt(x, i - 1) + row.w[1] * square + row.w[2] * squareAt(x, i + 1);
                const double bound = row.isJerk ? row.bound / std::sqrt(square) : row.bound;
                for (const double sign : {1.0, -1.0}) {
                    const double left = bound - sign * use;
                    std::array<double, 3> g{sign * row.w[0], sign * row.w[1], sign * row.w[2]};
                    if (row.isJerk) g[1] += 0.5 * bound / square;
                    for (std::size_t j = 0; j < 3; ++j) {
                        const Eigen::Index a = own + static_cast<Eigen::Index>(j) - 1;
                        if (a < 0 || a >= count) continue;
                        first[a] += weight * g[j] / left;
                        for (std::size_t k = 0; k < 3; ++k) {
                            const Eigen::Index b = own + static_cast<Eigen::Index>(k) - 1;
                            if (b >= 0 && b < count) second(a, b) += weight * g[j] * g[k] / (left * left);
                        }
                    }
                }
            }
        }
        const Eigen::VectorXd step = second.ldlt().solve(-first);
        const double now = value(x, weight);
        double length = 1;
        while (length > 1e-8 && !(value(x + length * step, weight) < now))
            length *= 0.6;
        if (length <= 1e-8) return false;
        x += length * step;
        return now - value(x, weight) > 1e-9 * std::abs(now);
    }

    const Problem& problem_;
    std::vector<double> places_;
    std::vector<Bend> bends_;
};

Path straight() {
    return [](double) {
        Bend bend{};
        bend.axes[0] = {1, 0, 0};
        return bend;
    };
}

} // namespace

TEST_CASE("on a straight path the profile is the exact one from rest to rest", "[motion][profile]") {
    for (const double speed : {50.0, 300.0, 1000.0, 5000.0}) {
        for (const double length : {0.001, 1.0, 10.0, 100.0, 1000.0}) {
            const Problem problem{straight(), length, speed, 5000, 100'000};
            const Solved solved = solve(problem, std::max(1, static_cast<int>(length / 10)));
            const double exact = AxisProfile::restToRest(0, length, {speed, 5000, 100'000}).duration();
            INFO("speed " << speed << ", length " << length);
            CHECK(solved.duration >= exact * (1 - 1e-9));
            CHECK(solved.duration <= exact * 1.01);
            CHECK(worstUse(problem, solved) <= 1 + 1e-6);
        }
    }
}

TEST_CASE("without limits of jerk the profile is that of a fine grid", "[motion][profile]") {
    std::mt19937_64 random(2);
    for (int n = 0; n < 20; ++n) {
        Problem problem = randomProblem(random);
        problem.jerk = 1e9;
        const double exact = durationWithoutJerk(problem);
        const double found = solve(problem, 300).duration;
        INFO("path " << n << ": " << found / exact);
        CHECK(found <= exact * 1.002);
        CHECK(found >= exact * 0.999);
    }
}

TEST_CASE("with limits of jerk the profile is near a converged optimum", "[motion][profile]") {
    std::mt19937_64 random(4);
    for (int n = 0; n < 8; ++n) {
        const Problem problem = randomProblem(random);
        const Solved solved = solve(problem, 60);
        const double optimum =
            Reference(problem).durationNear([&](double place) { return squareAt(solved, place); });
        INFO("path " << n << ": " << solved.duration << " s, optimum " << optimum << " s");
        CHECK(solved.duration <= optimum * 1.03);
        CHECK(solved.duration >= optimum * 0.98); // else the reference would not have converged
        CHECK(worstUse(problem, solved) <= 1.02); // derivatives are given every 2 to 5 mm only
    }
}

TEST_CASE("a start that cannot be kept within the limits is reported", "[motion][profile]") {
    const Problem problem{straight(), 10, 5000, 1000, 20'000};
    const ProfileGrid grid = gridOf(cellsOf(problem, 10), {1000, 0, 0}); // 500 mm would be needed
    CHECK_FALSE(ProfileSolver().solve(grid.cells, grid.start, grid.endWidth).isSolved);
}
