#pragma once
// HostSocket: a socket of the computer that rapidc runs on. Never blocks, never raises SIGPIPE, not inherited by other
// processes; closed with the object.

#include "runtime/net/address.h"
#include "runtime/net/outcome.h"

#include <cstddef>
#include <string_view>
#include <utility>

namespace rt::net {

class HostSocket {
  public:
    HostSocket() = default;
    ~HostSocket() { close(); }
    HostSocket(HostSocket&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    HostSocket& operator=(HostSocket&& other) noexcept {
        if (this != &other) {
            close();
            fd_ = std::exchange(other.fd_, -1);
        }
        return *this;
    }

    bool isOpen() const { return fd_ >= 0; }
    int fd() const { return fd_; }
    void close();

    Outcome open(bool datagrams);
    /// AddressInUse, AddressInvalid (the computer has no such address, or does not let this user open the port).
    Outcome bind(const Address& address);
    Outcome listen(int backlog);
    /// Again: no connection waits.
    Outcome accept(HostSocket& connection, Address& client);
    /// Again: wait for POLLOUT, then ask connected(). Closed: refused. Unreachable.
    Outcome connect(const Address& address);
    Outcome connected();
    /// `done`: bytes taken; Again: none can be taken now. Closed: the other side is gone.
    Outcome send(std::string_view bytes, std::size_t& done);
    /// Closed: the end of the stream, or a reset.
    Outcome receive(char* buffer, std::size_t size, std::size_t& got);
    Outcome sendTo(std::string_view bytes, const Address& to);
    /// `got`: length of the whole datagram; what is beyond `size` is lost.
    Outcome receiveFrom(char* buffer, std::size_t size, std::size_t& got, Address& from);

  private:
    int fd_ = -1;
};

} // namespace rt::net
