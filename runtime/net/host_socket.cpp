#include "runtime/net/host_socket.h"

#include <fmt/format.h>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace rt::net {
namespace {

sockaddr_in toHost(const Address& address) {
    sockaddr_in host{};
    host.sin_family = AF_INET;
    host.sin_addr.s_addr = htonl(address.ip);
    host.sin_port = htons(address.port);
    return host;
}

Address fromHost(const sockaddr_in& host) {
    return {ntohl(host.sin_addr.s_addr), ntohs(host.sin_port)};
}

const sockaddr* plain(const sockaddr_in& address) {
    return reinterpret_cast<const sockaddr*>(&address);
}

Outcome failure(const char* what, int error) {
    const auto text = [&] { return fmt::format("{}: {}", what, std::strerror(error)); };
    switch (error) {
    case EAGAIN:
#if EWOULDBLOCK != EAGAIN
    case EWOULDBLOCK:
#endif
    case EINTR:
    case EINPROGRESS:
    case EALREADY: return {Fault::Again, {}};
    case EADDRINUSE: return {Fault::AddressInUse, text()};
    case EADDRNOTAVAIL:
    case EACCES:
    case EPERM:
    case EINVAL: return {Fault::AddressInvalid, text()};
    case ENETUNREACH:
    case ENETDOWN:
    case EHOSTUNREACH:
    case EHOSTDOWN: return {Fault::Unreachable, text()};
    case EPIPE:
    case ECONNRESET:
    case ECONNREFUSED:
    case ECONNABORTED:
    case ETIMEDOUT:
    case ENOTCONN: return {Fault::Closed, text()};
    default: return {Fault::Unspecified, text()};
    }
}

} // namespace

void HostSocket::close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
}

Outcome HostSocket::open(bool datagrams) {
    close();
    const int type = (datagrams ? SOCK_DGRAM : SOCK_STREAM) | SOCK_NONBLOCK | SOCK_CLOEXEC;
    fd_ = ::socket(AF_INET, type, 0);
    if (fd_ < 0)
        return {Fault::Unspecified, fmt::format("the computer gives no socket: {}", std::strerror(errno))};
    const int on = 1;
    // Answers of a few bytes are not to wait for the next ones; a port can be used again right after a run.
    if (!datagrams) {
        (void)::setsockopt(fd_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        (void)::setsockopt(fd_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    } else {
        (void)::setsockopt(fd_, SOL_SOCKET, SO_BROADCAST, &on, sizeof on);
    }
    return {};
}

Outcome HostSocket::bind(const Address& address) {
    const sockaddr_in host = toHost(address);
    return ::bind(fd_, plain(host), sizeof host) == 0 ? Outcome{} : failure("binding failed", errno);
}

Outcome HostSocket::listen(int backlog) {
    return ::listen(fd_, backlog) == 0 ? Outcome{} : failure("listening failed", errno);
}

Outcome HostSocket::accept(HostSocket& connection, Address& client) {
    sockaddr_in from{};
    socklen_t size = sizeof from;
    const int fd = ::accept4(fd_, reinterpret_cast<sockaddr*>(&from), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (fd < 0 && errno == ECONNABORTED) return {Fault::Again, {}}; // the client has gone already
    if (fd < 0) return failure("accepting failed", errno);
    connection.close();
    connection.fd_ = fd;
    const int on = 1;
    (void)::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    client = fromHost(from);
    return {};
}

Outcome HostSocket::connect(const Address& address) {
    const sockaddr_in host = toHost(address);
    return ::connect(fd_, plain(host), sizeof host) == 0 ? Outcome{} : failure("connecting failed", errno);
}

Outcome HostSocket::connected() {
    int error = 0;
    socklen_t size = sizeof error;
    if (::getsockopt(fd_, SOL_SOCKET, SO_ERROR, &error, &size) != 0) error = errno;
    if (error != 0) return failure("connecting failed", error);
    sockaddr_in own{}, peer{};
    socklen_t length = sizeof peer;
    if (::getpeername(fd_, reinterpret_cast<sockaddr*>(&peer), &length) != 0) return {Fault::Again, {}};
    (void)::getsockname(fd_, reinterpret_cast<sockaddr*>(&own), &length);
    // A free port of this computer that is tried again and again gets connected with itself in the end.
    if (fromHost(own) == fromHost(peer)) return {Fault::Closed, "nothing listens there"};
    return {};
}

Outcome HostSocket::send(std::string_view bytes, std::size_t& done) {
    const ssize_t sent = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    done = sent < 0 ? 0 : static_cast<std::size_t>(sent);
    return sent < 0 ? failure("sending failed", errno) : Outcome{};
}

Outcome HostSocket::receive(char* buffer, std::size_t size, std::size_t& got) {
    const ssize_t read = ::recv(fd_, buffer, size, 0);
    got = read < 0 ? 0 : static_cast<std::size_t>(read);
    if (read < 0) return failure("receiving failed", errno);
    return read > 0 ? Outcome{} : Outcome{Fault::Closed, "the other side has closed the connection"};
}

Outcome HostSocket::sendTo(std::string_view bytes, const Address& to) {
    const sockaddr_in host = toHost(to);
    const ssize_t sent = ::sendto(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL, plain(host), sizeof host);
    return sent < 0 ? failure("sending failed", errno) : Outcome{};
}

Outcome HostSocket::receiveFrom(char* buffer, std::size_t size, std::size_t& got, Address& from) {
    sockaddr_in sender{};
    socklen_t length = sizeof sender;
    const ssize_t read =
        ::recvfrom(fd_, buffer, size, MSG_TRUNC, reinterpret_cast<sockaddr*>(&sender), &length);
    got = read < 0 ? 0 : static_cast<std::size_t>(read);
    from = fromHost(sender);
    return read < 0 ? failure("receiving failed", errno) : Outcome{};
}

} // namespace rt::net
