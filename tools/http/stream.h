#pragma once
// Stream: a TCP connection with or without TLS, as one type, so that connections and WebSockets are compiled once. Internal to
// tools/http: it includes Boost. Used on the network thread only.
//
// After gather() it collects what is written and sends it in few large pieces: WebSockets carry many small frames.

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/ssl/stream.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/bind_handler.hpp>
#include <boost/beast/core/error.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/websocket/teardown.hpp>

#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace rapidc::http {

namespace asio = boost::asio;
namespace beast = boost::beast;
using ErrorCode = boost::system::error_code;

class Stream {
  public:
    using Socket = asio::ip::tcp::socket;
    using executor_type = Socket::executor_type;

    /// `tls`: null for a plain connection; it must live longer than the stream.
    Stream(Socket socket, asio::ssl::context* tls) : state_(std::make_shared<State>(std::move(socket))) {
        if (tls) state_->tls = std::make_unique<asio::ssl::stream<Socket&>>(state_->socket, *tls);
    }

    executor_type get_executor() { return state_->socket.get_executor(); }
    Socket& socket() { return state_->socket; }
    asio::ssl::stream<Socket&>* tls() { return state_->tls.get(); }
    void close() {
        ErrorCode ignored;
        state_->socket.close(ignored);
    }

    /// Bytes that were read already and come first.
    void unread(std::string bytes) { state_->unread = std::move(bytes); }
    void gather() { state_->gathers = true; }

    template <class Buffers, class Handler> void async_read_some(const Buffers& buffers, Handler&& handler) {
        State& state = *state_;
        if (!state.unread.empty()) {
            const std::size_t size = asio::buffer_copy(buffers, asio::buffer(state.unread));
            state.unread.erase(0, size);
            asio::post(get_executor(),
                       beast::bind_front_handler(std::forward<Handler>(handler), ErrorCode{}, size));
        } else if (state.tls) {
            state.tls->async_read_some(buffers, std::forward<Handler>(handler));
        } else {
            state.socket.async_read_some(buffers, std::forward<Handler>(handler));
        }
    }

    template <class Buffers, class Handler> void async_write_some(const Buffers& buffers, Handler&& handler) {
        State& state = *state_;
        if (state.gathers) return gatherSome(buffers, std::forward<Handler>(handler));
        if (state.tls)
            state.tls->async_write_some(buffers, std::forward<Handler>(handler));
        else
            state.socket.async_write_some(buffers, std::forward<Handler>(handler));
    }

    /// After what was gathered has been sent: ends both directions.
    template <class Handler> void endGracefully(Handler&& handler) {
        auto kept = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler));
        whenSent(*state_, [state = state_, kept] {
            ErrorCode ignored;
            state->socket.shutdown(Socket::shutdown_both, ignored);
            state->socket.close(ignored);
            (*kept)(ErrorCode{});
        });
    }

  private:
    static constexpr std::size_t kMostGathered = 128 * 1024;

    struct State {
        explicit State(Socket moved) : socket(std::move(moved)) {}
        Socket socket;
        std::unique_ptr<asio::ssl::stream<Socket&>> tls;
        std::string unread;
        bool gathers = false, isSending = false;
        std::string gathered, sending;
        ErrorCode failed;
        std::function<void(ErrorCode)> writer; ///< waits for room
        std::function<void()> ender;           ///< waits until all has been sent
    };

    template <class Buffers, class Handler> void gatherSome(const Buffers& buffers, Handler&& handler) {
        State& state = *state_;
        const std::size_t size = asio::buffer_size(buffers);
        if (!state.failed) {
            const std::size_t before = state.gathered.size();
            state.gathered.resize(before + size);
            asio::buffer_copy(asio::buffer(&state.gathered[before], size), buffers);
        }
        const bool isFull = state.gathered.size() >= kMostGathered;
        if (!isFull) {
            asio::post(get_executor(), beast::bind_front_handler(std::forward<Handler>(handler), state.failed,
                                                                 state.failed ? std::size_t{0} : size));
        } else {
            auto kept = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler));
            state.writer = [kept, size](ErrorCode ec) { (*kept)(ec, ec ? 0 : size); };
        }
        if (!state.isSending && !state.failed) {
            state.isSending = true;
            // Posted, so that the frames that are written in this turn go together.
            asio::post(get_executor(), [kept = state_] { send(kept); });
        }
    }

    static void send(const std::shared_ptr<State>& state) {
        state->sending.swap(state->gathered);
        state->gathered.clear();
        const auto sent = [state](ErrorCode ec, std::size_t) {
            state->failed = ec;
            if (ec) state->gathered.clear();
            state->isSending = !state->gathered.empty();
            if (state->isSending) send(state);
            if (auto writer = std::exchange(state->writer, nullptr)) writer(ec);
            if (state->isSending) return;
            if (auto ender = std::exchange(state->ender, nullptr)) ender();
        };
        if (state->tls)
            asio::async_write(*state->tls, asio::buffer(state->sending), sent);
        else
            asio::async_write(state->socket, asio::buffer(state->sending), sent);
    }

    static void whenSent(State& state, std::function<void()> then) {
        if (state.isSending)
            state.ender = std::move(then);
        else
            asio::post(state.socket.get_executor(), std::move(then));
    }

    std::shared_ptr<State> state_;
};

/// How Beast ends a WebSocket.
template <class Handler> void async_teardown(beast::role_type, Stream& stream, Handler&& handler) {
    stream.endGracefully(std::forward<Handler>(handler));
}
inline void teardown(beast::role_type, Stream& stream, ErrorCode& ec) {
    ec = {};
    stream.close();
}
inline void beast_close_socket(Stream& stream) {
    stream.close();
}

} // namespace rapidc::http
