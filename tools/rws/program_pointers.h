#pragma once
// /rw/rapid/tasks/T/pcp: program pointer and motion pointer, and how the program pointer is moved.

#include "tools/rws/access.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::rws {

class ProgramPointers {
  public:
    ProgramPointers(service::VirtualController& controller, const Access& access)
        : controller_(controller), access_(access) {}

    void addTo(Router& router, Subscribables& subscribables);

  private:
    Reply show(const Request& request);
    Reply toRoutine(const Request& request);
    Reply toUrl(const Request& request);
    Reply toCursor(const Request& request);
    Reply toMain(const Request& request);
    Reply along(const Request& request, bool forward);
    Reply toLine(rt::Task& task, const std::string& module, uint32_t line);

    service::VirtualController& controller_;
    const Access& access_;
};

} // namespace rapidc::rws
