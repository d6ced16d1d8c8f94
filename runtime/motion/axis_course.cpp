#include "runtime/motion/axis_course.h"

#include "runtime/motion/axis_profile.h"

#include <algorithm>
#include <cmath>

namespace motion {

AxisCourse::AxisCourse(double time, AxisMoment from) : pieces_{{time, from.position, from.speed, 0, 0}} {}

AxisMoment AxisCourse::momentOn(const Piece& piece, double time) {
    const double t = time - piece.start;
    if (piece.jerk != 0) {
        const AxisState state = advanced({piece.position, piece.speed, piece.acceleration}, piece.jerk, t);
        return {state.p, state.v};
    }
    return {piece.position + (piece.speed + 0.5 * piece.acceleration * t) * t,
            piece.speed + piece.acceleration * t};
}

AxisMoment AxisCourse::at(double time) const {
    time = std::max(time, pieces_.front().start);
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), time,
                                        [](double value, const Piece& piece) { return value < piece.start; });
    return momentOn(after == pieces_.begin() ? *after : *(after - 1), time);
}

/// The piece at that time only, and its end there.
AxisCourse AxisCourse::upTo(double time) const {
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), time,
                                        [](double value, const Piece& piece) { return value < piece.start; });
    AxisCourse result(time, at(time));
    if (after != pieces_.begin() && (after - 1)->start < time) {
        const Piece& piece = *(after - 1);
        result.pieces_.back().acceleration = piece.acceleration + piece.jerk * (time - piece.start);
        result.pieces_.insert(result.pieces_.begin(), piece);
    }
    return result;
}

/// From the end of the course on.
void AxisCourse::changeSpeed(double speed, double acceleration) {
    Piece& last = pieces_.back();
    const double change = speed - last.speed;
    if (change == 0) return;
    last.acceleration = std::copysign(acceleration, change);
    const double end = last.start + std::fabs(change) / acceleration;
    pieces_.push_back({end, momentOn(last, end).position, speed, 0, 0});
}

void AxisCourse::keepSpeed(double seconds) {
    if (!(seconds > 0)) return;
    const Piece last = pieces_.back();
    pieces_.push_back({last.start + seconds, last.position + last.speed * seconds, last.speed, 0, 0});
}

AxisState AxisCourse::lastState() const {
    const Piece& last = pieces_.back();
    return {last.position, last.speed, last.acceleration};
}

void AxisCourse::keepJerk(double seconds, double jerk) {
    if (!(seconds > 0)) return;
    Piece& last = pieces_.back();
    last.jerk = jerk;
    const AxisState end = advanced(lastState(), jerk, seconds);
    pieces_.push_back({last.start + seconds, end.p, end.v, end.a, 0});
}

/// Without what rounding has left.
void AxisCourse::settle(double position, double speed) {
    Piece& last = pieces_.back();
    last.position = position;
    last.speed = speed;
    last.acceleration = last.jerk = 0;
}

AxisCourse AxisCourse::turning(double time, double speed, double acceleration, double jerk) const {
    AxisCourse result = upTo(time);
    if (jerk > 0) {
        const VelocityRamp ramp = rampTo(speed, result.lastState(), acceleration, jerk);
        for (std::size_t i = 0; i < ramp.time.size(); ++i)
            result.keepJerk(ramp.time[i], ramp.jerkOf(i));
        result.settle(result.pieces_.back().position, speed);
        return result;
    }
    result.pieces_.back().acceleration = 0;
    result.changeSpeed(speed, acceleration);
    return result;
}

AxisCourse AxisCourse::movedTo(double time, double position, double speed, double acceleration,
                               double jerk) const {
    AxisCourse result = upTo(time);
    if (jerk > 0) {
        const AxisProfile way =
            AxisProfile::between(result.lastState(), {position, 0, 0}, {speed, acceleration, jerk});
        for (std::size_t i = 0; i < AxisProfile::kPieces; ++i)
            result.keepJerk(way.times()[i], way.jerks()[i]);
        result.settle(position, 0);
        return result;
    }
    result.pieces_.back().acceleration = 0;
    const auto left = [&] { return position - result.pieces_.back().position; };
    const double begun = result.pieces_.back().speed;
    const double braking = begun * std::fabs(begun) / (2 * acceleration);
    const bool isPassing = begun * left() < 0 || std::fabs(braking) > std::fabs(left());
    if (begun != 0 && isPassing) result.changeSpeed(0, acceleration);
    const double way = left();
    if (way == 0 && result.pieces_.back().speed == 0) return result;
    const double start = result.pieces_.back().speed;
    const double highest = std::sqrt(acceleration * std::fabs(way) + 0.5 * start * start);
    const double cruise = std::copysign(std::min(speed, highest), way);
    result.changeSpeed(cruise, acceleration);
    const double brakeWay = cruise * std::fabs(cruise) / (2 * acceleration);
    result.keepSpeed((left() - brakeWay) / cruise);
    result.changeSpeed(0, acceleration);
    result.pieces_.back().position = position; // without rounding
    return result;
}

} // namespace motion
