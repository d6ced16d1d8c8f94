#include "tools/pendant/arm_bodies.h"

#include "runtime/robot/kinematics.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace rapidc::pendant {

namespace {

using robot::Pose;
using robot::Quat;
using robot::Vec3;

constexpr double kSame = 1e-3; // mm; nearer points are one

Quat turnAbout(const Vec3& axis, double degrees) {
    const double half = degrees * std::numbers::pi / 360;
    const Vec3 v = axis * std::sin(half);
    return {std::cos(half), v.x, v.y, v.z};
}

/// The point of the line through `point` along `axis` (unit) that is nearest to another point.
Vec3 footOf(const Vec3& point, const Vec3& axis, const Vec3& other) {
    return point + axis * dot(other - point, axis);
}

Solid solid(Solid::Kind kind, Solid::Role role, const Vec3& from, const Vec3& to, double radius) {
    return {kind, role, from, to, radius, -1};
}

/// A body without anything to draw is one whose points coincide.
void addLink(Body& body, const Vec3& from, const Vec3& to, double radius) {
    if (norm(to - from) > kSame)
        body.solids.push_back(solid(Solid::Kind::Capsule, Solid::Role::Arm, from, to, radius));
}

void addJoint(Body& body, const Vec3& axis, double radius) {
    const Vec3 half = axis * (radius * 1.3);
    body.solids.push_back(solid(Solid::Kind::Cylinder, Solid::Role::Joint, half * -1.0, half, radius * 1.15));
}

/// Thickness of the arm: about the share of the reach that industrial robots have, thinner towards the flange.
double radiusAt(const robot::RobotModel& model, std::size_t place, std::size_t count) {
    const double reach = model.reachM > 0 ? model.reachM * 1000 : 1000;
    const double share = count > 1 ? static_cast<double>(place) / static_cast<double>(count - 1) : 0;
    return reach * (0.085 - 0.055 * share);
}

void addFlange(std::vector<Body>& bodies, int parent, const Pose& origin, double radius) {
    Body flange;
    flange.name = "flange";
    flange.parent = parent;
    flange.origin = origin;
    flange.solids.push_back(
        solid(Solid::Kind::Cylinder, Solid::Role::Flange, {0, 0, -radius * 0.6}, {0, 0, 0}, radius));
    bodies.push_back(std::move(flange));
}

Body baseBody(const Vec3& top, double radius) {
    Body base;
    base.name = "base";
    base.solids.push_back(
        solid(Solid::Kind::Cylinder, Solid::Role::Arm, {0, 0, 0}, {0, 0, radius * 0.35}, radius * 1.7));
    addLink(base, {0, 0, radius * 0.35}, top, radius * 1.1);
    return base;
}

/// Axes that follow one another. Each one's line comes from the Jacobian with all joints at zero, whatever the mechanism.
class SerialChain {
  public:
    explicit SerialChain(const robot::RobotModel& model) : model_(model), kinematics_(model) {
        const std::size_t count = kinematics_.jointCount();
        const robot::Joints zeros = robot::Joints::zeros(count);
        flange_ = kinematics_.forward(zeros);
        const robot::JacobianMatrix jacobian = kinematics_.jacobian(zeros);
        for (std::size_t k = 0; k < count; ++k) {
            const bool isSeven = model.kinematics == robot::KinematicsKind::SevenAxes && count == 7;
            static constexpr std::size_t kSevenOrder[7] = {0, 1, 6, 2, 3, 4, 5}; // axis 7 follows axis 2
            addAxis(jacobian, isSeven ? kSevenOrder[k] : k);
        }
    }

    std::vector<Body> bodies() const {
        const std::size_t count = axes_.size();
        const double thick = radiusAt(model_, 0, count);
        // The base carries the first axis up to where the arm leaves its line.
        const Vec3 shoulder = count > 1 ? footOf(axes_[0].point, axes_[0].direction, axes_[1].point) : Vec3{};
        std::vector<Body> bodies{baseBody(shoulder * 0.45, thick)};
        for (std::size_t k = 0; k < count; ++k) {
            const Axis& axis = axes_[k];
            const Vec3 before = k == 0 ? Vec3{} : axes_[k - 1].point;
            const Vec3 next = k + 1 < count ? axes_[k + 1].point : flange_.pos;
            const double radius = radiusAt(model_, k, count);
            Body body;
            body.name = fmt::format("link{}", kinematics_.axisNumber(axis.joint));
            body.parent = static_cast<int>(bodies.size()) - 1;
            body.origin.pos = axis.point - before;
            body.axis = axis.direction;
            body.motion = axis.isLinear ? Body::Motion::Linear : Body::Motion::Rotary;
            body.terms = {{static_cast<int>(axis.joint), 1.0}};
            const Vec3 corner = footOf(axis.point, axis.direction, next);
            if (k > 0) addJoint(body, axis.direction, radius);
            addLink(body, k == 0 ? corner * 0.45 : Vec3{}, corner - axis.point, radius);
            addLink(body, corner - axis.point, next - axis.point, radius);
            bodies.push_back(std::move(body));
        }
        const Vec3 last = axes_.empty() ? Vec3{} : axes_.back().point;
        const Pose origin{flange_.pos - last, flange_.rot};
        addFlange(bodies, static_cast<int>(bodies.size()) - 1, origin,
                  radiusAt(model_, count - 1, count) * 1.1);
        return bodies;
    }

  private:
    struct Axis {
        std::size_t joint = 0;
        bool isLinear = false;
        Vec3 direction, point;
    };

    void addAxis(const robot::JacobianMatrix& jacobian, std::size_t joint) {
        const auto at = [&](std::size_t row) { return jacobian(row, joint); };
        const Vec3 speed{at(0), at(1), at(2)};
        const Vec3 turn{at(3), at(4), at(5)};
        Axis axis;
        axis.joint = joint;
        axis.isLinear = kinematics_.isLinear(joint);
        const Vec3 before = axes_.empty() ? Vec3{} : axes_.back().point;
        if (axis.isLinear) {
            axis.direction = speed * (1 / std::max(norm(speed), 1e-12));
            axis.point = footOf(flange_.pos, axis.direction, before);
        } else {
            axis.direction = turn * (1 / std::max(norm(turn), 1e-12));
            // speed = turn x (flange - point)
            axis.point = footOf(flange_.pos - cross(speed, axis.direction), axis.direction, before);
        }
        axes_.push_back(axis);
    }

    const robot::RobotModel& model_;
    robot::Kinematics kinematics_;
    Pose flange_;
    std::vector<Axis> axes_;
};

/// A body that turns by sign * joint + shift, as the mechanism counts it.
Body turning(const robot::RobotModel& model, const char* name, int parent, const Pose& origin,
             const Vec3& axis, std::initializer_list<std::pair<int, double>> models) {
    Body body;
    body.name = name;
    body.parent = parent;
    body.origin = origin;
    body.axis = axis;
    body.motion = Body::Motion::Rotary;
    for (const auto& [joint, factor] : models) {
        const auto i = static_cast<std::size_t>(joint);
        body.terms.emplace_back(joint, factor * model.geometry.signs[i]);
        body.constant -= factor * model.geometry.offsetsDeg[i];
    }
    return body;
}

std::vector<Body> parallelRods(const robot::RobotModel& model) {
    const robot::ParallelRodGeometry& g = model.parallelRods;
    const double r = radiusAt(model, 0, 4);
    constexpr Vec3 kY{0, 1, 0}, kZ{0, 0, 1};
    std::vector<Body> bodies{baseBody({0, 0, g.c1 * 0.45}, r)};
    Body turret = turning(model, "link1", 0, {}, kZ, {{0, 1.0}});
    addLink(turret, {0, 0, g.c1 * 0.45}, {g.a1, 0, g.c1}, r);
    bodies.push_back(turret);
    // Axis 2 counts from the vertical, axis 3 from the horizontal whatever axis 2 does.
    Body lower = turning(model, "link2", 1, {{g.a1, 0, g.c1}, {}}, kY, {{1, 1.0}});
    addJoint(lower, kY, r);
    addLink(lower, {}, {0, 0, g.c2}, r * 0.85);
    bodies.push_back(lower);
    Body upper = turning(model, "link3", 2, {{0, 0, g.c2}, {}}, kY, {{2, 1.0}, {1, -1.0}});
    addJoint(upper, kY, r * 0.8);
    addLink(upper, {-g.c3 * 0.2, 0, 0}, {g.c3, 0, 0}, r * 0.7);
    bodies.push_back(upper);
    Body wrist = turning(model, "wrist", 3, {{g.c3, 0, 0}, {}}, kY, {{2, -1.0}});
    addJoint(wrist, kY, r * 0.6);
    addLink(wrist, {}, {g.out, 0, 0}, r * 0.55);
    addLink(wrist, {g.out, 0, 0}, {g.out, 0, -g.down}, r * 0.5);
    bodies.push_back(wrist);
    bodies.push_back(turning(model, "link6", 4, {{g.out, 0, -g.down}, {}}, kZ, {{3, -1.0}}));
    addFlange(bodies, 5, {{}, model.flangeRot}, r * 0.6);
    return bodies;
}

std::vector<Body> delta(const robot::RobotModel& model) {
    const robot::DeltaGeometry& g = model.delta;
    const double r = g.upperArm * 0.08;
    Body base;
    base.name = "base";
    base.solids.push_back(
        solid(Solid::Kind::Cylinder, Solid::Role::Arm, {0, 0, -r}, {0, 0, r * 3}, g.baseRadius + r));
    std::vector<Body> bodies{base};
    Body carried; // what the motion gives; the flange itself comes last
    carried.name = "carried";
    carried.motion = Body::Motion::Flange;
    bodies.push_back(carried);
    // The platform stays level and does not turn with axis 4.
    Body platform =
        turning(model, "platform", 1, {{}, robot::conjugate(model.flangeRot)}, {0, 0, 1}, {{3, -1.0}});
    const Vec3 centre{0, 0, g.flangeDown};
    platform.solids.push_back(solid(Solid::Kind::Cylinder, Solid::Role::Arm, {0, 0, g.flangeDown - r}, centre,
                                    g.platformRadius + r));
    bodies.push_back(platform);
    for (int k = 0; k < 3; ++k) {
        const Quat direction = turnAbout({0, 0, 1}, 120.0 * k);
        const Pose origin{rotate(direction, {g.baseRadius, 0, 0}), direction};
        Body arm = turning(model, "arm", -1, origin, {0, 1, 0}, {{k, 1.0}});
        arm.name = fmt::format("link{}", k + 1);
        addJoint(arm, {0, 1, 0}, r * 1.2);
        addLink(arm, {}, {g.upperArm, 0, 0}, r);
        for (const double side : {-1.0, 1.0}) {
            const Vec3 across{0, side * r * 2.5, 0};
            Solid rod = solid(Solid::Kind::Rod, Solid::Role::Arm, Vec3{g.upperArm, 0, 0} + across,
                              centre + rotate(direction, Vec3{g.platformRadius, 0, 0} + across), r * 0.35);
            rod.toBody = 2;
            arm.solids.push_back(rod);
        }
        bodies.push_back(std::move(arm));
    }
    addFlange(bodies, 1, {}, r * 1.5);
    return bodies;
}

} // namespace

std::vector<Body> bodiesOf(const robot::RobotModel& model) {
    switch (model.kinematics) {
    case robot::KinematicsKind::NoArm: return {};
    case robot::KinematicsKind::ParallelRods: return parallelRods(model);
    case robot::KinematicsKind::Delta: return delta(model);
    default: return SerialChain(model).bodies();
    }
}

std::vector<Pose> posesOf(const std::vector<Body>& bodies, const robot::Joints& joints, const Pose& flange) {
    std::vector<Pose> poses;
    for (const Body& body : bodies) {
        double value = body.constant;
        for (const auto& [joint, factor] : body.terms)
            value += factor * joints[static_cast<std::size_t>(joint)];
        Pose moved;
        if (body.motion == Body::Motion::Rotary) moved.rot = turnAbout(body.axis, value);
        if (body.motion == Body::Motion::Linear) moved.pos = body.axis * value;
        if (body.motion == Body::Motion::Flange) moved = flange;
        const Pose parent = body.parent < 0 ? Pose{} : poses[static_cast<std::size_t>(body.parent)];
        poses.push_back(parent * body.origin * moved);
    }
    return poses;
}

} // namespace rapidc::pendant
