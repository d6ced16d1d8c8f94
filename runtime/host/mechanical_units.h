#pragma once
// MechanicalUnits: the robots and external units of a controller as the configuration describes them, and the groups in
// which they move (system parameters: topics Motion and Controller; RAPID manual 1.8, mechanical units).

#include "runtime/io/cfg_parser.h"
#include "runtime/motion/motion_system.h"
#include "runtime/robot/external_unit.h"

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rt {

/// A robot, or a chain of external axes.
struct MechanicalUnit {
    std::string name;
    bool isRobot = false;     ///< has a TCP; always active
    bool isActive = false;    ///< ActUnit, DeactUnit
    bool staysActive = false; ///< deactivation_forbidden
    bool isConveyor = false;  ///< moves by itself; robots follow its objects (runtime/host/conveyors.h)
    int axes = 0;
    std::size_t group = 0;        ///< number of the group it moves in
    robot::ExternalUnit geometry; ///< of an external unit, with the axes that carry it
    struct Axis {
        std::string single;    ///< name of its SINGLE
        std::size_t index = 0; ///< in ExternalAxes
        motion::ExternalAxisModel limits;
        bool mayBeIndependent = false; ///< IndAMove and its like (ARM independent_joint_on)
    };
    std::string carrier;   ///< name of the unit or single that moves its base; "" for none
    std::vector<Axis> own; ///< axes of an external unit
};

/// Mechanical units of controllers with conveyor tracking or sensor synchronisation are recognised by their names (CNV1,
/// INDCNV1, SSYNC1), as the options of RobotWare give them.
bool isConveyorName(std::string_view name);
bool isIndexingName(std::string_view name);

/// Units that one motion task moves together, by one motion planner.
struct MotionGroup {
    std::string name;  ///< of MECHANICAL_UNIT_GROUP; "" without one
    std::string robot; ///< name of the unit with a TCP; "" for a group of external units alone
    robot::RobotModel model;
    bool isModelAssumed = false;   ///< neither configuration nor command line names one
    motion::MotionOptions options; ///< external axes and what moves the base of the robot
};

/// Reads instances of a type in a domain of the configuration ("MOC", "ROBOT").
using CfgLookup = std::function<std::vector<const CfgInstance*>(std::string_view, std::string_view)>;

class MechanicalUnits {
  public:
    /// `robots`: the values of --robot, each a model, or UNIT=MODEL. Returns what is wrong, for people; empty: success.
    /// `isUsage`: a value of --robot is to blame. `needed`: how many motion tasks without a group of their own there are.
    std::string read(const CfgLookup& configuration, const std::vector<std::string>& robots,
                     std::string_view defaultModel, std::size_t needed, bool& isUsage);
    /// Parts of the configuration that do not move, a sentence each.
    const std::vector<std::string>& warnings() const { return warnings_; }

    /// In the order of the handles of mecunit data: the first one has handle 1. The objects do not move.
    const std::vector<std::unique_ptr<MechanicalUnit>>& all() const { return units_; }
    /// Without regard to case; null when there is none.
    MechanicalUnit* find(std::string_view name) const;
    const std::vector<MotionGroup>& groups() const { return groups_; }
    /// Activates or deactivates an external unit: its axes in `axes` (those of the group) get their last position, or leave it
    /// and become kNotConnected.
    void setActive(MechanicalUnit& unit, bool active, robot::ExternalAxes& axes);
    /// A conveyor that the configuration does not define. False when a unit of a different kind has the name.
    bool addConveyor(const std::string& name);
    /// The active unit that uses a logical axis of this one, too: stations of a positioner that are never active together. Null
    /// when there is none.
    const MechanicalUnit* sharesAxes(const MechanicalUnit& unit) const;
    /// Number of the group with this name in the configuration; -1 when there is none.
    int groupNamed(std::string_view name) const;

  private:
    struct RobotPlan {
        std::string name, model;
        const CfgInstance* instance = nullptr;
        bool isAsked = false;   // by --robot
        bool isAssumed = false; // the default model
    };
    std::vector<RobotPlan> planRobots(const CfgLookup& configuration, const std::vector<std::string>& robots,
                                      std::string_view defaultModel, std::size_t needed) const;
    static RobotPlan& firstRobot(const CfgLookup& configuration, std::vector<RobotPlan>& plans);
    void takeSimilar(const RobotPlan& plan, robot::Expected<robot::RobotModel, robot::ModelError>& model);
    std::string addRobots(const CfgLookup& configuration, const std::vector<RobotPlan>& plans, bool& isUsage);
    void addPositioner(const CfgLookup& configuration, const CfgInstance& instance);
    void addExternalUnits(const CfgLookup& configuration);
    void addGroups(const CfgLookup& configuration);
    void connectAxes();
    void startUnit(MechanicalUnit& unit);
    void carryBases();
    MechanicalUnit* carrierNamed(std::string_view name) const;

    std::vector<std::unique_ptr<MechanicalUnit>> units_;
    std::vector<MotionGroup> groups_;
    std::vector<std::string> warnings_;
};

} // namespace rt
