// System inputs of a controller that lives long: they order what its panel can do (serve: docs/system_signals.md).

#include "tools/service/panel_orders.h"
#include "tools/service/virtual_controller.h"
#include "unit/temporary_folder.h"

#include "runtime/host/panel_switches.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <future>
#include <thread>

using namespace rapidc::service;

namespace {

constexpr const char* kConfiguration = R"(EIO:CFG_1.0:7:0::
#
EIO_SIGNAL:

      -Name "diOn" -SignalType "DI"

      -Name "diOff" -SignalType "DI"

      -Name "diCycle" -SignalType "DI"

      -Name "diConfirm" -SignalType "DI"

      -Name "diLoad" -SignalType "DI"

      -Name "diBackup" -SignalType "DI"

      -Name "diReset" -SignalType "DI"

      -Name "doEmStop" -SignalType "DO"

      -Name "doMotors" -SignalType "DO"
#
SYSSIG_IN:

      -Signal "diOn" -Action "MotorOnStart" -Arg1 "CONT"

      -Signal "diOff" -Action "MotorOff"

      -Signal "diCycle" -Action "StopCycle"

      -Signal "diConfirm" -Action "ResetEstop"

      -Signal "diLoad" -Action "LoadStart" -Arg1 "HOME:/other.pgf" -Arg2 "T_ROB1"

      -Signal "diBackup" -Action "Backup" -Arg1 "line1"

      -Signal "diReset" -Action "SysReset"
#
SYSSIG_OUT:

      -Signal "doEmStop" -Status "EmStop"

      -Signal "doMotors" -Status "MotOnState"
)";

constexpr const char* kProgram = R"(MODULE Cycle
  PERS num count := 0;
  PROC main()
    count := count + 1;
    WaitTime 0.05;
  ENDPROC
ENDMODULE
)";

constexpr const char* kOther = R"(MODULE Other
  PERS num others := 0;
  PROC main()
    others := others + 1;
    WaitTime 0.05;
  ENDPROC
ENDMODULE
)";

constexpr const char* kModes = R"(SYS:CFG_1.0:7:0::
#
RUN_MODE_SETTINGS:

      -name "AutoToManual" -SwitchTo "Single"

      -name "ManualToAuto" -SwitchTo "Continuous"
)";

/// A controller with system inputs, on a thread of its own; motors off.
class Wired {
  public:
    Wired() {
        std::filesystem::create_directory(folder_.path / "home");
        Settings settings;
        settings.inputs.paths = {write("Cycle.modx", kProgram)};
        settings.inputs.configFiles = {write("EIO.cfg", kConfiguration), write("SYS.cfg", kModes)};
        settings.options.home = (folder_.path / "home").string();
        settings.programStart = false;
        controller_ = std::make_unique<VirtualController>(std::move(settings));
        REQUIRE(controller_->open() == rt::ExitStatus::Ended);
        thread_ = std::thread([this] { (void)controller_->run(); });
    }
    ~Wired() {
        controller_->shutDown();
        thread_.join();
    }
    Wired(const Wired&) = delete;
    Wired& operator=(const Wired&) = delete;

    std::string write(const std::string& name, const std::string& text) {
        const std::string path = (folder_.path / name).string();
        std::ofstream(path) << text;
        return path;
    }
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
    void set(const char* signal, double value) {
        ask([&](VirtualController& controller) {
            rt::IoSystem& io = controller.core().io();
            return io.force(io.find(signal), value);
        });
    }
    /// Returns when the orders of the signal have been carried out: they come with the events of that moment.
    void pulse(const char* signal) {
        set(signal, 1);
        set(signal, 0);
        const auto now = [](VirtualController& controller) { return controller.core().scheduler().now(); };
        const rt::Time before = ask(now);
        comes([&](VirtualController& controller) { return now(controller) > before; });
    }
    double value(const char* signal) {
        return ask([&](VirtualController& controller) {
            const rt::IoSystem& io = controller.core().io();
            return io.value(io.find(signal));
        });
    }

  private:
    TemporaryFolder folder_;
    std::unique_ptr<VirtualController> controller_;
    std::thread thread_;
};

const auto isRunning = [](VirtualController& controller) { return controller.isRunning(); };
const auto isStopped = [](VirtualController& controller) { return !controller.isRunning(); };

} // namespace

TEST_CASE("system inputs switch motors, start, and stop at the end of the cycle", "[service]") {
    Wired wired;
    wired.pulse("diOn");
    CHECK(wired.comes(isRunning));
    CHECK(wired.ask([](VirtualController& c) { return c.panel().motors; }) == MotorState::On);
    CHECK(wired.comes(
        [&](VirtualController& c) { return c.core().io().value(c.core().io().find("doMotors")) == 1; }));
    wired.pulse("diCycle");
    CHECK(wired.comes(isStopped));
    CHECK(wired.ask([](VirtualController& c) { return c.panel().motors; }) == MotorState::On);
    wired.pulse("diOff");
    CHECK(wired.comes([](VirtualController& c) { return c.panel().motors == MotorState::Off; }));
}

TEST_CASE("an emergency stop keeps its output until its reset is confirmed", "[service]") {
    Wired wired;
    wired.pulse("diOn");
    REQUIRE(wired.comes(isRunning));
    const auto press = [](bool pressed) {
        return [pressed](VirtualController& c) {
            c.pressEmergencyStop(pressed);
            return true;
        };
    };
    const auto stopped = [](VirtualController& c) {
        return c.core().io().value(c.core().io().find("doEmStop")) == 1;
    };
    wired.ask(press(true));
    CHECK(wired.comes(stopped));
    wired.pulse("diConfirm"); // the button is pressed
    wired.pulse("diOn");
    CHECK(wired.ask([](VirtualController& c) { return c.panel().motors; }) == MotorState::EmergencyStop);
    wired.ask(press(false));
    CHECK(wired.value("doEmStop") == 1);
    wired.pulse("diConfirm");
    CHECK(wired.comes([&](VirtualController& c) { return !stopped(c); }));
    CHECK(wired.ask([](VirtualController& c) { return c.panel().motors; }) == MotorState::Off);
}

TEST_CASE("in manual mode system inputs start nothing", "[service]") {
    bool refused = false;
    Wired wired;
    CHECK(wired.ask([](VirtualController& c) { return c.setMode(OperatingMode::ManualReduced); }).empty());
    wired.ask([&](VirtualController& c) {
        return c.core().log().addListener([&](const rt::Event& event) {
            refused = refused || event.number == static_cast<int>(rt::EventId::SystemInputRefused);
        });
    });
    wired.pulse("diOn");
    CHECK(wired.comes([&](VirtualController&) { return refused; }));
    CHECK_FALSE(wired.ask(isRunning));
    CHECK(wired.ask([](VirtualController& c) { return c.panel().motors; }) == MotorState::Off);
}

TEST_CASE("a system input loads a program and starts it", "[service]") {
    Wired wired;
    wired.write("home/other.pgf", "<?xml version=\"1.0\" encoding=\"ISO-8859-1\" "
                                  "?>\n<Program>\n\t<Module>Other.modx</Module>\n</Program>\n");
    wired.write("home/Other.modx", kOther);
    wired.pulse("diOn");
    REQUIRE(wired.comes(isRunning));
    wired.pulse("diCycle");
    REQUIRE(wired.comes(isStopped));
    wired.pulse("diLoad");
    CHECK(wired.comes([](VirtualController& c) {
        return c.core().findGlobal("others", "", *c.core().tasks().front()) != nullptr;
    }));
}

TEST_CASE("a backup is written by whoever writes backups", "[service]") {
    std::string folder;
    Wired wired;
    wired.ask([&](VirtualController& c) {
        c.panelOrders().setBackup([&](const std::string& name) {
            folder = name;
            return std::string();
        });
        return true;
    });
    wired.pulse("diBackup");
    CHECK(wired.comes([&](VirtualController&) { return folder == "BACKUP:/line1"; }));
}

TEST_CASE("a restart by a system input happens once", "[service]") {
    int restarts = 0;
    Wired wired;
    Observer observer;
    observer.changed = [&](Change change, const rt::Task*) {
        restarts += change == Change::Generation ? 1 : 0;
    };
    wired.ask([&](VirtualController& c) { return c.observers().add(observer); });
    wired.set("diReset", 1); // stays at 1: its value in the next controller gives no order
    CHECK(wired.comes([&](VirtualController&) { return restarts == 1; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    CHECK(wired.ask([&](VirtualController&) { return restarts; }) == 1);
}

TEST_CASE("a change of the mode switches the cycle as SYS.cfg says", "[service]") {
    Wired wired;
    const auto once = [](VirtualController& c) { return c.panel().runOnce; };
    CHECK_FALSE(wired.ask(once));
    wired.ask([](VirtualController& c) { return c.setMode(OperatingMode::ManualReduced); });
    CHECK(wired.ask(once));
    wired.ask([](VirtualController& c) { return c.setMode(OperatingMode::Auto); });
    CHECK_FALSE(wired.ask(once));
}
