// Reporting, and how the parser finds firm ground again after a mistake.

#include "frontend/syntax/later_words.h"
#include "frontend/syntax/parser_impl.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rapid::syntax {

using diag::Code;

namespace {

/// Words that begin an instruction.
constexpr TokenSet kStmtWords = {
    TokenKind::KwIf,     TokenKind::KwFor,   TokenKind::KwWhile,    TokenKind::KwTest,  TokenKind::KwGoto,
    TokenKind::KwReturn, TokenKind::KwRaise, TokenKind::KwConnect,  TokenKind::KwRetry, TokenKind::KwTrynext,
    TokenKind::KwExit,   TokenKind::KwBreak, TokenKind::KwContinue, TokenKind::PlaceSmt};
constexpr TokenSet kBlockWords = {TokenKind::KwElse,     TokenKind::KwElseif, TokenKind::KwCase,
                                  TokenKind::KwDefault,  TokenKind::KwError,  TokenKind::KwUndo,
                                  TokenKind::KwBackward, TokenKind::PlaceEit, TokenKind::PlaceCse};
constexpr TokenSet kDeclWords = {
    TokenKind::KwVar,    TokenKind::KwPers,   TokenKind::KwConst,  TokenKind::KwLocal, TokenKind::KwProc,
    TokenKind::KwFunc,   TokenKind::KwTrap,   TokenKind::KwRecord, TokenKind::KwAlias, TokenKind::KwModule,
    TokenKind::PlaceTdn, TokenKind::PlaceDdn, TokenKind::PlaceRdn};
constexpr TokenSet kLineWords = kStmtWords | kEndWords | kBlockWords | kDeclWords;
/// What ends any search for a word that is missing.
constexpr TokenSet kSearchEnd = kLineWords | TokenSet{TokenKind::Semicolon};

constexpr uint32_t kSearchTokens = 200;

/// What tells of words that could not be read: the next ones may be misread.
bool isUnread(Code code) {
    constexpr Code kAll[] = {Code::UnexpectedToken,           Code::MissingClosing,   Code::MissingSemicolon,
                             Code::InstructionOutsideRoutine, Code::PartOfCallResult, Code::BadNumber};
    return std::find(std::begin(kAll), std::end(kAll), code) != std::end(kAll);
}

/// What is said of words only because others are expected there.
bool isOnlyUnexpected(Code code) {
    constexpr Code kAll[] = {Code::UnexpectedToken, Code::ReservedWordAsName, Code::MissingClosing,
                             Code::MissingSemicolon, Code::InstructionOutsideRoutine};
    return std::find(std::begin(kAll), std::end(kAll), code) != std::end(kAll);
}

/// What is said where a name may have been torn in two.
bool isTornPlace(Code code) {
    return code == Code::UnexpectedToken || code == Code::MissingClosing || code == Code::MissingBlockWord;
}

} // namespace

// ---- Reporting ------------------------------------------------------------------------------------------------

diag::Diagnostic* Parser::reportAt(Code code, SourceRange range, std::initializer_list<std::string> args) {
    if (panic_) return nullptr;
    if (code >= Code::UnexpectedToken && code < Code::MissingSemicolon) ++unreadable_;
    if (isConsequence(code, range) || followsFromLast(code, range)) return nullptr;
    if (range.begin == tokens_[pos_].offset && isTornPlace(code))
        if (diag::Diagnostic* torn = reportTornName()) return torn;
    if (isUnread(code)) lastUnread_ = range.begin;
    if (++errors_ <= kMaxErrorsPerFile) {
        lastReport_ = &sink_.report(code, tree_.source, range, args);
        reports_ = sink_.all().size();
        return lastReport_;
    }
    if (errors_ == kMaxErrorsPerFile + 1) sink_.report(Code::TooManyErrors, tree_.source, range, {"errors"});
    return nullptr;
}

/// Whether the lexer has said it: about this token, or about a string in the line that lacks one of its quotes.
bool Parser::isConsequence(Code code, SourceRange range) {
    if (code != Code::UnexpectedToken && code != Code::MissingClosing && code != Code::MissingSemicolon &&
        code != Code::MissingBlockWord)
        return false;
    if (badNumber_ != kNoToken && badNumber_ == pos_) return true;
    if (std::binary_search(lexErrors_.begin(), lexErrors_.end(), range.begin)) return true;
    const auto broken =
        std::lower_bound(brokenStrings_.begin(), brokenStrings_.end(), range.begin,
                         [](const BrokenString& s, uint32_t at) { return s.range.begin < at; });
    if (broken == brokenStrings_.end()) return false;
    const std::string_view text = tree_.source->text();
    const size_t end = text.find_first_of("\r\n", range.begin);
    if (end < broken->range.begin) return false;
    if (broken->doubtful.end == 0) broken->doubtful = range;
    return true;
}

/// Whether the words are right behind some that could not be read: in the same line, or in the next one when that begins
/// with the semicolon of the first.
bool Parser::followsFromLast(Code code, SourceRange range) const {
    constexpr uint32_t kNear = 4;
    if (lastUnread_ == kNowhere || range.begin < lastUnread_ || !isOnlyUnexpected(code)) return false;
    TokenIndex i = pos_;
    for (uint32_t k = 0; tokens_[i].offset > lastUnread_; ++k, --i)
        if (k == kNear || (startsLine(i) && kindAt(i) != K::Semicolon)) return false;
    return true;
}

diag::Diagnostic* Parser::reportAfterExpr(Code code, std::initializer_list<std::string> args) {
    if (kind() != K::Question) return report(code, pos_, args);
    if (!panic_) ++unreadable_;
    return report(Code::ForeignSpelling, pos_, {"?", "IF ... THEN ... ELSE ... ENDIF to choose a value"});
}

bool Parser::isLastReport() const {
    return lastReport_ && reports_ == sink_.all().size();
}

/// Part of what has just been reported in the same line, with this code: a note there. False when nothing was.
bool Parser::joinLast(Code code, SourceRange place, std::string_view message) {
    if (panic_ || !isLastReport() || lastReport_->code != code || place.begin < lastReport_->range.end)
        return false;
    const uint32_t from = lastReport_->range.end;
    if (tree_.source->text().substr(from, place.begin - from).find_first_of("\r\n") != std::string_view::npos)
        return false;
    if (!message.empty()) lastReport_->notes.push_back({tree_.source, place, std::string(message)});
    return true;
}

/// The same, with one more edit to its fix.
bool Parser::joinLastEdit(Code code, SourceRange place, std::string replacement) {
    if (!isLastReport() || lastReport_->fixes.empty()) return false;
    const std::string message = replacement.empty() ? "and without this" : "and '" + replacement + "' here";
    if (!joinLast(code, place, message)) return false;
    lastReport_->fixes.front().edits.push_back({place, std::move(replacement)});
    return true;
}

void Parser::note(diag::Diagnostic* diagnostic, TokenIndex at, std::string message) {
    if (!diagnostic || at == kNoToken) return;
    diagnostic->notes.push_back({tree_.source, tree_.range(at), std::move(message)});
}

std::string Parser::describe(TokenIndex i) const {
    const K k = tokens_[i].kind;
    if (isKeyword(k) || isPlaceholder(k)) return std::string(tokenText(k));
    if (k == K::EndOfFile) return "the end of the file";
    std::string_view text = textOf(i);
    constexpr size_t kShown = 40;
    if (text.size() <= kShown) return fmt::format("'{}'", text);
    size_t cut = kShown;
    while ((static_cast<unsigned char>(text[cut]) & 0xC0) == 0x80)
        --cut;
    return fmt::format("'{}...'", text.substr(0, cut));
}

/// `(operand)`
void Parser::fixParentheses(diag::Diagnostic* diagnostic, const Node& operand) {
    if (!diagnostic || panic_) return;
    const SourceRange whole = tree_.range(operand);
    diag::Diagnostic::Fix both{"put the operand in parentheses",
                               {{{whole.begin, whole.begin}, "("}, {{whole.end, whole.end}, ")"}}};
    diagnostic->fixes.push_back(std::move(both));
}

/// `=`, `==` or `=:` where `:=` belongs; the parser then stands at the last token of it.
void Parser::reportEqual() {
    const bool turned = peek() == K::Colon && tree_.range(pos_).end == tree_.range(pos_ + 1).begin;
    const SourceRange sign{tree_.range(pos_).begin, tree_.range(turned ? pos_ + 1 : pos_).end};
    if (turned || textOf(pos_) == "==") {
        fix(reportAt(Code::ForeignSpelling, sign, {turned ? "=:" : "==", "':='"}), sign, ":=");
        if (turned) take();
    } else {
        fix(report(Code::EqualInAssignment, pos_), sign, ":=");
    }
}

void Parser::unexpected(std::string_view expected) {
    if (kind() != K::Error) report(Code::UnexpectedToken, pos_, {describe(pos_), std::string(expected)});
    endReported_ |= kind() == K::EndOfFile;
    panic_ = true;
}

/// What the line before lacks at its end; at a token within a line like unexpected().
void Parser::missing(std::string_view expected) {
    if (!startsLine(pos_) || pos_ == 0 || kind() == K::Error) return unexpected(expected);
    reportAt(Code::UnexpectedToken, endOf(pos_ - 1), {describe(pos_), std::string(expected)});
    endReported_ |= kind() == K::EndOfFile;
    panic_ = true;
}

/// Whether it is worth saying that the file ends too early: once.
bool Parser::isNewsHere() {
    return kind() != K::EndOfFile || !std::exchange(endReported_, true);
}

/// At ':=' behind what was read as an operand: it is the target of an instruction of its own, and the line before is
/// not finished. The parser then stands at this instruction.
bool Parser::assignmentBelow() {
    if (panic_ || kind() != K::Assign) return false;
    TokenIndex first = pos_;
    for (uint32_t k = 0; k < kSearchTokens && first > 0 && !startsLine(first); ++k)
        --first;
    if (first == pos_ || !isName(kindAt(first)) || !startsLine(first)) return false;
    constexpr TokenSet kBeforeOperand = {
        K::Assign,  K::Equal,  K::NotEqual, K::Less,  K::LessEqual, K::Greater,   K::GreaterEqual, K::Plus,
        K::Minus,   K::Star,   K::Slash,    K::KwDiv, K::KwMod,     K::KwAnd,     K::KwOr,         K::KwXor,
        K::KwNot,   K::Comma,  K::Dot,      K::KwIf,  K::LeftParen, K::LeftBrace, K::LeftBracket,  K::KwFrom,
        K::KwWhile, K::KwStep, K::KwTest,   K::KwTo,  K::KwElseif,  K::KwReturn,  K::KwRaise};
    if (kindAt(first - 1) == K::LeftBrace && braces_ > 0) return false; // of a block
    if (first <= wentBackTo_ || !kBeforeOperand.has(kindAt(first - 1)))
        return false; // never to a place twice
    for (TokenIndex i = first; i < pos_; ++i)
        if (kindAt(i) == K::Comma || kindAt(i) == K::LeftParen || kindAt(i) == K::Backslash) return false;
    pos_ = wentBackTo_ = first;
    missing("an expression");
    return true;
}

void Parser::reportTooDeep() {
    report(Code::NestingTooDeep, pos_, {std::to_string(kMaxDepth)});
    panic_ = true;
}

void Parser::checkNameLength(TokenIndex name) {
    if (name == kNoToken || tokens_[name].length <= kMaxNameLength) return;
    const std::string_view text = textOf(name);
    const auto isStart = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
    const auto length = static_cast<size_t>(std::count_if(text.begin(), text.end(), isStart));
    if (length <= kMaxNameLength) return;
    const size_t shown = std::min<size_t>(text.size(), 60);
    report(Code::NameTooLong, name,
           {std::string(text.substr(0, shown)) + (shown < text.size() ? "..." : ""), std::to_string(length)});
}

// ---- Looking around -------------------------------------------------------------------------------------------

/// True when only white space and comments separate the token from the end of an earlier line, and at the end of the file.
bool Parser::startsLine(TokenIndex i) const {
    if (i == 0 || i >= last_) return true;
    const std::string_view text = tree_.source->text();
    const uint32_t from = tokens_[i - 1].offset + tokens_[i - 1].length;
    for (uint32_t at = tokens_[i].offset; at > from; --at)
        if (text[at - 1] == '\n' || text[at - 1] == '\r') return true;
    return false;
}

/// Bytes between the start of the line and the token; only compared with others of its kind.
uint32_t Parser::columnOf(TokenIndex i) const {
    const std::string_view text = tree_.source->text();
    uint32_t at = tokens_[i].offset;
    constexpr uint32_t kFar = 500;
    while (at > 0 && tokens_[i].offset - at < kFar && text[at - 1] != '\n' && text[at - 1] != '\r')
        --at;
    return tokens_[i].offset - at;
}

/// The column of the first token in the line of a token.
uint32_t Parser::indentOf(TokenIndex i) const {
    for (uint32_t k = 0; k < kSearchTokens && !startsLine(i); ++k)
        --i;
    return columnOf(i);
}

/// Is this the beginning of an instruction, if a line begins here?
bool Parser::looksLikeStatement(TokenIndex i) const {
    if (!isName(kindAt(i))) return kindAt(i) == K::Percent;
    switch (kindAt(i + 1)) {
    case K::Assign:
    case K::Colon:
    case K::Semicolon:
    case K::Identifier:
    case K::NumLiteral:
    case K::StringLiteral:
    case K::Backslash:
    case K::LeftParen:
    case K::LeftBracket:
    case K::KwTrue:
    case K::KwFalse:
    case K::PlaceId:
    case K::PlaceArg: return true;
    case K::Dot:
    case K::LeftBrace: break;
    default: return false;
    }
    for (TokenIndex k = i + 2; k < i + kSearchTokens; ++k) {
        if (kindAt(k) == K::Assign) return true;
        if (kSearchEnd.has(kindAt(k))) return false;
    }
    return false;
}

/// Does the word really begin a block or a declaration, or is it part of a sentence?
bool Parser::opensBlock(TokenIndex i) const {
    TokenIndex found = 0;
    switch (kindAt(i)) {
    case K::KwIf: return findOnLine(i + 1, K::KwThen, found);
    case K::KwWhile: return findOnLine(i + 1, K::KwDo, found);
    case K::KwFor: return findOnLine(i + 1, K::KwFrom, found);
    case K::KwTest: return findOnLine(i + 1, K::KwCase, found);
    case K::KwProc: return isName(kindAt(i + 1)) && kindAt(i + 2) == K::LeftParen;
    case K::KwVar:
    case K::KwPers:
    case K::KwConst:
    case K::KwFunc: return isName(kindAt(i + 1)) && isName(kindAt(i + 2));
    default: return false;
    }
}

/// Looks for a word before the statement can end; an expression may go over several lines.
bool Parser::findOnLine(TokenIndex from, K wanted, TokenIndex& found) const {
    for (TokenIndex i = from; i < from + kSearchTokens; ++i) {
        if (kindAt(i) == wanted) {
            found = i;
            return true;
        }
        if (kSearchEnd.has(kindAt(i))) return false;
        if (startsLine(i) && looksLikeStatement(i)) return false;
    }
    return false;
}

/// ELSE in an IF, CASE in a TEST.
bool Parser::continuesBlock() const {
    constexpr TokenSet kBranches = {K::KwElse, K::KwElseif, K::KwCase};
    return (kBranches.has(kind()) || (kind() == K::KwDefault && peek() == K::Colon)) &&
           enclosing_.has(kind());
}

/// At a token that cannot continue the instruction: does another one begin here?
bool Parser::startsAfresh() const {
    if (kEndWords.has(kind()) || startsLine(pos_) || continuesBlock()) return true;
    return (isName(kind()) && peek() == K::Assign) || opensBlock(pos_);
}

/// A name that ends its line, followed by a line at the same margin that is an instruction of its own: the
/// semicolon is missing, although the second name could be read as an argument.
bool Parser::calleeEndsHere(TokenIndex callee, TokenIndex calleeEnd) const {
    const TokenIndex next = calleeEnd + 1;
    if (!isName(kindAt(next)) || !startsLine(next)) return false;
    if (!startsLine(callee)) { // "IF diStop = 1 Halt"
        TokenIndex head = callee;
        while (head > 0 && !startsLine(head))
            --head;
        if (kindAt(head) != K::KwIf || columnOf(next) > columnOf(head)) return false;
    }
    switch (kindAt(next + 1)) {
    case K::Identifier:
    case K::NumLiteral:
    case K::StringLiteral:
    case K::Colon: return true; // an argument cannot go on like this
    default: return columnOf(next) <= columnOf(callee) && looksLikeStatement(next);
    }
}

/// Names up to `last` that end their line and do not go on with an argument below. It does not matter where they begin:
/// formatting gives each instruction a line, but keeps the lines within one.
bool Parser::endsLine(TokenIndex last) const {
    const K next = kindAt(last + 1);
    return startsLine(last + 1) && (isName(next) || (!startsExpr(next) && next != K::Backslash));
}

/// "1,5" where a value ends.
bool Parser::reportDecimalComma() {
    if (kind() != K::Comma || kindAt(pos_ - 1) != K::NumLiteral || peek() != K::NumLiteral) return false;
    const SourceRange whole = tree_.range(pos_ - 1), decimals = tree_.range(pos_ + 1),
                      comma = tree_.range(pos_);
    if (whole.end != comma.begin || comma.end != decimals.begin) return false;
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    const std::string_view text = textOf(pos_ - 1);
    if (!std::all_of(text.begin(), text.end(), isDigit)) return false;
    const std::string_view shown = tree_.source->text().substr(whole.begin, decimals.end - whole.begin);
    fix(reportAt(Code::ForeignSpelling, {whole.begin, decimals.end},
                 {std::string(shown), "'.' before decimals"}),
        comma, ".");
    return true;
}

// ---- Finding the way back --------------------------------------------------------------------------------------

void Parser::endStatement(std::string_view expected) {
    if (accept(K::Semicolon)) {
        constexpr TokenSet kClosing = {K::RightParen, K::RightBracket, K::RightBrace};
        if (panic_ && kClosing.has(kind()) && !startsLine(pos_)) return syncStatement(); // "Abs(n;);"
        panic_ = false;
        return;
    }
    if (earlySemicolon_ == pos_ && !panic_) return;
    if (assignmentBelow()) return syncStatement();
    if (!panic_ && kind() != K::Error) {
        if (startsAfresh()) {
            diag::Diagnostic* missing =
                reportAt(Code::MissingSemicolon, endOf(pos_ - 1), {describe(pos_ - 1)});
            const bool twoWords = pos_ > 1 && kindAt(pos_ - 1) == K::Identifier &&
                                  kindAt(pos_ - 2) == K::Identifier && startsLine(pos_ - 2);
            fix(missing, endOf(pos_ - 1), ";");
            if (twoWords) ++unreadable_;
            if (twoWords) note(missing, pos_ - 2, "if this is a remark, put '!' before it");
            if (kLineWords.has(kind()) || looksLikeStatement(pos_)) return;
        } else if (kind() == K::Equal) {
            reportEqual();
        } else if (!reportDecimalComma()) {
            const std::string_view remedy = quoteInText() ? ": a '\"' inside a text is written twice" : "";
            diag::Diagnostic* d = reportAfterExpr(Code::UnexpectedToken,
                                                  {describe(pos_), fmt::format("{}{}", expected, remedy)});
            if ((kind() == K::Colon || kind() == K::Comma) && startsLine(pos_ + 1))
                fix(d, tree_.range(pos_), ";");
        }
    }
    syncStatement();
}

/// Behind the text "say " of `"say "hi" now"`: a word that stands between two texts without a space.
bool Parser::quoteInText() const {
    TokenIndex last = pos_;
    while (isName(kindAt(last)) && kindAt(last + 1) != K::StringLiteral && !startsLine(last + 1))
        ++last;
    return kindAt(pos_ - 1) == K::StringLiteral && kindAt(last + 1) == K::StringLiteral &&
           tree_.range(pos_ - 1).end == tree_.range(pos_).begin &&
           tree_.range(last).end == tree_.range(last + 1).begin;
}

/// Skips to the end of the instruction: its semicolon, or a line that begins like another one.
void Parser::syncStatement() {
    panic_ = false;
    for (; kind() != K::EndOfFile; take()) {
        if (accept(K::Semicolon)) return;
        if (kEndWords.has(kind()) || continuesBlock()) return;
        if (startsLine(pos_) && (kLineWords.has(kind()) || looksLikeStatement(pos_))) return;
        if (isTaskDirective(pos_) && startsLine(pos_)) return;
        // "FI a = b THEN" and the like: the block is there, only its head is broken.
        if ((kind() == K::KwThen || kind() == K::KwDo) && startsLine(pos_ + 1)) {
            headReported_ = pos_;
            return;
        }
    }
}

void Parser::expectWord(K word) {
    if (kind() == word || (!panic_ && kind() == K::Identifier && retagIfMeant(word))) {
        take();
        panic_ = false;
        if (kind() == K::Colon) takesColonAs("");
        return;
    }
    if (!panic_ && ((word == K::KwDo && kind() == K::KwThen) || (word == K::KwThen && kind() == K::KwDo))) {
        retag(pos_, pos_, word);
        take();
        return;
    }
    if (takesColonAs(tokenText(word))) return;
    const bool silent = panic_ || kind() == K::Error;
    TokenIndex found = 0;
    const bool later = findOnLine(pos_, word, found);
    if (!silent) {
        const std::string expected(tokenText(word));
        if (!later && startsLine(pos_)) {
            fix(reportAt(Code::MissingBlockWord, endOf(pos_ - 1), {describe(pos_), expected}),
                endOf(pos_ - 1), " " + expected);
        } else {
            report(Code::MissingBlockWord, pos_, {describe(pos_), expected});
        }
    }
    panic_ = false;
    if (later) {
        pos_ = found + 1;
    } else if (silent) {
        while (kind() != K::EndOfFile && !startsLine(pos_) && !kEndWords.has(kind()))
            if (take(), tokens_[pos_ - 1].kind == K::Semicolon) return;
    }
}

/// FROM, TO, DO, THEN in the head of a block that may be broken already: then nothing more is missed in it. Returns
/// false when the head ends without the word; an unfinished word at the end of the line is skipped.
bool Parser::expectHeadWord(K word, bool whole) {
    TokenIndex found = 0;
    if (whole) {
        whole = kind() == word || findOnLine(pos_, word, found);
        expectWord(word);
    } else if (findOnLine(pos_, word, found)) {
        pos_ = found + 1;
        panic_ = false;
        return true;
    }
    if (!whole && isName(kind()) && !startsLine(pos_) && (startsLine(pos_ + 1) || pos_ + 1 == last_)) take();
    panic_ = false;
    return whole;
}

/// An instruction on a line of its own, where something else should go on.
bool Parser::beginsInstruction(bool inCase) const {
    constexpr TokenSet kNoOperator = {K::Identifier, K::NumLiteral, K::StringLiteral, K::Assign, K::Colon};
    if (!startsLine(pos_) || !isName(kind())) return false;
    if (inCase && peek() == K::Colon) return false; // the last value of CASE, no label
    if (peek() == K::Dot || peek() == K::LeftBrace) return looksLikeStatement(pos_);
    return kNoOperator.has(peek()) && !(peek() == K::Identifier && startsLine(pos_ + 1));
}

TokenIndex Parser::missingName() {
    reportAt(Code::UnexpectedToken, endOf(pos_ - 1), {describe(pos_), "a name"});
    return kNoToken;
}

/// An expression in the head of a block. It may go over lines, but the next instruction is none.
Expr* Parser::parseHeadExpr(bool& whole, HeadPart part) {
    if (!whole) return errorExpr();
    if (beginsInstruction(part == HeadPart::CaseValue)) {
        reportAt(Code::UnexpectedToken, endOf(pos_ - 1), {describe(pos_), "an expression"});
        whole = false;
        return errorExpr();
    }
    const bool outer = std::exchange(inHead_, true);
    Expr* expr = part == HeadPart::Condition ? parseCondition() : parseExpr();
    inHead_ = outer;
    if (panic_ && (startsLine(pos_) || kind() == K::EndOfFile)) {
        whole = false;
        panic_ = false;
    }
    return expr;
}

void Parser::expectClosing(K closing, TokenIndex opening, bool inList) {
    if (accept(closing)) return;
    if (panic_ || assignmentBelow()) return;
    const std::string text(tokenText(closing));
    const std::string expected = inList ? fmt::format("',' or '{}'", text) : fmt::format("'{}'", text);
    diag::Diagnostic* diagnostic = nullptr;
    if (kind() == K::Error || foreignList_ > opening) { // what was reported in it may have taken the bracket
        foreignList_ = 0;
        panic_ = true;
        return;
    }
    if (startsLine(pos_)) {
        diagnostic = reportAt(Code::MissingClosing, endOf(pos_ - 1), {describe(pos_), expected});
    } else {
        diagnostic = reportAfterExpr(Code::MissingClosing, {describe(pos_), expected});
    }
    note(diagnostic, opening, fmt::format("the '{}' is here", textOf(opening)));
    panic_ = true;
}

/// Skips the rest of a routine that is nested too deep.
void Parser::abandonRoutine() {
    abandoned_ = true;
    panic_ = false;
    constexpr TokenSet kStop = {TokenKind::KwEndproc, TokenKind::KwEndfunc,   TokenKind::KwEndtrap,
                                TokenKind::KwProc,    TokenKind::KwFunc,      TokenKind::KwTrap,
                                TokenKind::KwModule,  TokenKind::KwEndmodule, TokenKind::EndOfFile};
    while (!kStop.has(kind()))
        take();
}

/// The same reserved word twice in a row.
void Parser::skipSecond(TokenIndex word) {
    if (kind() != kindAt(word) || pos_ != word + 1 || startsLine(pos_)) return;
    fix(report(Code::UnexpectedToken, pos_, {describe(pos_) + " twice", "a name"}),
        {tree_.range(word).end, tree_.range(pos_).end}, "");
    take();
}

/// A name, unless the next line begins an instruction.
TokenIndex Parser::expectNameHere() {
    if (!beginsInstruction()) return expectName();
    missing("a name");
    return kNoToken;
}

/// BREAK or CONTINUE names something, as older programs may. Where it cannot be the instruction it is that name, so that
/// one declaration gives one message.
void Parser::laterUsesAreNames(TokenIndex declared) {
    constexpr TokenSet kBeforeValue = {K::Assign, K::Comma, K::LeftParen, K::LeftBracket, K::LeftBrace,
                                       K::Plus,   K::Minus, K::Equal,     K::NotEqual,    K::KwNot,
                                       K::KwAnd,  K::KwOr,  K::KwXor,     K::KwReturn,    K::KwTest};
    const K word = kindAt(declared);
    readAs(declared, K::Identifier);
    for (TokenIndex i = declared + 1; i < last_; ++i)
        if (kindAt(i) == word && (kindAt(i + 1) != K::Semicolon || kBeforeValue.has(kindAt(i - 1))))
            readAs(i, K::Identifier);
}

/// A reserved word in the place of a name. One that data was declared with is meant as that name from then on.
TokenIndex Parser::takeReservedName() {
    if (reservedNames_.has(kind())) {
        readAs(pos_, K::Identifier);
    } else {
        diag::Diagnostic* diagnostic =
            report(Code::ReservedWordAsName, pos_, {std::string(tokenText(kind()))});
        if (kind() == K::KwBreak || kind() == K::KwContinue) {
            note(diagnostic, pos_,
                 fmt::format("an instruction since {}: programs of older controllers need another name",
                             reservedSince(kind())));
            laterUsesAreNames(pos_);
        }
    }
    return take();
}

/// Data with the name of a reserved word, which has been reported: its uses are no further mistakes.
void Parser::declareReserved(TokenIndex name) {
    reservedNames_ = reservedNames_ | TokenSet{kindAt(name)};
    readAs(name, K::Identifier);
}

TokenIndex Parser::expectName(bool newerKeywords) {
    if (isName(kind())) return take();
    if (kind() == K::NumLiteral && !startsLine(pos_)) { // "1st"
        report(Code::NameStart, pos_, {std::string(textOf(pos_).substr(0, 40))});
        return take();
    }
    if (newerKeywords && (kind() == K::KwBreak || kind() == K::KwContinue)) {
        readAs(pos_, K::Identifier); // RaiseToUser \Continue is older than the keyword
        return take();
    }
    constexpr TokenSet kAfterName = {K::Semicolon, K::Assign, K::LeftParen,
                                     K::LeftBrace, K::Comma,  K::RightParen};
    const bool canBeName = !kEndWords.has(kind()) || (kAfterName.has(peek()) && !startsLine(pos_ + 1));
    if (isKeyword(kind()) && canBeName && !startsLine(pos_)) return takeReservedName();
    if (startsLine(pos_) && pos_ > 0 && kind() != K::Error) {
        reportAt(Code::UnexpectedToken, endOf(pos_ - 1), {describe(pos_), "a name"});
        panic_ = true;
    } else {
        unexpected("a name");
    }
    return kNoToken;
}

} // namespace rapid::syntax
