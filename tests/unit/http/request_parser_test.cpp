#include "tools/http/request_parser.h"

#include <catch2/catch.hpp>

using namespace rapidc::http;

namespace {

/// The status with which a header is refused; 0: it is accepted.
int statusOf(const std::string& bytes, const Limits& limits = {}) {
    RequestParser parser(limits);
    parser.feed(bytes);
    if (parser.state() == RequestParser::State::Decision) return 0;
    REQUIRE(parser.state() == RequestParser::State::Failed);
    return parser.status();
}

std::string withHeader(const std::string& lines) {
    return "POST / HTTP/1.1\r\nHost: a\r\n" + lines + "\r\n";
}

} // namespace

TEST_CASE("Requests come out whole, however the bytes arrive", "[http]") {
    const std::string bytes =
        "GET /a?b=c HTTP/1.1\r\nHost: a\r\n\r\n"
        "\r\nPOST /d HTTP/1.1\r\nHost: a\r\nContent-Length: 4\r\n\r\nbody"
        "PUT /e HTTP/1.1\r\nHost: a\r\nTransfer-Encoding: chunked\r\n\r\n2\r\nxy\r\n1\r\nz\r\n0\r\n\r\n";
    for (std::size_t piece = 1; piece <= bytes.size(); ++piece) {
        RequestParser parser({});
        std::vector<std::string> requests;
        std::size_t at = 0;
        while (at < bytes.size() || parser.state() != RequestParser::State::Header) {
            if (parser.state() == RequestParser::State::Decision) {
                requests.push_back(parser.takeHead().target);
                parser.keepBody(100);
            } else if (parser.state() == RequestParser::State::Complete) {
                requests.back() += ' ' + parser.takeBody();
                parser.next();
            } else {
                REQUIRE(parser.state() != RequestParser::State::Failed);
                parser.feed(std::string_view(bytes).substr(at, piece));
                at += piece;
            }
        }
        CHECK(requests == std::vector<std::string>{"/a?b=c ", "/d body", "/e xyz"});
    }
}

TEST_CASE("What could be read in two ways is refused (serve-contract 16)", "[http]") {
    for (const char* lines :
         {"Content-Length: 1\r\nTransfer-Encoding: chunked\r\n",
          "Transfer-Encoding: chunked\r\nContent-Length: 1\r\n", "Content-Length: 1\r\nContent-Length: 1\r\n",
          "Content-Length: 1, 1\r\n", "Content-Length: x\r\n", "Host: b\r\n", "X : y\r\n", "X: y\r\n z\r\n",
          "X: y\r\n\tz\r\n", "X\r\n", ": y\r\n", "X: y\nZ: a\r\n"})
        CHECK(statusOf(withHeader(lines)) == 400);
    for (const char* lines : {"Transfer-Encoding: gzip\r\n", "Transfer-Encoding: gzip, chunked\r\n",
                              "Transfer-Encoding: identity\r\n"})
        CHECK(statusOf(withHeader(lines)) == 501);
    CHECK(statusOf(std::string("GET /\0 HTTP/1.1\r\nHost: a\r\n\r\n", 29)) == 400);
    CHECK(statusOf("GET / HTTP/1.1\r\n\r\n") == 400);
    CHECK(statusOf("GET / HTTP/1.1\r\nHost: a b\r\n\r\n") == 400);
    CHECK(statusOf("GET / HTTP/2.0\r\nHost: a\r\n\r\n") == 505);
    CHECK(statusOf(withHeader("Expect: x\r\n")) == 417);
    CHECK(statusOf(withHeader("X: y\r\n")) == 0);
}

TEST_CASE("Headers and bodies are bounded (serve-contract 15)", "[http]") {
    CHECK(statusOf(withHeader("X: " + std::string(70'000, 'x') + "\r\n")) == 431);
    std::string many;
    for (int i = 0; i < 1000; ++i)
        many += "X: y\r\n";
    CHECK(statusOf(withHeader(many)) == 431); // with Host 1,001
    CHECK(statusOf(withHeader("Content-Length: 67108864\r\n")) == 0);
    CHECK(statusOf(withHeader("Content-Length: 67108865\r\n")) == 413);

    RequestParser pieces({});
    pieces.feed("GET / HTTP/1.1\r\nHost: a\r\n");
    for (int i = 0; i < 200 && pieces.state() == RequestParser::State::Header; ++i)
        pieces.feed("X: " + std::string(500, 'x') + "\r\n");
    CHECK(pieces.status() == 431);

    RequestParser chunks({});
    chunks.feed(withHeader("Transfer-Encoding: chunked\r\n"));
    (void)chunks.takeHead();
    chunks.keepBody(5);
    chunks.feed("3\r\nabc\r\n3\r\n");
    CHECK(chunks.status() == 413);
}

TEST_CASE("A body that is not needed is counted and dropped", "[http]") {
    RequestParser parser({});
    parser.feed(withHeader("Content-Length: 5\r\n") + "ab");
    (void)parser.takeHead();
    parser.dropBody();
    CHECK(parser.state() == RequestParser::State::Body);
    parser.feed("cdeGET");
    CHECK(parser.state() == RequestParser::State::Complete);
    CHECK(parser.bodyBytes() == 0);
    CHECK(parser.takeRest() == "GET");
}

TEST_CASE("Own origins (serve-contract 17)", "[http]") {
    Head head;
    head.headers = {{"Host", "127.0.0.1:80"}};
    CHECK(hasOwnOrigin(head));
    const auto with = [](std::string host, std::string origin, bool secure = false) {
        Head asked;
        asked.secure = secure;
        asked.headers = {{"Host", std::move(host)}, {"Origin", std::move(origin)}};
        return hasOwnOrigin(asked);
    };
    CHECK(with("127.0.0.1:80", "http://127.0.0.1:80"));
    CHECK(with("localhost:80", "http://LOCALHOST:80"));
    CHECK(with("[::1]:80", "https://[::1]:80", true));
    CHECK_FALSE(with("127.0.0.1:80", "https://127.0.0.1:80"));
    CHECK_FALSE(with("127.0.0.1:80", "null"));
    CHECK_FALSE(with("127.0.0.1:80", ""));
    CHECK_FALSE(with("127.0.0.1:80", "http://127.0.0.1:81"));
    CHECK_FALSE(with("evil.example", "http://evil.example")); // a name that leads here
    CHECK(with("127.0.0.1", "http://127.0.0.1:80")); // the port that the scheme has by itself (RFC 6454 4)
    CHECK(with("127.0.0.1:443", "https://127.0.0.1", true));
    CHECK_FALSE(with("127.0.0.1:443", "http://127.0.0.1"));
    CHECK_FALSE(with("127.0.0.1:80", "ws://127.0.0.1:80")); // of an upgrade only
    Head upgrade;
    upgrade.headers = {{"Host", "127.0.0.1:8080"},
                       {"Origin", "ws://127.0.0.1:8080"},
                       {"Connection", "Upgrade"},
                       {"Upgrade", "websocket"}};
    CHECK(hasOwnOrigin(upgrade));
    upgrade.secure = true;
    CHECK_FALSE(hasOwnOrigin(upgrade));
}

TEST_CASE("Cookies are found by name", "[http]") {
    Head head;
    head.headers = {{"Cookie", "a=1; -http-session-=x=y ;b"}, {"cookie", "c=3"}};
    CHECK(head.cookie("a") == "1");
    CHECK(head.cookie("-http-session-") == "x=y");
    CHECK(head.cookie("c") == "3");
    CHECK(head.cookie("b").empty());
    CHECK(head.cookie("A").empty());
}
