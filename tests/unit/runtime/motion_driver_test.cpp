#include "unit/runtime/test_program.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace rt;
using testing::Run;
using testing::TempFolder;

namespace {

motion::MoveCommand toAxis1(double degrees) {
    motion::MoveCommand command;
    command.kind = motion::MoveKind::AbsJoint;
    command.joints.robax = {degrees, 0, 0, 0, 30, 0};
    command.speed.vTcp = 200;
    return command;
}

Status move(TaskCore* core, double degrees) {
    Task& task = taskOf(core);
    motion::MoveId id = 0;
    std::optional<motion::MotionError> error;
    const Status status = task.controller().motion(task).order(task, toAxis1(degrees), id, error);
    CHECK_FALSE(error);
    return status;
}

struct Row {
    double time = 0, axis1 = 0, speed = 0;
    int move = 0;
};

std::vector<Row> rows(const std::string& text) {
    std::vector<Row> result;
    std::istringstream lines(text);
    std::string line, field;
    std::getline(lines, line);
    CHECK(line == "time_s,unit,j1,j2,j3,j4,j5,j6,e1,e2,e3,e4,e5,e6,x,y,z,q1,q2,q3,q4,speed_mm_s,move");
    while (std::getline(lines, line)) {
        std::istringstream fields(line);
        std::vector<std::string> values;
        while (std::getline(fields, field, ','))
            values.push_back(field);
        REQUIRE(values.size() == 23);
        CHECK(values[1] == "ROB_1");
        CHECK(values[8] == "9E+09"); // no external axis
        result.push_back(
            {std::stod(values[0]), std::stod(values[2]), std::stod(values[21]), std::stoi(values[22])});
    }
    return result;
}

Status twoMoves(TaskCore* core, Frame*) {
    if (const Status status = move(core, 40)) return status;
    if (const Status status = taskOf(core).sleepFor(100 * kMillisecond)) return status;
    return move(core, -10);
}

std::string traceOf(const TempFolder& folder, const std::string& stimulus, EntryFunction entry, Run& run) {
    run.options.trace = folder.file("trace.csv");
    if (!stimulus.empty()) run.options.stimulus = folder.write("s.csv", stimulus);
    run.task("T_ROB1", entry);
    CHECK(run.run() == ExitStatus::Ended);
    return folder.read("trace.csv");
}

} // namespace

TEST_CASE("the trace has a sample each 4 ms, moving or standing", "[motion_driver]") {
    const TempFolder folder;
    Run run;
    const std::vector<Row> trace = rows(traceOf(folder, "", twoMoves, run));
    REQUIRE(trace.size() == static_cast<std::size_t>(run.now() / (4 * kMillisecond)) + 1);
    double largest = 0;
    for (std::size_t i = 0; i < trace.size(); ++i) {
        CHECK(trace[i].time == Approx(0.004 * static_cast<double>(i)).margin(1e-9));
        largest = std::max(largest, trace[i].axis1);
        if (i > 0) CHECK(trace[i].move >= trace[i - 1].move);
    }
    CHECK(trace.front().axis1 == 0);
    CHECK(largest == Approx(40).margin(1e-6)); // the fine point is reached, not cut
    CHECK(trace.back().axis1 == Approx(-10).margin(0.2));
    CHECK(trace.back().move == 2);
    const auto standing = [](const Row& row) { return std::fabs(row.axis1 - 40) < 1e-9 && row.speed == 0; };
    CHECK(std::count_if(trace.begin(), trace.end(), standing) >=
          18); // the 0.1 s in between, less the last half mm
}

TEST_CASE("the same program and stimulus give the same trace to the byte", "[motion_driver]") {
    const TempFolder folder;
    const char* stimulus = "0.1,stop,\n0.733,start,\n";
    Run first, second;
    const std::string one = traceOf(folder, stimulus, twoMoves, first);
    CHECK(one == traceOf(folder, stimulus, twoMoves, second));
    CHECK(one.size() > 1000);
}

TEST_CASE("a stop order brakes the robot on its path; a start continues", "[motion_driver]") {
    const TempFolder folder;
    Run plain, stopped;
    traceOf(folder, "", twoMoves, plain);
    const std::vector<Row> trace = rows(traceOf(folder, "0.2,stop,\n5,start,\n", twoMoves, stopped));
    CHECK(stopped.now() > plain.now() + 4 * kSecond);
    const auto at = [&](double time) { return trace[static_cast<std::size_t>(std::lround(time / 0.004))]; };
    CHECK(at(2).speed == 0);
    CHECK(at(2).axis1 == at(4.9).axis1);
    CHECK(at(2).axis1 > 0);
    CHECK(at(2).axis1 < 40);
    CHECK(trace.back().axis1 == Approx(-10).margin(0.2));
}

TEST_CASE("triggers call back at their time on the path", "[motion_driver]") {
    static Time fired = 0, reached = 0;
    fired = reached = 0;
    Run run;
    run.task("T_ROB1", [](TaskCore* core, Frame*) -> Status {
        Task& task = taskOf(core);
        MotionDriver& driver = task.controller().motion(task);
        motion::MoveCommand command = toAxis1(40);
        PathAction action;
        action.act = [&task] { fired = task.scheduler().now(); };
        action.place.inTime = true;
        action.place.amount = 0.1; // s before the end
        motion::MoveId id = 0;
        std::optional<motion::MotionError> error;
        if (const Status status = driver.order(task, command, id, error, {action})) return status;
        if (const Status status = driver.waitDone(task, id)) return status;
        reached = task.now();
        return kOk;
    });
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(reached > 0);
    CHECK(std::llabs(reached - fired - 100 * kMillisecond) < kMillisecond);
}

TEST_CASE("the run ends when the robot is at rest, not before", "[motion_driver]") {
    Run run;
    run.task("T_ROB1", [](TaskCore* core, Frame*) -> Status {
        Task& task = taskOf(core);
        motion::MoveCommand command = toAxis1(40);
        command.concurrent = true;
        motion::MoveId id = 0;
        std::optional<motion::MotionError> error;
        const Status status = task.controller().motion(task).order(task, command, id, error);
        CHECK(task.now() == 20 * kMillisecond); // with the start of the movement
        return status;
    });
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(run.now() > 100 * kMillisecond);
    CHECK(run.controller->motions().front()->system().currentJoints().robax[0] == Approx(40));
}

TEST_CASE("pp_to_main throws the path away and the program begins again", "[motion_driver]") {
    const TempFolder folder;
    Run run;
    const std::string text = traceOf(folder, "0.2,stop,\n1,pp_to_main,\n2,start,\n", twoMoves, run);
    const std::vector<Row> trace = rows(text);
    CHECK(trace.back().move == 3); // the one thrown away, then two
    CHECK(trace.back().axis1 == Approx(-10).margin(0.2));
}

TEST_CASE("a move that cannot be made is reported, not made", "[motion_driver]") {
    Run run;
    run.task("T_ROB1", [](TaskCore* core, Frame*) -> Status {
        Task& task = taskOf(core);
        motion::MoveId id = 0;
        std::optional<motion::MotionError> error;
        const Status status = task.controller().motion(task).order(task, toAxis1(999), id, error);
        REQUIRE(error);
        CHECK(error->kind == motion::MotionErrorKind::JointOutOfRange);
        return status;
    });
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(run.now() < kMillisecond);
}
