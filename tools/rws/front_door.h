#pragma once
// FrontDoor: what both dialects of Robot Web Services have in common before a handler is called: log on, sessions, limits, forms of requests
// and replies (serve-contract 11 to 19).
//
//     rws::FrontDoor door({.password = "robotics", .postToController = ..., .postToNetwork = ...}, router);
//     server.listen({.service = &door.service(rws::Dialect::V1)}, port);
//     server.every(std::chrono::seconds(1), [&] { door.tick(); });
//
// All of it runs on the network thread; handlers run where their route says.

#include "tools/http/server.h"
#include "tools/rws/accounts.h"
#include "tools/rws/negotiation.h"
#include "tools/rws/router.h"
#include "tools/rws/sessions.h"
#include "tools/rws/workers.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rapidc::rws {

/// Takes requests for event sockets (subscriptions).
class SocketGate {
  public:
    virtual ~SocketGate() = default;
    /// The path "/poll/ID" of a session. None: refused, with the status in `status`.
    virtual std::optional<http::Upgrade> upgrade(const http::Head& head, const std::string& path,
                                                 std::shared_ptr<const Session> session, int& status) = 0;
};

struct FrontDoorSettings {
    std::string password;
    /// Executes something on the controller's thread.
    std::function<void(std::function<void()>)> postToController;
    /// Executes something on the network thread, which renders the replies: the controller has a cycle to keep.
    std::function<void(std::function<void()>)> postToNetwork;
    /// Of numbers that have ended; called on the network thread.
    std::function<void(uint64_t)> sessionEnded, connectionEnded;
    /// Before the first request of a session; called on the network thread.
    std::function<void(std::shared_ptr<const Session>)> sessionBegan;
};

class FrontDoor {
  public:
    /// The router must be complete and must outlive the door.
    FrontDoor(FrontDoorSettings settings, const Router& router);
    ~FrontDoor();
    FrontDoor(const FrontDoor&) = delete;
    FrontDoor& operator=(const FrontDoor&) = delete;

    http::Service& service(Dialect dialect);
    void setSockets(SocketGate* sockets) { sockets_ = sockets; }
    /// A session with open sockets does not expire.
    void countSockets(uint64_t session, int change);
    /// The controller restarts: all sessions end. On the controller's thread.
    void endSessions();
    /// Once a second.
    void tick() { sessions_.expire(); }

  private:
    class Side;
    /// A request between its header and its body.
    struct Visit {
        std::shared_ptr<const Session> session; ///< null: the route needs none
        std::string path;
        std::vector<std::string> segments;
        http::FieldList query;
        std::optional<Form> form; ///< of the reply; none: it has no accepted one
        http::FieldList cookies;  ///< headers that set them
    };
    http::Decision decide(Dialect dialect, const http::Head& head);
    static std::optional<Form> askedForm(Dialect dialect, const http::Head& head, const Visit& visit);
    std::optional<http::Response> admit(Dialect dialect, const http::Head& head, Visit& visit);
    std::optional<http::Response> logOn(Dialect dialect, const http::Head& head, Visit& visit);
    void handle(Dialect dialect, http::Request& request, const http::Respond& respond);
    http::Response methodsOf(Dialect dialect, const Visit& visit) const;
    std::optional<http::Response> complete(Dialect dialect, http::Request& from, const Visit& visit,
                                           Request& request) const;
    void execute(const Route& route, Request request, const std::shared_ptr<Visit>& visit,
                 const http::Respond& respond);
    http::Response challenge(Dialect dialect, bool stale);
    bool hasEnded(const Session& session) const { return session.restarts < restarts_; }

    FrontDoorSettings settings_;
    const Router& router_;
    Accounts accounts_;
    Sessions sessions_;
    Workers workers_;
    SocketGate* sockets_ = nullptr;
    std::atomic<uint64_t> restarts_{0}; ///< of the controller
    std::unique_ptr<Side> sides_[2];
};

} // namespace rapidc::rws
