#include "tools/rws/rapid_services.h"

#include "tools/rws/alias_signals.h"
#include "tools/rws/device_tree.h"
#include "tools/rws/instruction_catalogue.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/rare_states.h"

namespace rapidc::rws {

RapidServices::RapidServices(service::VirtualController& controller)
    : controller_(controller), mastership_(controller.observers()), users_(controller.observers()),
      stations_(controller, mastership_), access_(controller, mastership_, users_, stations_),
      mastershipResources_(controller, mastership_), panel_(controller, access_), breakpoints_(controller),
      programs_(controller, access_, breakpoints_), execution_(controller, access_, breakpoints_),
      tasks_(controller, access_), pointers_(controller, access_), modules_(controller, access_),
      symbols_(controller, access_), dialogs_(controller), queues_(controller) {}

void RapidServices::addTo(Router& router, Subscribables& subscribables) {
    users_.addTo(router, subscribables);
    stations_.addTo(router);
    mastershipResources_.addTo(router, subscribables);
    panel_.addTo(router, subscribables);
    execution_.addTo(router, subscribables);
    tasks_.addTo(router, subscribables);
    pointers_.addTo(router, subscribables);
    modules_.addTo(router);
    programs_.addTo(router);
    symbols_.addTo(router, subscribables);
    dialogs_.addTo(router, subscribables);
    queues_.addTo(router, subscribables);
    addRareStates(controller_, subscribables);
    addAliasSignals(router, controller_);
    addDeviceTree(router, controller_);
    addInstructionCatalogue(router, controller_);
    router.getBoth("/rw/rapid", [](const Request& request) {
        if (request.dialect == Dialect::V2)
            return folder({{"rap-execution-li", "rapid/execution"},
                           {"rap-tasks-li", "rapid/tasks"},
                           {"rap-symbols-li", "rapid/symbols"},
                           {"rap-uiinstr-li", "rapid/uiinstr"},
                           {"rap-aliasio-li", "rapid/aliasio"},
                           {"rap-taskselection-li", "rapid/taskselection"}});
        return folder({{"rap-execution-li", "rapid/execution"},
                       {"rap-tasks-li", "rapid/tasks"},
                       {"rap-modules-li", "rapid/modules"},
                       {"rap-symbol-li", "rapid/symbol"},
                       {"rap-symbols-li", "rapid/symbols"},
                       {"rap-uiinstr-li", "rapid/uiinstr"},
                       {"rap-aliasio-li", "rapid/aliasio"}});
    });
    router.getBoth("/rw/rapid/symbols",
                   [](const Request&) { return folder({{"rap-symbols-li", "symbols/search"}}); });
    router.get(Dialect::V1, "/rw/rapid/symbol", [](const Request&) {
        return folder(
            {{"rap-symboldata-li", "symbol/data"}, {"rap-symbolproperties-li", "symbol/properties"}});
    });
}

void RapidServices::sessionBegan(std::shared_ptr<const Session> session) {
    users_.sessionBegan(std::move(session));
}

void RapidServices::sessionEnded(uint64_t session) {
    mastership_.sessionEnded(session);
    users_.sessionEnded(session);
    stations_.sessionEnded(session);
}

void RapidServices::connectionClosed(uint64_t connection) {
    mastership_.connectionClosed(connection);
}

} // namespace rapidc::rws
