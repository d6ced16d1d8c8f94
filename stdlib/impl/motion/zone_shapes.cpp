#include "stdlib/impl/motion/zone_shapes.h"

#include <cmath>

namespace rt::lib {
namespace {

bool isInVolume(const ZoneShape& shape, const robot::Vec3& tcp) {
    const std::array<double, 3> p{tcp.x, tcp.y, tcp.z};
    const double dx = p[0] - shape.low[0];
    const double dy = p[1] - shape.low[1];
    const double dz = p[2] - shape.low[2];
    switch (shape.kind) {
    case ZoneShape::Kind::Box:
        for (std::size_t i = 0; i < p.size(); ++i)
            if (p[i] < shape.low[i] || p[i] > shape.high[i]) return false;
        return true;
    case ZoneShape::Kind::Cylinder:
        return dz >= 0 && dz <= shape.height && std::hypot(dx, dy) <= shape.radius;
    case ZoneShape::Kind::Sphere: return std::hypot(dx, dy, dz) <= shape.radius;
    case ZoneShape::Kind::Joints: break;
    }
    return false;
}

bool isBetween(const ZoneShape& shape, const motion::MotionState& state) {
    const auto axes = state.numberedAxes();
    for (std::size_t i = 0; i < shape.lowAxes.size(); ++i) {
        const bool isLookedAt = motion::isConnected(shape.lowAxes[i]) &&
                                motion::isConnected(shape.highAxes[i]) && motion::isConnected(axes[i]);
        if (isLookedAt && (axes[i] < shape.lowAxes[i] || axes[i] > shape.highAxes[i])) return false;
    }
    return true;
}

} // namespace

bool ZoneShape::contains(const motion::MotionState& state) const {
    const bool isIn = kind == Kind::Joints ? isBetween(*this, state) : isInVolume(*this, state.tcp.pos);
    return isIn != outside;
}

Handle ZoneShapes::intern(const ZoneShape& shape) {
    const auto [at, isNew] = handles_.emplace(shape, static_cast<Handle>(shapes_.size() + 1));
    if (isNew) shapes_.push_back(&at->first);
    return at->second;
}

const ZoneShape* ZoneShapes::find(Handle handle) const {
    const auto index = static_cast<std::size_t>(handle - 1);
    return handle >= 1 && index < shapes_.size() ? shapes_[index] : nullptr;
}

} // namespace rt::lib
