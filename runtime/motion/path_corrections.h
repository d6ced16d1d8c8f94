#pragma once
// PathCorrections: an offset in path coordinates that the program or a sensor sets, for the movements that carry modification().

#include "runtime/motion/path_offset.h"

namespace motion {

class PathCorrections final : public PathOffset {
  public:
    PathCorrections();
    /// mm in the path coordinate system (PlannedMoment::pathFrame), from now on. The arm follows while it moves on its path,
    /// with at most 100 mm/s and 2000 mm/s^2 across it; slower where it is slower than 10 mm/s along its path.
    void setOffset(const Vec3& offset);
    const Vec3& offset() const { return offset_; }
    /// The same after so many mm of path: the measurement of a sensor in front of the TCP.
    void setOffsetAhead(const Vec3& offset, double mm);
    /// For MoveCommand::modifications.
    const std::shared_ptr<const Modification>& modification() const { return modification_; }

    bool isActive() const override;
    void advance(const PlannedMoment& planned) override;

  private:
    struct Corrected final : Modification {
        explicit Corrected(const PathCorrections* corrections) : by(corrections) {}
        const PathCorrections* by;
    };
    bool concerns(const PlannedMoment& planned) const;

    std::shared_ptr<const Modification> modification_;
    struct Ahead {
        double at = 0; ///< mm of path since the beginning
        Vec3 offset;
    };
    void takeAhead();
    void otherPath(bool isNew) override;

    Vec3 offset_;
    Vec3 target_; ///< the displacement of the latest period, in world, without the change in progress
    std::deque<Ahead> ahead_; ///< the next one first
    double way_ = 0;          ///< mm of path
    bool hasJumped_ = false, wasCorrected_ = false;
};

} // namespace motion
