#pragma once
// EventLogPages: /rw/elog, the event log by domains.

#include "tools/rws/progress.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/event_journal.h"
#include "tools/service/file_volumes.h"

namespace rapidc::rws {

class EventLogPages {
  public:
    /// All of them must outlive the routes and all subscriptions. In RWS 2.0 `start` is the number of a page, from 1.
    EventLogPages(service::EventJournal& journal, const service::FileVolumes& volumes, Progress& progress)
        : journal_(journal), volumes_(volumes), progress_(progress) {}
    void addTo(Router& router, Subscribables& subscribables);

  private:
    Reply domains(const Request& request) const;
    void describeDomain(const service::EventDomain& domain, Entry& entry) const;
    Reply domain(int number) const;
    Reply list(const Request& request) const;
    Reply one(const Request& request) const;
    Reply clear(const Request& request);
    Reply clearAll(const Request& request);
    Reply saveRaw(const Request& request) const;

    service::EventJournal& journal_;
    const service::FileVolumes& volumes_;
    Progress& progress_;
};

} // namespace rapidc::rws
