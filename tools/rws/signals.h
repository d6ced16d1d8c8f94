#pragma once
// Signals: /rw/iosystem/signals, what clients read, set, simulate, search and subscribe to.

#include "tools/rws/router.h"
#include "tools/rws/signal_watches.h"
#include "tools/rws/subscribable.h"
#include "tools/service/virtual_controller.h"

#include <functional>
#include <string>
#include <vector>

namespace rapidc::rws {

class Signals {
  public:
    explicit Signals(service::VirtualController& controller)
        : controller_(controller), watches_(controller) {}
    void addTo(Router& router, Subscribables& subscribables);

  private:
    rt::IoSystem& io() const { return controller_.core().io(); }
    /// The signal that "name" or "net/dev/name" means; a failure when there is none.
    std::optional<Failure> find(const Request& request, rt::SignalId& signal) const;
    Reply list(const Request& request, const std::vector<rt::SignalId>& signals) const;
    Reply listAll(const Request& request) const;
    void describeWhole(rt::SignalId signal, Entry& entry) const;
    Reply one(const Request& request) const;
    Reply configuration(const Request& request) const;
    /// RWS 1.0 `set`: mode=simulated and mode=value too. RWS 2.0 `set-value`.
    Reply set(const Request& request);
    Reply setState(const Request& request);
    Reply endAllSimulations(const Request& request);
    /// `sets`: one set of criteria, or two of which the second narrows.
    Reply search(const Request& request, int sets) const;
    std::optional<Failure> simulate(rt::SignalId signal, bool on);
    std::optional<Failure> setValue(rt::SignalId signal, const std::string& text);
    /// Why no client may set the signal; none when it may.
    std::optional<Failure> forbidden(rt::SignalId signal) const;
    bool levelLetsClientsWrite(const std::string& level) const;
    void addSubscription(Subscribables& subscribables);

    service::VirtualController& controller_;
    SignalWatches watches_;
};

/// "net/dev/name"; the bare name of a signal without device.
std::string signalTitle(const rt::IoSystem& io, rt::SignalId signal);

} // namespace rapidc::rws
