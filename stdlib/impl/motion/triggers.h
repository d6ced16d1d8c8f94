#pragma once
// triggdata: what is done at a place of the path (manual 1.8). A definition never changes; equal ones are one object, so
// that a program which defines its triggers again and again needs no more room.

#include "runtime/host/controller.h"

#include <compare>
#include <map>
#include <vector>

namespace rt {
struct StateKeepers;
}

namespace rt::lib {

struct TriggerDefinition {
    enum class Kind : uint8_t {
        Output,    ///< TriggIO, TriggEquip: sets `signal` to `value`
        Interrupt, ///< TriggInt
        Ramp,      ///< TriggRampAO: brings `signal` to `value` along `rampLength`
        Speed,     ///< TriggSpeed: `signal` is `value` times the speed of the TCP from here on
        Check,     ///< TriggCheckIO: the interrupt occurs unless `signal` is in `relation` to `value`
    };
    Kind kind = Kind::Output;
    motion::PathTrigger place;
    Time delay = 0; ///< \DODelay
    Handle signal = 0;
    double value = 0;
    double rampLength = 0; ///< mm of path, or s
    bool rampInTime = false;
    double dipLag = 0;      ///< s
    Handle errorSignal = 0; ///< 1 while the value does not fit `signal`
    float relation = 0;
    bool stopMove = false;
    int interrupt = 0;
    const bool* inhibit = nullptr; ///< \Inhib: persistent, looked at when the place is passed
    /// \InhibSetValue: the value while inhibited; null: 0. Persistent of this type.
    const void* inhibitValue = nullptr;
    const TypeDesc* inhibitType = nullptr;

    friend auto operator<=>(const TriggerDefinition&, const TriggerDefinition&) = default;
};

/// The definitions of a controller. 0, the initial value of a triggdata, is none.
class TriggerStore {
  public:
    Handle intern(const TriggerDefinition& definition);
    /// Null for a triggdata without contents.
    const TriggerDefinition* find(Handle handle) const;

  private:
    std::map<TriggerDefinition, Handle> handles_;
    std::vector<const TriggerDefinition*> definitions_; // by handle - 1
};

inline TriggerStore& triggerStore(TaskCore* task) {
    return taskOf(task).controller().service<TriggerStore>();
}

/// Adds what the driver is to do for this trigger.
void addActions(TaskCore* task, const TriggerDefinition& definition, std::vector<PathAction>& actions);

/// triggdata variables between two processes (--state).
void keepTriggers(Controller& controller, StateKeepers& kept);

/// An output can be set to this value by a program (ERR_AO_LIM, ERR_GO_LIM ...).
Status checkOutput(TaskCore* task, Handle signal, double value);
/// ... and that it can be set now (ERR_NORUNUNIT, ERR_SIG_NOT_VALID).
Status checkOutputNow(TaskCore* task, Handle signal, double value);
/// The place of a trigger: mm or s, as the program says it. ERR_ARGVALERR when that is not a number or negative.
Status checkDistance(TaskCore* task, float distance);

} // namespace rt::lib
