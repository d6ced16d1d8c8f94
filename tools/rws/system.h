#pragma once
// System: /rw/system, /rw/retcode and /ctrl: names, versions, options, clock, virtual time, restart, environment variables.

#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/file_volumes.h"
#include "tools/service/system_facts.h"
#include "tools/service/virtual_controller.h"

#include <optional>

namespace rapidc::rws {

class System {
  public:
    /// All of them must outlive the routes.
    System(service::VirtualController& controller, const service::FileVolumes& volumes);
    ~System();
    void addTo(Router& router, Subscribables& subscribables);

  private:
    /// Clients ask often: found out once for each generation of the controller.
    const service::SystemFacts& facts() const;
    void addSystem(Router& router);
    void addControl(Router& router);
    void addVirtualTime(Router& router);
    Reply system(const Request& request) const;
    Reply options(const Request& request) const;
    Reply products(const Request& request) const;
    Reply returnCode(const Request& request) const;
    Reply identity(const Request& request, Document::Place place) const;
    Reply clock(const Request& request) const;
    Reply setClock(const Request& request);
    Reply restart(const Request& request);
    Reply environment(const Request& request) const;
    Reply setTimeState(const Request& request);
    Reply setTimeSpeed(const Request& request);

    service::VirtualController& controller_;
    const service::FileVolumes& volumes_;
    service::Observers::Token token_;
    int64_t clockOffset_ = 0; ///< s by which clients have moved the clock; a restart keeps it
    uint64_t restarts_ = 0;
    mutable std::optional<service::SystemFacts> facts_;
};

} // namespace rapidc::rws
