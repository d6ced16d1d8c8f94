#include "runtime/motion/trajectory.h"

#include "runtime/motion/tolerances.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace motion {

namespace {

constexpr double kSameMoment = 1e-7; // s; the virtual clock has whole nanoseconds
constexpr double kMakingUp = 0.03;   // s, for what a run has covered before it was ordered
constexpr double kSettling = 0.044;  // s, from the release at a stop point to standstill, as measured

/// When the course, which comes to rest, has at most this share of its speed at `from`.
double slowTime(const Course& course, double from, double share) {
    const double wanted = share * course.at(from).v;
    double low = from;
    double high = std::max(from, course.end());
    while (high - low > kSameMoment) {
        const double middle = 0.5 * (low + high);
        (course.at(middle).v > wanted ? low : high) = middle;
    }
    return high;
}

/// Where, on the route of the leader, the first of the robots that move together comes to its zone at the end.
double firstZoneEntry(const Run& run, std::size_t companions) {
    const Route& way = run.route();
    const std::size_t last = way.legCount() - 1;
    double place = way.zoneEntry(last);
    for (std::size_t i = 0; i < companions; ++i) {
        const double entry = run.companions().route(i).zoneEntry(last);
        place = std::min(place, run.companions().leaderPlace(i, way, entry));
    }
    return place;
}

} // namespace

Trajectory::Trajectory(const robot::RobotModel& model, const ExternalAxisModels& external,
                       TrajectoryOptions options, const JointTarget& start, double earliest)
    : endTarget_(start), model_(model), external_(external), accelerations_(model), options_(options),
      earliest_(earliest) {}

// ---- What is to be run ----

Leg Trajectory::legOf(const std::shared_ptr<const MotionPath>& path, const MoveCommand& command) const {
    Leg leg;
    leg.path = path;
    leg.zone = command.zone;
    leg.programmed = limitsOf(command, model_, external_);
    leg.limits = limitedTo(leg.programmed, speedLimits_);
    leg.duration = command.duration;
    const double external = path->externalTravel() + std::abs(path->armTravel());
    double mm = path->length();
    if (path->isCartesian()) {
        mm = path->curve().length();
        const double turn = path->curve().rotationDeg() + external;
        leg.lengths = LengthMap::even(pathRate(mm, turn));
        leg.perMmLeft = perMmLeft(mm, turn);
        if (mm > 0) leg.perMm = leg.lengths.length() / mm;
    } else {
        const auto rate = [&](double s) {
            double tcp = 0;
            double turn = 0;
            path->tcpRatesAt(s, tcp, turn);
            return pathRate(tcp, turn + external);
        };
        leg.lengths = LengthMap::measured(rate, kAxesPieces, options_.planner == Planner::Optimal);
        if (!(leg.lengths.length() >
              1e-6)) { // an axis turns that moves and turns nothing: only a bad tool does that
            leg.lengths = LengthMap::even(1);
        }
        double tcp = 0;
        double turn = 0;
        path->tcpRatesAt(1, tcp, turn);
        leg.perMmLeft = perMmLeft(tcp, turn + external);
    }
    leg.isTurning = mm < 0.5 * leg.lengths.length();
    return leg;
}

Trajectory::Appended Trajectory::append(const std::shared_ptr<const MotionPath>& path,
                                        const MoveCommand& command, double now) {
    planChanged();
    const bool isFlyBy = !command.zone.finep;
    Entry* last = entries_.empty() ? nullptr : &entries_.back();
    endTarget_ = path->end();
    const bool canFollow = last != nullptr && last->run->isOpen() && last->isScheduled;
    if (path->isEmpty()) {
        const bool isAtFlyBy = canFollow && now < last->run->course().plannedEnd() && !(command.duration > 0);
        if (!isAtFlyBy) {
            const double pause = command.duration > 0 ? command.duration : options_.emptyMove;
            return appendPause(path, pause, command.stop, now);
        }
        if (!isFlyBy) last->run->close(); // the point has been on the path already
        last->stop = command.stop;
        return {{count() - 1, last->run->route().legCount() - 1}, true, false};
    }
    Leg leg = legOf(path, command);
    if (canFollow && last->run->append(leg, isFlyBy, now)) {
        planChanged();
        last->stop = command.stop;
        return {{count() - 1, last->run->route().legCount() - 1}, false, false};
    }
    const bool isCornerLost = last != nullptr && last->run->isOpen();
    closeLast();
    auto run = std::make_unique<Run>(settingsOf(leg.limits.rampShare), now);
    run->append(std::move(leg), isFlyBy, now);
    Appended result = appendRun(std::move(run), path, 0, command.stop, now);
    result.isCornerLost = isCornerLost;
    return result;
}

/// Windows that are longer let acceleration change more slowly (AccSet \Ramp).
RunSettings Trajectory::settingsOf(double rampShare) const {
    RunSettings settings = this->settings();
    settings.longWindow = model_.dynamics.longWindow / rampShare;
    settings.shortWindow = model_.dynamics.shortWindow / rampShare;
    settings.rampShare = rampShare;
    return settings;
}

/// In its work object, which may be carried.
bool Trajectory::keepsPlace(const Ordered& move) {
    if (move.path->isEmpty()) return true;
    constexpr double kNoWay = 1e-6; // mm
    const MotionPath& path = *move.path;
    return path.isCartesian() && path.curve().length() < kNoWay && path.curve().rotationDeg() < kNoWay &&
           path.externalTravel() < kNoWay;
}

/// A robot that keeps its place gets a leg without movement, as long as the longest one of the others.
std::vector<Leg> Trajectory::legsTogether(const std::vector<Ordered>& moves) const {
    std::vector<Leg> legs;
    double longest = 1;
    double duration = 0;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        legs.push_back(i == 0 ? legOf(moves[i].path, moves[i].command)
                              : followers_[i - 1].lock()->legOf(moves[i].path, moves[i].command));
        duration = std::max(duration, legs.back().duration);
        if (!keepsPlace(moves[i])) longest = std::max(longest, legs.back().length());
    }
    for (std::size_t i = 0; i < moves.size(); ++i) {
        legs[i].duration = i == 0 ? duration : 0;
        if (!keepsPlace(moves[i])) continue;
        legs[i].lengths = LengthMap::even(longest);
        legs[i].perMm = 1;
        legs[i].perMmLeft = 1e300;
        legs[i].isTurning = false;
        legs[i].limits.tcpSpeed = legs[i].programmed.tcpSpeed = 1e300;
    }
    return legs;
}

Trajectory::Appended Trajectory::appendTogether(const std::vector<Ordered>& moves, double now) {
    planChanged();
    const auto all = [&](const auto& condition) {
        return std::all_of(moves.begin(), moves.end(), condition);
    };
    const auto isEmptyMove = [](const Ordered& move) { return move.path->isEmpty(); };
    endTarget_ = moves.front().path->end();
    for (std::size_t i = 0; i < followers_.size(); ++i)
        if (const auto follower = followers_[i].lock()) follower->endTarget_ = moves[i + 1].path->end();
    Entry* last = entries_.empty() ? nullptr : &entries_.back();
    StopPoint stop = moves.front().command.stop;
    for (const Ordered& move : moves)
        stop = strictest(stop, move.command.stop);
    if (all(isEmptyMove)) {
        double pause = options_.emptyMove;
        for (const Ordered& move : moves)
            pause = std::max(pause, move.command.duration);
        return appendPause(moves.front().path, pause, stop, now);
    }
    // One that keeps its place while others move has no corner to begin or to end its movement in.
    const bool isFlyBy = all([](const Ordered& m) { return !m.command.zone.finep && !keepsPlace(m); });
    std::vector<Leg> legs = legsTogether(moves);
    Leg own = std::move(legs.front());
    legs.erase(legs.begin());
    const bool canFollow = last != nullptr && last->run->isOpen() && last->isScheduled &&
                           std::none_of(moves.begin(), moves.end(), keepsPlace);
    const auto carry = [&](Run& run) {
        for (std::size_t i = 0; i < moves.size(); ++i)
            if (moves[i].carrier) run.setCarrier(i, *moves[i].carrier, moves[i].carrierFrame);
    };
    if (canFollow && last->run->appendTogether(own, legs, isFlyBy, now)) {
        carry(*last->run);
        planChanged();
        last->stop = stop;
        return {{count() - 1, last->run->route().legCount() - 1}, false, false};
    }
    const bool isCornerLost = last != nullptr && last->run->isOpen();
    closeLast();
    RunSettings settings = settingsOf(own.limits.rampShare);
    settings.planner = Planner::Measured; // the optimal one times one robot
    settings.companions = std::make_shared<Companions>(0.5 * (settings.longWindow + settings.shortWindow));
    for (const auto& follower : followers_)
        settings.companions->add(follower.lock()->accelerations_);
    auto run = std::make_unique<Run>(settings, now);
    run->appendTogether(std::move(own), std::move(legs), isFlyBy, now);
    carry(*run);
    Appended result = appendRun(std::move(run), moves.front().path, 0, stop, now);
    result.isCornerLost = isCornerLost;
    return result;
}

RunSettings Trajectory::settings() const {
    RunSettings settings;
    settings.accelerations = &accelerations_;
    settings.speedShare = share_;
    settings.planner = options_.planner;
    settings.jerk = model_.maxJerk;
    return settings;
}

Trajectory::Appended Trajectory::appendPause(const std::shared_ptr<const MotionPath>& path, double seconds,
                                             const StopPoint& stop, double now) {
    closeLast();
    return appendRun(std::make_unique<Run>(settings(), now), path, seconds, stop, now);
}

Trajectory::Appended Trajectory::appendRun(std::unique_ptr<Run> run,
                                           const std::shared_ptr<const MotionPath>& path, double pause,
                                           const StopPoint& stop, double now) {
    Entry entry;
    entry.stop = stop;
    entry.run = std::move(run);
    entry.ordered = now;
    entry.pause = pause;
    entry.path = path;
    entries_.push_back(std::move(entry));
    schedule(count() - 1, now, -std::numeric_limits<double>::infinity());
    Entry& added = entries_.back();
    if (added.isScheduled && pause == 0 && added.run->start() < now) added.late = added.run->course().at(now);
    return {{count() - 1, 0}, false, false};
}

void Trajectory::closeLast() {
    if (!entries_.empty()) entries_.back().run->close();
}

// ---- Time ----

/// When a run begins if nothing holds the arm; nothing while the run before does not come to its end. A run that is known when the
/// stop point before it is reached overlaps with the end of the motion there; one that is ordered when the arm is at rest begins after
/// the delay. In between the time from the order to the beginning changes evenly (docs/motion.md).
std::optional<double> Trajectory::startAfter(std::size_t run) const {
    const Entry& e = entry(run);
    const double delay = e.pause > 0 ? 0 : options_.startDelay;
    if (run == first_) return std::max(e.ordered + delay, earliest_);
    const auto reached = stopTime(run - 1);
    if (!reached) return {};
    const Entry& before = entry(run - 1);
    double atOnce = *reached;
    double settled = kSettling;
    if (e.pause == 0 && before.pause == 0 && before.stop.standTime == 0) {
        const Course& course = before.run->course();
        const double left = options_.overlap * before.run->perMmLeft();
        atOnce = std::max(courseTime(run - 1, course.endPlace() - left), course.plannedEnd()) +
                 (*reached - *inPositionTime(run - 1)); // as much later as the stop point asks for
        settled = std::max(settled, course.end() - *reached);
    }
    const double late = e.ordered - *reached;
    if (late <= kSameMoment) return atOnce;
    const double share = std::min(1.0, late / settled);
    return e.ordered + (1 - share) * (atOnce - *reached) + share * delay;
}

/// Starts of the runs from this one on that have not begun. `earliest`: the arm has been released then.
void Trajectory::schedule(std::size_t from, double now, double earliest) {
    planChanged();
    for (std::size_t i = std::max(from, first_); i < count(); ++i) {
        Entry& e = entry(i);
        if (i > from && hasBegun(e, now)) continue;
        const auto start = isHeld_ ? std::nullopt : startAfter(i);
        e.isScheduled = start.has_value();
        if (start) e.run->startAt(std::max(*start, earliest));
        planChanged();
    }
}

bool Trajectory::hasBegun(const Entry& entry, double time) {
    return entry.isScheduled && entry.run->start() <= time + kNothing;
}

std::size_t Trajectory::activeAt(double time) const {
    std::size_t run = count() - 1;
    while (run > first_ && !hasBegun(entry(run), time))
        --run;
    return run;
}

void Trajectory::setSpeedShare(double now, double share) {
    planChanged();
    share_ = share;
    if (entries_.empty() || isHeld_) return;
    const std::size_t active = activeAt(now);
    for (std::size_t i = active; i < count(); ++i) {
        Entry& e = entry(i);
        if (e.pause > 0) continue;
        if (now < e.run->course().plannedEnd() || !e.isScheduled)
            e.run->plan(std::max(now, e.run->start()), share);
    }
    schedule(active + (hasBegun(entry(active), now) ? 1 : 0), now, now);
}

void Trajectory::setSpeedLimits(double now, const SpeedLimits& most) {
    planChanged();
    speedLimits_ = most;
    if (entries_.empty()) return;
    const std::size_t active = activeAt(now);
    for (std::size_t i = active; i < count(); ++i) {
        Entry& e = entry(i);
        if (e.pause == 0 && (now < e.run->course().plannedEnd() || !e.isScheduled))
            e.run->limitSpeeds(std::max(now, e.run->start()), most);
    }
    if (!isHeld_) schedule(active + (hasBegun(entry(active), now) ? 1 : 0), now, now);
}

void Trajectory::hold(double now, StopKind kind) {
    planChanged();
    if (isHeld_ && kind == StopKind::Normal) return;
    isHeld_ = true;
    if (entries_.empty()) return;
    const std::size_t active = activeAt(now);
    for (std::size_t i = active; i < count(); ++i) {
        Entry& e = entry(i);
        if (!hasBegun(e, now)) e.isScheduled = false;
        if (!e.isScheduled || e.pause > 0) continue;
        const Course& course = e.run->course();
        // The rest of a plan that has ended lies within the last mm, except in a stop on the path.
        if (now < course.plannedEnd() ||
            (kind == StopKind::Quick && e.run->isBraking() && now < course.end()))
            e.run->brake(now, kind);
    }
}

void Trajectory::release(double now) {
    planChanged();
    if (!isHeld_) return;
    isHeld_ = false;
    if (entries_.empty()) return;
    const std::size_t active = activeAt(now);
    Entry& e = entry(active);
    const bool isUnderWay = hasBegun(e, now);
    if (isUnderWay && e.pause == 0 && e.run->isBraking()) e.run->plan(now, share_);
    for (std::size_t i = active + (isUnderWay ? 1 : 0); i < count(); ++i)
        if (entry(i).pause == 0) entry(i).run->plan(entry(i).run->start(), share_);
    schedule(active + (isUnderWay ? 1 : 0), now, now);
}

double Trajectory::restTime() const {
    double end = -std::numeric_limits<double>::infinity();
    for (const Entry& e : entries_)
        if (e.isScheduled) end = std::max(end, e.pause > 0 ? e.run->start() : e.run->course().end());
    if (back_) end = std::max(end, back_->course.end());
    return end;
}

PathPlace Trajectory::restPlaceIfHeld(double time) const {
    if (isHeld_ || back_) return at(restTime()).place;
    const std::size_t active = activeAt(time);
    const Entry& e = entry(active);
    const bool hasBegun = e.isScheduled && e.run->start() <= time;
    if (!hasBegun || e.pause > 0) return at(time).place;
    if (time >= e.run->course().plannedEnd()) return {active, e.run->course().endPlace()};
    return {active, e.run->restPlace(time)};
}

bool Trajectory::isMoving(double time) const {
    // Events happen at whole nanoseconds, a little before or after the exact time.
    const double end = time + kNothing;
    if (back_ && end < back_->course.end()) return true;
    for (const Entry& e : entries_)
        if (e.pause == 0 && hasBegun(e, time) && end < e.run->course().end()) return true;
    return false;
}

/// A run that is ordered at the moment at which the stop point before it is reached has begun a little earlier (startAfter()): it has
/// covered some micrometres then. The arm makes up for them evenly, without a step of place or speed.
CourseState Trajectory::stateOf(const Entry& entry, double time) {
    CourseState state = entry.run->course().at(time);
    const double share = (time - entry.ordered) / kMakingUp;
    if (!(entry.late.s > 0) || share >= 1) return state;
    const double u = std::max(0.0, share);
    const double ofPlace = (2 * u - 3) * u * u + 1;
    const double ofSpeed = ((u - 2) * u + 1) * u * kMakingUp;
    state.s -= entry.late.s * ofPlace + entry.late.v * ofSpeed;
    state.v -= (entry.late.s * 6 * (u - 1) * u / kMakingUp) + entry.late.v * ((3 * u - 4) * u + 1);
    return state;
}

/// The runs before this one that have not settled at that time: mm left and speed, added.
Trajectory::Tail Trajectory::tailBefore(std::size_t run, double time) const {
    Tail tail;
    for (std::size_t i = run; i-- > first_;) {
        if (entry(i).pause > 0) continue;
        const Course& course = runAt(i).course();
        if (time >= course.end()) break;
        const CourseState state = stateOf(entry(i), time);
        tail.left += course.endPlace() - state.s;
        tail.speed += state.v;
    }
    return tail;
}

Trajectory::Moment Trajectory::at(double time) const {
    Moment result;
    if (entries_.empty()) return result;
    if (back_) {
        const CourseState state = back_->course.at(time);
        result.place = {back_->from.run, back_->from.s - state.s};
        result.speed = -state.v;
        return result;
    }
    std::size_t run = activeAt(time);
    const CourseState state = entry(run).isScheduled ? stateOf(entry(run), time) : CourseState{};
    const Tail tail = tailBefore(run, time);
    result.speed = state.v + tail.speed;
    double place = state.s - tail.left;
    while (place < 0 && run > first_)
        place += runAt(--run).route().length();
    result.place = {run, std::max(place, 0.0)};
    return result;
}

double Trajectory::courseTime(std::size_t run, double place) const {
    for (const Found& found : found_)
        if (found.run == run && found.place == place) return found.time;
    const double time = runAt(run).course().timeAt(place);
    found_[nextFound_] = {run, place, time};
    nextFound_ = (nextFound_ + 1) % found_.size();
    return time;
}

std::optional<double> Trajectory::timeAt(const PathPlace& place) const {
    if (place.run < first_ || place.run >= count() || !entry(place.run).isScheduled) return {};
    const Entry& e = entry(place.run);
    if (e.pause > 0) return e.run->start() + (place.s > 0 ? e.pause : 0);
    const Course& course = e.run->course();
    if (place.s > course.endPlace() + kNothing) return {};
    double low = place.s <= kNothing ? e.run->start() : courseTime(place.run, place.s);
    if (tailBefore(place.run, low).left <= kNothing) return low;
    double high = std::max(low, runAt(place.run - 1).course().end());
    if (course.at(high).s < place.s) return low; // at rest in between: it comes there as the tail ends
    for (int i = 0; i < 60 && high - low > 1e-11; ++i) {
        const double middle = 0.5 * (low + high);
        (course.at(middle).s - tailBefore(place.run, middle).left < place.s ? low : high) = middle;
    }
    return high;
}

std::optional<double> Trajectory::inPositionTime(std::size_t run) const {
    const Entry& e = entry(run);
    if (!e.isScheduled) return {};
    if (e.pause > 0) return e.run->start() + e.pause;
    if (e.run->isBraking()) return {};
    const Course& course = e.run->course();
    const double length = course.endPlace();
    const double left = options_.inPosition * e.run->perMmLeft();
    const double near = std::max(courseTime(run, length - std::min(left, 0.5 * length)), course.plannedEnd());
    // After the fly-by point before it, however short the last move is.
    const Route& route = e.run->route();
    const double last = route.legCount() > 1 ? route.legStart(route.legCount() - 1) : 0;
    return length - last >= left ? near : std::max(near, timeAt({run, last}).value_or(near));
}

std::optional<double> Trajectory::stopTime(std::size_t run) const {
    const auto fine = inPositionTime(run);
    const Entry& e = entry(run);
    const StopPoint& stop = e.stop;
    if (!fine) return {};
    if (e.pause > 0) return *fine + std::max(stop.minTime, stop.standTime);
    const Course& course = e.run->course();
    if (stop.standTime > 0) return course.end() + stop.standTime;
    double time = *fine;
    if (stop.positionPercent != 100) {
        const double length = course.endPlace();
        const double left = 0.01 * stop.positionPercent * options_.inPosition * e.run->perMmLeft();
        time = courseTime(run, length - std::min(left, 0.5 * length));
    }
    if (stop.speedPercent < 100) time = std::max(time, slowTime(course, *fine, 0.01 * stop.speedPercent));
    time = std::min(time, *fine + stop.maxTime);
    if (stop.minTime > 0) time = std::max(time, *fine + stop.minTime);
    return std::max(time, course.plannedEnd());
}

std::optional<double> Trajectory::brakingTime(std::size_t run) const {
    const Entry& e = entry(run);
    if (!e.isScheduled || e.run->isBraking()) return {};
    return e.pause > 0 ? e.run->start() : e.run->course().lastBraking();
}

std::optional<double> Trajectory::decisionTime() const {
    if (entries_.empty()) return {};
    const Entry& e = entries_.back();
    if (!e.run->isOpen() || !e.isScheduled || e.run->isBraking()) return {};
    if (options_.planner == Planner::Optimal) return e.run->decisionTime();
    return std::min(e.run->lastBraking(), courseTime(count() - 1, firstZoneEntry(*e.run, followers_.size())));
}

// ---- Places ----

PathPlace Trajectory::legStart(const LegRef& leg) const {
    if (entry(leg.run).pause > 0) return {leg.run, 0};
    return {leg.run, route(leg.run).legStart(leg.leg)};
}

PathPlace Trajectory::legEnd(const LegRef& leg) const {
    if (entry(leg.run).pause > 0) return {leg.run, 1};
    return {leg.run, route(leg.run).legEnd(leg.leg)};
}

PathPlace Trajectory::end() const {
    if (entries_.empty()) return {};
    return {count() - 1, entries_.back().run->route().length()};
}

RoutePoint Trajectory::pointAt(const PathPlace& place) const {
    const Entry& e = entry(place.run);
    if (e.pause > 0) return {e.path->end().robax, e.path->end().extax, true};
    return e.run->route().at(place.s);
}

void Trajectory::ratesAt(const PathPlace& place, const RoutePoint& here, Joints& first,
                         double& tcpRate) const {
    std::fill(first.begin(), first.end(), 0.0);
    tcpRate = 0;
    if (isPause(place.run)) return;
    const Route& way = route(place.run);
    constexpr double kStep = 2e-4; // mm
    const double from = std::clamp(place.s, 0.0, way.length());
    const double to = from + (from + kStep <= way.length() ? kStep : -kStep);
    const RoutePoint near = way.at(to, &here.joints);
    for (std::size_t i = 0; i < first.size(); ++i)
        first[i] = (near.joints[i] - here.joints[i]) / (to - from);
    if (const auto rate = way.curveRateAt(from)) {
        tcpRate = *rate;
        return;
    }
    const FrameSetup& frames = framesAt(place);
    const Vec3 difference = way.tcpOf(frames, near, to).pos - way.tcpOf(frames, here, from).pos;
    tcpRate = norm(difference) / std::abs(to - from);
}

const FrameSetup& Trajectory::framesAt(const PathPlace& place) const {
    const Entry& e = entry(place.run);
    if (e.pause > 0) return e.path->frames();
    const Route& way = e.run->route();
    return way.leg(way.legAt(place.s)).path->frames();
}

// ---- Back along the path ----

void Trajectory::goBack(double now, const PathPlace& to, double mmPerSecond) {
    PathPlace from = at(now).place;
    if (from.run > to.run) from = {to.run, route(to.run).length()};
    back_ = Back{runAt(to.run).courseBack(now, from.s, to.s, mmPerSecond), from};
}

void Trajectory::finishBack(double now) {
    const PathPlace place = at(now).place;
    back_.reset();
    standAt(now, place);
}

void Trajectory::standAt(double now, const PathPlace& place) {
    planChanged();
    back_.reset();
    for (std::size_t i = place.run; i < count(); ++i) {
        Entry& e = entry(i);
        if (e.pause > 0) {
            e.isScheduled = false;
        } else if (i == place.run) {
            e.run->standAt(now, place.s);
            e.late = {};
            e.isScheduled = true;
        } else if (e.isScheduled) {
            e.run->startAt(now);
            e.run->standAt(now, 0);
            e.isScheduled = false;
        }
        e.ordered = std::min(e.ordered, now);
    }
}

bool Trajectory::forgetBefore(double time, const LegRef& leg) {
    LegRef oldest = leg;
    for (const auto& follower : followers_)
        if (const auto asking = follower.lock()) {
            time = std::min(time, asking->oldestTime_);
            oldest = std::min(oldest, asking->oldest_);
        }
    while (entries_.size() > 1 && first_ < oldest.run && entries_.front().run->course().end() <= time) {
        entries_.pop_front();
        ++first_;
    }
    if (first_ != oldest.run || entries_.empty() || entries_.front().pause > 0) return false;
    return entries_.front().run->forgetBefore(time, legStart(oldest).s);
}

} // namespace motion
