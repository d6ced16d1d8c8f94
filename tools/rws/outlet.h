#pragma once
// Outlet: where the events of a group of subscriptions leave: a WebSocket that comes after the group, may drop, and may come again.
// May be used from every thread.

#include "tools/http/web_socket.h"

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>

namespace rapidc::rws {

class Outlet {
  public:
    Outlet(uint64_t session, bool reopens) : session(session), reopens_(reopens) {}

    const uint64_t session;

    /// Sends, or keeps until there is a socket; of those that wait the oldest are dropped when there are too many.
    void send(const std::shared_ptr<const std::string>& frame);
    /// False: the group does not take another socket.
    bool mayAttach();
    void attach(std::shared_ptr<http::WebSocket> socket);
    /// True: nothing will come after this socket.
    bool detach();
    /// The group has ended.
    void close();

  private:
    static constexpr std::size_t kMostWaiting = 1000;

    std::mutex mutex_;
    std::shared_ptr<http::WebSocket> socket_;
    std::deque<std::shared_ptr<const std::string>> waiting_;
    const bool reopens_;
    bool used_ = false, ended_ = false;
};

} // namespace rapidc::rws
