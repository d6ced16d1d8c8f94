#pragma once
// ArcProcess: the weld of one robot, from ArcLStart to ArcLEnd: its phases in time, its signals, its supervision.

#include "runtime/motion/weaving.h"
#include "stdlib/impl/arc/arc_equipment.h"

#include "stdlib_types.h"

#include <memory>
#include <optional>
#include <vector>

namespace rt::lib {

class ArcProcess {
  public:
    /// The weld of the task's robot.
    static ArcProcess& of(TaskCore* task);

    /// Between ArcLStart and ArcLEnd, even while an error has put the arc out.
    bool isActive() const { return phase_ != Phase::Off; }
    int system() const { return system_; }
    /// WeldInhib is set: movements without a weld.
    bool isInhibited() const { return inhibited_; }
    /// mm/s of the weld, from the data or ArcRefresh.
    double speed(const data::Welddata& weld) const;

    /// A new weld: reads the equipment, checks data and equipment. The gas is not on yet.
    Status prepare(TaskCore* task, int system, const data::Seamdata& seam, data::Welddata* weld);
    /// How long the gas is to flow before the arc, in s.
    double gasTime() const { return seam_.purge_time + seam_.preflow_time; }
    void openGas();
    /// With the robot at rest: waits for the gas, ignites, waits for the arc. On an error all is off. `notReady`: raised when
    /// an input says that the equipment is not in order.
    Status ignite(TaskCore* task, Status notReady);
    /// After an error in the weld: ignites again, and lets the robot move on.
    Status resume(TaskCore* task);
    /// An error interrupts the seam: arc and gas go off, and resume() is needed.
    void putOut();
    /// The seam continues with these data from here on; called when the robot is there.
    void weldWith(data::Welddata* weld);
    /// ArcLEnd, with the robot at rest: crater, burnback, rollback, gas.
    Status close(TaskCore* task, const data::Seamdata& seam);
    /// At once: all signals off.
    void kill();
    /// ArcRefresh: the data as they are now, weaving of movements that have been ordered included. `speed` 0 and no width (mm):
    /// as the data say. ERR_ARGVALERR for weave data that make no pattern.
    Status refresh(TaskCore* task, double speed, std::optional<double> weaveWidth);
    /// For a movement of the seam at this speed (mm/s). ERR_ARGVALERR; null for a movement without weaving.
    Status weave(TaskCore* task, const data::Weavedata* data, double speed, bool isLast,
                 std::shared_ptr<const motion::Modification>& modification);

  private:
    enum class Phase : uint8_t { Off, Preparing, Welding, Closing, Interrupted };

    void open(TaskCore* task);
    void take(ArmChange news);
    void inputChanged(SignalId id);
    void interrupt(Status error);
    void arcOn(const data::Arcdata& arc);
    void apply(const data::Arcdata& arc) const;
    void arcOff();
    Status checkEquipment(TaskCore* task, Status error) const;
    void superviseIgnition();
    Status patternOf(TaskCore* task, const data::Weavedata& data, double speed,
                     motion::WeavePattern& pattern) const;

    Controller* controller_ = nullptr;
    MotionDriver* motion_ = nullptr;
    ArcEquipment equipment_;
    Phase phase_ = Phase::Off;
    int system_ = 1;
    data::Seamdata seam_{};
    data::Welddata* weld_ = nullptr; ///< persistent of the program, during the weld
    double refreshedSpeed_ = 0;
    bool inhibited_ = false, established_ = false, stopped_ = false;
    Time gasSince_ = kNever;
    EventToken ignition_ = 0;
    struct Ordered {
        const data::Weavedata* data; ///< persistent of the program, during the weld
        double speed;
        std::weak_ptr<motion::Weave> weave;
    };
    std::optional<double> refreshedWidth_;
    std::vector<Ordered> weaves_; ///< of movements that have been ordered
    std::shared_ptr<motion::Weaving> weaving_;
};

/// The program of a task begins again: its weld ends.
void endWeld(Task& task);

} // namespace rt::lib
