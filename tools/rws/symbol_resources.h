#pragma once
// /rw/rapid/symbol and /rw/rapid/symbols: values and properties of data, types and routines, search. RWS 1.0 puts the symbol at the end of the
// path, RWS 2.0 in the middle.

#include "tools/rws/access.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/data_watches.h"
#include "tools/service/symbols.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::rws {

class SymbolResources {
  public:
    SymbolResources(service::VirtualController& controller, const Access& access)
        : controller_(controller), access_(access), symbols_(controller), watches_(controller) {}

    void addTo(Router& router, Subscribables& subscribables);

  private:
    Reply value(const Request& request);
    Reply setValue(const Request& request);
    Reply validate(const Request& request);
    Reply properties(const Request& request);
    Reply search(const Request& request);
    Reply unknown(const Request& request, const std::string& why) const;
    std::optional<Failure> subscribe(const Request& request, const Changed& changed, Subscription& out);

    service::VirtualController& controller_;
    const Access& access_;
    service::Symbols symbols_;
    service::DataWatches watches_;
};

} // namespace rapidc::rws
