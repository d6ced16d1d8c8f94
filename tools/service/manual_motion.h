#pragma once
// ManualMotion: what an operator chooses for moving by hand (tool, work object, payload, coordinate system), and the moving itself. For
// clients and the web page alike. On the controller's thread only.

#include "runtime/host/jogging.h"
#include "tools/service/virtual_controller.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace rapidc::service {

/// The choices for one mechanical unit.
struct UnitChoice {
    std::string tool = "tool0", workObject = "wobj0", payload = "load0", totalPayload = "load0";
    std::string jogMode = "Cartesian";      ///< AxisGroup1, AxisGroup2, Cartesian, Linear, Reorient ..
    std::string coordinateSystem = "World"; ///< World, Base, Tool, Wobj
    bool motionSupervision = true, pathSupervision = true, leadThrough = false;
    int motionSensitivity = 100, pathSensitivity = 100; ///< per cent
};

class ManualMotion {
  public:
    /// The controller has been opened and outlives this object.
    explicit ManualMotion(VirtualController& controller);
    ~ManualMotion();
    ManualMotion(const ManualMotion&) = delete;
    ManualMotion& operator=(const ManualMotion&) = delete;

    /// Null when there is no such unit.
    rt::MechanicalUnit* unit(std::string_view name) const { return controller_.core().units().find(name); }
    rt::MotionDriver& motionOf(const rt::MechanicalUnit& unit) const;
    /// The task that moves the unit; null when none does.
    rt::Task* taskOf(const rt::MechanicalUnit& unit) const;
    const UnitChoice& choice(const rt::MechanicalUnit& unit) const;
    /// Changes the choices, which raises changeCount(). "" or what is wrong, and nothing has changed.
    Refusal choose(const rt::MechanicalUnit& unit, UnitChoice choice);
    uint64_t changeCount() const { return changeCount_; }

    /// The frames of data in program memory, "tool0" and "wobj0" always among them. "" or what is wrong.
    Refusal framesOf(const rt::MechanicalUnit& unit, const std::string& tool, const std::string& workObject,
                     motion::FrameSetup& frames) const;

    /// In manual mode with motors on and a stopped program. `order.frames` is filled in from the choice of the unit.
    Refusal jog(const rt::MechanicalUnit& unit, rt::JogOrder order);
    /// Towards a target in the work object of the unit; repeated like jog().
    Refusal goTo(const rt::MechanicalUnit& unit, const motion::RobTarget& target);
    /// Turns the tool about its TCP until its z axis is parallel to the nearest axis of the coordinate system; repeated like jog().
    Refusal align(const rt::MechanicalUnit& unit);
    void stopJogging();
    bool isJogging() const;
    /// Why the latest movement of the unit ended early; "" = it did not.
    std::string jogLimit(const rt::MechanicalUnit& unit) const;
    /// Activates or deactivates an external unit. The program is stopped and the group is at rest.
    Refusal setActive(const rt::MechanicalUnit& unit, bool active);
    /// Places a unit at these axes without motion, as only a virtual controller can. The program is stopped.
    Refusal teleport(const rt::MechanicalUnit& unit, const motion::JointTarget& joints);

  private:
    Refusal refusalOfJogging() const;
    rt::Jogging& joggingOf(const rt::MechanicalUnit& unit);

    VirtualController& controller_;
    Observers::Token token_;
    std::map<std::string, UnitChoice> choices_; ///< by name of the unit
    std::map<std::size_t, std::unique_ptr<rt::Jogging>>
        jogging_; ///< by motion group; of the present generation
    uint64_t changeCount_ = 1;
};

/// The axes of an arm and its external axes from the figures of a RAPID jointtarget: rax_1 to rax_6 and eax_a to eax_f.
motion::JointTarget jointsFrom(const robot::Kinematics& kinematics, const std::vector<double>& arm,
                               const std::vector<double>& external);

} // namespace rapidc::service
