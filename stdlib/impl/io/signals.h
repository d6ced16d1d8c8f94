#pragma once
// From the results of the I/O system to RAPID's errors (manual 1.9).

#include "runtime/host/controller.h"

namespace rt {
struct StateKeepers;
}

namespace rt::lib {

/// kOk, or the error raised; `handle` is the signal concerned.
Status ioStatus(TaskCore* task, IoResult result, Handle handle);
/// The signal that a variable refers to; -1 and ERR_NO_ALIASIO_DEF raised (in `status`) when there is none.
SignalId signalOf(TaskCore* task, Handle handle, Status& status);
/// The same, and the signal can be used now; else ERR_NORUNUNIT or ERR_SIG_NOT_VALID raised as well.
SignalId usableSignal(TaskCore* task, Handle handle, Status& status);
/// Value of a signal.
Status readSignal(TaskCore* task, Handle handle, double& value);

/// kOk when a group may get this value as far as it is a whole number; else ERR_ARGVALERR.
Status checkWhole(TaskCore* task, double value);

/// Name of the signal that a handle refers to; empty when there is none.
std::string signalName(const IoSystem& io, Handle handle);
/// 0 when there is no signal of that name.
Handle signalNamed(const IoSystem& io, const std::string& name);

/// Signal variables (AliasIO) between two processes (--state): they stand for the signal of the same name.
void keepSignalVariables(Controller& controller, StateKeepers& kept);

} // namespace rt::lib
