#pragma once
// /rw/rapid/execution: start, stop, steps, program pointer to main, cycle.

#include "tools/rws/access.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/breakpoint_list.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::rws {

class Execution {
  public:
    Execution(service::VirtualController& controller, const Access& access,
              service::BreakpointList& breakpoints)
        : controller_(controller), access_(access), breakpoints_(breakpoints) {}

    void addTo(Router& router, Subscribables& subscribables);

  private:
    Reply start(const Request& request);
    Reply stop(const Request& request);
    Reply setCycle(const Request& request);
    Reply startFromMain();

    service::VirtualController& controller_;
    const Access& access_;
    service::BreakpointList& breakpoints_;
};

} // namespace rapidc::rws
