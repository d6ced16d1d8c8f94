#include "tools/http/crypto.h"
#include "tools/rws/digest.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace rapidc;
using rws::DigestGuard;

namespace {

constexpr const char* kSecretText = "Default User:validusers@robapi.abb:robotics";

std::string nonceOf(const std::string& challenge) {
    return rws::parseAuthorization(challenge, "Digest").at("nonce");
}

/// RFC 2617, 3.2.2: request-digest with qop=auth.
std::string answer(const std::string& nonce, const std::string& count, const std::string& uri,
                   const std::string& method = "GET") {
    const std::string response = http::md5Hex(fmt::format("{}:{}:{}:c:auth:{}", http::md5Hex(kSecretText),
                                                          nonce, count, http::md5Hex(method + ":" + uri)));
    return fmt::format("Digest username=\"Default User\", realm=\"validusers@robapi.abb\", nonce=\"{}\", "
                       "uri=\"{}\", qop=auth, nc={}, "
                       "cnonce=\"c\", response=\"{}\"",
                       nonce, uri, count, response);
}

DigestGuard::Verdict judge(DigestGuard& guard, const std::string& header, const std::string& target = "/a",
                           const std::string& method = "GET") {
    return guard
        .check(header, method, target,
               [](const std::string& user) {
                   return user == "Default User" ? http::md5Hex(kSecretText) : std::string();
               })
        .verdict;
}

} // namespace

TEST_CASE("The example of RFC 2617 gives its digest", "[rws]") {
    const std::string secret = http::md5Hex("Mufasa:testrealm@host.com:Circle Of Life");
    CHECK(http::md5Hex(secret + ":dcd98b7102dd2f0e8b11d0f600bfb0c093:00000001:0a4f113b:auth:" +
                       http::md5Hex("GET:/dir/index.html")) == "6629fae49393a05397450978507c4ef1");
}

TEST_CASE("Each counter of a nonce counts once, in any order within a window (serve-contract 11)", "[rws]") {
    DigestGuard guard;
    const std::string nonce = nonceOf(guard.challenge(false));
    CHECK(judge(guard, answer(nonce, "00000001", "/a")) == DigestGuard::Verdict::Right);
    CHECK(judge(guard, answer(nonce, "00000001", "/a")) == DigestGuard::Verdict::Stale);
    CHECK(judge(guard, answer(nonce, "00000040", "/a")) == DigestGuard::Verdict::Right);
    CHECK(judge(guard, answer(nonce, "0000003f", "/a")) == DigestGuard::Verdict::Right);
    CHECK(judge(guard, answer(nonce, "0000003f", "/a")) == DigestGuard::Verdict::Stale);
    CHECK(judge(guard, answer(nonce, "00000001", "/a")) == DigestGuard::Verdict::Stale);
    CHECK(judge(guard, answer(nonce, "00000100", "/a")) == DigestGuard::Verdict::Right);
    CHECK(judge(guard, answer(nonce, "00000041", "/a")) == DigestGuard::Verdict::Stale);
    CHECK(judge(guard, answer(nonce, "00000000", "/a")) == DigestGuard::Verdict::Wrong);
}

TEST_CASE("Answers for other addresses, methods, nonces and users are wrong", "[rws]") {
    DigestGuard guard, other;
    const std::string nonce = nonceOf(guard.challenge(false));
    CHECK(judge(guard, answer(nonce, "00000001", "/a"), "/b") == DigestGuard::Verdict::Wrong);
    CHECK(judge(guard, answer(nonce, "00000001", "/a"), "/a", "PUT") == DigestGuard::Verdict::Wrong);
    CHECK(judge(guard, answer(nonceOf(other.challenge(false)), "00000001", "/a")) ==
          DigestGuard::Verdict::Stale);
    CHECK(judge(guard, answer("1", "00000001", "/a")) == DigestGuard::Verdict::Stale);
    CHECK(judge(guard, "Digest username=\"Default User\"") == DigestGuard::Verdict::Wrong);
    CHECK(judge(guard, "Basic x") == DigestGuard::Verdict::Wrong);
    CHECK(judge(guard, answer(nonce, "00000001", "/a")) == DigestGuard::Verdict::Right);
}

TEST_CASE("Authorization headers are read or refused", "[rws]") {
    CHECK(rws::parseAuthorization("Digest a=\"x\\\"y\", B=c , d=\"\"", "Digest") ==
          std::map<std::string, std::string, std::less<>>{{"a", "x\"y"}, {"b", "c"}, {"d", ""}});
    for (const char* text : {"", "Digest", "Digestx a=b", "Digest a", "Digest a=\"", "Digest a=\"\\",
                             "Digest a=b a=c", "Digest =b", "Digest a=1,a=2", "Digest a=\"b\"c"})
        CHECK(rws::parseAuthorization(text, "Digest").empty());
}
