#include "runtime/net/socket.h"

#include "runtime/log/event_log.h"
#include "runtime/sched/scheduler.h"

#include <fmt/format.h>

#include <poll.h>

#include <algorithm>
#include <utility>

namespace rt::net {

Socket::Socket(Network& network, const Task& owner, bool datagrams)
    : network_(network), owner_(&owner), datagrams_(datagrams) {}

// ---- Waiting -------------------------------------------------------------------------------------------------------

std::optional<OutsideWait> Socket::outside(bool toSend) const {
    if (isInside_ || !host_.isOpen()) return std::nullopt;
    return OutsideWait{host_.fd(), static_cast<short>(toSend ? POLLOUT : POLLIN)};
}

void Socket::expectOutside() {
    if (!isInside_ && host_.isOpen()) keepPace();
}

void Socket::keepPace() {
    if (holdsPace_) return;
    holdsPace_ = true;
    network_.scheduler().holdPace();
}

void Socket::rest() {
    if (std::exchange(holdsPace_, false)) network_.scheduler().releasePace();
}

// ---- Making connections --------------------------------------------------------------------------------------------

/// Opens the socket of the computer, bound as this one is.
Outcome Socket::openHost() {
    if (host_.isOpen()) return {};
    if (Outcome outcome = host_.open(datagrams_); !outcome.ok()) return outcome;
    if (local_.port == 0) return {};
    Address used{network_.boundIp(local_.ip), local_.port};
    Outcome outcome = host_.bind(used);
    if (outcome.fault == Fault::AddressInvalid && network_.listensAnywhere()) {
        used.ip = kAnyAddress;
        outcome = host_.bind(used);
    }
    if (outcome.ok())
        network_.noteBound(local_, used, owner_);
    else
        host_.close();
    return outcome;
}

Outcome Socket::bind(const Address& address) {
    if (state_ == State::Closed) return ended();
    if (state_ != State::Created || local_.port != 0) return {Fault::IsBound, "the socket is bound already"};
    if (datagrams_ && (hiddenPort_ != 0 || host_.isOpen()))
        return {Fault::IsBound,
                "the socket has had a port since it sent a datagram; use SocketBind before that"};
    constexpr uint32_t kFirstMulticast = 0xE0000000;
    if (address.ip >= kFirstMulticast)
        return {Fault::AddressInvalid,
                fmt::format("{} cannot be an address of the controller", ipText(address.ip))};
    if (network_.boundAt(datagrams_, address.port) != nullptr)
        return {Fault::AddressInUse,
                fmt::format("port {} is used by another socket of this controller; close that "
                            "one first or use another port",
                            address.port)};
    local_ = address;
    if (!network_.isOffline()) {
        if (Outcome outcome = openHost(); !outcome.ok()) {
            local_ = {};
            outcome.why =
                fmt::format("{} cannot be used on this computer ({}); use another port, or --offline when "
                            "only tasks of this controller connect",
                            addressText(address), outcome.why);
            return outcome;
        }
    }
    network_.addOwn(address.ip);
    network_.addBound(datagrams_, address.port, *this);
    state_ = State::Bound;
    return {};
}

Outcome Socket::listen() {
    switch (state_) {
    case State::Closed: return ended();
    case State::Created: return {Fault::NotBound, "the socket is not bound; use SocketBind first"};
    case State::Connected: return {Fault::IsConnected, "the socket is connected already"};
    case State::Listening: return {};
    case State::Bound: break;
    }
    if (datagrams_) return {Fault::Unspecified, "a socket for datagrams has no connections to listen for"};
    if (host_.isOpen()) {
        if (Outcome outcome = host_.listen(kBacklog); !outcome.ok()) return outcome;
    }
    state_ = State::Listening;
    network_.listening().notifyAll();
    return {};
}

Outcome Socket::joinListener(Socket& listener, const Address& address) {
    if (listener.state_ != State::Listening || listener.waiting_.size() >= kBacklog)
        return {Fault::Again, {}};
    auto other = std::make_shared<Socket>(network_, *listener.owner_, false);
    other->peer_ = this;
    other->remote_ = {address.ip, local_.port};
    peer_ = other.get();
    remote_ = address;
    for (Socket* end : {this, other.get()}) {
        end->isInside_ = true;
        end->state_ = State::Connected;
    }
    stopConnecting();
    listener.waiting_.push_back(std::move(other));
    listener.changed_.notifyAll();
    return {};
}

Outcome Socket::connectOutside(const Address& address) {
    const auto ip = network_.outsideIp(address.ip);
    if (!ip && network_.isOwn(address.ip)) return {Fault::Again, {}};
    if (!ip && network_.isOffline())
        return {Fault::Unreachable, fmt::format("{} cannot be reached with --offline", addressText(address))};
    if (!ip) {
        network_.log().write(EventId::ConnectionForbidden, owner_,
                             {addressText(address), ipText(address.ip)});
        return {Fault::Unreachable, fmt::format("other computers are not reached without --connect")};
    }
    Outcome outcome;
    if (isConnecting_) {
        outcome = host_.connected();
    } else {
        if (outcome = openHost(); !outcome.ok()) return outcome;
        outcome = host_.connect({*ip, address.port});
        isConnecting_ = outcome.fault == Fault::Again;
    }
    if (outcome.fault == Fault::Again) return outcome;
    isConnecting_ = false;
    if (outcome.ok()) {
        remote_ = address;
        state_ = State::Connected;
        keepPace();
        return outcome;
    }
    host_.close(); // an attempt that failed leaves it unusable
    if (outcome.fault == Fault::Closed) return {Fault::Again, outcome.why};
    return outcome;
}

Outcome Socket::connect(const Address& address) {
    if (state_ == State::Closed) return ended();
    if (state_ == State::Listening) return {Fault::IsConnected, "the socket listens for connections"};
    if (state_ == State::Connected) return {Fault::IsConnected, "the socket is connected already"};
    if (datagrams_) {
        remote_ = address;
        state_ = State::Connected;
        return {};
    }
    if (!isConnecting_) {
        if (Socket* listener = network_.reachedBy(false, address)) return joinListener(*listener, address);
    }
    return connectOutside(address);
}

void Socket::stopConnecting() {
    if (isConnecting_) host_.close();
    isConnecting_ = false;
}

Outcome Socket::accept(const Task& owner, std::shared_ptr<Socket>& connection) {
    switch (state_) {
    case State::Closed: return ended();
    case State::Created:
        return {Fault::NotBound, "the socket is not bound; use SocketBind and SocketListen first"};
    case State::Bound: return {Fault::Unspecified, "the socket does not listen; use SocketListen first"};
    case State::Connected: return {Fault::IsConnected, "the socket is a connection, and does not listen"};
    case State::Listening: break;
    }
    if (!waiting_.empty()) {
        connection = std::move(waiting_.front());
        waiting_.pop_front();
        connection->owner_ = &owner;
        network_.listening().notifyAll();
        return {};
    }
    if (!host_.isOpen()) return {Fault::Again, {}};
    auto accepted = std::make_shared<Socket>(network_, owner, false);
    if (Outcome outcome = host_.accept(accepted->host_, accepted->remote_); !outcome.ok()) return outcome;
    accepted->state_ = State::Connected;
    accepted->keepPace();
    connection = std::move(accepted);
    return {};
}

// ---- Streams -------------------------------------------------------------------------------------------------------

/// The socket cannot be used any more. The first time its resources are given back.
Outcome Socket::ended() {
    std::string why = endReason_.empty() ? "the socket is closed or was never created" : endReason_;
    if (state_ != State::Closed) close();
    return {Fault::Closed, std::move(why)};
}

Outcome Socket::send(std::string_view bytes, std::size_t& done) {
    done = 0;
    if (state_ == State::Closed) return ended();
    if (state_ != State::Connected) return {Fault::NotConnected, "the socket is not connected"};
    if (datagrams_) {
        done = bytes.size();
        return sendTo(bytes, remote_);
    }
    if (bytes.empty()) return {};
    if (peer_ != nullptr) {
        done = std::min(bytes.size(), kWindow - std::min(peer_->received_.size(), kWindow));
        if (done == 0) return {Fault::Again, {}};
        peer_->received_.append(bytes.substr(0, done));
        peer_->changed_.notifyAll();
        return {};
    }
    Outcome outcome{Fault::Closed, "the other side has closed the connection"};
    if (!isInside_) outcome = host_.send(bytes, done);
    if (outcome.fault != Fault::Closed) return outcome;
    hasEnded_ = true;
    endReason_ = outcome.why;
    return received_.empty() ? ended() : outcome; // what came before the end can still be received
}

void Socket::fetchBytes() {
    if (isInside_ || !host_.isOpen() || hasEnded_) return;
    char buffer[4096];
    while (received_.size() < kWindow) {
        std::size_t got = 0;
        const Outcome outcome = host_.receive(buffer, sizeof buffer, got);
        received_.append(buffer, got);
        if (outcome.fault == Fault::Again) return;
        if (!outcome.ok()) {
            hasEnded_ = true;
            endReason_ = outcome.why;
            return;
        }
        if (got < sizeof buffer) return;
    }
}

Outcome Socket::await(std::size_t bytes) {
    if (state_ == State::Closed) return ended();
    if (state_ != State::Connected) return {Fault::NotConnected, "the socket is not connected"};
    if (received_.size() < kLargestMessage) fetchBytes();
    if (received_.size() >= bytes) return {};
    if (!hasEnded_) return {Fault::Again, {}};
    if (received_.empty()) return ended();
    return {Fault::Closed,
            fmt::format("the connection has ended after {} of {} bytes; they can be received without "
                        "\\ReadNoOfBytes",
                        received_.size(), bytes)};
}

Outcome Socket::available(std::size_t& bytes) {
    bytes = 0;
    if (state_ == State::Closed) return ended();
    if (datagrams_) {
        bytes = nextDatagram();
        if (bytes == 0) expectOutside();
        return {};
    }
    if (const Outcome outcome = await(1); !outcome.ok())
        return outcome.fault == Fault::Again ? Outcome{} : outcome;
    fetchBytes();
    bytes = received_.size();
    return {};
}

void Socket::take(std::size_t bytes) {
    received_.erase(0, bytes);
    if (peer_ != nullptr) peer_->changed_.notifyAll();
}

// ---- Datagrams -----------------------------------------------------------------------------------------------------

/// False: the receiver has no room.
bool Socket::deliver(Datagram datagram) {
    if (datagramsIn_.size() >= kMostDatagrams) return false;
    datagramsIn_.push_back(std::move(datagram));
    changed_.notifyAll();
    return true;
}

Outcome Socket::sendTo(std::string_view bytes, const Address& to) {
    if (state_ == State::Closed) return ended();
    if (!datagrams_)
        return {Fault::Unspecified, "the socket is one for connections; create it with SocketCreate \\UDP"};
    if (Socket* target = network_.reachedBy(true, to)) {
        if (local_.port == 0 && hiddenPort_ == 0) {
            hiddenPort_ = network_.freePort();
            network_.addBound(true, hiddenPort_, *this);
        }
        const uint32_t ip = local_.ip == kAnyAddress ? to.ip : local_.ip;
        const Address from{ip, local_.port != 0 ? local_.port : hiddenPort_};
        if (!target->deliver({std::string(bytes), from, bytes.size()}))
            network_.log().write(EventId::DatagramLost, target->owner_,
                                 {addressText(to), std::to_string(kMostDatagrams)});
        return {};
    }
    const auto ip = network_.outsideIp(to.ip);
    if (!ip && network_.isOwn(to.ip)) return {}; // as on a network: lost when no socket has this port
    if (!ip && network_.isOffline())
        return {Fault::Unreachable, fmt::format("{} cannot be reached with --offline", addressText(to))};
    if (!ip) {
        network_.log().write(EventId::ConnectionForbidden, owner_, {addressText(to), ipText(to.ip)});
        return {Fault::Unreachable, "other computers are not reached without --connect"};
    }
    if (Outcome outcome = openHost(); !outcome.ok()) return outcome;
    keepPace();
    Outcome outcome = host_.sendTo(bytes, {*ip, to.port});
    // An answer to an earlier datagram that no socket took it; of this one nothing is known.
    if (outcome.fault == Fault::Closed) outcome = host_.sendTo(bytes, {*ip, to.port});
    if (outcome.fault == Fault::Again || outcome.fault == Fault::Closed) return {};
    return outcome;
}

void Socket::fetchDatagrams() {
    if (!host_.isOpen()) return;
    char buffer[kLargestMessage];
    while (datagramsIn_.size() < kMostDatagrams) {
        std::size_t length = 0;
        Address from;
        const Outcome outcome = host_.receiveFrom(buffer, sizeof buffer, length, from);
        if (outcome.fault == Fault::Closed) continue; // an answer to what was sent earlier
        if (!outcome.ok()) return;
        keepPace();
        datagramsIn_.push_back({std::string(buffer, std::min(length, sizeof buffer)), from, length});
    }
}

/// The other side of a connected socket, which may be known by several addresses.
bool Socket::isRemote(const Address& address) const {
    const bool sameIp = address.ip == remote_.ip || address.ip == network_.outsideIp(remote_.ip) ||
                        (network_.isOwn(address.ip) && network_.isOwn(remote_.ip));
    return sameIp && address.port == remote_.port;
}

std::size_t Socket::nextDatagram() {
    fetchDatagrams();
    const auto isForeign = [this](const Datagram& datagram) {
        return state_ == State::Connected && !isRemote(datagram.from);
    };
    while (!datagramsIn_.empty() && isForeign(datagramsIn_.front())) {
        foreign_ = datagramsIn_.front().from;
        datagramsIn_.pop_front();
    }
    return datagramsIn_.empty() ? 0 : datagramsIn_.front().bytes.size();
}

Outcome Socket::receiveFrom(Datagram& datagram) {
    if (state_ == State::Closed) return ended();
    if (!datagrams_)
        return {Fault::Unspecified,
                "the socket is one for connections; use SocketReceive, or SocketCreate \\UDP"};
    (void)nextDatagram();
    if (datagramsIn_.empty()) return {Fault::Again, {}};
    datagram = std::move(datagramsIn_.front());
    datagramsIn_.pop_front();
    return {};
}

// ---- Closing -------------------------------------------------------------------------------------------------------

void Socket::close() {
    if (state_ == State::Closed) return;
    state_ = State::Closed;
    rest();
    for (const uint16_t port : {local_.port, hiddenPort_})
        if (port != 0) network_.removeBound(datagrams_, port, *this);
    if (peer_ != nullptr) {
        peer_->peer_ = nullptr;
        peer_->hasEnded_ = true;
        peer_->endReason_ = "the other side has closed the connection";
        peer_->changed_.notifyAll();
        peer_ = nullptr;
    }
    waiting_.clear();
    received_.clear();
    datagramsIn_.clear();
    host_.close();
    isConnecting_ = false;
    changed_.notifyAll();
}

} // namespace rt::net
