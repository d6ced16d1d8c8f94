#pragma once
// The sockets of a controller that variables of type socketdev name (manual 1.10). Decisions: README.md.

#include "runtime/host/controller.h"
#include "runtime/net/network.h"
#include "runtime/net/socket.h"

#include <memory>

namespace rt::lib {

class Sockets {
  public:
    /// Sockets that a controller has at the same time (manual: SocketCreate).
    static constexpr std::size_t kMost = 32;

    /// The service of this controller.
    static Sockets& of(Controller& controller);

    net::Network& network() { return network_; }
    bool isFull();
    Handle add(std::shared_ptr<net::Socket> socket) { return table_.create(std::move(socket)); }
    /// Null when the variable names none that is open.
    std::shared_ptr<net::Socket> find(Handle handle);
    void close(Handle handle);
    /// Those of a task; how many there were, and which: "port 5000, connection with 127.0.0.1:40000".
    std::size_t closeAll(const Task& task, std::string& which);

  private:
    void forgetClosed();

    net::Network network_;
    bool isOpen_ = false;
    HandleTable<std::shared_ptr<net::Socket>> table_; // after the network, which sockets need to the end
};

/// Closes what the program of the task has left open, and writes an event about it.
void closeSockets(Task& task, const char* why);

} // namespace rt::lib
