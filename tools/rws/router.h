#pragma once
// Router: patterns of paths -> handlers. Fixed segments are compared without regard to case.

#include "tools/rws/message.h"
#include "tools/rws/path_pattern.h"

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
    std::string
        pattern; ///< "/rw/rapid/tasks/{task}/pcp"; one "{path*}" takes one or more segments: "/fileservice/{path*}"
    /// pattern?action=NAME; "" = a request without action, and any GET or request of RWS 2.0 whose action has no route of its own.
    std::string action;
    Handler handler = {};
    Where where = Where::Controller;
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
        bool pathKnown = false;       ///< a route of any method has this path: 405 when the method has none
        bool methodKnown = false;     ///< the method too, but not the action: 400
    };
    /// The most specific route: fixed segments win over parameters, those over {path*}. Fills request.parameters.
    Match find(Request& request) const;
    /// Whether a route of that method has the path.
    bool has(Dialect dialect, Method method, const std::vector<std::string>& segments) const;

  private:
    struct Compiled {
        PathPattern pattern;
        Route route;
    };
    std::vector<Compiled> routes_[2]; ///< by dialect, the most specific first
};

} // namespace rapidc::rws
