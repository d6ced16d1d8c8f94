// Misspelt keywords.

#include "frontend/source/spelling.h"
#include "frontend/syntax/grammar/parts.h"

#include <algorithm>

namespace rapid::syntax {

using diag::Code;

namespace {

/// Words of other languages for keywords of RAPID.
struct ForeignWord {
    std::string_view word;
    TokenKind keyword;
};
constexpr ForeignWord kForeignWords[] = {
    {"IPERS", TokenKind::EndOfFile}, // an instruction, never meant as PERS
    {"NEXT", TokenKind::KwEndfor},
    {"WEND", TokenKind::KwEndwhile},
    {"ENDDO", TokenKind::KwEndwhile},
    {"ENDDO", TokenKind::KwEndfor},
    {"DONE", TokenKind::KwEndwhile},
    {"DONE", TokenKind::KwEndfor},
    {"WHEN", TokenKind::KwCase},
    {"ENDSWITCH", TokenKind::KwEndtest},
    {"ENDSELECT", TokenKind::KwEndtest},
    {"ENDCASE", TokenKind::KwEndtest},
    {"ELIF", TokenKind::KwElseif},
    {"FUNCTION", TokenKind::KwFunc},
    {"ENDFUNCTION", TokenKind::KwEndfunc},
    {"PROCEDURE", TokenKind::KwProc},
    {"SUB", TokenKind::KwProc},
    {"ENDPROCEDURE", TokenKind::KwEndproc},
    {"ENDSUB", TokenKind::KwEndproc},
    {"SWITCH", TokenKind::KwTest},
    {"SELECT", TokenKind::KwTest},
    {"OTHERWISE", TokenKind::KwDefault},
    {"CONSTANT", TokenKind::KwConst},
    {"VOID", TokenKind::KwProc},
    {"BY", TokenKind::KwStep},
    {"INC", TokenKind::KwStep},
    {"INCREMENT", TokenKind::KwStep},
    {"EXCEPT", TokenKind::KwError},
    {"EXCEPTION", TokenKind::KwError},
    {"CATCH", TokenKind::KwError},
    {"PERSISTENT", TokenKind::KwPers},
    {"VARIABLE", TokenKind::KwVar},
    {"PRIVATE", TokenKind::KwLocal},
    {"STATIC", TokenKind::KwLocal},
    {"STRUCT", TokenKind::KwRecord},
    {"ENDSTRUCT", TokenKind::KwEndrecord}};

constexpr size_t kLongestTypo = 14;

} // namespace

bool MisspeltWords::meant(TokenIndex i, K word, unsigned limit) const {
    if (kindAt(i) != K::Identifier) return false;
    const std::string_view text = textOf(i);
    const std::string_view spelling = tokenText(word);
    if (text.size() < 2 || text.size() > kLongestTypo) return false;
    const std::string written = upperCase(text);
    bool known = false;
    for (const ForeignWord& foreign : kForeignWords) {
        if (foreign.word != written) continue;
        if (foreign.keyword == word) return true;
        known = true;
    }
    if (known) return false;
    if (limit == 0) limit = spelling.size() <= 4 ? 1 : 2;
    return editDistance(written, spelling, limit) <= limit;
}

/// Letters of the word in another order, or one too many or too few: "Dim" is not meant as DIV.
bool MisspeltWords::isShuffled(TokenIndex i, K word) const {
    std::string written = upperCase(textOf(i)), spelling(tokenText(word));
    if (written.size() != spelling.size()) return true;
    std::sort(written.begin(), written.end());
    std::sort(spelling.begin(), spelling.end());
    return written == spelling;
}

void MisspeltWords::retag(TokenIndex first, TokenIndex last, K word) {
    const SourceRange place{range(first).begin, range(last).end};
    const auto shown = sourceText().substr(place.begin, place.end - place.begin);
    const std::string spelling(tokenText(word));
    const auto closed = std::find(foreignClosers_.begin(), foreignClosers_.end(), last);
    if (closed != foreignClosers_.end()) {
        foreignClosers_.erase(closed);
    } else {
        diag::Diagnostic* diagnostic = reportAt(Code::MisspeltKeyword, place, {std::string(shown), spelling});
        fix(diagnostic, place, spelling);
        noteForeignCloser(diagnostic, last, word);
    }
    readAs(last, word);
}

bool MisspeltWords::retagIfMeant(K word) {
    if (!meant(pos(), word)) return false;
    retag(pos(), pos(), word);
    return true;
}

/// Does what follows the words at `pos()` to `last` agree with this keyword of a list?
bool MisspeltWords::fitsAsListWord(K word, TokenIndex last) const {
    TokenIndex found = 0;
    const K next = kindAt(last + 1);
    const bool alone = ahead().endsLine(last);
    switch (word) {
    case K::KwElseif: return !alone && ahead().findOnLine(last + 1, K::KwThen, found);
    case K::KwCase:
        return !alone && next != K::Colon && ahead().findOnLine(last + 1, K::Colon, found) &&
               !startsLine(found);
    case K::KwDefault: return next == K::Colon;
    case K::KwError: // of a call, the semicolon would follow
        if ((textOf(last)[0] | 32) == 'r') return alone && block().isHandledBelow(last + 1);
        return alone || (next == K::LeftParen && ahead().findOnLine(last + 2, K::RightParen, found) &&
                         startsLine(found + 1));
    default: return alone;
    }
}

bool MisspeltWords::retagMisspelt(const TokenSet& own) {
    const std::string_view text = textOf(pos());
    const K next = peek();
    if (!panic() && own.has(K::KwError) && ends().isPieceOf(pos(), K::KwError) &&
        block().isHandledBelow(pos() + 1)) { // "ER"
        retag(pos(), pos(), K::KwError);
        return true;
    }
    constexpr TokenSet kUsedAsName = {TokenKind::Assign, TokenKind::Semicolon, TokenKind::Dot,
                                      TokenKind::Comma,  TokenKind::LeftBrace, TokenKind::LeftBracket};
    if (text.size() < 3 || text.size() > kLongestTypo || kUsedAsName.has(next)) return false;
    static constexpr K kWords[] = {K::KwEndif,   K::KwEndfor,  K::KwEndwhile, K::KwEndtest, K::KwEndproc,
                                   K::KwEndfunc, K::KwEndtrap, K::KwElseif,   K::KwElse,    K::KwCase,
                                   K::KwDefault, K::KwError,   K::KwUndo,     K::KwBackward};
    if (own.has(K::KwEndfor) && next == K::Identifier && equalsNoCase(text, "NEXT") &&
        ahead().endsLine(pos() + 1)) {
        retag(pos(), pos() + 1, K::KwEndfor); // "NEXT i"
        take();
        return true;
    }
    const bool end = equalsNoCase(text, "END");
    if (end && next == K::KwIf && own.has(K::KwElseif) &&
        fitsAsListWord(K::KwElseif, pos() + 1)) { // "END IF b THEN"
        retag(pos(), pos() + 1, K::KwElseif);
        take();
        return true;
    }
    constexpr TokenSet kOfRoutines = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap};
    for (const K word : kWords) {
        if (!own.has(word)) continue;
        if (kOfRoutines.has(word) && word != block().routineEnd) {
            if (end || !fitsAsListWord(word, pos()) || !meant(pos(), word)) continue;
            return ends().retagOtherEnd();
        }
        const std::string_view spelling = tokenText(word);
        TokenIndex last = pos();
        const bool alone = end && startsLine(pos() + 1);
        const bool twoWords = end && spelling.starts_with("END");
        if (alone && !block().closesHere(word)) {
            report(Code::StrayKeyword, pos(), {describe(pos()), "a block"});
            mark(Mark::StrayEnd);
            return false;
        }
        if (twoWords && !alone) {
            if (!foreignCloserIs(pos() + 1) && (!isKeyword(next) || tokenText(next) != spelling.substr(3)))
                continue;
            last = pos() + 1;
        }
        if (next == K::Colon && (word != K::KwDefault || text.size() > spelling.size())) continue;
        if (!fitsAsListWord(word, last) || (!twoWords && !meant(pos(), word))) continue;
        retag(pos(), last, word);
        moveTo(last);
        return true;
    }
    return false;
}

bool MisspeltWords::retagData() {
    if (kind() == K::Identifier && isName(peek()) && peek(2) == K::Assign && torn().takesRunTogether())
        return true;
    if (kind() != K::Identifier || !isName(peek()) || !isName(peek(2)) || startsLine(pos() + 2)) return false;
    constexpr TokenSet kAfter = {K::Semicolon, K::Assign, K::LeftBrace, K::Equal};
    if (!kAfter.has(peek(3))) return false;
    return retagIfMeant(K::KwVar) || retagIfMeant(K::KwPers) || retagIfMeant(K::KwConst);
}

bool MisspeltWords::retagOpener() {
    const K a = peek(), b = peek(2);
    if (a != K::Identifier) return false;
    if (b == K::KwFrom) return retagIfMeant(K::KwFor);
    if (b == K::KwWith || (b == K::Identifier && meant(pos() + 2, K::KwWith) && peek(3) == K::Identifier))
        return retagIfMeant(K::KwConnect);
    const bool isCall =
        equalsNoCase(textOf(pos()), "CALL") && !startsLine(pos() + 1) && !startsLine(pos() + 2);
    if (isCall && (b == K::Identifier || b == K::NumLiteral || b == K::StringLiteral)) { // "CALL name 1;"
        fix(report(Code::ForeignSpelling, pos(), {std::string(textOf(pos())), "the name of the procedure"}),
            {range(pos()).begin, range(pos() + 1).begin}, "");
        take();
        return true;
    }
    if (b == K::Identifier) return retagData();
    if (b == K::Semicolon && equalsNoCase(textOf(pos()), "TRY") && equalsNoCase(textOf(pos() + 1), "NEXT")) {
        retag(pos(), pos() + 1, K::KwTrynext);
        take();
        return true;
    }
    return false;
}

bool MisspeltWords::retagCallee(TokenIndex callee) {
    K word = K::EndOfFile;
    if (kind() == K::KwThen)
        word = K::KwIf;
    else if (kind() == K::KwDo)
        word = K::KwWhile;
    else if (kind() == K::KwCase && startsLine(pos()) && callee + 1 < pos())
        word = K::KwTest;
    if (word == K::EndOfFile || !meant(callee, word, word == K::KwTest ? 1 : 2)) return false;
    moveTo(callee);
    retag(callee, callee, word);
    return true;
}

bool MisspeltWords::retagDecl() {
    if (kind() != K::Identifier) return false;
    const K a = peek(), b = peek(2);
    const bool line2 = startsLine(pos() + 1), line3 = startsLine(pos() + 2);
    if (isContextual(pos(), "END") && (a == K::EndOfFile || (a == K::KwModule && peek(2) == K::EndOfFile))) {
        const TokenIndex last = a == K::KwModule ? pos() + 1 : pos();
        retag(pos(), last, K::KwEndmodule);
        moveTo(last);
        return true;
    }
    if (line2 || a == K::EndOfFile) return retagIfMeant(K::KwEndmodule);
    constexpr TokenSet kDeclBegins = {K::KwVar,  K::KwPers, K::KwConst,  K::KwProc,
                                      K::KwFunc, K::KwTrap, K::KwRecord, K::KwAlias};
    if (kDeclBegins.has(a) && (isContextual(pos(), "GLOBAL") || isContextual(pos(), "PUBLIC"))) {
        fix(report(Code::ForeignSpelling, pos(),
                   {std::string(textOf(pos())), describe(pos() + 1) + ": what is not LOCAL is global"}),
            {range(pos()).begin, range(pos() + 1).begin}, "");
        take();
        return true;
    }
    if (kDeclBegins.has(a)) return retagIfMeant(K::KwLocal);
    if (!isName(a)) return false;
    if (b == K::LeftParen && !line3) return retagIfMeant(K::KwProc);
    if (line3) return retagIfMeant(K::KwTrap) || retagIfMeant(K::KwRecord) || retagIfMeant(K::KwProc);
    if (!isName(b)) return false;
    if (peek(3) == K::LeftParen) return retagIfMeant(K::KwFunc);
    return retagData() || (peek(3) == K::Semicolon && retagIfMeant(K::KwAlias));
}

/// Between two operands: "ANDD", "DVI". In an IF without THEN the name begins the instruction instead.
bool MisspeltWords::retagOperator() {
    if (startsLine(pos()) || startsLine(pos() + 1) || !startsExpr(peek())) return false;
    TokenIndex then = 0;
    if (block().inCondition && !ahead().findOnLine(pos(), K::KwThen, then)) return false;
    const bool isCall = peek() == K::LeftParen && range(pos()).end == range(pos() + 1).begin;
    if (isCall) return false;
    for (const K word : {K::KwAnd, K::KwOr, K::KwXor, K::KwDiv, K::KwMod})
        if (isShuffled(pos(), word) && retagIfMeant(word)) return true;
    return false;
}

bool MisspeltWords::isMisspeltOperator(const Expr* left) {
    if (left->kind == NodeKind::Name && !startsLine(pos()) && startsExpr(kind()) &&
        meant(left->first, K::KwNot) && isShuffled(left->first, K::KwNot)) {
        TokenIndex then = 0;
        if (block().inHead && block().opening != kNoToken && kindAt(block().opening) == K::KwFor)
            return false; // a bound
        if (block().inCondition && !ahead().findOnLine(pos(), K::KwThen, then)) return false;
        moveTo(left->first);
        retag(pos(), pos(), K::KwNot);
        return true;
    }
    return retagOperator();
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
