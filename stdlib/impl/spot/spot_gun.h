#pragma once
// SpotGun: a spot welding gun and its timer: closing, weld and opening in time, by signals.

#include "stdlib/impl/process/process_signals.h"

#include "stdlib_types.h"

#include <map>
#include <string>

namespace rt {
struct StateKeepers;
}

namespace rt::lib {

class SpotGun {
  public:
    /// Reads what PROC.cfg and EIO.cfg say of the gun; `number` from 1. Returns what is wrong, or "".
    std::string read(Controller& controller, int number);
    int number() const { return number_; }

    /// Program and force of the next weld.
    void select(double program, double force) const;
    void equalise(bool on) const;
    void highLift(bool open) const;
    void weldError(bool on) const;

    /// The gun begins to close; again when it closes already: nothing.
    void close(Time now);
    /// The program stops before the robot is there: the gun opens, and closes again when it is.
    void giveUpClosing();
    bool isClosing() const { return closedSince_ != kNever; }
    Status waitClosed(TaskCore* task);

    /// Timer, water and pressure before the weld.
    Status checkReady(TaskCore* task) const;
    void startWeld(Time now);
    /// `timeout` in s; 0: as PROC.cfg says.
    Status waitWelded(TaskCore* task, double timeout);

    void open(Time now);
    Status waitOpen(TaskCore* task);
    /// After an error: no current, the gun opens, the error output is set.
    void abandon(Time now);

    double wearPerWeld() const { return signals_.number("WearPerWeld", 0); }
    int weldsSinceCalibration = 0;

  private:
    Status waitFor(TaskCore* task, std::size_t input, Time since, double seconds, double timeout,
                   const char* what);

    ProcessSignals signals_;
    int number_ = 1;
    Time closedSince_ = kNever, weldSince_ = kNever, openSince_ = 0;
};

/// The gun of a number or of gundata. Null, with an error raised, when it is not one.
SpotGun* spotGunOf(TaskCore* task, const float* number, const data::Gundata* gun, Status& status);
/// The controller stops or starts the program: guns that close on the way open.
void superviseGuns(TaskCore* task);
/// The program of a task begins again: guns open.
void openGuns(Task& task);

/// The welds of the guns since their calibration, between two processes (--state).
void keepSpotGuns(Controller& controller, StateKeepers& kept);

} // namespace rt::lib
