#pragma once
// SmartGripper: the gripper of one arm of an IRB 14000, simulated: two fingers that a servo moves between 0 and 25 mm, and two
// vacuum cups. Positions in mm of finger travel, speeds in mm/s, forces in N. A service of the motion group.

#include "runtime/host/controller.h"

#include <string>

namespace rt::lib {

class SmartGripper {
  public:
    static constexpr double kMostTravel = 25, kMostSpeed = 25, kMostForce = 20;
    static constexpr double kUsualSpeed = 20, kUsualForce = 10;

    /// The gripper on the robot of the task.
    static SmartGripper& of(TaskCore* task);

    void setSpeed(double speed) { speed_ = speed; }
    void setForce(double force) { force_ = force; }
    void setLimit(double limit) { limit_ = limit; }
    double limit() const { return limit_; }
    bool isCalibrated() const { return isCalibrated_; }
    /// The present position becomes 0 mm.
    void calibrate();
    /// As far as calibration shows.
    double position() const;
    bool isMoving() const { return arrival_ != 0; }
    /// Begins to move: to a position, or as far as the fingers get. An object between them stops them. A movement in progress ends.
    void moveTo(double position);
    void moveInward();
    void moveOutward();
    void stop();
    /// Until the fingers stand.
    Status waitStill(Task& task);
    /// Of cup 1 or 2 (index 0 or 1): suction and blow-off exclude each other.
    void setVacuum(std::size_t cup, bool on);
    void setBlow(std::size_t cup, bool on);
    /// The stimulus lets its vacuum fail.
    bool failsVacuum(std::size_t cup) const;

  private:
    void open(TaskCore* task);
    void move(double goal);
    double whereNow() const;
    double met(double from, double goal) const;
    void arrived();
    void show() const;
    void output(const std::string& signal, double value) const;

    Controller* controller_ = nullptr;
    std::string unit_, suffix_; ///< ROB_L, _L
    double speed_ = kUsualSpeed, force_ = kUsualForce, limit_ = kMostTravel;
    double start_ = kStart; ///< where the movement began, on the scale of the mechanism
    double goal_ = kStart;
    double end_ = kStart; ///< where it ends: at the goal or at what it meets
    double zero_ = 0;     ///< the calibrated 0 on that scale
    Time began_ = 0;
    EventToken arrival_ = 0;
    bool isCalibrated_ = false;
    WaitQueue changed_;

    static constexpr double kStart = 12; ///< half open when the controller starts
};

} // namespace rt::lib
