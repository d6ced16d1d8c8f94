#pragma once
// Subscriptions to states of the controller: an observer reads the state again whenever it may have changed.

#include "tools/rws/subscribable.h"
#include "tools/service/observers.h"

#include <functional>
#include <optional>
#include <set>

namespace rapidc::rws {

/// `read` makes the entry of an event, from the present state. It is called at once, after each of the changes and when the controller
/// has been replaced; `changed` is called when the entry has other values than before.
std::optional<Failure> watchState(service::Observers& observers, std::set<service::Change> changes,
                                  std::function<Entry()> read, Changed changed, Subscription& out);

} // namespace rapidc::rws
