#pragma once
// DispenseProcess: the bead of one robot: its gun and its flows.

#include "stdlib/impl/process/process_signals.h"

#include "stdlib_types.h"

#include <array>

namespace rt::lib {

class DispenseProcess {
  public:
    /// The bead of the task's robot.
    static DispenseProcess& of(TaskCore* task);

    /// A bead has been begun by the program and not been ended, wherever the robot is.
    bool isOrdered() const { return ordered_; }
    void setOrdered(bool ordered) { ordered_ = ordered; }

    /// Reads the equipment of the bead and checks the bead.
    Status prepare(TaskCore* task, const data::Beaddata& bead);
    /// How long before its place the gun is switched, in s.
    double onTime() const { return signals_.number("OnTime", 0); }
    double offTime() const { return signals_.number("OffTime", 0); }
    /// After an error in the bead: the robot moves on and the bead continues. Raises the error again while it is there.
    Status resume(TaskCore* task);

    /// On the path: the bead begins or has other data from here. `speed`: mm/s that the flows are meant for.
    void begin(const data::Beaddata& bead, double speed);
    void end();
    /// The movement was not made: nothing is dispensed.
    void interrupt();

  private:
    enum class Phase : uint8_t { Off, On, Stopped, Interrupted };

    void open(TaskCore* task);
    void take(ArmChange news);
    void inputChanged(SignalId id);
    void flowOn();
    void flowOff();
    void flow(std::size_t signal, double value, double type);

    Task* task_ = nullptr;
    MotionDriver* motion_ = nullptr;
    ProcessSignals signals_;
    Phase phase_ = Phase::Off;
    bool ordered_ = false;
    data::Beaddata bead_{};
    double speed_ = 0;
    std::array<bool, 2> follows_{}; ///< a flow follows the speed of the TCP
};

/// The program of a task begins again: its bead ends.
void endBead(Task& task);

} // namespace rt::lib
