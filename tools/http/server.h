#pragma once
// Server: HTTP/1.1 and WebSockets on one network thread, for any number of ports, with or without TLS.
//
//     class Hello : public http::Service {
//         http::Decision decide(const http::Head&) override { return {}; }
//         void handle(http::Request request, http::Respond respond) override { respond(http::Response::text(200, "hello")); }
//     } hello;
//     http::Server server;
//     uint16_t port = 0;
//     if (std::string why = server.listen({.service = &hello}, port); !why.empty()) ...
//     server.start();
//
// Services are called on the network thread and must not wait; they answer at any time from any thread.

#include "tools/http/message.h"
#include "tools/http/request_parser.h"
#include "tools/http/web_socket.h"

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace rapidc::http {

class TlsIdentity;

/// The decision of a service when it has seen a header.
struct Decision {
    /// Answers now; the body is read and dropped, so that clients which send first and read then get the answer.
    std::optional<Response> answer = {};
    /// Becomes a WebSocket.
    std::optional<Upgrade> upgrade = {};
    std::size_t bodyLimit = 64 * 1024 * 1024; ///< bytes; a larger one is answered 413
    std::shared_ptr<void> context = {};       ///< for Request::context
};

/// Answers a request; from any thread, once. When it is dropped, the client gets 503.
using Respond = std::function<void(Response)>;

class Service {
  public:
    virtual ~Service() = default;
    virtual Decision decide(const Head& head) = 0;
    virtual void handle(Request request, Respond respond) = 0;
    /// A TCP connection of this service has ended.
    virtual void connectionEnded(uint64_t /*connection*/) {}
    /// The body of a response to a request that the server itself refuses (400, 413, 431 ..).
    virtual Response refusal(int status, const std::string& reason);
};

struct Endpoint {
    std::string address = "127.0.0.1";           ///< of a network interface
    uint16_t port = 0;                           ///< 0: any free one
    std::shared_ptr<const TlsIdentity> tls = {}; ///< null: plain
    Service* service = nullptr;
};

class Server {
  public:
    explicit Server(Limits limits = {});
    /// Stops.
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// Opens a port before start(). "" and the port that was taken, or why it cannot be opened.
    std::string listen(const Endpoint& endpoint, uint16_t& port);
    /// Begins to serve, on a thread of its own.
    void start();
    /// From any other thread: closes the sockets and connections; ready within half a second. Services are not called any more.
    void stop();

    /// From any thread: executes something on the network thread; dropped after stop().
    void post(std::function<void()> command);
    /// Before start(): executes something on the network thread again and again.
    void every(std::chrono::milliseconds period, std::function<void()> command);

  private:
    struct Core;
    std::shared_ptr<Core> core_;
};

} // namespace rapidc::http
