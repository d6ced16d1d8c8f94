#pragma once
// Conveyor: a simulated conveyor with its objects as the conveyor tracking unit of a controller knows them: queue, start window,
// connected object, signals (RAPID manual 1.8, conveyor tracking).

#include "runtime/host/belt.h"
#include "runtime/io/io_system.h"
#include "runtime/log/event_log.h"
#include "runtime/motion/conveyor_tracking.h"
#include "runtime/sched/scheduler.h"
#include "runtime/sched/wait_queue.h"

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rt {

/// Lengths in mm and mm/s; of a turning conveyor in degrees. Positions are measured from the origin of the conveyor, downstream.
struct ConveyorSettings {
    std::string name;
    std::string prefix = "c1"; ///< of its signals
    robot::Pose base;          ///< origin in world; x is the direction of travel, z the axis of a turning one
    bool rotating = false;
    double index = 100; ///< of an indexing conveyor: one step, at `indexSpeed`
    double indexSpeed = 200;
    std::string trigger; ///< digital input that orders a step; "": none
    int axis = -1; ///< of the sensor's position in a robtarget, 0 for eax_a; -1: the first one that is given
    double speed = 0, acceleration = 1000;
    double every =
        0; ///< an object passes the sync switch each time the belt has moved by this; 0: none by itself
    double sync = 0;                        ///< from the sync switch to the origin (queue tracking distance)
    double window = 500;                    ///< width of the start window
    double minimum = -1000, maximum = 5000; ///< a connected object is dropped outside
    double separation = 0;                  ///< objects that follow more closely are not noticed
    double adjustmentSpeed = 1000, adjustmentAcceleration = 4000; ///< of the robot when it joins an object
    double countsPerMetre = 10'000;
};

/// A signal of conveyor tracking; its name follows the prefix of the conveyor.
struct ConveyorSignal {
    const char* name;
    SignalType type;
    uint32_t bits;
};
std::span<const ConveyorSignal> allConveyorSignals();

class Conveyor {
  public:
    Conveyor(Scheduler& scheduler, IoSystem& io, EventLog& log, ConveyorSettings settings);
    ~Conveyor();
    Conveyor(const Conveyor&) = delete;
    Conveyor& operator=(const Conveyor&) = delete;

    const ConveyorSettings& settings() const { return settings_; }
    const std::string& name() const { return settings_.name; }
    /// Defines the signals that the configuration lacks; before the program's names are connected.
    void addSignals();
    /// Connects the signals and lets objects come.
    void begin();

    bool isActive() const { return isActive_; }
    /// A unit that is deactivated drops its object, and loses its queue.
    void setActive(bool active);

    // ---- the belt ----
    void setSpeed(double speed);
    double speed() const;
    double orderedSpeed() const { return belt_->target(); } ///< that it has, or is about to have
    double position() const;                                ///< of the belt since the start
    /// Called after the speed has changed.
    void onSpeed(std::function<void()> action) { speedActions_.push_back(std::move(action)); }

    // ---- objects ----
    /// One is at the sync switch now, or `ahead` mm beyond it.
    void objectAtSync(double ahead = 0);
    /// One that is at this position now, without the sync switch.
    void addObject(double position);
    std::size_t pending() const { return queue_.size(); } ///< without the connected one
    void removeFirst();
    void removeAll();
    /// Position of the first object that can be connected; none when the start window is empty.
    bool hasObjectInWindow() const;
    /// Connects the first object in the start window; null when there is none.
    std::shared_ptr<const motion::TrackedObject> connect();
    std::shared_ptr<const motion::TrackedObject> connected() const;
    double connectedPosition() const; ///< 0 without an object
    /// Ends the connection; the object is not known any more. `why` for those who follow it.
    void drop();
    /// The same, as something that those who follow the object did not expect.
    void lose(const std::string& why);
    /// Called when the connected object is lost: outside the limits, or dropped by a signal.
    void onLost(std::function<void(const std::string& why)> action) {
        lostActions_.push_back(std::move(action));
    }

    // ---- between two processes ----
    /// Belt and objects; positions are those of the belt.
    struct Kept {
        bool isActive = false;
        double position = 0, speed = 0, target = 0;
        std::vector<double> queue; ///< positions at which each object is at the origin
        std::optional<double> connected, lastSync, nextObject;
    };
    Kept kept() const;
    void restore(const Kept& kept);

    /// Notified when something changes that a task may wait for.
    WaitQueue& changed() { return changed_; }
    /// changed() is also notified when the connected object comes to this position.
    void watch(double position);
    /// A task executes WaitWObj or WaitSensor.
    bool isAwaited = false;
    /// The user frame in world of an object at this position.
    robot::Pose frame(double position) const;

  private:
    class Link;
    double objectPosition(double origin) const { return position() - origin; }
    void schedule();
    void act();
    void passWindow();
    void checkLimits();
    void showSignals();
    void show(const char* name, double value);
    void pulse(const char* name);
    void onSignal(const char* name, std::function<void()> action);
    void addSignal(const char* name, SignalType type, uint32_t bits);
    SignalId signal(const char* name) const { return io_.find(settings_.prefix + name); }
    double counts(double position) const;

    Scheduler& scheduler_;
    IoSystem& io_;
    EventLog& log_;
    ConveyorSettings settings_;
    std::shared_ptr<Belt> belt_;
    std::deque<double> queue_; ///< positions of the belt at which each object is at the origin
    std::shared_ptr<Link> link_;
    std::optional<double> lastSync_, nextObject_; ///< position of the belt
    std::optional<double> watched_;
    std::vector<std::function<void()>> speedActions_;
    std::vector<std::function<void(const std::string&)>> lostActions_;
    std::vector<uint64_t> listeners_;
    WaitQueue changed_;
    EventToken next_ = 0;
    bool isActive_ = false;
};

} // namespace rt
