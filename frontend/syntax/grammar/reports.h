#pragma once
// Reports of the parser, and its memory of them: one mistake, one message.

#include "frontend/diag/diagnostic.h"
#include "frontend/syntax/grammar/lexical_mistakes.h"
#include "frontend/syntax/grammar/token_cursor.h"

#include <array>

namespace rapid::syntax {

class TornWords;
namespace say = diag::say;

/// Why a token was reported, or is not to be reported when the parser comes to it. The last token of each is remembered.
enum class Mark : uint8_t {
    SignAfterOperator,      ///< a sign after an operator; another one after it is the same mistake
    StrayEnd,               ///< a word for END that ends nothing
    BrokenHead,             ///< a THEN or DO whose IF, FOR or WHILE could not be read
    WrongEnd,               ///< an END word that closes a block of a different kind
    SwitchWithoutBackslash, ///< a parameter
    ForeignList,            ///< the bracket of a list that another language writes so
    RunTogether,            ///< the word of a declaration that what follows has run into
    EarlySemicolon,         ///< the place after an operand whose semicolon is before it
    AfterBadNumber,         ///< the place after a number that could not be read
    BlockOfCompactIf,       ///< an IF without THEN whose block is closed below; reported
    ColonGiven,             ///< an ELSE read as DEFAULT, reported together with its missing colon
    Count
};

/// Reports one diagnostic for each mistake. A mistake is a range of the text and a cause; what follows from it is not
/// reported:
/// 1. after a mistake nothing is, until the parser has found a place to continue from (panic);
/// 2. nothing about words that the lexer could not read, or in a line in which a '"' is missing;
/// 3. nothing that only says which words are expected, within a few words of others that could not be read;
/// 4. nothing at a token that is marked for the same cause.
/// A message about the same cause in the same line joins the last one as a note or an edit (joinLast).
class Reports {
  public:
    Reports(TokenCursor& in, diag::Sink& sink, LexicalMistakes& lexical, TornWords& torn)
        : in_(in), sink_(sink), lexical_(lexical), torn_(torn) {}

    /// Null when it follows from what was reported. The pointer is valid until the next report.
    template <size_t N>
    diag::Diagnostic* reportAt(diag::Message<N> message, SourceRange range, diag::MessageArgs<N> args) {
        return reportCode(message.code, range, args);
    }
    /// The instruction ends with this token, without its semicolon.
    diag::Diagnostic* reportUnfinishedLine(TokenIndex last);
    diag::Diagnostic* reportAt(diag::Message<0> message, SourceRange range) {
        return reportCode(message.code, range, {});
    }
    template <size_t N>
    diag::Diagnostic* report(diag::Message<N> message, TokenIndex at, diag::MessageArgs<N> args) {
        return reportCode(message.code, in_.range(at), args);
    }
    diag::Diagnostic* report(diag::Message<0> message, TokenIndex at) {
        return reportCode(message.code, in_.range(at), {});
    }
    /// The proposal of a recovery strategy: its code and arguments were checked when it was made.
    diag::Diagnostic* reportCode(diag::Code code, SourceRange range, std::span<const std::string> args);
    /// "found X, expected Y" where an expression has ended.
    diag::Diagnostic* reportAfterExpr(diag::Message<2> message, diag::MessageArgs<2> args);
    /// "found 'p Pick', expected 'pPick'"; the checker then reports nothing about that line.
    diag::Diagnostic* reportWord(SourceRange range, const std::string& whole, bool certain);
    /// Nesting deeper than kMaxDepth, and panic.
    void reportTooDeep();
    /// "found X, expected Y" at the current token, and panic.
    void unexpected(std::string_view expected);
    /// Reports at the end of the line before what it lacks; at a token within a line like unexpected().
    void missing(std::string_view expected);

    void note(diag::Diagnostic* diagnostic, TokenIndex at, std::string message);
    /// The edit that corrects the reported mistake; nothing when it was not shown.
    void fix(diag::Diagnostic* diagnostic, SourceRange place, std::string replacement, bool certain = true);
    /// `(operand)`
    void fixParentheses(diag::Diagnostic* diagnostic, const Node& operand);
    /// Part of what has just been reported in the same line, with this code: a note there. False when nothing was.
    bool joinLast(diag::Code code, SourceRange place, std::string_view message);
    /// The same, with one more edit to its fix.
    bool joinLastEdit(diag::Code code, SourceRange place, std::string replacement);
    /// The last report; read it after joinLast() only.
    diag::Diagnostic* last() const { return last_; }

    bool panic() const { return panic_; }
    void setPanic(bool panic) { panic_ = panic; }
    /// Errors of the file, those of the lexer included, also what is no longer shown.
    size_t errors() const { return errors_; }
    bool isFull() const { return errors_ > kMaxErrorsPerFile; }
    size_t countError() { return ++errors_; }
    /// Parts of instructions that could not be read, whether that was reported or not.
    size_t unreadable() const { return unreadable_; }
    void countUnreadable() { ++unreadable_; }
    /// All diagnostics of the sink.
    size_t count() const { return sink_.all().size(); }
    /// The words after the last ones that could not be read are read as they were meant.
    void forgetUnread() { lastUnread_ = kNowhere; }
    /// Nothing follows from what names and types in the line of this place seem to be.
    void noteUnclear(uint32_t place);
    /// Whether it is worth saying that a block is not closed before this token, or that the file ends too early: once, as one edit
    /// there closes everything.
    bool mayReportEnd();

    void mark(Mark cause, TokenIndex token) { marks_[static_cast<size_t>(cause)] = token; }
    void unmark(Mark cause) { mark(cause, kNoToken); }
    bool isMarked(Mark cause, TokenIndex token) const {
        return token != kNoToken && marks_[static_cast<size_t>(cause)] == token;
    }
    /// Whether a token after this one is marked.
    bool isMarkedAfter(Mark cause, TokenIndex token) const {
        const TokenIndex marked = marks_[static_cast<size_t>(cause)];
        return marked != kNoToken && marked > token;
    }

  private:
    bool isConsequence(diag::Code code, SourceRange range);
    bool followsFromLast(diag::Code code, SourceRange range) const;
    bool isLastReport() const;

    static constexpr uint32_t kNowhere = 0xFFFFFFFF;
    TokenCursor& in_;
    diag::Sink& sink_;
    LexicalMistakes& lexical_;
    TornWords& torn_;
    bool panic_ = false;
    bool endReported_ = false;            ///< that the file ends too early
    TokenIndex endReportedAt_ = kNoToken; ///< the token before which a block is not closed
    size_t errors_ = 0;
    size_t unreadable_ = 0;
    uint32_t lastUnread_ =
        kNowhere; ///< where the words begin that could not be read, the last that were reported
    diag::Diagnostic* last_ = nullptr; ///< good while lastCount_ says that nothing followed
    size_t lastCount_ = 0;             ///< of the sink
    std::array<TokenIndex, static_cast<size_t>(Mark::Count)> marks_ = [] {
        std::array<TokenIndex, static_cast<size_t>(Mark::Count)> none{};
        none.fill(kNoToken);
        return none;
    }();
};

} // namespace rapid::syntax
