#pragma once
// shapedata: the volumes of world zones (manual 2.9). A shape never changes; equal ones are one object.

#include "runtime/host/controller.h"

#include <array>
#include <compare>
#include <map>
#include <vector>

namespace rt::lib {

/// Six robot axes (deg), then six external axes (deg or mm).
using ZoneAxes = std::array<double, 12>;

struct ZoneShape {
    enum class Kind : uint8_t {
        Box,      ///< between two corners, sides parallel to the world axes
        Cylinder, ///< axis parallel to z of world
        Sphere,
        Joints ///< each axis between two values
    };
    Kind kind = Kind::Box;
    bool outside = false;           ///< the zone is everything but the volume
    std::array<double, 3> low{};    ///< mm in world: lower corner; centre (Cylinder: of the lower end)
    std::array<double, 3> high{};   ///< Box: upper corner
    double radius = 0, height = 0;  ///< mm
    ZoneAxes lowAxes{}, highAxes{}; ///< Joints; kNotConnected in one of them: the axis is not looked at

    /// Whether a robot in this state is in the zone. The surface of the volume belongs to it.
    bool contains(const motion::MotionState& state) const;

    friend auto operator<=>(const ZoneShape&, const ZoneShape&) = default;
};

/// The shapes of a controller. 0, the initial value of a shapedata, is none.
class ZoneShapes {
  public:
    Handle intern(const ZoneShape& shape);
    /// Null for a shapedata without contents.
    const ZoneShape* find(Handle handle) const;

  private:
    std::map<ZoneShape, Handle> handles_;
    std::vector<const ZoneShape*> shapes_; // by handle - 1
};

} // namespace rt::lib
