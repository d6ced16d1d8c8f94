#pragma once
// Control stations of RobotWare 8: a client registers as one, and one of them at a time has write access. Below RobotWare 8 there is no such
// resource.

#include "tools/rws/mastership.h"
#include "tools/rws/router.h"
#include "tools/service/virtual_controller.h"

#include <map>
#include <optional>
#include <string>

namespace rapidc::rws {

class ControlStations {
  public:
    ControlStations(const service::VirtualController& controller, Mastership& mastership)
        : controller_(controller), mastership_(mastership) {}

    void addTo(Router& router);
    void sessionEnded(uint64_t session) { stations_.erase(session); }
    /// Why the station of the session may not write. `hasAccess`: it has write access, `isHeld`: another client has.
    std::optional<Failure> refusal(uint64_t session, bool hasAccess, bool isHeld) const;

  private:
    struct Station {
        std::string name, id;
    };
    Reply registerRemote(const Request& request);
    Reply requestAccess(const Request& request);
    Reply releaseAccess(const Request& request);
    Reply status(const Request& request) const;
    /// The handler, with RobotWare 8.
    Handler only8(Handler handler) const;
    bool hasAccess(uint64_t session) const { return mastership_.isHeldBy(Domain::Rapid, session); }
    const Station* find(uint64_t session) const;

    const service::VirtualController& controller_;
    Mastership& mastership_;
    std::map<uint64_t, Station> stations_; ///< by session
    uint64_t appeals_ = 0;
    bool externalControl_ = true, motionControl_ = true;
};

} // namespace rapidc::rws
