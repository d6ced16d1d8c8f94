// Path modifiers: the arm beside its planned path; corrections in path coordinates.

#include "runtime/motion/motion_system.h"
#include "runtime/motion/path_corrections.h"
#include "runtime/motion/weaving.h"
#include "tests/unit/motion/motion_system_rig.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

using namespace motion_testing;

namespace {

/// Relative to the end of the last movement, in world (the robot is at its origin).
MoveCommand lineBy(const MotionSystem& system, const Vec3& way, double speed = 100) {
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.target = calcRobTarget(system.kinematics(), system.plannedEnd(), command.frames);
    command.target.pose.pos = command.target.pose.pos + way;
    command.speed.vTcp = speed;
    command.confL = false;
    return command;
}

/// Lets time pass in steps of 4 ms, as the driver does, and calls `look` before each.
template <class Look> void run(MotionSystem& system, TimeNs until, Look look) {
    while (system.now() < until) {
        const TimeNs next = (system.now() / kModifierPeriod + 1) * kModifierPeriod;
        system.advanceModifiers(next);
        look(system.sample(next), next);
        system.advanceTo(next);
    }
}
void run(MotionSystem& system, TimeNs until) {
    run(system, until, [](const MotionState&, TimeNs) {});
}

bool isNear(const Vec3& a, const Vec3& b, double mm) {
    return norm(a - b) < mm;
}

/// Moves the work object along x in time, whatever the path does.
class Belt final : public PathModifier {
  public:
    explicit Belt(double speed) : speed_(speed) {}
    bool isActive() const override { return true; }
    bool movesAtRest() const override { return speed_ != 0; }
    Pose displaced(const PlannedMoment& planned, const Pose& tcp) const override {
        return {tcp.pos + Vec3{speed_ * static_cast<double>(planned.time) * 1e-9, 0, 0}, tcp.rot};
    }

  private:
    double speed_;
};

} // namespace

TEST_CASE("corrections displace marked movements in path coordinates", "[motion][modifier]") {
    MotionSystem system = makeSystem();
    const auto corrections = std::make_shared<PathCorrections>();
    system.addModifier(corrections);
    const Vec3 start = system.current().tcp.pos;
    MoveCommand command = lineBy(system, {0, 150, 0});
    command.modifications.push_back(corrections->modification());
    REQUIRE(system.enqueue(command).hasValue());
    run(system, 300 * kMs);
    // The tool of the arm at its start points along world x and down; x of the path is world y.
    const Vec3 z = rotate(system.current().tcp.rot, Vec3{0, 0, 1});
    const Vec3 x{0, 1, 0};
    const Vec3 y = cross(z, x);
    corrections->setOffset({1, 3, -2});
    const Vec3 wanted = x * 1 + y * 3 + cross(x, y) * -2;
    bool wasReached = false;
    double fastest = 0;
    Vec3 last = system.current().tcp.pos;
    run(system, 1200 * kMs, [&](const MotionState& state, TimeNs) {
        const Vec3 offset = state.tcp.pos - start;
        const Vec3 across{offset.x, 0, offset.z};
        fastest = std::max(fastest, norm(state.tcp.pos - last) / 0.004);
        last = state.tcp.pos;
        wasReached = wasReached || isNear(across, {wanted.x, 0, wanted.z}, 1e-6);
        if (wasReached) CHECK(isNear(across, {wanted.x, 0, wanted.z}, 1e-6));
    });
    CHECK(wasReached);
    // 100 mm/s along the path and at most 100 mm/s for the correction.
    CHECK(fastest < 201);
    run(system, 3000 * kMs);
    REQUIRE(system.isIdle());
    // The destination is displaced too, and stays so.
    CHECK(isNear(system.current().tcp.pos, start + Vec3{0, 150, 0} + wanted, 1e-3));
    CHECK(isNear(system.currentTarget({}).pose.pos, start + Vec3{0, 150, 0} + wanted, 1e-3));
}

TEST_CASE("a movement without the mark leads back to its own path", "[motion][modifier]") {
    MotionSystem system = makeSystem();
    const auto corrections = std::make_shared<PathCorrections>();
    system.addModifier(corrections);
    corrections->setOffset({0, 5, 0});
    const Vec3 start = system.current().tcp.pos;
    MoveCommand first = lineBy(system, {0, 100, 0});
    first.modifications.push_back(corrections->modification());
    REQUIRE(system.enqueue(first).hasValue());
    REQUIRE(system.enqueue(lineBy(system, {0, 0, -100})).hasValue());
    double jump = 0;
    Vec3 last = start;
    run(system, 4000 * kMs, [&](const MotionState& state, TimeNs) {
        jump = std::max(jump, norm(state.tcp.pos - last));
        last = state.tcp.pos;
    });
    REQUIRE(system.isIdle());
    CHECK(jump < 0.8);
    CHECK(isNear(last, start + Vec3{0, 100, -100}, 1e-6));
}

TEST_CASE("a displacement turns no faster than it changes where the path turns along the tool",
          "[motion][modifier]") {
    MotionSystem system = makeSystem();
    const auto corrections = std::make_shared<PathCorrections>();
    system.addModifier(corrections);
    corrections->setOffset({0, 3, 2});
    const Vec3 z = rotate(system.current().tcp.rot, Vec3{0, 0, 1});
    for (const Vec3& way : {Vec3{0, 80, 0}, z * -50.0, Vec3{0, -60, 0}}) {
        MoveCommand command = lineBy(system, way, 50);
        command.zone = {way.y < 0, 10, 15, 15, 1.5, 15, 1.5};
        command.modifications.push_back(corrections->modification());
        REQUIRE(system.enqueue(command).hasValue());
    }
    Vec3 before = system.current().tcp.pos;
    double fastest = 0;
    run(system, 6000 * kMs, [&](const MotionState& state, TimeNs) {
        fastest = std::max(fastest, norm(state.tcp.pos - before) / 0.004);
        before = state.tcp.pos;
    });
    CHECK(system.isIdle());
    CHECK(fastest > 50);
    CHECK(fastest < 50 + 100 * 1.05); // along and across
}

TEST_CASE("corrections keep to circles", "[motion][modifier]") {
    MotionSystem system = makeSystem();
    const auto corrections = std::make_shared<PathCorrections>();
    system.addModifier(corrections);
    const Vec3 start = system.current().tcp.pos;
    MoveCommand circle = lineBy(system, {0, 80, 0}, 50);
    circle.kind = MoveKind::Circular;
    circle.circlePoint = circle.target.pose;
    circle.circlePoint.pos = start + Vec3{0, 40, 40};
    circle.modifications.push_back(corrections->modification());
    corrections->setOffset({0, 0, 2}); // x cross y: across the circle for a tool that points along world x
    REQUIRE(system.enqueue(circle).hasValue());
    const Vec3 centre = start + Vec3{0, 40, 0};
    int looked = 0;
    run(system, 4000 * kMs, [&](const MotionState& state, TimeNs time) {
        if (time < 600 * kMs) return;
        // Radius and height together: the offset is perpendicular to the tangent, so both add up exactly.
        const Vec3 from = state.tcp.pos - centre;
        const double radius = std::hypot(from.y, from.z);
        CHECK(std::hypot(radius - 40, from.x) == Approx(2).margin(2e-3));
        ++looked;
    });
    CHECK(looked > 100);
}

TEST_CASE("stopping on the path keeps the displacement, clearing the path begins again",
          "[motion][modifier]") {
    MotionSystem system = makeSystem();
    const auto corrections = std::make_shared<PathCorrections>();
    system.addModifier(corrections);
    corrections->setOffset({0, 4, 0});
    MoveCommand command = lineBy(system, {0, 150, 0}, 50);
    command.modifications.push_back(corrections->modification());
    REQUIRE(system.enqueue(command).hasValue());
    run(system, 900 * kMs);
    system.stop();
    run(system, 1500 * kMs);
    REQUIRE_FALSE(system.isMoving());
    const Vec3 stopped = system.current().tcp.pos;
    corrections->setOffset({0, -4, 0}); // while the arm is at rest nothing happens
    run(system, 2000 * kMs);
    CHECK(isNear(system.current().tcp.pos, stopped, 1e-9));
    SECTION("cleared") {
        system.clear();
        run(system, 2100 * kMs);
        CHECK(isNear(system.current().tcp.pos, stopped, 1e-6));
        system.start();
        MoveCommand back = lineBy(system, {0, 0, -50});
        REQUIRE(system.enqueue(back).hasValue());
        run(system, 4000 * kMs);
        CHECK(isNear(system.current().tcp.pos, stopped + Vec3{0, 0, -50}, 1e-6));
    }
    SECTION("put aside and taken back") {
        REQUIRE(system.storePath());
        REQUIRE(system.enqueue(lineBy(system, {0, 0, -20})).hasValue());
        run(system, 3000 * kMs);
        CHECK(isNear(system.current().tcp.pos, stopped + Vec3{0, 0, -20}, 1e-6));
        REQUIRE(system.restorePath());
        double jump = 0;
        Vec3 last = system.current().tcp.pos;
        system.start();
        run(system, 9000 * kMs, [&](const MotionState& state, TimeNs) {
            jump = std::max(jump, norm(state.tcp.pos - last));
            last = state.tcp.pos;
        });
        CHECK(system.isIdle());
        CHECK(jump < 1.1); // 250 mm/s on the way back to the path
    }
    SECTION("motors off") {
        system.start();
        run(system, 2400 * kMs);
        system.halt();
        run(system, 3000 * kMs);
        Vec3 last = system.current().tcp.pos;
        double jump = 0;
        system.start();
        run(system, 9000 * kMs, [&](const MotionState& state, TimeNs) {
            jump = std::max(jump, norm(state.tcp.pos - last));
            last = state.tcp.pos;
        });
        CHECK(system.isIdle());
        CHECK(jump < 1.1);
    }
}

TEST_CASE("a modifier of time moves an arm whose path is at rest", "[motion][modifier]") {
    MotionSystem system = makeSystem();
    system.addModifier(std::make_shared<Belt>(20));
    REQUIRE(system.enqueue(lineBy(system, {0, 50, 0})).hasValue());
    run(system, 2000 * kMs);
    CHECK(system.isIdle());
    CHECK(system.isMoving());
    const MotionState state = system.current();
    CHECK(state.moving);
    CHECK(state.tcp.pos.x - system.sample(system.now() - 100).tcp.pos.x < 1e-3);
}

TEST_CASE("a displacement out of reach stops the arm on its path", "[motion][modifier]") {
    MotionSystem system = makeSystem();
    system.addModifier(std::make_shared<Belt>(400));
    REQUIRE(system.enqueue(lineBy(system, {0, 150, 0}, 20)).hasValue());
    bool happened = false;
    for (int i = 0; i < 1000; ++i) {
        run(system, system.now() + 4 * kMs);
        for (const MotionEvent& event : system.takeEvents())
            happened = happened || event.kind == MotionEventKind::OutOfReach;
    }
    CHECK(happened);
    REQUIRE(system.outOfReachError());
    CHECK_FALSE(system.outOfReachError()->message().empty());
    CHECK(system.isStopRequested());
    CHECK_FALSE(system.isIdle());
}

TEST_CASE("an arm led from outside moves", "[motion][modifier]") {
    MotionSystem system = makeSystem();
    JointTarget joints = system.currentJoints();
    const JointTarget fast{{10, 0, 0, 0, 0, 0}, kNoExternalAxes};
    const JointTarget still{{0, 0, 0, 0, 0, 0}, kNoExternalAxes};
    for (int i = 0; i < 10; ++i) {
        joints.robax[0] += 0.04;
        REQUIRE(system.leadTo(joints, fast, 4 * kMs));
        CHECK(system.isMoving());
        CHECK(system.current().jointSpeed[0] == Approx(10));
        system.advanceTo(system.now() + 4 * kMs);
    }
    REQUIRE(system.leadTo(joints, still, 4 * kMs));
    CHECK_FALSE(system.isMoving());
    system.advanceTo(system.now() + 10 * kMs);
    int rests = 0;
    for (const MotionEvent& event : system.takeEvents())
        rests += event.kind == MotionEventKind::AtRest ? 1 : 0;
    CHECK(rests >= 1);
    CHECK(system.currentJoints().robax[0] == Approx(0.4));
}

TEST_CASE("the TCP that is shown is that of the latest tool, even without a path", "[motion][modifier]") {
    MotionSystem system = makeSystem();
    MoveCommand command = lineBy(system, {0, 20, 0});
    command.frames.tool.tframe.pos = {0, 0, 100};
    command.target = system.currentTarget(command.frames);
    command.target.pose.pos.y += 20;
    REQUIRE(system.enqueue(command).hasValue());
    run(system, 2000 * kMs);
    REQUIRE(system.isIdle());
    const Vec3 tip = system.current().tcp.pos;
    const JointTarget still{{0, 0, 0, 0, 0, 0}, kNoExternalAxes};
    for (int i = 0; i < 3; ++i)
        REQUIRE(system.leadTo(system.currentJoints(), still, 4 * kMs));
    CHECK(isNear(system.current().tcp.pos, tip, 1e-6));
    system.clear();
    CHECK(isNear(system.current().tcp.pos, tip, 1e-6));
}

TEST_CASE("weaving is the same on the path whatever stops and slows the arm", "[motion][modifier]") {
    const auto weavedPath = [](bool isDisturbed) {
        MotionSystem system = makeSystem();
        const auto weaving = std::make_shared<Weaving>();
        system.addModifier(weaving);
        weaving->setOn(true);
        const auto weave = std::make_shared<Weave>();
        weave->pattern.shape = WeaveShape::Zigzag;
        weave->pattern.length = 20;
        weave->pattern.width = 8;
        weave->isLast = true;
        MoveCommand command = lineBy(system, {0, 150, 0}, 50);
        command.modifications.push_back(weave);
        REQUIRE(system.enqueue(command).hasValue());
        std::vector<Vec3> path;
        const auto record = [&](const MotionState& state, TimeNs) { path.push_back(state.tcp.pos); };
        if (isDisturbed) {
            run(system, 1000 * kMs, record);
            system.setOverride(40);
            run(system, 1500 * kMs, record);
            system.stop();
            run(system, 2000 * kMs, record);
            REQUIRE(system.stepBack(10, 20));
            run(system, 3500 * kMs, record);
            system.start();
        }
        run(system, 12000 * kMs, record);
        REQUIRE(system.isIdle());
        return path;
    };
    const std::vector<Vec3> smooth = weavedPath(false);
    for (const Vec3& place : weavedPath(true)) {
        const auto after = std::lower_bound(smooth.begin(), smooth.end(), place.y,
                                            [](const Vec3& at, double y) { return at.y < y; });
        if (after == smooth.begin() || after == smooth.end()) continue;
        const Vec3 before = *(after - 1);
        const double way = after->y - before.y;
        const double share = way > 0 ? (place.y - before.y) / way : 0;
        CHECK(isNear(place, before + (*after - before) * share, 0.1)); // a corner between two samples
    }
}

TEST_CASE("a weaving pattern turns within 10 m/s^2 and keeps its sides", "[motion][modifier]") {
    const double speed = 20; // mm/s
    for (const WeaveShape shape : {WeaveShape::Zigzag, WeaveShape::Vee, WeaveShape::Triangle}) {
        WeavePattern sharp;
        sharp.shape = shape;
        sharp.length = 8;
        sharp.width = 6;
        sharp.height = 2;
        sharp.dwellLeft = 1;
        sharp.direction = 20;
        WeavePattern rounded = sharp;
        rounded.roundFor(speed);
        const double step = rounded.rounding / 20; // mm of path
        REQUIRE(step > 0);
        double most = 0;
        for (double s = 0; s < 2 * sharp.length; s += step) {
            const auto at = [&](double mm) { return rounded.at(mm / sharp.length); };
            const Vec3 bend = (at(s + step) - at(s) * 2 + at(s - step)) * (speed * speed / (step * step));
            most = std::max(most, norm(bend));
            // A point of a V with sides of 2.1 mm a mm of path is moved by a quarter of that and of the rounding.
            CHECK(norm(rounded.at(s / sharp.length) - sharp.at(s / sharp.length)) < 0.55 * rounded.rounding);
        }
        CHECK(most <= 10'000 * 1.001);
        CHECK(most > 4'000); // a turn back from side to side takes all of it, others take half
        // In the middle of a side nothing is rounded.
        const double middle = (1 - 0.5 / 8) * sharp.length;
        CHECK(isNear(rounded.at(middle / sharp.length), sharp.at(middle / sharp.length), 1e-9));
    }
}

TEST_CASE("a stationary tool: the work object moves so that the TCP is displaced in it",
          "[motion][modifier]") {
    MotionSystem system = makeSystem();
    const auto corrections = std::make_shared<PathCorrections>();
    system.addModifier(corrections);
    corrections->setOffset({0, 3, 0});
    FrameSetup frames;
    frames.tool = {false, {{350, 0, 600}, {1, 0, 0, 0}}}; // in world, its z axis up
    frames.workObject.robotHeld = true;
    MoveCommand command;
    command.kind = MoveKind::Linear;
    command.frames = frames;
    command.target = system.currentTarget(frames);
    const Pose begin = command.target.pose;
    const Vec3 way{0, 60, 0};
    command.target.pose.pos = begin.pos + way;
    command.speed.vTcp = 50;
    command.confL = false;
    command.modifications.push_back(corrections->modification());
    REQUIRE(system.enqueue(command).hasValue());
    run(system, 3000 * kMs);
    REQUIRE(system.isIdle());
    const Vec3 x{0, 1, 0};
    const Vec3 y = cross(rotate(begin.rot, Vec3{0, 0, 1}), x);
    const Vec3 wanted = begin.pos + way + y * (3 / norm(y));
    CHECK(isNear(system.currentTarget(frames).pose.pos, wanted, 1e-3));
    CHECK(isNear(system.current().tcp.pos, {350, 0, 600}, 1e-9));
}

TEST_CASE("a robot that moves together with another one is displaced alone", "[motion][modifier]") {
    MotionSystem first = makeSystem();
    MotionSystem second = makeSystem();
    const std::vector<MotionSystem*> both{&first, &second};
    REQUIRE(MotionSystem::beginTogether(both));
    const auto corrections = std::make_shared<PathCorrections>();
    second.addModifier(corrections);
    corrections->setOffset({0, 0, 4});
    const Vec3 start = first.current().tcp.pos;
    MoveCommand a = lineBy(first, {0, 100, 0});
    MoveCommand b = lineBy(second, {0, 100, 0});
    b.modifications.push_back(corrections->modification());
    REQUIRE(MotionSystem::enqueueTogether(both, {a, b}).hasValue());
    for (TimeNs time = kModifierPeriod; time < 3000 * kMs; time += kModifierPeriod)
        for (MotionSystem* system : both)
            system->advanceTo(time);
    REQUIRE(second.isIdle());
    CHECK(isNear(first.current().tcp.pos, start + Vec3{0, 100, 0}, 1e-3));
    CHECK(norm(second.current().tcp.pos - start - Vec3{0, 100, 0}) == Approx(4).margin(1e-3));
}
