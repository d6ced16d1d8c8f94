#pragma once
// Jogging: a person moves the axes of a stopped robot, or of an external unit, by hand: axis by axis, along a line, about the TCP, or by
// a given amount. The path of the program stays; the next start returns to it.

#include "runtime/host/motion_driver.h"
#include "runtime/sched/scheduler.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace rt {

enum class JogFrame : uint8_t { World, Base, Tool, WorkObject };

/// A movement by hand. Figures are shares of the speed of jogging, -1 to 1; signs give directions. Joints and the TCP do not move
/// together.
struct JogOrder {
    std::array<double, robot::kMostJoints> joints{};       ///< by axis of the arm
    std::array<double, motion::kExternalCount> external{}; ///< by external axis
    motion::Vec3 line, turn; ///< of the TCP, along and about the axes of `frame`
    JogFrame frame = JogFrame::World;
    motion::FrameSetup frames; ///< tool and work object
    /// How far a share of 1 moves: mm of TCP, degrees of turning, degrees or mm of an axis. None: until stop(), or for `holdTime`
    /// unless the order is repeated.
    std::optional<double> increment;
    /// The posture at the end of an increment, which then lasts, like other movements, only as long as the order is repeated: the same goal continues it.
    std::optional<motion::JointTarget> goal;
    Time holdTime = 300 * kMillisecond;

    bool isLinear() const;
    bool moves() const;
};

/// The order that moves all axes together from one posture to another.
JogOrder jogOrderTo(const motion::JointTarget& from, const motion::JointTarget& goal);

/// Speeds of jogging at a share of 1.
struct JogSpeeds {
    static constexpr double kLine = 250;       ///< mm/s of the TCP, even while axes are jogged
    static constexpr double kTurn = 40;        ///< deg/s
    static constexpr double kJointShare = 0.2; ///< of the highest speed of an axis,
    static constexpr double kMostJoint = 30;   ///< and deg/s
};

class Jogging {
  public:
    Jogging(Scheduler& scheduler, MotionDriver& motion);
    ~Jogging();
    Jogging(const Jogging&) = delete;
    Jogging& operator=(const Jogging&) = delete;

    /// Begins, continues, or changes a movement. "" or why it cannot be; the caller sees to modes and motors. Another direction
    /// begins once the arm has come to rest.
    std::string order(const JogOrder& order);
    /// Brakes; isMoving() until the arm is at rest.
    void stop();
    bool isMoving() const { return isActive_; }
    /// Why the latest movement ended early: an axis at its limit, out of reach, too fast for an axis. "" = it did not.
    const std::string& limit() const { return limit_; }

  private:
    void begin();
    void finish();
    void step();
    double speedRequested(double dt) const;
    /// The place of the arm after `seconds` of jogging at a share of 1. None: nowhere; `limit_` says why.
    std::optional<motion::JointTarget> after(double seconds);
    std::optional<motion::JointTarget> afterAxes(double seconds);
    std::optional<motion::JointTarget> afterLine(double seconds);
    bool isWithin(const motion::JointTarget& joints);
    double speedOfJoint(std::size_t i) const;
    double speedOfExternal(std::size_t i) const;
    double commonSpeed() const;
    double tcpWay(const motion::JointTarget& from, const motion::JointTarget& to) const;

    Scheduler& scheduler_;
    MotionDriver& motion_;
    std::shared_ptr<int> alive_ = std::make_shared<int>(0); ///< the driver's listener outlives this object
    bool isActive_ = false, hasStored_ = false;
    JogOrder order_;
    std::optional<JogOrder> next_; ///< once the arm is at rest
    motion::JointTarget now_;
    double share_ = 0;     ///< present speed
    double axisSpeed_ = 0; ///< of an increment of axes, deg/s or mm/s at a share of 1
    double remaining_ = 0; ///< of an increment: seconds at a share of 1
    bool isStopping_ = false;
    Time until_ = 0;
    EventToken event_ = 0;
    std::string limit_;
};

} // namespace rt
