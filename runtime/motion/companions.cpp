#include "runtime/motion/companions.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

constexpr double kLevel = 1e-12;

double ratioOn(const Route& leader, const Route& own, std::size_t leg) {
    const double length = leader.leg(leg).length();
    return length > kLevel ? own.leg(leg).length() / length : 0;
}

/// A place on both routes.
struct Knot {
    double leader = 0, own = 0;
};

/// Around the point at the end of a leg the companion's share in the movement changes from that of one leg to that of the
/// next. All robots are in the middles of their corners at the same time.
struct Transition {
    bool exists = false;
    Knot begin, middle, end;
};

Transition transitionAt(const Route& leader, const Route& own, std::size_t leg) {
    Transition t;
    if (leg + 1 >= leader.legCount() || leg + 1 >= own.legCount()) return t;
    t.exists = true;
    const Leg& leaderFirst = leader.leg(leg);
    const Leg& leaderSecond = leader.leg(leg + 1);
    const Leg& ownFirst = own.leg(leg);
    const Leg& ownSecond = own.leg(leg + 1);
    const double before =
        std::max(leaderFirst.cutEnd / leaderFirst.length(), ownFirst.cutEnd / ownFirst.length());
    const double after =
        std::max(leaderSecond.cutStart / leaderSecond.length(), ownSecond.cutStart / ownSecond.length());
    t.begin = {leaderFirst.pathBegin() + leaderFirst.length() * (1 - before),
               ownFirst.pathBegin() + ownFirst.length() * (1 - before)};
    t.middle = {leader.legEnd(leg), own.legEnd(leg)};
    t.end = {leaderSecond.pathBegin() + leaderSecond.length() * after,
             ownSecond.pathBegin() + ownSecond.length() * after};
    return t;
}

/// Cubic from one place and slope to another that never goes back.
Companions::Mapped cubic(const Knot& from, const Knot& to, double firstSlope, double lastSlope,
                         double place) {
    const double width = to.leader - from.leader;
    const double rise = to.own - from.own;
    if (!(width > kLevel)) return {from.own, lastSlope};
    const double mean = rise / width;
    const double a = std::min(firstSlope, 3 * mean); // Fritsch and Carlson
    const double b = std::min(lastSlope, 3 * mean);
    const double x = (place - from.leader) / width;
    const double y = 1 - x;
    const double height = x * x * (3 - 2 * x);
    return {from.own + rise * height + width * (a * x * y * y - b * x * x * y),
            mean * 6 * x * y + a * y * (1 - 3 * x) + b * x * (3 * x - 2)};
}

double slopeBetween(const Knot& from, const Knot& to) {
    return to.leader - from.leader > kLevel ? (to.own - from.own) / (to.leader - from.leader) : 0;
}

Companions::Mapped inTransition(const Transition& t, double firstSlope, double lastSlope, double place) {
    const double before = slopeBetween(t.begin, t.middle);
    const double after = slopeBetween(t.middle, t.end);
    const double middle = before + after > 0 ? 2 * before * after / (before + after) : 0;
    return place < t.middle.leader ? cubic(t.begin, t.middle, firstSlope, middle, place)
                                   : cubic(t.middle, t.end, middle, lastSlope, place);
}

/// The stretch of a companion as the leader sees it, `slope` mm a mm of its route.
RouteStretch seenByLeader(RouteStretch s, double slope, double change) {
    for (std::size_t i = 0; i < s.first.size(); ++i) {
        s.second[i] = s.second[i] * slope * slope + s.first[i] * change;
        s.first[i] *= slope;
    }
    for (std::size_t i = 0; i < s.externalFirst.size(); ++i) {
        s.externalSecond[i] = s.externalSecond[i] * slope * slope + s.externalFirst[i] * change;
        s.externalFirst[i] *= slope;
    }
    s.tcpRate *= slope;
    s.turnRate *= slope;
    s.armRate *= slope;
    s.curvature *= slope * slope;
    if (slope > kLevel) {
        s.zoneLength /= slope;
        s.end = s.begin + (s.end - s.begin) / slope;
    }
    return s;
}

} // namespace

Companions::Mapped Companions::placeOf(std::size_t member, const Route& leader, double place) const {
    const Route& own = route(member);
    const std::size_t leg = leader.legAt(place);
    const double ratio = ratioOn(leader, own, leg);
    if (leg > leader.firstLeg() && leader.isRounded(leg - 1)) {
        const Transition t = transitionAt(leader, own, leg - 1);
        if (t.exists && place < t.end.leader)
            return inTransition(t, ratioOn(leader, own, leg - 1), ratio, std::max(place, t.begin.leader));
    }
    if (leader.isRounded(leg)) {
        const Transition t = transitionAt(leader, own, leg);
        if (t.exists && place > t.begin.leader)
            return inTransition(t, ratio, ratioOn(leader, own, leg + 1), std::min(place, t.end.leader));
    }
    const double distance = place - leader.leg(leg).pathBegin();
    return {std::clamp(own.leg(leg).pathBegin() + distance * ratio, 0.0, own.length()), ratio};
}

double Companions::leaderPlace(std::size_t member, const Route& leader, double place) const {
    double low = 0;
    double high = leader.length();
    if (place <= 0) return low;
    if (place >= route(member).length()) return high;
    for (int i = 0; i < 60 && high - low > 1e-10; ++i) {
        const double middle = 0.5 * (low + high);
        (placeOf(member, leader, middle).place < place ? low : high) = middle;
    }
    return high;
}

bool Companions::append(std::vector<Leg> legs, const Route& leader, double fixed) {
    std::vector<Route> appended;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        appended.push_back(members_[i].route);
        const double own = leader.legCount() == 0 ? 0 : placeOf(i, leader, fixed).place;
        if (!appended.back().append(std::move(legs[i]), own)) return false;
    }
    for (std::size_t i = 0; i < members_.size(); ++i)
        members_[i].route = std::move(appended[i]);
    return true;
}

double Companions::largestSlope(std::size_t member, const Route& leader, double from, double to) const {
    const int looks =
        std::clamp(static_cast<int>(2 * (to - from)), 12, 120); // two a mm: it changes fast in a corner
    double largest = 0;
    for (int k = 0; k <= looks; ++k)
        largest = std::max(largest, placeOf(member, leader, from + (to - from) * k / looks).slope);
    return largest;
}

void Companions::tighten(const Route& leader, const RouteStretch& stretch, StretchLimits& limits) const {
    const double width = stretch.end - stretch.begin;
    for (std::size_t i = 0; i < members_.size(); ++i) {
        const Route& own = members_[i].route;
        if (own.stretches().empty()) continue;
        const Mapped begin = placeOf(i, leader, stretch.begin);
        const Mapped end = placeOf(i, leader, stretch.end);
        const double slope = largestSlope(i, leader, stretch.begin, stretch.end);
        // Averaging in time would pass over a short peak: the programmed speed holds for its surroundings as well.
        const double reach = averaging_ * limits.speed;
        const double around = largestSlope(i, leader, std::max(0.0, stretch.begin - reach),
                                           std::min(leader.length(), stretch.end + reach));
        const double change = (end.slope - begin.slope) / width;
        const std::size_t last = own.stretchAt(end.place);
        for (std::size_t k = own.stretchAt(begin.place); k <= last; ++k) {
            const RouteStretch& s = own.stretches()[k];
            StretchLimits l;
            limitsOn(seenByLeader(s, slope, change), own.leg(s.leg).limits, members_[i].accelerations, l);
            limits.speed = std::min(limits.speed, l.speed * (around > kLevel ? slope / around : 1));
            limits.bendSquare = std::min(limits.bendSquare, l.bendSquare);
            limits.gain = std::min(limits.gain, l.gain);
            limits.drop = std::min(limits.drop, l.drop);
            limits.more.push_back(l.rows);
        }
    }
}

} // namespace motion
