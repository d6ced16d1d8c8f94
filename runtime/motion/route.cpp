#include "runtime/motion/route.h"

#include "runtime/motion/tolerances.h"

#include <algorithm>
#include <cmath>

namespace motion {

namespace {

constexpr double kLeastRadius = 0.3; // mm, a zone that is programmed as 0 but not as a stop point (z0)

/// Zone radii in mm of route on one of the legs that meet.
struct Radii {
    double tcp = 0, turn = 0, external = 0;
};

Radii radiiOn(const Leg& leg, const ZoneData& zone) {
    Radii r;
    if (leg.isTurning) {
        const double degrees = std::max({zone.zoneOri, zone.zoneReax, zone.zoneLeax});
        r.tcp = r.turn = r.external = kMmPerDegree * std::max(degrees, 0.03);
    } else {
        r.tcp = std::max(zone.pzoneTcp, kLeastRadius) * leg.perMm;
        r.turn = std::max(zone.pzoneOri * leg.perMm, r.tcp);
        r.external = std::max(zone.pzoneEax * leg.perMm, r.tcp);
    }
    // At most half of the way to the neighbouring point (manual 2.2.3).
    const double half = 0.5 * leg.length();
    return {std::min(r.tcp, half), std::min(r.turn, half), std::min(r.external, half)};
}

/// Place where the first of the curve and the blends of a corner begins.
double zoneBegin(const Corner& corner) {
    double begin = corner.begin;
    if (corner.turn.before > 0) begin = std::min(begin, corner.turn.begin);
    if (corner.external.before > 0) begin = std::min(begin, corner.external.begin);
    return begin;
}

/// Place where the last of them ends.
double zoneEnd(const Corner& corner) {
    double end = corner.end();
    if (corner.turn.before > 0) end = std::max(end, corner.turn.end);
    if (corner.external.before > 0) end = std::max(end, corner.external.end);
    return end;
}

} // namespace

bool Route::isRounded(std::size_t number) const {
    return corner(number).kind != CornerKind::None;
}

std::optional<double> Route::append(Leg leg, double fixedUpTo) {
    if (legs_.empty()) {
        leg.begin = leg.cutStart = leg.cutEnd = 0;
        legs_.push_back(std::move(leg));
        corners_.grow().begin = legs_.back().end();
        layStretches(0);
        return 0;
    }
    const Radii before = radiiOn(legs_.back(), legs_.back().zone);
    Radii after = radiiOn(leg, legs_.back().zone);
    const bool inSpace = !legs_.back().isTurning && !leg.isTurning &&
                         sameTool(legs_.back().path->frames(), leg.path->frames());
    double first = before.tcp;
    double second = after.tcp;
    if (inSpace) first = second = std::min(first, second);
    if (legs_.back().end() - first < fixedUpTo - kNothing) return {};
    const bool betweenJoints = !legs_.back().path->isCartesian() && !leg.path->isCartesian();

    legs_.push_back(std::move(leg));
    corners_.grow();
    for (const CornerKind kind : {CornerKind::Space, CornerKind::Joint}) {
        if (kind == CornerKind::Space && (!inSpace || betweenJoints)) continue;
        makeCorner(kind, first, second, fixedUpTo);
        const double changed = zoneBegin(corners_[corners_.size() - 2]);
        keptStretches_ = stretches_.size();
        while (keptStretches_ > 0 && stretches_[keptStretches_ - 1].end > changed + kNothing)
            --keptStretches_;
        replacedStretches_.clear();
        for (std::size_t i = keptStretches_; i < stretches_.size(); ++i)
            replacedStretches_.push_back(stretches_[i]);
        stretches_.resize(keptStretches_);
        if (layStretches(stretches_.empty() ? changed : stretches_.back().end)) return changed;
        restoreStretches();
    }
    dropLastLeg();
    return {};
}

void Route::dropLastLeg() {
    legs_.pop_back();
    corners_.pop_back();
    legs_.back().cutEnd = 0;
    corners_.back() = {};
    corners_.back().begin = legs_.back().end();
}

void Route::restoreStretches() {
    stretches_.resize(keptStretches_);
    for (const RouteStretch& stretch : replacedStretches_)
        stretches_.push_back(stretch);
}

void Route::undoAppend() {
    restoreStretches();
    replacedStretches_.clear();
    dropLastLeg();
}

void Route::makeCorner(CornerKind kind, double before, double after, double fixedUpTo) {
    Leg& a = legs_[legs_.size() - 2];
    Leg& b = legs_.back();
    Corner& corner = corners_[corners_.size() - 2];
    corner = {};
    corner.kind = kind;
    corner.isSmooth = isSmooth_;
    corner.before = before;
    corner.after = after;
    if (kind == CornerKind::Space) {
        curveInSpace(corner, a, b);
        const Radii first = radiiOn(a, a.zone);
        const Radii second = radiiOn(b, a.zone);
        const double room = std::max(before, a.pathBegin() + a.length() - fixedUpTo);
        const double turn = std::min({first.turn, second.turn, room});
        const double external = std::min({first.external, second.external, room});
        blendTurn(corner, a, b, std::max(turn, before), std::max(turn, after));
        blendExternal(corner, a, b, std::max(external, before), std::max(external, after));
    } else {
        curveOfAxes(corner, a, b);
    }
    a.cutEnd = before;
    b.cutStart = after;
    placeLastCorner();
}

void Route::placeLastCorner() {
    const Leg& a = legs_[legs_.size() - 2];
    Leg& b = legs_.back();
    Corner& corner = corners_[corners_.size() - 2];
    corner.begin = a.end();
    b.begin = corner.end();
    const auto place = [&](auto& blend) {
        blend.begin = a.pathBegin() + a.length() - blend.before;
        blend.end = b.pathBegin() + blend.after;
    };
    place(corner.turn);
    place(corner.external);
    corners_.back().begin = b.end();
}

/// Whether the place lies in a corner or in a zone of orientation or external axes.
bool Route::isShaped(std::size_t own, double place) const {
    if (place > leg(own).end()) return true;
    const auto covers = [&](const Corner& c) { return c.turn.covers(place) || c.external.covers(place); };
    return covers(corner(own)) || (own > firstLeg_ && covers(corner(own - 1)));
}

std::optional<double> Route::curveRate(std::size_t own, bool inCorner) const {
    if (inCorner) return corner(own).kind == CornerKind::Space ? std::optional(1.0) : std::nullopt;
    const Leg& l = leg(own);
    if (!l.path->isCartesian()) return {};
    return l.length() > 0 ? 1 / l.perMm : 0;
}

std::optional<double> Route::curveRateAt(double place) const {
    const std::size_t own = ownLeg(place);
    const bool inCorner = place > leg(own).end() && isRounded(own);
    if (inCorner && corner(own).kind == CornerKind::Space && corner(own).reversalRate > 0) {
        const Corner& c = corner(own);
        const double x = c.lengths.parameterAt(place - c.begin);
        const double mm = norm(c.space.slopeAt(x));
        return mm / c.routeRate(x, mm);
    }
    return curveRate(own, inCorner);
}

/// Of a work object that another robot carries. Without a carrier that is known it passes through the programmed points.
std::optional<Pose> Route::userFrameAt(double place) const {
    const std::size_t number = legAt(place);
    const Leg& l = leg(number);
    if (l.path->frames().userCourse == nullptr) return {};
    if (carrier_) return carrier_(place);
    const double whole = legEnd(number) - legStart(number);
    const double share = whole > 0 ? (place - legStart(number)) / whole : 1;
    return (*l.path->frames().userCourse)(std::clamp(share, 0.0, 1.0));
}

Pose Route::tcpOf(const FrameSetup& frames, const RoutePoint& point, double place) const {
    const Pose flange = legs_.front().path->kinematics().forward(point.joints);
    if (frames.userCourse == nullptr) return frames.fromFlange(flange, point.extax);
    const auto user = userFrameAt(place);
    return frames.fromFlange(flange, point.extax, user ? &*user : nullptr);
}

Pose Route::flangeFor(const MotionPath& path, const Pose& target, const ExternalAxes& axes,
                      double place) const {
    if (path.frames().userCourse == nullptr) return path.flangeOf(target, axes);
    const auto user = userFrameAt(place);
    return path.flangeOf(target, axes, user ? &*user : nullptr);
}

std::size_t Route::ownLeg(double place) const {
    if (!legs_.empty() && place >= legs_.back().begin)
        return legCount() - 1; // mostly of a leg that is appended
    const std::size_t begun = legs_.countUpTo(place, [](const Leg& l) { return l.begin; });
    return firstLeg_ + (begun == 0 ? 0 : begun - 1);
}

RoutePoint Route::at(double place, const Joints* near) const {
    return pointAt(std::clamp(place, 0.0, length()), near);
}

const Joints& Route::jointsNear(double place) const {
    return stretches_.empty() ? legs_.front().path->start().robax
                              : stretches_[stretchAt(place)].middle.joints;
}

RoutePoint Route::pointAt(double place, const Joints* near) const {
    Sought sought;
    robot::InverseTask task;
    seekPoint(ownLeg(place), place, near, sought, task);
    find({&sought, 1}, {&task, 1});
    return sought.point;
}

void Route::at(std::span<const double> places, std::span<RoutePoint> points) const {
    constexpr std::size_t kTogether = 3;
    std::array<Sought, kTogether> sought;
    std::array<robot::InverseTask, kTogether> tasks;
    for (std::size_t first = 0; first < places.size(); first += kTogether) {
        const std::size_t count = std::min(kTogether, places.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            const double place = std::clamp(places[first + i], 0.0, length());
            sought[i] = {};
            seekPoint(ownLeg(place), place, nullptr, sought[i], tasks[i]);
        }
        find(std::span(sought).first(count), std::span(tasks).first(count));
        for (std::size_t i = 0; i < count; ++i)
            points[first + i] = sought[i].point;
    }
}

void Route::find(std::span<Sought> points, std::span<robot::InverseTask> tasks) const {
    const robot::Kinematics& kinematics = legs_.front().path->kinematics();
    const auto isTask = [](const Sought& point) { return point.isTask; };
    if (std::all_of(points.begin(), points.end(), isTask)) {
        kinematics.inverseContinueEach(tasks);
    } else {
        for (std::size_t i = 0; i < points.size(); ++i)
            if (points[i].isTask) kinematics.inverseContinueEach(tasks.subspan(i, 1));
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        Sought& sought = points[i];
        if (!sought.isTask) continue;
        sought.point.joints = tasks[i].joints;
        if (tasks[i].isSolved) continue;
        sought.point.isSolved = sought.isAsMeasured;
        sought.tcp.reset();
    }
}

void Route::seekPoint(std::size_t own, double place, const Joints* near, Sought& sought,
                      robot::InverseTask& task) const {
    if (place > leg(own).end() && isRounded(own))
        seekInCorner(own, place, near, sought, task);
    else
        seekOnLeg(own, place, near, sought, task);
}

void Route::seekOnLeg(std::size_t number, double place, const Joints* near, Sought& sought,
                      robot::InverseTask& task) const {
    const Leg& l = leg(number);
    const double distance = place - l.pathBegin();
    const double parameter = l.lengths.parameterAt(distance);
    RoutePoint& point = sought.point;
    point.extax = l.path->externalAt(parameter);
    const Corner* turning = nullptr;
    // By external axes, or another robot, that are elsewhere than on the leg itself.
    bool isCarried = l.path->isCartesian() && l.path->frames().userCourse != nullptr;
    const Leg* frames = &l;
    std::optional<double> armAngle;
    for (const bool atEnd : {false, true}) {
        if (!atEnd && number == firstLeg_) continue;
        const Corner& c = corner(atEnd ? number : number - 1);
        if (c.external.covers(place)) {
            const AxisVector axes = c.external.at(place);
            takeExternal(axes, point.extax);
            if (l.path->kinematics().hasArmAngle()) armAngle = axes.v[kArmAnglePlace];
            isCarried = isCarried || (l.path->isCartesian() && l.path->frames().dependsOnAxes());
        }
        if (!c.turn.covers(place)) continue;
        turning = &c;
        if (atEnd) frames = &leg(number + 1);
    }
    if (turning == nullptr && !armAngle && !isCarried) {
        sought.isTask = sought.isAsMeasured = l.path->seeksJoints(parameter, task, sought.tcp);
        if (!sought.isTask) point.joints = l.path->jointsAt(parameter, &sought.tcp);
        return;
    }
    Pose pose = poseIn(l, *frames, distance);
    if (turning != nullptr) pose.rot = robot::turnedBy(turning->centre, turning->turn.at(place));
    sought.isTask = true;
    task.seed = near != nullptr ? near : &jointsNear(place);
    task.flange = flangeFor(*frames->path, pose, point.extax, place);
    task.armAngleDeg = armAngle ? *armAngle : l.path->armAngleAt(parameter);
    if (frames == &l) sought.tcp = pose;
}

void Route::seekInCorner(std::size_t number, double place, const Joints* near, Sought& sought,
                         robot::InverseTask& task) const {
    const Corner& c = corner(number);
    const Leg& next = leg(number + 1);
    const double x = c.lengths.parameterAt(place - c.begin);
    RoutePoint& point = sought.point;
    point.extax = next.path->start().extax;
    if (c.kind == CornerKind::Joint) {
        const AxisVector axes = c.axes.at(x);
        point.joints = near != nullptr ? *near : jointsNear(place);
        std::copy_n(axes.v.begin(), point.joints.size(), point.joints.begin());
        takeExternal(axes, point.extax);
        return;
    }
    task.armAngleDeg = c.armAngle;
    if (c.external.covers(place)) {
        const AxisVector axes = c.external.at(place);
        takeExternal(axes, point.extax);
        task.armAngleDeg = axes.v[kArmAnglePlace];
    }
    const Pose pose{c.space.at(x),
                    c.turn.covers(place) ? robot::turnedBy(c.centre, c.turn.at(place)) : c.centre};
    sought.isTask = true;
    task.seed = near != nullptr ? near : &jointsNear(place);
    task.flange = flangeFor(*next.path, pose, point.extax, place);
    sought.tcp = pose;
}

double Route::legStart(std::size_t number) const {
    return number == firstLeg_ ? leg(number).pathBegin() : corner(number - 1).middle();
}

double Route::legEnd(std::size_t number) const {
    return corner(number).middle();
}

double Route::zoneEntry(std::size_t number) const {
    const Corner& c = corner(number);
    if (c.kind == CornerKind::None) { // not known yet: as programmed
        const Leg& l = leg(number);
        const Radii r = radiiOn(l, l.zone);
        return l.end() - (l.zone.finep ? 0 : std::max({r.tcp, r.turn, r.external}));
    }
    return zoneBegin(c);
}

double Route::zoneExit(std::size_t number) const {
    const Corner& c = corner(number);
    return c.kind == CornerKind::None ? leg(number).end() : zoneEnd(c);
}

double Route::placeAfterStart(std::size_t number, double mm) const {
    const Leg& l = leg(number);
    const double distance = std::clamp(mm * l.perMm, 0.0, l.length());
    if (distance < l.cutStart && number > firstLeg_) {
        const Corner& c = corner(number - 1);
        return c.middle() + (c.end() - c.middle()) * distance / l.cutStart;
    }
    const double beyond = distance - (l.length() - l.cutEnd);
    if (beyond <= 0 || l.cutEnd == 0) return l.pathBegin() + distance;
    const Corner& c = corner(number);
    return c.begin + (c.middle() - c.begin) * beyond / l.cutEnd;
}

double Route::placeBeforeEnd(std::size_t number, double mm) const {
    const Leg& l = leg(number);
    return placeAfterStart(number, l.length() / l.perMm - mm);
}

std::size_t Route::legAt(double place) const {
    return legBy(ownLeg(place), place);
}

std::size_t Route::legBy(std::size_t own, double place) const {
    return own + 1 < legCount() && place > corner(own).middle() ? own + 1
           : own > firstLeg_ && place < legStart(own)           ? own - 1
                                                                : own;
}

std::size_t Route::stretchAt(double place) const {
    const std::size_t begun = stretches_.countUpTo(place, [](const RouteStretch& s) { return s.begin; });
    return begun == 0 ? 0 : begun - 1;
}

std::size_t Route::forgetBefore(double place) {
    std::size_t stretches = 0;
    while (stretches + 1 < stretches_.size() && stretches_[stretches].end <= place)
        ++stretches;
    stretches_.forget(stretches);
    std::size_t legs = 0; // of the leg before, the corner between is needed
    while (legs + 2 < legs_.size() && legs_[legs + 1].begin <= place)
        ++legs;
    legs_.forget(legs);
    corners_.forget(legs);
    firstLeg_ += legs;
    return stretches;
}

} // namespace motion
