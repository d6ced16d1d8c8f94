#pragma once
// The common part of the instructions that order interrupts (manual 1.11).

#include "runtime/host/controller.h"

#include <functional>

namespace rt::lib {

/// InterruptOrder::kind
inline constexpr const char* kAnalogOrder = "ISignalAI";
inline constexpr const char* kPersistentOrder = "IPers";
inline constexpr const char* kErrorOrder = "IError";
inline constexpr const char* kMessageOrder = "IRMQMessage";
inline constexpr const char* kTriggerOrder = "TriggInt";
inline constexpr std::size_t kMostArguments = 6; ///< of InterruptOrder::numbers

struct OrderKind {
    bool single = false; ///< only the first occurrence
    bool safe = false;   ///< kept while the task is stopped; single as well
};

/// The number in an interrupt variable; 0, which is not an interrupt, for what cannot be one.
int numberOf(const float* interrupt);
/// The number an interrupt variable is ordered by. A variable that is not connected with a trap routine gets a
/// number too: it may be ordered, but its occurrence is fatal. 0 and ERR_INOMAX (in `status`) when 100 are defined.
int numberToOrder(TaskCore* task, float* interrupt, Status& status);
/// Orders `number` (from numberToOrder); `disarm` ends what was armed.
/// `what`: how a later process can order it again (orderAgain); empty: it cannot.
Status orderInterrupt(TaskCore* task, int number, OrderKind kind, std::function<void()> disarm,
                      InterruptOrder what);
/// Orders an interrupt of an earlier process again (--state). False: it cannot be done.
bool orderAgain(Task& task, int number, bool single, bool safe, const InterruptOrder& order);
/// ERR_UNKINO: the variable is not connected.
Status unknownInterrupt(TaskCore* task);

} // namespace rt::lib
