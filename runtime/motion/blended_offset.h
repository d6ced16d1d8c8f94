#pragma once
// BlendedOffset: a displacement that follows a target exactly, and passes jumps of it smoothly.

#include "runtime/motion/path_modifier.h"

#include <deque>
#include <vector>

namespace motion {

class BlendedOffset {
  public:
    /// The target at the next moment of time. `progress`: how much further the blend is, in s, mm or whatever `length` of
    /// jumpTo() is measured in.
    void advance(TimeNs time, const Vec3& target, double progress);
    /// As advance(), and the target has jumped there: the difference to where the displacement is now vanishes over `length`.
    void jumpTo(TimeNs time, const Vec3& target, double length);

    /// The displacement of the latest advance(), and at a time that is kept.
    const Vec3& now() const { return now_; }
    Vec3 at(TimeNs time) const;
    /// How fast the difference to the target vanishes at present, per unit of progress.
    Vec3 rate() const;
    /// No displacement now, nor at a time that is kept.
    bool isNone() const;

    /// The path begins where the arm is: no displacement.
    void reset();
    void store();
    void restore();
    void clearStored() { stored_.clear(); }
    void forgetBefore(TimeNs time);

  private:
    struct Kept {
        TimeNs time = 0;
        Vec3 offset;
    };
    Vec3 difference() const;
    void keep(TimeNs time, const Vec3& offset);

    Vec3 now_;
    Vec3 from_, fromRate_; ///< difference to the target, and its change per unit of progress, at the jump
    double done_ = 0, length_ = 0;
    std::deque<Kept> kept_;
    std::vector<Vec3> stored_;
};

} // namespace motion
