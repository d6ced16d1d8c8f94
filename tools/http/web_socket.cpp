#include "tools/http/web_socket.h"

#include "tools/http/connection.h"

#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/message.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/beast/websocket/stream.hpp>

#include <netinet/tcp.h>

#include <deque>
#include <mutex>

namespace rapidc::http {

namespace websocket = beast::websocket;

namespace {

constexpr std::chrono::seconds kHandshakeTime{5};
/// A peer that does not acknowledge what was sent for so long is gone.
constexpr unsigned kUserTimeout = 60'000;

class Socket final : public Channel, public std::enable_shared_from_this<Socket> {
  public:
    Socket(std::shared_ptr<Hub> hub, Service& service, Stream stream, Peer peer,
           std::shared_ptr<SocketListener> listener)
        : hub_(std::move(hub)), service_(service), socket_(std::move(stream)), peer_(std::move(peer)),
          listener_(std::move(listener)) {}

    void open(const Head& head, const Upgrade& upgrade);

    void abort() override { end(); }
    void leave() override { close(CloseCode::GoingAway, "the server ends"); }
    void tick(Clock::time_point now) override {
        if (!isOpen_ && now > openingEnd_) return end();
        if (!isOpen_ || now < nextPing_ || isPinging_) return;
        nextPing_ = now + hub_->limits.pingTime;
        isPinging_ = true;
        socket_.async_ping({}, [self = shared_from_this()](ErrorCode) { self->isPinging_ = false; });
    }

    /// From any thread.
    void send(std::shared_ptr<const std::string> text) {
        const std::lock_guard lock(mutex_);
        if (isCut_) return;
        waitingBytes_ += text->size();
        waiting_.push_back(std::move(text));
        isCut_ = waitingBytes_ > hub_->limits.socketQueueBytes;
        if (std::exchange(isScheduled_, true)) return;
        asio::post(hub_->io, [self = shared_from_this()] { self->writeNext(); });
    }
    std::size_t waitingBytes() {
        const std::lock_guard lock(mutex_);
        return waitingBytes_;
    }
    void post(CloseCode code, std::string reason) {
        asio::post(hub_->io, [self = shared_from_this(), code, reason = std::move(reason)] {
            self->close(code, reason);
        });
    }

  private:
    void end() {
        if (hasEnded_) return;
        hasEnded_ = true;
        const auto self = shared_from_this();
        {
            const std::lock_guard lock(mutex_);
            isCut_ = true;
            waiting_.clear();
        }
        socket_.next_layer().close();
        hub_->channels.erase(peer_.connection);
        if (hub_->isStopping) return;
        if (isOpen_) listener_->closed();
        service_.connectionEnded(peer_.connection);
    }

    void close(CloseCode code, const std::string& reason) {
        if (hasEnded_ || isClosing_) return;
        if (!isOpen_) return end();
        isClosing_ = true;
        const websocket::close_reason why(static_cast<websocket::close_code>(code),
                                          beast::string_view(reason.data(), reason.size()));
        socket_.async_close(why, [self = shared_from_this()](ErrorCode) { self->end(); });
    }

    void read() {
        socket_.async_read(buffer_, [self = shared_from_this()](ErrorCode ec, std::size_t) {
            if (self->hasEnded_) return;
            if (ec) return self->isClosing_ ? void() : self->end();
            const auto data = self->buffer_.data();
            std::string message(static_cast<const char*>(data.data()), data.size());
            self->buffer_.consume(self->buffer_.size());
            if (!self->isClosing_) self->listener_->received(std::move(message), self->socket_.got_text());
            self->read();
        });
    }

    void writeNext() {
        if (hasEnded_) return;
        if (!isOpen_ || isClosing_ || isWriting_)
            return; // opened() continues; what waits when it closes is dropped
        {
            const std::lock_guard lock(mutex_);
            if (!isCut_ && waiting_.empty()) isScheduled_ = false;
            if (!isScheduled_) return;
            if (!isCut_) {
                writing_ = std::move(waiting_.front());
                waiting_.pop_front();
                waitingBytes_ -= writing_->size();
            }
        }
        if (isCut_) return end(); // too slow; a farewell would not reach it
        isWriting_ = true;
        socket_.async_write(asio::buffer(*writing_), [self = shared_from_this()](ErrorCode ec, std::size_t) {
            self->isWriting_ = false;
            if (self->hasEnded_) return;
            if (ec) return self->isClosing_ ? void() : self->end();
            self->writeNext();
        });
    }

    void opened(ErrorCode ec);

    std::shared_ptr<Hub> hub_;
    Service& service_;
    websocket::stream<Stream> socket_;
    const Peer peer_;
    const std::shared_ptr<SocketListener> listener_;
    beast::flat_buffer buffer_;
    bool isOpen_ = false, isClosing_ = false, hasEnded_ = false, isPinging_ = false, isWriting_ = false;
    Clock::time_point nextPing_, openingEnd_ = Clock::now() + kHandshakeTime;
    std::shared_ptr<const std::string> writing_;

    std::mutex mutex_; ///< for what follows
    std::deque<std::shared_ptr<const std::string>> waiting_;
    std::size_t waitingBytes_ = 0;
    bool isScheduled_ = false;       ///< writeNext() is running or will be called
    std::atomic<bool> isCut_{false}; ///< too much waits, or the socket has ended
};

/// The end for services: it may live longer than the socket.
class Handle final : public WebSocket {
  public:
    explicit Handle(std::weak_ptr<Socket> socket) : socket_(std::move(socket)) {}
    void send(std::shared_ptr<const std::string> text) override {
        if (const auto socket = socket_.lock()) socket->send(std::move(text));
    }
    void close(CloseCode code, std::string reason) override {
        if (const auto socket = socket_.lock()) socket->post(code, std::move(reason));
    }
    std::size_t waitingBytes() const override {
        const auto socket = socket_.lock();
        return socket ? socket->waitingBytes() : 0;
    }

  private:
    std::weak_ptr<Socket> socket_;
};

void Socket::open(const Head& head, const Upgrade& upgrade) {
    beast::http::request<beast::http::empty_body> request;
    request.method_string(head.method);
    request.target(head.target);
    request.version(static_cast<unsigned>(10 + head.minorVersion));
    for (const auto& [name, value] : head.headers)
        request.insert(name, value);
    socket_.set_option(
        websocket::stream_base::timeout{kHandshakeTime, websocket::stream_base::none(), false});
    socket_.set_option(websocket::stream_base::decorator([upgrade](websocket::response_type& response) {
        for (const auto& [name, value] : upgrade.headers)
            response.insert(name, value);
        if (!upgrade.subprotocol.empty() && response.result() == beast::http::status::switching_protocols)
            response.set(beast::http::field::sec_websocket_protocol, upgrade.subprotocol);
    }));
    socket_.read_message_max(hub_->limits.socketMessageBytes);
    socket_.auto_fragment(false);
    socket_.text(true);
    socket_.async_accept(request, [self = shared_from_this()](ErrorCode ec) {
        if (!self->hasEnded_) self->opened(ec);
    });
}

void Socket::opened(ErrorCode ec) {
    if (ec) return end();
    isOpen_ = true;
    nextPing_ = Clock::now() + hub_->limits.pingTime;
    socket_.next_layer().gather();
    setsockopt(socket_.next_layer().socket().native_handle(), IPPROTO_TCP, TCP_USER_TIMEOUT, &kUserTimeout,
               sizeof kUserTimeout);
    listener_->opened(std::make_shared<Handle>(weak_from_this()));
    writeNext();
    read();
}

} // namespace

void serveSocket(std::shared_ptr<Hub> hub, Service& service, Stream stream, const Peer& peer,
                 const Head& head, Upgrade upgrade) {
    const auto socket = std::make_shared<Socket>(hub, service, std::move(stream), peer, upgrade.listener);
    hub->channels[peer.connection] = socket;
    socket->open(head, upgrade);
}

} // namespace rapidc::http
