#include "unit/runtime/test_program.h"

#include "runtime/host/command_line.h"
#include "runtime/sim/stimulus.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace rt;
using Catch::Matchers::Contains;
using testing::Run;
using testing::TempFolder;

namespace {

const char* const kSignals =
    "EIO:CFG_1.0:7:0::\n\n#\n\nEIO_SIGNAL:\n\n      -Name \"di1\" -SignalType \"DI\"\n\n"
    "      -Name \"do1\" -SignalType \"DO\"\n";

/// The exit status.
int parse(const std::vector<std::string>& arguments, RunOptions& options) {
    CommandLine line("test", "");
    addRunOptions(line.executable(), options, true);
    std::vector<const char*> words{"test"};
    for (const std::string& argument : arguments)
        words.push_back(argument.c_str());
    return line.run(static_cast<int>(words.size()), words.data());
}

/// Waits for di1 and answers with do1.
Status waitForInput(TaskCore* core, Frame*) {
    Task& task = taskOf(core);
    IoSystem& io = task.controller().io();
    const SignalId input = io.find("di1");
    WaitResult result{};
    const WaitSpec spec{{&io.changed(input)}, [&io, input] { return io.value(input) == 1; }, kNever, 0};
    if (const Status status = task.waitFor(spec, result)) return status;
    io.set(IoSystem::handleOf(io.find("do1")), 1);
    return task.sleepFor(kSecond);
}

int counter = 0; // a variable of the program
Status resetCounter(TaskCore*, Frame*) {
    counter = 0;
    return kOk;
}

} // namespace

TEST_CASE("stimulus: header, comments, order, quotes", "[stimulus]") {
    std::vector<StimulusProblem> problems;
    const auto items = parseStimulus(
        "time_s,target,value\n# a comment\n2,di1,1 # late\n 0.5 , di1 , 0\r\n2,answer,\"a,b#\"\n\n"
        "3,stop,\n3,pp_to_main\n3,start,\n4,gi1,TRUE\n",
        problems);
    REQUIRE(problems.empty());
    REQUIRE(items.size() == 7);
    CHECK(items[0].time == 500 * kMillisecond);
    CHECK(items[0].target == "di1");
    CHECK(items[1].value == 1);
    CHECK(items[2].kind == StimulusKind::Answer);
    CHECK(items[2].text == "a,b#");
    CHECK(items[3].kind == StimulusKind::Stop);
    CHECK(items[4].kind == StimulusKind::PpToMain);
    CHECK(items[5].kind == StimulusKind::Start);
    CHECK(items[6].value == 1);
}

TEST_CASE("stimulus: every invalid line is reported with its number", "[stimulus]") {
    std::vector<StimulusProblem> problems;
    parseStimulus("x,di1,1\n-1,di1,1\n1,,1\n1\n1,di1,high?\n1,stop,7\n1,\"di1,1\n", problems);
    REQUIRE(problems.size() == 7);
    for (uint32_t i = 0; i < 7; ++i)
        CHECK(problems[i].line == i + 1);
    CHECK_THAT(problems[0].message, Contains("'x' is not a time"));
    CHECK_THAT(problems[5].message, Contains("takes no value"));
}

TEST_CASE("options of run", "[host]") {
    RunOptions options;
    CHECK(parse({"--cycles=0", "--config=a.cfg", "--config=b.cfg", "--robot=IRB 120-3/0.58", "--realtime",
                 "--max-time=2.5", "--seed=7", "--rate=unlimited", "--task=T2:STATIC=x.modx"},
                options) == 0);
    CHECK(options.cycles == 0);
    CHECK(options.configFiles == std::vector<std::string>{"a.cfg", "b.cfg"});
    CHECK(options.robots == std::vector<std::string>{"IRB 120-3/0.58"});
    CHECK(options.realtime);
    CHECK(options.hasMaxTime);
    CHECK(options.maxTime == 2.5);
    CHECK(options.seed == 7);
    CHECK(options.rate == kUnlimitedRate);
    CHECK(options.tasks == std::vector<std::string>{"T2:STATIC=x.modx"});
    for (const char* wrong : {"--cycles=-1", "--cycles=x", "--max-time=soon", "--max-time=-1", "--rate=fast",
                              "--rate=1.5", "--seed=x", "--nonsense"}) {
        INFO(wrong);
        CHECK(parse({wrong}, options) == static_cast<int>(ExitStatus::BadUsage));
    }
}

TEST_CASE("HOME: nothing outside can be reached", "[host]") {
    const TempFolder folder;
    const std::string root = folder.path + "/home";
    std::filesystem::create_directories(root + "/sub");
    std::filesystem::create_symlink("/etc", root + "/out");
    std::filesystem::create_symlink("/nowhere/new.txt", root + "/dangling");
    std::filesystem::create_symlink("sub", root + "/inside");
    std::filesystem::create_symlink("../../outside.txt", root + "/sub/up");
    std::filesystem::create_symlink("loop", root + "/loop");
    std::filesystem::create_symlink(root + "/sub", root + "/absolute");
    Volumes home;
    std::string error, path;
    REQUIRE(home.open(root, error));
    const auto resolves = [&](const char* rapid, const std::string& expected) {
        INFO(rapid);
        CHECK(home.resolve(rapid, path));
        CHECK(path == root + expected);
    };
    resolves("HOME:", "");
    resolves("home:/a.txt", "/a.txt");
    resolves("HOME:a.txt", "/a.txt");
    resolves("sub/../a.txt", "/a.txt");
    resolves("HOME:/sub//./b.txt", "/sub/b.txt");
    resolves("HOME:\\sub\\b.txt", "/sub/b.txt");
    resolves("inside/b.txt", "/sub/b.txt");
    resolves("inside/../c.txt", "/c.txt");
    resolves("absolute/b.txt", "/sub/b.txt");
    for (const char* outside : {"../x", "HOME:/..", "HOME:/sub/../../x", "out/passwd", "dangling", "sub/up",
                                "loop", "USB1:/x", "/../x", "HOME:/a/../../home/../x"}) {
        INFO(outside);
        CHECK_FALSE(home.resolve(outside, path));
    }
    CHECK(home.resolve("HOME:/sub", "b.txt", path));
    CHECK(path == root + "/sub/b.txt");
    CHECK_FALSE(home.resolve("HOME:", "../x", path));
    CHECK_FALSE(home.resolve("HOME:", "HOME:/x", path));
    CHECK_FALSE(home.resolve(std::string_view("a\0b", 3), path));
}

TEST_CASE("HOME: is an empty folder that is removed, unless one is given", "[host]") {
    std::string path, error;
    {
        Volumes home;
        REQUIRE(home.openTemporary(error));
        path = home.path();
        CHECK(std::filesystem::is_empty(path));
        std::ofstream(path + "/left.txt") << "x";
    }
    CHECK_FALSE(std::filesystem::exists(path));
    const TempFolder folder;
    {
        Volumes home;
        REQUIRE(home.open(folder.path, error));
    }
    CHECK(std::filesystem::exists(folder.path));
    Volumes none;
    CHECK_FALSE(none.open(folder.path + "/missing", error));
}

TEST_CASE("stimulus drives a program; signals and events are written", "[host]") {
    const TempFolder folder;
    Run run;
    run.options.configFiles = {folder.write("EIO.cfg", kSignals)};
    run.options.stimulus = folder.write("s.csv", "1.5,di1,1\n");
    run.options.signals = folder.file("signals.csv");
    run.options.events = folder.file("events.jsonl");
    static Handle slot = 0;
    slot = 0;
    run.externals = {{"DI1", "signaldi", &slot, "main.modx", 3, 8}};
    run.task("T_ROB1", waitForInput);
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(slot == IoSystem::handleOf(run.controller->io().find("di1")));
    CHECK(run.now() == 2500 * kMillisecond);
    run.controller.reset();
    CHECK(folder.read("signals.csv") == "time_s,signal,value\n1.500000,di1,1\n1.500000,do1,1\n");
    CHECK(folder.read("events.jsonl").empty());
}

TEST_CASE("a program that names what is not configured does not start", "[host]") {
    const TempFolder folder;
    static Handle slot = 0;
    for (const char* kind : {"signaldo", "signalai", "socket"}) {
        Run run;
        run.options.configFiles = {folder.write("EIO.cfg", kSignals)};
        run.externals = {{"di1", kind, &slot, "main.modx", 3, 8}};
        run.task("T", waitForInput);
        CHECK(run.run() == ExitStatus::BadProgram);
    }
    Run unknown;
    unknown.options.configFiles = {folder.write("EIO.cfg", kSignals)};
    unknown.externals = {{"di7", "signaldi", &slot, "main.modx", 3, 8}};
    unknown.task("T", waitForInput);
    CHECK(unknown.run() == ExitStatus::BadProgram);
    // Without any configuration the use of the signal is the error (decision 39).
    Run open;
    open.externals = {{"di7", "signaldi", &slot, "main.modx", 3, 8}};
    open.task("T", [](TaskCore*, Frame*) -> Status { return kOk; });
    CHECK(open.run() == ExitStatus::Ended);
    CHECK(open.controller->io().idOf(slot) == -1);
    CHECK(open.controller->io().undefinedName(slot) == "di7");
}

TEST_CASE("wrong use of options ends with status 3, wrong configuration with 2", "[host]") {
    const TempFolder folder;
    const auto tried = [&](auto change) {
        Run run;
        change(run.options);
        run.task("T", [](TaskCore*, Frame*) -> Status { return kOk; });
        return run.run();
    };
    CHECK(tried([](RunOptions& o) { o.home = "/nowhere/at/all"; }) == ExitStatus::BadUsage);
    CHECK(tried([](RunOptions& o) { o.robots = {"no such robot"}; }) == ExitStatus::BadUsage);
    CHECK(tried([](RunOptions& o) { o.stimulus = "/nowhere.csv"; }) == ExitStatus::BadUsage);
    CHECK(tried([](RunOptions& o) { o.trace = "/nowhere/t.csv"; }) == ExitStatus::BadUsage);
    CHECK(tried([](RunOptions& o) { o.configFiles = {"/nowhere.cfg"}; }) == ExitStatus::BadUsage);
    CHECK(tried([&](RunOptions& o) { o.stimulus = folder.write("s.csv", "1,di99,1\n"); }) ==
          ExitStatus::BadUsage);
    CHECK(tried([&](RunOptions& o) {
              o.configFiles = {folder.write("x.cfg", "EIO:CFG_1.0:7:0::\n      oops\n")};
          }) == ExitStatus::BadProgram);
    CHECK(tried([](RunOptions&) {}) == ExitStatus::Ended);
}

TEST_CASE("stop and start from outside suspend the NORMAL tasks", "[host]") {
    const TempFolder folder;
    static std::vector<std::string> ticks;
    ticks.clear();
    Run run;
    run.options.stimulus = folder.write("s.csv", "1.05,stop,\n3.05,start,\n9,start,\n");
    run.task("T", [](TaskCore* core, Frame*) -> Status {
        for (int i = 0; i < 3; ++i) {
            if (const Status status = taskOf(core).sleepFor(kSecond)) return status;
            ticks.push_back(formatSeconds(taskOf(core).now(), 2));
        }
        return kOk;
    });
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(ticks == std::vector<std::string>{"1.00", "4.05", "5.05"});
    CHECK(run.count(EventId::ProgramStopped) == 1);
    CHECK(run.count(EventId::ProgramRestarted) == 1);
}

TEST_CASE("Stop waits for a start that is to come", "[host]") {
    const TempFolder folder;
    static bool after = false;
    after = false;
    Run run;
    run.options.stimulus = folder.write("s.csv", "5,start,\n");
    run.task("T", [](TaskCore* core, Frame*) -> Status {
        if (const Status status = taskOf(core).stopHere("Stop")) return status;
        after = true;
        return kOk;
    });
    CHECK(run.run() == ExitStatus::Ended);
    CHECK(after);
    CHECK(run.now() == 5 * kSecond);
}

TEST_CASE("pp_to_main runs the UNDO handlers and gives variables their initial values", "[host]") {
    const TempFolder folder;
    static std::vector<std::string> log;
    log.clear();
    Run run;
    run.options.stimulus = folder.write("s.csv", "1,pp_to_main,\n2,stop,\n3,pp_to_main,\n3,start,\n");
    run.task(
        "T",
        [](TaskCore* core, Frame*) -> Status {
            log.push_back("main " + std::to_string(++counter));
            const Status status = taskOf(core).sleepFor(10 * kSecond);
            if (status == kUnwind) { // what a compiled UNDO handler does
                if (const Status undo = taskOf(core).sleepFor(kMillisecond)) return undo;
                log.push_back("undo");
            }
            return status;
        },
        "NORMAL", resetCounter);
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(log == std::vector<std::string>{"main 1", "undo", "main 1"});
    CHECK(run.count(EventId::ActionRefusedRunning) == 1);
    CHECK(run.count(EventId::ProgramPointerReset) == 1);
}

TEST_CASE("after an error a start executes the instruction again, after pp_to_main it begins at main",
          "[host]") {
    const TempFolder folder;
    static int mains = 0;
    const auto body = [](TaskCore* core, Frame*) -> Status {
        if (++mains == 1) return rt_raise(core, nullptr, 5);
        return kOk;
    };
    mains = 0;
    Run repeated;
    repeated.options.stimulus = folder.write("s.csv", "2,start,\n");
    repeated.task("T", body);
    CHECK(repeated.run() == ExitStatus::StoppedByError);
    CHECK(repeated.count(EventId::UnhandledError) == 2);
    CHECK(mains == 1);
    mains = 0;
    Run again;
    again.options.stimulus = folder.write("s.csv", "1,pp_to_main,\n2,start,\n");
    again.task("T", body);
    CHECK(again.run() == ExitStatus::Ended);
    CHECK(mains == 2);
}

TEST_CASE("answers come from the stimulus: waiting at that time or asked next", "[host]") {
    const TempFolder folder;
    static std::vector<std::string> got;
    got.clear();
    Run run;
    run.options.stimulus = folder.write("s.csv", "1,answer,first\n2,answer, second \n");
    run.task("T", [](TaskCore* core, Frame*) -> Status {
        Task& task = taskOf(core);
        Dialog dialog;
        dialog.lines = {"Number?"};
        dialog.broken = [] { return false; }; // nothing watched could ever change this
        for (int i = 0; i < 3; ++i) {
            DialogEnd end{};
            std::string answer;
            if (const Status status = task.controller().panel().ask(task, dialog, end, answer)) return status;
            got.push_back(answer + (end == DialogEnd::NoClient ? "(nobody)" : "") + "@" +
                          formatSeconds(task.now(), 0));
            if (i == 0) {
                if (const Status status = task.sleepFor(3 * kSecond)) return status;
            }
        }
        return kOk;
    });
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(got == std::vector<std::string>{"first@1", "second@4", "(nobody)@4"});
    CHECK(run.count(EventId::NoOperator) == 1);
}

TEST_CASE("a dialog with a time limit ends by it when nobody answers", "[host]") {
    static DialogEnd end{};
    Run run;
    run.task("T", [](TaskCore* core, Frame*) -> Status {
        Task& task = taskOf(core);
        Dialog dialog;
        dialog.deadline = 3 * kSecond;
        std::string answer;
        return task.controller().panel().ask(task, dialog, end, answer);
    });
    REQUIRE(run.run() == ExitStatus::Ended);
    CHECK(end == DialogEnd::Timeout);
    CHECK(run.now() == 3 * kSecond);
}

TEST_CASE("events are JSON lines with fixed members", "[host]") {
    Event event;
    event.sequence = 1;
    event.number = 40900;
    event.type = EventType::Error;
    event.title = "Execution error";
    event.text = "text with \"quotes\" and \xFF";
    event.time = 1'234'567'890;
    event.task = "T_ROB1";
    event.place = {"M", "main", "m.modx", 7, 3};
    const nlohmann::json json = nlohmann::json::parse(toJson(event));
    CHECK(json["number"] == 40900);
    CHECK(json["category"] == "program");
    CHECK(json["type"] == "error");
    CHECK(json["title"] == "Execution error");
    CHECK(json["time"] == 1.234567);
    CHECK(json["task"] == "T_ROB1");
    CHECK(json["module"] == "M");
    CHECK(json["line"] == 7);
    CHECK_THAT(toText(event), Contains("error 40900: Execution error") && Contains("T_ROB1 M:7 in main"));
}

TEST_CASE("clocks count virtual time while they run", "[host]") {
    HandleTable<ClockObject> clocks;
    Handle variable = 0;
    ClockObject& clock = clocks.at(variable);
    CHECK(variable > 0);
    clock.start(kSecond);
    clock.start(2 * kSecond); // no effect
    CHECK(clock.elapsed(3 * kSecond) == 2 * kSecond);
    clock.stop(4 * kSecond);
    CHECK(clock.elapsed(9 * kSecond) == 3 * kSecond);
    clock.reset(9 * kSecond);
    CHECK(clock.elapsed(9 * kSecond) == 0);
    CHECK(&clocks.at(variable) == &clock);
    CHECK(clocks.erase(variable));
    CHECK(clocks.find(variable) == nullptr);
    Handle other = variable;
    clocks.at(other);
    CHECK(other != variable); // never given out again
}

TEST_CASE("system signals give orders and show states", "[host]") {
    const TempFolder folder;
    const std::string plus =
        "      -Name \"diStop\" -SignalType \"DI\"\n\n      -Name \"diStart\" -SignalType \"DI\"\n\n"
        "      -Name \"doRun\" -SignalType \"DO\"\n#\n\nSYSSIG_IN:\n\n"
        "      -Signal \"diStop\" -Action \"Stop\"\n\n"
        "      -Signal \"diStart\" -Action \"Start\" -Arg1 \"CONT\"\n\n"
        "      -Signal \"diAddIn\" -Action \"Stop\"\n#\n\nSYSSIG_OUT:\n\n"
        "      -Status \"CycleOn\" -Signal \"doRun\"\n";
    Run run;
    run.options.configFiles = {folder.write("EIO.cfg", kSignals + std::string("\n") + plus)};
    run.options.stimulus = folder.write("s.csv", "1,diStop,1\n3,diStart,1\n");
    run.options.signals = folder.file("signals.csv");
    run.task("T", [](TaskCore* core, Frame*) -> Status {
        if (const Status status = taskOf(core).sleepFor(2 * kSecond)) return status;
        CHECK(taskOf(core).now() == 5 * kSecond); // the wait counts again from the start (manual 2.2.6)
        return taskOf(core).stopHere("Stop");     // no start to come any more
    });
    CHECK(run.run() == ExitStatus::Ended);
    run.controller.reset();
    CHECK(folder.read("signals.csv") ==
          "time_s,signal,value\n0.000000,doRun,1\n1.000000,diStop,1\n1.000000,doRun,0\n"
          "3.000000,diStart,1\n3.000000,doRun,1\n5.000000,doRun,0\n");
}
