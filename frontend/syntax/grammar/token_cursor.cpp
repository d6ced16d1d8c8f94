#include "frontend/syntax/grammar/token_cursor.h"

#include <fmt/format.h>

namespace rapid::syntax {

std::string TokenCursor::describe(TokenIndex i) const {
    const TokenKind k = tokens_[i].kind;
    if (isKeyword(k) || isPlaceholder(k)) return std::string(tokenText(k));
    if (k == TokenKind::EndOfFile) return "the end of the file";
    std::string_view text = textOf(i);
    constexpr size_t kShownBytes = 40;
    if (text.size() <= kShownBytes) return fmt::format("'{}'", text);
    size_t cut = kShownBytes;
    while ((static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80)
        --cut;
    return fmt::format("'{}...'", text.substr(0, cut));
}

bool TokenCursor::startsLine(TokenIndex i) const {
    if (i == 0 || i >= last_) return true;
    const std::string_view text = tree_.source->text();
    const uint32_t from = tokens_[i - 1].offset + tokens_[i - 1].length;
    for (uint32_t at = tokens_[i].offset; at > from; --at)
        if (text[at - 1] == '\n' || text[at - 1] == '\r') return true;
    return false;
}

uint32_t TokenCursor::columnOf(TokenIndex i) const {
    const std::string_view text = tree_.source->text();
    uint32_t at = tokens_[i].offset;
    constexpr uint32_t kFar = 500;
    while (at > 0 && tokens_[i].offset - at < kFar && text[at - 1] != '\n' && text[at - 1] != '\r')
        --at;
    return tokens_[i].offset - at;
}

uint32_t TokenCursor::indentOf(TokenIndex i) const {
    for (uint32_t k = 0; k < kSearchTokens && !startsLine(i); ++k)
        --i;
    return columnOf(i);
}

} // namespace rapid::syntax
