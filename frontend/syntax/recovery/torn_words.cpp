// Names that were torn ("p Pick", "my-name") or have run into the word before them ("VARnum", "PROCMove()"): one report, and
// what was meant as the fix when the whole name is used elsewhere.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <algorithm>

namespace rapid::syntax {

namespace {

/// Names that most programs use without declaring them.
constexpr std::string_view kFrequent[] = {
#define FREQUENT_NAME(name) name,
#include "frontend/syntax/recovery/spellings.def"
};

bool isDigits(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

} // namespace

/// The spelling of a name in the file, outside of the places `exceptFirst` to `exceptLast`; empty when there is none. `wanted` is
/// compared without case.
std::string_view TornWords::spellingInFile(std::string_view wanted, TokenIndex exceptFirst,
                                           TokenIndex exceptLast) {
    if (searched_ >= kMostWords) return {};
    searched_ += lastToken();
    const std::string upper = upperCase(wanted);
    for (TokenIndex i = 0; i < lastToken(); ++i)
        if (tokenAt(i).length == wanted.size() && kindAt(i) == K::Identifier &&
            (i < exceptFirst || i > exceptLast) && equalsNoCase(textOf(i), upper))
            return textOf(i);
    return {};
}

bool TornWords::isArrayOfFile(TokenIndex name) {
    constexpr TokenSet kOpens = {K::LeftBrace, K::LeftBracket, K::LeftParen};
    constexpr TokenSet kRoutines = {K::KwProc, K::KwFunc};
    if (searched_ >= kMostWords) return false;
    searched_ += lastToken();
    const std::string upper = upperCase(textOf(name));
    for (TokenIndex i = 2; i < lastToken(); ++i) {
        const bool declared = tokenAt(i).length == upper.size() && isName(kindAt(i - 1)) && !startsLine(i) &&
                              kOpens.has(kindAt(i + 1)) && !kRoutines.has(kindAt(i - 2));
        if (declared && equalsNoCase(textOf(i), upper)) return true;
    }
    return false;
}

/// Whether one of two words is the name of nothing else in the file.
bool TornWords::isOnlyHere(TokenIndex second) {
    return spellingInFile(textOf(second), second, second).empty() ||
           spellingInFile(textOf(second - 1), second - 1, second - 1).empty();
}

std::string TornWords::tornName(TokenIndex second) {
    if (second == 0 || second >= lastToken() || kindAt(second - 1) != K::Identifier || startsLine(second))
        return {};
    const K k = kindAt(second);
    const std::string_view head = textOf(second - 1), tail = textOf(second);
    if (k != K::Identifier && !isKeyword(k) && (k != K::NumLiteral || !isDigits(tail))) return {};
    const SourceRange gap{range(second - 1).end, range(second).begin};
    const std::string_view between = sourceText().substr(gap.begin, gap.end - gap.begin);
    constexpr size_t kWide = 3;
    if (between.size() > kWide || between.find_first_not_of(" \t") != std::string_view::npos) return {};
    std::string whole = std::string(head).append(tail);
    const std::string upper = upperCase(whole);
    for (const std::string_view name : kFrequent)
        if (equalsNoCase(name, upper)) return std::string(name);
    const bool predefined = equalsNoCase(head, "V") || equalsNoCase(head, "Z");
    if (predefined && k == K::NumLiteral) return whole; // v100, z10
    if (whole.size() > kMaxNameLength) return {};
    return std::string(spellingInFile(whole, second - 1, second));
}

diag::Diagnostic* TornWords::reportTornName() {
    if (reports().errors() >= kMaxErrorsPerFile) return nullptr;
    for (const TokenIndex second : {pos(), pos() - 1}) {
        const bool begins = second < 2 || startsLine(second - 1) || kindAt(second - 2) == K::Semicolon;
        if (second == 0 || (second != pos() && !begins)) return nullptr;
        const std::string whole = tornName(second);
        if (whole.empty()) continue;
        const auto underscored = std::string(textOf(second - 1)).append("_").append(textOf(second));
        const bool only = spellingInFile(underscored, second - 1, second).empty();
        return reportWord(second - 1, second, whole,
                          only && (isKeyword(kindAt(second)) || isOnlyHere(second)));
    }
    return nullptr;
}

/// "found 'p Pick', expected 'pPick'"; the checker then reports nothing about that line.
diag::Diagnostic* TornWords::reportWord(TokenIndex first, TokenIndex last, const std::string& whole,
                                        bool certain) {
    return reports().reportWord({range(first).begin, range(last).end}, whole, certain);
}

bool TornWords::takeTornName(TokenIndex name, const TokenSet& after, bool endsLine) {
    constexpr TokenSet kPieces = {K::Identifier, K::NumLiteral, K::KwTo,  K::KwOr,   K::KwAnd,
                                  K::KwDo,       K::KwIf,       K::KwNot, K::KwStep, K::KwMod};
    if ((!kPieces.has(kind()) && kind() != K::Minus) || panic() || name == kNoToken || name + 1 != pos() ||
        kindAt(name) != K::Identifier || startsLine(pos()))
        return false;
    TokenIndex last = name;
    std::string joined(textOf(name)), underscored = joined;
    constexpr TokenIndex kMostPieces = 8;
    while (last < name + kMostPieces) {
        const TokenIndex piece = kindAt(last + 1) == K::Minus ? last + 2 : last + 1;
        if (!kPieces.has(kindAt(piece)) || startsLine(piece)) break;
        joined += textOf(piece);
        underscored.append("_").append(textOf(piece));
        last = piece;
    }
    if (last == name || startsLine(last + 1) != endsLine || (!endsLine && !after.has(kindAt(last + 1))))
        return false;
    std::string_view known = spellingInFile(joined, name, last);
    if (known.empty()) known = spellingInFile(underscored, name, last);
    const bool value = kindAt(name + 1) == K::NumLiteral; // perhaps
    const bool two = kindAt(name + 1) == K::Identifier && !isOnlyHere(name + 1);
    if (known.empty() && (value || two || endsLine)) return false;
    reportWord(name, last, known.empty() ? underscored : std::string(known), !known.empty());
    moveTo(last + 1);
    return true;
}

void TornWords::reportMissingIf() {
    const std::string_view text = textOf(pos());
    const SourceRange place = range(pos());
    constexpr std::string_view kIf = "IF";
    const bool glued = text.size() > kIf.size() && equalsNoCase(text.substr(0, kIf.size()), kIf) &&
                       spellingInFile(text, pos(), pos()).empty();
    if (!glued) {
        fix(report(say::UnexpectedToken, pos(), {describe(pos()), "IF before a condition"}),
            {place.begin, place.begin}, "IF ");
        return;
    }
    const std::string whole = "IF " + std::string(text.substr(kIf.size()));
    fix(report(say::UnexpectedToken, pos(), {describe(pos()), "'" + whole + "': two words"}), place, whole);
    reports().noteUnclear(place.begin);
}

} // namespace rapid::syntax
