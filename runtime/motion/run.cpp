#include "runtime/motion/run.h"

#include "runtime/motion/tolerances.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace motion {

namespace {

/// Squares of the speed on a stretch.
struct StretchSpeeds {
    double first = 0, last = 0; ///< at its ends
    double most = 0;
    double gained = 0; ///< at its end with full acceleration from the first
    double before = 0; ///< at its beginning with full braking to the last
};

/// Full acceleration, the highest speed, full braking; each may take none of the stretch.
void shapeStretch(Course& course, double from, double to, const StretchSpeeds& x) {
    const double width = to - from;
    const double rise = (x.gained - x.first) / width;
    const double fall = (x.before - x.last) / width;
    if (x.first <= x.most && x.last <= x.most && x.gained > x.last && x.before > x.first && rise > 0 &&
        fall > 0) {
        const double top =
            std::min(x.most, (x.first * fall + x.last * rise + rise * fall * width) / (rise + fall));
        const double up = (top - x.first) / rise;
        const double down = (top - x.last) / fall;
        if (up > kNothing) course.moveTo(from + up, std::sqrt(top));
        if (width - up - down > kNothing) course.moveTo(to - down, std::sqrt(top));
    }
    course.moveTo(to, std::sqrt(x.last));
}

} // namespace

Run::Run(const RunSettings& settings, double start)
    : settings_(settings), route_(settings.planner == Planner::Optimal), course_(newCourse(start, 0)),
      start_(start), share_(settings.speedShare) {
    reachable_.push_back(0);
    planned_.push_back(0);
    if (settings.planner == Planner::Optimal)
        optimal_.emplace(ArmLimits{settings.accelerations, settings.jerk});
}

Course Run::newCourse(double time, double place) const {
    if (settings_.planner == Planner::Optimal) return Course::exact(time, place);
    return {time, place, settings_.longWindow, settings_.shortWindow};
}

/// The part of the route up to there can no longer change.
double Run::fixedPlace(double now) const {
    if (route_.legCount() == 0) return 0;
    if (isBraking_) return course_.endPlace();
    return now <= start_ ? 0 : course_.plannedAt(now).s;
}

bool Run::append(Leg leg, bool isOpen, double now) {
    decision_.reset();
    if (!canAppend(now)) return false;
    const bool isFirst = route_.legCount() == 0;
    if (leg.duration > 0) leg.limits.pathSpeed = leg.length() / leg.duration;
    leg.programmed.pathSpeed = leg.limits.pathSpeed;
    const double endRamp = isOpen ? 1 : std::min(1.0, leg.limits.finePointRampShare / leg.limits.rampShare);
    const auto changed = route_.append(std::move(leg), fixedPlace(now));
    if (!changed) return false;
    if (optimal_) optimal_->setEndRamp(endRamp);
    if (optimal_ && !appendOptimal(*changed, now)) return false;
    isOpen_ = isOpen;
    if (optimal_) {
        if (isFirst && !isOpen) meetDuration();
        return true;
    }
    const std::size_t from = isFirst ? 0 : std::min(route_.stretchAt(*changed), route_.keptStretches());
    const std::size_t first = limitStretches(from);
    planBackward(first);
    if (first < from) changed_ = std::min(changed_, first);
    if (!isBraking_) planForward(now);
    if (isFirst && !isOpen) meetDuration();
    return true;
}

bool Run::canAppend(double now) const {
    if (route_.legCount() == 0) return true;
    return isOpen_ && (isBraking_ || now < course_.plannedEnd());
}

bool Run::appendTogether(Leg leg, std::vector<Leg> others, bool isOpen, double now) {
    if (!canAppend(now)) return false;
    // While legs are appended the carriers' places are not known.
    route_.setCarrier({});
    for (std::size_t i = 0; i < settings_.companions->size(); ++i)
        settings_.companions->route(i).setCarrier({});
    const Companions before = *settings_.companions;
    if (!settings_.companions->append(std::move(others), route_, fixedPlace(now))) return false;
    if (append(std::move(leg), isOpen, now)) return true;
    *settings_.companions = before;
    return false;
}

void Run::setCarrier(std::size_t carried, std::size_t carrier,
                     std::function<Pose(const RoutePoint&)> frameOf) {
    Companions& others = *settings_.companions;
    Route& own = carried == 0 ? route_ : others.route(carried - 1);
    own.setCarrier([this, carried, carrier, frameOf = std::move(frameOf)](double place) {
        const Companions& all = *settings_.companions;
        const double common = carried == 0 ? place : all.leaderPlace(carried - 1, route_, place);
        if (carrier == 0) return frameOf(route_.at(common));
        return frameOf(all.route(carrier - 1).at(all.placeOf(carrier - 1, route_, common).place));
    });
}

double Run::perMmLeft() const {
    const std::size_t last = route_.legCount() - 1;
    double least = route_.leg(last).perMmLeft;
    if (settings_.companions == nullptr) return least;
    const double length = route_.leg(last).length();
    for (std::size_t i = 0; i < settings_.companions->size(); ++i) {
        const Leg& other = settings_.companions->route(i).leg(last);
        least = std::min(least, other.perMmLeft * length / other.length());
    }
    return least;
}

/// False, and the route is as before, when the arm can no longer take the corner within its limits.
bool Run::appendOptimal(double changed, double now) {
    const bool isFirst = route_.legCount() == 1;
    const std::size_t from = route_.keptStretches();
    optimal_->measure(route_, from);
    if (isBraking_ || optimal_->plan(course_, route_, std::max(now, start_), changed, share_) || isFirst)
        return true;
    route_.undoAppend();
    optimal_->measure(route_, std::min(from, route_.stretches().size()));
    return false;
}

/// Limits of the stretches from this one on; the first stretch whose limits may have changed.
std::size_t Run::limitStretches(std::size_t from) {
    const auto& stretches = route_.stretches();
    limits_.resize(from);
    for (std::size_t k = from; k < stretches.size(); ++k) {
        const RouteStretch& s = stretches[k];
        StretchLimits& added = limits_.grow();
        limitsOn(s, route_.leg(s.leg).limits, *settings_.accelerations, added);
        if (settings_.companions != nullptr) settings_.companions->tighten(route_, s, added);
        added.ownSpeed = added.speed;
        if (!s.isAxesCorner) added.axisSpeed = kUnlimited; // no dip that is widened
        if (s.isReversal) added.axisSpeed = std::min(added.axisSpeed, std::sqrt(added.bendSquare));
    }
    return widenDips(from);
}

/// Averaging in time would pass over a short place in a corner between joint moves where an axis turns fast, or where the path turns back on
/// itself: around it, as far as the windows reach, the speed exceeds what the axis allows there by a limited share only. Limits from `from` on are new: stretches before it that a dip in
/// their place had lowered have their own speeds again. The first stretch whose speed has changed, at most `from`.
std::size_t Run::widenDips(std::size_t from) {
    constexpr double kExcess = 1.25;
    constexpr double kReversalShare = 0.35; // the rest of the windows adds little to the speed there
    const auto& stretches = route_.stretches();
    if (from >= limits_.size()) return from;
    const double halfWindow = 0.5 * (settings_.longWindow + settings_.shortWindow);
    std::size_t restored = from;
    while (restored > 0 && limits_[restored - 1].speed < limits_[restored - 1].ownSpeed)
        --restored;
    std::vector<double> before;
    for (std::size_t i = restored; i < from; ++i)
        before.push_back(std::exchange(limits_[i].speed, limits_[i].ownSpeed));
    double fastest = 0;
    for (std::size_t i = restored; i < limits_.size(); ++i)
        fastest = std::max(fastest, limits_[i].speed);
    std::size_t first = from;
    const auto lower = [&](std::size_t i, double speed) {
        if (limits_[i].speed <= speed) return;
        limits_[i].speed = speed;
        if (i < restored) first = std::min(first, i);
    };
    const auto widen = [&](std::size_t dip) {
        const double speed = kExcess * limits_[dip].axisSpeed;
        const double reach = speed * halfWindow * (stretches[dip].isReversal ? kReversalShare : 1);
        for (std::size_t i = dip; i > 0 && stretches[i - 1].end > stretches[dip].begin - reach; --i)
            lower(i - 1, speed);
        for (std::size_t i = dip + 1; i < limits_.size() && stretches[i].begin < stretches[dip].end + reach;
             ++i)
            lower(i, speed);
    };
    std::size_t dip = restored;
    double fastestNear = fastest; // of all that a dip can reach
    while (dip > 0 && stretches[dip - 1].end > stretches[restored].begin - fastest * halfWindow)
        fastestNear = std::max(fastestNear, limits_[--dip].speed);
    for (; dip < limits_.size(); ++dip)
        if (kExcess * limits_[dip].axisSpeed < fastestNear) widen(dip);
    for (std::size_t i = restored; i < from; ++i)
        if (limits_[i].speed != before[i - restored]) return std::min(first, i);
    return first;
}

double Run::speedSquare(std::size_t stretch) const {
    const StretchLimits& l = limits_[stretch];
    const double speed = share_ * l.speed;
    return std::min(speed < 1e100 ? speed * speed : kUnlimited, l.bendSquare);
}

/// AccSet \FinePointRamp: at a stop point deceleration decreases more slowly than the windows make it.
void Run::taperEnd() {
    taper_ = 0;
    if (isOpen_ || route_.legCount() == 0 || limits_.empty()) return;
    const double share = route_.leg(route_.legCount() - 1).limits.finePointRampShare;
    const double windows = settings_.longWindow + settings_.shortWindow;
    taper_ = std::max(0.0, windows * (settings_.rampShare / share - 1));
    if (!(taper_ > 0)) return;
    const double width = limits_.back().width;
    const double braking = limits_.back().reachFrom(0, width, false).high / (2 * width);
    taperJerk_ = std::min(braking, 1e6) / taper_;
}

/// Largest square of the speed at a place from which deceleration falls evenly to zero at the end.
double Run::taperSquare(double place) const {
    if (!(taper_ > 0)) return kUnlimited;
    const double way = route_.length() - place;
    const double before = way - taperWay();
    if (before > limits_.back().width) return kUnlimited;
    if (before > 0) { // evenly braked up to there
        const double begun = 0.5 * taperJerk_ * taper_ * taper_;
        return begun * begun + 2 * taperJerk_ * taper_ * before;
    }
    const double speed = std::cbrt(4.5 * taperJerk_ * way * way); // jerk t^2 / 2 after jerk t^3 / 6
    return speed * speed;
}

/// Largest speeds from which the plan can still stop at the end; those of stretches before `from` only where they change.
void Run::planBackward(std::size_t from) {
    const std::size_t count = limits_.size();
    const std::size_t known = std::min(from, reachable_.size() - 1);
    reachable_.resize(count + 1);
    planned_.resize(count + 1);
    reachable_[count] = 0;
    taperEnd();
    std::size_t changed = count;
    for (std::size_t i = count; i-- > 0;) {
        double most = speedSquare(i);
        if (i > 0) most = std::min(most, speedSquare(i - 1));
        most = std::min(most, limits_[i].reachFrom(reachable_[i + 1], limits_[i].width, false).high);
        most = std::max(std::min(most, taperSquare(nodePlace(i))), 0.0);
        if (i < known && reachable_[i] == most) break;
        reachable_[i] = most;
        changed = i;
    }
    changed_ = std::min(changed_, changed);
}

double Run::nodePlace(std::size_t node) const {
    const auto& stretches = route_.stretches();
    return node < stretches.size() ? stretches[node].begin : route_.length();
}

/// From the state at `now`, or from the last place before which nothing changes, to the end of the route.
void Run::planForward(double now) {
    const CourseState state = now <= start_ ? CourseState{} : course_.plannedAt(now);
    std::size_t stretch = now <= start_ ? 0 : route_.stretchAt(state.s);
    double place = state.s;
    double square = state.v * state.v;
    double from = std::max(now, start_);
    if (changed_ > stretch + 1) { // what is planned up to there remains
        stretch = changed_ - 1;
        place = nodePlace(stretch);
        square = planned_[stretch];
        from = std::max(from, course_.plannedTimeAt(place));
    } else if (stretch < planned_.size() && place <= nodePlace(stretch) + kNothing) {
        planned_[stretch] = square;
    }
    course_.cutAfter(from);
    if (course_.plannedEnd() < from) course_.rest(from - course_.plannedEnd());
    for (; stretch < limits_.size(); ++stretch) {
        passStretch(stretch, place, square);
        place = nodePlace(stretch + 1);
        square = planned_[stretch + 1];
    }
    changed_ = limits_.size() + 1;
}

/// Plans from a place on the stretch, with this square of the speed, to its end.
void Run::passStretch(std::size_t stretch, double from, double square) {
    const StretchLimits& limits = limits_[stretch];
    const double to = nodePlace(stretch + 1);
    const double width = to - from;
    if (width < kNothing) {
        planned_[stretch + 1] = square;
        return;
    }
    const double most = speedSquare(stretch);
    const SquareRange reach = limits.reachFrom(square, width, true);
    double next = std::max(0.0, std::min({reach.high, reachable_[stretch + 1], most}));
    // The speed has been lowered meanwhile: as fast as braking allows.
    if (square > most && stretch + 1 < limits_.size()) next = std::max(next, std::min(reach.low, square));
    if (taper_ > 0 && to > route_.length() - taperWay() + kNothing && square > 0)
        return passTapered(stretch, from, square, next);
    const double back = limits.reachFrom(next, width, false).high;
    shapeStretch(course_, from, to, {square, next, most, reach.high, back});
    planned_[stretch + 1] = next;
}

/// A single move with a given duration: as slow as it has to be at full override, which then acts on the speed.
void Run::meetDuration() {
    if (route_.legCount() != 1 || !(route_.leg(0).duration > 0)) return;
    const double share = std::exchange(share_, 1);
    Leg& leg = route_.leg(0);
    leg.programmed.pathSpeed = optimal_ ? optimalSpeedFor(leg.duration) : averagedSpeedFor(leg.duration);
    leg.limits.pathSpeed = leg.programmed.pathSpeed;
    if (share != share_) plan(start_, share);
}

/// Plans with the speed along the path at which the course lasts that long; unlimited when it takes at least that. To be found in few
/// rounds: each solves the whole course. The speed is the way divided by the time without what is lost at the ends, which hardly changes.
double Run::optimalSpeedFor(double wanted) {
    constexpr double kReserve = 5e-5; // of the time, which is made up at the end
    constexpr int kMostRounds = 20;
    const auto durationAt = [&](double speed) {
        route_.leg(0).limits.pathSpeed = speed;
        optimal_->measure(route_, 0);
        course_ = newCourse(start_, 0);
        return optimal_->plan(course_, route_, start_, 0, share_) ? course_.plannedEnd() - start_
                                                                  : kUnlimited;
    };
    if (durationAt(kUnlimited) >= wanted) return kUnlimited;
    const double aim = (1 - kReserve) * wanted;
    double slow = route_.length() / wanted;
    double fast = kUnlimited;
    double speed = slow;
    for (int round = 0; round < kMostRounds; ++round) {
        const double seconds = durationAt(speed);
        (seconds > wanted ? slow : fast) = speed;
        if (std::abs(seconds - aim) < kReserve * wanted) break;
        const double left = aim - (seconds - route_.length() / speed);
        speed = left > 0 ? route_.length() / left : kUnlimited;
        if (!(speed > slow && speed < fast)) speed = fast < kUnlimited ? 0.5 * (slow + fast) : 2 * slow;
    }
    if (course_.plannedEnd() - start_ > wanted) durationAt(fast);
    course_.slowBy(wanted / (course_.plannedEnd() - start_));
    return fast;
}

/// The same of a course that is averaged in time.
double Run::averagedSpeedFor(double wanted) {
    route_.leg(0).limits.pathSpeed = kUnlimited;
    limitStretches(0);
    std::vector<double> fastest;
    for (std::size_t i = 0; i < limits_.size(); ++i)
        fastest.push_back(limits_[i].speed);
    const auto durationAt = [&](double speed) {
        for (std::size_t i = 0; i < limits_.size(); ++i)
            limits_[i].speed = std::min(fastest[i], speed);
        planBackward(0);
        changed_ = 0;
        course_ = Course(start_, 0, settings_.longWindow, settings_.shortWindow);
        planForward(start_);
        return course_.end() - start_;
    };
    if (durationAt(kUnlimited) >= wanted) return kUnlimited;
    double low = 0;
    double high = route_.length() / std::max(1e-3, wanted - settings_.longWindow - settings_.shortWindow) * 4;
    for (int i = 0; i < 60 && high - low > 1e-12 * high; ++i) {
        const double middle = 0.5 * (low + high);
        (durationAt(middle) > wanted ? low : high) = middle;
    }
    durationAt(high);
    return high;
}

/// A stretch on which deceleration decreases: in parts of the same time.
void Run::passTapered(std::size_t stretch, double from, double square, double last) {
    constexpr int kParts = 24;
    const StretchLimits& limits = limits_[stretch];
    const double to = nodePlace(stretch + 1);
    const double begin = std::max(from, route_.length() - taperWay());
    double place = from;
    for (int part = kParts; part >= 0; --part) {
        const double time =
            static_cast<double>(part) / kParts; // that is left; the way left goes with its cube
        const double left = time * time * time;
        const double next = to - (to - begin) * left;
        const double width = next - place;
        if (width < kNothing) continue;
        const double gained = limits.reachFrom(square, width, true).high;
        const double most = part == 0 ? last : std::min({gained, taperSquare(next), speedSquare(stretch)});
        if (part == kParts) { // up to the place from which on it decreases
            const double back = limits.reachFrom(most, width, false).high;
            shapeStretch(course_, place, next, {square, most, speedSquare(stretch), gained, back});
        } else {
            course_.moveTo(next, std::sqrt(std::max(most, 0.0)));
        }
        square = most;
        place = next;
    }
    planned_[stretch + 1] = last;
}

void Run::limitSpeeds(double now, const SpeedLimits& most) {
    for (std::size_t i = route_.firstLeg(); i < route_.legCount(); ++i)
        route_.leg(i).limits = limitedTo(route_.leg(i).programmed, most);
    if (optimal_) {
        optimal_->measure(route_, 0);
    } else {
        limitStretches(0);
        planBackward(0);
        changed_ = 0;
    }
    if (!isBraking_) plan(now, share_);
}

void Run::plan(double now, double speedShare) {
    decision_.reset();
    if (optimal_) {
        share_ = speedShare;
        if (route_.legCount() == 0) return;
        isBraking_ = !optimal_->plan(course_, route_, std::max(now, start_), 0, speedShare) &&
                     course_.endPlace() < route_.length() - kNothing;
        return;
    }
    if (speedShare != share_ || isBraking_) {
        share_ = speedShare;
        planBackward(0);
        changed_ = 0;
    }
    isBraking_ = false;
    if (course_.isQuick()) // it is executed to its end
        course_ = course_.continued(now, settings_.longWindow, settings_.shortWindow);
    planForward(now);
}

/// Calls `step` with place and speed at the end of each piece of the way on which the arm brakes from `state`.
template <class Step> void Run::brakeFrom(const CourseState& state, Step step) const {
    double place = state.s;
    double square = state.v * state.v;
    for (std::size_t i = route_.stretchAt(place); i < limits_.size() && square > 0; ++i) {
        const double to = nodePlace(i + 1);
        const double width = to - place;
        if (width < kNothing) continue;
        const double slowest = std::min(limits_[i].reachFrom(square, width, true).low, 0.999 * square);
        if (slowest <= 0 || i + 1 == limits_.size()) {
            const double rest = slowest < 0 ? width * square / (square - slowest) : width;
            step(place + rest, 0.0);
            break;
        }
        step(to, std::sqrt(slowest));
        square = slowest;
        place = to;
    }
}

void Run::brake(double now, StopKind kind) {
    if (optimal_ && isBraking_) return; // as fast as it can already
    decision_.reset();
    isBraking_ = true;
    if (now <= start_) { // it has not moved since it was put there
        course_ = newCourse(start_, course_.at(start_).s);
        return;
    }
    if (optimal_) {
        optimal_->brake(course_, now);
    } else {
        if (kind == StopKind::Quick) course_.dropLongWindow(now);
        const CourseState state = course_.plannedAt(now);
        course_.cutAfter(now);
        brakeFrom(state, [this](double place, double speed) { course_.moveTo(place, speed); });
        course_.rest(0);
    }
    isBraking_ = course_.endPlace() < route_.length() - kNothing;
}

double Run::restPlace(double now) const {
    if (now <= start_) return 0;
    if (optimal_) return optimal_->restPlace(course_, now);
    const CourseState state = course_.plannedAt(now);
    double rest = state.s;
    brakeFrom(state, [&rest](double place, double) { rest = place; });
    return rest;
}

double Run::lastBraking() const {
    if (!decision_) decision_ = course_.lastBraking();
    return *decision_;
}

double Run::decisionTime() const {
    if (decision_) return *decision_;
    const double entry = route_.zoneEntry(route_.legCount() - 1);
    const double known = std::min(course_.lastBraking(), course_.timeAt(entry));
    // Any corner can be taken from where the arm could still stop before it.
    double low = std::max(start_, course_.begin());
    double high = std::max(low, known);
    for (int i = 0; i < 16 && high - low > 1e-3; ++i) {
        const double middle = 0.5 * (low + high);
        (optimal_->evenRestPlace(course_, middle) <= entry ? low : high) = middle;
    }
    decision_ = low;
    return low;
}

void Run::standAt(double time, double place) {
    decision_.reset();
    course_ = newCourse(time, place);
    start_ = std::min(start_, time);
    isBraking_ = place < route_.length() - kNothing;
}

void Run::startAt(double time) {
    decision_.reset();
    course_.shift(time - start_);
    start_ = time;
}

Course Run::courseBack(double time, double from, double to, double mmPerSecond) const {
    if (optimal_) return optimal_->courseBack(time, from, to, mmPerSecond);
    struct Part {
        std::size_t stretch;
        double low, width, most, square = 0;
    };
    std::vector<Part> parts;
    for (std::size_t i = route_.stretchAt(from);; --i) {
        const double high = std::min(from, nodePlace(i + 1));
        const double low = std::max(to, nodePlace(i));
        const double speed = mmPerSecond / std::max(route_.stretches()[i].tcpRate, 1e-3);
        if (high - low > kNothing)
            parts.push_back({i, low, high - low, std::min(speedSquare(i), speed * speed)});
        if (i == 0 || low <= to) break;
    }
    double square = 0;
    for (auto part = parts.rbegin(); part != parts.rend(); ++part) { // from the rest at the end
        part->square = square;
        square = std::min(part->most, limits_[part->stretch].reachFrom(square, part->width, true).high);
    }
    Course course(time, 0, settings_.longWindow, settings_.shortWindow);
    square = 0;
    for (const Part& part : parts) {
        const StretchLimits& limits = limits_[part.stretch];
        const double gained = limits.reachFrom(square, part.width, false).high;
        const double next = std::max(0.0, std::min({gained, part.most, part.square}));
        const double before = limits.reachFrom(next, part.width, true).high;
        const double begin = from - part.low - part.width;
        shapeStretch(course, begin, begin + part.width, {square, next, part.most, gained, before});
        square = next;
    }
    return course;
}

bool Run::forgetBefore(double time, double place) {
    const bool isRoundedAnew = course_.forgetBefore(time);
    const std::size_t count = route_.forgetBefore(place);
    if (count == 0) return isRoundedAnew;
    if (optimal_) {
        optimal_->forget(count);
        return isRoundedAnew;
    }
    limits_.forget(count);
    reachable_.forget(count);
    planned_.forget(count);
    changed_ = limits_.size() + 1;
    return isRoundedAnew;
}

} // namespace motion
