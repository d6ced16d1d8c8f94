#pragma once
// WebSockets as services use them. A socket begins with an Upgrade (server.h) and lives until one side closes it.

#include "tools/http/url.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace rapidc::http {

enum class CloseCode : uint16_t {
    Normal = 1000,
    GoingAway = 1001,
    ProtocolError = 1002,
    PolicyViolation = 1008,
    TooBig = 1009,
    ServiceRestart = 1012,
};

/// The end of a socket with which a service sends; may be kept and called from every thread, even after the socket has ended.
class WebSocket {
  public:
    virtual ~WebSocket() = default;
    /// Sends one text message; the bytes are shared, not copied. A client that reads too slowly is cut off.
    virtual void send(std::shared_ptr<const std::string> text) = 0;
    virtual void close(CloseCode code, std::string reason) = 0;
    /// The bytes that were sent and have not left yet: a service may leave out what the client does not need for certain.
    virtual std::size_t waitingBytes() const { return 0; }

    void send(std::string text) { send(std::make_shared<const std::string>(std::move(text))); }
};

/// The events of a socket for its service. All calls come on the network thread.
class SocketListener {
  public:
    virtual ~SocketListener() = default;
    virtual void opened(std::shared_ptr<WebSocket> socket) = 0;
    virtual void received(std::string message, bool isText) = 0;
    /// Once, after opened(), however the socket ended.
    virtual void closed() = 0;
};

/// The answer to a request for a socket.
struct Upgrade {
    std::string subprotocol; ///< of the response; "" = none
    FieldList headers;
    std::shared_ptr<SocketListener> listener;
};

} // namespace rapidc::http
