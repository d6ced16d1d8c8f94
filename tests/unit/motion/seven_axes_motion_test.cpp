// Arms with seven axes move: the arm angle along lines, circles and joint moves, in corners, through stops; and what is
// refused (docs/motion.md).

#include "runtime/motion/motion_system.h"
#include "runtime/motion/path.h"
#include "tests/unit/motion/motion_system_rig.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace motion_testing;

namespace {

MotionSystem yumi(const char* name = "IRB 14050-0.5/0.559") {
    return MotionSystem(robot::loadRobotModel(name).value());
}

RobTarget here(const MotionSystem& system) {
    return system.toRobTarget(system.plannedEnd(), {});
}

MoveCommand lineTo(const RobTarget& target, double zone = -1) {
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.target = target;
    command.speed = {200, 500, 5000, 1000};
    if (zone >= 0) command.zone = {false, zone, 1.5 * zone, 1.5 * zone, 0.15 * zone, 1.5 * zone, 0.15 * zone};
    return command;
}

/// A line by these mm and this change of the arm angle, from where the last move ends.
MoveCommand armLineBy(const MotionSystem& system, double x, double y, double z, double arm,
                      double zone = -1) {
    RobTarget target = here(system);
    target.pose = robot::offs(target.pose, x, y, z);
    target.armAngle += arm;
    return lineTo(target, zone);
}

struct Sample {
    double seconds;
    MotionState state;
    double armAngle;
};

/// Runs what is ordered to its end, with a sample each ms.
std::vector<Sample> samplesOf(MotionSystem& system) {
    std::vector<Sample> samples;
    for (int i = 0; i < 60'000 && (!system.isIdle() || system.isMoving()); ++i) {
        system.advanceTo(system.now() + kMs);
        const MotionState state = system.current();
        samples.push_back(
            {static_cast<double>(system.now()) * 1e-9, state, system.kinematics().armAngle(state.joints)});
    }
    REQUIRE(system.isIdle());
    return samples;
}

/// Highest speed of an axis as a share of its limit.
double fastestAxis(const MotionSystem& system, const std::vector<Sample>& samples) {
    double most = 0;
    for (std::size_t n = 1; n < samples.size(); ++n)
        for (std::size_t i = 0; i < 7; ++i)
            most = std::max(most, std::fabs(samples[n].state.joints[i] - samples[n - 1].state.joints[i]) /
                                      (0.001 * system.model().maxSpeed[i]));
    return most;
}

} // namespace

TEST_CASE("an arm with seven axes starts where its model says", "[motion][seven]") {
    const MotionSystem system = yumi();
    CHECK(system.current().joints == Joints{0, -130, 30, 0, 40, 0, 135});
    const auto axes = system.current().numberedAxes();
    CHECK(axes[1] == -130);
    CHECK(axes[6] == 135); // axis 7 is shown as external axis a
    CHECK(axes[7] == kNotConnected);
}

TEST_CASE("the arm angle turns evenly along a line", "[motion][seven]") {
    MotionSystem system = yumi();
    const RobTarget from = here(system);
    REQUIRE(system.enqueue(armLineBy(system, 60, -40, 50, 12)).hasValue());
    const auto samples = samplesOf(system);
    const Vec3 way{60, -40, 50};
    for (const Sample& sample : samples) {
        const Vec3 gone = sample.state.tcp.pos - from.pose.pos;
        const double share = dot(gone, way) / dot(way, way);
        CHECK(norm(gone - way * share) < 1e-6); // on the line
        CHECK(robot::angleBetween(sample.state.tcp.rot, from.pose.rot) < 1e-5);
        CHECK(std::fabs(std::remainder(sample.armAngle - from.armAngle - 12 * share, 360.0)) < 1e-6);
    }
    CHECK(fastestAxis(system, samples) < 1.02);
}

TEST_CASE("a free arm angle stays as it is on a line", "[motion][seven]") {
    MotionSystem system = yumi();
    const double before = here(system).armAngle;
    MoveCommand command = armLineBy(system, 40, 40, 40, 0);
    command.target.armAngle = robot::kSeedArmAngle;
    REQUIRE(system.enqueue(command).hasValue());
    for (const Sample& sample : samplesOf(system))
        CHECK(sample.armAngle == Approx(before).margin(1e-6));
}

TEST_CASE("the arm angle can turn while the TCP is at rest", "[motion][seven]") {
    MotionSystem system = yumi();
    const RobTarget from = here(system);
    MoveCommand command = armLineBy(system, 0, 0, 0, 20);
    command.speed.vReax = 10; // deg/s: eax_a is the place of a rotating external axis
    REQUIRE(system.enqueue(command).hasValue());
    const auto samples = samplesOf(system);
    CHECK(samples.back().seconds > 2.0);
    CHECK(samples.back().seconds < 2.5);
    for (const Sample& sample : samples)
        CHECK(norm(sample.state.tcp.pos - from.pose.pos) < 1e-6);
    CHECK(samples.back().armAngle == Approx(std::remainder(from.armAngle + 20, 360.0)).margin(1e-6));
}

TEST_CASE("the arm angle turns the short way", "[motion][seven]") {
    MotionSystem system = yumi();
    RobTarget target = here(system);
    target.armAngle += 10 + 720;
    REQUIRE(system.enqueue(lineTo(target)).hasValue());
    const auto samples = samplesOf(system);
    double most = 0;
    for (const Sample& sample : samples)
        most = std::max(most, std::fabs(std::remainder(sample.armAngle - target.armAngle, 360.0)));
    CHECK(most <= 10 + 1e-6);
}

TEST_CASE("a circle carries the arm angle to that of its target", "[motion][seven]") {
    MotionSystem system = yumi();
    const RobTarget from = here(system);
    MoveCommand command = armLineBy(system, 40, 40, 0, 8);
    command.kind = MoveKind::Circular;
    command.circlePoint = robot::offs(from.pose, 40, 0, 0); // a half circle about (20, 20)
    REQUIRE(system.enqueue(command).hasValue());
    const auto samples = samplesOf(system);
    const Vec3 centre = from.pose.pos + Vec3{20, 20, 0};
    for (const Sample& sample : samples)
        CHECK(norm(sample.state.tcp.pos - centre) == Approx(std::hypot(20.0, 20.0)).margin(1e-6));
    CHECK(samples.back().armAngle == Approx(std::remainder(from.armAngle + 8, 360.0)).margin(1e-6));
}

TEST_CASE("joint moves reach pose and arm angle of their target", "[motion][seven]") {
    MotionSystem system = yumi();
    MoveCommand command = armLineBy(system, 80, -30, 60, -10);
    command.kind = MoveKind::Joint;
    REQUIRE(system.enqueue(command).hasValue());
    samplesOf(system);
    CHECK(norm(system.current().tcp.pos - command.target.pose.pos) < 1e-6);
    CHECK(here(system).armAngle == Approx(std::remainder(command.target.armAngle, 360.0)).margin(1e-6));
    // All seven axes start and arrive together.
    MoveCommand absolute;
    absolute.joints.robax = {10, -100, 20, 15, 50, 20, 100};
    REQUIRE(system.enqueue(absolute).hasValue());
    samplesOf(system);
    CHECK(system.current().joints == absolute.joints.robax);
    absolute.joints.robax[6] = kNotConnected; // axis 7 stays
    absolute.joints.robax[0] = 0;
    REQUIRE(system.enqueue(absolute).hasValue());
    samplesOf(system);
    CHECK(system.current().joints[6] == 100);
}

TEST_CASE("a free arm angle that cannot be kept is replaced by the nearest possible one", "[motion][seven]") {
    MotionSystem system = yumi();
    RobTarget target = here(system);
    // Far down in front of the arm: with the arm angle of the start axis 2 would leave its range.
    target.pose.pos = {350, 0, 100};
    MoveCommand command = lineTo(target);
    command.kind = MoveKind::Joint;
    command.confJ = false;
    const robot::Kinematics& arm = system.kinematics();
    const double kept = target.armAngle;
    const bool isPossible = arm.inverseNear(target.pose, system.plannedEnd().robax, kept).hasValue();
    command.target.armAngle = robot::kSeedArmAngle;
    const auto moved = system.enqueue(command);
    REQUIRE(moved.hasValue());
    const double taken = arm.armAngle(system.plannedEnd().robax);
    const double away = std::fabs(std::remainder(taken - kept, 360.0));
    if (isPossible) CHECK(away < 1e-6);
    // No multiple of 5 degrees nearer to the start does it.
    for (double less = 5; less < away - 1e-6; less += 5)
        for (const double side : {-1.0, 1.0})
            CHECK_FALSE(arm.inverseNear(target.pose, Joints{0, -130, 30, 0, 40, 0, 135}, kept + side * less)
                            .hasValue());
}

TEST_CASE("corners of a seven-axis arm are smooth in all axes and in the arm angle", "[motion][seven]") {
    for (const double zone : {5.0, 20.0, 1000.0}) {
        CAPTURE(zone);
        MotionSystem system = yumi();
        const Vec3 from = system.current().tcp.pos;
        REQUIRE(system.enqueue(armLineBy(system, 60, 0, 0, 6, zone)).hasValue());
        REQUIRE(system.enqueue(armLineBy(system, 0, 0, 60, -4, zone)).hasValue());
        MoveCommand joint = armLineBy(system, 0, 40, 0, 3, zone);
        joint.kind = MoveKind::Joint;
        REQUIRE(system.enqueue(joint).hasValue());
        REQUIRE(system.enqueue(armLineBy(system, -30, 0, 0, 0)).hasValue());
        const auto samples = samplesOf(system);
        for (const MotionEvent& event : system.takeEvents())
            CHECK(event.kind != MotionEventKind::CornerLost);
        double nearest = 1e9;
        for (const Sample& sample : samples)
            nearest = std::min(nearest, norm(sample.state.tcp.pos - (from + Vec3{60, 0, 0})));
        // 0.432 r sin(45 degrees), r at most half of the line.
        CHECK(nearest == Approx(0.432 * std::min(zone, 30.0) * std::sqrt(0.5)).epsilon(0.08));
        CHECK(fastestAxis(system, samples) < 1.1);
        double largest = 0; // of the arm angle in a millisecond
        for (std::size_t n = 1; n < samples.size(); ++n)
            largest = std::max(
                largest, std::fabs(std::remainder(samples[n].armAngle - samples[n - 1].armAngle, 360.0)));
        CHECK(largest < 0.3);
    }
}

TEST_CASE("the path of a seven-axis arm is the same at every override", "[motion][seven]") {
    const auto pathAt = [](double percent) {
        MotionSystem system = yumi();
        system.setOverride(percent);
        REQUIRE(system.enqueue(armLineBy(system, 60, 0, 0, 10, 20)).hasValue());
        REQUIRE(system.enqueue(armLineBy(system, 0, 20, 60, -5, 20)).hasValue());
        REQUIRE(system.enqueue(armLineBy(system, -40, 0, 0, 0)).hasValue());
        return samplesOf(system);
    };
    const auto slow = pathAt(10);
    std::size_t near = 0;
    for (const Sample& sample : pathAt(100)) {
        const auto distance = [&](std::size_t k) {
            double most = 0;
            for (std::size_t i = 0; i < 7; ++i)
                most = std::max(most, std::fabs(slow[k].state.joints[i] - sample.state.joints[i]));
            return most;
        };
        while (near + 1 < slow.size() && distance(near + 1) <= distance(near))
            ++near;
        CHECK(distance(near) < 0.1); // the slow run has a sample at most that far away
    }
}

TEST_CASE("a stop holds a seven-axis arm on its path, and motors off let it return", "[motion][seven]") {
    MotionSystem system = yumi();
    const RobTarget from = here(system);
    REQUIRE(system.enqueue(armLineBy(system, 60, -40, 50, 12)).hasValue());
    const JointTarget end = system.plannedEnd();
    system.advanceTo(150 * kMs);
    system.halt();
    system.advanceTo(1000 * kMs);
    CHECK_FALSE(system.isMoving());
    system.start();
    const auto samples = samplesOf(system);
    for (std::size_t i = 0; i < 7; ++i)
        CHECK(system.current().joints[i] == Approx(end.robax[i]).margin(1e-6));
    CHECK(norm(system.current().tcp.pos - from.pose.pos - Vec3{60, -40, 50}) < 1e-6);
    CHECK(fastestAxis(system, samples) < 1.05);
}

TEST_CASE("moves that a seven-axis arm cannot make say why", "[motion][seven]") {
    MotionSystem system = yumi();
    const auto kindOf = [&](const MoveCommand& command) {
        const auto result = system.enqueue(command);
        REQUIRE_FALSE(result.hasValue());
        CHECK_FALSE(result.error().message().empty());
        CHECK(system.isIdle());
        return result.error().kind;
    };
    CHECK(kindOf(armLineBy(system, 2000, 0, 0, 0)) == MotionErrorKind::Unreachable);
    MoveCommand angle = armLineBy(system, 20, 0, 0, 0);
    angle.target.armAngle = HUGE_VAL;
    CHECK(kindOf(angle) == MotionErrorKind::BadArgument);
    MoveCommand six;
    six.joints.robax = {0, -100, 0, 0, 30, 0}; // an arm of six axes
    CHECK(kindOf(six) == MotionErrorKind::BadArgument);
    MoveCommand outside;
    outside.joints.robax = {0, -130, 30, 0, 40, 0, 170};
    const auto refused = system.enqueue(outside);
    REQUIRE_FALSE(refused.hasValue());
    CHECK(refused.error().kind == MotionErrorKind::JointOutOfRange);
    CHECK(refused.error().message().find("axis 7 would have to go to 170.00") != std::string::npos);
    // Axis 2 at 0: axes 1 and 7 are in line (manual 2.7). Joint moves pass it, a line along axis 1's plane does not.
    MoveCommand wrong = armLineBy(system, 20, 0, 0, 0);
    wrong.target.conf.cfx ^= 4; // axis 2 above 0
    CHECK(kindOf(wrong) == MotionErrorKind::ConfigurationMismatch);
    wrong.kind = MoveKind::Joint;
    wrong.target.conf.cfx ^= 4;
    wrong.target.conf.cf1 += 2;
    CHECK(kindOf(wrong) == MotionErrorKind::NoSuchConfiguration);
    MoveCommand tilted = armLineBy(system, 20, 0, 0, 0);
    tilted.target.pose.rot = {2, 0, 0, 0};
    CHECK(kindOf(tilted) == MotionErrorKind::BadArgument);
    MoveCommand nowhere = armLineBy(system, 20, 0, 0, 0);
    nowhere.target.pose.pos.y = std::nan("");
    CHECK(kindOf(nowhere) == MotionErrorKind::BadArgument);
    MoveCommand circle = armLineBy(system, 20, 20, 0, 0);
    circle.kind = MoveKind::Circular;
    circle.circlePoint = circle.target.pose;
    CHECK(kindOf(circle) == MotionErrorKind::CirclePointsTooClose);
}

TEST_CASE("a line through the singularity of the shoulder is refused, a joint move passes it",
          "[motion][seven]") {
    MotionSystem system = yumi();
    REQUIRE(system.placeAt({{0, -20, 20, 30, 60, 0, 40}, kNoExternalAxes}));
    MoveCommand over;
    over.joints.robax = {0, 20, 20, 30, 60, 0, 40};
    MotionSystem other = yumi();
    REQUIRE(other.placeAt({over.joints.robax, kNoExternalAxes}));
    MoveCommand line = lineTo(here(other));
    line.confL = false;
    const auto refused = system.enqueue(line);
    if (!refused) {
        const bool isKnown = refused.error().kind == MotionErrorKind::Singularity ||
                             refused.error().kind == MotionErrorKind::JointOutOfRange;
        CHECK(isKnown);
    } else {
        CHECK(fastestAxis(system, samplesOf(system)) < 1.1); // the line goes another way round
    }
    MotionSystem third = yumi();
    REQUIRE(third.placeAt({{0, -20, 20, 30, 60, 0, 40}, kNoExternalAxes}));
    REQUIRE(third.enqueue(over).hasValue());
    CHECK(fastestAxis(third, samplesOf(third)) < 1.02);
}

TEST_CASE("external axes of a seven-axis arm begin at b", "[motion][seven]") {
    MotionOptions options;
    options.external[0].present = options.external[1].present = true;
    MotionSystem system(robot::loadRobotModel("IRB 14050-0.5/0.559").value(), options);
    CHECK_FALSE(isConnected(system.currentJoints().extax[0]));
    CHECK(isConnected(system.currentJoints().extax[1]));
    MoveCommand move;
    move.joints = system.plannedEnd();
    move.joints.extax[1] = 2e7;
    const auto refused = system.enqueue(move);
    REQUIRE_FALSE(refused.hasValue());
    CHECK(refused.error().message().find("external axis b") != std::string::npos);
}

TEST_CASE("at the circle point of a circle in steps the arm angle has come as far as the TCP",
          "[motion][seven]") {
    MotionSystem system = yumi();
    const RobTarget from = here(system);
    MoveCommand circle = armLineBy(system, 40, 40, 0, 8);
    circle.kind = MoveKind::Circular;
    circle.circlePoint = robot::offs(from.pose, 40, 0, 0); // half of the way on a half circle
    const auto parts = splitAtCirclePoint(circle, from);
    REQUIRE(parts.size() == 2);
    CHECK(std::remainder(parts[0].target.armAngle - from.armAngle, 360.0) == Approx(4).margin(1e-9));
    CHECK(parts[1].target.armAngle == circle.target.armAngle);
    RobTarget withAxis = from;
    withAxis.extax[1] = 100;
    circle.target.extax[1] = 300;
    CHECK(splitAtCirclePoint(circle, withAxis)[0].target.extax[1] == Approx(200));
}
