#include "runtime/host/belt.h"

#include <algorithm>
#include <cmath>

namespace rt {

namespace {

double secondsBetween(Time from, Time to) {
    return 1e-9 * static_cast<double>(to - from);
}

} // namespace

Belt::Belt(double speed, double acceleration) : acceleration_(acceleration), target_(speed) {
    pieces_.push_back({0, 0, speed, 0});
}

const Belt::Piece& Belt::pieceAt(Time time) const {
    const auto after = std::upper_bound(pieces_.begin(), pieces_.end(), time,
                                        [](Time value, const Piece& piece) { return value < piece.start; });
    return after == pieces_.begin() ? *after : *(after - 1);
}

double Belt::position(Time time) const {
    const Piece& piece = pieceAt(time);
    const double t = secondsBetween(piece.start, time);
    return piece.position + t * (piece.speed + t * piece.acceleration / 2);
}

double Belt::speed(Time time) const {
    const Piece& piece = pieceAt(time);
    return piece.speed + secondsBetween(piece.start, time) * piece.acceleration;
}

void Belt::setSpeed(Time time, double speed) {
    const Piece now{time, position(time), this->speed(time), 0};
    target_ = speed;
    while (!pieces_.empty() && pieces_.back().start >= time)
        pieces_.pop_back();
    Piece ramp = now;
    ramp.acceleration = std::copysign(acceleration_, speed - now.speed);
    const Time end = addTime(time, fromSeconds(std::fabs(speed - now.speed) / acceleration_));
    if (end > time) pieces_.push_back(ramp);
    const double t = secondsBetween(time, end);
    pieces_.push_back({end, now.position + t * (now.speed + t * ramp.acceleration / 2), speed, 0});
    while (pieces_.size() > kMostPieces)
        pieces_.pop_front();
}

void Belt::restore(Time time, double position, double speed, double target) {
    pieces_ = {{time, position, speed, 0}};
    setSpeed(time, target);
}

Time Belt::whenAt(double position, Time from) const {
    Time begin = from;
    for (;;) {
        const Piece& piece = pieceAt(begin);
        const auto next = std::upper_bound(pieces_.begin(), pieces_.end(), begin,
                                           [](Time value, const Piece& p) { return value < p.start; });
        const Time end = next == pieces_.end() ? kNever : next->start;
        // The first time after `begin` at which the position is met within the piece.
        const double a = piece.acceleration / 2, b = piece.speed, c = piece.position - position;
        const double earliest = secondsBetween(piece.start, begin);
        double found = -1;
        if (a == 0) {
            if (b != 0) found = -c / b;
        } else if (const double root = b * b - 4 * a * c; root >= 0) {
            const double first = (-b - std::sqrt(root)) / (2 * a), second = (-b + std::sqrt(root)) / (2 * a);
            found = std::min(first, second) >= earliest ? std::min(first, second) : std::max(first, second);
        }
        if (found >= earliest) {
            const Time time = addTime(piece.start, static_cast<Time>(std::ceil(std::min(found, 4e9) * 1e9)));
            if (time < end) return time;
        }
        if (end == kNever) return kNever;
        begin = end;
    }
}

} // namespace rt
