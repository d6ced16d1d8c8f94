#pragma once
// Network: the sockets of a controller by port, and how far they reach. Sockets of the same controller find each other here;
// what they do not find is looked for on the computer (NetworkOptions). A service of the controller.

#include "runtime/net/address.h"
#include "runtime/net/network_options.h"
#include "runtime/sched/wait_queue.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace rt {
class EventLog;
class Scheduler;
class Task;
enum class EventId : int;
} // namespace rt

namespace rt::net {

class Socket;

class Network {
  public:
    Network() = default;
    Network(const Network&) = delete;
    Network& operator=(const Network&) = delete;

    /// Before anything else.
    void open(Scheduler& scheduler, EventLog& log, const NetworkOptions& options);
    Scheduler& scheduler() { return *scheduler_; }
    EventLog& log() { return *log_; }
    bool isOffline() const { return options_.offline; }

    // ---- Addresses ----------------------------------------------------------------------------------------
    /// The address of the computer that a socket is bound to instead of the one that the program names.
    uint32_t boundIp(uint32_t named) const;
    /// Servers whose address the computer does not have are bound to all of its addresses.
    bool listensAnywhere() const { return options_.listen == kAnyAddress; }
    /// The address that a connection to this one leads to; none: it is not allowed.
    std::optional<uint32_t> outsideIp(uint32_t named) const;
    /// The program uses this address as one of its controller.
    void addOwn(uint32_t ip) { own_.insert(ip); }
    bool isOwn(uint32_t ip) const;

    // ---- Ports --------------------------------------------------------------------------------------------
    /// The socket of this controller that is bound to the port; null when there is none.
    Socket* boundAt(bool datagrams, uint16_t port) const;
    /// The one that what is sent to this address comes to; null when there is none.
    Socket* reachedBy(bool datagrams, const Address& address) const;
    void addBound(bool datagrams, uint16_t port, Socket& socket) { bound_[{datagrams, port}] = &socket; }
    void removeBound(bool datagrams, uint16_t port, const Socket& socket);
    /// For a datagram socket that is not bound: a port of its own within the controller.
    uint16_t freePort() const;

    /// Notified when a socket begins to listen, and when a listening one has room for more connections.
    WaitQueue& listening() { return listening_; }

    /// Says once for each pair of addresses that a socket is bound to another address than the program names.
    /// `task`: the one that bound it.
    void noteBound(const Address& named, const Address& used, const Task* task);

  private:
    Scheduler* scheduler_ = nullptr;
    EventLog* log_ = nullptr;
    NetworkOptions options_;
    std::set<uint32_t> own_;
    std::map<std::pair<bool, uint16_t>, Socket*> bound_;
    std::set<std::pair<Address, Address>> noted_;
    WaitQueue listening_;
};

} // namespace rt::net
