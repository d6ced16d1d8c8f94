#pragma once
// PathModifiers: the modifiers of one arm, in the order in which they act, and what is shown of it while they do.

#include "runtime/motion/path_modifier.h"

#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace motion {

/// The arm as it is shown at a moment: what speeds are measured from.
struct ShownArm {
    TimeNs time = 0;
    Joints joints{};
    Vec3 tcpInObject; ///< mm, in the object frame
    uint64_t tag = 0;
};

class PathModifiers {
  public:
    void add(std::shared_ptr<PathModifier> modifier) { modifiers_.push_back(std::move(modifier)); }
    bool areActive() const;
    bool moveAtRest() const;
    void advance(const PlannedMoment& planned);
    Pose displaced(const PlannedMoment& planned) const;
    /// The TCP in the object frame, wherever the object is.
    Vec3 placeInObject(const PlannedMoment& planned, const Pose& tcp) const;

    void pathReplaced();
    void pathStored();
    void pathRestored();
    void storedPathsCleared();
    void forgetBefore(TimeNs time);

    /// The moment up to which the modifiers have advanced, a multiple of the period.
    TimeNs advancedTo() const { return advancedTo_; }
    void setAdvancedTo(TimeNs time) { advancedTo_ = time; }
    void note(const ShownArm& shown) { shown_.push_back(shown); }
    /// The latest one before that time; null when there is none within two periods.
    const ShownArm* shownBefore(TimeNs time) const;

    /// A displaced pose was out of reach, which has not been reported yet.
    std::optional<MotionError> unreported;
    /// The arm cannot reach the displaced pose now.
    bool isOutOfReach = false;
    std::optional<MotionError> latestError; ///< for the event

  private:
    std::vector<std::shared_ptr<PathModifier>> modifiers_;
    std::deque<ShownArm> shown_;
    TimeNs advancedTo_ = 0;
};

} // namespace motion
