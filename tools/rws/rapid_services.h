#pragma once
// RapidServices: all resources around RAPID and people, in the order in which they need each other.

#include "tools/rws/access.h"
#include "tools/rws/control_stations.h"
#include "tools/rws/dialogs.h"
#include "tools/rws/execution.h"
#include "tools/rws/mastership.h"
#include "tools/rws/mastership_resources.h"
#include "tools/rws/modules.h"
#include "tools/rws/panel.h"
#include "tools/rws/program_pointers.h"
#include "tools/rws/programs.h"
#include "tools/rws/queues.h"
#include "tools/rws/symbol_resources.h"
#include "tools/rws/tasks.h"
#include "tools/rws/users.h"

namespace rapidc::rws {

class RapidServices {
  public:
    explicit RapidServices(service::VirtualController& controller);
    RapidServices(const RapidServices&) = delete;
    RapidServices& operator=(const RapidServices&) = delete;

    void addTo(Router& router, Subscribables& subscribables);
    /// For resources elsewhere that change something.
    const Access& access() const { return access_; }
    /// Shared with the web page.
    service::BreakpointList& breakpoints() { return breakpoints_; }

    // On the controller's thread:
    void sessionBegan(std::shared_ptr<const Session> session);
    /// A session was closed, or has expired.
    void sessionEnded(uint64_t session);
    /// The controller restarts: masterships end, those requested with an id too.
    void controllerRestarts() { mastership_.releaseAll(); }
    /// A TCP connection of RWS 1.0 was closed.
    void connectionClosed(uint64_t connection);

  private:
    service::VirtualController& controller_;
    Mastership mastership_;
    Users users_;
    ControlStations stations_;
    Access access_;
    MastershipResources mastershipResources_;
    Panel panel_;
    service::BreakpointList breakpoints_;
    Programs programs_;
    Execution execution_;
    Tasks tasks_;
    ProgramPointers pointers_;
    Modules modules_;
    SymbolResources symbols_;
    Dialogs dialogs_;
    Queues queues_;
};

} // namespace rapidc::rws
