#include "tools/rws/sessions.h"

#include <catch2/catch.hpp>

#include <set>

using namespace rapidc::rws;

TEST_CASE("There are at most seventy sessions (serve-contract 13)", "[rws]") {
    std::set<uint64_t> ended;
    Sessions sessions([&](uint64_t number) { ended.insert(number); });
    std::set<std::string> cookies;
    uint64_t first = 0;
    for (uint64_t i = 0; i < 70; ++i) {
        const Sessions::LoggedOn* session =
            sessions.logOn(i % 2 ? Dialect::V1 : Dialect::V2, "Admin", "127.0.0.1", i, "");
        REQUIRE(session);
        CHECK(session->cookie.size() >= 16);
        cookies.insert(session->cookie);
        if (i == 0) first = session->session->number;
    }
    CHECK(cookies.size() == 70);
    CHECK_FALSE(sessions.logOn(Dialect::V1, "Admin", "127.0.0.1", 100, ""));
    sessions.end(first);
    CHECK(ended == std::set<uint64_t>{first});
    CHECK(sessions.logOn(Dialect::V1, "Admin", "127.0.0.1", 100, ""));
}

TEST_CASE("A session belongs to its cookie, its dialect and its connection (serve-contract 12)", "[rws]") {
    Sessions sessions([](uint64_t) {});
    const Sessions::LoggedOn* session = sessions.logOn(Dialect::V1, "Admin", "127.0.0.1", 7, "nonce");
    REQUIRE(session);
    const std::string cookie = session->cookie;
    CHECK(sessions.find(cookie, Dialect::V1) == session);
    CHECK_FALSE(sessions.find(cookie, Dialect::V2));
    CHECK_FALSE(sessions.find("", Dialect::V1));
    CHECK_FALSE(sessions.find(cookie + "0", Dialect::V1));
    CHECK(sessions.ofConnection(7, "Admin", "nonce") == session);
    CHECK_FALSE(sessions.ofConnection(7, "Admin", "another")); // another client of the same process
    CHECK_FALSE(sessions.ofConnection(7, "Default User", "nonce"));
    CHECK_FALSE(sessions.ofConnection(8, "Admin", "nonce"));
    const std::string context = session->abbcx;
    CHECK(sessions.ofContext(context, "Admin", Dialect::V1) == session);
    CHECK_FALSE(sessions.ofContext(context, "Default User", Dialect::V1));
    CHECK_FALSE(sessions.ofContext(context, "Admin", Dialect::V2));
    CHECK_FALSE(sessions.ofContext("", "Admin", Dialect::V1));
    sessions.connectionEnded(7);
    CHECK_FALSE(sessions.ofConnection(7, "Admin", "nonce"));
    CHECK(sessions.find(cookie, Dialect::V1));
    sessions.end(session->session->number);
    CHECK_FALSE(sessions.find(cookie, Dialect::V1));
}

TEST_CASE("A restart ends the sessions of the time before (decision 132)", "[rws]") {
    std::set<uint64_t> ended;
    Sessions sessions([&](uint64_t number) { ended.insert(number); });
    const Sessions::LoggedOn* before = sessions.logOn(Dialect::V1, "Admin", "127.0.0.1", 1, "nonce", 2);
    const Sessions::LoggedOn* after = sessions.logOn(Dialect::V2, "Admin", "127.0.0.1", 2, "", 3);
    REQUIRE((before && after));
    const uint64_t number = before->session->number;
    const std::string old = before->cookie, current = after->cookie;
    sessions.endBefore(3);
    CHECK(ended == std::set<uint64_t>{number});
    CHECK_FALSE(sessions.find(old, Dialect::V1));
    CHECK_FALSE(sessions.ofConnection(1, "Admin", "nonce"));
    CHECK(sessions.find(current, Dialect::V2));
}

TEST_CASE(
    "A burst of more than a thousand requests meets the limit, three hundred do not (serve-contract 14)",
    "[rws]") {
    CHECK(Sessions::kMostPerSecond >= 300);
    CHECK(2 * Sessions::kMostPerSecond < 1000); // a second can fall into two seconds of the count
}
