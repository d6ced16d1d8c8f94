#include "tools/http/url.h"

#include <catch2/catch.hpp>

using namespace rapidc::http;

TEST_CASE("Escapes are decoded or refused (serve-contract 16)", "[http]") {
    CHECK(decodePercent("a%20b%2fc") == "a b/c");
    CHECK(decodePercent("a+b") == "a+b");
    CHECK(decodePercent("a+b", true) == "a b");
    for (const char* text : {"%", "%4", "%zz", "%4g", "a%", "%00", "a%00b"})
        CHECK_FALSE(decodePercent(text));
    CHECK_FALSE(decodePercent(std::string_view("a\0b", 3)));
    CHECK(encodePercent("x{3}/a b") == "x%7B3%7D/a%20b");
}

TEST_CASE("Fields of queries and forms keep their order", "[http]") {
    CHECK(parseFields("a=1&b=&c&a=2%263&=x") ==
          FieldList{{"a", "1"}, {"b", ""}, {"c", ""}, {"a", "2&3"}, {"", "x"}});
    CHECK(parseFields("")->empty());
    CHECK(parseFields("&&")->empty());
    CHECK(parseFields("a=b=c") == FieldList{{"a", "b=c"}});
    CHECK_FALSE(parseFields("a=%"));
    CHECK_FALSE(parseFields("a&b&c", 2));
}

TEST_CASE("Targets of requests", "[http]") {
    const auto target = parseTarget("/rw/rapid/symbol/RAPID%2FT%2Fx//data/?json=1&a=b");
    REQUIRE(target);
    CHECK(target->path == "/rw/rapid/symbol/RAPID/T/x/data");
    CHECK(target->segments == std::vector<std::string>{"rw", "rapid", "symbol", "RAPID/T/x", "data"});
    CHECK(target->query == FieldList{{"json", "1"}, {"a", "b"}});
    CHECK(parseTarget("/")->path == "/");
    CHECK(parseTarget("http://host:80/a?b")->path == "/a");
    CHECK(parseTarget("http://host")->path == "/");
    for (const char* text :
         {"", "a", "*", "/a%", "/%00", "/a b", "/a#b", "/a\tb", "ftp://x/", "http:///a", "/?a=%1"})
        CHECK_FALSE(parseTarget(text));
}

TEST_CASE("Media types and base64", "[http]") {
    CHECK(mediaTypeOf(" Application/X-www-form-urlencoded ;v=2.0") == "application/x-www-form-urlencoded");
    CHECK(mediaTypeOf("").empty());
    CHECK(decodeBase64("QWRtaW46cm9ib3RpY3M=") == "Admin:robotics"); // RFC 4648
    CHECK(decodeBase64("Zg==") == "f");
    CHECK(decodeBase64("") == "");
    CHECK_FALSE(decodeBase64("Z"));
    CHECK_FALSE(decodeBase64("Zg=*"));
}
