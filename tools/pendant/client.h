#pragma once
// Client: a page that is connected. It may be kept after its socket has ended; sending does nothing then.

#include "tools/http/web_socket.h"
#include "tools/pendant/protocol.h"

#include <atomic>
#include <memory>
#include <string>

namespace rapidc::pendant {

class Client {
  public:
    static constexpr int kMostWaiting = 64;                             ///< requests
    static constexpr std::size_t kLargestAnswer = std::size_t{8} << 20; ///< bytes

    Client(std::shared_ptr<http::WebSocket> socket, std::string peer, bool needsLogin)
        : socket_(std::move(socket)), peer_(std::move(peer)), isGreeted_(false), needsLogin_(needsLogin) {}

    // ---- From any thread
    void answer(const Json& id, const Json& result);
    void refuse(const Json& id, const RequestError& error);
    void send(std::shared_ptr<const std::string> message) { socket_->send(std::move(message)); }
    void close(http::CloseCode code, std::string reason) { socket_->close(code, std::move(reason)); }
    /// Reads too slowly at present: what is not needed for certain is left out.
    bool isCongested() const { return socket_->waitingBytes() > kCongested; }
    /// A request begins to wait; false when there are too many.
    bool beginRequest() {
        if (waiting_.fetch_add(1) < kMostWaiting) return true;
        --waiting_;
        return false;
    }
    void endRequest() { --waiting_; }
    const std::string& peer() const { return peer_; }

    // ---- On the controller's thread
    bool isGreeted() const { return isGreeted_; }
    void greet() { isGreeted_ = true; }
    bool needsLogin() const { return needsLogin_; }

  private:
    static constexpr std::size_t kCongested = std::size_t{256} * 1024; ///< bytes

    const std::shared_ptr<http::WebSocket> socket_;
    const std::string peer_;
    std::atomic<int> waiting_{0};
    bool isGreeted_;
    const bool needsLogin_;
};

} // namespace rapidc::pendant
