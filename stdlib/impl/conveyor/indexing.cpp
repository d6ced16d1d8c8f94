// Manual 1.8: servo tracking for indexing conveyors.

#include "stdlib/impl/conveyor/indexing.h"

#include "stdlib/impl/conveyor/tracking.h"
#include "stdlib/impl/support/fail.h"

#include "natives/conveyor.h"
#include "stdlib_constants.h"

#include <algorithm>
#include <cmath>
#include <map>

using namespace rt;

namespace {

/// A conveyor in indexing mode: after IndCnvInit, until IndCnvReset.
struct Indexing {
    uint64_t listener = 0; ///< of the input; 0: disabled
    EventToken braking = 0;
    Time busyUntil = 0;
};

struct IndexingConveyors {
    std::map<Conveyor*, Indexing> all;
};

IndexingConveyors& indexing(Controller& controller) {
    return controller.service<IndexingConveyors>();
}

/// The belt moves on by one step. The time between the two orders is that of the step at full speed: what the first ramp lacks
/// is made up by the second one.
void step(Controller& controller, Conveyor& conveyor) {
    Indexing& state = indexing(controller).all[&conveyor];
    Scheduler& scheduler = controller.scheduler();
    if (scheduler.now() < state.busyUntil) return; // the last step continues
    const ConveyorSettings& settings = conveyor.settings();
    const double speed = std::min(settings.indexSpeed, std::sqrt(settings.index * settings.acceleration));
    const Time travel = fromSeconds(settings.index / speed);
    state.busyUntil = addTime(scheduler.now(), addTime(travel, fromSeconds(speed / settings.acceleration)));
    conveyor.objectAtSync();
    conveyor.setSpeed(speed);
    state.braking = scheduler.after(travel, [&conveyor] { conveyor.setSpeed(0); });
}

void disable(Controller& controller, Indexing& state) {
    if (state.listener != 0) controller.io().removeListener(std::exchange(state.listener, 0));
}

Status wrongOrder(TaskCore* task, const Conveyor& conveyor, const char* instruction, const char* first) {
    return lib::fail(task, err::ERR_INDCNV_ORDER,
                     std::string(instruction) + ": " + conveyor.name() + " is not ready for it; use " +
                         first + " first");
}

/// A conveyor in indexing mode that is initialised. `status` is what to return for any other unit.
struct Initialised {
    Initialised(TaskCore* task, Handle unit, const char* instruction)
        : controller(taskOf(task).controller()), conveyor(lib::conveyorUnit(task, unit, status)) {
        auto& all = indexing(controller).all;
        const auto found = all.find(conveyor);
        if (found != all.end())
            state = &found->second;
        else if (conveyor != nullptr)
            status = wrongOrder(task, *conveyor, instruction, "IndCnvInit");
    }
    explicit operator bool() const { return state != nullptr; }

    Status status = kOk;
    Controller& controller;
    Conveyor* conveyor;
    Indexing* state = nullptr;
};

} // namespace

namespace rt::lib {

void resetIndexing(Controller& controller) {
    for (auto& [conveyor, state] : indexing(controller).all)
        disable(controller, state);
    indexing(controller).all.clear();
}

} // namespace rt::lib

extern "C" {

/// The meaning of the data is not known: step, speed and input are settings of the simulated conveyor.
Status rt_IndCnvInit(TaskCore* task, Handle* MechUnit, Handle*) {
    Status status = kOk;
    Conveyor* conveyor = lib::conveyorUnit(task, *MechUnit, status);
    if (conveyor == nullptr) return status;
    if (!conveyor->isActive())
        return lib::fail(task, err::ERR_CNV_NOT_ACT,
                         conveyor->name() + " is not activated; use ActUnit first");
    auto& all = indexing(taskOf(task).controller()).all;
    if (all.contains(conveyor)) return wrongOrder(task, *conveyor, "IndCnvInit", "IndCnvReset");
    all[conveyor] = {};
    conveyor->setSpeed(0);
    return kOk;
}

Status rt_IndCnvEnable(TaskCore* task, Handle* MechUnit) {
    const Initialised found(task, *MechUnit, "IndCnvEnable");
    if (!found) return found.status;
    Controller& controller = found.controller;
    Conveyor* conveyor = found.conveyor;
    if (found.state->listener != 0) return wrongOrder(task, *conveyor, "IndCnvEnable", "IndCnvDisable");
    const std::string& input = conveyor->settings().trigger;
    const SignalId id = controller.io().find(input);
    if (id < 0)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "no digital input orders the steps of " + conveyor->name() +
                             "; name one with --conveyor=" + conveyor->name() + "=trigger:SIGNAL");
    found.state->listener =
        controller.io().addListener(id, [&controller, conveyor](SignalId, double, double value) {
            if (value != 0) step(controller, *conveyor);
        });
    return kOk;
}

Status rt_IndCnvDisable(TaskCore* task, Handle* MechUnit) {
    const Initialised found(task, *MechUnit, "IndCnvDisable");
    if (!found) return found.status;
    if (found.state->listener == 0) return wrongOrder(task, *found.conveyor, "IndCnvDisable", "IndCnvEnable");
    disable(found.controller, *found.state);
    return kOk;
}

Status rt_IndCnvAddObject(TaskCore* task, Handle* MechUnit) {
    const Initialised found(task, *MechUnit, "IndCnvAddObject");
    if (found) found.conveyor->objectAtSync();
    return found.status;
}

Status rt_IndCnvReset(TaskCore* task, Handle* MechUnit) {
    const Initialised found(task, *MechUnit, "IndCnvReset");
    if (!found) return found.status;
    disable(found.controller, *found.state);
    indexing(found.controller).all.erase(found.conveyor);
    return kOk;
}
}
