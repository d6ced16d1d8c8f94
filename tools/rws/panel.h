#pragma once
// /rw/panel: motors, operating mode, speed ratio, collision detection; what only virtual controllers have: the stops and the lock of the mode.

#include "tools/rws/access.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::rws {

class Panel {
  public:
    Panel(service::VirtualController& controller, const Access& access)
        : controller_(controller), access_(access) {}

    void addTo(Router& router, Subscribables& subscribables);

  private:
    void addMode(Router& router);
    void addStops(Router& router);
    void subscribe(Subscribables& subscribables);
    Reply setMotors(const Request& request);
    Reply setMode(const Request& request);
    Reply setSpeedRatio(const Request& request);
    Reply lock(const Request& request);
    Reply restart(const Request& request);
    /// State off opens the chain (engages the stop), on closes it.
    Reply setChain(const Request& request, void (service::VirtualController::*order)(bool));

    service::VirtualController& controller_;
    const Access& access_;
    bool locked_ = false;
};

} // namespace rapidc::rws
