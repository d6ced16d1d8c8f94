#include "stdlib/impl/spot/spot_gun.h"

#include "config/json_text.h"
#include "runtime/debug/state_keepers.h"
#include "runtime/host/json_numbers.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>

namespace rt::lib {
namespace {

using Kind = ProcessSignal::Kind;

constexpr std::string_view kTypes = "SPOT";
constexpr int kMostGuns = 10;

// In the order of kSignals.
enum Signal : std::size_t {
    CloseGun,
    HighLift,
    Equalize,
    EnableCurrent,
    StartWeld,
    WeldError,
    WeldProgram,
    Pressure,
    GunClosed,
    GunOpen,
    WeldComplete,
    WeldFault,
    TimerReady,
    WaterOk,
    PressureOk
};
constexpr ProcessSignal kSignals[] = {{"CloseGun", "g{}_close_gun", Kind::Output},
                                      {"HighLift", "g{}_high_lift", Kind::Output},
                                      {"Equalize", "g{}_equalize", Kind::Output},
                                      {"EnableCurrent", "g{}_enable_current", Kind::Output},
                                      {"StartWeld", "g{}_start_weld", Kind::Output},
                                      {"WeldError", "g{}_weld_error", Kind::Output},
                                      {"WeldProgram", "g{}_weld_program", Kind::Reference},
                                      {"Pressure", "g{}_pressure", Kind::Reference},
                                      {"GunClosed", "g{}_gun_closed", Kind::Input},
                                      {"GunOpen", "g{}_gun_open", Kind::Input},
                                      {"WeldComplete", "g{}_weld_complete", Kind::Input},
                                      {"WeldFault", "g{}_weld_fault", Kind::Input},
                                      {"TimerReady", "g{}_timer_ready", Kind::Input},
                                      {"WaterOk", "g{}_water_ok", Kind::Input},
                                      {"PressureOk", "g{}_pressure_ok", Kind::Input}};

/// All guns of the controller, by number.
struct SpotGuns {
    std::map<int, std::unique_ptr<SpotGun>> byNumber;
};

/// One supervision for each motion group.
struct GunSupervision {
    bool isOn = false;
};

void giveUp(Controller& controller) {
    for (auto& [number, gun] : controller.service<SpotGuns>().byNumber)
        gun->giveUpClosing();
}

} // namespace

std::string SpotGun::read(Controller& controller, int number) {
    number_ = number;
    return signals_.read(controller, kTypes, number, kSignals);
}

void SpotGun::select(double program, double force) const {
    signals_.set(WeldProgram, program);
    signals_.set(Pressure, force);
}

void SpotGun::equalise(bool on) const {
    signals_.set(Equalize, on ? 1 : 0);
}

void SpotGun::highLift(bool open) const {
    signals_.set(HighLift, open ? 1 : 0);
}

void SpotGun::weldError(bool on) const {
    signals_.set(WeldError, on ? 1 : 0);
}

void SpotGun::close(Time now) {
    if (isClosing()) return;
    closedSince_ = now;
    signals_.set(CloseGun, 1);
}

void SpotGun::giveUpClosing() {
    if (!isClosing() || weldSince_ != kNever) return; // a weld in progress is finished
    closedSince_ = kNever;
    signals_.set(CloseGun, 0);
}

/// Waits for an input to be 1, or, when there is no such input, until the equipment has had `seconds`.
Status SpotGun::waitFor(TaskCore* task, std::size_t input, Time since, double seconds, double timeout,
                        const char* what) {
    Task& owner = taskOf(task);
    if (signals_.id(input) < 0) return owner.sleepUntil(addTime(since, fromSeconds(seconds)));
    IoSystem& io = owner.controller().io();
    const auto isFault = [this, input] {
        return input == WeldComplete && signals_.input(WeldFault).value_or(false);
    };
    WaitSpec spec;
    spec.queues = {&io.changed(signals_.id(input))};
    if (input == WeldComplete && signals_.id(WeldFault) >= 0)
        spec.queues.push_back(&io.changed(signals_.id(WeldFault)));
    spec.condition = [&] { return isFault() || signals_.input(input).value_or(true); };
    spec.deadline = addTime(owner.now(), fromSeconds(timeout));
    WaitResult result{};
    if (const Status status = owner.waitFor(spec, result)) return status;
    if (isFault())
        return fail(task, err::SPOTWELD_ERR,
                    fmt::format("the timer of gun {} reports a fault (input WeldFault)", number_));
    if (result == WaitResult::Timeout)
        return fail(task, err::SPOTWELD_ERR,
                    fmt::format("gun {} {} within {:g} s (input {})", number_, what, timeout,
                                kSignals[input].attribute));
    return kOk;
}

Status SpotGun::waitClosed(TaskCore* task) {
    return waitFor(task, GunClosed, closedSince_, signals_.number("CloseTime", 0.2),
                   signals_.number("GunTimeout", 2), "is not closed");
}

Status SpotGun::checkReady(TaskCore* task) const {
    for (const auto& [input, what] : {std::pair{TimerReady, "the timer is not ready"},
                                      std::pair{WaterOk, "the cooling water does not flow"},
                                      std::pair{PressureOk, "the pressure is too low"}})
        if (!signals_.input(input).value_or(true))
            return fail(task, err::SPOTWELD_ERR,
                        fmt::format("gun {}: {} (input {})", number_, what, kSignals[input].attribute));
    return kOk;
}

void SpotGun::startWeld(Time now) {
    weldSince_ = now;
    signals_.set(EnableCurrent, signals_.number("Simulate", 0) == 0 ? 1 : 0);
    signals_.set(StartWeld, 1);
}

Status SpotGun::waitWelded(TaskCore* task, double timeout) {
    const Status status =
        waitFor(task, WeldComplete, weldSince_, signals_.number("WeldTime", 0.4),
                timeout > 0 ? timeout : signals_.number("WeldTimeout", 2), "has not finished the weld");
    signals_.set(StartWeld, 0);
    signals_.set(EnableCurrent, 0);
    weldSince_ = kNever;
    return status;
}

void SpotGun::open(Time now) {
    closedSince_ = kNever;
    openSince_ = now;
    signals_.set(CloseGun, 0);
}

Status SpotGun::waitOpen(TaskCore* task) {
    return waitFor(task, GunOpen, openSince_, signals_.number("OpenTime", 0.2),
                   signals_.number("GunTimeout", 2), "is not open");
}

void SpotGun::abandon(Time now) {
    signals_.set(StartWeld, 0);
    signals_.set(EnableCurrent, 0);
    weldSince_ = kNever;
    open(now);
    weldError(true);
}

SpotGun* spotGunOf(TaskCore* task, const float* number, const data::Gundata* gun, Status& status) {
    Controller& controller = taskOf(task).controller();
    int wanted = 1;
    if (number != nullptr && *number == std::floor(*number) && *number >= 1 && *number <= kMostGuns)
        wanted = static_cast<int>(*number);
    else if (number != nullptr) {
        status = failWith(task, err::ERR_ARGVALERR, "{} is not the number of a gun, from 1 to {}", *number,
                          kMostGuns);
        return nullptr;
    } else if (gun != nullptr) {
        if (const int named = processInstance(controller, kTypes, gun->gun_name.view()); named > 0)
            wanted = named;
    }
    auto& slot = controller.service<SpotGuns>().byNumber[wanted];
    if (!slot) slot = std::make_unique<SpotGun>();
    if (const std::string problem = slot->read(controller, wanted); !problem.empty()) {
        status = fail(task, err::SPOTWELD_ERR, problem);
        return nullptr;
    }
    return slot.get();
}

void keepSpotGuns(Controller& controller, StateKeepers& kept) {
    kept.keepers["spotGuns"] = {[&controller] {
                                    nlohmann::json all = nlohmann::json::array();
                                    for (const auto& [number, gun] : controller.service<SpotGuns>().byNumber)
                                        all.push_back({number, gun->weldsSinceCalibration});
                                    return all;
                                },
                                [&controller](const nlohmann::json& all) {
                                    for (const nlohmann::json& entry : all) {
                                        const int number = numberFrom<int>(entry.at(0));
                                        if (number < 1 || number > kMostGuns) continue;
                                        auto& gun = controller.service<SpotGuns>().byNumber[number];
                                        if (!gun) gun = std::make_unique<SpotGun>();
                                        (void)gun->read(controller, number); // its user reports what is wrong
                                        gun->weldsSinceCalibration = numberFrom<int>(entry.at(1));
                                    }
                                }};
}

void superviseGuns(TaskCore* task) {
    auto& supervision = motionOf(task).service<GunSupervision>();
    if (std::exchange(supervision.isOn, true)) return;
    Controller& controller = taskOf(task).controller();
    motionOf(task).addListener([&controller](ArmChange news) {
        if (news == ArmChange::StopOnPath || news == ArmChange::MotorsOff) giveUp(controller);
    });
}

void openGuns(Task& task) {
    if (task.isMotionTask()) giveUp(task.controller());
}

} // namespace rt::lib
