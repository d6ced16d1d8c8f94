#pragma once
// Kinematics: poses from joints and joints from poses, without moving anything. Metres and radians; poses in the base frame of the robot.

#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/manual_motion.h"

namespace rapidc::rws {

class Kinematics {
  public:
    explicit Kinematics(service::ManualMotion& manual) : manual_(manual) {}
    void addTo(Router& router, Subscribables& subscribables);

  private:
    using Calculation = Reply (Kinematics::*)(const Request&, const rt::MechanicalUnit&) const;
    Handler forRobot(Calculation calculation) const;
    Reply poseFromJoints(const Request& request, const rt::MechanicalUnit& unit) const;
    Reply jointsFromPose(const Request& request, const rt::MechanicalUnit& unit) const;
    Reply allSolutions(const Request& request, const rt::MechanicalUnit& unit) const;
    /// CalcRobTFromJoints: a robtarget in mm for tool and work object by name.
    Reply targetFromJoints(const Request& request, const rt::MechanicalUnit& unit) const;

    service::ManualMotion& manual_;
};

} // namespace rapidc::rws
