#include "frontend/syntax/lexer.h"
#include "frontend/syntax/foreign_characters.h"
#include "frontend/syntax/plain_pieces.h"
#include "frontend/syntax/token_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace rapid::syntax {

namespace {

constexpr size_t kMaxStringBytes = 80; // manual 1.1.2

enum class CharClass : uint8_t {
    Junk,
    Space,
    Letter,
    Digit,
    Quote,
    Comment,
    Punctuation,
    Dot,
    Less,
    NonAscii
};

constexpr std::array<CharClass, 256> kClasses = [] {
    std::array<CharClass, 256> table{};
    for (int c = 'a'; c <= 'z'; ++c)
        table[static_cast<size_t>(c)] = CharClass::Letter;
    for (int c = 'A'; c <= 'Z'; ++c)
        table[static_cast<size_t>(c)] = CharClass::Letter;
    for (int c = '0'; c <= '9'; ++c)
        table[static_cast<size_t>(c)] = CharClass::Digit;
    for (const char c : {' ', '\t', '\n', '\r', '\f'})
        table[static_cast<size_t>(c)] = CharClass::Space;
    for (const char c :
         {';', ',', ':', '(', ')', '{', '}', '[', ']', '\\', '?', '|', '%', '+', '-', '*', '/', '=', '>'})
        table[static_cast<size_t>(c)] = CharClass::Punctuation;
    table['"'] = CharClass::Quote;
    table['!'] = CharClass::Comment;
    table['.'] = CharClass::Dot;
    table['<'] = CharClass::Less;
    for (size_t c = 0x80; c < 256; ++c)
        table[c] = CharClass::NonAscii;
    return table;
}();

/// Letters, digits and '_' of ASCII.
constexpr std::array<bool, 256> kWordChars = [] {
    std::array<bool, 256> table{};
    for (size_t c = 0; c < 128; ++c)
        table[c] = kClasses[c] == CharClass::Letter || kClasses[c] == CharClass::Digit || c == '_';
    return table;
}();

constexpr std::array<TokenKind, 128> kSingles = [] {
    std::array<TokenKind, 128> table{};
    table[';'] = TokenKind::Semicolon;
    table[','] = TokenKind::Comma;
    table[':'] = TokenKind::Colon;
    table['('] = TokenKind::LeftParen;
    table[')'] = TokenKind::RightParen;
    table['{'] = TokenKind::LeftBrace;
    table['}'] = TokenKind::RightBrace;
    table['['] = TokenKind::LeftBracket;
    table[']'] = TokenKind::RightBracket;
    table['\\'] = TokenKind::Backslash;
    table['?'] = TokenKind::Question;
    table['|'] = TokenKind::Bar;
    table['%'] = TokenKind::Percent;
    table['+'] = TokenKind::Plus;
    table['-'] = TokenKind::Minus;
    table['*'] = TokenKind::Star;
    table['/'] = TokenKind::Slash;
    table['='] = TokenKind::Equal;
    table['>'] = TokenKind::Greater;
    return table;
}();

/// Second characters of operators that other languages have and RAPID has not.
constexpr std::array<bool, 256> kForeignSeconds = [] {
    std::array<bool, 256> table{};
    for (const char c : {'=', '|', '/', '*', '>', '+', '-', '<'})
        table[static_cast<size_t>(c)] = true;
    return table;
}();

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

unsigned char byteAt(const char* p) {
    return static_cast<unsigned char>(*p);
}
CharClass classAt(const char* p) {
    return kClasses[byteAt(p)];
}
bool isDigit(char c) {
    return c >= '0' && c <= '9';
}
bool isHexDigit(char c) {
    return isDigit(c) || ((c | 32) >= 'a' && (c | 32) <= 'f');
}
bool isLineEnd(char c) {
    return c == '\n' || c == '\r';
}

/// One of the Latin-1 letters of the manual, À to ÿ without × and ÷, as UTF-8.
bool isLatin1Letter(const char* p) {
    if (byteAt(p) != 0xC3) return false;
    const unsigned char low = byteAt(p + 1);
    return low >= 0x80 && low <= 0xBF && low != 0x97 && low != 0xB7;
}

/// "'@'" or "U+00A0" for what a screen does not show.
class Lexer {
  public:
    explicit Lexer(std::string_view text, bool wholeAggregates = false)
        : begin_(text.data()), end_(begin_ + text.size()), padding_(findPadding(begin_, end_)), p_(begin_),
          wholeAggregates_(wholeAggregates) {}

    LexResult run() {
        result_.tokens.reserve(static_cast<size_t>(end_ - begin_) / 3 + 16);
        readFileHeader();
        while (skipGap())
            readToken();
        push(TokenKind::EndOfFile, end_);
        return std::move(result_);
    }

    /// The tokens from one offset to another one; `before` is the kind of the token before them.
    LexResult runPart(size_t from, size_t to, TokenKind before) {
        before_ = before;
        p_ = begin_ + from;
        while (skipGap() && p_ < begin_ + to)
            readToken();
        if (p_ == end_) push(TokenKind::EndOfFile, end_);
        return std::move(result_);
    }

  private:
    /// Goes to the next token; false at the end of the text, which std::string terminates by a NUL.
    bool skipGap() {
        const char* p = p_; // a local one stays in a register, here and in other loops over characters
        for (;;) {
            const CharClass c = classAt(p);
            if (c == CharClass::Space) {
                ++p;
            } else if (c == CharClass::Comment) {
                p_ = p;
                if (p[1] == '=' && isNotEqual()) break;
                do
                    ++p;
                while (p < end_ && !isLineEnd(*p));
            } else {
                break;
            }
        }
        p_ = p < padding_ ? p : end_;
        return p < padding_;
    }

    /// The end mark of old DOS files and the NUL bytes that fill up a sector are the end of the text.
    static const char* findPadding(const char* begin, const char* end) {
        while (end > begin && (end[-1] == 0x1A || end[-1] == 0 || classAt(end - 1) == CharClass::Space))
            --end;
        return end;
    }

    TokenKind lastKind() const { return result_.tokens.empty() ? before_ : result_.tokens.back().kind; }

    void push(TokenKind kind, const char* start) {
        const auto length = std::min(static_cast<size_t>(p_ - start), kMaxTokenLength);
        Token& token = result_.tokens.emplace_back();
        token.offset = static_cast<uint32_t>(start - begin_);
        token.length = static_cast<uint32_t>(length) & kMaxTokenLength;
        token.kind = kind;
    }

    void error(diag::Code code, const char* from, const char* to, std::vector<std::string> args = {},
               std::optional<std::string> fix = {}) {
        if (result_.errors.size() >= kMaxLexErrors) return;
        const SourceRange range{static_cast<uint32_t>(from - begin_), static_cast<uint32_t>(to - begin_)};
        result_.errors.push_back({code, range, std::move(args), std::move(fix)});
    }

    // ---- What other languages write (reported once, and read as it was meant)

    /// `fix` may be a word: it keeps a distance from its neighbours.
    void foreign(const char* start, std::string_view expected, std::string_view fix) {
        std::optional<std::string> edit;
        if (!fix.empty()) {
            const bool word = classAt(fix.data()) == CharClass::Letter;
            edit = (word && start > begin_ && classAt(start - 1) != CharClass::Space ? " " : "") +
                   std::string(fix) + (word && classAt(p_) != CharClass::Space ? " " : "");
        }
        error(diag::Code::ForeignSpelling, start, p_, {std::string(slice(start, p_)), std::string(expected)},
              std::move(edit));
    }

    void skipLine() {
        while (p_ < end_ && !isLineEnd(*p_))
            ++p_;
    }

    /// After the first character of a punctuation; false when the second one does not belong to it.
    bool readForeign(const char* start) {
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

    /// Is the "!=" here an operator? It is, when an operand stands before it and code goes on behind it.
    bool isNotEqual() const {
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

    /// At the beginning of a line or behind an instruction, where nothing but a comment goes on.
    bool mayBeRemark(const char* start) const {
        if (result_.tokens.empty() || result_.tokens.back().kind == TokenKind::Semicolon) return true;
        const Token& last = result_.tokens.back();
        return isKeyword(last.kind) || std::any_of(begin_ + last.offset + last.length, start, isLineEnd);
    }

    /// `&` `~` `^` and text in single quotes; false for other characters.
    bool readForeignCharacter() {
        const char* start = p_;
        if (*p_ == '&') {
            while (*p_ == '&')
                ++p_;
            const char* next = p_;
            while (*next == ' ')
                ++next;
            const bool joins = *next == '"' || (!result_.tokens.empty() &&
                                                result_.tokens.back().kind == TokenKind::StringLiteral);
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
        } else if (*p_ == '\'') {
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
            error(diag::Code::ForeignSpelling, start, p_,
                  {std::string(slice(start, p_).substr(0, 40)), "a string between '\"'"},
                  plain ? std::optional('"' + std::string(content) + '"') : std::nullopt);
            push(TokenKind::Error, start);
        } else {
            return false;
        }
        return true;
    }

    /// "!="
    void readNotEqual() {
        const char* start = p_;
        p_ += 2;
        foreign(start, "'<>'", "<>");
        push(TokenKind::NotEqual, start);
    }

    /// A word that begins with '_': a name, reported where it occurs first.
    void readUnderscoreName() {
        const char* start = p_;
        while (*p_ == '_')
            ++p_;
        skipWordChars();
        std::string name(slice(start, p_).substr(0, 40));
        if (std::find(badNames_.begin(), badNames_.end(), name) == badNames_.end()) {
            if (badNames_.size() < kMaxLexErrors) badNames_.push_back(name);
            error(diag::Code::NameStart, start, p_, {std::move(name)});
        }
        push(TokenKind::Identifier, start);
    }

    std::string_view slice(const char* from, const char* to) const {
        return {from, static_cast<size_t>(to - from)};
    }

    void readToken() {
        switch (classAt(p_)) {
        case CharClass::Letter: return readWord();
        case CharClass::Digit: return readNumber();
        case CharClass::Quote: return readString();
        case CharClass::Punctuation:
            if (*p_ == '%' && slice(p_, end_).starts_with("%%%") && lastKind() == TokenKind::KwEndmodule)
                return readFileHeader(); // files of several modules, put together from others
            return readPunctuation();
        case CharClass::Dot:
            if (isDigit(p_[1])) return readNumber();
            return readSingle(TokenKind::Dot);
        case CharClass::Less: return readLess();
        case CharClass::NonAscii:
            if (isLatin1Letter(p_)) return readWord();
            return readJunk();
        case CharClass::Comment: return readNotEqual();
        case CharClass::Junk:
        case CharClass::Space: return readJunk();
        }
    }

    void readSingle(TokenKind kind) {
        const char* start = p_++;
        push(kind, start);
    }

    void skipWordChars() {
        const char* p = p_;
        for (;;) {
            while (kWordChars[byteAt(p)])
                ++p;
            if (!isLatin1Letter(p)) break;
            p += 2;
        }
        p_ = p;
    }

    void readWord() {
        const char* start = p_;
        skipWordChars();
        const TokenKind kind = keywordKind(slice(start, p_));
        result_.hasModule |= kind == TokenKind::KwModule;
        push(kind, start);
    }

    void skipDigits() {
        const char* p = p_;
        while (isDigit(*p))
            ++p;
        p_ = p;
    }

    void readNumber() {
        const char* start = p_;
        const char prefix = static_cast<char>(p_[1] | 32);
        bool valid = true;
        if (*p_ == '0' && (prefix == 'x' || prefix == 'o' || prefix == 'b')) {
            const char* digits = p_ += 2;
            if (prefix == 'x')
                while (isHexDigit(*p_))
                    ++p_;
            if (prefix == 'o')
                while (*p_ >= '0' && *p_ <= '7')
                    ++p_;
            if (prefix == 'b')
                while (*p_ == '0' || *p_ == '1')
                    ++p_;
            valid = p_ > digits;
        } else {
            skipDigits();
            if (*p_ == '.') {
                ++p_;
                skipDigits();
            }
            if ((*p_ | 32) == 'e') {
                const char* digits = p_ + 1;
                if (*digits == '+' || *digits == '-') ++digits;
                if (isDigit(*digits)) {
                    p_ = digits;
                    skipDigits();
                }
            }
        }
        if (kWordChars[byteAt(p_)] || isLatin1Letter(p_) || *p_ == '.') { // glued to what follows
            valid = false;
            while (*p_ == '.' || kWordChars[byteAt(p_)] || isLatin1Letter(p_))
                ++p_, skipContinuation();
        }
        if (!valid) error(diag::Code::BadNumber, start, p_, {std::string(slice(start, p_).substr(0, 40))});
        push(TokenKind::NumLiteral, start);
    }

    void skipContinuation() {
        while ((byteAt(p_) & 0xC0) == 0x80)
            ++p_;
    }

    void readString() {
        const char* start = p_++;
        size_t saved = 0; // bytes that codes and doubled characters take beyond their value
        bool badEscape = false;
        for (;;) {
            const char c = *p_;
            if (c == '"') {
                if (p_[1] != '"') break;
                p_ += 2;
                ++saved;
            } else if (c == '\\') {
                if (p_[1] == '\\') {
                    p_ += 2;
                    ++saved;
                } else if (isHexDigit(p_[1]) && isHexDigit(p_[2])) {
                    p_ += 3;
                    saved += 2;
                } else {
                    if (!badEscape) reportEscape();
                    badEscape = true;
                    ++p_;
                }
            } else if (isLineEnd(c) || p_ >= end_) {
                error(diag::Code::UnterminatedString, start, p_);
                return push(TokenKind::Error, start);
            } else {
                ++p_;
            }
        }
        ++p_;
        const size_t bytes = static_cast<size_t>(p_ - start) - 2 - saved;
        if (bytes > kMaxStringBytes) error(diag::Code::StringTooLong, start, p_, {std::to_string(bytes)});
        push(TokenKind::StringLiteral, start);
    }

    void reportEscape() {
        const char* to = p_ + 1;
        if (to < end_ && !isLineEnd(*to) && *to != '"') {
            ++to;
            while ((byteAt(to) & 0xC0) == 0x80)
                ++to;
        }
        error(diag::Code::BadStringEscape, p_, to, {std::string(slice(p_, to))});
    }

    /// The value of an assignment or of data; false, and nothing is read, where it is something else.
    bool readPlainAggregate() {
        if (lastKind() != TokenKind::Assign) return false;
        const char* start = p_;
        PlainText<false> pieces(start);
        if (!skipPlainAggregate(pieces)) return false;
        const char* end = pieces.end();
        if (end - start > static_cast<std::ptrdiff_t>(kMaxTokenLength)) return false;
        const char* after = end;
        while (classAt(after) == CharClass::Space)
            ++after;
        if (*after != ';') return false;
        p_ = end;
        push(TokenKind::PlainAggregate, start);
        return true;
    }

    void readPunctuation() {
        const char* start = p_;
        if (*p_ == '[' && wholeAggregates_ && readPlainAggregate()) return;
        const char c = *p_++;
        TokenKind kind = kSingles[static_cast<size_t>(c)];
        if (*p_ == '=' && (c == ':' || c == '>')) {
            ++p_;
            kind = c == ':' ? TokenKind::Assign : TokenKind::GreaterEqual;
        } else if (kForeignSeconds[byteAt(p_)] && readForeign(start)) {
            return;
        }
        push(kind, start);
    }

    void readLess() {
        const char* start = p_++;
        if (*p_ == '=') return ++p_, push(TokenKind::LessEqual, start);
        if (*p_ == '>') return ++p_, push(TokenKind::NotEqual, start);
        // "<id>" cannot be two relations, because relations do not chain.
        const char* close = p_;
        while (close < p_ + 4 && classAt(close) == CharClass::Letter)
            ++close;
        if (*close == '>' && close - p_ >= 2) {
            const std::string_view text = slice(start, close + 1);
            for (auto k = static_cast<int>(TokenKind::PlaceTdn); k <= static_cast<int>(TokenKind::PlaceId);
                 ++k) {
                if (!equalsNoCase(text, tokenText(static_cast<TokenKind>(k)))) continue;
                p_ = close + 1;
                return push(static_cast<TokenKind>(k), start);
            }
        }
        push(TokenKind::Less, start);
    }

    /// Quotation marks, dashes, spaces and punctuation of word processors and other keyboards; false for other characters.
    bool readTypographic() {
        const char* start = p_;
        const std::string_view line = slice(start, std::find_if(start, end_, isLineEnd));
        const ForeignCharacter* found = foreignCharacter(line);
        if (!found) return false;
        p_ += found->utf8.size();
        if (found->meant != "\"") {
            const bool space = found->meant == " ";
            error(diag::Code::ForeignSpelling, start, p_,
                  {space ? showCharacter(found->utf8) : std::string(found->utf8),
                   space ? "a plain space" : fmt::format("'{}'", found->meant)},
                  std::string(found->meant));
            if (found->kind != TokenKind::Error) push(found->kind, start);
            return true;
        }
        const char* close = p_;
        const char* end = line.data() + line.size();
        while (close < end && quoteLength(slice(close, end)) == 0)
            ++close;
        const std::string_view content = slice(p_, close);
        const bool whole = close < end && content.find('\\') == std::string_view::npos;
        p_ = close + quoteLength(slice(close, end));
        error(diag::Code::ForeignSpelling, start, p_,
              {std::string(slice(start, p_).substr(0, 40)), "a string between '\"'"},
              whole ? std::optional('"' + std::string(content) + '"') : std::nullopt);
        push(TokenKind::Error, start);
        return true;
    }

    /// One token for a run of unreadable characters, one report for a line of them.
    void readJunk() {
        const char* start = p_;
        bool sameLine = lastJunk_ != nullptr;
        for (const char* q = lastJunk_; sameLine && q < start; ++q)
            sameLine = !isLineEnd(*q);
        if (*p_ == '_') return readUnderscoreName();
        if (!sameLine && (readForeignCharacter() || readTypographic())) return;
        while (p_ < end_ && isJunk()) {
            ++p_;
            skipContinuation();
        }
        if (!sameLine) error(diag::Code::UnexpectedCharacter, start, p_, {showCharacter(slice(start, p_))});
        lastJunk_ = p_;
        push(TokenKind::Error, start);
    }

    bool isJunk() const {
        const CharClass c = classAt(p_);
        return c == CharClass::Junk || (c == CharClass::NonAscii && !isLatin1Letter(p_));
    }

    /// `%%% VERSION:1 LANGUAGE:ENGLISH %%%` before a module.
    void readFileHeader() {
        if (!skipGap() || !slice(p_, end_).starts_with("%%%")) return;
        const char* start = p_;
        const std::string_view rest = slice(start, end_);
        const size_t close = rest.find("%%%", 3);
        if (close != std::string_view::npos) {
            p_ = start + close + 3;
        } else {
            p_ = start + 3;
            error(diag::Code::UnclosedFileHeader, start, p_);
            while (p_ < end_ && !equalsNoCase(slice(p_, end_).substr(0, 6), "MODULE"))
                ++p_;
        }
        push(TokenKind::FileHeader, start);
    }

    const char* begin_;
    const char* end_;
    const char* padding_; ///< white space and end marks from here on
    const char* p_;
    const char* lastJunk_ = nullptr;
    bool wholeAggregates_ = false;
    TokenKind before_ = TokenKind::EndOfFile; ///< kind of the token before the first one
    std::vector<std::string> badNames_;       ///< that begin with '_'
    LexResult result_;
};

} // namespace

LexResult lex(std::string_view text, bool wholeAggregates) {
    return Lexer(text, wholeAggregates).run();
}

LexResult lexPart(std::string_view text, size_t from, size_t to, TokenKind before) {
    return Lexer(text).runPart(from, to, before);
}

} // namespace rapid::syntax
