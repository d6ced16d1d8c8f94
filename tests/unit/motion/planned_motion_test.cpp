// Invariants of timed moves, checked on random moves of several arms: finite, exact ends, no limit exceeded
// anywhere, on the programmed path. Limits are checked on differences of sampled axis angles, not on what the
// planner believes.

#include "runtime/motion/planned_motion.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>

using namespace motion;
using robot::angleBetween;

namespace {

robot::RobotModel modelOf(const char* name) {
    auto model = robot::loadRobotModel(name);
    REQUIRE(model.hasValue());
    return *model;
}

/// Number of random cases: RAPIDC_TEST_CASES multiplies it and changes the seeds, for long runs.
int factor() {
    const char* text = std::getenv("RAPIDC_TEST_CASES");
    return text == nullptr ? 1 : std::max(1, std::atoi(text));
}

class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed + 1000U * static_cast<unsigned>(factor() - 1)) {}
    double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    Joints posture(const robot::RobotModel& model, double share) {
        Joints joints;
        for (std::size_t i = 0; i < joints.size(); ++i) {
            joints[i] = share * in(std::max(model.lowerDeg[i], -170.0), std::min(model.upperDeg[i], 170.0));
        }
        joints[4] += joints[4] < 0 ? -20 : 20; // not right at the singularity
        return joints;
    }

  private:
    std::mt19937_64 engine_;
};

struct Excess {
    double speed = 0, acceleration = 0; // largest share of the limit used by an axis
    double tcp = 0;                     // mm/s
    double turn = 0;                    // deg/s
    double tcpReported = 0;             // largest difference of reported and measured TCP speed, mm/s
    bool isFinite = true;
};

/// Differences over 1 ms; central, so that a limit that is met exactly shows as 1.
Excess measure(const PlannedMotion& motion, const robot::RobotModel& model) {
    Excess excess;
    constexpr double kStep = 1e-3;
    const robot::Kinematics kinematics(model);
    const FrameSetup& frames = motion.path().frames();
    const auto objectTcp = [&](const Joints& joints) {
        return frames.fromFlange(kinematics.forward(joints));
    };
    const int samples = static_cast<int>(std::min(20000.0, motion.duration() / kStep)) + 2;
    Joints before = motion.sample(-kStep).joints;
    Joints here = motion.sample(0).joints;
    for (int i = 0; i <= samples; ++i) {
        const MotionState state = motion.sample((i + 1) * kStep);
        const Joints& after = state.joints;
        for (std::size_t k = 0; k < here.size(); ++k) {
            excess.isFinite = excess.isFinite && std::isfinite(after[k]);
            excess.speed = std::max(excess.speed, std::fabs(after[k] - here[k]) / kStep / model.maxSpeed[k]);
            excess.acceleration =
                std::max(excess.acceleration, std::fabs(after[k] - 2 * here[k] + before[k]) / kStep / kStep /
                                                  model.maxAcceleration[k]);
        }
        const Pose a = objectTcp(before);
        const Pose b = objectTcp(here);
        const Pose c = objectTcp(after);
        excess.tcp = std::max(excess.tcp, norm(c.pos - b.pos) / kStep);
        excess.turn = std::max(excess.turn, angleBetween(b.rot, c.rot) / kStep);
        const double measured = norm(c.pos - a.pos) / (2 * kStep);
        excess.tcpReported =
            std::max(excess.tcpReported, std::fabs(measured - motion.sample(i * kStep).tcpSpeed));
        before = here;
        here = after;
    }
    return excess;
}

void checkEnds(const PlannedMotion& motion) {
    CHECK(motion.sample(0).joints == motion.path().start().robax);
    CHECK(motion.sample(motion.duration()).joints == motion.path().end().robax);
    CHECK(motion.sample(motion.duration() + 5).joints == motion.path().end().robax);
    CHECK(motion.sample(motion.duration()).tcpSpeed == 0);
    CHECK(std::isfinite(motion.duration()));
    CHECK(motion.duration() > 0);
}

void checkLimits(const PlannedMotion& motion, const robot::RobotModel& model, const MoveCommand& command) {
    const Excess excess = measure(motion, model);
    CHECK(excess.isFinite);
    CHECK(excess.speed <= 1 + 1e-6);
    CHECK(excess.acceleration <= 1 + 1e-4); // differences of 1e-13 deg over a square millisecond
    if (command.duration == 0) {
        CHECK(excess.tcp <= command.speed.vTcp * (1 + 1e-6) + 1e-6);
        CHECK(excess.turn <= command.speed.vOri * (1 + 1e-6) + 1e-3);
    }
}

MoveCommand withSpeed(MoveCommand command, double vTcp) {
    command.speed.vTcp = vTcp;
    return command;
}

} // namespace

TEST_CASE("joint moves keep every limit and arrive together", "[motion][invariants]") {
    Random random(1);
    for (const char* name : {"IRB 120-3/0.58", "IRB 2600-12/1.65", "IRB 7600-150/3.5"}) {
        const robot::RobotModel model = modelOf(name);
        const robot::Kinematics kinematics(model);
        for (int n = 0; n < 40 * factor(); ++n) {
            MoveCommand command = withSpeed({}, n % 4 == 0 ? 100 : n % 4 == 1 ? 7000 : random.in(20, 2500));
            const JointTarget start{random.posture(model, 0.7), kNoExternalAxes};
            command.joints.robax = random.posture(model, 0.7);
            CAPTURE(name, n, command.speed.vTcp);
            auto path = MotionPath::make(kinematics, start, command);
            REQUIRE(path.hasValue());
            const PlannedMotion motion = PlannedMotion::plan(*path, model, {}, command);
            checkEnds(motion);
            checkLimits(motion, model, command);
            // All axes have done the same share of their way at any time.
            const Joints half = motion.sample(0.4 * motion.duration()).joints;
            const double share = motion.sample(0.4 * motion.duration()).pathFraction;
            for (std::size_t i = 0; i < 6; ++i) {
                const double expected = start.robax[i] + share * (command.joints.robax[i] - start.robax[i]);
                CHECK(half[i] == Approx(expected).margin(1e-9));
            }
        }
    }
}

TEST_CASE("a joint move at full speed is limited by the slowest axis", "[motion][invariants]") {
    const robot::RobotModel model = modelOf("IRB 120-3/0.58");
    MoveCommand command = withSpeed({}, 1e6);
    command.speed.vOri = 1e6;
    command.joints.robax = {150, 20, 0, 0, 30, 0};
    auto path = MotionPath::make(robot::Kinematics(model), {{0, 0, 0, 0, 30, 0}, kNoExternalAxes}, command);
    REQUIRE(path.hasValue());
    const PlannedMotion motion = PlannedMotion::plan(*path, model, {}, command);
    CHECK(motion.limiter() == Limiter::JointSpeed);
    CHECK(motion.limitingAxis() == 1);
    // way/v + v/a + a/j with 1 % kept in reserve.
    const double v = 0.99 * 250;
    const double a = 0.99 * 1000;
    const double j = 0.99 * 20000;
    CHECK(motion.duration() == Approx(150 / v + v / a + a / j).epsilon(1e-9));
}

TEST_CASE("lines keep every limit and the line", "[motion][invariants]") {
    Random random(2);
    int planned = 0;
    for (const char* name : {"IRB 120-3/0.58", "IRB 2600-12/1.65", "IRB 6700-150/3.2"}) {
        const robot::RobotModel model = modelOf(name);
        const robot::Kinematics kinematics(model);
        for (int n = 0; n < 60 * factor(); ++n) {
            MoveCommand command = withSpeed({}, n % 3 == 0 ? 5000 : random.in(20, 2000));
            command.kind = MoveKind::Linear;
            command.confL = false;
            command.frames.tool.tframe = {{random.in(-50, 50), 0, random.in(0, 200)}, {}};
            const JointTarget start{random.posture(model, 0.5), kNoExternalAxes};
            Joints other = start.robax;
            for (double& angle : other)
                angle += random.in(-35, 35);
            command.target = calcRobTarget(kinematics, {other, kNoExternalAxes}, command.frames);
            auto path = MotionPath::make(kinematics, start, command);
            if (!path) continue; // out of range or through a singularity: refused, which other tests look at
            ++planned;
            CAPTURE(name, n, command.speed.vTcp);
            const PlannedMotion motion = PlannedMotion::plan(*path, model, {}, command);
            checkEnds(motion);
            checkLimits(motion, model, command);
            const Pose from = command.frames.fromFlange(kinematics.forward(start.robax));
            const Vec3 way = command.target.pose.pos - from.pos;
            const double whole = angleBetween(from.rot, command.target.pose.rot);
            double last = 0;
            for (int i = 0; i <= 100; ++i) {
                const MotionState state = motion.sample(motion.duration() * i / 100);
                const Pose tcp = command.frames.fromFlange(kinematics.forward(state.joints));
                const double share = dot(tcp.pos - from.pos, way) / dot(way, way);
                CHECK(share >= last - 1e-9);
                last = share;
                CHECK(norm(tcp.pos - (from.pos + way * share)) < 1e-6);
                CHECK(angleBetween(from.rot, tcp.rot) == Approx(share * whole).margin(1e-5));
                CHECK(norm(state.tcp.pos - tcp.pos) < 1e-9); // world is the object frame here
            }
        }
    }
    CHECK(planned > 80);
}

TEST_CASE("a line in the open runs at the programmed speed", "[motion][invariants]") {
    const robot::RobotModel model = modelOf("IRB 120-3/0.58");
    const robot::Kinematics kinematics(model);
    const JointTarget start{{0, 20, 10, 0, 60, 0}, kNoExternalAxes};
    for (double speed : {50.0, 200.0, 500.0}) {
        MoveCommand command = withSpeed({}, speed);
        command.kind = MoveKind::Linear;
        command.target = calcRobTarget(kinematics, start, command.frames);
        command.target.pose = robot::offs(command.target.pose, -80, 120, -40);
        command.confL = false;
        auto path = MotionPath::make(kinematics, start, command);
        REQUIRE(path.hasValue());
        const PlannedMotion motion = PlannedMotion::plan(*path, model, {}, command);
        CHECK(motion.limiter() == Limiter::TcpSpeed);
        CHECK(motion.sample(motion.duration() / 2).tcpSpeed == Approx(speed).epsilon(1e-6));
        CHECK(motion.duration() > path->length() / speed);
        CHECK(motion.duration() < path->length() / speed + 0.6);
        CHECK(motion.sample(motion.timeAtDistance(30)).pathFraction ==
              Approx(30 / path->length()).epsilon(1e-6));
        CHECK(measure(motion, model).tcpReported < 0.02 * speed);
    }
}

TEST_CASE("arcs keep every limit and the circle", "[motion][invariants]") {
    Random random(3);
    const robot::RobotModel model = modelOf("IRB 2600-12/1.65");
    const robot::Kinematics kinematics(model);
    int planned = 0;
    for (int n = 0; n < 160 * factor(); ++n) {
        MoveCommand command = withSpeed({}, n % 3 == 0 ? 5000 : random.in(20, 1500));
        command.kind = MoveKind::Circular;
        command.confL = false;
        const JointTarget start{{random.in(-60, 60), random.in(0, 30), random.in(-20, 20), random.in(-30, 30),
                                 random.in(30, 70), random.in(-90, 90)},
                                kNoExternalAxes};
        const Pose from = kinematics.forward(start.robax);
        command.circlePoint =
            robot::offs(from, random.in(-150, 150), random.in(-150, 150), random.in(-150, 150));
        command.target.pose =
            robot::offs(from, random.in(-150, 150), random.in(-150, 150), random.in(-150, 150));
        auto path = MotionPath::make(kinematics, start, command);
        if (!path) continue;
        ++planned;
        CAPTURE(n, command.speed.vTcp);
        const PlannedMotion motion = PlannedMotion::plan(*path, model, {}, command);
        checkEnds(motion);
        checkLimits(motion, model, command);
        const CartesianCurve& arc = path->curve();
        for (int i = 0; i <= 100; ++i) {
            const Pose tcp = kinematics.forward(motion.sample(motion.duration() * i / 100).joints);
            CHECK(norm(tcp.pos - arc.centre()) == Approx(arc.radius()).margin(1e-6));
            CHECK(std::fabs(dot(tcp.pos - arc.centre(), arc.axis())) < 1e-6);
        }
        const double there = path->parameterAtDistance(0.5 * path->length());
        CHECK(there == Approx(0.5));
    }
    CHECK(planned > 30);
}

TEST_CASE("near the wrist singularity the move slows down there and only there", "[motion][invariants]") {
    const robot::RobotModel model = modelOf("IRB 120-3/0.58");
    const robot::Kinematics kinematics(model);
    // Sideways past the stretched wrist, a few degrees away from it: axis 4 has to turn fast in the middle.
    const JointTarget start{{-25, 0, 0, 80, 25, -80}, kNoExternalAxes};
    MoveCommand command = withSpeed({}, 600);
    command.kind = MoveKind::Linear;
    command.confL = false;
    const Pose here = kinematics.forward(start.robax);
    command.target.pose = {{here.pos.x, -here.pos.y, here.pos.z}, here.rot};
    command.target.pose.rot =
        robot::normalized({here.rot.w, -here.rot.x, here.rot.y, -here.rot.z}); // mirrored
    auto path = MotionPath::make(kinematics, start, command);
    REQUIRE(path.hasValue());
    const PlannedMotion motion = PlannedMotion::plan(*path, model, {}, command);
    checkLimits(motion, model, command);
    checkEnds(motion);
    double slowest = 1e9;
    double fastest = 0;
    for (int i = 20; i <= 80; ++i) {
        const double speed = motion.sample(motion.duration() * i / 100).tcpSpeed;
        slowest = std::min(slowest, speed);
        fastest = std::max(fastest, speed);
    }
    CHECK(slowest > 0);
    CHECK(fastest <= 600 * (1 + 1e-9));
}

TEST_CASE("a programmed time is met or the limits decide", "[motion][invariants]") {
    const robot::RobotModel model = modelOf("IRB 120-3/0.58");
    const robot::Kinematics kinematics(model);
    MoveCommand command;
    command.joints.robax = {60, 20, 0, 0, 30, 90};
    command.speed.vTcp = 5; // replaced by the time
    for (double duration : {0.05, 1.0, 4.0, 30.0}) {
        command.duration = duration;
        auto path = MotionPath::make(kinematics, {{0, 0, 0, 0, 30, 0}, kNoExternalAxes}, command);
        REQUIRE(path.hasValue());
        const PlannedMotion motion = PlannedMotion::plan(*path, model, {}, command);
        checkLimits(motion, model, command);
        if (duration >= 1) {
            CHECK(motion.duration() == Approx(duration).epsilon(1e-9));
            CHECK(motion.limiter() == Limiter::Duration);
        } else {
            CHECK(motion.duration() > duration);
        }
    }
}

TEST_CASE("settings of the program slow moves down", "[motion][settings]") {
    const robot::RobotModel model = modelOf("IRB 120-3/0.58");
    const robot::Kinematics kinematics(model);
    const JointTarget start{{0, 20, 10, 0, 60, 0}, kNoExternalAxes};
    MoveCommand command = withSpeed({}, 400);
    command.kind = MoveKind::Linear;
    command.confL = false;
    command.target = calcRobTarget(kinematics, start, command.frames);
    command.target.pose = robot::offs(command.target.pose, -120, 150, -50);
    const auto plan = [&] {
        auto path = MotionPath::make(kinematics, start, command);
        REQUIRE(path.hasValue());
        return PlannedMotion::plan(*path, model, {}, command);
    };
    const auto highestSpeed = [](const PlannedMotion& motion) {
        double speed = 0;
        for (int i = 0; i <= 1000; ++i)
            speed = std::max(speed, motion.sample(motion.duration() * i / 1000).tcpSpeed);
        return speed;
    };
    const PlannedMotion normal = plan();
    CHECK(highestSpeed(normal) == Approx(400).epsilon(1e-6));

    command.settings.velocityPercent = 50;
    CHECK(highestSpeed(plan()) == Approx(200).epsilon(1e-6));
    command.settings = {};
    command.settings.maxTcpSpeed = 150;
    CHECK(highestSpeed(plan()) == Approx(150).epsilon(1e-6));

    command.settings = {};
    command.settings.accelerationPercent = 30;
    const PlannedMotion gentle = plan();
    CHECK(gentle.duration() > normal.duration());
    robot::RobotModel gentleModel = model;
    for (double& acceleration : gentleModel.maxAcceleration)
        acceleration *= 0.3;
    CHECK(measure(gentle, gentleModel).acceleration <= 1 + 1e-3);
    CHECK(measure(gentle, gentleModel).acceleration > 0.6);
    command.settings.accelerationPercent = 20;
    const double lowest = plan().duration();
    CHECK(lowest > gentle.duration());
    command.settings.accelerationPercent = 5; // acts as 20
    CHECK(plan().duration() == lowest);
    command.settings = {};
    command.settings.rampPercent = 10;
    CHECK(plan().limits().jerk == Approx(0.1 * normal.limits().jerk).epsilon(0.2));

    command.settings = {};
    command.settings.pathAcceleration = 0.5;
    command.settings.pathDeceleration = 0.25;
    const PlannedMotion limited = plan();
    constexpr double kStep = 1e-3;
    double rise = 0;
    double fall = 0;
    for (double t = kStep; t < limited.duration(); t += kStep) {
        const double change = (limited.sample(t).tcpSpeed - limited.sample(t - kStep).tcpSpeed) / kStep;
        rise = std::max(rise, change);
        fall = std::max(fall, -change);
    }
    CHECK(rise <= 500 * (1 + 1e-6));
    CHECK(fall <= 250 * (1 + 1e-6));
    CHECK(rise > 450);
    CHECK(fall > 225);
}

TEST_CASE("reorientation and external axes set the pace where they need longer", "[motion][invariants]") {
    const robot::RobotModel model = modelOf("IRB 120-3/0.58");
    const robot::Kinematics kinematics(model);
    JointTarget start{{0, 20, 10, 0, 60, 0}, kNoExternalAxes};
    start.extax[0] = 0;
    ExternalAxisModels external;
    external[0] = {true, false, -1000, 1000, 200, 1000, 10000};
    MoveCommand command = withSpeed({}, 1000);
    command.kind = MoveKind::Linear;
    command.confL = false;
    command.target = calcRobTarget(kinematics, start, command.frames);
    command.target.pose = robot::relTool(command.target.pose, 1, 0, 0, 0, 0, 60);
    command.speed.vOri = 45;
    auto turning = MotionPath::make(kinematics, start, command);
    REQUIRE(turning.hasValue());
    const PlannedMotion turn = PlannedMotion::plan(*turning, model, external, command);
    CHECK(turn.limiter() == Limiter::OrientationSpeed);
    CHECK(turn.duration() > 60.0 / 45);
    CHECK(measure(turn, model).turn <= 45 * (1 + 1e-6));

    command.speed.vOri = 500;
    command.target.extax[0] = 600;
    auto sliding = MotionPath::make(kinematics, start, command);
    REQUIRE(sliding.hasValue());
    const PlannedMotion slide = PlannedMotion::plan(*sliding, model, external, command);
    CHECK(slide.limiter() == Limiter::ExternalSpeed);
    CHECK(slide.limitingAxis() == 7);
    CHECK(slide.duration() > 600.0 / 200);
    CHECK(slide.sample(slide.duration()).extax[0] == 600);
    double last = 0;
    for (double t = 1e-3; t < slide.duration(); t += 1e-3) {
        const double at = slide.sample(t).extax[0];
        CHECK((at - last) / 1e-3 <= 200 * (1 + 1e-6));
        last = at;
    }
}

TEST_CASE("a move to where the arm stands takes no time", "[motion][invariants]") {
    const robot::RobotModel model = modelOf("IRB 120-3/0.58");
    const robot::Kinematics kinematics(model);
    const JointTarget start{{0, 0, 0, 0, 30, 0}, kNoExternalAxes};
    MoveCommand command;
    command.joints = start;
    auto path = MotionPath::make(kinematics, start, command);
    REQUIRE(path.hasValue());
    CHECK(PlannedMotion::plan(*path, model, {}, command).duration() == 0);
    CHECK(PlannedMotion::plan(*path, model, {}, command).sample(1).joints == start.robax);
    command.kind = MoveKind::Linear;
    command.target = calcRobTarget(kinematics, start, command.frames);
    path = MotionPath::make(kinematics, start, command);
    REQUIRE(path.hasValue());
    CHECK(PlannedMotion::plan(*path, model, {}, command).duration() < 1e-3);
    command.duration = 2; // a time given is taken even without a way
    command.kind = MoveKind::AbsJoint;
    path = MotionPath::make(kinematics, start, command);
    CHECK(PlannedMotion::plan(*path, model, {}, command).duration() == 2);
}
