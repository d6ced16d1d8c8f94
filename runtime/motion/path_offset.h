#pragma once
// PathOffset: a modifier that displaces the TCP by a vector in world, which depends on the place on the path and changes smoothly.

#include "runtime/motion/blended_offset.h"

#include <utility>

namespace motion {

class PathOffset : public PathModifier {
  public:
    Pose displaced(const PlannedMoment& planned, const Pose& tcp) const final {
        return {tcp.pos + shown_.at(planned.time), tcp.rot};
    }
    void pathReplaced() final {
        shown_.reset();
        hasPlace_ = false;
        otherPath(true);
    }
    void pathStored() final {
        shown_.store();
        hasPlace_ = false;
        otherPath(false);
    }
    void pathRestored() final {
        shown_.restore();
        hasPlace_ = false;
        otherPath(false);
    }
    void storedPathsCleared() final { shown_.clearStored(); }
    void forgetBefore(TimeNs time) final { shown_.forgetBefore(time); }

  protected:
    struct Step {
        double way = 0;          ///< mm of path since the last moment; negative on the way back
        bool isOtherRun = false; ///< it was on another part of the path: perhaps another direction
    };
    /// To be called by advance(), once.
    Step stepTo(const PlannedMoment& planned) {
        Step step;
        if (std::exchange(hasPlace_, true)) step.way = planned.distanceFrom(run_, s_);
        step.isOtherRun = std::exchange(run_, planned.run) != planned.run;
        s_ = planned.s;
        return step;
    }
    /// The way until the next moment does not count.
    void forgetPlace() { hasPlace_ = false; }
    /// The arm is on another path; `isNew`: one that begins where the arm is, not one that was stored.
    virtual void otherPath(bool isNew) = 0;

    BlendedOffset shown_;

  private:
    bool hasPlace_ = false;
    std::size_t run_ = 0;
    double s_ = 0; ///< mm on that run
};

} // namespace motion
