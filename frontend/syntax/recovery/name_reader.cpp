// Names, and reserved words in their place.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"
#include "frontend/syntax/later_words.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapid::syntax {

TokenIndex NameReader::expectName(bool newerKeywords) {
    if (isName(kind())) return take();
    if (kind() == K::NumLiteral && !startsLine(pos())) { // "1st"
        report(say::NameStart, pos(), {std::string(textOf(pos()).substr(0, 40))});
        return take();
    }
    if (newerKeywords && (kind() == K::KwBreak || kind() == K::KwContinue)) {
        readAs(pos(), K::Identifier); // RaiseToUser \Continue is older than the keyword
        return take();
    }
    constexpr TokenSet kAfterPlainName = {K::Semicolon, K::Assign, K::LeftParen,
                                          K::LeftBrace, K::Comma,  K::RightParen};
    const bool canBeName = !kEndWords.has(kind()) || (kAfterPlainName.has(peek()) && !startsLine(pos() + 1));
    if (isKeyword(kind()) && canBeName && !startsLine(pos())) return takeReservedName();
    if (startsLine(pos()) && pos() > 0 && kind() != K::Error) {
        reportAt(say::UnexpectedToken, endOf(pos() - 1), {describe(pos()), "a name"});
        startPanic();
    } else {
        unexpected("a name");
    }
    return kNoToken;
}

TokenIndex NameReader::expectNameHere() {
    if (!ahead().beginsInstruction()) return expectName();
    missing("a name");
    return kNoToken;
}

TokenIndex NameReader::missingName() {
    reportAt(say::UnexpectedToken, endOf(pos() - 1), {describe(pos()), "a name"});
    return kNoToken;
}

void NameReader::skipSecond(TokenIndex word) {
    if (kind() != kindAt(word) || pos() != word + 1 || startsLine(pos())) return;
    fix(report(say::UnexpectedToken, pos(), {describe(pos()) + " twice", "a name"}),
        {range(word).end, range(pos()).end}, "");
    take();
}

TokenIndex NameReader::takeReservedName() {
    if (reservedNames_.has(kind())) {
        readAs(pos(), K::Identifier);
    } else {
        diag::Diagnostic* diagnostic =
            report(say::ReservedWordAsName, pos(), {std::string(tokenText(kind()))});
        if (kind() == K::KwBreak || kind() == K::KwContinue) {
            note(diagnostic, pos(),
                 fmt::format("an instruction since {}: programs of older controllers need another name",
                             reservedSince(kind())));
            laterUsesAreNames(pos());
        }
    }
    return take();
}

void NameReader::declareReserved(TokenIndex name) {
    reservedNames_ = reservedNames_ | TokenSet{kindAt(name)};
    readAs(name, K::Identifier);
}

/// BREAK or CONTINUE names something, as older programs may. Where it cannot be the instruction it is that name, so that
/// one declaration gives one message.
void NameReader::laterUsesAreNames(TokenIndex declared) {
    constexpr TokenSet kBeforeValue = {K::Assign, K::Comma, K::LeftParen, K::LeftBracket, K::LeftBrace,
                                       K::Plus,   K::Minus, K::Equal,     K::NotEqual,    K::KwNot,
                                       K::KwAnd,  K::KwOr,  K::KwXor,     K::KwReturn,    K::KwTest};
    const K word = kindAt(declared);
    readAs(declared, K::Identifier);
    for (TokenIndex i = declared + 1; i < lastToken(); ++i)
        if (kindAt(i) == word && (kindAt(i + 1) != K::Semicolon || kBeforeValue.has(kindAt(i - 1))))
            readAs(i, K::Identifier);
}

void NameReader::checkNameLength(TokenIndex name) {
    if (name == kNoToken || tokenAt(name).length <= kMaxNameLength) return;
    const std::string_view text = textOf(name);
    const auto isStart = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
    const auto length = static_cast<size_t>(std::count_if(text.begin(), text.end(), isStart));
    if (length <= kMaxNameLength) return;
    const size_t shown = std::min<size_t>(text.size(), 60);
    report(say::NameTooLong, name,
           {std::string(text.substr(0, shown)) + (shown < text.size() ? "..." : ""), std::to_string(length)});
}

} // namespace rapid::syntax
