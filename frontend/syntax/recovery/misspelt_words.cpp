// Misspelt keywords.

#include "frontend/diag/messages/syntax.h"
#include "frontend/source/spelling.h"
#include "frontend/syntax/grammar/parts.h"

#include <algorithm>

namespace rapid::syntax {

namespace {

/// Words of other languages for keywords of RAPID.
struct ForeignWord {
    std::string_view word;
    TokenKind keyword;
};
constexpr ForeignWord kForeignWords[] = {
#define FOREIGN_WORD(word, keyword) {word, TokenKind::keyword},
#include "frontend/syntax/recovery/spellings.def"
};

constexpr size_t kLongestTypo = 14;

} // namespace

unsigned MisspeltWords::editsTo(TokenIndex i, K word, unsigned limit) const {
    if (kindAt(i) != K::Identifier) return 0;
    const std::string_view text = textOf(i);
    const std::string_view spelling = tokenText(word);
    if (text.size() < 2 || text.size() > kLongestTypo) return 0;
    const std::string written = upperCase(text);
    bool known = false;
    for (const ForeignWord& foreign : kForeignWords) {
        if (foreign.word != written) continue;
        if (foreign.keyword == word) return 1;
        known = true;
    }
    if (known) return 0;
    if (limit == 0) limit = spelling.size() <= 4 ? 1 : 2;
    const unsigned edits = editDistance(written, spelling, limit);
    return edits <= limit ? edits : 0;
}

bool MisspeltWords::isPieceOf(TokenIndex i, K end) const {
    if (kindAt(i) != K::Identifier || !startsLine(i) || !startsLine(i + 1)) return false;
    const std::string_view text = textOf(i), word = tokenText(end);
    constexpr size_t kLeast = 2;
    if (text.size() < kLeast) return false;
    if (text.size() < word.size()) return equalsNoCase(text, word.substr(0, text.size()));
    return equalsNoCase(text.substr(text.size() - word.size()), word) &&
           equalsNoCase(text.substr(0, kLeast), word.substr(0, kLeast));
}

/// Letters of the word in a different order, or one too many or too few: "Dim" is not meant as DIV.
bool MisspeltWords::isShuffled(TokenIndex i, K word) const {
    std::string written = upperCase(textOf(i)), spelling(tokenText(word));
    if (written.size() != spelling.size()) return true;
    std::sort(written.begin(), written.end());
    std::sort(spelling.begin(), spelling.end());
    return written == spelling;
}

void MisspeltWords::readAsKeyword(TokenIndex first, TokenIndex last, K word) {
    const SourceRange place{range(first).begin, range(last).end};
    const auto shown = sourceText().substr(place.begin, place.end - place.begin);
    const std::string spelling(tokenText(word));
    const auto closed = std::find(foreignClosers_.begin(), foreignClosers_.end(), last);
    if (closed != foreignClosers_.end()) {
        foreignClosers_.erase(closed);
    } else {
        diag::Diagnostic* diagnostic = reportAt(say::MisspeltKeyword, place, {std::string(shown), spelling});
        fix(diagnostic, place, spelling);
        noteForeignCloser(diagnostic, last, word);
    }
    readAs(last, word);
}

/// The END word of another language that closes what the word at `opening` begins: "ENDSWITCH", "END SWITCH". Its last
/// token, or kNoToken.
TokenIndex MisspeltWords::foreignCloser(TokenIndex opening, K closer) const {
    const std::string begins = upperCase(textOf(opening)), ends = "END" + begins;
    const bool known =
        std::any_of(std::begin(kForeignWords), std::end(kForeignWords),
                    [&](const auto& foreign) { return foreign.word == ends && foreign.keyword == closer; });
    if (!known) return kNoToken;
    uint32_t open = 0;
    for (TokenIndex i = opening + 1; i < lastToken() && i < opening + kFarTokens; ++i) {
        if (kindAt(i) != K::Identifier || !startsLine(i)) continue;
        const bool twoWords = equalsNoCase(textOf(i), "END") && equalsNoCase(textOf(i + 1), begins);
        if (equalsNoCase(textOf(i), begins)) ++open;
        if (!twoWords && !equalsNoCase(textOf(i), ends)) continue;
        if (open-- == 0) return twoWords ? i + 1 : i;
    }
    return kNoToken;
}

void MisspeltWords::noteForeignCloser(diag::Diagnostic* diagnostic, TokenIndex opening, K word) {
    struct Pair {
        K opener, closer;
    };
    static constexpr Pair kPairs[] = {{K::KwTest, K::KwEndtest},
                                      {K::KwRecord, K::KwEndrecord},
                                      {K::KwFunc, K::KwEndfunc},
                                      {K::KwProc, K::KwEndproc}};
    const auto* pair =
        std::find_if(std::begin(kPairs), std::end(kPairs), [&](const Pair& p) { return p.opener == word; });
    if (!diagnostic || pair == std::end(kPairs)) return;
    const TokenIndex closer = foreignCloser(opening, pair->closer);
    if (closer == kNoToken) return;
    foreignClosers_.push_back(closer);
    const bool twoWords = equalsNoCase(textOf(closer - 1), "END");
    const SourceRange place{range(twoWords ? closer - 1 : closer).begin, range(closer).end};
    const std::string spelling(tokenText(pair->closer));
    note(diagnostic, closer, "and " + spelling + " here");
    diagnostic->fixes.back().edits.push_back({place, spelling});
}

bool MisspeltWords::foreignCloserIs(TokenIndex i) const {
    return std::find(foreignClosers_.begin(), foreignClosers_.end(), i) != foreignClosers_.end();
}

} // namespace rapid::syntax
