#include "tools/service/virtual_controller.h"
#include "unit/temporary_folder.h"

#include "runtime/debug/debug_data.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <future>
#include <thread>

using namespace rapidc::service;

namespace {

/// A controller with one module in T_ROB1, on a thread of its own.
class Served {
  public:
    explicit Served(const std::string& text, bool programStart = false) {
        file_ = (folder_.path / "Cycle.modx").string();
        std::ofstream(file_) << text;
        Settings settings;
        settings.inputs.paths = {file_};
        settings.programStart = programStart;
        controller_ = std::make_unique<VirtualController>(std::move(settings));
        opened = controller_->open();
        if (opened == rt::ExitStatus::Ended) thread_ = std::thread([this] { status = controller_->run(); });
    }
    ~Served() { end(); }
    Served(const Served&) = delete;
    Served& operator=(const Served&) = delete;

    void end() {
        controller_->shutDown();
        if (thread_.joinable()) thread_.join();
    }
    /// Executes a command on the controller's thread and returns its result.
    template <class Command> auto ask(const Command& command) {
        std::promise<decltype(command(*controller_))> answer;
        auto result = answer.get_future();
        controller_->post([&] { answer.set_value(command(*controller_)); });
        return result.get();
    }
    /// Until `condition` holds, 10 s of the wall clock at most.
    template <class Condition> bool comes(const Condition& condition) {
        for (int i = 0; i < 1000; ++i) {
            if (ask(condition)) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }
    std::string value(const std::string& name) {
        return ask([&](VirtualController& controller) -> std::string {
            const auto& core = controller.core();
            const rt::GlobalDesc* data = core.findGlobal(name, "", *core.tasks().front());
            return data == nullptr ? "" : rt::valueText(rt::dataOf(*data));
        });
    }
    std::string file(const std::string& name, const std::string& text) {
        const std::string path = (folder_.path / name).string();
        std::ofstream(path) << text;
        return path;
    }

    rt::ExitStatus opened = rt::ExitStatus::Ended, status = rt::ExitStatus::Ended;

  private:
    TemporaryFolder folder_;
    std::string file_;
    std::unique_ptr<VirtualController> controller_;
    std::thread thread_;
};

const auto programRuns = [](VirtualController& controller) { return controller.isRunning(); };
const auto programIsStopped = [](VirtualController& controller) { return !controller.isRunning(); };

rt::Task& robotTask(VirtualController& controller) {
    return *controller.core().tasks().front();
}

constexpr const char* kCounter = R"(MODULE Cycle
  PERS num count := 0;
  VAR num inner := 0;
  PROC main()
    count := count + 1;
    inner := inner + 1;
    WaitTime 0.01;
  ENDPROC
ENDMODULE
)";

} // namespace

TEST_CASE("a controller without program start waits with its motors off", "[service]") {
    Served served(kCounter);
    REQUIRE(served.opened == rt::ExitStatus::Ended);
    CHECK_FALSE(served.ask(programRuns));
    CHECK(served.ask([](VirtualController& c) { return c.panel().motors; }) == MotorState::Off);
    CHECK(served.ask([](VirtualController& c) { return c.start(ExecutionMode::Continue); }) != "");
    CHECK(served.ask([](VirtualController& c) { return c.setMotors(true); }).empty());
    CHECK(served.ask([](VirtualController& c) { return c.start(ExecutionMode::Continue); }).empty());
    CHECK(served.ask(programRuns));
    CHECK(served.comes([](VirtualController& c) { return robotTask(c).cyclesDone() > 2; }));
    CHECK(served.ask([](VirtualController& c) { return c.stop(StopMode::Stop); }).empty());
    CHECK(served.comes(programIsStopped));
    served.end();
    CHECK(served.status == rt::ExitStatus::Ended);
}

TEST_CASE("with program start main runs for ever", "[service]") {
    Served served(kCounter, true);
    CHECK(served.comes([](VirtualController& c) { return robotTask(c).cyclesDone() > 3; }));
    CHECK(served.ask(programRuns));
}

TEST_CASE("cycle once: main is executed once by each start, and variables keep their values", "[service]") {
    Served served(kCounter);
    served.ask([](VirtualController& c) { return c.setMotors(true); });
    served.ask([](VirtualController& c) { return c.setRunOnce(true); });
    for (int i = 1; i <= 2; ++i) {
        REQUIRE(served.ask([](VirtualController& c) { return c.start(ExecutionMode::Continue); }).empty());
        REQUIRE(served.comes(programIsStopped));
        CHECK(served.value("count") == std::to_string(i));
        CHECK(served.value("inner") == std::to_string(i));
    }
}

TEST_CASE("the end of a cycle stops the program", "[service]") {
    Served served(kCounter, true);
    CHECK(served.ask([](VirtualController& c) { return c.stop(StopMode::Cycle); }).empty());
    CHECK(served.comes(programIsStopped));
    CHECK(served.ask([](VirtualController& c) { return robotTask(c).startsAtMain(); }));
}

TEST_CASE("steps execute one instruction of the task", "[service]") {
    Served served(kCounter);
    served.ask([](VirtualController& c) { return c.setMotors(true); });
    const auto step = [](VirtualController& c) { return c.start(ExecutionMode::StepOver); };
    for (int i = 0; i <= 1; ++i) {
        REQUIRE(served.ask(step).empty());
        REQUIRE(served.comes(programIsStopped));
        CHECK(served.value("count") == "1");
        CHECK(served.value("inner") == std::to_string(i));
    }
}

TEST_CASE("the program pointer goes to a line of another routine", "[service]") {
    Served served("MODULE Cycle\n  VAR num x := 0;\n  PROC main()\n    Stop;\n  ENDPROC\n  PROC other()\n    "
                  "x := 1;\n    "
                  "x := x + 10;\n    Stop;\n  ENDPROC\nENDMODULE\n",
                  true);
    REQUIRE(served.comes(programIsStopped));
    REQUIRE(
        served.ask([](VirtualController& c) { return c.pointerToLine(robotTask(c), "Cycle", 8); }).empty());
    REQUIRE(served.comes([](VirtualController& c) { return robotTask(c).place().line == 8; }));
    REQUIRE(served.ask([](VirtualController& c) { return c.start(ExecutionMode::Continue); }).empty());
    REQUIRE(served.comes(programIsStopped));
    CHECK(served.value("x") == "10"); // line 7 was not executed
    CHECK(served.ask([](VirtualController& c) { return c.pointerToLine(robotTask(c), "Cycle", 2); }) != "");
}

TEST_CASE("orders that follow a pointer to line wait until it is there", "[service]") {
    Served served("MODULE Cycle\n  VAR num x := 0;\n  PROC main()\n    Stop;\n  ENDPROC\n  PROC other()\n    "
                  "x := 1;\n    "
                  "x := x + 10;\n    Stop;\n  ENDPROC\nENDMODULE\n",
                  true);
    REQUIRE(served.comes(programIsStopped));
    const auto orders = [](VirtualController& c) -> std::string {
        if (Refusal refusal = c.pointerToLine(robotTask(c), "Cycle", 8); !refusal.empty()) return refusal;
        return c.start(ExecutionMode::Continue);
    };
    REQUIRE(served.ask(orders) == "");
    CHECK(served.comes([](VirtualController& c) { return robotTask(c).place().line == 9; }));
    REQUIRE(served.comes(programIsStopped));
    CHECK(served.value("x") == "10"); // execution began in line 8
}

TEST_CASE("a restart keeps persistents; a cold one begins again", "[service]") {
    Served served(kCounter);
    served.ask([](VirtualController& c) { return c.setMotors(true); });
    served.ask([](VirtualController& c) { return c.setRunOnce(true); });
    served.ask([](VirtualController& c) { return c.start(ExecutionMode::Continue); });
    REQUIRE(served.comes(programIsStopped));
    REQUIRE(served.value("count") == "1");
    CHECK(served.ask([](VirtualController& c) { return c.restart(RestartMode::Warm); }).empty());
    CHECK(served.value("count") == "1"); // the command waits for the next controller
    CHECK(served.ask([](VirtualController& c) { return c.restart(RestartMode::Cold); }).empty());
    CHECK(served.value("count") == "0");
}

TEST_CASE("commands that come during a restart are executed in their order", "[service]") {
    Served served(kCounter);
    std::vector<int> order;
    served.ask([&](VirtualController& c) {
        Observer observer;
        observer.changed = [&](Change change, const rt::Task*) {
            if (change == Change::Restart) c.post([&] { order.push_back(1); });
            if (change == Change::Generation) c.post([&] { order.push_back(2); });
        };
        c.observers().add(std::move(observer));
        return c.restart(RestartMode::Warm);
    });
    CHECK(served.comes([&](VirtualController&) { return order.size() == 2; }));
    CHECK(order == std::vector<int>{1, 2});
}

TEST_CASE("a byte is a whole number from 0 to 255 (1.15)", "[service]") {
    rt::TypeDesc byte{};
    byte.name = byte.baseName = "byte";
    byte.kind = rt::DescKind::Num;
    byte.size = sizeof(float);
    byte.count = 1;
    for (const float good : {0.0F, 1.0F, 255.0F})
        CHECK(rt::rangeProblem(&good, byte).empty());
    for (const float bad : {-1.0F, 1.5F, 1E38F})
        CHECK_FALSE(rt::rangeProblem(&bad, byte).empty());
    const float large = 256;
    CHECK(rt::rangeProblem(&large, byte) == "256 is not a byte: give a whole number from 0 to 255");
    rt::TypeDesc number = byte;
    number.name = "num";
    CHECK(rt::rangeProblem(&large, number).empty());
}

TEST_CASE("modules come and go; one with mistakes changes nothing", "[service]") {
    Served served(kCounter);
    const std::string good = served.file("Part.modx", "MODULE Part\n  PERS num fromPart := 7;\nENDMODULE\n");
    const std::string bad = served.file("Bad.modx", "MODULE Bad\n  VAR num x := \"text\";\nENDMODULE\n");
    const auto load = [](const std::string& path, bool replace) {
        return
            [path, replace](VirtualController& c) { return c.loadModule(robotTask(c), path, path, replace); };
    };
    CHECK(served.ask(load(good, false)).empty());
    CHECK(served.value("fromPart") == "7");
    CHECK(served.ask(load(good, false)) != ""); // it is loaded already
    CHECK(served.ask(load(bad, false)) != "");
    served.file("Part.modx", "MODULE Part\n  PERS num fromPart := 8;\nENDMODULE\n");
    CHECK(served.ask(load(good, true)).empty());
    CHECK(served.value("fromPart") == "8");
    CHECK(served.ask([](VirtualController& c) { return c.unloadModule(robotTask(c), "Part"); }).empty());
    CHECK(served.value("fromPart").empty());
    CHECK(served.ask([](VirtualController& c) { return c.unloadModule(robotTask(c), "Part"); }) != "");
    CHECK(served.ask([](VirtualController& c) { return c.structuralChanges(robotTask(c)); }) == 3);
}

TEST_CASE("the text of a compiled module can be replaced; data keep their values", "[service]") {
    Served served(kCounter);
    served.ask([](VirtualController& c) { return c.setMotors(true); });
    served.ask([](VirtualController& c) { return c.setRunOnce(true); });
    served.ask([](VirtualController& c) { return c.start(ExecutionMode::Continue); });
    REQUIRE(served.comes(programIsStopped));
    const auto replace = [](const std::string& text) {
        return [text](VirtualController& c) { return c.setModuleText(robotTask(c), "cycle", text); };
    };
    CHECK(served.ask(replace("MODULE Cycle\n  PROC main()\n    undeclared := 1;\n  ENDPROC\nENDMODULE\n")) !=
          "");
    CHECK(served.value("count") == "1");
    CHECK(
        served
            .ask(replace("MODULE Cycle\n  PERS num count := 0;\n  PROC main()\n    count := count + 100;\n  "
                         "ENDPROC\nENDMODULE\n"))
            .empty());
    CHECK(served.value("count") == "1");
    REQUIRE(served.ask([](VirtualController& c) { return c.start(ExecutionMode::Continue); }).empty());
    REQUIRE(served.comes(programIsStopped));
    CHECK(served.value("count") == "101");
    std::string text;
    CHECK(served.ask([&](VirtualController& c) { return c.moduleText(robotTask(c), "Cycle", text); }));
    CHECK(text.find("count + 100") != std::string::npos);
}

TEST_CASE("virtual time can be halted and runs at a factor of the wall clock", "[service]") {
    Served served(kCounter, true);
    const auto now = [](VirtualController& c) { return c.core().scheduler().now(); };
    served.ask([](VirtualController& c) { return c.setTimeRunning(false), 0; });
    const rt::Time halted = served.ask(now);
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    CHECK(served.ask(now) == halted);
    served.ask([](VirtualController& c) { return c.setPace(0), c.setTimeRunning(true), 0; });
    CHECK(served.comes([&](VirtualController& c) { return now(c) > halted + 60 * rt::kSecond; }));
}

TEST_CASE("an emergency stop takes the motors off until it is released and they are switched on",
          "[service]") {
    Served served(kCounter, true);
    served.ask([](VirtualController& c) { return c.pressEmergencyStop(true), 0; });
    CHECK(served.comes(programIsStopped));
    CHECK(served.ask([](VirtualController& c) { return c.panel().motors; }) == MotorState::EmergencyStop);
    CHECK(served.ask([](VirtualController& c) { return c.setMotors(true); }) != "");
    served.ask([](VirtualController& c) { return c.pressEmergencyStop(false), 0; });
    CHECK(served.ask([](VirtualController& c) { return c.panel().motors; }) ==
          MotorState::EmergencyStopReset);
    CHECK(served.ask([](VirtualController& c) { return c.setMotors(true); }).empty());
    CHECK(served.ask([](VirtualController& c) { return c.start(ExecutionMode::Continue); }).empty());
}

TEST_CASE("observers hear of execution, events and signals", "[service]") {
    Served served(kCounter);
    std::atomic<int> executions{0}, events{0};
    served.ask([&](VirtualController& c) {
        Observer observer;
        observer.changed = [&](Change change, const rt::Task*) {
            executions += change == Change::Execution ? 1 : 0;
        };
        observer.event = [&](const rt::Event&) { ++events; };
        return c.observers().add(observer);
    });
    served.ask([](VirtualController& c) { return c.setMotors(true); });
    served.ask([](VirtualController& c) { return c.setRunOnce(true); });
    served.ask([](VirtualController& c) { return c.start(ExecutionMode::Continue); });
    REQUIRE(served.comes([&](VirtualController&) { return executions.load() == 2; })); // started, stopped
    CHECK(events.load() >= 3); // motors on, program started, program stopped
}

TEST_CASE("the cycle of motion runs while something moves, and nothing is scheduled at rest", "[service]") {
    constexpr const char* kMove = R"(MODULE Cycle
  PROC main()
    MoveAbsJ [[10,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    Stop;
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v1000, fine, tool0;
    Stop;
  ENDPROC
ENDMODULE
)";
    Served served(kMove);
    REQUIRE(served.opened == rt::ExitStatus::Ended);
    const auto isIdle = [](VirtualController& c) {
        return !c.isRunning() && !c.core().scheduler().anythingPending();
    };
    CHECK(served.comes(isIdle));
    CHECK(served.ask([](VirtualController& c) { return c.cycles().cycles; }) == 0);
    served.ask([](VirtualController& c) {
        c.setPace(0);
        return c.setMotors(true);
    });
    CHECK(served.ask([](VirtualController& c) { return c.start(ExecutionMode::Continue); }).empty());
    CHECK(served.comes([&](VirtualController& c) { return c.cycles().cycles > 10 && isIdle(c); }));
    const auto seen = served.ask([](VirtualController& c) { return c.cycles(); });
    CHECK(seen.missed == 0); // virtual time does not keep pace with the wall clock
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    CHECK(served.ask([](VirtualController& c) { return c.cycles().cycles; }) == seen.cycles);
}

TEST_CASE("a cycle is missed when it begins after the next one was due", "[service]") {
    CycleCount count;
    for (const rt::Time late : {0, 3'999'999, 4'000'000, 9'000'000})
        count.count(late, 4 * rt::kMillisecond);
    CHECK(count.cycles == 4);
    CHECK(count.missed == 2);
    CHECK(count.latest == 9'000'000);
    CHECK(count.missedShare() == 50);
}
