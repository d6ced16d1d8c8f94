#pragma once
// RequestParser: bytes -> requests, by the parser of Boost.Beast, with the limits and the strictness of a server that a proxy
// may feed: a request that could be read in two ways is refused.

#include "tools/http/message.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace boost::system {
class error_code;
}

namespace rapidc::http {

struct Limits {
    std::size_t headerBytes = 64 * 1024;
    std::size_t headerFields = 1000;
    std::size_t bodyBytes = 64 * 1024 * 1024;     ///< of one request
    std::size_t allBodyBytes = 256 * 1024 * 1024; ///< of all requests that are being read or answered
    std::size_t connections = 1000;
    std::size_t socketQueueBytes = 8 * 1024 * 1024; ///< waiting for one WebSocket: a slower reader is closed
    std::size_t socketMessageBytes = 1024 * 1024;   ///< of one message from a WebSocket
    std::chrono::seconds headerTime{20};            ///< for a whole header, and for the TLS handshake
    std::chrono::seconds idleTime{300};             ///< between two requests
    std::chrono::seconds progressTime{
        30};                     ///< without a single byte while a body is read or a response written
    std::size_t bodyRate = 1024; ///< bytes a second of a body, on average after the first progressTime
    std::chrono::seconds answerTime{120}; ///< for the service
    std::chrono::seconds pingTime{20};    ///< between pings of WebSockets
};

class RequestParser {
  public:
    enum class State : uint8_t {
        Header,   ///< needs more bytes
        Decision, ///< the header is complete: head() can be taken; keepBody() or dropBody() continues
        Body,     ///< needs more bytes
        Complete, ///< next() begins the next request
        Failed,   ///< status() and reason(); the connection must end
    };

    explicit RequestParser(const Limits& limits);
    ~RequestParser();
    RequestParser(const RequestParser&) = delete;
    RequestParser& operator=(const RequestParser&) = delete;

    State state() const { return state_; }
    /// Takes more bytes. Bytes of later requests are kept.
    void feed(std::string_view bytes);

    /// In state Decision: what was read.
    Head takeHead();
    /// In state Decision: reads the body and keeps it for takeBody(), or only counts it.
    void keepBody(std::size_t limit);
    void dropBody();
    std::string takeBody();
    std::size_t bodyBytes() const;

    /// After Complete: begins the next request with the bytes that have come already.
    void next();
    bool hasBegun() const; ///< some bytes of the present request have come
    /// Bytes after the present request.
    std::string takeRest();

    int status() const { return status_; }
    const std::string& reason() const { return reason_; }

  private:
    struct Beast;

    void begin();
    void advance();
    void readHead();
    bool mayBegin();
    void fail(int status, std::string reason);
    void failWith(const boost::system::error_code& error);

    Limits limits_;
    std::unique_ptr<Beast> beast_;
    std::string buffer_; ///< bytes that are not consumed yet
    std::size_t headerBytes_ = 0;
    Head head_;
    State state_ = State::Header;
    int status_ = 0;
    std::string reason_;
};

} // namespace rapidc::http
