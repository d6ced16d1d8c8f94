#pragma once
// Weaving: a pattern that repeats itself along the path, across it (arc welding).

#include "runtime/motion/path_offset.h"

namespace motion {

enum class WeaveShape : uint8_t { None, Zigzag, Vee, Triangle, Circle };

/// One cycle of a pattern, mm and deg, in the weave frame: x along the path, y to the left, z away from the workpiece (against
/// the tool). A cycle begins in the middle, goes to the left, and through the middle to the right and back; the triangle goes
/// from the left to the right and then to the middle.
struct WeavePattern {
    WeaveShape shape = WeaveShape::None;
    double length = 0; ///< mm of path of a cycle with its dwells
    double width = 0;  ///< from left to right
    double height = 0; ///< of the turning points above the middle (not Zigzag)
    /// mm of path that the TCP moves along the seam only. In the middle: each time it comes there.
    double dwellLeft = 0, dwellCenter = 0, dwellRight = 0;
    double direction = 0;   ///< deg about z of the frame
    double tilt = 0;        ///< deg about y
    double orientation = 0; ///< deg about x
    double bias = 0;        ///< mm to the left (Zigzag)
    double rounding = 0;    ///< mm of path on which the TCP turns at a corner of the pattern (not Circle)
    friend bool operator==(const WeavePattern&, const WeavePattern&) = default;

    bool isWeaving() const { return shape != WeaveShape::None && length > 0; }
    /// mm of path of all dwells of a cycle; less than `length`.
    double dwells() const;
    /// Sets the rounding so that at this speed along the path, mm/s, turning takes no more acceleration across it than
    /// arms have, as far as the pattern keeps its shape.
    void roundFor(double speed);
    /// In the weave frame; `phase` in cycles.
    Vec3 at(double phase) const;
};

/// The pattern of a movement.
struct Weave final : Modification {
    WeavePattern pattern;
    bool isLast = false; ///< the seam ends with this movement, and the pattern dies away before its end
};

/// Displaces the movements that carry a Weave while it is on. The pattern goes by the distance along the path: it stops with the
/// arm, does not depend on the speed, and runs backwards on the way back. When another pattern, another direction or the end of
/// the process changes the displacement, the difference dies away over a quarter of a cycle.
class Weaving final : public PathOffset {
  public:
    /// A new seam: the next cycle begins in the middle.
    void restart() { phase_ = 0; }
    void setOn(bool on) {
        if (!isOn_) forgetPlace(); // nothing advanced meanwhile
        isOn_ = on;
    }

    bool isActive() const override { return isOn_ || !shown_.isNone(); }
    void advance(const PlannedMoment& planned) override;

  private:
    void otherPath(bool isNew) override;

    bool isOn_ = false;
    double phase_ = 0;
    WeavePattern pattern_; ///< of the latest moment
    double blend_ = 1;     ///< mm
};

} // namespace motion
