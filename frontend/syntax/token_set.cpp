#include "frontend/syntax/token_set.h"

#include <array>

namespace rapid::syntax {

namespace {

constexpr std::string_view kTexts[] = {
#define TOKEN(name, text) text,
#include "frontend/syntax/token_kinds.def"
};

constexpr std::string_view kTokenNames[] = {
#define TOKEN(name, text) #name,
#include "frontend/syntax/token_kinds.def"
};

// Keywords are found by a hash without collisions, which the compiler verifies.
constexpr size_t kHashBits = 9;
constexpr size_t kShortest = 2;
constexpr size_t kLongest = 9;
constexpr auto kFirst = static_cast<size_t>(TokenKind::KwAlias);
constexpr auto kLast = static_cast<size_t>(TokenKind::KwXor);

constexpr uint32_t hashOf(std::string_view word, uint32_t factor) {
    const auto fold = [](char c) { return static_cast<uint32_t>(static_cast<unsigned char>(c) & 0xDFu); };
    const uint32_t mix = static_cast<uint32_t>(word.size()) + fold(word[0]) * 33u + fold(word[1]) * 1009u +
                         fold(word[word.size() / 2]) * 271u + fold(word.back()) * 9176u;
    return mix * factor >> (32 - kHashBits);
}

using HashTable = std::array<uint8_t, size_t{1} << kHashBits>;

constexpr bool fill(HashTable& table, uint32_t factor) {
    table.fill(0);
    for (size_t i = kFirst; i <= kLast; ++i) {
        uint8_t& slot = table[hashOf(kTexts[i], factor)];
        if (slot) return false;
        slot = static_cast<uint8_t>(i);
    }
    return true;
}

constexpr uint32_t kFactor = 0x4AB3259Bu;

constexpr HashTable makeTable() {
    HashTable table{};
    return fill(table, kFactor) ? table : HashTable{};
}
constexpr HashTable kTable = makeTable();
static_assert(kTable != HashTable{}, "two keywords share a hash: choose another kFactor");

} // namespace

std::string_view tokenText(TokenKind kind) {
    return kTexts[static_cast<size_t>(kind)];
}
std::string_view tokenKindName(TokenKind kind) {
    return kTokenNames[static_cast<size_t>(kind)];
}

TokenKind keywordKind(std::string_view word) {
    if (word.size() < kShortest || word.size() > kLongest) return TokenKind::Identifier;
    const size_t found = kTable[hashOf(word, kFactor)];
    if (found == 0 || !equalsNoCase(word, kTexts[found])) return TokenKind::Identifier;
    return static_cast<TokenKind>(found);
}

} // namespace rapid::syntax
