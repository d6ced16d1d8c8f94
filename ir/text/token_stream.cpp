#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "ir/text/names.h"
#include "ir/text/parser.h"

namespace ir::text {

bool TokenStream::failAt(const Token& where, const std::string& message) {
    if (error_.empty()) error_ = fmt::format("{}:{}: {}", where.line, where.column, message);
    return false;
}

bool TokenStream::expected(std::string_view what) {
    switch (token_.kind) {
    case TokenKind::Bad: return fail(token_.text);
    case TokenKind::End: return fail(fmt::format("end of text where {} is expected", what));
    case TokenKind::NewLine: return fail(fmt::format("end of line where {} is expected", what));
    default: return fail(fmt::format("'{}' where {} is expected", token_.text, what));
    }
}

bool TokenStream::takeWord(std::string_view word) {
    if (!isWord(word)) return false;
    advance();
    return true;
}

bool TokenStream::takePunct(char c) {
    if (!isPunct(c)) return false;
    advance();
    return true;
}

bool TokenStream::punct(char c) {
    return takePunct(c) || expected(fmt::format("'{}'", c));
}
bool TokenStream::word(std::string_view word) {
    return takeWord(word) || expected(fmt::format("'{}'", word));
}

bool TokenStream::endOfLine() {
    if (token_.kind == TokenKind::End) return true;
    if (token_.kind != TokenKind::NewLine) return expected("the end of the line");
    skipNewLines();
    return true;
}

void TokenStream::skipNewLines() {
    while (token_.kind == TokenKind::NewLine)
        advance();
}

bool TokenStream::string(std::string& out) {
    if (token_.kind != TokenKind::String) return expected("a string");
    out = token_.text;
    advance();
    return true;
}

bool TokenStream::name(std::string& out) {
    if (token_.kind != TokenKind::Name) return expected("a name (@\"...\")");
    out = token_.text;
    advance();
    return true;
}

bool TokenStream::number(double& out) {
    if (isWord("nan") || isWord("inf")) {
        out = isWord("nan") ? std::nan("") : HUGE_VAL;
        advance();
        return true;
    }
    if (token_.kind != TokenKind::Number) return expected("a number");
    char* end = nullptr;
    out = std::strtod(token_.text.c_str(), &end);
    if (*end != '\0') return expected("a number");
    advance();
    return true;
}

bool TokenStream::integer(int64_t& out, int64_t min, int64_t max) {
    if (token_.kind != TokenKind::Number) return expected("an integer");
    char* end = nullptr;
    errno = 0;
    out = std::strtoll(token_.text.c_str(), &end, 10);
    if (*end != '\0') return expected("an integer");
    if (errno != 0 || out < min || out > max)
        return fail(fmt::format("'{}' is outside {} to {}", token_.text, min, max));
    advance();
    return true;
}

bool TokenStream::constant(TypeId type, double& realNumber, int64_t& integerNumber) {
    if (isFloat(type)) return number(realNumber);
    if (type == kBool || type == kPtr) return integer(integerNumber, 0, type == kBool ? 1 : 0);
    if (!isInteger(type)) return fail("there are no constants of this type");
    const unsigned bits = bitsOf(type);
    if (token_.kind != TokenKind::Number) return expected("an integer");
    const bool negative = token_.text[0] == '-';
    char* end = nullptr;
    errno = 0;
    const uint64_t magnitude = std::strtoull(token_.text.c_str() + (negative ? 1 : 0), &end, 10);
    if (*end != '\0') return expected("an integer");
    const uint64_t largest = negative ? uint64_t{1} << (bits - 1) : zeroExtended(-1, bits);
    if (errno != 0 || magnitude > largest)
        return fail(fmt::format("'{}' does not fit in {} bits", token_.text, bits));
    integerNumber = signExtended(negative ? 0 - magnitude : magnitude, bits);
    advance();
    return true;
}

bool TokenStream::unsignedInt(uint32_t& out) {
    int64_t wide = 0;
    if (!integer(wide, 0, UINT32_MAX - 1)) return false;
    out = static_cast<uint32_t>(wide);
    return true;
}

bool TokenStream::signedInt(int32_t& out) {
    int64_t wide = 0;
    if (!integer(wide, INT32_MIN, INT32_MAX)) return false;
    out = static_cast<int32_t>(wide);
    return true;
}

bool TokenStream::block(BlockId& out) {
    const std::string& text = token_.text;
    if (token_.kind != TokenKind::Word || text.size() < 2 || text.size() > 8 || text[0] != 'b' ||
        text.find_first_not_of("0123456789", 1) != std::string::npos)
        return expected("a block (b0, b1 ...)");
    out = static_cast<BlockId>(std::strtoul(text.c_str() + 1, nullptr, 10));
    advance();
    return true;
}

bool TokenStream::type(const Module& module, TypeId& out) {
    if (token_.kind == TokenKind::Value) {
        char* end = nullptr;
        unsigned long id = std::strtoul(token_.text.c_str(), &end, 10);
        if (*end != '\0' || id >= module.types.size())
            return fail(fmt::format("there is no type %{} so far", token_.text));
        out = static_cast<TypeId>(id);
        advance();
        return true;
    }
    for (out = kVoid; out < kScalarTypes; ++out)
        if (takeWord(typeName(out))) return true;
    return expected("a type");
}

} // namespace ir::text
