// What the lexer meets that is not RAPID: operators and comments of other languages, characters of word processors,
// unreadable bytes. Each is read as it was meant where that is clear (lexer_impl.h).

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/foreign_characters.h"
#include "frontend/syntax/lexer_impl.h"

#include <fmt/format.h>

namespace rapid::syntax {

namespace {

constexpr size_t kShown = 40; ///< bytes of a text that a message repeats

/// Operators of other languages, and what RAPID writes. No text of RAPID has these two characters side by side, but for
/// '<' when a placeholder begins with it.
struct ForeignOperator {
    std::string_view text;
    TokenKind kind;
    std::string_view expected;
    std::string_view fix; ///< empty: not certain
};
constexpr ForeignOperator kForeignOperators[] = {
    {"==", TokenKind::Equal, "'='", "="},
    {"||", TokenKind::KwOr, "OR", "OR"},
    {"->", TokenKind::Dot, "'.'", "."},
    {"=>", TokenKind::GreaterEqual, "'>='", ">="},
    {"=<", TokenKind::LessEqual, "'<='", "<="},
    {"><", TokenKind::NotEqual, "'<>'", "<>"},
    {"+=", TokenKind::Assign, "':=' and the whole sum", ""},
    {"-=", TokenKind::Assign, "':=' and the whole difference", ""},
    {"*=", TokenKind::Assign, "':=' and the whole product", ""},
    {"/=", TokenKind::Assign, "':=' and the whole quotient", ""},
};

} // namespace

void Lexer::foreign(const char* start, std::string_view expected, std::string_view fix) {
    std::optional<std::string> edit;
    if (!fix.empty()) {
        const bool word = classAt(fix.data()) == CharClass::Letter;
        edit = (word && start > begin_ && classAt(start - 1) != CharClass::Space ? " " : "") +
               std::string(fix) + (word && classAt(p_) != CharClass::Space ? " " : "");
    }
    error(say::ForeignSpelling, start, p_,
          {std::string(slice(start, p_).substr(0, kShown)), std::string(expected)}, std::move(edit));
}

bool Lexer::readForeign(const char* start) {
    const std::string_view two(start, 2);
    if (two == "//") {
        ++p_;
        foreign(start, "'!' before a comment", "!");
        skipLine();
        return true;
    }
    if (two == "/*") {
        const std::string_view line = slice(start, std::find_if(start, end_, isLineEnd));
        const size_t close = line.find("*/");
        p_ = close == std::string_view::npos ? start + line.size() : start + close + 2;
        foreign(start, "'!' before a comment", "");
        return true;
    }
    if (two == "++" || two == "--") {
        const char* next = p_ + 1;
        while (*next == ' ')
            ++next;
        if (*next != ';') return false;
        ++p_;
        foreign(start, two == "++" ? "instruction Incr" : "instruction Decr", "");
        push(TokenKind::Error, start);
        return true;
    }
    for (const ForeignOperator& op : kForeignOperators) {
        if (op.text != two) continue;
        if (two[1] == '<' && classAt(start + 2) == CharClass::Letter) continue; // a placeholder
        ++p_;
        foreign(start, op.expected, op.fix);
        push(op.kind, start);
        return true;
    }
    return false;
}

bool Lexer::isNotEqual() const {
    if (result_.tokens.empty() || p_[2] == '=' || isLineEnd(p_[2])) return false;
    constexpr TokenSet kOperandEnds = {
        TokenKind::Identifier, TokenKind::NumLiteral, TokenKind::StringLiteral, TokenKind::RightParen,
        TokenKind::RightBrace, TokenKind::KwTrue,     TokenKind::RightBracket,  TokenKind::KwFalse};
    const Token& previous = result_.tokens.back();
    const char* from = begin_ + previous.offset + previous.length;
    if (!kOperandEnds.has(previous.kind) || std::any_of(from, p_, isLineEnd)) return false;
    const std::string_view rest = slice(p_, std::find_if(p_, end_, isLineEnd));
    return rest.find(';') != std::string_view::npos || rest.find(" THEN") != std::string_view::npos ||
           rest.find(" DO") != std::string_view::npos;
}

void Lexer::readNotEqual() {
    const char* start = p_;
    p_ += 2;
    foreign(start, "'<>'", "<>");
    push(TokenKind::NotEqual, start);
}

bool Lexer::mayBeRemark(const char* start) const {
    if (result_.tokens.empty() || result_.tokens.back().kind == TokenKind::Semicolon) return true;
    const Token& last = result_.tokens.back();
    return isKeyword(last.kind) || std::any_of(begin_ + last.offset + last.length, start, isLineEnd);
}

bool Lexer::readForeignCharacter() {
    const char* start = p_;
    if (*p_ == '&') {
        while (*p_ == '&')
            ++p_;
        const char* next = p_;
        while (*next == ' ')
            ++next;
        const bool joins = *next == '"' || lastKind() == TokenKind::StringLiteral;
        foreign(start, joins ? "'+' between strings" : "AND", joins ? "+" : "AND");
        push(joins ? TokenKind::Plus : TokenKind::KwAnd, start);
    } else if (*p_ == '~') {
        ++p_;
        foreign(start, "NOT", "NOT");
        push(TokenKind::KwNot, start);
    } else if (*p_ == '#' && mayBeRemark(start)) {
        ++p_;
        foreign(start, "'!' before a comment", "!");
        skipLine();
    } else if (*p_ == '^') {
        ++p_;
        foreign(start, "function Pow", "");
        push(TokenKind::Error, start);
    } else {
        return *p_ == '\'' && readSingleQuote();
    }
    return true;
}

bool Lexer::readSingleQuote() {
    const char* start = p_;
    const char* close = p_ + 1;
    while (close < end_ && *close != '\'' && !isLineEnd(*close))
        ++close;
    if (*close != '\'') {
        if (!mayBeRemark(start)) return false;
        ++p_;
        foreign(start, "'!' before a comment", "!");
        skipLine();
        return true;
    }
    p_ = close + 1;
    const std::string_view content = slice(start + 1, close);
    const bool plain = content.find_first_of("\"\\") == std::string_view::npos;
    error(say::ForeignSpelling, start, p_,
          {std::string(slice(start, p_).substr(0, kShown)), "a string between '\"'"},
          plain ? std::optional('"' + std::string(content) + '"') : std::nullopt);
    push(TokenKind::Error, start);
    return true;
}

bool Lexer::readTypographic() {
    const char* start = p_;
    const auto found = [this](const char* at) { return foreignCharacter(slice(at, end_)); };
    const ForeignCharacter* first = found(p_);
    if (!first) return false;
    if (first->meant == "\"") {
        readTypographicQuote();
        return true;
    }
    const bool space = first->meant == " ";
    p_ += first->utf8.size();
    std::string meant(first->meant);
    while (space) { // web pages mix them with plain ones
        const char* next = p_;
        while (*next == ' ')
            ++next;
        const ForeignCharacter* more = found(next);
        if (!more || more->meant != " ") break;
        meant.append(static_cast<size_t>(next - p_) + 1, ' ');
        p_ = next + more->utf8.size();
    }
    error(say::ForeignSpelling, start, p_,
          {space ? showCharacter(first->utf8) : std::string(first->utf8),
           space ? "a plain space" : fmt::format("'{}'", first->meant)},
          std::move(meant));
    if (first->kind != TokenKind::Error) push(first->kind, start);
    return true;
}

void Lexer::readTypographicQuote() {
    const char* start = p_;
    const auto quoteAt = [this](const char* at) { return quoteLength(slice(at, end_)); };
    const char* content = start + quoteAt(start);
    const char* close = content;
    while (close < end_ && !isLineEnd(*close) && quoteAt(close) == 0)
        ++close;
    const std::string_view inside = slice(content, close);
    const bool closed = close < end_ && !isLineEnd(*close);
    const bool plain = closed && inside.find('\\') == std::string_view::npos;
    p_ = closed ? close + quoteAt(close) : close;
    error(say::ForeignSpelling, start, p_,
          {std::string(slice(start, p_).substr(0, kShown)), "a string between '\"'"},
          plain ? std::optional('"' + std::string(inside) + '"') : std::nullopt);
    push(TokenKind::Error, start);
}

void Lexer::readUnderscoreName() {
    const char* start = p_;
    while (*p_ == '_')
        ++p_;
    skipWordChars();
    std::string name(slice(start, p_).substr(0, kShown));
    if (std::find(badNames_.begin(), badNames_.end(), name) == badNames_.end()) {
        if (badNames_.size() < kMaxLexErrors) badNames_.push_back(name);
        error(say::NameStart, start, p_, {std::move(name)});
    }
    push(TokenKind::Identifier, start);
}

void Lexer::readJunk() {
    if (*p_ == '_') return readUnderscoreName();
    const char* start = p_;
    quiet_ = isReportedLine(start);
    if (!readForeignCharacter() && !readTypographic()) {
        while (p_ < end_ && isJunk()) {
            ++p_;
            skipContinuation();
            if (foreignCharacter(slice(p_, end_))) break;
        }
        if (!quiet_) error(say::UnexpectedCharacter, start, p_, {showCharacter(slice(start, p_))});
        reported_ = p_;
        push(TokenKind::Error, start);
    }
    quiet_ = false;
}

bool Lexer::isJunk() const {
    const CharClass c = classAt(p_);
    return c == CharClass::Junk || (c == CharClass::NonAscii && !isLatin1Letter(p_));
}

bool Lexer::isReportedLine(const char* start) {
    while (reported_ && reported_ < start)
        reported_ = isLineEnd(*reported_) ? nullptr : reported_ + 1;
    return reported_ != nullptr;
}

} // namespace rapid::syntax
