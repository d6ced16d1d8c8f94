#pragma once
// /rw/mastership in both dialects: RWS 1.0 cfg, motion, rapid; RWS 2.0 edit, motion. With RobotWare 8 RWS 2.0 answers 410.

#include "tools/rws/mastership.h"
#include "tools/rws/router.h"
#include "tools/rws/subscribable.h"
#include "tools/service/virtual_controller.h"

namespace rapidc::rws {

class MastershipResources {
  public:
    MastershipResources(service::VirtualController& controller, Mastership& mastership)
        : controller_(controller), mastership_(mastership) {}

    void addTo(Router& router, Subscribables& subscribables);

  private:
    Reply list(const Request& request) const;
    Reply show(const Request& request) const;
    Reply request(const Request& request);
    Reply release(const Request& request);
    Reply requestWithId(const Request& request);
    Reply releaseWithId(const Request& request);
    /// The handler, unless RobotWare 8 has control stations in place of mastership.
    Handler before8(Handler handler) const;
    Entry holderEntry(const char* type, const std::string& name, const std::vector<Domain>& domains) const;
    /// Also whether the session of the request holds them.
    Entry entryOf(const char* type, const Request& request, const std::string& name,
                  const std::vector<Domain>& domains) const;

    service::VirtualController& controller_;
    Mastership& mastership_;
};

} // namespace rapidc::rws
