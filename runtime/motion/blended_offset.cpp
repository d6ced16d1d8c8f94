#include "runtime/motion/blended_offset.h"

#include <algorithm>

namespace motion {

void BlendedOffset::advance(TimeNs time, const Vec3& target, double progress) {
    done_ = std::min(length_, done_ + progress);
    keep(time, target + difference());
}

void BlendedOffset::jumpTo(TimeNs time, const Vec3& target, double length) {
    const Vec3 rate = this->rate();
    from_ = now_ - target;
    fromRate_ = length > 0 ? rate : Vec3{};
    length_ = std::max(0.0, length);
    done_ = 0;
    keep(time, target + difference());
}

/// A polynomial of fifth degree: from_ and fromRate_ at the beginning, without curvature at both ends.
Vec3 BlendedOffset::difference() const {
    if (!(done_ < length_)) return {};
    const double u = done_ / length_;
    const double u3 = u * u * u;
    const double value = 1 - u3 * (10 - u * (15 - 6 * u));
    const double slope = u - u3 * (6 - u * (8 - 3 * u));
    return from_ * value + fromRate_ * (slope * length_);
}

Vec3 BlendedOffset::rate() const {
    if (!(done_ < length_)) return {};
    const double u = done_ / length_;
    const double u2 = u * u;
    const double value = -30 * u2 * (1 - u) * (1 - u) / length_;
    const double slope = 1 - u2 * (18 - u * (32 - 15 * u));
    return from_ * value + fromRate_ * slope;
}

Vec3 BlendedOffset::at(TimeNs time) const {
    if (kept_.empty()) return now_;
    const auto after = std::upper_bound(kept_.begin(), kept_.end(), time,
                                        [](TimeNs value, const Kept& kept) { return value < kept.time; });
    if (after == kept_.begin()) return after->offset;
    if (after == kept_.end()) return kept_.back().offset;
    const Kept& before = *(after - 1);
    const double share =
        static_cast<double>(time - before.time) / static_cast<double>(after->time - before.time);
    return before.offset * (1 - share) + after->offset * share;
}

bool BlendedOffset::isNone() const {
    const Vec3 none;
    return now_ == none &&
           std::all_of(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.offset == none; });
}

/// From now on nothing before it can be asked: it belongs to another path.
void BlendedOffset::reset() {
    now_ = from_ = fromRate_ = {};
    done_ = length_ = 0;
    kept_.clear();
}

void BlendedOffset::store() {
    stored_.push_back(now_);
    reset();
}

void BlendedOffset::restore() {
    if (stored_.empty()) return;
    reset();
    now_ = stored_.back();
    stored_.pop_back();
}

void BlendedOffset::forgetBefore(TimeNs time) {
    while (kept_.size() > 1 && kept_[1].time <= time)
        kept_.pop_front();
}

void BlendedOffset::keep(TimeNs time, const Vec3& offset) {
    now_ = offset;
    while (!kept_.empty() && kept_.back().time >= time)
        kept_.pop_back();
    kept_.push_back({time, offset});
}

} // namespace motion
