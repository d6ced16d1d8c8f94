#pragma once
// /rw/rapid/tasks: the tasks and their states, activation, loading and unloading of modules, pointers.

#include "tools/rws/access.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::rws {

class Tasks {
  public:
    Tasks(service::VirtualController& controller, const Access& access)
        : controller_(controller), access_(access) {}

    void addTo(Router& router, Subscribables& subscribables);

  private:
    void addCounters(Router& router);
    void subscribe(Subscribables& subscribables);
    Reply list(const Request& request);
    Reply show(const Request& request);
    static Reply synchronisation(const Request& request);
    Reply activate(const Request& request, bool active);
    Reply loadModule(const Request& request);
    Reply unloadModule(const Request& request);
    Reply activationRecord(const Request& request);
    Reply routines(const Request& request);
    Reply selection(const Request& request);
    Reply select(const Request& request);
    void describe(const rt::Task& task, Dialect dialect, Entry& entry) const;
    std::string parameterOf(const rt::Task& task, const char* name, const char* otherwise) const;

    service::VirtualController& controller_;
    const Access& access_;
};

} // namespace rapidc::rws
