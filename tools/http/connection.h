#pragma once
// Connection: one TCP connection: reads requests one after the other, asks the service, writes the responses. Internal to tools/http:
// it includes Boost. Lives on the network thread.

#include "tools/http/server.h"
#include "tools/http/stream.h"

#include <chrono>
#include <memory>
#include <string>
#include <unordered_map>

namespace rapidc::http {

using Clock = std::chrono::steady_clock;

class Channel;

/// The common state of all connections. They keep it alive, because a response may come after the end of the server.
struct Hub {
    explicit Hub(Limits given) : limits(given) {}
    const Limits limits;
    asio::io_context io{1};
    std::unordered_map<uint64_t, std::shared_ptr<Channel>> channels; ///< by number of the TCP connection
    std::size_t bodyBytes = 0; ///< of all requests that are being read or answered
    bool isStopping = false;
};

/// The protocol of a TCP connection: HTTP, later perhaps a WebSocket.
class Channel {
  public:
    virtual ~Channel() = default;
    /// Ends at once.
    virtual void abort() = 0;
    /// Ends soon, with a farewell when the protocol has one.
    virtual void leave() { abort(); }
    /// Called several times a second.
    virtual void tick(Clock::time_point now) = 0;
    /// Waits for a request: may be ended in favour of others; the time since when.
    virtual std::optional<Clock::time_point> waitsSince() const { return std::nullopt; }
};

struct Peer {
    uint64_t connection = 0;
    std::string address;
    bool secure = false;
};

/// Begins to serve a connection; it registers itself in the hub.
void serve(std::shared_ptr<Hub> hub, Service& service, Stream stream, Peer peer);
/// Turns a connection into a WebSocket, which takes its place in the hub.
void serveSocket(std::shared_ptr<Hub> hub, Service& service, Stream stream, const Peer& peer,
                 const Head& head, Upgrade upgrade);

} // namespace rapidc::http
