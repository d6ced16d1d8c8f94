#pragma once
// Partner: where the data come from that guide the robot (EGM), and where those about the robot go. The place at which a
// sensor, a signal or a program outside the controller is connected.

#include "runtime/motion/targets.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rt::lib {

inline constexpr std::size_t kMostRapidNumbers = 40; ///< RAPID data of a message

enum class GuidanceMode : uint8_t { Joint, Pose, PathCorrection };

/// The target of a partner. Parts that are absent keep their last value.
struct SensorData {
    /// Each axis that is asked for, by its number from 1 (index 0: axis 1, index 6: axis 7 of a seven-axis arm), deg.
    std::array<std::optional<double>, 7> joints{};
    /// Additional axes eax_a to eax_f that are asked for: deg or mm. eax_a of a seven-axis arm is among the joints.
    std::array<std::optional<double>, 6> additional{};
    /// Place and orientation in the frame of the sensor: mm, and deg about x, y, z (RAPID's EulerZYX). Of a path correction: x, y, z
    /// in path coordinates.
    std::array<std::optional<double>, 6> pose{};
    /// Orientation as a quaternion, instead of the angles.
    std::optional<motion::Quat> orientation;
    /// Speeds to which the correction of the position is added: of axes 1 to 6 (deg/s); of the pose in the frame of the sensor (mm/s
    /// along, deg/s about x, y, z); of eax_a to eax_f (deg/s or mm/s).
    std::array<double, 6> jointSpeed{}, poseSpeed{}, additionalSpeed{};
    /// False: the data are for RAPID alone, and the last target stays.
    bool hasTarget = true;
    /// For RAPID (\DIFromSensor, \DataFromSensor; at most 40 numbers).
    std::optional<bool> digital;
    std::vector<double> numbers;
};

/// The place of the robot as messages give it.
struct RobotPlace {
    std::array<double, 6>
        joints{}; ///< axes 1 to 6, deg (mm for a linear axis); 0 for those that the arm does not have
    std::vector<double>
        external; ///< eax_a (axis 7 of a seven-axis arm) and further ones up to the last that is connected
    motion::Pose pose; ///< in the correction frame
};

/// The state of the robot that is sent to a partner.
struct RobotData {
    RobotPlace feedback, planned;
    int64_t nanoseconds = 0; ///< virtual time
    int64_t calendar = 0;    ///< whole seconds since 1970 of the controller
    bool motorsOn = true, isGuided = false, isConverged = false, programRuns = true, hasCollided = false;
    double utilization = 0;      ///< fastest axis in percent of its highest speed
    uint32_t moveIndex = 0;      ///< movement instructions ordered so far
    bool digital = false;        ///< \DOToSensor
    std::vector<double> numbers; ///< \DataToSensor
};

class Partner {
  public:
    Partner() = default;
    virtual ~Partner() = default;
    Partner(const Partner&) = delete;
    Partner& operator=(const Partner&) = delete;

    /// For events.
    virtual std::string name() const = 0;
    /// A session begins or ends: nothing is exchanged outside sessions.
    virtual void begin() {}
    virtual void end() {}
    /// The newest data. False when none have come since the last call; refused ones do not count.
    virtual bool receive(SensorData& data) = 0;
    /// Once in each period of the exchange. Returns why it failed, or "".
    virtual std::string send(const RobotData& /*data*/) { return {}; }
    /// Data must come again and again (\CommTimeout); a signal always has a value.
    virtual bool answers() const { return false; }
};

} // namespace rt::lib
