#pragma once
// AxisReader: what the configuration says about an external axis (system parameters, topic Motion: SINGLE, JOINT, ARM and the
// types that these refer to).

#include "runtime/host/mechanical_units.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rt {

/// The instance with that name, without regard to case; null when there is none.
const CfgInstance* instanceNamed(const std::vector<const CfgInstance*>& instances, std::string_view name);

/// base_frame_pos_* (m) and base_frame_orient_u* of a ROBOT or SINGLE, in mm. An instance with none of them: `otherwise`; with some of
/// them: 0 and the identity for the others.
robot::Pose baseFrameOf(const CfgInstance& instance, const robot::Pose& otherwise = {});

/// Types refer to each other by name; what is missing keeps the value of a usual positioner or track.
class AxisReader {
  public:
    /// The axis of a SINGLE.
    static AxisReader ofSingle(const CfgLookup& configuration, std::string_view single);
    /// The axis of a JOINT, or, where the file has no such JOINT, of the ARM with that name.
    static AxisReader ofJoint(const CfgLookup& configuration, std::string_view joint);

    bool isRotating() const;
    /// Bounds, speed and acceleration (degrees or mm).
    motion::ExternalAxisModel limits() const;
    /// ARM independent_joint_on: IndAMove and its like may move the axis.
    bool mayBeIndependent() const;
    /// 0 for eax_a; nothing when the configuration does not say.
    std::optional<std::size_t> axisIndex() const;
    robot::Pose base() const { return single_ != nullptr ? baseFrameOf(*single_) : robot::Pose{}; }
    /// Name of the unit or single that moves the base; "" for none.
    std::string carrier() const { return text(single_, "base_frame_coordinated"); }
    /// From the arm before to this one (ARM_TYPE); nothing without one.
    std::optional<robot::Pose> step() const;

  private:
    AxisReader(const CfgLookup& configuration, const CfgInstance* single, std::string_view joint);
    static std::string text(const CfgInstance* instance, std::string_view attribute) {
        return instance != nullptr ? instance->text(attribute) : std::string();
    }
    const CfgInstance* find(std::string_view type, std::string_view name, std::string_view fallback) const;
    double fastest() const;

    const CfgLookup& lookup_;
    const CfgInstance* single_;
    const CfgInstance* joint_;
    std::string name_; // of the joint
    const CfgInstance* arm_;
    const CfgInstance* transmission_;
};

} // namespace rt
