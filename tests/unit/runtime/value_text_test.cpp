// Values as they stand in a source: whatever a program holds reads back as the very same bits.

#include "frontend/syntax/ast.h"
#include "frontend/syntax/lexer.h"
#include "runtime/value/value_text.h"

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>
#include <random>

using namespace rt;

namespace {

TypeDesc scalar(DescKind kind, uint32_t size) {
    TypeDesc type{};
    type.name = type.baseName = "t";
    type.kind = kind;
    type.size = size;
    type.count = 1;
    return type;
}

const TypeDesc kNum = scalar(DescKind::Num, 4);
const TypeDesc kDnum = scalar(DescKind::Dnum, 8);
const TypeDesc kString = scalar(DescKind::String, sizeof(String));

std::string num(float value) {
    std::string text;
    REQUIRE(valueToSource(&value, kNum, text));
    return text;
}

std::string dnum(double value) {
    std::string text;
    REQUIRE(valueToSource(&value, kDnum, text));
    return text;
}

std::string string(std::string_view bytes) {
    String value;
    value.assign(bytes);
    std::string text;
    REQUIRE(valueToSource(&value, kString, text));
    return text;
}

/// The value that the front end gives a literal.
double literal(std::string_view text) {
    const bool negative = text.front() == '-';
    const auto value = rapid::syntax::numberValue(text.substr(negative ? 1 : 0));
    REQUIRE(value.valid);
    REQUIRE(value.inRange);
    return negative ? -value.value : value.value;
}

} // namespace

TEST_CASE("numbers have as few digits as they need", "[value]") {
    CHECK(num(0.1F) == "0.1");
    CHECK(num(1.0F / 3) == "0.33333334");
    CHECK(num(-12.5F) == "-12.5");
    CHECK(num(8388608) == "8388608");
    CHECK(num(123456.78F) == "123456.78");
    CHECK(num(9E9F) == "9E+09");
    CHECK(num(1E-7F) == "1E-07");
    CHECK(num(0.0001F) == "0.0001");
    CHECK(num(-0.0F) == "-0");
    CHECK(num(std::numeric_limits<float>::max()) == "3.4028235E+38");
    CHECK(dnum(1.0 / 3) == "0.3333333333333333");
    CHECK(dnum(4503599627370496) == "4503599627370496");
    CHECK(dnum(0.1) == "0.1");
}

TEST_CASE("every number reads back as the same bits, in the runtime and in the front end", "[value]") {
    std::mt19937 random(17);
    for (int i = 0; i < 200000; ++i) {
        const auto bits = static_cast<uint32_t>(random());
        float value = 0, again = 1;
        std::memcpy(&value, &bits, sizeof value);
        std::string text;
        if (!valueToSource(&value, kNum, text)) continue; // not finite
        INFO(text);
        REQUIRE(sourceToValue(text, &again, kNum));
        REQUIRE(std::memcmp(&value, &again, sizeof value) == 0);
        const auto read = static_cast<float>(literal(text));
        REQUIRE(std::memcmp(&value, &read, sizeof value) == 0);
    }
    for (int i = 0; i < 100000; ++i) {
        const uint64_t bits = (uint64_t{random()} << 32) | random();
        double value = 0, again = 1;
        std::memcpy(&value, &bits, sizeof value);
        std::string text;
        if (!valueToSource(&value, kDnum, text)) continue;
        INFO(text);
        REQUIRE(sourceToValue(text, &again, kDnum));
        REQUIRE(std::memcmp(&value, &again, sizeof value) == 0);
        const double read = literal(text);
        REQUIRE(std::memcmp(&value, &read, sizeof value) == 0);
    }
}

TEST_CASE("numbers that are not finite have no literal", "[value]") {
    std::string text;
    const float infinite = std::numeric_limits<float>::infinity();
    CHECK_FALSE(valueToSource(&infinite, kNum, text));
    const double none = std::numeric_limits<double>::quiet_NaN();
    CHECK_FALSE(valueToSource(&none, kDnum, text));
}

TEST_CASE("strings: quotes and backslashes doubled, other bytes as codes", "[value]") {
    CHECK(string("a \"b\" \\c") == R"("a ""b"" \\c")");
    CHECK(string("bell \x07\n\x7F") == R"("bell \07\0A\7F")");
    CHECK(string("gr\xC3\xBCn") == "\"gr\xC3\xBCn\"");
    CHECK(string("\xC3") == R"("\C3")");
    CHECK(string("\xED\xA0\x80") == R"("\ED\A0\80")"); // half of a surrogate pair is not a character
    CHECK(string("") == "\"\"");
}

TEST_CASE("every string reads back as the same bytes, in the runtime and in the front end", "[value]") {
    std::mt19937 random(23);
    const std::string pieces[] = {"a",    "0",    "F", "\"", "\\", "\xC3\xBC", "\xF0\x9F\xA4\x96",
                                  "\xFF", "\x01", " ", "]",  ","};
    for (int i = 0; i < 50000; ++i) {
        std::string bytes;
        for (int k = static_cast<int>(random() % 12); k > 0; --k)
            bytes += random() % 4 == 0 ? std::string(1, static_cast<char>(random() % 256))
                                       : pieces[random() % std::size(pieces)];
        const std::string text = string(bytes);
        INFO(text);
        String again;
        REQUIRE(sourceToValue(text, &again, kString));
        REQUIRE(again.view() == bytes);
        REQUIRE(rapid::syntax::decodeStringLiteral(text) == bytes);
    }
}

TEST_CASE("records and arrays", "[value]") {
    const TypeDesc* fields[] = {&kNum, &kString};
    const char* names[] = {"size", "name"};
    const uint32_t offsets[] = {0, 4};
    TypeDesc record = scalar(DescKind::Record, 88);
    record.count = 2;
    record.fields = fields;
    record.fieldNames = names;
    record.offsets = offsets;
    const TypeDesc* element[] = {&record};
    TypeDesc array = scalar(DescKind::Array, 2 * 88);
    array.count = 2;
    array.dims[0] = 2;
    array.fields = element;
    struct Part {
        float size = 0;
        String name;
    } parts[2], again[2];
    parts[0].size = 1.5F;
    parts[1].name.assign("x\n");
    std::string text;
    REQUIRE(valueToSource(parts, array, text));
    CHECK(text == R"([[1.5,""],[0,"x\0A"]])");
    REQUIRE(sourceToValue(text, again, array));
    CHECK(again[0].size == 1.5F);
    CHECK(again[1].name.view() == "x\n");
    CHECK_FALSE(sourceToValue("[[1,\"\"]]", again, array));
    CHECK(again[0].size == 1.5F); // untouched
}
