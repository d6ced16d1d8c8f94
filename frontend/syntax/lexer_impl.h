#pragma once
// The lexer's class. lexer.cpp reads what RAPID has, lexer_foreign.cpp what other languages, word processors and damaged
// files have. The class of a character never depends on unreadable text before it: only reports are one a line.

#include "frontend/syntax/lexer.h"
#include "frontend/syntax/token_set.h"

#include <algorithm>
#include <array>

namespace rapid::syntax {

namespace say = diag::say;

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

inline constexpr std::array<CharClass, 256> kClasses = [] {
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
inline constexpr std::array<bool, 256> kWordChars = [] {
    std::array<bool, 256> table{};
    for (size_t c = 0; c < 128; ++c)
        table[c] = kClasses[c] == CharClass::Letter || kClasses[c] == CharClass::Digit || c == '_';
    return table;
}();

/// Second characters of operators that other languages have and RAPID has not.
inline constexpr std::array<bool, 256> kForeignSeconds = [] {
    std::array<bool, 256> table{};
    for (const char c : {'=', '|', '/', '*', '>', '+', '-', '<'})
        table[static_cast<size_t>(c)] = true;
    return table;
}();

inline unsigned char byteAt(const char* p) {
    return static_cast<unsigned char>(*p);
}
inline CharClass classAt(const char* p) {
    return kClasses[byteAt(p)];
}
inline bool isLineEnd(char c) {
    return c == '\n' || c == '\r';
}

/// One of the Latin-1 letters of the manual, À to ÿ without × and ÷, as UTF-8.
inline bool isLatin1Letter(const char* p) {
    if (byteAt(p) != 0xC3) return false;
    const unsigned char low = byteAt(p + 1);
    return low >= 0x80 && low <= 0xBF && low != 0x97 && low != 0xB7;
}

class Lexer {
  public:
    explicit Lexer(std::string_view text, bool wholeAggregates = false)
        : begin_(text.data()), end_(begin_ + text.size()), padding_(findPadding(begin_, end_)), p_(begin_),
          wholeAggregates_(wholeAggregates) {}

    LexResult run();
    /// The tokens from one offset to another one; `before` is the kind of the token before them.
    LexResult runPart(size_t from, size_t to, TokenKind before);

  private:
    /// Goes to the next token; false at the end of the text, which std::string terminates by a NUL.
    bool skipGap();
    /// The end mark of old DOS files and the NUL bytes that fill up a sector are the end of the text.
    static const char* findPadding(const char* begin, const char* end);

    TokenKind lastKind() const { return result_.tokens.empty() ? before_ : result_.tokens.back().kind; }
    void push(TokenKind kind, const char* start) {
        const auto length = std::min(static_cast<size_t>(p_ - start), kMaxTokenLength);
        Token& token = result_.tokens.emplace_back();
        token.offset = static_cast<uint32_t>(start - begin_);
        token.length = static_cast<uint32_t>(length) & kMaxTokenLength;
        token.kind = kind;
    }

    template <size_t N>
    void error(diag::Message<N> message, const char* from, const char* to, diag::MessageArgs<N> args,
               std::optional<std::string> fix = {}) {
        addError(message.code, from, to, {args, args + N}, std::move(fix));
    }
    void error(diag::Message<0> message, const char* from, const char* to) {
        addError(message.code, from, to, {}, {});
    }
    void addError(diag::Code code, const char* from, const char* to, std::vector<std::string> args,
                  std::optional<std::string> fix) {
        if (quiet_ || result_.errors.size() >= kMaxLexErrors) return;
        const SourceRange range{static_cast<uint32_t>(from - begin_), static_cast<uint32_t>(to - begin_)};
        result_.errors.push_back({code, range, std::move(args), std::move(fix)});
    }

    void skipLine() {
        while (p_ < end_ && !isLineEnd(*p_))
            ++p_;
    }

    std::string_view slice(const char* from, const char* to) const {
        return {from, static_cast<size_t>(to - from)};
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

    void skipContinuation() {
        while ((byteAt(p_) & 0xC0) == 0x80)
            ++p_;
    }

    void readToken();
    void readSingle(TokenKind kind);
    void readWord();
    void skipDigits();
    void readNumber();
    void readString();
    void reportEscape();
    /// The value of an assignment or of data; false, and nothing is read, where it is something else.
    bool readPlainAggregate();
    void noteShape(std::span<const PlainPiece> pieces);
    void readPunctuation();
    void readLess();
    /// `%%% VERSION:1 LANGUAGE:ENGLISH %%%` before a module.
    void readFileHeader();

    // ---- lexer_foreign.cpp: reported once, and read as it was meant

    /// `fix` may be a word: it keeps a distance from its neighbours.
    void foreign(const char* start, std::string_view expected, std::string_view fix);
    /// After the first character of a punctuation; false when the second one does not belong to it.
    bool readForeign(const char* start);
    /// Is the "!=" here an operator? It is, when an operand precedes it and code continues after it.
    bool isNotEqual() const;
    /// "!="
    void readNotEqual();
    /// At the beginning of a line or after an instruction, where only a comment can follow.
    bool mayBeRemark(const char* start) const;
    /// `&` `~` `^` and text in single quotes; false for other characters.
    bool readForeignCharacter();
    bool readSingleQuote();
    /// Quotation marks, dashes, spaces and punctuation of word processors and other keyboards; false for other characters.
    bool readTypographic();
    void readTypographicQuote();
    /// A word that begins with '_': a name, reported where it occurs first.
    void readUnderscoreName();
    /// One token for a run of unreadable characters, one report for a line of them.
    void readJunk();
    bool isJunk() const;
    /// Were unreadable characters reported between `start` and the beginning of its line?
    bool isReportedLine(const char* start);

    const char* begin_;
    const char* end_;
    const char* padding_; ///< white space and end marks from here on
    const char* p_;
    /// After unreadable characters that were reported, or further on in their line; null when the line has ended.
    const char* reported_ = nullptr;
    bool quiet_ = false; ///< the line has its report
    bool wholeAggregates_ = false;
    TokenKind before_ = TokenKind::EndOfFile; ///< kind of the token before the first one
    std::vector<std::string> badNames_;       ///< that begin with '_'
    LexResult result_;
};

} // namespace rapid::syntax
