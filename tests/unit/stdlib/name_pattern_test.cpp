#include "stdlib/impl/data/name_pattern.h"

#include <catch2/catch.hpp>
#include <string>

using rt::lib::NamePattern;

namespace {
bool matches(const char* pattern, const char* name) {
    NamePattern p;
    REQUIRE(p.parse(pattern));
    return p.matches(name);
}
bool isPattern(const std::string& text) {
    NamePattern p;
    return p.parse(text);
}
} // namespace

TEST_CASE("a pattern must match the whole name, without regard to case", "[names]") {
    CHECK(matches("abc", "ABC"));
    CHECK_FALSE(matches("abc", "abcd"));
    CHECK_FALSE(matches("bc", "abc"));
    CHECK(matches("MY.*", "myTool"));
    CHECK(matches(".*", ""));
    CHECK(NamePattern().matches("anything"));
}

TEST_CASE("parts of patterns of names", "[names]") {
    CHECK(matches("p[0-9]+", "p10"));
    CHECK_FALSE(matches("p[0-9]+", "p"));
    CHECK(matches("p[0-9]*", "p"));
    CHECK(matches("colou?r", "color"));
    CHECK(matches("(left|right)_hand", "Right_hand"));
    CHECK_FALSE(matches("(left|right)_hand", "_hand"));
    CHECK(matches("[^a-c]x", "dx"));
    CHECK_FALSE(matches("[^a-c]x", "Bx"));
    CHECK(matches("a|bc", "bc"));
    CHECK(matches("(ab)+", "ababab"));
    CHECK(matches("a.c", "a_c"));
}

TEST_CASE("texts that are not patterns", "[names]") {
    for (const char* text : {"*", "a)", "(a", "[a", "[]", "+b", "[z-a]", "a\\"})
        CHECK_FALSE(isPattern(text));
    CHECK_FALSE(isPattern(std::string(80, '('))); // nested beyond reason
}

TEST_CASE("the time of a match does not depend on the pattern", "[names]") {
    const std::string name(63, 'a');
    CHECK_FALSE(matches("((((a*)*)*)*)*b", name.c_str()));
    CHECK_FALSE(matches("(a|a|aa)+(a|a|aa)+(a|a|aa)+c", name.c_str()));
    CHECK_FALSE(matches(".*", std::string(64, 'a').c_str()));
}
