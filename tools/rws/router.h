#pragma once
// Router: patterns of paths -> handlers. Fixed segments are compared without regard to case.

#include "tools/rws/message.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rapidc::rws {

using Handler = std::function<Reply(const Request&)>;

/// The thread that executes a handler.
enum class Where : uint8_t {
    Controller, ///< the thread of the scheduler, between the tasks: may touch the controller; must end within a millisecond or so
    Disk,       ///< a worker: files; may not touch the controller
};

struct Route {
    Method method = Method::Get;
    std::string pattern; ///< "/rw/rapid/tasks/{task}/pcp"; "{path*}" at the end takes all further segments
    std::string action;  ///< of RWS 1.0: POST pattern?action=NAME; "" = a request without action
    Handler handler;
    Where where = Where::Controller;
    bool withoutLogin = false;
};

class Router {
  public:
    /// Adds a route for one dialect or for both. A later route with the same method, pattern and action replaces the earlier one.
    void add(Dialect dialect, Route route);
    void addBoth(const Route& route);

    // Short forms; handlers run on the controller's thread.
    void get(Dialect dialect, std::string pattern, Handler handler);
    void post(Dialect dialect, std::string pattern, Handler handler);
    void action(std::string pattern, std::string action, Handler handler); ///< RWS 1.0: POST pattern?action=
    void getBoth(std::string pattern, const Handler& handler);
    void postBoth(std::string pattern, const Handler& handler);

    struct Match {
        const Route* route = nullptr; ///< null: none
        bool pathKnown = false;       ///< another method has this path: 405
    };
    /// The most specific route: fixed segments win over parameters, those over {path*}. Fills request.parameters.
    Match find(Request& request) const;

  private:
    std::vector<Route> routes_[2];
};

} // namespace rapidc::rws
