#include "frontend/syntax/foreign_characters.h"

#include <fmt/format.h>

namespace rapid::syntax {

namespace {

using K = TokenKind;

constexpr ForeignCharacter kCharacters[] = {{"\u201C", "\""},
                                            {"\u201D", "\""},
                                            {"\u201E", "\""},
                                            {"\u201F", "\""},
                                            {"\u00AB", "\""},
                                            {"\u00BB", "\""},
                                            {"\u2018", "\""},
                                            {"\u2019", "\""},
                                            {"\uFF02", "\""},
                                            {"\u00A0", " "},
                                            {"\u2007", " "},
                                            {"\u202F", " "},
                                            {"\u3000", " "},
                                            {"\u200B", " "},
                                            {"\uFEFF", " "},
                                            {"\u2013", "-", K::Minus},
                                            {"\u2014", "-", K::Minus},
                                            {"\u2212", "-", K::Minus},
                                            {"\u00D7", "*", K::Star},
                                            {"\u00F7", "/", K::Slash},
                                            {"\u2260", "<>", K::NotEqual},
                                            {"\u2264", "<=", K::LessEqual},
                                            {"\u2265", ">=", K::GreaterEqual},
                                            {"\uFF0C", ",", K::Comma},
                                            {"\u3001", ",", K::Comma},
                                            {"\uFF1B", ";", K::Semicolon},
                                            {"\uFF1A", ":", K::Colon},
                                            {"\uFF08", "(", K::LeftParen},
                                            {"\uFF09", ")", K::RightParen},
                                            {"\uFF3B", "[", K::LeftBracket},
                                            {"\uFF3D", "]", K::RightBracket},
                                            {"\uFF1D", "=", K::Equal}};

} // namespace

const ForeignCharacter* foreignCharacter(std::string_view text) {
    if (text.empty() || static_cast<unsigned char>(text[0]) < 0x80) return nullptr;
    for (const ForeignCharacter& character : kCharacters)
        if (text.starts_with(character.utf8)) return &character;
    return nullptr;
}

size_t quoteLength(std::string_view text) {
    if (text.starts_with('"')) return 1;
    const ForeignCharacter* found = foreignCharacter(text);
    return found && found->meant == "\"" ? found->utf8.size() : 0;
}

std::string showCharacter(std::string_view text) {
    const auto c = static_cast<unsigned char>(text[0]);
    if (c < 0x80) return c >= 0x20 && c != 0x7F ? fmt::format("'{}'", text[0]) : fmt::format("U+{:04X}", c);
    const size_t length = c >= 0xF0 ? 4 : c >= 0xE0 ? 3 : 2;
    uint32_t point = c & (length == 4 ? 0x07u : length == 3 ? 0x0Fu : 0x1Fu);
    for (size_t i = 1; i < length && i < text.size(); ++i)
        point = point << 6 | (static_cast<unsigned char>(text[i]) & 0x3Fu);
    const bool visible = point > 0xA0 && point != 0xAD && !(point >= 0x2000 && point <= 0x200F) &&
                         !(point >= 0x2028 && point <= 0x202F) && point != 0xFEFF && point != 0x3000;
    return visible ? fmt::format("'{}' (U+{:04X})", text.substr(0, length), point)
                   : fmt::format("U+{:04X}", point);
}

} // namespace rapid::syntax
