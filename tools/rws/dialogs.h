#pragma once
// /rw/rapid/uiinstr: operator dialogs, their texts, and answers from a client.

#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::rws {

class Dialogs {
  public:
    explicit Dialogs(service::VirtualController& controller) : controller_(controller) {}

    void addTo(Router& router, Subscribables& subscribables);

  private:
    Reply active(const Request& request);
    Reply parameters(const Request& request);
    Reply parameter(const Request& request);
    Reply answer(const Request& request);

    service::VirtualController& controller_;
};

} // namespace rapidc::rws
