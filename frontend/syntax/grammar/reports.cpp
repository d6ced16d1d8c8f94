// One mistake, one message.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <algorithm>
#include <utility>

namespace rapid::syntax {

using diag::Code;

namespace {

/// Codes of words that could not be read: the next ones may be misread.
bool isUnread(Code code) {
    constexpr Code kAll[] = {say::UnexpectedToken.code,  say::MissingClosing.code,
                             say::MissingSemicolon.code, say::InstructionOutsideRoutine.code,
                             say::PartOfCallResult.code, say::BadNumber.code};
    return std::find(std::begin(kAll), std::end(kAll), code) != std::end(kAll);
}

/// Codes that only say that other words are expected.
bool isOnlyUnexpected(Code code) {
    constexpr Code kAll[] = {say::UnexpectedToken.code, say::ReservedWordAsName.code,
                             say::MissingClosing.code, say::MissingSemicolon.code,
                             say::InstructionOutsideRoutine.code};
    return std::find(std::begin(kAll), std::end(kAll), code) != std::end(kAll);
}

/// Codes of places where a name may have been torn in two.
bool isTornPlace(Code code) {
    return code == say::UnexpectedToken.code || code == say::MissingClosing.code ||
           code == say::MissingBlockWord.code;
}

} // namespace

diag::Diagnostic* Reports::reportCode(Code code, SourceRange range, std::span<const std::string> args) {
    if (panic_) return nullptr;
    if (code >= say::UnexpectedToken.code && code < say::MissingSemicolon.code) ++unreadable_;
    if (isConsequence(code, range) || followsFromLast(code, range)) return nullptr;
    if (range.begin == in_.tokenAt(in_.pos()).offset && isTornPlace(code))
        if (diag::Diagnostic* torn = torn_.reportTornName()) return torn;
    if (isUnread(code)) lastUnread_ = range.begin;
    if (++errors_ <= kMaxErrorsPerFile) {
        last_ = &sink_.report(code, in_.tree().source, range, args);
        lastCount_ = sink_.all().size();
        return last_;
    }
    if (errors_ == kMaxErrorsPerFile + 1)
        sink_.report(say::TooManyErrors, in_.tree().source, range, {"errors"});
    return nullptr;
}

/// Whether the lexer has said it: about this token, or about a string in the line that lacks one of its quotes.
bool Reports::isConsequence(Code code, SourceRange range) {
    if (code != say::UnexpectedToken.code && code != say::MissingClosing.code &&
        code != say::MissingSemicolon.code && code != say::MissingBlockWord.code)
        return false;
    return isMarked(Mark::AfterBadNumber, in_.pos()) || lexical_.covers(range);
}

/// Whether the words follow some that could not be read: in the same line, or in the next one when that begins
/// with the semicolon of the first.
bool Reports::followsFromLast(Code code, SourceRange range) const {
    constexpr uint32_t kNear = 4;
    if (lastUnread_ == kNowhere || range.begin < lastUnread_ || !isOnlyUnexpected(code)) return false;
    TokenIndex i = in_.pos();
    for (uint32_t k = 0; in_.tokenAt(i).offset > lastUnread_; ++k, --i)
        if (k == kNear || (in_.startsLine(i) && in_.kindAt(i) != TokenKind::Semicolon)) return false;
    return true;
}

diag::Diagnostic* Reports::reportAfterExpr(diag::Message<2> message, diag::MessageArgs<2> args) {
    if (in_.kind() != TokenKind::Question) return report(message, in_.pos(), args);
    if (!panic_) ++unreadable_;
    return report(say::ForeignSpelling, in_.pos(), {"?", "IF ... THEN ... ELSE ... ENDIF to choose a value"});
}

diag::Diagnostic* Reports::reportUnfinishedLine(TokenIndex last) {
    diag::Diagnostic* d = reportAt(say::MissingSemicolon, in_.endOf(last), {in_.describe(last)});
    if (d == nullptr) return nullptr;
    d->cause = diag::newLineCause();
    in_.tree().unfinishedLines.push_back({d->range.begin, static_cast<uint32_t>(d->cause)});
    return d;
}

/// Whether nothing has been reported since `last_`.
bool Reports::isLastReport() const {
    return last_ && lastCount_ == sink_.all().size();
}

bool Reports::joinLast(Code code, SourceRange place, std::string_view message) {
    if (panic_ || !isLastReport() || last_->code != code || place.begin < last_->range.end) return false;
    const uint32_t from = last_->range.end;
    if (in_.sourceText().substr(from, place.begin - from).find_first_of("\r\n") != std::string_view::npos)
        return false;
    if (!message.empty()) last_->notes.push_back({in_.tree().source, place, std::string(message)});
    return true;
}

bool Reports::joinLastEdit(Code code, SourceRange place, std::string replacement) {
    if (!isLastReport() || last_->fixes.empty()) return false;
    const std::string message = replacement.empty() ? "and without this" : "and '" + replacement + "' here";
    if (!joinLast(code, place, message)) return false;
    last_->fixes.front().edits.push_back({place, std::move(replacement)});
    return true;
}

void Reports::note(diag::Diagnostic* diagnostic, TokenIndex at, std::string message) {
    if (!diagnostic || at == kNoToken) return;
    diagnostic->notes.push_back({in_.tree().source, in_.range(at), std::move(message)});
}

void Reports::fix(diag::Diagnostic* diagnostic, SourceRange place, std::string replacement, bool certain) {
    if (!diagnostic) return;
    diagnostic->fix(place, std::move(replacement), certain);
    // The words after it are read as they were meant, unless a line just seems to end too early.
    if (certain && diagnostic->code != say::MissingSemicolon.code) forgetUnread();
}

void Reports::fixParentheses(diag::Diagnostic* diagnostic, const Node& operand) {
    if (!diagnostic || panic_) return;
    const SourceRange whole = in_.range(operand);
    diag::Diagnostic::Fix both{"put the operand in parentheses",
                               {{{whole.begin, whole.begin}, "("}, {{whole.end, whole.end}, ")"}}};
    diagnostic->fixes.push_back(std::move(both));
}

void Reports::unexpected(std::string_view expected) {
    if (in_.kind() != TokenKind::Error)
        report(say::UnexpectedToken, in_.pos(), {in_.describe(in_.pos()), std::string(expected)});
    endReported_ |= in_.kind() == TokenKind::EndOfFile;
    panic_ = true;
}

void Reports::missing(std::string_view expected) {
    if (!in_.startsLine(in_.pos()) || in_.pos() == 0 || in_.kind() == TokenKind::Error)
        return unexpected(expected);
    reportAt(say::UnexpectedToken, in_.endOf(in_.pos() - 1),
             {in_.describe(in_.pos()), std::string(expected)});
    endReported_ |= in_.kind() == TokenKind::EndOfFile;
    panic_ = true;
}

bool Reports::mayReportEnd() {
    if (in_.kind() == TokenKind::EndOfFile) return !std::exchange(endReported_, true);
    return std::exchange(endReportedAt_, in_.pos()) != in_.pos();
}

void Reports::reportTooDeep() {
    report(say::NestingTooDeep, in_.pos(), {std::to_string(kMaxDepth)});
    panic_ = true;
}

diag::Diagnostic* Reports::reportWord(SourceRange range, const std::string& whole, bool certain) {
    if (++errors_ > kMaxErrorsPerFile) return nullptr;
    const auto shown = std::string(in_.sourceText().substr(range.begin, range.end - range.begin));
    diag::Diagnostic& d = sink_.report(say::UnexpectedToken, in_.tree().source, range,
                                       {"'" + shown + "'", "'" + whole + "': a name is one word"});
    d.fix(range, whole, certain);
    lastUnread_ = range.begin;
    noteUnclear(range.begin);
    return &d;
}

void Reports::noteUnclear(uint32_t place) {
    const std::string_view text = in_.sourceText();
    uint32_t begin = place;
    while (begin > 0 && place - begin < SyntaxTree::kUnclearReach && text[begin - 1] != '\n' &&
           text[begin - 1] != '\r')
        --begin;
    in_.tree().unclearLines.push_back(begin);
}

} // namespace rapid::syntax
