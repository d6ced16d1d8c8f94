// Manual 1.10: the instructions and functions for sockets.

#include "stdlib/impl/sockets/payload.h"
#include "stdlib/impl/sockets/sockets.h"
#include "stdlib/impl/support/deadline.h"
#include "stdlib/impl/support/fail.h"

#include "natives/sockets.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>

using namespace rt;
using lib::Incoming;
using lib::Outgoing;
using lib::Sockets;
using net::Address;
using net::Fault;
using net::Outcome;
using net::Socket;

namespace {

using SocketPtr = std::shared_ptr<Socket>;

/// How often a connection is tried again that nothing on the computer has taken.
constexpr Time kRetryPeriod = 100 * kMillisecond;

Sockets& socketsOf(TaskCore* task) {
    return Sockets::of(taskOf(task).controller());
}

Status errorOf(Fault fault) {
    switch (fault) {
    case Fault::None: return kOk;
    case Fault::Again: return err::ERR_SOCK_TIMEOUT;
    case Fault::Closed: return err::ERR_SOCK_CLOSED;
    case Fault::AddressInvalid: return err::ERR_SOCK_ADDR_INVALID;
    case Fault::AddressInUse: return err::ERR_SOCK_ADDR_INUSE;
    case Fault::IsBound: return err::ERR_SOCK_IS_BOUND;
    case Fault::NotBound: return err::ERR_SOCK_NOT_BOUND;
    case Fault::IsConnected: return err::ERR_SOCK_IS_CONN;
    case Fault::NotConnected: return err::ERR_SOCK_NOT_CONN;
    case Fault::Unreachable: return err::ERR_SOCK_NET_UNREACH;
    case Fault::Unspecified: break;
    }
    return err::ERR_SOCK_UNSPEC;
}

/// kOk, or raises what the outcome means.
Status finish(TaskCore* task, const Outcome& outcome) {
    return outcome.ok() ? kOk : lib::fail(task, errorOf(outcome.fault), outcome.why);
}

/// The socket that the variable names; null and ERR_SOCK_CLOSED raised.
SocketPtr socketOf(TaskCore* task, const Handle* variable, Status& status) {
    SocketPtr socket = socketsOf(task).find(*variable);
    if (!socket)
        status = lib::fail(task, err::ERR_SOCK_CLOSED,
                           "the socket is closed or was never created; use SocketCreate first");
    return socket;
}

Status addressOf(TaskCore* task, const String* text, float port, Address& address) {
    if (!net::parseIp(text->view(), address.ip))
        return lib::fail(
            task, err::ERR_SOCK_ADDR_INVALID,
            fmt::format("\"{}\" is not an address; write one such as \"192.168.125.1\"", text->view()));
    if (!(port >= 1 && port <= UINT16_MAX && std::trunc(port) == port))
        return lib::fail(task, err::ERR_SOCK_ADDR_INVALID,
                         fmt::format("{} is not a port, which is a whole number from 1 to 65535", port));
    address.port = static_cast<uint16_t>(port);
    return kOk;
}

/// Address of another computer: 0.0.0.0 names none.
Status remoteOf(TaskCore* task, const String* text, float port, Address& address) {
    if (const Status status = addressOf(task, text, port, address)) return status;
    if (address.ip != net::kAnyAddress) return kOk;
    return lib::fail(task, err::ERR_SOCK_ADDR_INVALID, "0.0.0.0 is not the address of a computer");
}

/// Repeats `step` until it answers other than Again or the deadline has passed. Negative: the task is being unwound.
template <class Step>
Status repeat(TaskCore* task, Socket& socket, bool toSend, Time deadline, Outcome& outcome,
              const Step& step) {
    outcome = step();
    if (outcome.fault != Fault::Again) return kOk;
    WaitSpec spec;
    spec.queues = {&socket.changed()};
    spec.condition = [&] {
        outcome = step();
        return outcome.fault != Fault::Again;
    };
    spec.deadline = deadline;
    spec.outside = [&] { return socket.outside(toSend); };
    WaitResult result{};
    const Status status = taskOf(task).waitFor(spec, result);
    if (outcome.fault == Fault::Again) {
        outcome.why = "nothing came within \\Time";
        socket.expectOutside();
    }
    return status;
}

/// As repeat, with what only connecting has: other sockets begin to listen, attempts on the computer are made again.
Status repeatConnecting(TaskCore* task, Socket& socket, const Address& address, Time deadline,
                        Outcome& outcome) {
    net::Network& network = socketsOf(task).network();
    const bool isOutside = network.outsideIp(address.ip).has_value();
    WaitSpec spec;
    spec.queues = {&socket.changed(), &network.listening()};
    spec.condition = [&] {
        outcome = socket.connect(address);
        return outcome.fault != Fault::Again;
    };
    spec.deadline = deadline;
    spec.pollPeriod = isOutside ? kRetryPeriod : 0;
    spec.outside = [&]() -> std::optional<OutsideWait> {
        if (auto outside = socket.outside(true)) return outside;
        return isOutside ? std::optional(OutsideWait{}) : std::nullopt;
    };
    WaitResult result{};
    const Status status = taskOf(task).waitFor(spec, result);
    if (status < 0 || outcome.fault == Fault::Again) socket.stopConnecting();
    return status;
}

Status sendBytes(TaskCore* task, Socket& socket, std::string_view bytes) {
    std::size_t sent = 0;
    Outcome outcome;
    const auto step = [&]() -> Outcome {
        std::size_t done = 0;
        Outcome now = socket.send(bytes.substr(sent), done);
        sent += done;
        if (now.ok() && sent < bytes.size()) now.fault = Fault::Again;
        return now;
    };
    if (const Status status = repeat(task, socket, true, kNever, outcome, step)) return status;
    return finish(task, outcome);
}

/// \ReadNoOfBytes as a number of bytes, 1 when it is left out or names all of a container.
Status bytesToAwait(TaskCore* task, const float* wanted, const Incoming& into, std::size_t& bytes) {
    bytes = 1;
    if (wanted == nullptr) return kOk;
    const auto most = static_cast<float>(into.capacity());
    if (!(*wanted >= 1 && *wanted <= most && std::trunc(*wanted) == *wanted))
        return lib::fail(
            task, err::ERR_ARGVALERR,
            fmt::format("\\ReadNoOfBytes is {}, but must be a whole number from 1 to {}, the bytes that the "
                        "variable takes",
                        *wanted, most));
    if (!into.isWhole(*wanted)) bytes = static_cast<std::size_t>(*wanted);
    return kOk;
}

Status receiveStream(TaskCore* task, Socket& socket, const Incoming& into, const float* wanted,
                     Time deadline) {
    std::size_t least = 0;
    if (const Status status = bytesToAwait(task, wanted, into, least)) return status;
    Outcome outcome;
    const auto step = [&] { return socket.await(least); };
    if (const Status status = repeat(task, socket, false, deadline, outcome, step)) return status;
    if (!outcome.ok()) return finish(task, outcome);
    const bool isExact = wanted != nullptr && !into.isWhole(*wanted);
    const std::size_t count = isExact ? least : into.fitting(socket.received());
    into.put(socket.received().substr(0, count));
    socket.take(count);
    return kOk;
}

Status receiveDatagram(TaskCore* task, Socket& socket, const Incoming& into, Time deadline, Address& from) {
    net::Datagram datagram;
    Outcome outcome;
    const auto step = [&] { return socket.receiveFrom(datagram); };
    if (const Status status = repeat(task, socket, false, deadline, outcome, step)) return status;
    if (!outcome.ok()) return finish(task, outcome);
    const std::size_t count = into.fitting(datagram.bytes);
    if (datagram.sent > count)
        taskOf(task).report(EventId::DatagramCut,
                            {std::to_string(datagram.sent), net::addressText(datagram.from),
                             std::to_string(into.capacity())});
    into.put(std::string_view(datagram.bytes).substr(0, count));
    from = datagram.from;
    return kOk;
}

} // namespace

extern "C" {

Status rt_SocketCreate(TaskCore* task, Handle* Socket, bool UDP) {
    Sockets& sockets = socketsOf(task);
    if (sockets.find(*Socket))
        return lib::fail(task, err::ERR_SOCK_UNSPEC, "the socket is in use already; use SocketClose first");
    if (sockets.isFull())
        return lib::fail(task, err::ERR_SOCK_UNSPEC,
                         fmt::format("{} sockets are in use, the maximum; close those that are not needed",
                                     Sockets::kMost));
    *Socket = sockets.add(std::make_shared<net::Socket>(sockets.network(), taskOf(task), UDP));
    return kOk;
}

Status rt_SocketBind(TaskCore* task, Handle* Socket, const String* LocalAddress, float LocalPort) {
    Status status = kOk;
    const SocketPtr socket = socketOf(task, Socket, status);
    if (!socket) return status;
    Address address;
    if ((status = addressOf(task, LocalAddress, LocalPort, address)) != kOk) return status;
    return finish(task, socket->bind(address));
}

Status rt_SocketListen(TaskCore* task, Handle* Socket) {
    Status status = kOk;
    const SocketPtr socket = socketOf(task, Socket, status);
    return socket ? finish(task, socket->listen()) : status;
}

Status rt_SocketAccept(TaskCore* task, Handle* Socket, Handle* ClientSocket, String* ClientAddress,
                       const float* Time) {
    Status status = kOk;
    const SocketPtr socket = socketOf(task, Socket, status);
    if (!socket) return status;
    Sockets& sockets = socketsOf(task);
    if (socket == sockets.find(*ClientSocket))
        return lib::fail(task, err::ERR_SOCK_UNSPEC,
                         "the listening socket cannot be the client socket, too; use another variable");
    SocketPtr connection;
    Outcome outcome;
    const auto step = [&]() -> Outcome {
        if (!sockets.find(*ClientSocket) && sockets.isFull())
            return {Fault::Unspecified,
                    fmt::format("{} sockets are in use, the maximum; close those that are "
                                "not needed",
                                Sockets::kMost)};
        return socket->accept(taskOf(task), connection);
    };
    if ((status = repeat(task, *socket, false, lib::deadlineOf(task, Time), outcome, step)) != kOk)
        return status;
    if (!outcome.ok()) return finish(task, outcome);
    if (ClientAddress != nullptr) ClientAddress->assign(net::ipText(connection->remote().ip));
    sockets.close(*ClientSocket); // a connection that the variable named before would be lost
    *ClientSocket = sockets.add(std::move(connection));
    return kOk;
}

Status rt_SocketConnect(TaskCore* task, Handle* Socket, const String* Address, float Port,
                        const float* Time) {
    Status status = kOk;
    const SocketPtr socket = socketOf(task, Socket, status);
    if (!socket) return status;
    net::Address address;
    if ((status = remoteOf(task, Address, Port, address)) != kOk) return status;
    const rt::Time deadline = lib::deadlineOf(task, Time);
    Outcome outcome = socket->connect(address);
    if (outcome.fault == Fault::Again) {
        if ((status = repeatConnecting(task, *socket, address, deadline, outcome)) != kOk) return status;
        if (outcome.fault == Fault::Again)
            outcome.why =
                fmt::format("{} did not take the connection within \\Time; check that the server runs "
                            "there and listens",
                            net::addressText(address));
    }
    return finish(task, outcome);
}

Status rt_SocketSend(TaskCore* task, Handle* Socket, const String* Str, data::Rawbytes* RawData,
                     const float* Data, int32_t DataDim1, const float* NoOfBytes) {
    Status status = kOk;
    const SocketPtr socket = socketOf(task, Socket, status);
    if (!socket) return status;
    std::array<char, net::kLargestMessage> buffer;
    std::string_view bytes;
    if ((status = Outgoing{Str, RawData, Data, DataDim1, NoOfBytes}.get(task, buffer, bytes)) != kOk)
        return status;
    return sendBytes(task, *socket, bytes);
}

Status rt_SocketSendTo(TaskCore* task, Handle* Socket, const String* RemoteAddress, float RemotePort,
                       const String* Str, data::Rawbytes* RawData, const float* Data, int32_t DataDim1,
                       const float* NoOfBytes) {
    Status status = kOk;
    const SocketPtr socket = socketOf(task, Socket, status);
    if (!socket) return status;
    Address address;
    if ((status = remoteOf(task, RemoteAddress, RemotePort, address)) != kOk) return status;
    std::array<char, net::kLargestMessage> buffer;
    std::string_view bytes;
    if ((status = Outgoing{Str, RawData, Data, DataDim1, NoOfBytes}.get(task, buffer, bytes)) != kOk)
        return status;
    return finish(task, socket->sendTo(bytes, address));
}

Status rt_SocketReceive(TaskCore* task, Handle* Socket, String* Str, data::Rawbytes* RawData, float* Data,
                        int32_t DataDim1, const float* ReadNoOfBytes, float* NoRecBytes, const float* Time) {
    Status status = kOk;
    const SocketPtr socket = socketOf(task, Socket, status);
    if (!socket) return status;
    const Incoming into{Str, RawData, Data, DataDim1, NoRecBytes};
    if ((status = into.check(task)) != kOk) return status;
    const rt::Time deadline = lib::deadlineOf(task, Time);
    if (!socket->isDatagrams()) return receiveStream(task, *socket, into, ReadNoOfBytes, deadline);
    if (socket->state() != net::Socket::State::Connected)
        return lib::fail(task, err::ERR_SOCK_NOT_CONN,
                         "the socket is not connected; use SocketReceiveFrom for datagrams of any sender");
    Address from;
    return receiveDatagram(task, *socket, into, deadline, from);
}

Status rt_SocketReceiveFrom(TaskCore* task, Handle* Socket, String* Str, data::Rawbytes* RawData, float* Data,
                            int32_t DataDim1, float* NoRecBytes, String* RemoteAddress, float* RemotePort,
                            const float* Time) {
    Status status = kOk;
    const SocketPtr socket = socketOf(task, Socket, status);
    if (!socket) return status;
    const Incoming into{Str, RawData, Data, DataDim1, NoRecBytes};
    if ((status = into.check(task)) != kOk) return status;
    Address from;
    if ((status = receiveDatagram(task, *socket, into, lib::deadlineOf(task, Time), from)) != kOk)
        return status;
    RemoteAddress->assign(net::ipText(from.ip));
    *RemotePort = static_cast<float>(from.port);
    return kOk;
}

Status rt_SocketClose(TaskCore* task, Handle* Socket) {
    socketsOf(task).close(*Socket);
    *Socket = 0;
    return kOk;
}

Status rt_SocketGetStatus(TaskCore* task, float* result, Handle* Socket) {
    const SocketPtr socket = socketsOf(task).find(*Socket);
    *result = k::SOCKET_CLOSED;
    if (!socket) return kOk;
    switch (socket->state()) {
    case net::Socket::State::Created: *result = k::SOCKET_CREATED; break;
    case net::Socket::State::Bound: *result = k::SOCKET_BOUND; break;
    case net::Socket::State::Listening: *result = k::SOCKET_LISTENING; break;
    case net::Socket::State::Connected: *result = k::SOCKET_CONNECTED; break;
    case net::Socket::State::Closed: break;
    }
    return kOk;
}

Status rt_SocketPeek(TaskCore* task, float* result, Handle* Socket) {
    Status status = kOk;
    const SocketPtr socket = socketOf(task, Socket, status);
    if (!socket) return status;
    std::size_t bytes = 0;
    const Outcome outcome = socket->available(bytes);
    *result = static_cast<float>(bytes);
    return finish(task, outcome);
}
}
