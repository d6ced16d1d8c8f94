#include "runtime/report/analysis.h"
#include "runtime/report/comparison.h"
#include "runtime/report/move_text.h"
#include "runtime/report/page.h"
#include "runtime/report/path_picture.h"
#include "runtime/report/summary.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace rt::report;

namespace {

constexpr double kStep = 0.004; // s between samples

/// A robot with round limits: 100 deg/s and 500 deg/s^2 on each axis.
robot::RobotModel simpleRobot() {
    robot::RobotModel model;
    model.name = "simple";
    model.kinematics = robot::KinematicsKind::SphericalWrist;
    model.geometry = {0, 0, 0, 290, 270, 302, 72, {0, 0, -90, 0, 0, 0}};
    model.maxSpeed = {100, 100, 100, 100, 100, 100};
    for (robot::AccelerationLimit& limit : model.dynamics.axes)
        limit.cap = 500 * M_PI / 180;
    model.maxTcpSpeed = 2000;
    return model;
}

Move moveNumber(uint64_t number, double speed) {
    Move move;
    move.number = number;
    move.kind = motion::MoveKind::Linear;
    move.speed = speed;
    move.turnSpeed = 500;
    move.place = {"Cell", "main", "", static_cast<uint32_t>(10 + number), 5};
    return move;
}

/// Adds `seconds` of motion along x, with the TCP speed and the angle of axis 1 as functions of the time since its start.
void addMotion(RobotRecord& record, uint64_t number, double seconds,
               const std::function<double(double)>& speed, const std::function<double(double)>& axis1) {
    if (record.samples.empty()) record.samples.emplace_back();
    const Sample before = record.samples.back();
    Sample sample = before;
    const int steps = static_cast<int>(std::lround(seconds / kStep));
    for (int i = 1; i <= steps; ++i) {
        const double t = i * kStep;
        sample.time = before.time + t;
        sample.position.x += (speed(t) + speed(t - kStep)) / 2 * kStep;
        sample.speed = speed(t);
        sample.joints[0] = before.joints[0] + axis1(t);
        sample.move = number;
        record.samples.push_back(sample);
    }
    record.end = sample.time;
}

void addStanding(RobotRecord& record, double seconds) {
    Sample sample = record.samples.back();
    sample.speed = 0;
    sample.time += kStep;
    record.samples.push_back(sample);
    sample.time += seconds - kStep;
    record.samples.push_back(sample);
    record.end = sample.time;
}

/// 0 to `top` within 0.1 s, and back at the end.
std::function<double(double)> ramped(double top, double seconds) {
    return [=](double t) { return top * std::clamp(std::min(t, seconds - t) / 0.1, 0.0, 1.0); };
}

std::function<double(double)> slowly() {
    return [](double t) { return 10 * t; }; // deg: far from any limit
}

double lostTo(const MoveResult& result, Cause cause, int axis = 0) {
    for (const Loss& loss : result.losses)
        if (loss.cause == cause && loss.axis == axis) return loss.seconds;
    return 0;
}

/// A path of three lines (x, y, x) with a stop of 0.5 s after the first, 100 mm/s.
RobotRecord angledRun() {
    RobotRecord record;
    record.robot = simpleRobot();
    record.samples.emplace_back();
    for (uint64_t number : {1, 2, 3}) {
        record.moves.push_back(moveNumber(number, 100));
        Sample sample = record.samples.back();
        for (int i = 1; i <= 250; ++i) {
            sample.time += kStep;
            (number == 2 ? sample.position.y : sample.position.x) += 0.4;
            sample.joints[0] += 0.04;
            sample.speed = 100;
            sample.move = number;
            record.samples.push_back(sample);
        }
        if (number == 1) addStanding(record, 0.5);
    }
    addStanding(record, 0.2);
    return record;
}

/// The run as a recording, each sample changed by `change`.
Recording recordingOf(const RobotRecord& record,
                      const std::function<void(RecordedSample&, const Sample&)>& change) {
    Recording recording;
    recording.file = "rec.csv";
    recording.hasPositions = true;
    for (const Sample& sample : record.samples) {
        RecordedSample copy{sample.time, sample.position, sample.joints};
        change(copy, sample);
        recording.samples.push_back(copy);
    }
    return recording;
}

std::string problemOf(const std::string& text) {
    std::vector<Recording> recordings;
    return parseRecording(text, "r.csv", recordings);
}

RunRecord runOf(const RobotRecord& robot) {
    RunRecord run;
    run.robots.push_back(robot);
    return run;
}

} // namespace

// ---- Text of instructions (rule: the target is the last point; arguments that begin with \ are optional) --------------

TEST_CASE("the target of a movement is read from its source", "[report]") {
    const auto at = [](const std::string& text) { return moveTextAt(text, 1, 1); };
    CHECK(at("MoveL p10, v100, fine, tool0;").target == "p10");
    CHECK(at("MoveL p10, v100, fine, tool0;").isName);
    CHECK(at("MoveJ \\Conc, p20, v100\\T:=2, z10, tool0;").target == "p20");
    CHECK(at("MoveC via, goal, v100, z10, tool0;").target == "goal");
    CHECK(at("SearchL \\Stop, di1\\Flanks, found, p30, v100, tool0;").target == "p30");
    CHECK(at("SearchC di1, found, via, p40, v100, tool0;").target == "p40");
    CHECK(at("TriggC via, p50, v100, t1, z10, tool0;").target == "p50");
    CHECK(at("movel points{2}.p, v100, fine, tool0;").target == "points{2}.p");
    CHECK(at("MoveL Offs(p10,\n  0,0, ! above\n 80), v100, fine, tool0;").target == "Offs(p10, 0,0, 80)");
    CHECK_FALSE(at("MoveL Offs(p10,0,0,80), v100, fine, tool0;").isName);
}

TEST_CASE("where no movement is, none is named", "[report]") {
    CHECK(moveTextAt("  SetDO do1, 1;", 1, 3).instruction.empty());
    CHECK(moveTextAt("MoveL p10, v100", 1, 1).instruction.empty()); // without an end
    CHECK(moveTextAt("MoveL p10, v100, fine, tool0;", 2, 1).instruction.empty());
    CHECK(moveTextAt("", 1, 1).instruction.empty());
    CHECK(moveTextAt("a\n  MoveAbsJ home, v100, fine, tool0;", 2, 3).target == "home");
}

// ---- Analysis (rules: docs/reports.md) -------------------------------------------------------------------------------

TEST_CASE("a movement at its programmed speed loses time at its stop points only", "[report]") {
    RobotRecord record;
    record.robot = simpleRobot();
    record.moves.push_back(moveNumber(1, 200));
    addMotion(record, 1, 1, ramped(200, 1), slowly());
    const Analysis analysis = analyse(record);
    REQUIRE(analysis.moves.size() == 1);
    const MoveResult& result = analysis.moves[0];
    CHECK(result.main.cause == Cause::Programmed);
    CHECK(result.reached == Approx(200));
    CHECK(result.length == Approx(180).margin(0.1));
    CHECK(result.end - result.start == Approx(1));
    // Two ramps of 0.1 s at half the speed on average: 0.1 s lost.
    CHECK(lostTo(result, Cause::StopPoint) == Approx(0.1).margin(0.01));
}

TEST_CASE("an axis at 98 percent of its speed limit is what limits", "[report]") {
    RobotRecord record;
    record.robot = simpleRobot();
    record.moves.push_back(moveNumber(1, 1000));
    addMotion(record, 1, 1, [](double) { return 500.0; }, [](double t) { return -98.5 * t; });
    const Analysis analysis = analyse(record);
    REQUIRE(analysis.moves.size() == 1);
    CHECK(analysis.moves[0].main.cause == Cause::JointSpeed);
    CHECK(analysis.moves[0].main.axis == 1);
    CHECK(analysis.moves[0].main.seconds == Approx(0.5).margin(0.01)); // half the speed for 1 s
    const RunRecord run = runOf(record);
    CHECK(summaryText(run, robotReports(run, {})).find("speed limit of axis 1") != std::string::npos);
}

TEST_CASE("an axis below 98 percent of its limit does not limit", "[report]") {
    RobotRecord record;
    record.robot = simpleRobot();
    record.moves.push_back(moveNumber(1, 1000));
    addMotion(record, 1, 1, [](double) { return 500.0; }, [](double t) { return 97 * t; });
    const Analysis analysis = analyse(record);
    REQUIRE(analysis.moves.size() == 1);
    CHECK(lostTo(analysis.moves[0], Cause::JointSpeed, 1) == 0);
}

TEST_CASE("acceleration at its limit is found from differences of samples, and AccSet lowers the limit",
          "[report]") {
    for (const double share : {1.0, 0.5}) {
        RobotRecord record;
        record.robot = simpleRobot();
        record.moves.push_back(moveNumber(1, 1000));
        record.moves.back().acceleration = share;
        // 0.2 s up and 0.2 s down.
        const auto angle = [share](double t) {
            const double a = 500 * share;
            return t <= 0.2 ? a * t * t / 2 : a * 0.02 + a * 0.2 * (t - 0.2) - a * (t - 0.2) * (t - 0.2) / 2;
        };
        addMotion(record, 1, 0.4, [](double t) { return 1000 * std::min(t, 0.4 - t); }, angle);
        const Analysis analysis = analyse(record);
        REQUIRE(analysis.moves.size() == 1);
        CHECK(analysis.moves[0].main.cause == Cause::Acceleration);
        CHECK(analysis.moves[0].main.axis == 1);
    }
}

TEST_CASE("moving and waiting add up to the cycle", "[report]") {
    const RobotRecord record = angledRun();
    const Analysis analysis = analyse(record);
    REQUIRE(analysis.moves.size() == 3);
    CHECK(analysis.cycle == Approx(3.7));
    CHECK(analysis.moving == Approx(3).margin(0.001));
    CHECK(analysis.moving + analysis.waiting == Approx(analysis.cycle));
    CHECK(analysis.length == Approx(300).margin(0.01));
    CHECK(analysis.moves[1].start == Approx(1.5).margin(0.005));
}

TEST_CASE("slower round a fly-by point is the zone's doing", "[report]") {
    RobotRecord record;
    record.robot = simpleRobot();
    for (uint64_t number : {1, 2}) {
        record.moves.push_back(moveNumber(number, 200));
        record.moves.back().stopPoint = number == 2;
        record.moves.back().zone = 10;
    }
    // The first movement ends at half the speed, with which the second begins.
    addMotion(
        record, 1, 1, [](double t) { return 200 * std::min({t / 0.1, 1.0, 0.5 + (1 - t) / 0.2}); }, slowly());
    addMotion(
        record, 2, 1, [](double t) { return 200 * std::min({1.0, 0.5 + t / 0.2, (1 - t) / 0.1}); }, slowly());
    const Analysis analysis = analyse(record);
    REQUIRE(analysis.moves.size() == 2);
    // 0.1 s at three quarters of the speed on average.
    CHECK(lostTo(analysis.moves[0], Cause::Zone) == Approx(0.025).margin(0.004));
    CHECK(lostTo(analysis.moves[1], Cause::Zone) == Approx(0.025).margin(0.004));
    CHECK(lostTo(analysis.moves[0], Cause::StopPoint) == Approx(0.05).margin(0.005));
}

TEST_CASE("a path that turns back on itself stops for its zone, unless it ends at a stop point", "[report]") {
    for (const bool isStop : {false, true}) {
        CAPTURE(isStop);
        RobotRecord record;
        record.robot = simpleRobot();
        for (uint64_t number : {1, 2}) {
            record.moves.push_back(moveNumber(number, 200));
            record.moves.back().stopPoint = isStop || number == 2;
            record.moves.back().zone = 10;
            addMotion(record, number, 1, ramped(200, 1), slowly());
        }
        const double tip = 180; // mm, 1 s at 200 mm/s less the two ramps
        for (Sample& sample : record.samples)
            if (sample.move == 2) sample.position.x = 2 * tip - sample.position.x;
        const Analysis analysis = analyse(record);
        REQUIRE(analysis.moves.size() == 2);
        // 0.1 s at half the speed on average, at both ends of both movements.
        CHECK(lostTo(analysis.moves[0], Cause::Zone) == Approx(isStop ? 0 : 0.05).margin(0.005));
        CHECK(lostTo(analysis.moves[1], Cause::Zone) == Approx(isStop ? 0 : 0.05).margin(0.005));
        CHECK(lostTo(analysis.moves[0], Cause::StopPoint) == Approx(isStop ? 0.1 : 0.05).margin(0.005));
        CHECK(lostTo(analysis.moves[1], Cause::StopPoint) == Approx(isStop ? 0.1 : 0.05).margin(0.005));
    }
}

// ---- Recordings ------------------------------------------------------------------------------------------------------

TEST_CASE("columns of a recording are found by lenient names, with units", "[report]") {
    std::vector<Recording> all;
    REQUIRE(
        parseRecording("Time [ms];TCP X [m];tcp_y;Pos Z;note\n\n# by hand\n500;0,1;2;3;a\n600;0,2;2;3;b\n",
                       "r.csv", all)
            .empty());
    Recording recording = all.at(0);
    CHECK(recording.hasPositions);
    CHECK_FALSE(recording.hasJoints);
    REQUIRE(recording.samples.size() == 2);
    CHECK(recording.samples[0].time == Approx(0.5));
    CHECK(recording.samples[1].position == robot::Vec3{200, 2, 3});
    REQUIRE(
        parseRecording("t,J1,joint_2,Axis 3,rax_4,a5,j6_rad\n0,1,2,3,4,5,0\n1,1,2,3,4,5,3.14159265358979\n",
                       "r.csv", all)
            .empty());
    recording = all.at(0);
    CHECK(recording.hasJoints);
    CHECK(recording.samples[1].joints[5] == Approx(180));
    // Quaternions of a trace are not axes.
    REQUIRE(
        parseRecording("time_s,x,y,z,q1,q2,q3,q4\n0,1,2,3,1,0,0,0\n1,1,2,3,1,0,0,0\n", "r.csv", all).empty());
    CHECK_FALSE(all.at(0).hasJoints);
}

TEST_CASE("a column names the robot of each line of a recording", "[report]") {
    std::vector<Recording> all;
    REQUIRE(
        parseRecording("time_s,unit,x,y,z\n0,ROB_1,1,2,3\n0,ROB_2,7,8,9\n1,ROB_1,4,5,6\n0.5,ROB_2,7,8,9\n",
                       "r.csv", all)
            .empty());
    REQUIRE(all.size() == 2);
    CHECK(all[1].unit == "ROB_2");
    CHECK(all[0].samples.at(1).position == robot::Vec3{4, 5, 6});
    RunRecord run = runOf(angledRun());
    run.robots[0].unit = "Rob_2"; // names have no case
    CHECK(recordingsFor(run.robots, all) == std::vector<const Recording*>{&all[1]});
    run.robots.push_back(run.robots[0]);
    run.robots[1].unit = "ROB_3";
    CHECK(recordingsFor(run.robots, all) == std::vector<const Recording*>{&all[1], nullptr});
    // A recording without names is of the first robot.
    REQUIRE(parseRecording("time_s,x,y,z\n0,1,2,3\n1,4,5,6\n", "r.csv", all).empty());
    CHECK(recordingsFor(run.robots, all) == std::vector<const Recording*>{&all[0], nullptr});
    CHECK(problemOf("time_s,unit,x,y,z\n0,A,1,2,3\n1,A,1,2,3\n1,B,1,2,3\n") ==
          "r.csv: a recording of B needs two samples at least, this one has 1");
}

TEST_CASE("a bad recording is described with line and remedy", "[report]") {
    CHECK(problemOf("") ==
          "r.csv: the file is empty; the first line must name the columns: time_s, and j1 to j6 (degrees) "
          "or x, y, z (mm, TCP in world)");
    CHECK(problemOf("0,1,2,3\n1,1,2,3\n")
              .find("r.csv:1: a column of time is missing; the first line must name") == 0);
    CHECK(
        problemOf("time_s,x,y\n0,1,2\n").find("r.csv:1: neither j1 to j6 nor x, y, z are there in full; ") ==
        0);
    CHECK(problemOf("time_s,t,x,y,z\n").find("r.csv:1: column 't' means the same as a column before it") ==
          0);
    CHECK(problemOf("time_s,x,y,z\n0,1,2,3\n1,1,zwei,3\n") ==
          "r.csv:3: 'zwei' in column 'y' is not a number; correct it or remove the line");
    CHECK(problemOf("time_s,x,y,z\n0,1,2,3\n1,1,2\n") ==
          "r.csv:3: 3 fields instead of 4; is the line cut off?");
    CHECK(problemOf("time_s,x,y,z\n1,1,2,3\n0.5,1,2,3\n") ==
          "r.csv:3: the time 0.5 s is before that of the line above it (1 s); sort the lines by time");
    CHECK(problemOf("time_s,x,y,z\n1,1,2,3\n") ==
          "r.csv: a recording needs two samples at least, this one has 1");
}

// ---- Comparison ------------------------------------------------------------------------------------------------------

TEST_CASE("a recording that begins later does not differ", "[report]") {
    const RobotRecord record = angledRun();
    const Analysis analysis = analyse(record);
    const Recording later = recordingOf(record, [](RecordedSample& s, const Sample&) { s.time += 5; });
    const Comparison result = compare(record, analysis, later);
    REQUIRE(result.problem.empty());
    // 1 mm after the start to 1 mm before the end: 10 ms less at either end than the 3.5 s between.
    CHECK(result.here == Approx(3.48).margin(0.001));
    CHECK(result.there == Approx(3.48).margin(0.001));
    CHECK(result.offset == Approx(-5));
    CHECK(result.worst == Approx(0).margin(1e-6));
    CHECK(result.largest(10).empty());
}

TEST_CASE("a recording beside the path is as far away as it is", "[report]") {
    const RobotRecord record = angledRun();
    const Analysis analysis = analyse(record);
    const Recording above = recordingOf(record, [](RecordedSample& s, const Sample&) { s.position.z += 2; });
    const Comparison result = compare(record, analysis, above);
    CHECK(result.median == Approx(2));
    CHECK(result.most == Approx(2));
    CHECK(result.worst == Approx(2));
    CHECK(result.here == Approx(result.there).margin(0.001));
}

TEST_CASE("the worst place is found, with its movement", "[report]") {
    const RobotRecord record = angledRun();
    const Analysis analysis = analyse(record);
    // A bump of 3 mm in the middle of the second movement, at y = 50.
    const Recording bump = recordingOf(record, [](RecordedSample& s, const Sample& sample) {
        s.position.z += 3 * std::exp(-std::pow((sample.position.y - 50) / 15, 2));
    });
    const Comparison result = compare(record, analysis, bump);
    CHECK(result.worst == Approx(3).margin(0.05));
    CHECK(result.median < 0.01);
    REQUIRE(result.worstMove != nullptr);
    CHECK(result.worstMove->move->number == 2);
    CHECK(result.worstPlace.y == Approx(50).margin(2));
}

TEST_CASE("a longer stop and a slower movement are found where they are", "[report]") {
    const RobotRecord record = angledRun();
    const Analysis analysis = analyse(record);
    const double stopEnds = 1.5, third = 2.5;
    const Recording slower = recordingOf(record, [&](RecordedSample& s, const Sample& sample) {
        if (sample.time >= stopEnds - 1e-9) s.time += 0.3; // waits 0.3 s longer
        if (sample.time > third)
            s.time += 0.2 * (sample.time - third); // and is 20 % slower in the third movement
    });
    const Comparison result = compare(record, analysis, slower);
    CHECK(result.here - result.there == Approx(-0.3 - 0.2 * 0.99).margin(0.005));
    const auto largest = result.largest(2);
    REQUIRE(largest.size() == 2);
    CHECK(largest[0].waiting);
    CHECK(largest[0].move->move->number == 1);
    CHECK(largest[0].difference() == Approx(-0.3).margin(0.005));
    CHECK_FALSE(largest[1].waiting);
    CHECK(largest[1].move->move->number == 3);
    CHECK(largest[1].difference() == Approx(-0.2 * 0.98).margin(0.01));
    const std::string text = comparisonText(runOf(record), {{analysis, &slower, result}}, {slower});
    CHECK(text.find("Cell:11") != std::string::npos);
    CHECK(text.find("waiting at its end") != std::string::npos);
}

TEST_CASE("a path there and back on one line is not mixed up", "[report]") {
    RobotRecord record;
    record.robot = simpleRobot();
    record.samples.emplace_back();
    for (uint64_t number : {1, 2, 3, 4}) {
        record.moves.push_back(moveNumber(number, 100));
        Sample sample = record.samples.back();
        for (int i = 1; i <= 125; ++i) {
            sample.time += kStep;
            sample.position.z += number % 2 == 1 ? -0.4 : 0.4;
            sample.joints[1] += 0.04;
            sample.move = number;
            sample.speed = 100;
            record.samples.push_back(sample);
        }
    }
    const Analysis analysis = analyse(record);
    // The third movement takes a tenth longer.
    const Recording slower = recordingOf(record, [](RecordedSample& s, const Sample& sample) {
        s.time += 0.1 * std::clamp(sample.time - 1, 0.0, 0.5);
    });
    const Comparison result = compare(record, analysis, slower);
    CHECK(result.worst < 0.3);
    const auto largest = result.largest(1);
    REQUIRE(largest.size() == 1);
    CHECK(largest[0].move->move->number == 3);
    CHECK(largest[0].difference() == Approx(-0.05).margin(0.01));
}

TEST_CASE("long paths are paired as finely as short ones", "[report]") {
    // 60 strokes of 100 mm, there and back; the eleventh takes a quarter of a second longer in the recording.
    RobotRecord record;
    record.robot = simpleRobot();
    record.samples.emplace_back();
    for (uint64_t number = 1; number <= 60; ++number) {
        record.moves.push_back(moveNumber(number, 500));
        Sample sample = record.samples.back();
        for (int i = 1; i <= 50; ++i) {
            sample.time += kStep;
            sample.position.z += number % 2 == 1 ? -2 : 2;
            sample.joints[1] += 0.04;
            sample.move = number;
            sample.speed = 500;
            record.samples.push_back(sample);
        }
    }
    const Analysis analysis = analyse(record);
    const Recording slower = recordingOf(record, [](RecordedSample& s, const Sample& sample) {
        s.time += 1.25 * std::clamp(sample.time - 2, 0.0, 0.2);
        s.position.x += 0.5;
    });
    const Comparison result = compare(record, analysis, slower);
    CHECK(result.worst == Approx(0.5).margin(0.001));
    const auto largest = result.largest(1);
    REQUIRE(largest.size() == 1);
    CHECK(largest[0].move->move->number == 11);
    CHECK(largest[0].difference() == Approx(-0.25).margin(0.01));
}

TEST_CASE("axis angles alone are compared at the flange", "[report]") {
    const RobotRecord record =
        angledRun(); // axis 1 turns by 30 degrees, a circle of the flange about the base
    const Analysis analysis = analyse(record);
    Recording angles = recordingOf(record, [](RecordedSample& s, const Sample&) { s.position = {}; });
    angles.hasPositions = false;
    angles.hasJoints = true;
    const Comparison result = compare(record, analysis, angles);
    REQUIRE(result.problem.empty());
    CHECK(result.atFlange);
    CHECK(result.worst == Approx(0).margin(1e-6));
    CHECK(result.here == Approx(result.there));
}

TEST_CASE("a recording without motion is refused in words", "[report]") {
    const RobotRecord record = angledRun();
    const Analysis analysis = analyse(record);
    const Recording still = recordingOf(record, [](RecordedSample& s, const Sample&) { s.position = {}; });
    CHECK(compare(record, analysis, still).problem == "the TCP does not move in the recording");
}

// ---- Pages and pictures ----------------------------------------------------------------------------------------------

TEST_CASE("no text of the program can end the data of a page", "[report]") {
    RunRecord record = runOf(angledRun());
    record.program = "a<b>&\"{{script}}";
    record.markers.push_back({0.5, "line", 0, "", "</script><script>alert(1)</script>"});
    const std::vector<RobotReport> robots = robotReports(record, {});
    const std::string data = pageData({record, robots});
    CHECK(data.find('<') == std::string::npos);
    const std::string page = reportPage({record, robots});
    CHECK(page.find("<title>a&lt;b&gt;&amp;&quot;") != std::string::npos);
    std::size_t ends = 0;
    for (std::size_t at = page.find("</script>"); at != std::string::npos;
         at = page.find("</script>", at + 1))
        ++ends;
    CHECK(ends == 2); // data and script
}

TEST_CASE("the picture shows zones, names and changes of signals", "[report]") {
    RobotRecord record = angledRun();
    record.moves[0].text = {"MoveL", "pCorner", true};
    record.moves[0].end = {100, 0, 0};
    record.moves[0].stopPoint = false;
    record.moves[0].zone = 20;
    record.moves[1].end = {100, 100, 0};
    RunRecord run = runOf(record);
    run.signals.push_back({"doGrip", "DO", 0, {{1.2, 1}}});
    const std::string svg = pathPicture(run);
    CHECK(svg.find(">pCorner<") != std::string::npos);
    CHECK(svg.find(">line 12<") != std::string::npos); // without a name: the line
    CHECK(svg.find(">doGrip=1<") != std::string::npos);
    // A zone of 20 mm in a picture of 420 px for 200 mm in x, 8 percent of room: from -0 to 200.
    CHECK(svg.find("class='zone'") != std::string::npos);
    CHECK(svg.find("r='38.9'") != std::string::npos); // 20 / (200 * 1.08) * 420
}

TEST_CASE("a run without samples has a page and a picture", "[report]") {
    RobotRecord record;
    record.robot = simpleRobot();
    const Analysis analysis = analyse(record);
    const RunRecord run = runOf(record);
    CHECK(pathPicture(run).find("</svg>") != std::string::npos);
    CHECK(reportPage({run, robotReports(run, {})}).find("</html>") != std::string::npos);
    CHECK(compare(record, analysis, Recording()).problem == "the TCP does not move in this run");
}

TEST_CASE("several robots have a legend and a summary each", "[report]") {
    RunRecord run = runOf(angledRun());
    run.robots.push_back(run.robots[0]);
    run.robots[0].unit = "ROB_1";
    run.robots[1].unit = "ROB_<2>";
    const std::string svg = pathPicture(run);
    CHECK(svg.find(">ROB_1<") != std::string::npos);
    CHECK(svg.find(">ROB_&lt;2&gt;<") != std::string::npos);
    const std::string text = summaryText(run, robotReports(run, {}));
    CHECK(text.find("robot       ROB_1 (simple)\nmoving") != std::string::npos);
    CHECK(text.find("\nrobot       ROB_<2> (simple)\nmoving") != std::string::npos);
    // External axes alone have no path.
    run.robots[1].hasArm = false;
    CHECK(pathPicture(run).find("ROB_1") == std::string::npos); // one path needs no legend
}

// Rule: an external axis at its speed limit is named, and its programmed speed counts (docs/reports.md).
TEST_CASE("external axes have programmed speeds and limits", "[report]") {
    RobotRecord record;
    record.robot = simpleRobot();
    record.hasArm = false;
    record.external.push_back({"STN1", 1, true, 50, 1e6});
    record.moves.push_back(moveNumber(1, 100));
    record.moves[0].externalTurnSpeed = 100;
    Sample sample;
    sample.external[1] = 0;
    record.samples.push_back(sample);
    sample.move = 1;
    for (int i = 1; i <= 250; ++i) { // 1 s at 50 deg/s, half of what is programmed
        sample.time += kStep;
        sample.external[1] += 0.2;
        record.samples.push_back(sample);
    }
    const Analysis limited = analyse(record);
    REQUIRE(limited.moves.size() == 1);
    CHECK(lostTo(limited.moves[0], Cause::JointSpeed, kFirstExternal + 1) == Approx(0.5).margin(0.01));
    CHECK(causeText(limited.moves[0].main) == "speed limit of axis eax_b");
    record.moves[0].externalTurnSpeed = 50;
    CHECK(analyse(record).moves.at(0).atProgrammed == Approx(1).margin(0.01));
}
