#pragma once
// PolledStates: subscriptions to states that report no changes of their own (I/O networks, system parameters, work in progress): they
// are read again at an interval. On the controller's thread only.

#include "tools/rws/subscribable.h"

#include <functional>
#include <memory>

namespace rapidc::rws {

/// Subscribes to the entry that `read` makes; it must be cheap. `changed` is called when the entry has other values than at the last poll().
std::optional<Failure> watchPolled(const Subscribables& subscribables, std::function<Entry()> read,
                                   Changed changed, Subscription& out);

} // namespace rapidc::rws
