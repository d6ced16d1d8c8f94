#include "runtime/motion/optimal_plan.h"

#include "runtime/motion/tolerances.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

constexpr double kSliver = 1e-6; // mm, of a cell that is not worth planning
constexpr double kTick = 0.001;  // s, at which the result is checked
// Shares of the limits in the check: samples may lie elsewhere later, and a jerk changes faster than an acceleration.
constexpr double kAllowed = 0.9985;
constexpr double kAllowedJerk = 0.99;
constexpr double kKeptLead =
    0.25; // s before the arm would brake, from which on a longer path is planned again

/// Writes what was found into the course, from the place `begin` on.
void takeProfile(Course& course, double begin, const ProfileGrid& grid, const ProfileSolver::Result& found) {
    const auto& knots = found.knots;
    double place = begin;
    if (!(grid.start.v > 0)) { // the speed grows with the square of the time
        const double seconds = 3 * grid.start.restWidth / knots.front().v;
        place += grid.start.restWidth;
        course.follow(0, 0, {2 * knots.front().v / (seconds * seconds), 0}, seconds, place);
    }
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
        const double way = knots[i + 1].s - knots[i].s;
        const double bend = (knots[i + 1].a - knots[i].a) / way;
        course.follow(knots[i].v, knots[i].a, {0, bend},
                      Course::secondsFor(way, knots[i].v, knots[i + 1].v, bend), place + knots[i + 1].s);
    }
    place += knots.back().s;
    const double seconds = 3 * grid.endWidth / knots.back().v;
    course.follow(knots.back().v, -2 * knots.back().v / seconds,
                  {2 * knots.back().v / (seconds * seconds), 0}, seconds, place + grid.endWidth);
    course.rest(0);
}

/// Largest share of a limit that a row takes at this state of the place and jerk.
double useOf(const ProfileRow& row, const CourseState& state, double jerk) {
    const double acceleration = row.first * state.a + row.second * state.v * state.v;
    const double change =
        row.first * jerk + state.v * (3 * row.second * state.a + row.third * state.v * state.v);
    return std::max({acceleration / row.up, -acceleration / row.down, std::abs(change) / row.jerk});
}

} // namespace

void OptimalPlan::measure(const Route& route, std::size_t from) {
    const auto& stretches = route.stretches();
    cells_.resize(from);
    begins_.resize(from);
    for (std::size_t i = from; i < stretches.size(); ++i) {
        cells_.push_back(measuredCell(route, stretches[i], limits_));
        begins_.push_back(stretches[i].begin);
        if (i > 0) joinCells(cells_[i - 1], cells_[i]);
    }
}

void OptimalPlan::forget(std::size_t stretches) {
    cells_.forget(stretches);
    begins_.forget(stretches);
}

std::size_t OptimalPlan::cellAt(double place) const {
    const std::size_t begun = begins_.countUpTo(place, [](double begin) { return begin; });
    return begun == 0 ? 0 : begun - 1;
}

std::vector<ProfileCell> OptimalPlan::pathBetween(double from, double to, double share) const {
    std::vector<ProfileCell> path;
    double sliver = 0;
    for (std::size_t i = cellAt(from); i < cells_.size() && begins_[i] < to; ++i) {
        const double width = cells_[i].width;
        const double begin = std::max(0.0, from - begins_[i]);
        const double end = std::min(width, to - begins_[i]);
        if (end - begin < kSliver && !(path.empty() && i + 1 == cells_.size())) {
            (path.empty() ? sliver : path.back().width) += std::max(0.0, end - begin);
            continue;
        }
        path.push_back(partOf(cells_[i], begin / width, end / width));
        path.back().width = end - begin + sliver;
        sliver = 0;
        path.back().mostSquare = cells_[i].mostSquare * share * share;
    }
    return path;
}

// ---- To the end of the route ----

bool OptimalPlan::plan(Course& course, const Route& route, double now, double changed, double share) {
    const bool isSameShare = share == share_;
    const double begun = std::max(now, course.begin());
    std::optional<Course> found; // the first one, until one keeps all limits at each tick
    if (isSameShare && course.plannedEnd() > begun) {
        double kept =
            std::min(course.lastBraking() - kKeptLead, course.plannedTimeAt(changed) - 0.5 * kKeptLead);
        for (double earlier = 0.1; kept > begun + 0.02 && kept > course.begin() + 0.1; earlier *= 2) {
            Course candidate = course;
            if (planFrom(candidate, route, kept, share)) {
                if (keepsTicks_ || !found) found = std::move(candidate);
                if (keepsTicks_) break;
            }
            kept -= earlier;
        }
    }
    if (!found || !keepsTicks_) {
        Course candidate = course;
        if (planFrom(candidate, route, begun, share) && (keepsTicks_ || !found)) found = std::move(candidate);
    }
    // At this moment the plan may be so close to a limit that no other one begins there: a little later, before the change.
    constexpr double kLater = 0.008; // s
    const double last = isSameShare ? std::min(course.plannedTimeAt(changed), course.plannedEnd()) : begun;
    for (double later = kLater; !found && begun + later < last; later += kLater) {
        Course candidate = course;
        if (planFrom(candidate, route, begun + later, share)) found = std::move(candidate);
    }
    if (!found) return false;
    course = std::move(*found);
    share_ = share;
    return true;
}

/// At another override, or under new limits of speed, the arm may have to slow down first.
bool OptimalPlan::planFrom(Course& course, const Route& route, double time, double share) {
    const CourseState state = course.plannedAt(time);
    if (state.s >= length() - kNothing) return false;
    const double most = cells_[cellAt(state.s)].mostSquare * share * share;
    const bool isTooFast = state.v * state.v > most * (1 + 1e-6);
    if (!isTooFast && solveFrom(course, route, time, state, share)) return true;
    if (!(state.v > 0) || !(isTooFast || share < share_)) return false;
    for (const double part : {0.999, 0.7, 0.4, 0.2}) {
        const double way = state.v * 0.3;
        const double speed = part * std::sqrt(mostSquareAhead(state.s, way, share));
        const auto slower = slowing(course, time, speed);
        if (!slower) continue;
        Course candidate = course;
        candidate.cutAfter(slower->begin);
        follow(candidate, *slower);
        const AxisState end = slower->ramp.end(slower->from);
        if (end.p >= length() - kSliver) continue;
        if (!solveFrom(candidate, route, candidate.plannedEnd(), {end.p, end.v, 0}, share)) continue;
        course = std::move(candidate);
        return true;
    }
    return false;
}

double OptimalPlan::mostSquareAhead(double place, double way, double share) const {
    double square = 1e8;
    for (std::size_t i = cellAt(place); i < cells_.size() && begins_[i] <= place + way; ++i)
        square = std::min(square, cells_[i].mostSquare);
    return square * share * share;
}

/// AccSet \FinePointRamp: the jerk is lower on the way on which deceleration decreases towards the stop point.
void OptimalPlan::softenEnd(std::vector<ProfileCell>& path) const {
    if (!(endRampShare_ < 1)) return;
    double acceleration = 1e7, jerk = 1e9;
    const ProfileRows& end = path.back().last;
    for (std::size_t r = 0; r < end.count; ++r) {
        const double rate = std::max(std::abs(end.rows[r].first), 1e-12);
        acceleration = std::min(acceleration, std::min(end.rows[r].up, end.rows[r].down) / rate);
        jerk = std::min(jerk, endRampShare_ * end.rows[r].jerk / rate);
    }
    const double speed = std::sqrt(path.back().mostSquare);
    double left = std::min(acceleration * acceleration * acceleration / (6 * jerk * jerk),
                           speed * std::sqrt(2 * speed / jerk) / 3);
    for (auto cell = path.rbegin(); cell != path.rend() && left > 0; ++cell) {
        left -= cell->width;
        for (ProfileRows* rows : {&cell->first, &cell->last})
            for (std::size_t r = 0; r < rows->count; ++r)
                rows->rows[r].jerk *= endRampShare_;
    }
}

bool OptimalPlan::solveFrom(Course& course, const Route& route, double time, const CourseState& state,
                            double share) {
    constexpr double kStanding = 1e-6; // mm/s
    ProfileStart start;
    if (state.v > kStanding) start = {state.v, state.a, 0};
    bool isPlanned = false;
    keepsTicks_ = false;
    constexpr int kMostRounds = 16;
    for (int round = 0; round < kMostRounds; ++round) {
        std::vector<ProfileCell> path = pathBetween(state.s, length(), share);
        if (path.empty()) return false;
        softenEnd(path);
        ProfileGrid grid;
        ProfileSolver::Result found;
        for (const double firstShare : {1.0, 0.2}) {
            grid = gridOf(path, start, firstShare);
            found = solver_.solve(grid.cells, grid.start, grid.endWidth);
            if (found.isSolved || !(start.v > 0)) break;
        }
        if (!found.isSolved) return isPlanned;
        course.cutAfter(time);
        if (course.plannedEnd() < time) course.rest(time - course.plannedEnd());
        takeProfile(course, state.s, grid, found);
        isPlanned = true;
        keepsTicks_ = !tightenWhereExceeded(course, route, time, share, round);
        if (keepsTicks_) break;
    }
    return true;
}

/// Largest shares of the limits that the axes take, by four samples of the course a tick apart.
OptimalPlan::Use OptimalPlan::useAt(const Route& route, const std::array<const Joints*, 4>& axes,
                                    double place) const {
    const Joints &first = *axes[0], &here = *axes[1], &next = *axes[2], &last = *axes[3];
    Joints most = here;
    limits_.accelerations->limitsAt(here, most);
    const MoveLimits& limits = route.leg(route.legAt(place)).limits;
    Use use;
    for (std::size_t i = 0; i < most.size(); ++i) {
        const double bend = next[i] - 2 * here[i] + first[i];
        const double nextBend = last[i] - 2 * next[i] + here[i];
        const double acceleration = limits.accelerationShare[i] * most[i] * kTick * kTick;
        const double jerk = limits.rampShare * limits_.jerk[i] * kTick * kTick * kTick;
        use.acceleration = std::max(use.acceleration, std::abs(bend) / acceleration);
        use.jerk = std::max(use.jerk, std::abs(nextBend - bend) / jerk);
    }
    return use;
}

/// Lowers what a cell allows, in proportion to what was exceeded at this speed of the route.
void OptimalPlan::tighten(ProfileCell& cell, const Use& use, double speed, int round) {
    constexpr double kBent = 1.02; // more is a bend that is sharper than a stretch shows: slower there
    const double lower = 0.999 - 0.003 * round; // than necessary, for an end after few rounds
    const double bend = std::max(std::sqrt(use.acceleration), std::cbrt(use.jerk));
    if (std::max(use.acceleration, use.jerk) > kBent)
        cell.mostSquare = std::min(cell.mostSquare, std::pow(std::min(lower, 0.99) * speed / bend, 2));
    const auto lowered = [&](double used, double allowed) {
        return used > allowed ? lower * allowed / std::min(used, kBent) : 1.0;
    };
    const double acceleration = lowered(use.acceleration, kAllowed);
    const double jerk = lowered(use.jerk, kAllowedJerk);
    for (ProfileRows* rows : {&cell.first, &cell.last}) {
        for (std::size_t r = 0; r < rows->count; ++r) {
            rows->rows[r].up *= acceleration;
            rows->rows[r].down *= acceleration;
            rows->rows[r].jerk *= jerk;
        }
    }
}

bool OptimalPlan::tightenWhereExceeded(const Course& course, const Route& route, double time, double share,
                                       int round) {
    constexpr std::size_t kPhases = 2; // a reader's ticks may lie between those of the check
    constexpr double kStep = kTick / kPhases;
    constexpr std::size_t kLast = 3 * kPhases;
    struct Sample {
        double place = 0;
        Joints axes;
    };
    std::array<Sample, kLast + 1> samples; // the latest ones, each overwrites the oldest
    std::vector<Use> uses(cells_.size());
    std::vector<double> speeds(cells_.size(), 0);
    bool isExceeded = false;
    const auto count = static_cast<std::size_t>((course.plannedEnd() - time) / kStep) + 2 * kLast;
    constexpr std::size_t kTogether = 3;
    std::array<double, kTogether> places{}; // of this sample and the next ones
    std::array<RoutePoint, kTogether> points;
    for (std::size_t k = 0; k < count; ++k) {
        if (k % kTogether == 0) {
            for (std::size_t i = 0; i < kTogether; ++i) {
                // The ticks before are those of the plan before, up to the moment from which on it is another.
                const double moment = time + (static_cast<double>(k + i) - 2 * kPhases) * kStep;
                places[i] = course.plannedAt(moment).s;
            }
            route.at(places, points);
        }
        const double place = places[k % kTogether];
        samples[k % samples.size()] = {place, points[k % kTogether].joints};
        if (k < kLast) continue;
        const auto at = [&](std::size_t i) -> const Sample& {
            return samples[(k - kLast + i) % samples.size()];
        };
        const Use use = useAt(route, {&at(0).axes, &at(kPhases).axes, &at(2 * kPhases).axes, &at(kLast).axes},
                              at(kPhases).place);
        if (use.acceleration <= kAllowed && use.jerk <= kAllowedJerk) continue;
        isExceeded = true;
        const double speed = (place - at(0).place) / (3 * kTick * share);
        const std::size_t last = cellAt(place);
        for (std::size_t i = cellAt(at(0).place); i <= last; ++i) {
            uses[i].acceleration = std::max(uses[i].acceleration, use.acceleration);
            uses[i].jerk = std::max(uses[i].jerk, use.jerk);
            speeds[i] = std::max(speeds[i], speed);
        }
    }
    for (std::size_t i = 0; i < cells_.size(); ++i)
        if (speeds[i] > 0) tighten(cells_[i], uses[i], speeds[i], round);
    return isExceeded;
}

// ---- Slowing down ----

bool OptimalPlan::keepsLimits(const Slowing& slowing, const Course& course) const {
    constexpr double kSpacing = 0.7; // mm between the places that are checked
    constexpr double kRounding = 1 + 1e-7;
    AxisState from = slowing.from;
    for (std::size_t piece = 0; piece < 3; ++piece) {
        const double jerk = slowing.ramp.jerkOf(piece);
        const double time = slowing.ramp.time[piece];
        const int samples = std::clamp(static_cast<int>(from.v * time / kSpacing), 10, 400);
        for (int k = 0; k <= samples; ++k) {
            const AxisState at = advanced(from, jerk, time * k / samples);
            if (at.p > length() + kNothing || at.v < -1e-6) return false;
            const std::size_t i = cellAt(at.p);
            const ProfileCell& cell = cells_[i];
            const ProfileRows rows = rowsAt(cell, std::clamp((at.p - begins_[i]) / cell.width, 0.0, 1.0));
            const bool isFirst = piece == 0 && k == 0;
            // Limits that have been lowered are exceeded for some time, but no further than before.
            if (at.v * at.v > cell.mostSquare * share_ * share_ * kRounding &&
                at.v > kRounding * course.plannedAt(course.plannedTimeAt(at.p)).v)
                return false;
            for (std::size_t r = 0; r < rows.count && !isFirst; ++r)
                if (useOf(rows.rows[r], {at.p, at.v, at.a}, jerk) > kRounding) return false;
        }
        from = advanced(from, jerk, slowing.ramp.time[piece]);
    }
    return true;
}

std::optional<OptimalPlan::Slowing> OptimalPlan::slowing(const Course& course, double now,
                                                         double speed) const {
    std::optional<Slowing> best;
    double ended = course.plannedEnd();
    for (double delay = 0; now + delay < ended; delay = delay == 0 ? 0.002 : 1.3 * delay) {
        const CourseState state = course.plannedAt(now + delay);
        if (state.v <= speed) break;
        Slowing candidate;
        candidate.begin = now + delay;
        candidate.from = {state.s, state.v, state.a};
        double acceleration = 1e7;
        double jerk = 1e9;
        const std::size_t here = cellAt(state.s);
        const ProfileRows rows = rowsAt(cells_[here], (state.s - begins_[here]) / cells_[here].width);
        for (std::size_t r = 0; r < rows.count; ++r) {
            const double rate = std::max(std::abs(rows.rows[r].first), 1e-12);
            acceleration = std::min(acceleration, std::min(rows.rows[r].up, rows.rows[r].down) / rate);
            jerk = std::min(jerk, rows.rows[r].jerk / rate);
        }
        for (double share = 1.3; share > 0.03; share *= 0.85) {
            candidate.ramp = rampTo(speed, candidate.from, share * acceleration, share * jerk);
            const double end = candidate.begin + candidate.ramp.duration();
            if (end >= ended) break;
            if (!keepsLimits(candidate, course)) continue;
            best = candidate;
            ended = end;
            break;
        }
    }
    return best;
}

void OptimalPlan::follow(Course& course, const Slowing& slowing) {
    AxisState at = slowing.from;
    for (std::size_t piece = 0; piece < 3; ++piece) {
        const double jerk = slowing.ramp.jerkOf(piece);
        const AxisState next = advanced(at, jerk, slowing.ramp.time[piece]);
        course.follow(at.v, at.a, {jerk, 0}, slowing.ramp.time[piece], next.p);
        at = next;
    }
}

/// The course as it comes to rest when it brakes after `now`.
Course OptimalPlan::stopped(const Course& course, double now) const {
    constexpr double kAtOnce = 0.01; // s
    const auto ramp = slowing(course, now, 0);
    Course result = course;
    const CourseState state = course.plannedAt(now);
    const double last = ramp ? ramp->ramp.end(ramp->from).p : course.endPlace();
    const bool isLate = !ramp || ramp->begin > now + kAtOnce;
    // On a path that bends much, no even braking keeps the limits: the nearest place at which the arm can rest.
    for (const double share : {0.05, 0.1, 0.2, 0.35, 0.5, 0.7}) {
        if (!isLate || !(state.v > 0)) break;
        const double to = state.s + share * (last - state.s);
        const std::vector<ProfileCell> path = pathBetween(state.s, to, share_);
        if (path.empty() || to - state.s < 1e-3) continue;
        const ProfileGrid grid = gridOf(path, {state.v, state.a, 0});
        const auto found = ProfileSolver().solve(grid.cells, grid.start, grid.endWidth);
        if (!found.isSolved) continue;
        result.cutAfter(now);
        takeProfile(result, state.s, grid, found);
        return result;
    }
    if (!ramp) return result; // the plan comes to rest as soon
    result.cutAfter(ramp->begin);
    follow(result, *ramp);
    result.rest(0);
    return result;
}

void OptimalPlan::brake(Course& course, double now) const {
    course = stopped(course, now);
}

double OptimalPlan::restPlace(const Course& course, double now) const {
    return stopped(course, now).endPlace();
}

double OptimalPlan::evenRestPlace(const Course& course, double now) const {
    const auto found = slowing(course, now, 0);
    return found ? found->ramp.end(found->from).p : course.endPlace();
}

// ---- Back ----

Course OptimalPlan::courseBack(double time, double from, double to, double mmPerSecond) const {
    Course course = Course::exact(time, 0);
    std::vector<ProfileCell> path = pathBetween(to, from, share_);
    if (path.empty() || !(from - to > kSliver)) return course;
    std::reverse(path.begin(), path.end());
    bool wasSmooth = true;
    for (ProfileCell& cell : path) {
        std::swap(cell.first, cell.last);
        std::swap(cell.isSmooth, wasSmooth);
        cell.mostSquare = std::min(cell.mostSquare, mmPerSecond * mmPerSecond);
        for (ProfileRows* rows : {&cell.first, &cell.last}) {
            for (std::size_t i = 0; i < rows->count; ++i) {
                rows->rows[i].first *= -1;
                rows->rows[i].third *= -1;
                std::swap(rows->rows[i].up, rows->rows[i].down);
            }
        }
    }
    ProfileSolver solver;
    const ProfileGrid grid = gridOf(path, {});
    const auto found = solver.solve(grid.cells, grid.start, grid.endWidth);
    if (found.isSolved) takeProfile(course, 0, grid, found);
    return course;
}

} // namespace motion
