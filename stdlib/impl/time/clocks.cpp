// Manual 1.14: clocks count virtual time.

#include "stdlib/impl/time/clocks.h"

#include "config/json_text.h"
#include "runtime/debug/state_keepers.h"
#include "runtime/host/controller.h"
#include "runtime/host/json_numbers.h"
#include "stdlib/impl/support/fail.h"

#include "natives/time.h"
#include "stdlib_constants.h"

#include <algorithm>
#include <string>

using namespace rt;

namespace {

/// A clock overflows after 4294967 s (49 days), as on a controller.
constexpr Time kLongest = Time{4294967} * kSecond;

ClockObject& clockOf(TaskCore* task, Handle* slot) {
    return taskOf(task).controller().clocks().at(*slot);
}

Status checked(TaskCore* task, const ClockObject& clock) {
    if (clock.elapsed(taskOf(task).now()) <= kLongest) return kOk;
    return lib::fail(task, err::ERR_OVERFLOW,
                     "the clock has counted more than 4294967 s; reset it with ClkReset");
}

} // namespace

namespace rt::lib {

void keepClocks(Controller& controller, StateKeepers& kept) {
    const auto textOf = [&controller](Handle handle) -> std::string {
        const ClockObject* clock = controller.clocks().find(handle);
        if (clock == nullptr) return {};
        return rapid::config::textOf(
            nlohmann::json({clock->elapsed(controller.scheduler().now()), clock->running()}));
    };
    const auto make = [&controller](const std::string& text) {
        const auto json = rapid::config::parseJson(text);
        const Handle handle = controller.clocks().create();
        controller.clocks().find(handle)->restore(
            std::clamp<Time>(numberFrom<Time>(json.at(0)), 0, kLongest + kSecond), json.at(1).get<bool>(),
            controller.scheduler().now());
        return handle;
    };
    kept.handles["clock"] = {textOf, make};
}

} // namespace rt::lib

extern "C" {

Status rt_ClkReset(TaskCore* task, Handle* Clock) {
    clockOf(task, Clock).reset(taskOf(task).now());
    return kOk;
}

Status rt_ClkStart(TaskCore* task, Handle* Clock) {
    ClockObject& clock = clockOf(task, Clock);
    if (const Status status = checked(task, clock)) return status;
    clock.start(taskOf(task).now());
    return kOk;
}

Status rt_ClkStop(TaskCore* task, Handle* Clock) {
    ClockObject& clock = clockOf(task, Clock);
    clock.stop(taskOf(task).now());
    return checked(task, clock);
}

Status rt_ClkRead(TaskCore* task, float* result, Handle* Clock, bool HighRes) {
    const ClockObject& clock = clockOf(task, Clock);
    if (const Status status = checked(task, clock)) return status;
    const Time resolution = HighRes ? kMicrosecond : kMillisecond;
    // To the nearest: a wait of 0.7 s, which binary32 holds as 0.69999999, shall read 0.7.
    const Time elapsed = (clock.elapsed(taskOf(task).now()) + resolution / 2) / resolution * resolution;
    *result = static_cast<float>(toSeconds(elapsed));
    return kOk;
}
}
