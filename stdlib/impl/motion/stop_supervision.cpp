// TriggStopProc (manual 1.8): at a stop of the program the values of process signals are noted, when it begins and when the
// arm is at rest; then the signals are set to 0. The values that a RESTART routine needs to begin a process again.

#include "stdlib/impl/io/signals.h"
#include "stdlib/impl/motion/state.h"
#include "stdlib/impl/motion/triggers.h"
#include "stdlib/impl/support/fail.h"

#include "natives/triggers.h"
#include "stdlib_constants.h"

#include <array>
#include <utility>
#include <vector>

using namespace rt;

namespace {

constexpr float kNoValue = -1; // of a signal that is not supervised, and as long as there was no stop
constexpr std::size_t kSignals = 5;

struct Supervised {
    data::Restartdata* data = nullptr;
    std::array<Handle, kSignals> signals{}; ///< DO1, GO1 to GO4; 0 = not given
    Handle shadow = 0;
};

std::array<float*, kSignals> before(data::Restartdata& d) {
    return {&d.predo1val, &d.prego1val, &d.prego2val, &d.prego3val, &d.prego4val};
}

std::array<float*, kSignals> after(data::Restartdata& d) {
    return {&d.postdo1val, &d.postgo1val, &d.postgo2val, &d.postgo3val, &d.postgo4val};
}

class StopSupervision {
  public:
    /// In place of an earlier one with the same data.
    void add(Controller& controller, MotionDriver& motion, const Supervised& supervised) {
        if (std::exchange(motion_, &motion) == nullptr)
            motion.addListener([this, &controller](ArmChange news) { take(controller, news); });
        std::erase_if(all_, [&](const Supervised& known) { return known.data == supervised.data; });
        all_.push_back(supervised);
        invalidate(*supervised.data);
    }

    void clear() { all_.clear(); }

  private:
    static void invalidate(data::Restartdata& data) {
        data = {};
        for (float* value : before(data))
            *value = kNoValue;
        for (float* value : after(data))
            *value = kNoValue;
        data.preshadowval = data.shadowflanks = data.postshadowval = kNoValue;
    }

    void take(Controller& controller, ArmChange news) {
        switch (news) {
        case ArmChange::Start:
            if (braking_) end(controller); // started before the arm stood
            stopped_ = false;
            return;
        case ArmChange::MotorsOff: onPath_ = false; [[fallthrough]];
        case ArmChange::StopOnPath:
            if (std::exchange(stopped_, true)) return;
            onPath_ = news == ArmChange::StopOnPath;
            begin(controller);
            [[fallthrough]];
        case ArmChange::PowerFailed:
        case ArmChange::CornerLost:
        case ArmChange::Override:
        case ArmChange::OutOfReach:
        case ArmChange::Event:
            if (braking_ && !motion_->system().isMoving()) end(controller);
            return;
        }
    }

    void begin(Controller& controller) {
        braking_ = true;
        IoSystem& io = controller.io();
        for (const Supervised& watched : all_) {
            note(io, watched, before(*watched.data));
            watched.data->preshadowval = static_cast<float>(io.value(io.idOf(watched.shadow)));
            watched.data->shadowflanks = 0;
        }
        listener_ = io.addListener(-1, [this, &io](SignalId id, double, double) {
            for (const Supervised& watched : all_)
                if (io.idOf(watched.shadow) == id) watched.data->shadowflanks += 1;
        });
    }

    void end(Controller& controller) {
        braking_ = false;
        IoSystem& io = controller.io();
        io.removeListener(listener_);
        for (const Supervised& watched : all_) {
            data::Restartdata& data = *watched.data;
            note(io, watched, after(data));
            data.postshadowval = static_cast<float>(io.value(io.idOf(watched.shadow)));
            data.restartstop = true;
            data.stoponpath = onPath_;
            for (const Handle signal : watched.signals)
                if (signal != 0) (void)io.set(signal, 0); // checked by TriggStopProc
        }
    }

    static void note(const IoSystem& io, const Supervised& what, const std::array<float*, kSignals>& values) {
        for (std::size_t i = 0; i < kSignals; ++i)
            *values[i] =
                what.signals[i] == 0 ? kNoValue : static_cast<float>(io.value(io.idOf(what.signals[i])));
    }

    std::vector<Supervised> all_;
    uint64_t listener_ = 0;
    MotionDriver* motion_ = nullptr; // known when the first one is supervised
    bool stopped_ = false, braking_ = false, onPath_ = true;
};

} // namespace

namespace rt::lib {

void endStopSupervision(Task& task) {
    task.controller().motion(task).service<StopSupervision>().clear();
}

} // namespace rt::lib

extern "C" {

Status rt_TriggStopProc(TaskCore* task, data::Restartdata* RestartRef, Handle* DO1, Handle* GO1, Handle* GO2,
                        Handle* GO3, Handle* GO4, Handle* ShadowDO) {
    Controller& controller = taskOf(task).controller();
    Supervised supervised{RestartRef, {}, *ShadowDO};
    Status status = kOk;
    (void)lib::usableSignal(task, *ShadowDO, status);
    if (status != kOk) return status;
    const std::array<const Handle*, kSignals> signals{DO1, GO1, GO2, GO3, GO4};
    bool any = false;
    for (std::size_t i = 0; i < kSignals; ++i) {
        if (signals[i] == nullptr) continue;
        any = true;
        supervised.signals[i] = *signals[i];
        if (const Status refused = lib::checkOutputNow(task, *signals[i], 0)) return refused;
    }
    if (!any)
        return lib::fail(task, err::ERR_ARGVALERR,
                         "TriggStopProc needs a process signal: at least one of \\DO1 and \\GO1 to \\GO4");
    MotionDriver& motion = lib::motionOf(task);
    motion.service<StopSupervision>().add(controller, motion, supervised);
    return kOk;
}
}
