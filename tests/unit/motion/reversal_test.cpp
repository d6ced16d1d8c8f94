// Fly-by points at which the path turns back on itself (docs/motion.md, "The path"): the TCP comes to rest on the way, and the axes accelerate little more
// than they may; before and after it the programmed speed holds.

#include "runtime/motion/motion_system.h"
#include "runtime/robot/dynamics.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace motion;

namespace {

constexpr TimeNs kSample = 1'000'000;
constexpr double kSampleSeconds = 1e-9 * static_cast<double>(kSample);

/// Figures of the execution of a program.
struct Execution {
    double seconds = 0;
    double fastest = 0;         ///< mm/s of the TCP
    double slowest = 1e300;     ///< the same, in the middle half of the time
    double acceleration = 0;    ///< largest of an axis, as a share of its limit in that pose
    double tcpAcceleration = 0; ///< mm/s^2
};

MotionSystem largeRobot() {
    MotionSystem system(robot::loadRobotModel("IRB 6640-180/2.55").value());
    system.placeAt({{0, 10, 10, 0, 60, 0}, kNoExternalAxes});
    return system;
}

Execution executed(MotionSystem& system, const std::vector<MoveCommand>& program) {
    for (const MoveCommand& command : program)
        REQUIRE(system.enqueue(command));
    const robot::AccelerationMap accelerations(system.model());
    std::array<MotionState, 3> last;
    last.fill(system.current());
    const TimeNs begin = system.now();
    Execution execution;
    std::vector<double> speeds;
    while (!(system.isIdle() && !system.isMoving()) && system.now() - begin < 60'000'000'000) {
        system.advanceTo(system.now() + kSample);
        std::rotate(last.begin(), last.begin() + 1, last.end());
        last[2] = system.current();
        speeds.push_back(norm(last[2].tcp.pos - last[1].tcp.pos) / kSampleSeconds);
        const Vec3 bend = last[2].tcp.pos - last[1].tcp.pos * 2.0 + last[0].tcp.pos;
        execution.tcpAcceleration =
            std::max(execution.tcpAcceleration, norm(bend) / (kSampleSeconds * kSampleSeconds));
        Joints most = last[1].joints;
        accelerations.limitsAt(last[1].joints, most);
        for (std::size_t i = 0; i < most.size(); ++i) {
            const double change = last[2].joints[i] - 2 * last[1].joints[i] + last[0].joints[i];
            execution.acceleration = std::max(execution.acceleration,
                                              std::abs(change) / (kSampleSeconds * kSampleSeconds * most[i]));
        }
    }
    execution.seconds = 1e-9 * static_cast<double>(system.now() - begin);
    execution.fastest = *std::max_element(speeds.begin(), speeds.end());
    const auto middle = static_cast<std::ptrdiff_t>(speeds.size() / 4);
    execution.slowest = *std::min_element(speeds.begin() + middle, speeds.end() - middle);
    return execution;
}

struct Turn {
    MoveKind kind = MoveKind::Linear;
    double degrees = 180;
    double speed = 1000, zone = 50; ///< mm/s, mm
};

/// 300 mm to one side, then as far in a direction that differs by an angle.
std::vector<MoveCommand> programOf(const MotionSystem& system, const Turn& turn, bool isFine) {
    constexpr double kWay = 300;
    const double angle = turn.degrees * M_PI / 180;
    MoveCommand command;
    command.kind = turn.kind;
    command.confL = false;
    command.speed.vTcp = turn.speed;
    command.zone = {isFine,           turn.zone,       1.5 * turn.zone, 1.5 * turn.zone,
                    0.15 * turn.zone, 1.5 * turn.zone, 0.15 * turn.zone};
    command.target = system.toRobTarget(system.plannedEnd(), command.frames);
    std::vector<MoveCommand> program;
    command.target.pose = robot::offs(command.target.pose, 0, kWay, 0);
    program.push_back(command);
    command.target.pose = robot::offs(command.target.pose, 0, kWay * std::cos(angle), kWay * std::sin(angle));
    command.zone.finep = true;
    program.push_back(command);
    return program;
}

Execution executed(const Turn& turn, bool isFine = false) {
    MotionSystem system = largeRobot();
    return executed(system, programOf(system, turn, isFine));
}

} // namespace

TEST_CASE("where a path turns back on itself in a zone the TCP comes to rest within the limits of the axes",
          "[motion][reversal]") {
    // 1.25 times the speed at which an axis keeps its limit, so 1.56 times the acceleration, and what the rest of the windows adds. A
    // speed that is not lowered needs more than 10 times the limit.
    constexpr double kMost = 3;
    for (const MoveKind kind : {MoveKind::Linear, MoveKind::Joint})
        for (const double degrees : {180.0, 175.0, 160.0})
            for (const double speed : {100.0, 300.0, 1000.0, 5000.0})
                for (const double zone : {1.0, 10.0, 50.0, 150.0}) {
                    CAPTURE(static_cast<int>(kind), degrees, speed, zone);
                    const Execution execution = executed({kind, degrees, speed, zone});
                    CHECK(execution.acceleration <= kMost);
                    CHECK(execution.fastest <= speed * 1.005);
                    if (degrees == 180)
                        CHECK(execution.slowest <=
                              0.5 * kMost * 12'000 * kSampleSeconds); // at rest between two samples
                }
}

TEST_CASE("a reversal in a zone takes no longer than one at a stop point", "[motion][reversal]") {
    constexpr double kNearly = 1.01; // z1 is nearly a stop point
    for (const double speed : {50.0, 200.0, 1000.0, 5000.0})
        for (const double zone : {1.0, 10.0, 50.0, 150.0}) {
            CAPTURE(speed, zone);
            CHECK(executed({MoveKind::Linear, 180, speed, zone}).seconds <=
                  executed({MoveKind::Linear, 180, speed, zone}, true).seconds * kNearly);
        }
}

TEST_CASE("PathAccLim and WorldAccLim hold where a path turns back on itself", "[motion][reversal]") {
    // 1 m/s^2; the speed exceeds the one that keeps it by a quarter at most.
    const bool isPath = GENERATE(true, false);
    MotionSystem system = largeRobot();
    std::vector<MoveCommand> program = programOf(system, {MoveKind::Linear, 180, 500, 50}, false);
    for (MoveCommand& command : program)
        (isPath ? command.settings.pathAcceleration : command.settings.worldAcceleration) = 1;
    if (isPath)
        for (MoveCommand& command : program)
            command.settings.pathDeceleration = 1;
    const Execution execution = executed(system, program);
    CHECK(execution.tcpAcceleration <= 1000 * 1.25 * 1.25);
    CHECK(execution.tcpAcceleration >= 950);
}

TEST_CASE("the speed of the TCP holds through corners that do not turn back", "[motion][reversal]") {
    // At 50 mm/s no axis is at its limit: the programmed speed holds throughout (motion facts 2: within 0.1 %).
    for (const double degrees : {30.0, 90.0, 145.0}) {
        CAPTURE(degrees);
        const Execution execution = executed({MoveKind::Linear, degrees, 50, 50});
        CHECK(execution.slowest >= 50 * 0.998);
        CHECK(execution.fastest <= 50 * 1.002);
    }
}

TEST_CASE("an axis of the wrist turns back in a zone within its limit", "[motion][reversal]") {
    for (const double degreesPerSecond : {20.0, 100.0, 500.0}) {
        CAPTURE(degreesPerSecond);
        MotionSystem system = largeRobot();
        MoveCommand command;
        command.kind = MoveKind::AbsJoint;
        command.speed.vOri = degreesPerSecond;
        command.speed.vTcp = 1000;
        command.zone = {false, 50, 75, 75, 7.5, 75, 7.5};
        command.joints = system.plannedEnd();
        command.joints.robax[5] += 60;
        std::vector<MoveCommand> program{command};
        command.joints.robax[5] -= 60;
        command.zone.finep = true;
        program.push_back(command);
        CHECK(executed(system, program).acceleration <= 3);
    }
}
