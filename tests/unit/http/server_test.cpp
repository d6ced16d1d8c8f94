#include "tools/http/server.h"
#include "tools/http/tls.h"

#include <catch2/catch.hpp>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <thread>

using namespace rapidc::http;

namespace {

/// A client that sends bytes and reads until it has seen a text or the end.
class Client {
  public:
    explicit Client(uint16_t port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(port);
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        REQUIRE(connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
        const timeval limit{20, 0};
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
    }
    ~Client() { close(socket_); }
    Client(const Client&) = delete;
    Client& operator=(const Client&) = delete;

    void send(const std::string& bytes) const {
        (void)!::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    }
    /// All that comes, up to and with `end` ("": up to the end of the connection).
    std::string read(const std::string& end = {}) {
        char bytes[4096];
        for (;;) {
            const std::size_t at = end.empty() ? std::string::npos : read_.find(end);
            if (at != std::string::npos) {
                const std::string text = read_.substr(0, at + end.size());
                read_.erase(0, at + end.size());
                return text;
            }
            const ssize_t size = recv(socket_, bytes, sizeof bytes, 0);
            if (size <= 0) return std::exchange(read_, {});
            read_.append(bytes, static_cast<std::size_t>(size));
        }
    }

  private:
    int socket_;
    std::string read_;
};

/// Sends back every message of a socket, and many more when it is asked to.
class Echo final : public SocketListener {
  public:
    explicit Echo(std::atomic<int>& open) : open_(open) {}
    void opened(std::shared_ptr<WebSocket> socket) override {
        ++open_;
        socket_ = std::move(socket);
    }
    void received(std::string message, bool) override { socket_->send("<" + message + ">"); }
    void closed() override { --open_; }

  private:
    std::atomic<int>& open_;
    std::shared_ptr<WebSocket> socket_;
};

/// Answers on threads of its own, later.
class Later final : public Service {
  public:
    ~Later() override {
        for (std::thread& thread : threads_)
            thread.join();
    }
    Decision decide(const Head& head) override {
        Decision decision;
        if (head.asksForSocket())
            decision.upgrade = Upgrade{"", {}, std::make_shared<Echo>(sockets)};
        else if (head.target == "/refused")
            decision.answer = Response::text(403, "no");
        decision.bodyLimit = 1000;
        return decision;
    }
    void handle(Request request, Respond respond) override {
        if (request.target == "/dropped") return;
        threads_.emplace_back(
            [body = request.target + request.body, respond] { respond(Response::text(200, body + "\n")); });
    }
    void connectionEnded(uint64_t) override { ++ended; }
    std::atomic<int> ended{0}, sockets{0};

  private:
    std::vector<std::thread> threads_;
};

struct Running {
    Later service;
    Server server;
    uint16_t port = 0;
    explicit Running(Limits limits = {}) : server(limits) {
        Endpoint endpoint;
        endpoint.service = &service;
        REQUIRE(server.listen(endpoint, port).empty());
        server.start();
    }
    ~Running() { server.stop(); }
};

/// A masked frame of a client whose mask is zero.
std::string frame(const std::string& text) {
    return std::string{'\x81', static_cast<char>(0x80 | text.size()), 0, 0, 0, 0} + text;
}

} // namespace

TEST_CASE("Answers come in the order of the requests, whatever thread they come from", "[http]") {
    Running running;
    Client client(running.port);
    client.send("GET /1 HTTP/1.1\r\nHost: a\r\n\r\nPOST /2 HTTP/1.1\r\nHost: a\r\nContent-Length: "
                "1\r\n\r\nxGET /3 HTTP/1.1\r\nHost: a\r\n\r\n");
    for (const char* text : {"/1\n", "/2x\n", "/3\n"})
        CHECK(client.read(text).find("HTTP/1.1 200 OK\r\n") == 0);
}

TEST_CASE("A request that a service drops is answered", "[http]") {
    Running running;
    Client client(running.port);
    client.send("GET /dropped HTTP/1.1\r\nHost: a\r\n\r\nGET /next HTTP/1.1\r\nHost: a\r\n\r\n");
    CHECK(client.read("/next\n").find("HTTP/1.1 503") == 0);
}

TEST_CASE("The body of a refused request is read and dropped", "[http]") {
    Running running;
    Client client(running.port);
    client.send("POST /refused HTTP/1.1\r\nHost: a\r\nContent-Length: 100000\r\n\r\n" +
                std::string(100'000, 'x') + "GET /next HTTP/1.1\r\nHost: a\r\n\r\n");
    CHECK(client.read("/next\n").find("HTTP/1.1 403") == 0);
    Client waits(running.port);
    waits.send("POST /refused HTTP/1.1\r\nHost: a\r\nExpect: 100-continue\r\nContent-Length: 5\r\n\r\n");
    CHECK(waits.read().find("HTTP/1.1 403") == 0);
    Client tooLarge(running.port);
    tooLarge.send("POST /x HTTP/1.1\r\nHost: a\r\nContent-Length: 1001\r\n\r\n");
    CHECK(tooLarge.read().find("HTTP/1.1 413") == 0);
}

TEST_CASE("All bodies together are bounded", "[http]") {
    Limits limits;
    limits.allBodyBytes = 500;
    Running running(limits);
    Client first(running.port), second(running.port);
    first.send("POST /a HTTP/1.1\r\nHost: a\r\nContent-Length: 900\r\n\r\n" + std::string(600, 'x'));
    CHECK(first.read().find("HTTP/1.1 503") == 0);
    second.send("POST /b HTTP/1.1\r\nHost: a\r\nContent-Length: 400\r\n\r\n" + std::string(400, 'x'));
    CHECK(second.read("x\n").find("HTTP/1.1 200") == 0);
}

TEST_CASE("A body that comes drop by drop ends the connection, a slow one that keeps the rate does not",
          "[http][slow]") {
    Limits limits;
    limits.progressTime = std::chrono::seconds(1);
    limits.bodyRate = 100;
    Running running(limits);
    const auto send = [&](std::size_t bytes) {
        Client client(running.port);
        client.send("POST /body HTTP/1.1\r\nHost: a\r\nContent-Length: 400\r\n\r\n");
        for (std::size_t sent = 0; sent < 400 && sent / bytes < 16; sent += bytes) {
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            client.send(std::string(bytes, 'x'));
        }
        return client.read(bytes > 1 ? "x\n" : "");
    };
    CHECK(send(1).empty()); // 10 bytes a second
    CHECK(send(25).find("HTTP/1.1 200") == 0);
}

TEST_CASE("When there are too many connections, the one that waits longest makes room", "[http]") {
    Limits limits;
    limits.connections = 3;
    Running running(limits);
    Client first(running.port), second(running.port), third(running.port);
    first.send("GET / HTTP/1.1\r\n");
    Client fourth(running.port);
    fourth.send("GET /4 HTTP/1.1\r\nHost: a\r\n\r\n");
    CHECK(fourth.read("/4\n").find("HTTP/1.1 200") == 0);
    CHECK(first.read().empty());
}

TEST_CASE("WebSockets: upgrade, bytes that came with it, messages, end", "[http]") {
    Running running;
    {
        Client client(running.port);
        client.send("GET /s HTTP/1.1\r\nHost: a\r\nUpgrade: websocket\r\nConnection: "
                    "Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n" +
                    frame("early"));
        CHECK(client.read("\r\n\r\n").find("s3pPLMBiTxaQ9kYGzzhZRbK+xOo=") !=
              std::string::npos); // RFC 6455, 1.3
        CHECK(client.read("<early>") == "\x81\x07<early>");
        for (int i = 0; i < 1000; ++i)
            client.send(frame("x"));
        for (int i = 0; i < 1000; ++i)
            REQUIRE(client.read("<x>") == "\x81\x03<x>");
        CHECK(running.service.sockets == 1);
    }
    Client broken(running.port);
    broken.send("GET /s HTTP/1.1\r\nHost: a\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\r\n");
    CHECK(broken.read().find("HTTP/1.1 400") == 0);
    running.server.stop();
    CHECK(running.service.sockets <= 1);
}

TEST_CASE("A server ends while connections of all kinds are there", "[http]") {
    auto running = std::make_unique<Running>();
    Client idle(running->port), half(running->port), socket(running->port);
    half.send("POST / HTTP/1.1\r\nHost: a\r\nContent-Length: 10\r\n\r\nabc");
    socket.send("GET /s HTTP/1.1\r\nHost: a\r\nUpgrade: websocket\r\nConnection: "
                "Upgrade\r\nSec-WebSocket-Version: 13\r\n"
                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    socket.read("\r\n\r\n");
    while (running->service.sockets == 0) // the service hears of it after the client
        std::this_thread::yield();
    running.reset();
    CHECK(idle.read().empty());
    const std::string farewell = socket.read();
    REQUIRE(farewell.size() >= 4);
    CHECK(farewell[0] == '\x88');
    CHECK(farewell.substr(2, 2) == "\x03\xe9"); // 1001
}

TEST_CASE("A port is taken once", "[http]") {
    Running running;
    Endpoint endpoint;
    endpoint.port = running.port;
    endpoint.service = &running.service;
    Server other;
    uint16_t port = 0;
    CHECK_FALSE(other.listen(endpoint, port).empty());
    endpoint.address = "not an address";
    CHECK_FALSE(other.listen(endpoint, port).empty());
}
