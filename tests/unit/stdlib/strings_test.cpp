// String functions: manual 1.19.

#include "natives/strings.h"
#include "natives/various.h"
#include "runtime/abi/support_natives.h"
#include "stdlib/impl/support/utf8.h"
#include "stdlib_constants.h"

#include <catch2/catch.hpp>

#include <functional>

using namespace rt;

namespace {

String s(std::string_view text) {
    String out;
    out.assign(text);
    return out;
}

/// Result of a native that yields a string, or the error as "!number".
std::string text(const std::function<Status(String*)>& native) {
    String out;
    const Status status = native(&out);
    return status == kOk ? std::string(out.view()) : "!" + std::to_string(status);
}

std::string error(Status number) {
    return "!" + std::to_string(number);
}

std::string part(std::string_view of, float position, float length) {
    const String str = s(of);
    return text([&](String* r) { return rt_StrPart(nullptr, r, &str, position, length); });
}

float find(std::string_view in, float position, std::string_view set, bool notInSet = false) {
    const String str = s(in);
    const String chars = s(set);
    float out = -1;
    const Status status = rt_StrFind(nullptr, &out, &str, position, &chars, notInSet);
    return status == kOk ? out : -static_cast<float>(status);
}

float match(std::string_view in, float position, std::string_view pattern) {
    const String str = s(in);
    const String wanted = s(pattern);
    float out = -1;
    const Status status = rt_StrMatch(nullptr, &out, &str, position, &wanted);
    return status == kOk ? out : -static_cast<float>(status);
}

bool inOrder(std::string_view a, std::string_view b, std::string_view order) {
    const String x = s(a);
    const String y = s(b);
    const String o = s(order);
    bool out = false;
    REQUIRE(rt_StrOrder(nullptr, &out, &x, &y, &o) == kOk);
    return out;
}

std::string byteText(float byte, bool hex = false, bool okt = false, bool bin = false, bool chr = false) {
    return text([&](String* r) { return rt_ByteToStr(nullptr, r, byte, hex, okt, bin, chr); });
}

float textByte(std::string_view from, bool hex = false, bool okt = false, bool bin = false,
               bool chr = false) {
    const String str = s(from);
    float out = -1;
    const Status status = rt_StrToByte(nullptr, &out, &str, hex, okt, bin, chr);
    return status == kOk ? out : -static_cast<float>(status);
}

} // namespace

TEST_CASE("characters, not bytes, are counted", "[stdlib][strings]") {
    CHECK(lib::characterCount("") == 0);
    CHECK(lib::characterCount("Robotics") == 8);
    CHECK(lib::characterCount("žluťoučký") == 9);
    CHECK(lib::characterCount("€") == 1);
    CHECK(lib::characterCount("\xF0\x9F\xA4\x96") == 1);
    CHECK(lib::characterCount("a\xFF\x80z") == 4); // bytes that are not UTF-8 count one by one
    CHECK(lib::characterCount("\xC5") == 1);       // cut off in the middle
    CHECK(lib::cutToString(std::string(79, 'x') + "ž").size() == 79);
    const String str = s("žluť");
    float out = 0;
    REQUIRE(rt_StrLen(nullptr, &out, &str) == kOk);
    CHECK(out == 4);
    REQUIRE(rt_StrSize(nullptr, &out, &str) == kOk);
    CHECK(out == 6);
}

TEST_CASE("StrPart takes characters and refuses what lies outside", "[stdlib][strings]") {
    CHECK(part("Robotics", 1, 5) == "Robot");
    CHECK(part("Robotics", 8, 1) == "s");
    CHECK(part("žluťoučký", 2, 4) == "luťo");
    CHECK(part("Robotics", 3, 0).empty());
    for (const auto& [position, length] : {std::pair{0, 1}, {9, 1}, {7, 3}, {1, -1}})
        CHECK(part("Robotics", static_cast<float>(position), static_cast<float>(length)) ==
              error(err::ERR_ARGVALERR));
    CHECK(part("Robotics", 1.5F, 1) == error(err::ERR_ARGVALERR));
}

TEST_CASE("StrFind and StrMatch give length plus 1 when nothing is found", "[stdlib][strings]") {
    CHECK(find("Robotics", 1, "aeiou") == 2);
    CHECK(find("Robotics", 3, "aeiou") == 4);
    CHECK(find("Robotics", 1, "aeiou", true) == 1);
    CHECK(find("aaa", 1, "a", true) == 4);
    CHECK(find("Robotics", 1, "xyz") == 9);
    CHECK(find("", 1, "a") == 1);
    CHECK(find("Robotics", 10, "s") == -static_cast<float>(err::ERR_ARGVALERR));
    CHECK(find("Robotics", 0, "s") == -static_cast<float>(err::ERR_ARGVALERR));
    CHECK(match("Robotics", 1, "bo") == 3);
    CHECK(match("Robotics", 4, "bo") == 9);
    CHECK(match("abcabc", 2, "abc") == 4);
    CHECK(match("čaj čaj", 2, "čaj") == 5);
    CHECK(match("ab", 1, "abc") == 3);
}

TEST_CASE("A search that begins one after the last character finds nothing", "[stdlib][strings]") {
    CHECK(find("Robotics", 9, "s") == 9);
    CHECK(find("Robotics", 9, "s", true) == 9);
    CHECK(find("čaj", 4, "j") == 4);
    CHECK(find(std::string(80, 'a'), 81, "a") == 81);
    CHECK(match("Robotics", 9, "s") == 9);
    CHECK(match("Robotics", 9, "") == 9);
    CHECK(match("čaj", 4, "j") == 4);
    CHECK(match("", 1, "a") == 1);
    CHECK(match(std::string(80, 'a'), 81, "a") == 81);
    CHECK(match("Robotics", 10, "s") == -static_cast<float>(err::ERR_ARGVALERR));
    CHECK(match("čaj", 5, "j") == -static_cast<float>(err::ERR_ARGVALERR));
}

TEST_CASE("StrOrder follows the ordering, then the character codes", "[stdlib][strings]") {
    CHECK(inOrder("FIRST", "SECOND", "ABCDEFGHIJKLMNOPQRSTUVWXYZ"));
    CHECK(inOrder("FIRST", "FIRSTB", "ABCDEFGHIJKLMNOPQRSTUVWXYZ"));
    CHECK_FALSE(inOrder("FIRSTB", "FIRST", "ABCDEFGHIJKLMNOPQRSTUVWXYZ"));
    CHECK(inOrder("SAME", "SAME", ""));
    CHECK(inOrder("B", "A", "BA"));
    CHECK(inOrder("A", "b", "A")); // a character of the ordering comes before any other
    CHECK_FALSE(inOrder("b", "a", "A"));
}

TEST_CASE("StrMap maps each character", "[stdlib][strings]") {
    const auto map = [](std::string_view str, std::string_view from, std::string_view to) {
        const String a = s(str);
        const String b = s(from);
        const String c = s(to);
        return text([&](String* r) { return rt_StrMap(nullptr, r, &a, &b, &c); });
    };
    CHECK(map("Robotics", "aeiou", "AEIOU") == "RObOtIcs");
    CHECK(map("abc", "abc", "bca") == "bca"); // each character once
    CHECK(map("žena", "ž", "z") == "zena");
    CHECK(map("abc", "ab", "x") == error(err::ERR_ARGVALERR));
}

TEST_CASE("bytes in every notation", "[stdlib][strings]") {
    CHECK(byteText(122) == "122");
    CHECK(byteText(122, true) == "7A");
    CHECK(byteText(5, true) == "05");
    CHECK(byteText(122, false, true) == "172");
    CHECK(byteText(122, false, false, true) == "01111010");
    CHECK(byteText(122, false, false, false, true) == "z");
    CHECK(byteText(0xE9, false, false, false, true) == "é");
    CHECK(byteText(256) == error(err::ERR_ARGVALERR));
    CHECK(textByte("10") == 10);
    CHECK(textByte("AE", true) == 174);
    CHECK(textByte("176", false, true) == 126);
    CHECK(textByte("00001010", false, false, true) == 10);
    CHECK(textByte("A", false, false, false, true) == 65);
    CHECK(textByte("é", false, false, false, true) == 233);
    for (const char* bad : {"", "256", "1x", "-1"})
        CHECK(textByte(bad) == -static_cast<float>(err::ERR_ARGVALERR));
}

TEST_CASE("decimal and hexadecimal texts", "[stdlib][strings]") {
    const auto hex = [](std::string_view from) {
        const String str = s(from);
        return text([&](String* r) { return rt_DecToHex(nullptr, r, &str); });
    };
    const auto dec = [](std::string_view from) {
        const String str = s(from);
        return text([&](String* r) { return rt_HexToDec(nullptr, r, &str); });
    };
    CHECK(hex("99999999") == "5F5E0FF");
    CHECK(dec("5F5E0FF") == "99999999");
    CHECK(hex("9223372036854775807") == "7FFFFFFFFFFFFFFF");
    CHECK(hex("9223372036854775808") == error(err::ERR_ARGVALERR));
    CHECK(dec("G") == error(err::ERR_ARGVALERR));
    CHECK(hex("") == error(err::ERR_ARGVALERR));
}

TEST_CASE("NumToStr refuses negative decimals; long texts are errors", "[stdlib][strings]") {
    CHECK(text([](String* r) { return rt_NumToStr(nullptr, r, 0.38521F, 3, false); }) == "0.385");
    CHECK(text([](String* r) { return rt_NumToStr(nullptr, r, 1, -1, false); }) == error(err::ERR_ARGVALERR));
    CHECK(text([](String* r) { return rt_DnumToStr(nullptr, r, 1, 80, false); }) ==
          error(err::ERR_STRTOOLNG));
}

TEST_CASE("StrFormat fills the placeholders that have an argument", "[stdlib][strings]") {
    const String format = s("{1} of {2}, {3} {7} {");
    const String one = s("2");
    const String two = s("{1}");
    CHECK(text([&](String* r) {
              return rt_StrFormat(nullptr, r, &format, &one, &two, nullptr, nullptr, nullptr, nullptr);
          }) == "2 of {1}, {3} {7} {");
}

TEST_CASE("strings join up to 80 bytes and compare by their bytes", "[stdlib][strings]") {
    const String a = s(std::string(40, 'a'));
    const String b = s(std::string(41, 'b'));
    CHECK(text([&](String* r) { return rt_strConcat(nullptr, r, &a, &b); }) == error(err::ERR_STRTOOLNG));
    String joined = a;
    REQUIRE(rt_strConcat(nullptr, &joined, &joined, &a) == kOk); // the result may be an operand
    CHECK(joined.view() == std::string(80, 'a'));
    const String shorter = s("a");
    String stale = s("ab");
    stale.length = 1;
    CHECK(rt_strEqual(&shorter, &stale)); // bytes after the end do not count
    CHECK_FALSE(rt_strEqual(&a, &shorter));
}

TEST_CASE("digit strings compare and compute as integers", "[stdlib][strings]") {
    const String ten = s("10");
    const String nine = s("9");
    const String most = s("4294967295");
    const String bad = s("4294967296");
    bool less = false;
    REQUIRE(rt_StrDigCmp(nullptr, &less, &nine, k::LT, &ten) == kOk);
    CHECK(less);
    const auto calc = [](const String& a, float op, const String& b) {
        return text([&](String* r) { return rt_StrDigCalc(nullptr, r, &a, op, &b); });
    };
    const String zero = s("0");
    CHECK(calc(ten, k::OpSub, nine) == "1");
    CHECK(calc(ten, k::OpDiv, nine) == "1");
    CHECK(calc(ten, k::OpMod, nine) == "1");
    CHECK(calc(nine, k::OpSub, ten) == error(err::ERR_CALC_NEG));
    CHECK(calc(most, k::OpAdd, nine) == error(err::ERR_CALC_OVERFLOW));
    CHECK(calc(ten, k::OpDiv, zero) == error(err::ERR_CALC_DIVZERO));
    CHECK(calc(bad, k::OpAdd, nine) == error(err::ERR_INT_NOTVAL));
}
