#include "runtime/motion/course.h"

#include "runtime/motion/tolerances.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace motion {

Course::Course(double time, double place, double longWindow, double shortWindow)
    : origin_(place), longWindow_(longWindow), shortWindow_(shortWindow) {
    knots_.push_back({time, 0, 0, 0, 0, 0, {}});
}

Course Course::continued(double time, double longWindow, double shortWindow) const {
    Course next(std::max(time, end()), endPlace(), longWindow, shortWindow);
    next.from_ = next.knots_.front().t;
    next.before_ = std::make_shared<const Course>(*this);
    return next;
}

/// The average over the long window as far back as the short one reaches, in short pieces: it is of the third degree.
void Course::dropLongWindow(double time) {
    if (isExact() || isQuick() || time <= knots_.front().t) return;
    constexpr int kPieces = 64;
    const auto before = std::make_shared<const Course>(*this);
    std::vector<Knot> averaged;
    for (int i = 0; i <= kPieces; ++i) {
        Knot knot;
        knot.t = time - shortWindow_ * (kPieces - i) / kPieces;
        const Integrals now = before->integralsAt(knot.t);
        const Integrals first = before->integralsAt(knot.t - longWindow_);
        knot.s = (now.once - first.once) / longWindow_;
        knot.v = std::max(0.0, (now.s - first.s) / longWindow_);
        if (i > 0) averaged.back().a = (knot.v - averaged.back().v) / (knot.t - averaged.back().t);
        averaged.push_back(knot);
    }
    knots_ = {};
    knots_.push_back(averaged.front());
    longWindow_ = 0;
    for (std::size_t i = 1; i < averaged.size(); ++i)
        push(averaged[i]);
    before_ = before;
    from_ = time;
}

void Course::push(const Knot& knot) {
    const Integrals there = integralsOn(knots_.back(), knot.t); // with the acceleration of the last knot
    knots_.push_back(knot);
    knots_.back().once = there.once;
    knots_.back().twice = there.twice;
}

void Course::moveTo(double place, double speed) {
    Knot& last = knots_.back();
    const double way = place - origin_ - last.s;
    const double duration = way > 0 ? 2 * way / (last.v + speed) : 0;
    if (!(duration > 0) || !std::isfinite(duration)) {
        last.v = speed;
        return;
    }
    last.a = (speed - last.v) / duration;
    push({last.t + duration, place - origin_, speed, 0, 0, 0, {}});
}

void Course::follow(double v, double a, Change change, double seconds, double place) {
    if (!(seconds > 0)) return;
    Knot& last = knots_.back();
    last.v = v;
    last.a = a;
    last.change = change;
    const CourseState end = stateOn(last, seconds);
    knots_.push_back({last.t + seconds, place - origin_, std::max(0.0, end.v), end.a, 0, 0, {}});
}

double Course::secondsFor(double way, double v, double endV, double perMm) {
    const double mean = v + endV;
    if (!(way > 0) || !(mean > 0)) return 0;
    const double rate = std::sqrt(std::abs(perMm));
    const double share = rate * way / mean;
    if (share < 1e-4) return 2 * way / mean * (1 + (perMm > 0 ? 1 : -1) * share * share / 3);
    return 2 / rate * (perMm > 0 ? std::atanh(std::min(share, 1 - 1e-15)) : std::atan(share));
}

/// That long after a knot.
CourseState Course::stateOn(const Knot& knot, double t) {
    const double j = knot.change.perSecond;
    const double bend = knot.change.perMm;
    const double angle = bend * t * t;
    if (std::abs(angle) < 1e-3) { // also constant jerk; the rest of the series is below rounding
        const double j0 = j + bend * knot.v;
        const double j1 = bend * knot.a, j2 = bend * bend * knot.v, j3 = bend * bend * knot.a;
        const double s3 = j0 / 6, s4 = j1 / 24, s5 = j2 / 120, s6 = j3 / 720;
        return {knot.s + t * (knot.v + t * (knot.a / 2 + t * (s3 + t * (s4 + t * (s5 + t * s6))))),
                knot.v + t * (knot.a + t * (3 * s3 + t * (4 * s4 + t * (5 * s5 + t * 6 * s6)))),
                knot.a + t * (6 * s3 + t * (12 * s4 + t * (20 * s5 + t * 30 * s6)))};
    }
    const double rate = std::sqrt(std::abs(bend));
    const double x = rate * t;
    const double even = bend > 0 ? std::cosh(x) : std::cos(x);
    const double odd = (bend > 0 ? std::sinh(x) : std::sin(x)) / rate;
    return {knot.s + knot.a * (even - 1) / bend + knot.v * odd, knot.v * even + knot.a * odd,
            knot.a * even + bend * knot.v * odd};
}

/// Seconds from a knot over `way` mm, at most `most`.
double Course::timeOn(const Knot& knot, double way, double most) {
    if (!(way > 0)) return 0;
    if (knot.change.perSecond == 0) {
        const double square = knot.v * knot.v + way * (2 * knot.a + knot.change.perMm * way);
        return std::min(most, secondsFor(way, knot.v, std::sqrt(std::max(0.0, square)), knot.change.perMm));
    }
    double low = 0;
    double high = most;
    double time = 0.5 * most;
    for (int i = 0; i < 80 && high - low > 1e-13; ++i) {
        const CourseState state = stateOn(knot, time);
        const double miss = state.s - knot.s - way;
        (miss < 0 ? low : high) = time;
        const double newton = state.v > 0 ? time - miss / state.v : low;
        const bool isInside = newton > low && newton < high;
        if (isInside && std::abs(newton - time) < 1e-13) return newton;
        time = isInside ? newton : 0.5 * (low + high);
    }
    return time;
}

void Course::rest(double seconds) {
    knots_.back().v = knots_.back().a = 0;
    knots_.back().change = {};
    if (seconds > 0) push({knots_.back().t + seconds, knots_.back().s, 0, 0, 0, 0, {}});
}

void Course::cutAfter(double time) {
    if (time >= knots_.back().t) return;
    const CourseState state = plannedAt(time);
    while (knots_.size() > 1 && knots_.back().t > time)
        knots_.pop_back();
    if (time <= knots_.front().t) {
        knots_.back().v = knots_.back().a = 0;
        knots_.back().change = {};
        return;
    }
    push({time, state.s - origin_, state.v, isExact() ? state.a : 0, 0, 0, {}});
}

void Course::shift(double seconds) {
    for (std::size_t i = 0; i < knots_.size(); ++i)
        knots_[i].t += seconds;
    before_ = nullptr; // nothing has been executed
}

void Course::slowBy(double factor) {
    const double begin = knots_.front().t;
    for (std::size_t i = 0; i < knots_.size(); ++i) {
        Knot& knot = knots_[i];
        knot.t = begin + factor * (knot.t - begin);
        knot.v /= factor;
        knot.a /= factor * factor;
        knot.change.perSecond /= factor * factor * factor;
        knot.change.perMm /= factor * factor;
    }
}

bool Course::forgetBefore(double time) {
    const bool wasContinued = before_ != nullptr;
    if (time >= from_) before_ = nullptr;
    const double needed = time - longWindow_ - shortWindow_;
    constexpr std::size_t kWorthwhile = 256;
    if (knots_.size() <= kWorthwhile || knots_[kWorthwhile].t > needed)
        return wasContinued && before_ == nullptr;
    std::size_t spare = kWorthwhile;
    while (spare + 1 < knots_.size() && knots_[spare + 1].t <= needed)
        ++spare;
    knots_.forget(spare);
    // Neither a shift of all places nor the constants of integration change what is executed.
    const double shift = knots_.front().s;
    origin_ += shift;
    for (std::size_t i = 0; i < knots_.size(); ++i) {
        knots_[i].s -= shift;
        knots_[i].once = knots_[i].twice = 0;
        if (i == 0) continue;
        const Knot& from = knots_[i - 1];
        const double t = knots_[i].t - from.t;
        knots_[i].once = from.once + t * (from.s + t * (from.v / 2 + t * from.a / 6));
        knots_[i].twice =
            from.twice + t * (from.once + t * (from.s / 2 + t * (from.v / 6 + t * from.a / 24)));
    }
    return true;
}

const Course::Knot& Course::knotAt(double time) const {
    const std::size_t begun = knots_.countUpTo(time, [](const Knot& knot) { return knot.t; });
    return knots_[begun == 0 ? 0 : begun - 1];
}

Course::Integrals Course::integralsAt(double time) const {
    return integralsOn(knotAt(time), time);
}

Course::Integrals Course::integralsOn(const Knot& from, double time) {
    const double t = time - from.t; // below 0 before the first knot, where the arm rests
    if (t < 0) {
        return {from.s, from.once + t * from.s, from.twice + t * (from.once + t * from.s / 2), 0};
    }
    return {from.s + t * (from.v + t * from.a / 2),
            from.once + t * (from.s + t * (from.v / 2 + t * from.a / 6)),
            from.twice + t * (from.once + t * (from.s / 2 + t * (from.v / 6 + t * from.a / 24))),
            from.v + t * from.a};
}

CourseState Course::plannedAt(double time) const {
    const Knot& from = knotAt(time);
    const double t = std::max(0.0, time - from.t);
    const bool isBefore = time < knots_.front().t;
    if (isExact()) {
        const CourseState state = isBefore ? CourseState{from.s, 0, 0} : stateOn(from, t);
        return {origin_ + state.s, std::max(0.0, state.v), state.a};
    }
    return {origin_ + from.s + t * (from.v + t * from.a / 2), isBefore ? 0 : from.v + t * from.a, from.a};
}

double Course::lastBraking() const {
    std::size_t i = knots_.size() - 1;
    const auto brakes = [&](std::size_t piece) {
        return isExact() ? knots_[piece + 1].v < knots_[piece].v * (1 - 1e-5) : knots_[piece].a < 0;
    };
    while (i > 0 && brakes(i - 1))
        --i;
    return knots_[i].t;
}

double Course::plannedTimeAt(double place) const {
    const double wanted = place - origin_;
    const std::size_t passed = knots_.countWhile([&](const Knot& knot) { return knot.s < wanted; });
    if (passed == 0) return knots_.front().t;
    if (passed == knots_.size()) return knots_.back().t;
    const Knot& from = knots_[passed - 1];
    const Knot& after = knots_[passed];
    const double way = wanted - from.s;
    if (isExact()) return from.t + timeOn(from, way, after.t - from.t);
    const double speed = std::sqrt(std::max(0.0, from.v * from.v + 2 * from.a * way));
    return from.t + (way > 0 ? std::min(2 * way / (from.v + speed), after.t - from.t) : 0);
}

CourseState Course::at(double time) const {
    if (before_ != nullptr && time < from_) return before_->at(time);
    if (time >= end()) return {endPlace(), 0, 0};
    if (time <= knots_.front().t) return {origin_ + knots_.front().s, 0, 0};
    if (isExact()) return plannedAt(time);
    const Integrals now = integralsAt(time);
    CourseState state;
    const Integrals second = integralsAt(time - shortWindow_);
    if (isQuick()) {
        state.s = origin_ + (now.once - second.once) / shortWindow_;
        state.v = std::max(0.0, (now.s - second.s) / shortWindow_);
        state.a = (now.v - second.v) / shortWindow_;
        return state;
    }
    const Integrals first = integralsAt(time - longWindow_);
    const Integrals both = integralsAt(time - longWindow_ - shortWindow_);
    const double share = 1 / (longWindow_ * shortWindow_);
    state.s = origin_ + (now.twice - first.twice - second.twice + both.twice) * share;
    state.v = std::max(0.0, (now.once - first.once - second.once + both.once) * share);
    state.a = (now.s - first.s - second.s + both.s) * share;
    return state;
}

double Course::timeAt(double place) const {
    if (place >= endPlace() - kNothing) return end();
    if (before_ != nullptr && place <= before_->at(from_).s) return before_->timeAt(place);
    double low = plannedTimeAt(place);
    if (isExact()) return low;
    double high = low + longWindow_ + shortWindow_;
    if (place <= origin_ + knots_.front().s + kNothing) return knots_.front().t;
    double time = 0.5 * (low + high);
    for (int i = 0; i < 80 && high - low > 1e-11; ++i) {
        const CourseState state = at(time);
        (state.s < place ? low : high) = time;
        const double newton = state.v > 0 ? time + (place - state.s) / state.v : low;
        const bool isInside = newton > low && newton < high;
        if (isInside && std::abs(newton - time) < 1e-10) return newton;
        time = isInside ? newton : 0.5 * (low + high);
    }
    return time;
}

} // namespace motion
