#pragma once
// /rw/rapid/execution: start, stop, steps, program pointer to main, cycle.

#include "tools/rws/access.h"
#include "tools/rws/programs.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::rws {

class Execution {
  public:
    /// `programs` has the breakpoints.
    Execution(service::VirtualController& controller, const Access& access, Programs& programs)
        : controller_(controller), access_(access), programs_(programs) {}

    void addTo(Router& router, Subscribables& subscribables);

  private:
    Reply start(const Request& request);
    Reply stop(const Request& request);
    Reply setCycle(const Request& request);
    Reply startFromMain();

    service::VirtualController& controller_;
    const Access& access_;
    Programs& programs_;
};

} // namespace rapidc::rws
