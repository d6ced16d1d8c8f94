#pragma once
// Modules of a task: list, text and parts of it, changes, saving. RWS 1.0: /rw/rapid/modules?task=T; RWS 2.0: /rw/rapid/tasks/T/modules.

#include "tools/rws/access.h"
#include "tools/rws/router.h"
#include "tools/service/virtual_controller.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace rapidc::rws {

class Modules {
  public:
    Modules(service::VirtualController& controller, const Access& access)
        : controller_(controller), access_(access) {}

    void addTo(Router& router);

  private:
    /// A module that a request names, with its text.
    struct Asked {
        rt::Task* task = nullptr;
        const rt::LoadedModule* module = nullptr;
        std::string text;
    };
    using Method = Reply (Modules::*)(const Request&, const Asked&);
    /// Finds the module first.
    Handler with(Method method);
    Reply list(const Request& request);
    Reply showOld(const Request& request, const Asked& asked);
    Reply show(const Request& request, const Asked& asked);
    Reply text(const Request& request, const Asked& asked);
    Reply keepValues(const Request& request, const Asked& asked);
    Reply range(const Request& request, const Asked& asked);
    Reply search(const Request& request, const Asked& asked);
    Reply routine(const Request& request, const Asked& asked);
    Reply changeCount(const Request& request, const Asked& asked);
    Reply extension(const Request& request, const Asked& asked);
    Reply setText(const Request& request, const Asked& asked);
    Reply setRange(const Request& request, const Asked& asked);
    Reply save(const Request& request, const Asked& asked);
    Reply modify(const Request& request, const Asked& asked);
    bool isSystem(const rt::Task& task, const rt::LoadedModule& module);
    void describe(const rt::Task& task, const rt::LoadedModule& module, Document& document);

    service::VirtualController& controller_;
    const Access& access_;
};

} // namespace rapidc::rws
