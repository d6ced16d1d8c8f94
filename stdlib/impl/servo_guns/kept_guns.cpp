// Servo guns between two processes (--state). The end of a process is a power failure: what moved has stopped, and no force is left.

#include "config/json_text.h"
#include "stdlib/impl/servo_guns/servo_gun.h"

#include "runtime/debug/state_keepers.h"
#include "runtime/host/json_numbers.h"

namespace rt::lib {

using Json = nlohmann::json;

Json ServoGun::state() const {
    return {{"initialized", isInitialized_},
            {"synchronized", isSynchronized_},
            {"openAt", openAt_},
            {"thickness", thickness_},
            {"wear", {wearBase_, wearKnown_, tipWear_, adjustment_}},
            {"ramp", rampPercent_},
            {"cutOff", wasCutOff_ || isAwaited_}};
}

void ServoGun::restore(const Json& state) {
    state.at("initialized").get_to(isInitialized_);
    state.at("synchronized").get_to(isSynchronized_);
    openAt_ = numberFrom<double>(state.at("openAt"));
    thickness_ = numberFrom<double>(state.at("thickness"));
    const Json& wear = state.at("wear");
    wearBase_ = numberFrom<double>(wear.at(0));
    wearKnown_ = numberFrom<double>(wear.at(1));
    tipWear_ = numberFrom<double>(wear.at(2));
    adjustment_ = numberFrom<double>(wear.at(3));
    rampPercent_ = numberFrom<double>(state.at("ramp"));
    state.at("cutOff").get_to(wasCutOff_);
}

void keepServoGuns(Controller& controller, StateKeepers& kept) {
    kept.keepers["servoGuns"] = {[&controller] {
                                     Json all = Json::object();
                                     for (const auto& [unit, gun] : controller.service<ServoGuns>().known())
                                         if (gun) all[unit->name] = gun->state();
                                     return all;
                                 },
                                 [&controller](const Json& all) {
                                     for (const auto& [unit, state] : all.items())
                                         if (ServoGun* gun =
                                                 controller.service<ServoGuns>().find(controller, unit))
                                             gun->restore(state);
                                 }};
}

} // namespace rt::lib
