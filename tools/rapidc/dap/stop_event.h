#pragma once
// The event "stopped" of the protocol.

#include "tools/rapidc/dap/messages.h"

namespace rt {
class Task;
enum class StopReason : uint8_t;
} // namespace rt

namespace rapidc::dap {

/// The body of "stopped" for a stop of `task` that stopped all of them.
Json stopEvent(rt::StopReason reason, const rt::Task& task);

} // namespace rapidc::dap
