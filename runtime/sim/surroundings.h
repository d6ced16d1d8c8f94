#pragma once
// Surroundings: what a program can feel of the world around the controller and no signal carries: forces on an arm, the part in
// a gripper, the sheet in a gun, the readings of a sensor. Set by the stimulus, read by the simulated devices of the standard
// library. A service of the controller.

#include "runtime/sched/wait_queue.h"

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace rt {

class Surroundings {
  public:
    /// Of a robot, Nm: torque that acts on axis N from outside (external_torque_N).
    static constexpr const char* kExternalTorque = "external_torque";
    /// At the force sensor of a robot, N and Nm: force_1 to force_6.
    static constexpr const char* kForce = "force";
    /// In a gripper, mm: where the fingers meet a part; below 0: there is none.
    static constexpr const char* kPart = "part";
    /// Of a gripper, 1 while vacuum 1 or 2 is not reached: vacuum_failure_1, vacuum_failure_2.
    static constexpr const char* kVacuumFailure = "vacuum_failure";
    /// The real load of a robot: kg, mm, kg m2.
    static constexpr const char* kLoadMass = "load_mass";
    static constexpr const char* kLoadCentre = "load_centre";   ///< load_centre_1 to 3: x, y, z
    static constexpr const char* kLoadInertia = "load_inertia"; ///< load_inertia_1 to 3
    /// Of a servo gun: mm of sheet between the tips, mm of wear, position initialized, tips synchronized.
    static constexpr const char* kThickness = "thickness";
    static constexpr const char* kTipWear = "tip_wear";
    static constexpr const char* kInitialized = "initialized";
    static constexpr const char* kSynchronized = "synchronized";
    /// Of a sensor: variable_N, and the number of its fault (0: none).
    static constexpr const char* kVariable = "variable";
    static constexpr const char* kFault = "fault";
    /// Of a conveyor: mm/s or deg/s of the belt; an object that is so far beyond the sync switch, mm or deg.
    static constexpr const char* kSpeed = "speed";
    static constexpr const char* kObject = "object";

    /// "UNIT.QUANTITY" as a stimulus writes it.
    struct Name {
        std::string unit, quantity;
    };
    /// Nothing when the text is not of that form; then it names something else.
    static std::optional<Name> split(std::string_view text);
    /// "" or what is wrong with the quantity, with the ones there are.
    static std::string problemOf(std::string_view quantity);

    void set(const Name& name, double value);
    /// The latest value; nothing when it was never set. Without regard to case.
    std::optional<double> find(std::string_view unit, std::string_view quantity) const;
    std::optional<double> find(std::string_view unit, const char* quantity, int number) const;
    double value(std::string_view unit, std::string_view quantity, double otherwise = 0) const {
        return find(unit, quantity).value_or(otherwise);
    }
    double value(std::string_view unit, const char* quantity, int number, double otherwise) const {
        return find(unit, quantity, number).value_or(otherwise);
    }

    /// Called after each change, by the scheduler.
    uint64_t addListener(std::function<void(const Name&, double)> listener);
    void removeListener(uint64_t token) { listeners_.erase(token); }

  private:
    std::map<std::pair<std::string, std::string>, double> values_; // names in capitals
    std::map<uint64_t, std::function<void(const Name&, double)>> listeners_;
    uint64_t lastToken_ = 0;
};

} // namespace rt
