// Paths: lines and arcs are what they say, frames are composed the right way round, errors name what is
// wrong.

#include "runtime/motion/path.h"
#include "runtime/motion/targets.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

using namespace motion;
using robot::angleBetween;
using robot::fromAxisAngle;
using robot::fromEulerZyx;

namespace {

const robot::Kinematics& irb120() {
    static const robot::Kinematics kinematics = [] {
        auto model = robot::loadRobotModel("IRB 120-3/0.58");
        REQUIRE(model.hasValue());
        return robot::Kinematics(*model);
    }();
    return kinematics;
}

const JointTarget kReady{{0, 0, 0, 0, 30, 0}, kNoExternalAxes};

Pose pose(double x, double y, double z, Quat rot = {}) {
    return {{x, y, z}, rot};
}

void checkSame(const Pose& a, const Pose& b, double tolerance = 1e-8) {
    CHECK(norm(a.pos - b.pos) < tolerance);
    CHECK(angleBetween(a.rot, b.rot) < tolerance);
}

MoveCommand lineBy(double x, double y, double z, const JointTarget& start = kReady) {
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.target = calcRobTarget(irb120(), start, command.frames);
    command.target.pose = robot::offs(command.target.pose, x, y, z);
    return command;
}

MotionErrorKind errorOf(const MoveCommand& command, const JointTarget& start = kReady) {
    const auto path = MotionPath::make(irb120(), start, command);
    REQUIRE_FALSE(path.hasValue());
    CHECK_FALSE(path.error().message().empty());
    return path.error().kind;
}

} // namespace

TEST_CASE("tool, work object and displacement compose in the manual's order", "[motion][targets]") {
    FrameSetup frames;
    frames.baseFrame = pose(100, 200, 0, fromEulerZyx(90, 0, 0));
    frames.tool.tframe = pose(0, 0, 150, fromEulerZyx(0, 0, 30));
    frames.workObject.uframe = pose(500, 0, 20, fromEulerZyx(10, 0, 0));
    frames.workObject.oframe = pose(0, 40, 0);
    frames.displacement = pose(1, 2, 3);
    const Pose target = pose(10, 20, 30, fromEulerZyx(0, 180, 0));
    const Pose flange = frames.toFlange(target, kNoExternalAxes);
    checkSame(frames.baseFrame * flange * frames.tool.tframe,
              frames.workObject.uframe * frames.workObject.oframe * frames.displacement * target);
    checkSame(frames.fromFlange(flange, kNoExternalAxes), target);
    checkSame(frames.tcpInWorld(flange, kNoExternalAxes), frames.baseFrame * flange * frames.tool.tframe);

    // Stationary tool: the object rides on the flange.
    frames.tool.robotHeld = false;
    frames.workObject.robotHeld = true;
    const Pose held = frames.toFlange(target, kNoExternalAxes);
    checkSame(frames.baseFrame * held * frames.workObject.uframe * frames.workObject.oframe *
                  frames.displacement * target,
              frames.tool.tframe);
    checkSame(frames.fromFlange(held, kNoExternalAxes), target);
    checkSame(frames.tcpInWorld(held, kNoExternalAxes), frames.tool.tframe);
}

TEST_CASE("robtarget and jointtarget turn into each other", "[motion][targets]") {
    std::mt19937_64 random(2);
    FrameSetup frames;
    frames.tool.tframe = pose(10, 0, 100, fromEulerZyx(0, 45, 0));
    for (int n = 0; n < 500; ++n) {
        JointTarget joints;
        for (std::size_t i = 0; i < 6; ++i) {
            joints.robax[i] = std::uniform_real_distribution<double>(irb120().lowerDeg()[i],
                                                                     irb120().upperDeg()[i])(random);
        }
        const robot::Singularity near = irb120().singularity(joints.robax);
        if (near.wristDeg < 1 || near.armMm < 1 || near.elbowDeg < 1) continue;
        joints.extax[0] = 12;
        const RobTarget target = calcRobTarget(irb120(), joints, frames);
        CHECK(target.extax[0] == 12);
        CHECK(target.pose.rot.w >= 0);
        const auto back = calcJointTarget(irb120(), target, frames, {});
        REQUIRE(back.hasValue());
        for (std::size_t i = 0; i < 6; ++i)
            CHECK(back->robax[i] == Approx(joints.robax[i]).margin(1e-6));
    }
    frames.workObject.robotHeld = true; // both held
    CHECK_FALSE(calcJointTarget(irb120(), {}, frames, {}).hasValue());
}

TEST_CASE("floats become poses with unit quaternions", "[motion][targets]") {
    const float trans[3] = {1, 2, 3};
    const float rot[4] = {0.7071F, 0, 0.7071F, 0};
    const Pose read = poseFromFloats(trans, rot);
    CHECK(norm(read.rot) == Approx(1).epsilon(1e-15));
    float transBack[3];
    float rotBack[4];
    poseToFloats(read, transBack, rotBack);
    CHECK(transBack[2] == 3);
    CHECK(rotBack[0] == Approx(0.70710678));
}

TEST_CASE("a line runs straight and turns evenly", "[motion][path]") {
    const Pose from = pose(300, -100, 400, fromEulerZyx(0, 90, 0));
    const Pose to = pose(350, 150, 300, fromEulerZyx(20, 120, 10));
    const CartesianCurve line = CartesianCurve::line(from, to);
    checkSame(line.at(0), from);
    checkSame(line.at(1), to);
    CHECK(line.length() == Approx(norm(to.pos - from.pos)));
    for (double s : {0.1, 0.5, 0.77}) {
        const Pose at = line.at(s);
        CHECK(norm(at.pos - (from.pos + (to.pos - from.pos) * s)) < 1e-9);
        CHECK(angleBetween(from.rot, at.rot) == Approx(s * angleBetween(from.rot, to.rot)));
    }
}

TEST_CASE("an arc goes through its three points on their circle", "[motion][path]") {
    std::mt19937_64 random(4);
    const auto draw = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int n = 0; n < 300; ++n) {
        const Vec3 centre{draw(-500, 500), draw(-500, 500), draw(-500, 500)};
        const Quat plane = robot::normalized({draw(-1, 1), draw(-1, 1), draw(-1, 1), draw(-1, 1)});
        const double radius = draw(5, 800);
        const double sweep = draw(10, 239);
        const double share = draw(0.25, 0.75);
        const auto point = [&](double angle) {
            const double a = angle * std::numbers::pi / 180;
            return centre + rotate(plane, {radius * std::cos(a), radius * std::sin(a), 0});
        };
        const auto arc = CartesianCurve::arc({point(0), {}}, {point(sweep * share), {}}, {point(sweep), {}});
        REQUIRE(arc.hasValue());
        CHECK(arc->radius() == Approx(radius).epsilon(1e-8));
        CHECK(arc->sweepDeg() == Approx(sweep).epsilon(1e-8));
        CHECK(arc->length() == Approx(radius * sweep * std::numbers::pi / 180).epsilon(1e-8));
        for (double s : {0.0, share, 0.3, 0.9, 1.0}) {
            CHECK(norm(arc->at(s).pos - point(sweep * s)) < 1e-6);
            CHECK(std::fabs(dot(arc->at(s).pos - arc->centre(), arc->axis())) < 1e-6);
        }
    }
}

TEST_CASE("orientation on an arc turns relative to the circle", "[motion][path]") {
    const Quat start = fromEulerZyx(0, 180, 0);
    const Vec3 z{0, 0, 1};
    // The tool is kept constant relative to the path: it has turned with it by a quarter at the end.
    const Quat end = fromAxisAngle(z, 90) * start;
    const auto carried = CartesianCurve::arc(
        {{100, 0, 0}, start}, {{70.7, 70.7, 0}, fromAxisAngle(z, 45) * start}, {{0, 100, 0}, end});
    REQUIRE(carried.hasValue());
    const double sweep = carried->sweepDeg();
    for (double s : {0.25, 0.5, 1.0}) {
        CHECK(angleBetween(carried->at(s).rot, fromAxisAngle(carried->axis(), sweep * s) * start) < 0.1);
    }
    // The same orientation at both ends: it stays as it is, turning back relative to the circle.
    const auto fixed =
        CartesianCurve::arc({{100, 0, 0}, start}, {{70.7, 70.7, 0}, start}, {{0, 100, 0}, start});
    REQUIRE(fixed.hasValue());
    for (double s : {0.3, 0.6, 1.0})
        CHECK(angleBetween(fixed->at(s).rot, start) < 1e-6);
    CHECK(fixed->rotationDeg() < 1e-6);
    // A circle point turned by half a revolution chooses the other way round, with the same end.
    const Quat twisted = fromAxisAngle(z, 180) * fromAxisAngle(z, 45) * start;
    const Quat other = fromAxisAngle(z, 120) * start;
    const auto shortWay = CartesianCurve::arc(
        {{100, 0, 0}, start}, {{70.7, 70.7, 0}, fromAxisAngle(z, 60) * start}, {{0, 100, 0}, other});
    const auto longWay =
        CartesianCurve::arc({{100, 0, 0}, start}, {{70.7, 70.7, 0}, twisted}, {{0, 100, 0}, other});
    REQUIRE(shortWay.hasValue());
    REQUIRE(longWay.hasValue());
    CHECK(angleBetween(longWay->at(1).rot, other) < 1e-6);
    CHECK(angleBetween(longWay->at(0.5).rot, shortWay->at(0.5).rot) > 170);
    CHECK(longWay->rotationDeg() > shortWay->rotationDeg());
}

TEST_CASE("points that make no circle are refused", "[motion][path]") {
    const auto kind = [](const Vec3& a, const Vec3& b, const Vec3& c) {
        const auto arc = CartesianCurve::arc({a, {}}, {b, {}}, {c, {}});
        REQUIRE_FALSE(arc.hasValue());
        return arc.error().kind;
    };
    CHECK(kind({0, 0, 0}, {0.05, 0, 0}, {100, 0, 0}) == MotionErrorKind::CirclePointsTooClose);
    CHECK(kind({0, 0, 0}, {50, 50, 0}, {0, 0, 0}) == MotionErrorKind::CirclePointsTooClose);
    CHECK(kind({0, 0, 0}, {100, 0, 0}, {100, 0, 0}) == MotionErrorKind::CirclePointsTooClose);
    CHECK(kind({0, 0, 0}, {0, 0, 0}, {0, 0, 0}) == MotionErrorKind::CirclePointsTooClose);
    CHECK(kind({0, 0, 0}, {150, 0, 0}, {100, 0, 0}) == MotionErrorKind::CirclePointsCollinear);
    CHECK(kind({0, 0, 0}, {-50, 0.001, 0}, {100, 0, 0}) == MotionErrorKind::CirclePointsCollinear);
    // 270 degrees: from angle 0 over 135 to 270.
    CHECK(kind({100, 0, 0}, {-70.71, 70.71, 0}, {0, -100, 0}) == MotionErrorKind::CircleTooLarge);
}

TEST_CASE("points on one line run as that line, a very flat arc as an arc", "[motion][path]") {
    const auto straight = CartesianCurve::arc({{0, 0, 0}, {}}, {{50, 0, 0}, {}}, {{100, 0, 0}, {}});
    REQUIRE(straight.hasValue());
    CHECK_FALSE(straight->isArc());
    CHECK(straight->at(0.25).pos == Vec3{25, 0, 0});
    // Rise 0.2 mm over a chord of 100 mm: the angle at its ends is 0.23 degrees.
    const auto flat = CartesianCurve::arc({{0, 0, 0}, {}}, {{50, 0.2, 0}, {}}, {{100, 0, 0}, {}});
    REQUIRE(flat.hasValue());
    CHECK(flat->isArc());
    CHECK(flat->at(0.5).pos.y == Approx(0.2).margin(1e-6));
}

TEST_CASE("orientation on a circle: relative to the circle, to the object, or through the circle point",
          "[motion][path]") {
    // A quarter of a circle about z, the circle point at its middle.
    const Pose from{{100, 0, 0}, {}};
    const Pose over{{100 * std::sqrt(0.5), 100 * std::sqrt(0.5), 0}, robot::fromAxisAngle({1, 0, 0}, 40)};
    const Pose to{{0, 100, 0}, robot::fromAxisAngle({0, 0, 1}, 90)};
    const auto path = CartesianCurve::arc(from, over, to, CircleOrientation::PathFrame);
    const auto object = CartesianCurve::arc(from, over, {to.pos, robot::fromAxisAngle({1, 0, 0}, 60)},
                                            CircleOrientation::ObjectFrame);
    const auto through = CartesianCurve::arc(from, over, {to.pos, robot::fromAxisAngle({1, 0, 0}, 60)},
                                             CircleOrientation::CirclePoint);
    REQUIRE(path.hasValue());
    REQUIRE(object.hasValue());
    REQUIRE(through.hasValue());
    for (const double s : {0.1, 0.3, 0.5, 0.9}) {
        // The tool keeps its angle to the radius: it turns with the circle.
        CHECK(robot::angleBetween(path->at(s).rot, robot::fromAxisAngle({0, 0, 1}, 90 * s)) < 1e-6);
        CHECK(robot::angleBetween(object->at(s).rot, robot::fromAxisAngle({1, 0, 0}, 60 * s)) < 1e-6);
        const double angle = s < 0.5 ? 80 * s : 40 + 40 * (s - 0.5);
        CHECK(robot::angleBetween(through->at(s).rot, robot::fromAxisAngle({1, 0, 0}, angle)) < 1e-6);
    }
    CHECK(object->rotationDeg() == Approx(60));
    CHECK(through->rotationDeg() == Approx(80)); // 40 degrees on the first half
}

TEST_CASE("a resolved line keeps the TCP on the line at every parameter", "[motion][path]") {
    MoveCommand command = lineBy(-60, 150, -80);
    command.confL = false;
    const auto path = MotionPath::make(irb120(), kReady, command);
    REQUIRE(path.hasValue());
    const Pose from = command.frames.fromFlange(irb120().forward(kReady.robax), kReady.extax);
    for (int i = 0; i <= 500; ++i) {
        const double s = i / 500.0;
        const Pose at = irb120().forward(path->jointsAt(s));
        CHECK(norm(at.pos - (from.pos + (command.target.pose.pos - from.pos) * s)) < 1e-8);
        CHECK(angleBetween(at.rot, from.rot) < 1e-7);
    }
    CHECK(path->jointsAt(0) == kReady.robax);
    CHECK(path->jointsAt(1) == path->end().robax);
    CHECK(path->length() == Approx(norm(Vec3{-60, 150, -80})));
    for (std::size_t k = 1; k < path->nodes().size(); ++k)
        CHECK(path->nodes()[k].s > path->nodes()[k - 1].s);
}

TEST_CASE("SingArea: a line through the singularity of the wrist", "[motion][path]") {
    // Axis 5 passes 0 in the middle of a line along which the wrist swings from one side to the other.
    const JointTarget start{{0, 20, 10, 0, 20, 0}, kNoExternalAxes};
    const Pose from = irb120().forward(start.robax);
    MoveCommand command;
    command.kind = MoveKind::Linear;
    // Beside the plane of the arm axis 4 would have to turn half a revolution in a moment.
    command.target.pose = irb120().forward({0.001, 20, 10, 0, -20, 0});
    command.confL = false;
    const auto refused = MotionPath::make(irb120(), start, command);
    REQUIRE_FALSE(refused.hasValue());
    CHECK(refused.error().kind == MotionErrorKind::Singularity);
    command.singularity = SingularityMode::Wrist;
    const auto path = MotionPath::make(irb120(), start, command);
    REQUIRE(path.hasValue());
    const Vec3 way = command.target.pose.pos - from.pos;
    Joints before = start.robax;
    for (int i = 0; i <= 200; ++i) {
        const double s = i / 200.0;
        const Joints joints = path->jointsAt(s);
        CHECK(norm(irb120().forward(joints).pos - (from.pos + way * s)) < 1e-6); // the TCP stays on its line
        for (std::size_t axis = 0; axis < 6; ++axis)
            CHECK(std::fabs(joints[axis] - before[axis]) < 3); // and no axis jumps
        before = joints;
    }
    CHECK(angleBetween(irb120().forward(path->jointsAt(1)).rot, command.target.pose.rot) < 1e-6);
}

TEST_CASE("SingArea Wrist: the axes of the wrist turn evenly on every line and circle", "[motion][path]") {
    // Manual 2.2.4: the wrist is interpolated axis by axis and the TCP follows its path; on a circle the circle point has the
    // programmed orientation.
    const JointTarget start{{0, 20, 10, 30, 40, 20}, kNoExternalAxes};
    const Pose from = irb120().forward(start.robax);
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.target.pose = irb120().forward({20, 25, 0, 70, 50, -10});
    command.confL = false;
    command.singularity = SingularityMode::Wrist;
    SECTION("line") {
        const auto path = MotionPath::make(irb120(), start, command);
        REQUIRE(path.hasValue());
        const Vec3 way = command.target.pose.pos - from.pos;
        for (const double s : {0.25, 0.5, 0.75, 1.0}) {
            const Joints joints = path->jointsAt(s);
            CHECK(norm(irb120().forward(joints).pos - (from.pos + way * s)) < 1e-6);
            CHECK(joints[3] == Approx(30 + 40 * s).margin(1e-6));
            CHECK(joints[4] == Approx(40 + 10 * s).margin(1e-6));
            CHECK(joints[5] == Approx(20 - 30 * s).margin(1e-6));
        }
    }
    SECTION("circle") {
        command.kind = MoveKind::Circular;
        command.circlePoint = irb120().forward({10, 15, 8, 35, 30, 15});
        const auto path = MotionPath::make(irb120(), start, command);
        REQUIRE(path.hasValue());
        double nearest = 1e9;
        double turned = 1e9;
        for (int i = 0; i <= 2000; ++i) {
            const Pose here = irb120().forward(path->jointsAt(i / 2000.0));
            const double distance = norm(here.pos - command.circlePoint.pos);
            if (distance >= nearest) continue;
            nearest = distance;
            turned = angleBetween(here.rot, command.circlePoint.rot);
        }
        CHECK(nearest < 0.1);
        CHECK(turned < 0.1);
        CHECK(angleBetween(irb120().forward(path->jointsAt(1)).rot, command.target.pose.rot) < 1e-6);
    }
}

TEST_CASE("SingArea LockAxis4: axis 4 does not turn", "[motion][path]") {
    MoveCommand command = lineBy(0, 80, -40);
    command.confL = false;
    command.singularity = SingularityMode::LockAxis4;
    const auto path = MotionPath::make(irb120(), kReady, command);
    REQUIRE(path.hasValue());
    const Pose from = irb120().forward(kReady.robax);
    for (int i = 0; i <= 100; ++i) {
        const double s = i / 100.0;
        CHECK(path->jointsAt(s)[3] == Approx(kReady.robax[3]).margin(1e-9));
        CHECK(norm(irb120().forward(path->jointsAt(s)).pos - (from.pos + Vec3{0, 80, -40} * s)) < 1e-6);
    }
}

TEST_CASE("a line with a stationary tool is straight on the work object", "[motion][path]") {
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.frames.tool.robotHeld = false;
    command.frames.workObject.robotHeld = true;
    command.frames.tool.tframe = pose(420, 60, 500, fromEulerZyx(0, 90, 0));
    command.frames.workObject.uframe = pose(0, 0, 40);
    command.confL = false;
    const Pose from = command.frames.fromFlange(irb120().forward(kReady.robax), kReady.extax);
    command.target.pose = robot::offs(from, 30, -20, 10);
    const auto path = MotionPath::make(irb120(), kReady, command);
    REQUIRE(path.hasValue());
    for (int i = 0; i <= 100; ++i) {
        const double s = i / 100.0;
        const Pose at = command.frames.fromFlange(irb120().forward(path->jointsAt(s)), path->externalAt(s));
        CHECK(norm(at.pos - (from.pos + Vec3{30, -20, 10} * s)) < 1e-8);
        CHECK(angleBetween(at.rot, from.rot) < 1e-7);
    }
}

TEST_CASE("straight through the wrist singularity axis 4 does not turn", "[motion][path]") {
    // In the plane of the arm, turning the tool about y from axis 5 = 30 to axis 5 = -30.
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.confL = false;
    command.target.pose = irb120().forward({0, 0, 0, 0, -30, 0});
    const auto path = MotionPath::make(irb120(), kReady, command);
    REQUIRE(path.hasValue());
    for (int i = 0; i <= 200; ++i) {
        const Joints joints = path->jointsAt(i / 200.0);
        CHECK(joints[3] == Approx(0).margin(1e-6));
        CHECK(std::fabs(joints[4]) < 30.1);
    }
    CHECK(path->end().robax[4] == Approx(-30).margin(1e-6));
}

TEST_CASE("a target out of reach is judged before the way to it", "[motion][path]") {
    // docs/motion.md, Path: the error names what has to be corrected. The straight ways lead through the foot of the robot.
    const auto straightTo = [](const Pose& target) {
        MoveCommand command;
        command.kind = MoveKind::Linear;
        command.confL = false;
        command.target.pose = target;
        return MotionPath::make(irb120(), kReady, command);
    };
    const Pose ready = irb120().forward(kReady.robax);
    SECTION("no posture reaches the target") {
        const auto path = straightTo({{-900, 50, 400}, ready.rot});
        REQUIRE_FALSE(path.hasValue());
        CHECK(path.error().kind == MotionErrorKind::Unreachable);
        CHECK(path.error().pathFraction == 1);
        CHECK(path.error().position.x == Approx(-900));
    }
    SECTION("a posture reaches it: the way is what is impossible") {
        const auto path = straightTo(irb120().forward({160, 0, 0, 0, 30, 0}));
        REQUIRE_FALSE(path.hasValue());
        CHECK(path.error().pathFraction < 1);
    }
}

TEST_CASE("a path that misses a singularity by a hair is refused with the place", "[motion][path]") {
    const JointTarget start{{0, 0, 0, 0, 10, 0}, kNoExternalAxes};
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.confL = false;
    command.target.pose = irb120().forward({0, 0, 0, 0, -10, 0});
    // Axis 1 of the target is off by so little that the flip of axis 4 hides within micrometres.
    command.target.pose.rot = fromAxisAngle({0, 0, 1}, 1e-6) * command.target.pose.rot;
    const auto path = MotionPath::make(irb120(), start, command);
    REQUIRE_FALSE(path.hasValue());
    CHECK(path.error().kind == MotionErrorKind::Singularity);
    CHECK(path.error().pathFraction == Approx(0.5).margin(0.05));
}

TEST_CASE("errors tell what is wrong with a move", "[motion][path]") {
    CHECK(errorOf(lineBy(900, 0, 0)) == MotionErrorKind::Unreachable);
    MoveCommand far;
    far.kind = MoveKind::Joint;
    far.target.pose = pose(900, 0, 0);
    CHECK(errorOf(far) == MotionErrorKind::Unreachable);

    MoveCommand outside;
    outside.joints.robax = {0, 0, 75, 0, 0, 0};
    const auto tooFar = MotionPath::make(irb120(), kReady, outside);
    REQUIRE_FALSE(tooFar.hasValue());
    CHECK(tooFar.error().kind == MotionErrorKind::JointOutOfRange);
    CHECK(tooFar.error().joint == 3);
    CHECK(tooFar.error().value == 75);
    CHECK(tooFar.error().message().find("axis 3") != std::string::npos);

    // Turning the flange on and on by lines leaves the range of axis 6.
    const JointTarget nearEnd{{0, 0, 0, 0, 30, 390}, kNoExternalAxes};
    MoveCommand twist = lineBy(0, 0, 0, nearEnd);
    twist.confL = false;
    twist.target.pose = robot::relTool(twist.target.pose, 0, 0, 0, 0, 0, 30);
    const auto twisted = MotionPath::make(irb120(), nearEnd, twist);
    REQUIRE_FALSE(twisted.hasValue());
    CHECK(twisted.error().kind == MotionErrorKind::JointOutOfRange);
    CHECK(twisted.error().joint == 6);
    CHECK(twisted.error().pathFraction > 0.2);

    MoveCommand wrong = lineBy(10, 0, 0);
    wrong.target.conf.cf6 += 3;
    CHECK(errorOf(wrong) == MotionErrorKind::ConfigurationMismatch);
    wrong.confL = false;
    CHECK(MotionPath::make(irb120(), kReady, wrong).hasValue());
    wrong.kind = MoveKind::Joint;
    wrong.target.conf = {0, -2, 0, 0};
    CHECK(errorOf(wrong) == MotionErrorKind::NoSuchConfiguration);
    wrong.confJ = false;
    CHECK(MotionPath::make(irb120(), kReady, wrong).hasValue());

    MoveCommand bad = lineBy(10, 0, 0);
    bad.target.pose.pos.x = std::nan("");
    CHECK(errorOf(bad) == MotionErrorKind::BadArgument);
    bad = lineBy(10, 0, 0);
    bad.target.pose.rot = {0, 0, 0, 0};
    CHECK(errorOf(bad) == MotionErrorKind::BadArgument);
    bad = lineBy(10, 0, 0);
    bad.speed.vTcp = -1;
    CHECK(errorOf(bad) == MotionErrorKind::BadArgument);
    bad = lineBy(10, 0, 0);
    bad.frames.tool.robotHeld = false;
    CHECK(errorOf(bad) == MotionErrorKind::BadArgument);
}

TEST_CASE("ConfJ off takes the nearest posture", "[motion][path]") {
    MoveCommand command;
    command.kind = MoveKind::Joint;
    command.confJ = false;
    const Joints goal{20, 10, -10, 40, 50, 60};
    command.target.pose = irb120().forward(goal);
    const JointTarget start{{18, 12, -8, 42, 48, 58}, kNoExternalAxes};
    const auto path = MotionPath::make(irb120(), start, command);
    REQUIRE(path.hasValue());
    for (std::size_t i = 0; i < 6; ++i)
        CHECK(path->end().robax[i] == Approx(goal[i]).margin(1e-8));
}

TEST_CASE("external axes go along evenly, absent ones stay absent", "[motion][path]") {
    JointTarget start = kReady;
    start.extax[0] = 100;
    MoveCommand command;
    command.joints = kReady;
    command.joints.extax[0] = 300;
    command.joints.extax[1] = 5; // there is no such axis
    const auto path = MotionPath::make(irb120(), start, command);
    REQUIRE(path.hasValue());
    CHECK_FALSE(path->isEmpty());
    CHECK(path->externalAt(0.5)[0] == Approx(200));
    CHECK(path->end().extax[0] == 300);
    CHECK_FALSE(isConnected(path->externalAt(0.5)[1]));
    command.joints.extax[0] = kNotConnected;
    CHECK(MotionPath::make(irb120(), start, command)->end().extax[0] == 100);
    CHECK(MotionPath::make(irb120(), start, command)->isEmpty());
}
