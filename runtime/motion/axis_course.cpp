#include "runtime/motion/axis_course.h"

#include <algorithm>
#include <cmath>

namespace motion {

AxisCourse::AxisCourse(double time, AxisMoment from) : pieces_{{time, from.position, from.speed, 0}} {}

AxisMoment AxisCourse::momentOn(const Piece& piece, double time) {
    const double t = time - piece.start;
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
    if (after != pieces_.begin() && (after - 1)->start < time)
        result.pieces_.insert(result.pieces_.begin(), *(after - 1));
    return result;
}

/// From the end of the course on.
void AxisCourse::changeSpeed(double speed, double acceleration) {
    Piece& last = pieces_.back();
    const double change = speed - last.speed;
    if (change == 0) return;
    last.acceleration = std::copysign(acceleration, change);
    const double end = last.start + std::fabs(change) / acceleration;
    pieces_.push_back({end, momentOn(last, end).position, speed, 0});
}

void AxisCourse::keepSpeed(double seconds) {
    if (!(seconds > 0)) return;
    const Piece last = pieces_.back();
    pieces_.push_back({last.start + seconds, last.position + last.speed * seconds, last.speed, 0});
}

AxisCourse AxisCourse::turning(double time, double speed, double acceleration) const {
    AxisCourse result = upTo(time);
    result.changeSpeed(speed, acceleration);
    return result;
}

AxisCourse AxisCourse::movedTo(double time, double position, double speed, double acceleration) const {
    AxisCourse result = upTo(time);
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
