#pragma once
// PathModifier: something that leads the TCP away from the planned path on purpose: corrections of a sensor, weaving, a moving
// conveyor. Planning and events (starts, ends, triggers) know the planned path only; the arm is shown displaced, with the
// joints that follow from the planned ones by inverse kinematics.
//
// Which movements a modifier displaces is its own decision. Movements carry Modifications (MoveCommand::modifications), and a
// modifier looks for its own kind of them: PlannedMoment::find. A displacement may depend on the place (path, frame,
// distanceFrom), on the time, or on both. One that moves the work object in time (a conveyor) returns the planned pose moved
// along with it, `transport * tcp` with the transport as a pose in world, and says movesAtRest() while the conveyor runs: then
// the arm moves on after a stop point, and WaitRob, isMoving() and the trace see it. BlendedOffset ramps displacements in and out.
//
// * Times: advance() comes at whole multiples of 4 ms, in order. displaced() is asked at any time that is still kept, and for
//   times after the last advance(): a modifier with memory keeps samples up to forgetBefore() and interpolates.
// * Stop on the path: the planned path brakes, isHeld is set, and speed becomes 0. Modifiers that depend on `speed` or the place stop with it.
// * Off the path (emergency stop) and on the way back to it nothing is asked; then all continues with what was there.
// * ClearPath, a new path from where the arm is: pathReplaced(); the displacement begins at none again.
// * StorePath and RestoPath: pathStored(), pathRestored(); the path that is taken back continues with its displacement. Levels
//   nest; storedPathsCleared() when all of them are thrown away.
// * A pose that the arm cannot reach: the arm keeps as near to it as it can, stops on its path, and an OutOfReach event follows.
// * Another process continues the path (--state): modifications are not kept.

#include "runtime/motion/move_command.h"

#include <cstdint>
#include <memory>

namespace motion {

class Trajectory;
struct PathPlace;

using TimeNs = int64_t;

/// Period of the controller while it moves the arm: displacements, jogging, guidance and supervision advance with it.
inline constexpr TimeNs kModifierPeriod = 4'000'000;
inline constexpr double kModifierSeconds = 1e-9 * static_cast<double>(kModifierPeriod);

/// The data of a modifier for a movement that it displaces; each kind of modifier has its own.
struct Modification {
    Modification() = default;
    virtual ~Modification() = default;
    Modification(const Modification&) = default;
    Modification& operator=(const Modification&) = default;
};

/// The arm as planned at one moment on its path.
struct PlannedMoment {
    TimeNs time = 0;
    const Trajectory* path = nullptr;
    std::size_t run = 0;   ///< number of the part between two stop points
    double s = 0;          ///< mm on that part
    double speed = 0;      ///< mm/s along the path, turning counted as well; negative on the way back
    double toEnd = 0;      ///< mm of path to the programmed end of the movement
    bool isMoving = false; ///< as planned
    bool isHeld =
        false; ///< a stop of the program, StopMove or an override of 0 holds the arm, perhaps still braking
    uint64_t tag = 0;                             ///< of the movement
    const Modifications* modifications = nullptr; ///< of the movement; null: none
    const FrameSetup* frames = nullptr;           ///< of the movement
    JointTarget joints;
    Pose tcp;    ///< in world; a stationary tool is where it is
    Pose object; ///< the displaced object frame in world

    /// The data of the movement for the calling modifier; null: nothing of this kind.
    template <class T> const T* find() const {
        if (modifications == nullptr) return nullptr;
        for (const auto& modification : *modifications)
            if (const T* found = dynamic_cast<const T*>(modification.get())) return found;
        return nullptr;
    }
    /// The path coordinate system, as an orientation in world: x is the tangent of the path relative to the work object in the
    /// programmed direction, y is (z of the tool) x (tangent), z is x cross y. If the TCP hardly moves, x is that of the tool.
    Quat pathFrame() const;
    /// Signed mm of path from another moment on the same path to this one.
    double distanceFrom(std::size_t otherRun, double otherS) const;
};

class PathModifier {
  public:
    PathModifier() = default;
    virtual ~PathModifier() = default;
    PathModifier(const PathModifier&) = delete;
    PathModifier& operator=(const PathModifier&) = delete;

    /// It displaces the arm, has done so at a time that is still kept, or may begin to. Otherwise nothing below is called
    /// but the notifications.
    virtual bool isActive() const = 0;
    /// Each kModifierPeriod while the arm follows its path.
    virtual void advance(const PlannedMoment& /*planned*/) {}
    /// The TCP in world; `tcp` is the planned one as modifiers before this one have displaced it.
    virtual Pose displaced(const PlannedMoment& planned, const Pose& tcp) const = 0;
    /// Carries the planned object frame, in world, to where the object is: speeds are measured relative to that.
    virtual Pose objectShift(const PlannedMoment& /*planned*/) const { return {}; }
    /// It moves the arm now, although its path is at rest.
    virtual bool movesAtRest() const { return false; }

    virtual void pathReplaced() {}
    virtual void pathStored() {}
    virtual void pathRestored() {}
    virtual void storedPathsCleared() {}
    /// Nothing before this time is asked any more.
    virtual void forgetBefore(TimeNs /*time*/) {}
};

} // namespace motion
