#pragma once
// GuidedArm: the robot while data from outside lead it. Each period the axes move towards what is asked for, within speed,
// acceleration and range of each axis.

#include "stdlib/impl/guided_motion/partner.h"

#include "runtime/host/motion_driver.h"

namespace rt::lib {

/// egmframetype of the tool.
inline constexpr int kToolFrame = 1;

/// Allowed difference between what is asked for and where the robot is: deg for axes and rotations, mm for positions.
struct Window {
    double low = 0, high = 0;
};

/// The settings of EGMActJoint and EGMActPose, with the external motion data of the configuration.
struct GuidanceSettings {
    GuidanceMode mode = GuidanceMode::Joint;
    motion::FrameSetup frames;
    motion::Pose correctionFrame, sensorFrame;
    int correctionType = 2, sensorType = 2; ///< egmframetype: 2 is the work object
    std::array<Window, 7> windows{};        ///< of axes 1 to 7, or of x, y, z, rx, ry, rz
    double filterHz = 20;                   ///< bandwidth of the low-pass filter; 0 = none
    double maxSpeed = 1;                    ///< deg/s; of linear additional axes mm/s
    double maxDeviation = 1000;             ///< deg from where the guidance began
};

/// The request of EGMRunJoint and EGMRunPose.
struct GuidanceOrder {
    bool rampDown = false;          ///< back to the start at the end
    bool continues = false;         ///< \NoWaitCond: the condition does not end the guidance
    std::array<bool, 7> named{};    ///< the axes or directions that move and whose windows count
    double conditionTime = 1;       ///< s
    double rampIn = 0, rampOut = 0; ///< s
    double gain = 40;               ///< 1/s: speed for each deg of difference
    motion::Pose offset;            ///< added to the pose that is asked for
    bool movesRobot() const;
};

class GuidedArm {
  public:
    static constexpr Time kPeriod = motion::kModifierPeriod;

    GuidedArm(MotionDriver& motion, const GuidanceSettings& settings, const GuidanceOrder& order);

    /// One period towards what is asked for. `share` of the gain is in force (ramp).
    void follow(const SensorData& data, double share);
    /// One period of braking, each axis for itself.
    void brake();
    /// Along the way back to the start, at this share of it (0 to 1).
    void placeOnWayBack(double share);
    /// Notes where the way back begins; returns how long it takes at least, in s.
    double beginWayBack();
    /// No axis moves, and following the same data again would change nothing.
    bool isSteady() const { return isSteady_; }
    bool isStanding() const;
    bool isConverged() const;
    /// The program has ordered a movement, or the arm cannot be guided any more.
    bool isLost() const { return lost_; }
    /// Why the target is not followed; "" when it is.
    const std::string& limit() const { return limit_; }

  private:
    motion::Joints target(const SensorData& data);
    motion::Joints targetOfPose(const SensorData& data);
    motion::Joints limited(motion::Joints wanted);
    Window rangeOf(std::size_t axis) const;
    motion::Joints speedRequested(const SensorData& data) const;
    motion::Joints speedOfPose(const SensorData& data) const;
    /// deg/s.
    double highestSpeed(std::size_t axis) const;
    /// Poses: the share of their speeds with which all axes move so that none exceeds its highest one. Near a singularity
    /// the others wait for the axes that have to turn far, and the TCP keeps near its way.
    double paceTowards(const motion::Joints& goal, double gain, const motion::Joints& asked) const;
    void moveAxis(std::size_t axis, double goal, double gain, double speedRequested, double pace);
    void moveAdditional(const SensorData& data, double gain);
    void place(const motion::JointTarget& speed);
    motion::JointTarget speedNow() const { return {speed_, additionalSpeed_}; }

    MotionDriver& motion_;
    GuidanceSettings settings_;
    GuidanceOrder order_;
    motion::JointTarget start_, now_;
    motion::JointTarget wayBackFrom_;
    motion::Joints speed_, filtered_, wanted_;
    motion::ExternalAxes additionalSpeed_{}; ///< deg/s, mm/s
    motion::Pose sensorInWorld_, objectInWorld_;
    motion::Pose wantedPose_; ///< in the frame of the sensor
    bool isSteady_ = false, lost_ = false;
    std::string limit_;
};

/// The frame of this type in world: of the robot's base, the tool, the work object or the world (egmframetype).
motion::Pose guidanceFrame(MotionDriver& motion, const motion::FrameSetup& frames, int type);
/// The same frames with the base of the robot where it is now.
motion::FrameSetup basedFrames(MotionDriver& motion, motion::FrameSetup frames);
/// TCP in world.
motion::Pose guidedTcp(MotionDriver& motion, const motion::FrameSetup& frames,
                       const motion::JointTarget& joints);

} // namespace rt::lib
