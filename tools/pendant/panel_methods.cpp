// panel.*, time.set, restart: the operator's panel, virtual time, the controller itself.

#include "config/json_text.h"
#include "tools/pendant/areas.h"
#include "tools/pendant/hub.h"

namespace rapidc::pendant {

namespace {

using service::Change;
using service::MotorState;
using service::OperatingMode;

constexpr Word<MotorState> kMotorStates[] = {
    {"init", MotorState::Init},
    {"on", MotorState::On},
    {"off", MotorState::Off},
    {"guardStop", MotorState::GuardStop},
    {"emergencyStop", MotorState::EmergencyStop},
    {"emergencyStopReset", MotorState::EmergencyStopReset},
    {"failure", MotorState::SystemFailure},
};
constexpr Word<OperatingMode> kModes[] = {
    {"auto", OperatingMode::Auto},
    {"manual", OperatingMode::ManualReduced},
    {"manualFull", OperatingMode::ManualFull},
};
constexpr Word<bool> kCycles[] = {{"forever", false}, {"once", true}};
constexpr Word<service::RestartMode> kRestarts[] = {
    {"warm", service::RestartMode::Warm},
    {"cold", service::RestartMode::Cold},
};
constexpr int kMostPace = 1000; // per cent

class PanelArea final : public Area {
  public:
    explicit PanelArea(const Context& context) : controller_(context.controller), hub_(context.hub) {
        service::Observer observer;
        observer.changed = [this](Change change, const rt::Task*) {
            switch (change) {
            case Change::MotorState:
            case Change::OperatingMode:
            case Change::SpeedRatio:
            case Change::Execution:
            case Change::Cycle:
            case Change::Generation: isChanged_ = true, hub_.wake(); break;
            default: break;
            }
        };
        observer_ = controller_.observers().add(std::move(observer));
    }
    ~PanelArea() override { controller_.observers().remove(observer_); }
    PanelArea(const PanelArea&) = delete;
    PanelArea& operator=(const PanelArea&) = delete;

    void addTo(MethodTable& methods) override;
    void describe(Json& state) override { state["panel"] = panel(), state["time"] = time(); }
    void flush() override {
        if (!std::exchange(isChanged_, false)) return;
        hub_.broadcast("panel", panel());
    }

  private:
    Json panel() const {
        const service::PanelState& panel = controller_.panel();
        return {{"motors", wordFor(panel.motors, kMotorStates)},
                {"mode", wordFor(panel.mode, kModes)},
                {"speed", panel.speedRatio},
                {"cycle", wordFor(panel.runOnce, kCycles)},
                {"running", controller_.isRunning()},
                {"emergencyStop", panel.motors == MotorState::EmergencyStop}};
    }
    Json time() const {
        return {{"t", rounded(rt::toSeconds(controller_.core().scheduler().now()), 4)},
                {"pace", controller_.pace()},
                {"running", controller_.isTimeRunning()}};
    }
    /// The next flush shows the panel, even where no observer was called.
    void touch() { isChanged_ = true, hub_.wake(); }
    Json setTime(const Json& params) {
        if (has(params, "pace")) controller_.setPace(static_cast<int>(wholeOf(params, "pace", 0, kMostPace)));
        if (has(params, "running")) controller_.setTimeRunning(flagOf(params, "running"));
        hub_.broadcast("time", time());
        return time();
    }

    service::VirtualController& controller_;
    Hub& hub_;
    service::Observers::Token observer_ = 0;
    bool isChanged_ = false;
};

void PanelArea::addTo(MethodTable& methods) {
    methods.add("panel.motors", [this](Client&, const Json& params) {
        refuseUnless(controller_.setMotors(flagOf(params, "on")));
        touch();
        return panel();
    });
    methods.add("panel.mode", [this](Client&, const Json& params) {
        refuseUnless(controller_.setMode(wordOf(params, "mode", kModes)));
        touch();
        return panel();
    });
    methods.add("panel.speed", [this](Client&, const Json& params) {
        refuseUnless(controller_.setSpeedRatio(static_cast<int>(wholeOf(params, "percent", 0, 100))));
        touch();
        return panel();
    });
    methods.add("panel.cycle", [this](Client&, const Json& params) {
        refuseUnless(controller_.setRunOnce(wordOf(params, "cycle", kCycles)));
        touch();
        return panel();
    });
    methods.add("panel.emergencyStop", [this](Client&, const Json& params) {
        controller_.pressEmergencyStop(flagOf(params, "pressed"));
        touch();
        return panel();
    });
    methods.add("time.set", [this](Client&, const Json& params) { return setTime(params); });
    methods.add("restart", [this](Client&, const Json& params) {
        refuseUnless(controller_.restart(wordOf(params, "mode", kRestarts)));
        return Json::object();
    });
}

} // namespace

std::unique_ptr<Area> makePanelArea(const Context& context) {
    return std::make_unique<PanelArea>(context);
}

} // namespace rapidc::pendant
