// Manual 1.8: conveyor tracking, and the part of sensor synchronisation that concerns the object.

#include "stdlib/impl/conveyor/waiting.h"

#include "stdlib/impl/conveyor/tracking.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/support/fail.h"

#include "natives/conveyor.h"
#include "stdlib_constants.h"

using namespace rt;

namespace rt::lib {

namespace {

Status notActive(TaskCore* task, const Conveyor& conveyor) {
    return fail(task, err::ERR_CNV_NOT_ACT, conveyor.name() + " is not activated; use ActUnit first");
}

/// One instruction at a time waits for an object of the conveyor.
class Awaiting {
  public:
    explicit Awaiting(Conveyor& conveyor) : conveyor_(conveyor) { conveyor_.isAwaited = true; }
    ~Awaiting() { conveyor_.isAwaited = false; }
    Awaiting(const Awaiting&) = delete;
    Awaiting& operator=(const Awaiting&) = delete;

  private:
    Conveyor& conveyor_;
};

} // namespace

Status waitForObject(TaskCore* task, Conveyor& conveyor, const ObjectWait& wait) {
    Task& owner = taskOf(task);
    if (wait.flag != nullptr) *wait.flag = false;
    if (!conveyor.isActive()) return notActive(task, conveyor);
    if (conveyor.isAwaited)
        return fail(task, err::ERR_CNV_CONNECT,
                    "another instruction waits for an object of " + conveyor.name() + " already");
    if (wait.maxTime != nullptr && !(*wait.maxTime >= 0))
        return fail(task, err::ERR_ARGVALERR, "\\MaxTime must not be negative");
    const Awaiting awaiting(conveyor);
    bool isConnected = conveyor.connected() != nullptr;
    const auto isOver = [&] {
        if (!conveyor.isActive()) return true;
        if (!isConnected) isConnected = conveyor.connect() != nullptr;
        if (!isConnected) return false;
        if (conveyor.connected() == nullptr) return true; // dropped meanwhile
        const double ahead = wait.leadTime * conveyor.speed();
        return wait.distance == nullptr || conveyor.connectedPosition() + ahead >= *wait.distance - 1e-6;
    };
    const auto watch = [&] {
        if (isOver()) return true;
        if (isConnected && wait.distance != nullptr)
            conveyor.watch(*wait.distance - wait.leadTime * conveyor.speed());
        return false;
    };
    WaitResult result = WaitResult::Done;
    if (!watch()) {
        WaitSpec spec;
        spec.queues = {&conveyor.changed()};
        spec.condition = watch;
        if (wait.maxTime != nullptr) spec.deadline = addTime(owner.now(), fromSeconds(*wait.maxTime));
        if (const Status status = owner.waitFor(spec, result)) return status;
    }
    if (result == WaitResult::Timeout) {
        if (wait.flag == nullptr)
            return fail(task, err::ERR_WAIT_MAXTIME,
                        "no object of " + conveyor.name() + " came within \\MaxTime");
        *wait.flag = true;
        return kOk;
    }
    if (!conveyor.isActive()) return notActive(task, conveyor);
    if (conveyor.connected() == nullptr)
        return fail(task, err::ERR_CNV_DROPPED,
                    "the object of " + conveyor.name() + " was dropped while the task waited");
    return kOk;
}

Status dropObject(TaskCore* task, Conveyor& conveyor) {
    if (!conveyor.isActive()) return notActive(task, conveyor);
    if (conveyor.connected() != nullptr)
        conveyor.lose("the program has dropped it, although a movement was in progress. "
                      "Finish movements on the conveyor first");
    return kOk;
}

} // namespace rt::lib

namespace {

/// The conveyor of WaitWObj and DropWObj.
Conveyor* conveyorOf(TaskCore* task, const data::Wobjdata& workObject, Status& status) {
    Conveyor* conveyor = lib::conveyorOf(taskOf(task).controller(), workObject);
    status =
        conveyor != nullptr
            ? kOk
            : lib::fail(task, err::ERR_ARGVALERR,
                        "the work object is not moved by a conveyor; ufprog must be FALSE and ufmec name one "
                        "that PROC.cfg, MOC.cfg or --conveyor defines");
    return conveyor;
}

} // namespace

extern "C" {

Status rt_WaitWObj(TaskCore* task, data::Wobjdata* WObj, const float* RelDist, const float* MaxTime,
                   bool* TimeFlag) {
    Status status = kOk;
    Conveyor* conveyor = conveyorOf(task, *WObj, status);
    if (conveyor == nullptr) return status;
    return lib::waitForObject(task, *conveyor, {RelDist, MaxTime, TimeFlag, 0});
}

Status rt_DropWObj(TaskCore* task, data::Wobjdata* WObj) {
    Status status = kOk;
    Conveyor* conveyor = conveyorOf(task, *WObj, status);
    return conveyor == nullptr ? status : lib::dropObject(task, *conveyor);
}

Status rt_WaitSensor(TaskCore* task, Handle* MechUnit, const float* RelDist, const float* PredTime,
                     const float* MaxTime, bool* TimeFlag) {
    Status status = kOk;
    Conveyor* conveyor = lib::conveyorUnit(task, *MechUnit, status);
    if (conveyor == nullptr) return status;
    return lib::waitForObject(task, *conveyor,
                              {RelDist, MaxTime, TimeFlag, PredTime != nullptr ? *PredTime : 0.0});
}

Status rt_DropSensor(TaskCore* task, Handle* MechUnit) {
    Status status = kOk;
    Conveyor* conveyor = lib::conveyorUnit(task, *MechUnit, status);
    return conveyor == nullptr ? status : lib::dropObject(task, *conveyor);
}
}
