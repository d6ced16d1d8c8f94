#include "tools/http/request_parser.h"

#include "config/letter_case.h"

#include <boost/asio/buffer.hpp>
#include <boost/beast/http/basic_parser.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/fields.hpp>
#include <boost/beast/http/parser.hpp>

namespace rapidc::http {

namespace beast = boost::beast;
using rapid::config::sameName;

namespace {

/// A body that is kept or only counted.
struct Sink {
    std::string bytes;
    bool keeps = false;
};

struct SinkBody {
    using value_type = Sink;
    class reader {
      public:
        template <bool isRequest, class Fields>
        reader(beast::http::header<isRequest, Fields>&, value_type& sink) : sink_(sink) {}
        void init(const boost::optional<std::uint64_t>&, beast::error_code& ec) { ec = {}; }
        template <class Buffers> std::size_t put(const Buffers& buffers, beast::error_code& ec) {
            ec = {};
            const std::size_t size = boost::asio::buffer_size(buffers);
            if (!sink_.keeps) return size;
            const std::size_t before = sink_.bytes.size();
            sink_.bytes.resize(before + size);
            return boost::asio::buffer_copy(boost::asio::buffer(&sink_.bytes[before], size), buffers);
        }
        void finish(beast::error_code& ec) { ec = {}; }

      private:
        value_type& sink_;
    };
};

/// Lines of the chunked coding and trailers, which are not kept, may wait for so many bytes at most.
constexpr std::size_t kMostWaiting = 64 * 1024;
/// Bytes that a client may send in advance of the responses.
constexpr std::size_t kMostPipelined = 4 * 1024 * 1024;

bool isHostCharacter(char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           std::string_view(".-_:[]").find(c) != std::string_view::npos;
}

struct Refusal {
    int status = 0; ///< 0: none
    std::string reason;
};

Refusal checkHost(const Head& head) {
    const std::size_t hosts = head.count("Host");
    if (hosts > 1) return {400, "two Host headers"};
    if (hosts == 0) return head.minorVersion == 0 ? Refusal{} : Refusal{400, "no Host header"};
    for (const char c : head.header("Host"))
        if (!isHostCharacter(c)) return {400, "the Host header is not a host"};
    return {};
}

/// The rules that Beast leaves to its users.
Refusal checkHead(const Head& head, const Limits& limits) {
    if (head.headers.size() > limits.headerFields) return {431, "too many headers"};
    if (const Refusal host = checkHost(head); host.status) return host;
    const std::size_t codings = head.count("Transfer-Encoding");
    if (codings > 0 && (codings > 1 || !sameName(head.header("Transfer-Encoding"), "chunked")))
        return {501, "a transfer coding other than chunked"};
    if (codings > 0 && head.count("Content-Length") > 0) return {400, "two lengths of the body"};
    if (codings > 0 && head.minorVersion == 0) return {400, "a transfer coding in HTTP/1.0"};
    if (head.count("Content-Length") > 1 || head.header("Content-Length").find(',') != std::string_view::npos)
        return {400, "two lengths of the body"};
    if (head.count("Expect") > 0 && !sameName(head.header("Expect"), "100-continue"))
        return {417, "an expectation other than 100-continue"};
    return {};
}

} // namespace

namespace {

/// A line that begins with a blank continues the one before, which others may read differently.
bool hasPlainLines(std::string_view header) {
    return header.find("\r\n ") == std::string_view::npos && header.find("\r\n\t") == std::string_view::npos;
}

} // namespace

struct RequestParser::Beast {
    beast::http::request_parser<SinkBody> parser;
};

RequestParser::RequestParser(const Limits& limits) : limits_(limits) {
    begin();
}

RequestParser::~RequestParser() = default;

void RequestParser::begin() {
    beast_ = std::make_unique<Beast>();
    beast_->parser.header_limit(static_cast<std::uint32_t>(limits_.headerBytes));
    beast_->parser.body_limit(limits_.bodyBytes);
    beast_->parser.eager(false);
    state_ = State::Header;
    headerBytes_ = 0;
    head_ = {};
}

void RequestParser::next() {
    begin();
    advance();
}

bool RequestParser::hasBegun() const {
    return headerBytes_ > 0 || !buffer_.empty();
}

std::string RequestParser::takeRest() {
    return std::exchange(buffer_, {});
}

void RequestParser::fail(int status, std::string reason) {
    state_ = State::Failed;
    status_ = status;
    reason_ = std::move(reason);
    buffer_.clear();
}

void RequestParser::feed(std::string_view bytes) {
    if (state_ == State::Failed) return;
    buffer_ += bytes;
    if (buffer_.size() > limits_.headerBytes + kMostPipelined)
        return fail(400, "too much before the response");
    advance();
}

/// Empty lines before a request are skipped (RFC 9112, 2.2). Whether something is left.
bool RequestParser::mayBegin() {
    std::size_t blank = 0;
    while (blank + 1 < buffer_.size() && buffer_[blank] == '\r' && buffer_[blank + 1] == '\n')
        blank += 2;
    buffer_.erase(0, blank);
    return !buffer_.empty() && buffer_ != "\r";
}

void RequestParser::advance() {
    if (state_ == State::Header && headerBytes_ == 0 && !mayBegin()) return;
    while ((state_ == State::Header || state_ == State::Body) && !buffer_.empty()) {
        beast::error_code ec;
        const std::size_t used = beast_->parser.put(boost::asio::buffer(buffer_), ec);
        if (state_ == State::Header && !hasPlainLines(std::string_view(buffer_).substr(0, used)))
            return fail(400, "a header over several lines");
        buffer_.erase(0, used);
        if (ec && ec != beast::http::error::need_more) return failWith(ec);
        if (state_ == State::Header) {
            // Beast limits what it has not consumed yet; this is the sum.
            headerBytes_ += used;
            const bool isDone = beast_->parser.is_header_done();
            if (headerBytes_ + (isDone ? 0 : buffer_.size()) > limits_.headerBytes)
                return fail(431, "the header is too large");
            if (isDone) return readHead();
        } else if (beast_->parser.is_done()) {
            state_ = State::Complete;
        }
        if (used == 0) break;
    }
    if (state_ == State::Body && buffer_.size() > kMostWaiting)
        fail(400, "a line of the chunked body is too long");
}

void RequestParser::failWith(const boost::system::error_code& ec) {
    using beast::http::error;
    if (ec == error::body_limit) return fail(413, "the body is too large");
    if (ec == error::header_limit || ec == error::buffer_overflow)
        return fail(431, "the header is too large");
    if (ec == error::bad_version) return fail(505, "a version other than HTTP/1.1 and HTTP/1.0");
    fail(400, ec.message());
}

void RequestParser::readHead() {
    const auto& message = beast_->parser.get();
    head_.method = std::string(message.method_string());
    head_.target = std::string(message.target());
    head_.minorVersion = static_cast<int>(message.version() % 10);
    for (const auto& field : message)
        head_.headers.emplace_back(std::string(field.name_string()), std::string(field.value()));
    if (const Refusal refusal = checkHead(head_, limits_); refusal.status)
        return fail(refusal.status, refusal.reason);
    if (const auto length = beast_->parser.content_length()) head_.length = *length;
    head_.isChunked = beast_->parser.chunked();
    head_.keepsAlive = beast_->parser.keep_alive();
    state_ = State::Decision;
}

Head RequestParser::takeHead() {
    return std::move(head_);
}

void RequestParser::keepBody(std::size_t limit) {
    beast_->parser.get().body().keeps = true;
    if (const auto length = beast_->parser.content_length(); length && *length > limit)
        return fail(413, "the body is too large");
    beast_->parser.body_limit(std::min(limit, limits_.bodyBytes));
    dropBody();
}

void RequestParser::dropBody() {
    beast_->parser.eager(true);
    state_ = State::Body;
    if (beast_->parser.is_done())
        state_ = State::Complete;
    else
        advance();
}

std::string RequestParser::takeBody() {
    return std::move(beast_->parser.get().body().bytes);
}

std::size_t RequestParser::bodyBytes() const {
    return beast_->parser.get().body().bytes.size();
}

} // namespace rapidc::http
