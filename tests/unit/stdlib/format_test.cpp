// Numbers and values as text: manual 1.10, 1.19.

#include "runtime/value/value_text.h"

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <random>
#include <string>

using namespace rt;
using namespace rt;

namespace {

const TypeDesc kNum{"num", "num", DescKind::Num, 4, 0, {0, 0, 0}, nullptr, nullptr, nullptr};
const TypeDesc kDnum{"dnum", "dnum", DescKind::Dnum, 8, 0, {0, 0, 0}, nullptr, nullptr, nullptr};
const TypeDesc kBool{"bool", "bool", DescKind::Bool, 1, 0, {0, 0, 0}, nullptr, nullptr, nullptr};
const TypeDesc kString{"string", "string", DescKind::String, 84, 0, {0, 0, 0}, nullptr, nullptr, nullptr};

struct Part {
    float id;
    bool good;
    String name;
};
const TypeDesc* const kPartFields[] = {&kNum, &kBool, &kString};
const char* const kPartNames[] = {"id", "good", "name"};
const uint32_t kPartOffsets[] = {offsetof(Part, id), offsetof(Part, good), offsetof(Part, name)};
const TypeDesc kPart{"part",    "part",      DescKind::Record, sizeof(Part), 3,
                     {0, 0, 0}, kPartFields, kPartNames,       kPartOffsets};

const TypeDesc* const kMatrixElement[] = {&kNum};
const TypeDesc kMatrix{"num", "num", DescKind::Array, 24, 6, {2, 3, 0}, kMatrixElement, nullptr, nullptr};

} // namespace

TEST_CASE("a num is written with at most six significant digits", "[stdlib][format]") {
    CHECK(formatNum(0.0F) == "0");
    CHECK(formatNum(-0.0F) == "0");
    CHECK(formatNum(5.0F) == "5");
    CHECK(formatNum(-1.25F) == "-1.25");
    CHECK(formatNum(1.141367F) == "1.14137");
    CHECK(formatNum(0.1F) == "0.1"); // binary32 noise lies beyond the sixth digit
    CHECK(formatNum(905.17F) == "905.17");
    CHECK(formatNum(1.5e-7F) == "1.5E-07");
    CHECK(formatNum(9e9F) == "9E+09");
}

TEST_CASE("integers within the exact range are written in full", "[stdlib][format]") {
    CHECK(formatNum(8388608.0F) == "8388608");
    CHECK(formatNum(-1234567.0F) == "-1234567");
    CHECK(formatNum(16777216.0F) == "1.67772E+07"); // beyond 2^23
    CHECK(formatDnum(4294967295.0) == "4294967295");
    CHECK(formatDnum(4503599627370496.0) == "4503599627370496");
}

TEST_CASE("a dnum is written with at most fifteen significant digits", "[stdlib][format]") {
    CHECK(formatDnum(1.234567890123456789) == "1.23456789012346");
    CHECK(formatDnum(0.1) == "0.1");
}

TEST_CASE("the operator display drops a decimal part that is noise", "[stdlib][format]") {
    CHECK(formatDisplayNum(2.000004F) == "2");
    CHECK(formatDisplayNum(1.999996F) == "2");
    CHECK(formatDisplayNum(2.00001F) == "2.00001");
    CHECK(formatDisplayDnum(3.00000000000001) == "3");
    CHECK(formatNum(0.000004F) == "4E-06"); // not so elsewhere
    CHECK(formatDisplayNum(0.000004F) == "0");
}

TEST_CASE("NumToStr writes the decimals asked for", "[stdlib][format]") {
    CHECK(formatDecimals(0.38521, 3, false) == "0.385");
    CHECK(formatDecimals(0.38521, 2, true) == "3.85E-01");
    CHECK(formatDecimals(1500, 1, true) == "1.5E+03");
    CHECK(formatDecimals(5, 2, false) == "5.00");
}

TEST_CASE("numbers are read by the rules of num literals, with a sign", "[stdlib][format]") {
    double v = -1;
    CHECK((parseRapidNumber("3.85", v) && v == 3.85));
    CHECK((parseRapidNumber(" -2.5E1 ", v) && v == -25));
    CHECK((parseRapidNumber(".5", v) && v == 0.5));
    CHECK((parseRapidNumber("5.", v) && v == 5));
    CHECK((parseRapidNumber("0x1F", v) && v == 31));
    CHECK((parseRapidNumber("0b101", v) && v == 5));
    CHECK((parseRapidNumber("0o17", v) && v == 15));
    for (const char* bad : {"", "robot", "1 2", "--1", "inf", "nan", "1e", "0x", "0b2", "1,5"})
        CHECK_FALSE(parseRapidNumber(bad, v));
}

TEST_CASE("records, strings and arrays as text and back", "[stdlib][format]") {
    Part part{7, true, {}};
    part.name.assign("a \"b\" \\c");
    const std::string text = valueToText(&part, kPart);
    CHECK(text == "[7,TRUE,\"a \"\"b\"\" \\\\c\"]");
    Part back{};
    REQUIRE(textToValue(text, &back, kPart));
    CHECK(back.id == 7.0F);
    CHECK(back.good);
    CHECK(back.name.view() == part.name.view());

    float matrix[6] = {1, 2, 3, 4, 5, 6};
    CHECK(valueToText(matrix, kMatrix) == "[[1,2,3],[4,5,6]]");
    REQUIRE(textToValue("[ [6,5,4] , [3,2,1.5] ]", matrix, kMatrix));
    CHECK(matrix[0] == 6.0F);
    CHECK(matrix[5] == 1.5F);
}

TEST_CASE("text that does not fit leaves the data alone", "[stdlib][format]") {
    Part part{7, true, {}};
    for (const char* bad :
         {"[8,FALSE]", "[8,FALSE,\"x\"", "[8,2,\"x\"]", "[8,FALSE,\"x\"] y", "8", "[8,FALSE,\"x]"})
        CHECK_FALSE(textToValue(bad, &part, kPart));
    CHECK(part.id == 7.0F);
    CHECK(part.good);
    float num = 1;
    CHECK_FALSE(textToValue("1e39", &num, kNum)); // too large for binary32
    CHECK(num == 1.0F);
    double dnum = 0;
    CHECK(textToValue("1e39", &dnum, kDnum));
    String string;
    CHECK_FALSE(textToValue('"' + std::string(81, 'x') + '"', &string, kString));
    CHECK(textToValue('"' + std::string(80, 'x') + '"', &string, kString));
}

namespace {

std::string asPrintf(double value, int decimals) {
    char buffer[500];
    std::snprintf(buffer, sizeof buffer, "%.*f", decimals, value);
    return buffer;
}

} // namespace

TEST_CASE("decimals are those of printf: ties, large numbers, no numbers; zero has no sign",
          "[stdlib][format]") {
    const double big = std::numeric_limits<double>::max(), none = std::numeric_limits<double>::quiet_NaN();
    for (const double value :
         {0.0, 0.5, 1.5, 2.5, 0.4, 0.125, 0.375, 2.675, 1e15, 9007199254740991.0, 9007199254740993.5, 1e22,
          1e23, big, 5e-324, static_cast<double>(0.1F), std::numeric_limits<double>::infinity(), none}) {
        for (const double with : {value, -value})
            for (const int decimals : {0, 1, 2, 3, 6, 15, 20, 80})
                CHECK(formatDecimals(with, decimals, false) == asPrintf(with == 0 ? 0 : with, decimals));
    }
}

TEST_CASE("decimals are those of printf for any number", "[stdlib][format]") {
    std::mt19937_64 random(1);
    int wrong = 0;
    const auto compare = [&wrong](double value, int decimals) {
        if (formatDecimals(value, decimals, false) != asPrintf(value, decimals)) ++wrong;
    };
    for (int i = 0; i < 100'000; ++i) {
        const uint64_t bits = random();
        const int decimals = static_cast<int>(bits % 12);
        compare(std::bit_cast<double>(random()), decimals); // of any size
        compare(static_cast<double>(std::bit_cast<float>(static_cast<uint32_t>(bits >> 32))), decimals);
        compare(static_cast<double>(static_cast<int64_t>(random()) >> 20) / 16, decimals % 5); // many ties
    }
    CHECK(wrong == 0);
}
