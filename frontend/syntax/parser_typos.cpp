// Misspelt keywords. A name is taken for a keyword only where a name cannot stand, or where what follows proves what was
// meant; the token is then changed, so that one typing mistake costs one diagnostic.

#include "frontend/source/spelling.h"
#include "frontend/syntax/parser_impl.h"

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

/// Blocks of other languages that RAPID writes in another way. WHILE is what closes DO.
struct ForeignBlock {
    std::string_view word;
    std::string_view closer; ///< "A|B": one of them; "A B": both, in this order
    std::string_view expected;
};
constexpr ForeignBlock kForeignBlocks[] = {
    {"REPEAT", "UNTIL|ENDREPEAT", "WHILE and a condition"},
    {"DO", "WHILE|ENDDO|LOOP|UNTIL", "WHILE and a condition before DO"},
    {"LOOP", "ENDLOOP|UNTIL|WHILE", "WHILE TRUE DO"},
    {"BEGIN", "END", "an instruction: blocks have no word of their own"},
    {"TRY", "CATCH ENDTRY", "an ERROR handler at the end of the routine"}};

constexpr size_t kLongestTypo = 14;

} // namespace

/// Could the name have been meant as this keyword? Short words have many neighbours, so they allow one edit.
bool Parser::meant(TokenIndex i, K word, unsigned limit) const {
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

/// Reports the word and reads it as the keyword it stands for. `last` is the last token of the word. A word of another
/// language brings its END word with it: both are one mistake.
void Parser::retag(TokenIndex first, TokenIndex last, K word) {
    const SourceRange range{tree_.range(first).begin, tree_.range(last).end};
    const auto shown = tree_.source->text().substr(range.begin, range.end - range.begin);
    const std::string spelling(tokenText(word));
    const auto closed = std::find(foreignClosers_.begin(), foreignClosers_.end(), last);
    if (closed != foreignClosers_.end()) {
        foreignClosers_.erase(closed);
    } else {
        diag::Diagnostic* diagnostic = reportAt(Code::MisspeltKeyword, range, {std::string(shown), spelling});
        fix(diagnostic, range, spelling);
        noteForeignCloser(diagnostic, last, word);
    }
    readAs(last, word);
}

/// The END word of another language that closes what the word at `opening` begins: "ENDSWITCH", "END SWITCH". Its last
/// token, or kNoToken.
TokenIndex Parser::foreignCloser(TokenIndex opening, K closer) const {
    const std::string begins = upperCase(textOf(opening)), ends = "END" + begins;
    const bool known =
        std::any_of(std::begin(kForeignWords), std::end(kForeignWords),
                    [&](const auto& foreign) { return foreign.word == ends && foreign.keyword == closer; });
    if (!known) return kNoToken;
    uint32_t open = 0;
    for (TokenIndex i = opening + 1; i < last_ && i < opening + kFarTokens; ++i) {
        if (kindAt(i) != K::Identifier || !startsLine(i)) continue;
        const bool twoWords = equalsNoCase(textOf(i), "END") && equalsNoCase(textOf(i + 1), begins);
        if (equalsNoCase(textOf(i), begins)) ++open;
        if (!twoWords && !equalsNoCase(textOf(i), ends)) continue;
        if (open-- == 0) return twoWords ? i + 1 : i;
    }
    return kNoToken;
}

void Parser::noteForeignCloser(diag::Diagnostic* diagnostic, TokenIndex opening, K word) {
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
    const SourceRange range{tree_.range(twoWords ? closer - 1 : closer).begin, tree_.range(closer).end};
    const std::string spelling(tokenText(pair->closer));
    note(diagnostic, closer, "and " + spelling + " here");
    diagnostic->fixes.back().edits.push_back({range, spelling});
}

bool Parser::retagIfMeant(K word) {
    if (!meant(pos_, word)) return false;
    retag(pos_, pos_, word);
    return true;
}

/// What only an ERROR handler can have, before the next handler or the end of the routine.
bool Parser::isHandledBelow(TokenIndex from) const {
    if (errors_ > kMaxErrorsPerFile) return false;
    for (TokenIndex i = from;
         i < from + kFarTokens && !kRoutineEnds.has(kindAt(i)) && kindAt(i) != K::EndOfFile; ++i)
        if (kindAt(i) == K::KwTrynext || kindAt(i) == K::KwRetry) return true;
    return false;
}

/// Does what follows the words at `pos_` to `last` agree with this keyword of a list?
bool Parser::fitsAsListWord(K word, TokenIndex last) const {
    TokenIndex found = 0;
    const K next = kindAt(last + 1);
    const bool alone = endsLine(last);
    switch (word) {
    case K::KwElseif: return !alone && findOnLine(last + 1, K::KwThen, found);
    case K::KwCase:
        return !alone && next != K::Colon && findOnLine(last + 1, K::Colon, found) && !startsLine(found);
    case K::KwDefault: return next == K::Colon;
    case K::KwError: // of a call, the semicolon would follow
        if ((textOf(last)[0] | 32) == 'r') return alone && isHandledBelow(last + 1);
        return alone ||
               (next == K::LeftParen && findOnLine(last + 2, K::RightParen, found) && startsLine(found + 1));
    default: return alone;
    }
}

/// LOOP, closed by ENDWHILE.
bool Parser::isEndlessLoop() {
    if (panic_ || !isContextual(pos_, "LOOP") || !endsLine(pos_) ||
        kindAt(unmatchedWord(pos_ + 1)) != K::KwEndwhile)
        return false;
    fix(report(Code::ForeignSpelling, pos_, {std::string(textOf(pos_)), "WHILE TRUE DO"}), tree_.range(pos_),
        "WHILE TRUE DO");
    return true;
}

/// REPEAT, LOOP ... at the end of a line: reported; the word that closes the block is then passed over.
bool Parser::startsForeignBlock() {
    if (!endsLine(pos_)) return false;
    const std::string word = upperCase(textOf(pos_));
    for (const ForeignBlock& block : kForeignBlocks) {
        if (block.word != word) continue;
        report(Code::ForeignSpelling, pos_, {word, std::string(block.expected)});
        foreignCloser_ = block.closer;
        take();
        return true;
    }
    return false;
}

/// Is it the END word of a block whose opening word has been reported?
bool Parser::foreignCloserIs(TokenIndex i) const {
    return std::find(foreignClosers_.begin(), foreignClosers_.end(), i) != foreignClosers_.end();
}

/// One of the words that may come next.
bool Parser::isForeignCloser(TokenIndex i) const {
    std::string_view closers = foreignCloser_.substr(0, foreignCloser_.find(' '));
    while (!closers.empty()) {
        const std::string_view one = closers.substr(0, closers.find('|'));
        if (equalsNoCase(textOf(i), one)) return true;
        closers.remove_prefix(std::min(one.size() + 1, closers.size()));
    }
    return false;
}

bool Parser::endsForeignBlock() {
    if (!isForeignCloser(pos_)) return false;
    const size_t length = foreignCloser_.find(' ');
    foreignCloser_.remove_prefix(length == std::string_view::npos ? foreignCloser_.size() : length + 1);
    take();
    if (!startsLine(pos_)) syncStatement();
    return true;
}

/// "ENDIFF", "END IF", "ELSIF", "CSAE 2:": names at the beginning of an instruction that stand for a word this list
/// waits for.
bool Parser::retagMisspelt(const TokenSet& own) {
    const std::string_view text = textOf(pos_);
    const K next = peek();
    if (!panic_ && own.has(K::KwError) && isPieceOf(pos_, K::KwError) && isHandledBelow(pos_ + 1)) { // "ER"
        retag(pos_, pos_, K::KwError);
        return true;
    }
    constexpr TokenSet kUsedAsName = {TokenKind::Assign, TokenKind::Semicolon, TokenKind::Dot,
                                      TokenKind::Comma,  TokenKind::LeftBrace, TokenKind::LeftBracket};
    if (text.size() < 3 || text.size() > kLongestTypo || kUsedAsName.has(next)) return false;
    static constexpr K kWords[] = {K::KwEndif,   K::KwEndfor,  K::KwEndwhile, K::KwEndtest, K::KwEndproc,
                                   K::KwEndfunc, K::KwEndtrap, K::KwElseif,   K::KwElse,    K::KwCase,
                                   K::KwDefault, K::KwError,   K::KwUndo,     K::KwBackward};
    if (own.has(K::KwEndfor) && next == K::Identifier && equalsNoCase(text, "NEXT") && endsLine(pos_ + 1)) {
        retag(pos_, pos_ + 1, K::KwEndfor); // "NEXT i"
        ++pos_;
        return true;
    }
    const bool end = equalsNoCase(text, "END");
    if (end && next == K::KwIf && own.has(K::KwElseif) &&
        fitsAsListWord(K::KwElseif, pos_ + 1)) { // "END IF b THEN"
        retag(pos_, pos_ + 1, K::KwElseif);
        ++pos_;
        return true;
    }
    constexpr TokenSet kOfRoutines = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap};
    for (const K word : kWords) {
        if (!own.has(word)) continue;
        if (kOfRoutines.has(word) && word != routineEnd_) {
            if (end || !fitsAsListWord(word, pos_) || !meant(pos_, word)) continue;
            return retagOtherEnd();
        }
        const std::string_view spelling = tokenText(word);
        TokenIndex last = pos_;
        const bool alone = end && startsLine(pos_ + 1);
        const bool twoWords = end && spelling.starts_with("END");
        if (alone && !closesHere(word)) {
            report(Code::StrayKeyword, pos_, {describe(pos_), "a block"});
            strayEnd_ = pos_;
            return false;
        }
        if (twoWords && !alone) {
            if (!foreignCloserIs(pos_ + 1) && (!isKeyword(next) || tokenText(next) != spelling.substr(3)))
                continue;
            last = pos_ + 1;
        }
        if (next == K::Colon && (word != K::KwDefault || text.size() > spelling.size())) continue;
        if (!fitsAsListWord(word, last) || (!twoWords && !meant(pos_, word))) continue;
        retag(pos_, last, word);
        pos_ = last;
        return true;
    }
    return false;
}

/// At a name that was meant as the END word of another kind of routine, "endfunction" in a PROC: that of this one, unless
/// it is still to come.
bool Parser::retagOtherEnd() {
    if (endOfRoutineBelow() != routineEnd_) {
        retag(pos_, pos_, routineEnd_);
        return true;
    }
    report(Code::UnexpectedToken, pos_,
           {describe(pos_), "an instruction: " + std::string(tokenText(routineEnd_)) + " is still to come"});
    strayEnd_ = pos_;
    return false;
}

/// "VRA num x;", "PRES num x := 1;": three names in a row are a declaration.
bool Parser::retagData() {
    if (kind() == K::Identifier && isName(peek()) && peek(2) == K::Assign && takesRunTogether()) return true;
    if (kind() != K::Identifier || !isName(peek()) || !isName(peek(2)) || startsLine(pos_ + 2)) return false;
    constexpr TokenSet kAfter = {K::Semicolon, K::Assign, K::LeftBrace, K::Equal};
    if (!kAfter.has(peek(3))) return false;
    return retagIfMeant(K::KwVar) || retagIfMeant(K::KwPers) || retagIfMeant(K::KwConst);
}

/// A name that begins an instruction and is no callee.
bool Parser::retagOpener() {
    const K a = peek(), b = peek(2);
    if (a != K::Identifier) return false;
    if (b == K::KwFrom) return retagIfMeant(K::KwFor);
    if (b == K::KwWith || (b == K::Identifier && meant(pos_ + 2, K::KwWith) && peek(3) == K::Identifier))
        return retagIfMeant(K::KwConnect);
    const bool isCall = equalsNoCase(textOf(pos_), "CALL") && !startsLine(pos_ + 1) && !startsLine(pos_ + 2);
    if (isCall && (b == K::Identifier || b == K::NumLiteral || b == K::StringLiteral)) { // "CALL name 1;"
        fix(report(Code::ForeignSpelling, pos_, {std::string(textOf(pos_)), "the name of the procedure"}),
            {tree_.range(pos_).begin, tree_.range(pos_ + 1).begin}, "");
        take();
        return true;
    }
    if (b == K::Identifier) return retagData();
    if (b == K::Semicolon && equalsNoCase(textOf(pos_), "TRY") && equalsNoCase(textOf(pos_ + 1), "NEXT")) {
        retag(pos_, pos_ + 1, K::KwTrynext);
        ++pos_;
        return true;
    }
    return false;
}

/// What was read as a call goes on with THEN, DO or CASE: the callee was meant as IF, WHILE or TEST.
bool Parser::retagCallee(TokenIndex callee) {
    K word = K::EndOfFile;
    if (kind() == K::KwThen)
        word = K::KwIf;
    else if (kind() == K::KwDo)
        word = K::KwWhile;
    else if (kind() == K::KwCase && startsLine(pos_) && callee + 1 < pos_)
        word = K::KwTest;
    if (word == K::EndOfFile || !meant(callee, word, word == K::KwTest ? 1 : 2)) return false;
    pos_ = callee;
    retag(callee, callee, word);
    return true;
}

/// At module level, where only a declaration or ENDMODULE can stand.
bool Parser::retagDecl() {
    if (kind() != K::Identifier) return false;
    const K a = peek(), b = peek(2);
    const bool line2 = startsLine(pos_ + 1), line3 = startsLine(pos_ + 2);
    if (isContextual(pos_, "END") && (a == K::EndOfFile || (a == K::KwModule && peek(2) == K::EndOfFile))) {
        const TokenIndex last = a == K::KwModule ? pos_ + 1 : pos_;
        retag(pos_, last, K::KwEndmodule);
        pos_ = last;
        return true;
    }
    if (line2 || a == K::EndOfFile) return retagIfMeant(K::KwEndmodule);
    constexpr TokenSet kDeclWords = {K::KwVar,  K::KwPers, K::KwConst,  K::KwProc,
                                     K::KwFunc, K::KwTrap, K::KwRecord, K::KwAlias};
    if (kDeclWords.has(a) && (isContextual(pos_, "GLOBAL") || isContextual(pos_, "PUBLIC"))) {
        fix(report(Code::ForeignSpelling, pos_,
                   {std::string(textOf(pos_)), describe(pos_ + 1) + ": what is not LOCAL is global"}),
            {tree_.range(pos_).begin, tree_.range(pos_ + 1).begin}, "");
        take();
        return true;
    }
    if (kDeclWords.has(a)) return retagIfMeant(K::KwLocal);
    if (!isName(a)) return false;
    if (b == K::LeftParen && !line3) return retagIfMeant(K::KwProc);
    if (line3) return retagIfMeant(K::KwTrap) || retagIfMeant(K::KwRecord) || retagIfMeant(K::KwProc);
    if (!isName(b)) return false;
    if (peek(3) == K::LeftParen) return retagIfMeant(K::KwFunc);
    return retagData() || (peek(3) == K::Semicolon && retagIfMeant(K::KwAlias));
}

/// Between two operands: "ANDD", "DVI". In an IF without THEN the name begins the instruction instead.
bool Parser::retagOperator() {
    if (startsLine(pos_) || startsLine(pos_ + 1) || !startsExpr(peek())) return false;
    TokenIndex then = 0;
    if (inCondition_ && !findOnLine(pos_, K::KwThen, then)) return false;
    const bool isCall = peek() == K::LeftParen && tree_.range(pos_).end == tree_.range(pos_ + 1).begin;
    if (isCall) return false;
    for (const K word : {K::KwAnd, K::KwOr, K::KwXor, K::KwDiv, K::KwMod})
        if (isShuffled(pos_, word) && retagIfMeant(word)) return true;
    return false;
}

/// Letters of the word in another order, or one too many or too few: "Dim" is not meant as DIV.
bool Parser::isShuffled(TokenIndex i, K word) const {
    std::string written = upperCase(textOf(i)), spelling(tokenText(word));
    if (written.size() != spelling.size()) return true;
    std::sort(written.begin(), written.end());
    std::sort(spelling.begin(), spelling.end());
    return written == spelling;
}

} // namespace rapid::syntax
