#pragma once
// State of one signal, private to IoSystem.

#include "runtime/io/io_system.h"
#include "runtime/sched/scheduler.h"

namespace rt {

/// A change ordered for later; at most one per signal.
enum class Pending : uint8_t { None, Delay, Pulse };

struct IoSystem::Signal {
    SignalConfig config;
    double value = 0;
    bool deviceOff = false; ///< or without contact
    bool invalid = false;
    bool driven = false; ///< result of a cross connection
    bool isSimulated = false;
    double plantValue = 0; ///< of a simulated input: what it would be without the simulation
    Pending pending = Pending::None;
    EventToken event = 0;
    WaitQueue changed;
};

} // namespace rt
