#include "tools/pendant/planned_path.h"

#include <cmath>
#include <numbers>

namespace rapidc::pendant {

namespace {

using robot::Vec3;

constexpr int kJointPieces = 24, kCirclePieces = 32;
constexpr double kStraight = 1e-6; // of the sine: three points on a line

/// TCP in world at these joints.
robot::Pose tcpAt(motion::MotionSystem& system, const motion::FrameSetup& frames,
                  const motion::JointTarget& joints) {
    return frames.tool.robotHeld ? system.flangeInWorld(joints) * frames.tool.tframe : frames.tool.tframe;
}

motion::JointTarget between(const motion::JointTarget& a, const motion::JointTarget& b, double share) {
    motion::JointTarget result = a;
    for (std::size_t i = 0; i < a.robax.size(); ++i)
        result.robax[i] = a.robax[i] + (b.robax[i] - a.robax[i]) * share;
    for (std::size_t i = 0; i < a.extax.size(); ++i)
        if (motion::isConnected(a.extax[i]) && motion::isConnected(b.extax[i]))
            result.extax[i] = a.extax[i] + (b.extax[i] - a.extax[i]) * share;
    return result;
}

/// Points of the circle from `a` through `b` to `c`.
std::vector<Vec3> circle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 u = b - a, v = c - a;
    const Vec3 normal = cross(u, v);
    const double square = dot(normal, normal);
    if (!(square > kStraight * dot(u, u) * dot(v, v))) return {a, b, c};
    const Vec3 toCentre = (cross(v, normal) * dot(u, u) + cross(normal, u) * dot(v, v)) * (0.5 / square);
    const Vec3 centre = a + toCentre;
    const Vec3 x = a - centre;
    const Vec3 y = cross(normal * (1 / std::sqrt(square)), x);
    double end = std::atan2(dot(c - centre, y), dot(c - centre, x));
    if (end < 0) end += 2 * std::numbers::pi;
    std::vector<Vec3> points;
    for (int i = 0; i <= kCirclePieces; ++i) {
        const double angle = end * i / kCirclePieces;
        points.push_back(centre + x * std::cos(angle) + y * std::sin(angle));
    }
    return points;
}

} // namespace

PlannedPath::PlannedPath(rt::MotionDriver& motion) : motion_(motion) {
    motion_.addOrderListener(
        [this, alive = std::weak_ptr<int>(alive_)](const rt::MotionDriver::Ordered& ordered) {
            if (!alive.expired()) note(ordered);
        });
}

void PlannedPath::note(const rt::MotionDriver::Ordered& ordered) {
    dropFinished();
    if (moves_.size() >= kMost) return;
    motion::MotionSystem& system = motion_.system();
    const motion::FrameSetup& frames = ordered.command.frames;
    Move move;
    move.id = ordered.id;
    move.kind = ordered.command.kind;
    move.to = tcpAt(system, frames, ordered.to);
    const Vec3 from = tcpAt(system, frames, ordered.from).pos;
    if (const rt::MotionPointer& pointer = motion_.pointer(); pointer.valid && pointer.routine != nullptr) {
        move.module = pointer.routine->module;
        const bool isKnown = pointer.statement >= 0 &&
                             static_cast<uint32_t>(pointer.statement) < pointer.routine->statementCount;
        if (isKnown) move.line = pointer.routine->statements[pointer.statement].line;
    }
    switch (move.kind) {
    case motion::MoveKind::Linear: move.points = {from, move.to.pos}; break;
    case motion::MoveKind::Circular: {
        const motion::WorkObjectFrame& object = frames.workObject;
        const robot::Pose place = object.uframe * object.oframe * frames.displacement;
        move.points = circle(from, apply(place, ordered.command.circlePoint.pos), move.to.pos);
        break;
    }
    default:
        for (int i = 0; i <= kJointPieces; ++i)
            move.points.push_back(
                tcpAt(system, frames,
                      between(ordered.from, ordered.to, static_cast<double>(i) / kJointPieces))
                    .pos);
    }
    moves_.push_back(std::move(move));
}

void PlannedPath::dropFinished() {
    motion::MotionSystem& system = motion_.system();
    std::erase_if(moves_, [&](const Move& move) { return system.isDone(move.id); });
}

const std::deque<PlannedPath::Move>& PlannedPath::moves() {
    dropFinished();
    return moves_;
}

} // namespace rapidc::pendant
