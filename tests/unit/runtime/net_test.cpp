// Addresses, options and the computer's sockets, without a program.

#include "runtime/log/event_log.h"
#include "runtime/net/address.h"
#include "runtime/net/host_socket.h"
#include "runtime/net/network.h"
#include "runtime/net/network_options.h"
#include "runtime/sched/scheduler.h"

#include <catch2/catch.hpp>

using namespace rt::net;

TEST_CASE("addresses are four numbers", "[net]") {
    uint32_t ip = 1;
    CHECK((parseIp("192.168.125.1", ip) && ip == kServicePort));
    CHECK((parseIp("0.0.0.0", ip) && ip == kAnyAddress));
    for (const char* wrong :
         {"", "1.2.3", "1.2.3.4.5", "1.2.3.256", "1.2.3.-4", "localhost", " 1.2.3.4", "1.2.3.4 "})
        CHECK_FALSE(parseIp(wrong, ip));
    CHECK_FALSE(parseIp(std::string_view("1.2.3.4\0", 8), ip));
    CHECK(addressText({kLoopback, 5000}) == "127.0.0.1:5000");
    CHECK(isLoopback(kLoopback + 5));
    CHECK_FALSE(isLoopback(kServicePort));
}

TEST_CASE("options of the network", "[net]") {
    NetworkOptions options;
    CHECK(takeListen(options, "any").empty());
    CHECK(options.listen == kAnyAddress);
    CHECK(takeListen(options, "127.0.0.2").empty());
    CHECK(options.listen == kLoopback + 1);
    CHECK_FALSE(takeListen(options, "here").empty());
    CHECK(takeConnect(options, "192.168.125.1").empty());
    CHECK(takeConnect(options, "10.0.0.1=127.0.0.1").empty());
    for (const char* wrong : {"", "=", "10.0.0.1=", "=10.0.0.1", "10.0.0.1=x", "all"})
        CHECK_FALSE(takeConnect(options, wrong).empty());
    CHECK(options.connect.size() == 2);
    CHECK_FALSE(options.connectAnywhere);
    CHECK(takeConnect(options, "any").empty());
    CHECK(options.connectAnywhere);
}

TEST_CASE("how far a program reaches", "[net]") {
    rt::Scheduler scheduler({});
    rt::EventLog log;
    constexpr uint32_t kFar = 0x0A010203, kOwn = 0xC0A80105;
    NetworkOptions options;
    Network closed, open, away;
    closed.open(scheduler, log, options);
    CHECK(closed.boundIp(kOwn) == kLoopback);
    CHECK(closed.boundIp(kAnyAddress) == kLoopback);
    CHECK_FALSE(closed.outsideIp(kFar));
    CHECK(closed.outsideIp(kLoopback) == kLoopback);
    CHECK(closed.outsideIp(kServicePort) == kLoopback);
    closed.addOwn(kOwn);
    CHECK(closed.outsideIp(kOwn) == kLoopback);
    CHECK(takeListen(options, "any").empty());
    CHECK(takeConnect(options, "10.1.2.3=127.0.0.1").empty());
    open.open(scheduler, log, options);
    CHECK(open.boundIp(kOwn) == kOwn);
    CHECK(open.listensAnywhere());
    CHECK(open.outsideIp(kFar) == kLoopback);
    CHECK_FALSE(open.outsideIp(kFar + 1));
    options.offline = true;
    away.open(scheduler, log, options);
    CHECK_FALSE(away.outsideIp(kLoopback));
}

TEST_CASE("the computer's sockets never wait", "[net]") {
    HostSocket server, accepted;
    Address from;
    REQUIRE(server.open(false).ok());
    REQUIRE(server.bind({kLoopback, 0}).ok());
    REQUIRE(server.listen(1).ok());
    CHECK(server.accept(accepted, from).fault == Fault::Again);
    HostSocket unused;
    REQUIRE(unused.open(true).ok());
    char buffer[8];
    std::size_t got = 0;
    REQUIRE(unused.bind({kLoopback, 0}).ok());
    CHECK(unused.receiveFrom(buffer, sizeof buffer, got, from).fault == Fault::Again);
    const int fd = server.fd();
    HostSocket moved = std::move(server);
    CHECK_FALSE(server.isOpen());
    CHECK(moved.fd() == fd);
    moved.close();
    CHECK_FALSE(moved.isOpen());
}
