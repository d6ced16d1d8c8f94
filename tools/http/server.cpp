#include "tools/http/server.h"

#include "tools/http/connection.h"
#include "tools/http/tls.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/steady_timer.hpp>

#include <fmt/format.h>
#include <sys/resource.h>

#include <future>
#include <thread>

namespace rapidc::http {

using Tcp = asio::ip::tcp;

namespace {

constexpr std::chrono::milliseconds kTick{250};
constexpr std::chrono::milliseconds kFarewell{300};
/// Files that the rest of the process needs.
constexpr std::size_t kReservedFiles = 128;

/// No more connections than there are file descriptors for.
Limits within(Limits limits) {
    rlimit files{};
    if (getrlimit(RLIMIT_NOFILE, &files) == 0 && files.rlim_cur != RLIM_INFINITY) {
        const std::size_t usable =
            files.rlim_cur > 2 * kReservedFiles ? files.rlim_cur - kReservedFiles : files.rlim_cur / 2;
        limits.connections = std::min<std::size_t>(limits.connections, usable);
    }
    return limits;
}

std::unique_ptr<asio::ssl::context> contextOf(const TlsIdentity& identity) {
    auto context = std::make_unique<asio::ssl::context>(asio::ssl::context::tls_server);
    context->set_options(asio::ssl::context::default_workarounds | asio::ssl::context::no_sslv2 |
                         asio::ssl::context::no_sslv3 | asio::ssl::context::no_tlsv1 |
                         asio::ssl::context::no_tlsv1_1);
    SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
    SSL_CTX_set_options(context->native_handle(), SSL_OP_NO_RENEGOTIATION | SSL_OP_IGNORE_UNEXPECTED_EOF);
    SSL_CTX_set_mode(context->native_handle(), SSL_MODE_RELEASE_BUFFERS);
    context->use_certificate(asio::buffer(identity.certificate()), asio::ssl::context::pem);
    context->use_private_key(asio::buffer(identity.key()), asio::ssl::context::pem);
    return context;
}

/// One port.
struct Listener {
    Tcp::acceptor acceptor;
    std::unique_ptr<asio::ssl::context> tls;
    Service* service;
    asio::steady_timer pause; ///< after a failure to accept
};

struct Repeated {
    asio::steady_timer timer;
    std::chrono::milliseconds period;
    std::function<void()> command;
};

} // namespace

Response Service::refusal(int status, const std::string& reason) {
    return Response::text(status, reason + "\n");
}

struct Server::Core {
    explicit Core(Limits limits)
        : hub(std::make_shared<Hub>(within(limits))), work(hub->io.get_executor()), ticks(hub->io) {}

    std::shared_ptr<Hub> hub;
    asio::executor_work_guard<asio::io_context::executor_type> work;
    std::vector<std::unique_ptr<Listener>> listeners;
    std::vector<std::unique_ptr<Repeated>> repeated;
    asio::steady_timer ticks;
    uint64_t lastNumber = 0;
    std::thread thread;

    void accept(Listener& listener) {
        listener.acceptor.async_accept([this, &listener](ErrorCode ec, Tcp::socket socket) {
            if (hub->isStopping) return;
            if (ec) return acceptLater(listener);
            welcome(listener, std::move(socket));
            accept(listener);
        });
    }

    /// No file descriptor is free, most likely.
    void acceptLater(Listener& listener) {
        endLongestWaiting();
        listener.pause.expires_after(std::chrono::milliseconds(100));
        listener.pause.async_wait([this, &listener](ErrorCode ec) {
            if (!ec && !hub->isStopping) accept(listener);
        });
    }

    void welcome(Listener& listener, Tcp::socket socket) {
        if (hub->channels.size() >= hub->limits.connections && !endLongestWaiting()) return;
        ErrorCode ec;
        socket.set_option(Tcp::no_delay(true), ec);
        socket.set_option(asio::socket_base::keep_alive(true), ec);
        const Tcp::endpoint remote = socket.remote_endpoint(ec);
        if (ec) return;
        Peer peer{++lastNumber, remote.address().to_string(), listener.tls != nullptr};
        serve(hub, *listener.service, Stream(std::move(socket), listener.tls.get()), std::move(peer));
    }

    /// Makes room: the connection that has waited longest for a request. Whether there was one.
    bool endLongestWaiting() {
        std::shared_ptr<Channel> longest;
        for (const auto& [number, channel] : hub->channels)
            if (channel->waitsSince() && (!longest || *channel->waitsSince() < *longest->waitsSince()))
                longest = channel;
        if (longest) longest->abort();
        return longest != nullptr;
    }

    std::vector<std::shared_ptr<Channel>> allChannels() const {
        std::vector<std::shared_ptr<Channel>> all;
        for (const auto& [number, channel] : hub->channels)
            all.push_back(channel);
        return all;
    }

    void tick() {
        ticks.expires_after(kTick);
        ticks.async_wait([this](ErrorCode ec) {
            if (ec || hub->isStopping) return;
            const Clock::time_point now = Clock::now();
            for (const std::shared_ptr<Channel>& channel : allChannels())
                channel->tick(now);
            tick();
        });
    }

    void repeat(Repeated& each) {
        each.timer.expires_after(each.period);
        each.timer.async_wait([this, &each](ErrorCode ec) {
            if (ec || hub->isStopping) return;
            each.command();
            repeat(each);
        });
    }

    /// On the network thread; afterwards run() returns as soon as all channels have ended.
    void close() {
        hub->isStopping = true;
        for (const auto& listener : listeners) {
            ErrorCode ignored;
            listener->acceptor.close(ignored);
            listener->pause.cancel();
        }
        for (const auto& each : repeated)
            each->timer.cancel();
        for (const std::shared_ptr<Channel>& channel : allChannels())
            channel->leave();
        work.reset();
        ticks.expires_after(kFarewell);
        ticks.async_wait([this](ErrorCode) {
            for (const std::shared_ptr<Channel>& channel : allChannels())
                channel->abort();
        });
    }
};

Server::Server(Limits limits) : core_(std::make_shared<Core>(limits)) {}

Server::~Server() {
    stop();
}

std::string Server::listen(const Endpoint& endpoint, uint16_t& port) {
    ErrorCode ec;
    const asio::ip::address address = asio::ip::make_address(endpoint.address, ec);
    if (ec) return fmt::format("'{}' is not an address of a network interface", endpoint.address);
    asio::io_context& io = core_->hub->io;
    auto listener = std::make_unique<Listener>(
        Listener{Tcp::acceptor(io), nullptr, endpoint.service, asio::steady_timer(io)});
    Tcp::acceptor& acceptor = listener->acceptor;
    acceptor.open(address.is_v6() ? Tcp::v6() : Tcp::v4(), ec);
    if (!ec) acceptor.set_option(asio::socket_base::reuse_address(true), ec);
    if (!ec) acceptor.bind({address, endpoint.port}, ec);
    if (!ec) acceptor.listen(asio::socket_base::max_listen_connections, ec);
    if (ec) return fmt::format("cannot listen on {}:{}: {}", endpoint.address, endpoint.port, ec.message());
    port = acceptor.local_endpoint(ec).port();
    if (endpoint.tls) listener->tls = contextOf(*endpoint.tls);
    core_->listeners.push_back(std::move(listener));
    return {};
}

void Server::start() {
    Core& core = *core_;
    for (const auto& listener : core.listeners)
        core.accept(*listener);
    for (const auto& each : core.repeated)
        core.repeat(*each);
    core.tick();
    core.thread = std::thread([&core] { core.hub->io.run(); });
}

void Server::stop() {
    if (!core_->thread.joinable()) return;
    asio::post(core_->hub->io, [&core = *core_] { core.close(); });
    core_->thread.join();
}

void Server::post(std::function<void()> command) {
    asio::post(core_->hub->io, std::move(command));
}

void Server::every(std::chrono::milliseconds period, std::function<void()> command) {
    core_->repeated.push_back(
        std::make_unique<Repeated>(Repeated{asio::steady_timer(core_->hub->io), period, std::move(command)}));
}

} // namespace rapidc::http
