#pragma once
// Socket: one end of a connection (TCP) or a place for datagrams (UDP), within the controller or through the computer's
// network. Nothing here waits: operations answer Fault::Again, and the caller waits for changed() and outside().

#include "runtime/net/host_socket.h"
#include "runtime/net/network.h"
#include "runtime/sched/task.h"

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace rt::net {

/// Largest message of one instruction, in bytes (manual: SocketSend, SocketReceive).
inline constexpr std::size_t kLargestMessage = 1024;

struct Datagram {
    std::string bytes;
    Address from;
    std::size_t sent = 0; ///< length as sent; more than the bytes when the rest is lost
};

class Socket {
  public:
    enum class State : uint8_t { Created, Bound, Listening, Connected, Closed };
    static constexpr std::size_t kBacklog = 10;        ///< connections that wait to be accepted
    static constexpr std::size_t kWindow = 64 * 1024;  ///< bytes on their way to a receiver
    static constexpr std::size_t kMostDatagrams = 256; ///< on their way; further ones are lost

    /// `owner`: the task whose program made it.
    Socket(Network& network, const Task& owner, bool datagrams);
    ~Socket() { close(); }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;

    State state() const { return state_; }
    bool isDatagrams() const { return datagrams_; }
    const Task& owner() const { return *owner_; }
    /// As the program bound it; all 0 when it is not bound.
    const Address& local() const { return local_; }
    /// The other side of a connection.
    const Address& remote() const { return remote_; }

    // ---- Waiting ------------------------------------------------------------------------------------------
    /// Notified when an operation that answered Again may succeed, and when the socket is closed.
    WaitQueue& changed() { return changed_; }
    /// For a task that waits to receive or accept / to send, to be connected.
    std::optional<OutsideWait> outside(bool toSend) const;

    /// The program has waited for something from outside in vain and may do so again: virtual time keeps pace with the wall clock
    /// until the socket is closed, even between the attempts.
    void expectOutside();
    /// Nothing is expected from outside until something is sent or comes again: virtual time need not keep pace with the wall clock.
    void rest();

    // ---- Operations ---------------------------------------------------------------------------------------
    Outcome bind(const Address& address);
    Outcome listen();
    /// Again: being connected, or nothing listens there yet. To be called again, until it is given up by stopConnecting().
    Outcome connect(const Address& address);
    void stopConnecting();
    /// The connection belongs to `owner`. Again: none waits.
    Outcome accept(const Task& owner, std::shared_ptr<Socket>& connection);
    /// `done`: bytes taken. Again: no more can be taken now.
    Outcome send(std::string_view bytes, std::size_t& done);
    /// Until at least so many bytes (1 or more) have come. Closed: they will not come.
    Outcome await(std::size_t bytes);
    /// How many bytes there are, or how long the next datagram is; 0: nothing has come.
    Outcome available(std::size_t& bytes);
    /// Bytes that have come and were not taken; await() looks for more.
    std::string_view received() const { return received_; }
    void take(std::size_t bytes);
    Outcome sendTo(std::string_view bytes, const Address& to);
    /// Again: none has come. Connected sockets take those of the other side only.
    Outcome receiveFrom(Datagram& datagram);
    /// The sender of a datagram that a connected socket did not take, since the last call.
    std::optional<Address> takeForeign() { return std::exchange(foreign_, std::nullopt); }
    /// Bytes that were sent still come to the other side. Tasks that wait for this socket are notified.
    void close();

  private:
    Outcome openHost();
    Outcome connectOutside(const Address& address);
    Outcome joinListener(Socket& listener, const Address& address);
    bool deliver(Datagram datagram);
    void fetchBytes();
    void fetchDatagrams();
    std::size_t nextDatagram();
    bool isRemote(const Address& address) const;
    Outcome ended();
    void keepPace();

    Network& network_;
    const Task* owner_;
    const bool datagrams_;
    State state_ = State::Created;
    Address local_, remote_;
    uint16_t hiddenPort_ = 0; ///< of a datagram socket that is not bound
    HostSocket host_;
    bool isConnecting_ = false; ///< on the computer's network
    bool holdsPace_ = false;
    Socket* peer_ = nullptr; ///< the other side, in the same controller
    bool isInside_ = false;  ///< the other side is or was in the same controller
    bool hasEnded_ = false;  ///< nothing more will come
    std::string endReason_;
    std::string received_;
    std::deque<Datagram> datagramsIn_;
    std::optional<Address> foreign_;              ///< sender of the latest datagram that was not taken
    std::deque<std::shared_ptr<Socket>> waiting_; ///< connections to be accepted
    WaitQueue changed_;
};

} // namespace rt::net
