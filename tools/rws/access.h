#pragma once
// Access: whether a client may change something now (serve-contract 38 to 40).

#include "tools/rws/control_stations.h"
#include "tools/rws/mastership.h"
#include "tools/rws/router.h"
#include "tools/rws/users.h"
#include "tools/service/virtual_controller.h"

#include <optional>

namespace rapidc::rws {

class Access {
  public:
    /// All of them must outlive the access.
    Access(const service::VirtualController& controller, const Mastership& mastership, const Users& users,
           const ControlStations& stations)
        : controller_(controller), mastership_(mastership), users_(users), stations_(stations) {}

    /// RWS 1.0: no other client may hold the domain. RWS 2.0: the client holds it (edit: Cfg, Rapid; Motion), or it asks for it with
    /// ?mastership=implicit; with RobotWare 8 its control station has write access. In manual mode changes of data, programs and
    /// configuration need the privilege of /users/rmmp.
    std::optional<Failure> refusal(const Request& request, Domain domain) const;
    /// The handler, for all but those whom another client keeps out: whoever holds no mastership may, too.
    Handler shared(Domain domain, Handler handler) const;
    /// The handler, for those who may. The access must outlive what is returned.
    Handler guarded(Domain domain, Handler handler) const;

  private:
    const service::VirtualController& controller_;
    const Mastership& mastership_;
    const Users& users_;
    const ControlStations& stations_;
};

} // namespace rapidc::rws
