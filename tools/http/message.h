#pragma once
// Requests and responses of HTTP as the server hands them to a service and takes them from it.

#include "tools/http/url.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace rapidc::http {

/// A request before its body has been read.
struct Head {
    std::string method;   ///< as the client wrote it: "GET"
    std::string target;   ///< as the client wrote it
    int minorVersion = 1; ///< of HTTP/1
    FieldList headers;
    std::optional<uint64_t> length; ///< declared bytes of the body; none: no body, or chunked
    bool isChunked = false;
    bool keepsAlive = true; ///< the client wants to use the connection again

    uint64_t connection = 0; ///< number of the TCP connection, never used twice
    std::string peer;        ///< address of the client: "127.0.0.1"
    bool secure = false;     ///< over TLS

    /// The first header of that name, "" when there is none; letter case makes no difference.
    std::string_view header(std::string_view name) const;
    std::size_t count(std::string_view name) const;
    bool asksForSocket() const; ///< Upgrade: websocket
    /// The value of a cookie; "" when there is none.
    std::string_view cookie(std::string_view name) const;
};

struct Request : Head {
    std::string body;
    std::shared_ptr<void> context; ///< what Service::decide() left in its decision
};

struct Response {
    int status = 200;
    FieldList headers; ///< besides Content-Length and Connection; names and values must not hold line ends
    std::string body;
    bool closes = false; ///< the connection ends after this response

    static Response text(int status, std::string body, std::string contentType = "text/plain;charset=utf-8");
};

/// "Not Found".
const char* statusText(int status);
/// Status line and header; `hasBody`: also an empty body is announced.
std::string headOf(const Response& response, bool keepsAlive);

/// Whether a browser that sends this request shows a page of this very server: no Origin, or one that equals Host, where the host is
/// an address or localhost (a name could be made to lead here by whoever owns it). Of an upgrade the scheme may be ws or wss, which no
/// browser writes.
bool hasOwnOrigin(const Head& head);
/// Whether Host is an address or localhost.
bool hasSafeHost(const Head& head);

} // namespace rapidc::http
