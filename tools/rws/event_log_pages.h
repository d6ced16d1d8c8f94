#pragma once
// EventLogPages: /rw/elog, the event log by domains.

#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/event_journal.h"

namespace rapidc::rws {

class EventLogPages {
  public:
    /// The journal must outlive the routes and all subscriptions.
    explicit EventLogPages(service::EventJournal& journal) : journal_(journal) {}
    void addTo(Router& router, Subscribables& subscribables);

  private:
    Reply domains(const Request& request) const;
    Reply list(const Request& request) const;
    Reply one(const Request& request) const;
    Reply clear(const Request& request);
    Reply clearAll(const Request& request);

    service::EventJournal& journal_;
};

} // namespace rapidc::rws
