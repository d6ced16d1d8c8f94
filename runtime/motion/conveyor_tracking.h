#pragma once
// ConveyorTracking: the robot follows an object that a conveyor carries. Movements are planned with the conveyor at one position;
// the arm is shown displaced by what the object has moved since. It joins the object with a ramp of limited speed and
// acceleration, and then keeps to it exactly.

#include "runtime/motion/path_modifier.h"

#include <deque>
#include <functional>
#include <memory>
#include <vector>

namespace motion {

/// An object on a conveyor, from its connection until it is dropped. Positions in mm, or degrees for a turning conveyor.
class TrackedObject {
  public:
    TrackedObject() = default;
    virtual ~TrackedObject() = default;
    TrackedObject(const TrackedObject&) = delete;
    TrackedObject& operator=(const TrackedObject&) = delete;

    /// Beyond the origin of the conveyor; at any time that is still kept, and later if the conveyor continues as now.
    virtual double position(TimeNs time) const = 0;
    virtual double speed(TimeNs time) const = 0;
    /// The user frame in world with the object at this position.
    virtual Pose frame(double position) const = 0;
    virtual bool isConnected() const = 0;
    virtual double adjustmentSpeed() const = 0; ///< the fastest movement of the robot along the conveyor
    virtual double adjustmentAcceleration() const = 0; ///< per s^2
};

/// The movement belongs to a tracked object; its path is planned with the object at `planned`.
struct OnConveyor : Modification {
    std::shared_ptr<const TrackedObject> object;
    double planned = 0;
};

class ConveyorTracking : public PathModifier {
  public:
    /// `now`: the time of the arm. `isHeld`: a stop holds it.
    ConveyorTracking(std::function<TimeNs()> now, std::function<bool()> isHeld)
        : now_(std::move(now)), isHeld_(std::move(isHeld)) {}

    /// The object that the movement ordered last follows; null: it does not follow one.
    const OnConveyor* ordered() const { return ordered_.get(); }
    void setOrdered(std::shared_ptr<const OnConveyor> ordered);
    /// The arm is beside its planned path, or moves along with a conveyor.
    bool isDisplaced() const;
    /// The path is at rest as far as it is known.
    bool isPathMoving() const { return isPathMoving_; }
    /// A new path begins where the arm is now. It keeps the speed that it has along the conveyor, which a ramp ends.
    void beginFromHere();
    /// It has caught up with its object.
    bool isCaught() const { return !samples_.empty() && samples_.back().isCaught; }

    bool isActive() const override { return !samples_.empty() || ordered_ != nullptr; }
    void advance(const PlannedMoment& planned) override;
    Pose displaced(const PlannedMoment& planned, const Pose& tcp) const override;
    Pose objectShift(const PlannedMoment& planned) const override;
    bool movesAtRest() const override;
    void pathReplaced() override;
    void pathStored() override;
    void pathRestored() override;
    void forgetBefore(TimeNs time) override;

  private:
    /// From a time on: the displacement with its speed and acceleration, or, when caught, that of the object.
    struct Sample {
        TimeNs time = 0;
        double d = 0, v = 0, a = 0;
        bool isCaught = false;
        bool follows = false;                 ///< the movement in progress belongs to the object
        std::shared_ptr<const OnConveyor> on; ///< direction of the displacement
    };
    const Sample* sampleAt(TimeNs time) const;
    static double displacementAt(const Sample& sample, TimeNs time);
    static double speedAt(const Sample& sample, TimeNs time);
    void follow(Sample& next, const OnConveyor& on) const;
    void returnToPath(Sample& next) const;
    static void stopMoving(Sample& next);
    static void approach(Sample& next, double error, double reference, double mostSpeed);

    std::function<TimeNs()> now_;
    std::function<bool()> isHeld_;
    std::deque<Sample> samples_;
    std::shared_ptr<const OnConveyor> ordered_;
    struct Stored {
        Sample sample;
        std::shared_ptr<const OnConveyor> ordered;
    };
    std::vector<Stored> stored_;
    bool isPathMoving_ = false;
    bool isBeginning_ = false; // between beginFromHere() and the order of the next movement
};

} // namespace motion
