// END words: which block they end, and what was meant where they are missing, misplaced or written in another way.

#include "frontend/syntax/parser_impl.h"

#include <fmt/format.h>

#include <utility>

namespace rapid::syntax {

using diag::Code;

namespace {

/// A routine has ended before these.
constexpr TokenSet kBehindRoutine = {TokenKind::KwProc,   TokenKind::KwFunc,      TokenKind::KwTrap,
                                     TokenKind::KwModule, TokenKind::KwEndmodule, TokenKind::EndOfFile};
constexpr TokenSet kBlockEnds = {TokenKind::KwEndif, TokenKind::KwEndfor, TokenKind::KwEndwhile,
                                 TokenKind::KwEndtest};

} // namespace

/// The END word of a block. A missing one is reported where the text can no longer belong to the block; when its head is
/// broken, that has been reported.
void Parser::closeBlock(K end, TokenIndex opening, bool whole) {
    if (accept(end)) {
        panic_ = false;
        return;
    }
    if (abandoned_) return;
    if (kBlockEnds.has(kind()) && peek() == end &&
        enclosing_.has(kind())) { // two END words in the wrong order
        note(report(Code::MissingBlockEnd, pos_, {describe(pos_), std::string(tokenText(end))}), opening,
             fmt::format("{} begins here, so its {} comes first", describe(opening), tokenText(end)));
        readAs(pos_ + 1, kind());
        readAs(pos_, end);
        take();
        return;
    }
    const std::string opened = describe(opening);
    if (whole && isNewsHere())
        note(report(Code::MissingBlockEnd, pos_, {describe(pos_), std::string(tokenText(end))}), opening,
             fmt::format("{} begins here", opened));
    if (wrongEnd_ == pos_) take();
}

/// The opener of the innermost block around this one that a word belongs to; kNoToken when there is none.
TokenIndex Parser::outerOpenerOf(K word) const {
    struct Family {
        TokenSet words;
        K opener, closer;
    };
    static constexpr Family kFamilies[] = {{kIfEnds, K::KwIf, K::KwEndif},
                                           {kTestEnds, K::KwTest, K::KwEndtest},
                                           {{K::KwEndfor}, K::KwFor, K::KwEndfor},
                                           {{K::KwEndwhile}, K::KwWhile, K::KwEndwhile}};
    for (const Family& family : kFamilies) {
        if (!family.words.has(word)) continue;
        uint32_t closed = 0;
        const TokenIndex end = std::max(routineStart_, blockOpening_ - std::min(blockOpening_, kFarTokens));
        for (TokenIndex i = blockOpening_; i-- > end;) {
            TokenIndex then = 0;
            if (kindAt(i) == family.closer) ++closed;
            if (kindAt(i) != family.opener ||
                (family.opener == K::KwIf && !findOnLine(i + 1, K::KwThen, then)))
                continue;
            if (closed-- == 0) return i;
        }
    }
    return kNoToken;
}

/// At a word that a block further out waits for: by its margin it stands in this block all the same, and below the outer
/// one there is such a word again.
bool Parser::standsInside() const {
    if (blockOpening_ == kNoToken || !startsLine(pos_) || !startsLine(blockOpening_)) return false;
    if (errors_ > kMaxErrorsPerFile) return false;
    const TokenIndex outer = outerOpenerOf(kind());
    if (outer == kNoToken || !startsLine(outer)) return false;
    const uint32_t margin = columnOf(outer);
    if (columnOf(pos_) < columnOf(blockOpening_) || columnOf(blockOpening_) <= margin) return false;
    const TokenSet family = kIfEnds.has(kind())     ? kIfEnds
                            : kTestEnds.has(kind()) ? kTestEnds
                                                    : TokenSet{kind()};
    for (TokenIndex i = pos_ + 1; i < last_ && i < pos_ + kFarTokens; ++i)
        if (startsLine(i) && columnOf(i) <= margin) return columnOf(i) == margin && family.has(kindAt(i));
    return false;
}

/// From a place on: the first word that goes on with or ends a block, a handler or a routine, and whose block does not
/// begin there. The end of the file, once so many mistakes have been found that no more are shown.
TokenIndex Parser::unmatchedWord(TokenIndex from) const {
    if (errors_ > kMaxErrorsPerFile) return last_;
    constexpr TokenSet kBranches = {K::KwElse, K::KwElseif, K::KwCase, K::KwDefault};
    uint32_t open = 0;
    TokenIndex i = from;
    for (; i < from + kFarTokens && i < last_; ++i) {
        const K k = kindAt(i);
        if (kRoutineEnds.has(k)) return i;
        TokenIndex then = 0;
        if (k == K::KwFor || k == K::KwWhile || k == K::KwTest ||
            (k == K::KwIf && findOnLine(i + 1, K::KwThen, then)))
            ++open;
        if (open == 0 && (kBranches.has(k) || kBlockEnds.has(k))) return i;
        if (kBlockEnds.has(k)) --open;
    }
    return i;
}

/// The END word of the list that is being read.
TokenKind Parser::endOfOwn(const TokenSet& own) const {
    for (const K end : {K::KwEndif, K::KwEndfor, K::KwEndwhile, K::KwEndtest})
        if (own.has(end)) return end;
    return routineEnd_;
}

/// Is the word here, which could stand for any END, that of the block around it? Not if that is still to come, unless
/// it stands below the word that began the block.
bool Parser::closesHere(K end) const {
    if (end == routineEnd_ && errors_ <= kMaxErrorsPerFile && endOfRoutineBelow() == end) return false;
    if (errors_ > kMaxErrorsPerFile || kindAt(unmatchedWord(pos_ + 1)) != end) return true;
    return end != routineEnd_ && blockOpening_ != kNoToken && startsLine(blockOpening_) &&
           columnOf(pos_) == columnOf(blockOpening_);
}

/// What is left of an END word that was cut off or written into another one: "EN", "ENDPENDPROC".
bool Parser::isPieceOf(TokenIndex i, K end) const {
    if (kindAt(i) != K::Identifier || !startsLine(i) || !startsLine(i + 1)) return false;
    const std::string_view text = textOf(i), word = tokenText(end);
    constexpr size_t kLeast = 2;
    if (text.size() < kLeast) return false;
    if (text.size() < word.size()) return equalsNoCase(text, word.substr(0, text.size()));
    return equalsNoCase(text.substr(text.size() - word.size()), word) &&
           equalsNoCase(text.substr(0, kLeast), word.substr(0, kLeast));
}

/// Such a piece where the list that is being read ends: before the next routine, or in line with the word that began the
/// block.
bool Parser::retagPiece(const TokenSet& own) {
    const K end = endOfOwn(own);
    if (panic_ || !own.has(end) || !isPieceOf(pos_, end)) return false;
    const bool behind = kBehindRoutine.has(peek()) || peek() == K::KwLocal;
    const bool fits = end == routineEnd_ ? behind
                                         : blockOpening_ != kNoToken && startsLine(blockOpening_) &&
                                               columnOf(pos_) == columnOf(blockOpening_) && closesHere(end);
    if (fits) retag(pos_, pos_, end);
    return fits;
}

/// The last word of the file, where ENDMODULE belongs: another END word, or a piece of that one.
bool Parser::retagLastEnd() {
    if (peek() != K::EndOfFile || kind() == K::EndOfFile || !startsLine(pos_)) return false;
    if (isPieceOf(pos_, K::KwEndmodule)) {
        if (quietOutside_)
            readAs(pos_, K::KwEndmodule);
        else
            retag(pos_, pos_, K::KwEndmodule);
        return true;
    }
    if (!kEndWords.has(kind())) return false;
    if (!quietOutside_)
        fix(report(Code::MissingBlockEnd, pos_, {describe(pos_), "ENDMODULE"}), tree_.range(pos_),
            "ENDMODULE");
    readAs(pos_, K::KwEndmodule);
    return true;
}

/// At ENDMODULE in a routine whose own END word is still to come. Afterwards the list goes on.
bool Parser::takesEarlyEndmodule() {
    if (panic_ || abandoned_ || !endsRoutineTooEarly()) return false;
    const std::string end(tokenText(routineEnd_));
    if (peek() == routineEnd_ && kindAt(pos_ + 2) == K::EndOfFile) { // the two in the wrong order
        report(Code::MissingBlockEnd, pos_, {describe(pos_), end});
        readAs(pos_ + 1, K::KwEndmodule);
        readAs(pos_, routineEnd_);
        return true;
    }
    report(Code::UnexpectedToken, pos_, {describe(pos_), "an instruction: " + end + " is still to come"});
    take();
    return true;
}

/// '}' alone in a line, where no '{' began the block.
bool Parser::retagBrace(const TokenSet& own) {
    const K end = endOfOwn(own);
    if (panic_ || !own.has(end) || !startsLine(pos_) || !startsLine(pos_ + 1) || !closesHere(end))
        return false;
    retag(pos_, pos_, end);
    return true;
}

/// ENDPROC and the like in a block, while the END word of the routine is still to come.
bool Parser::endsRoutineTooEarly() const {
    constexpr TokenSet kEnds = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap, K::KwEndmodule};
    if (!kEnds.has(kind()) || errors_ > kMaxErrorsPerFile) return false;
    TokenIndex i = pos_ + 1;
    while (kindAt(i) != routineEnd_ && !kBehindRoutine.has(kindAt(i)))
        ++i;
    return kindAt(i) == routineEnd_;
}

/// "CASE n" and "CASE 1:" below it, in no TEST.
bool Parser::isTestWrittenCase() {
    TokenIndex found = 0, next = pos_ + 1;
    if (panic_ || kind() != K::KwCase || enclosing_.has(K::KwCase) || findOnLine(pos_ + 1, K::Colon, found))
        return false;
    constexpr TokenIndex kLongHead = 50;
    while (next < pos_ + kLongHead && !startsLine(next))
        ++next;
    if (!startsLine(next) || kindAt(next) != K::KwCase) return false;
    retag(pos_, pos_, K::KwTest);
    return true;
}

/// The END word of this routine, whatever word began it; EndOfFile if there is none ahead of the next routine.
TokenKind Parser::endOfRoutineBelow() const {
    constexpr TokenSet kEnds = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap};
    TokenIndex& i = routineEndBelow_.found;
    if (pos_ < routineEndBelow_.from || pos_ > i) i = routineEndBelow_.from = pos_;
    while (!kEnds.has(kindAt(i)) && !kBehindRoutine.has(kindAt(i)))
        ++i;
    return kEnds.has(kindAt(i)) ? kindAt(i) : K::EndOfFile;
}

/// A word that ends a list of instructions, but neither this one nor one around it. Returns true when it is taken as
/// the end of this list all the same.
bool Parser::handleStray(const TokenSet& own) {
    struct Pair {
        K stray;
        std::string_view opener;
    };
    static constexpr Pair kOpeners[] = {
        {K::KwEndif, "IF ... THEN"},  {K::KwElse, "IF ... THEN"}, {K::KwElseif, "IF ... THEN"},
        {K::PlaceEit, "IF ... THEN"}, {K::KwEndfor, "FOR"},       {K::KwEndwhile, "WHILE"},
        {K::KwEndtest, "TEST"},       {K::KwCase, "TEST"},        {K::KwDefault, "TEST"},
        {K::PlaceCse, "TEST"},        {K::KwEndrecord, "RECORD"},
    };
    const K stray = kind();
    const bool isEnd = kEndWords.has(stray);
    const bool inBlock =
        own.has(K::KwEndif) || own.has(K::KwEndfor) || own.has(K::KwEndwhile) || own.has(K::KwEndtest);
    if (isEnd && inBlock && startsLine(pos_) && blockOpening_ != kNoToken &&
        columnOf(pos_) == columnOf(blockOpening_)) {
        wrongEnd_ = pos_;
        return true;
    }
    if (stray == K::KwElse && own.has(K::KwDefault)) { // of TEST
        const std::string word = peek() == K::Colon ? "DEFAULT" : "DEFAULT:";
        fix(report(Code::MisspeltKeyword, pos_, {describe(pos_), word}), tree_.range(pos_), word);
        readAs(pos_, K::KwDefault);
        colonGiven_ = peek() != K::Colon;
        return true;
    }
    constexpr TokenSet kOfIf = {K::KwEndif, K::KwElse, K::KwElseif};
    if (kOfIf.has(stray) && compactIf_ != kNoToken && compactIfEnd_ != kNoToken &&
        columnOf(pos_) == columnOf(compactIf_)) { // IF without THEN, its block closed by ENDIF
        const SourceRange place = endOf(compactIfEnd_);
        diag::Diagnostic* diagnostic =
            reportAt(Code::MissingBlockWord, place, {describe(compactIfEnd_ + 1), "THEN"});
        fix(diagnostic, place, " THEN");
        note(diagnostic, pos_,
             fmt::format("this {} belongs to a block, which begins with THEN", describe(pos_)));
        compactIf_ = kNoToken;
        return false;
    }
    // Followed by the next routine: the end of this one was meant.
    constexpr TokenSet kNext = {K::KwProc, K::KwFunc, K::KwTrap, K::KwEndmodule, K::KwLocal, K::EndOfFile};
    if (isEnd && own.has(K::KwEndproc) && kNext.has(peek())) {
        wrongEnd_ = pos_;
        return true;
    }
    if (inBlock && endsRoutineTooEarly() && own.has(kindAt(unmatchedWord(pos_ + 1)))) {
        report(Code::UnexpectedToken, pos_,
               {describe(pos_),
                "an instruction: " + std::string(tokenText(endOfOwn(own))) + " is still to come"});
        return false;
    }
    if (inBlock && endsRoutineTooEarly()) {
        wrongEnd_ = pos_;
        return true;
    }
    std::string_view opener = "a routine";
    for (const Pair& pair : kOpeners)
        if (pair.stray == stray) opener = pair.opener;
    diag::Diagnostic* diagnostic = report(Code::StrayKeyword, pos_, {describe(pos_), std::string(opener)});
    if (opener.starts_with("IF") && compactIf_ != kNoToken)
        note(diagnostic, compactIf_, "this IF has no THEN, so it ends with one instruction");
    return false;
}

} // namespace rapid::syntax
