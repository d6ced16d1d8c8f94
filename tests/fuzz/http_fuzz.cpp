// libFuzzer target: what a client of `rapidc serve` can send: requests, targets, forms, log on, media types. Must not crash or hang.
//
// The first byte chooses the size of the pieces in which the bytes arrive; the outcome must not depend on it.

#include "fuzz_support.h"
#include "tools/http/request_parser.h"
#include "tools/rws/digest.h"
#include "tools/rws/negotiation.h"
#include "tools/rws/path_pattern.h"

#include <vector>

namespace {

using namespace rapidc;
using http::RequestParser;
using rapid::fuzz::require;

http::Limits smallLimits() {
    http::Limits limits;
    limits.headerBytes = 2048;
    limits.headerFields = 20;
    limits.bodyBytes = 4096;
    return limits;
}

/// The layers above the parser read a head.
void readHead(const http::Head& head) {
    require(!head.method.empty() && !head.target.empty(), "a request without method or target");
    require(head.headers.size() <= smallLimits().headerFields, "too many headers");
    require(head.count("Host") <= 1, "two hosts");
    require(!(head.isChunked && head.length), "two lengths");
    require(!head.isChunked || head.count("Content-Length") == 0, "two lengths");
    for (const auto& [name, value] : head.headers)
        require(value.find_first_of(std::string_view("\r\n\0", 3)) == std::string::npos,
                "a line end or NUL in a header");
    (void)http::hasOwnOrigin(head);
    (void)http::hasSafeHost(head);
    (void)head.asksForSocket();
    (void)head.cookie("-http-session-");
    (void)rws::acceptedForm(head.header("Accept"), "/rw/elog/0");
    (void)rws::isAcceptedContent(head, "/rw/panel");
    (void)rws::parseAuthorization(head.header("Authorization"), "Digest");
    if (const auto target = http::parseTarget(head.target)) {
        require(target->path.starts_with('/'), "a path without '/'");
        require(target->path.find('\0') == std::string::npos, "NUL in a path");
        const rws::PathPattern pattern("/a/{b}/{c*}/d");
        if (pattern.matches(target->segments))
            require(pattern.parametersOf(target->segments).size() == 2, "a parameter is missing");
    }
}

/// All requests of a stream as text, and the status of its end.
std::string outcomeOf(std::string_view bytes, std::size_t piece) {
    RequestParser parser(smallLimits());
    std::string outcome;
    std::size_t at = 0;
    for (int guard = 0; guard < 100'000; ++guard) {
        switch (parser.state()) {
        case RequestParser::State::Header:
        case RequestParser::State::Body:
            if (at >= bytes.size()) return outcome + "open";
            parser.feed(bytes.substr(at, piece));
            at += piece;
            break;
        case RequestParser::State::Decision: {
            const http::Head head = parser.takeHead();
            readHead(head);
            outcome += head.method + ' ' + head.target + '\n';
            if (head.method == "DROP")
                parser.dropBody();
            else
                parser.keepBody(2000);
            break;
        }
        case RequestParser::State::Complete: {
            const std::string body = parser.takeBody();
            require(body.size() <= 2000, "a body is too large");
            outcome += std::to_string(body.size()) + '\n';
            if (const auto fields = http::parseFields(body))
                for (const auto& [name, value] : *fields)
                    require(name.find('\0') == std::string::npos && value.find('\0') == std::string::npos,
                            "NUL in a form");
            parser.next();
            break;
        }
        case RequestParser::State::Failed:
            require((parser.status() >= 400 && parser.status() < 500) || parser.status() == 501 ||
                        parser.status() == 505,
                    "a wrong status");
            return outcome + "failed";
        }
    }
    require(false, "the parser does not come to an end");
    return outcome;
}

/// The same requests. A header without its end may have been refused already or not yet.
bool isSame(const std::string& a, const std::string& b) {
    return a.substr(0, a.rfind('\n') + 1) == b.substr(0, b.rfind('\n') + 1);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size == 0 || size > 1 << 14) return 0;
    const std::string bytes = rapid::fuzz::bytesOf(data + 1, size - 1);
    require(isSame(outcomeOf(bytes, bytes.size() + 1), outcomeOf(bytes, 1 + data[0] % 64)),
            "the outcome depends on how the bytes arrive");
    (void)http::parseTarget(bytes);
    (void)http::parseFields(bytes);
    (void)http::decodeBase64(bytes);
    (void)rws::parseAuthorization("Digest " + bytes, "Digest");
    (void)rws::acceptedForm(bytes, "/");
    require(http::decodePercent(http::encodePercent(bytes)).value_or(bytes) == bytes,
            "escaping loses something");
    return 0;
}
