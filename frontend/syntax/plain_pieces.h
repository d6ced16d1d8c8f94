#pragma once
// Walks over a plain aggregate (AggregateExpr), piece by piece, as text or as tokens: the one place that knows what is plain.

#include "frontend/syntax/ast.h"
#include "frontend/syntax/limits.h"

#include <array>

namespace rapid::syntax {

enum class PlainPiece : uint8_t { Open, Close, Comma, Number, String, Bool, Other };

/// Over the text: for aggregates that are one token. A NUL must follow the text. Anything else, even if only unusual, is PlainPiece::Other.
/// `known`: somebody went over the text before, there is nothing unusual in it.
template <bool known> class PlainText {
  public:
    /// `at`: where the '[' is.
    explicit PlainText(const char* at) : p_(at) {}

    PlainPiece next() {
        skipGap();
        begin_ = p_;
        negative_ = *p_ == '-';
        switch (*p_) {
        case '[': return ++p_, PlainPiece::Open;
        case ']': return ++p_, PlainPiece::Close;
        case ',': return ++p_, PlainPiece::Comma;
        case '"': return string();
        case '-':
            ++p_;
            skipGap();
            begin_ = p_;
            return number();
        case 'T':
        case 't': return word("TRUE");
        case 'F':
        case 'f': return word("FALSE");
        default: return number();
        }
    }
    /// After the last piece.
    const char* end() const { return p_; }
    /// The last piece, without its sign.
    std::string_view text() const { return {begin_, static_cast<size_t>(p_ - begin_)}; }
    bool isNegative() const { return negative_; }

  private:
    static bool isDigit(char c) { return c >= '0' && c <= '9'; }
    /// It would belong to the number or the word before it.
    static bool isGlued(char c) {
        const auto letter = static_cast<char>(c | 0x20);
        return isDigit(c) || (letter >= 'a' && letter <= 'z') || c == '_' || c == '.' || c < 0;
    }

    void skipGap() {
        for (;;) {
            while (*p_ == ' ' || (*p_ >= '\t' && *p_ <= '\r' && *p_ != '\v'))
                ++p_;
            if (*p_ != '!' || p_[1] == '=') return;
            while (*p_ != '\0' && *p_ != '\n' && *p_ != '\r')
                ++p_;
        }
    }

    /// Digits, perhaps with a dot and a short exponent: by its length below the greatest num.
    PlainPiece number() {
        constexpr int kMaxLength = 12;
        const char* p = p_;
        if constexpr (known) {
            while (*p != ',' && *p != ']' && *p > ' ' && *p != '!')
                ++p;
            p_ = p;
            return PlainPiece::Number;
        }
        std::ptrdiff_t dots = 0;
        for (; isDigit(*p) || *p == '.'; ++p) // one loop: where it ends is hard to foresee
            dots += *p == '.';
        if (dots > 1 || p == p_ + dots) return PlainPiece::Other;
        if ((*p | 0x20) == 'e') {
            ++p;
            const bool small = *p == '-';
            if (*p == '+' || *p == '-') ++p;
            const char* digits = p;
            while (isDigit(*p))
                ++p;
            if (p == digits || p > digits + 2 || (!small && p == digits + 2 && *digits > '2'))
                return PlainPiece::Other;
        }
        if (isGlued(*p) || p > p_ + kMaxLength) return PlainPiece::Other;
        p_ = p;
        return PlainPiece::Number;
    }

    PlainPiece word(std::string_view upper) {
        for (const char c : upper)
            if ((*p_++ & ~0x20) != c) return PlainPiece::Other;
        return isGlued(*p_) ? PlainPiece::Other : PlainPiece::Bool;
    }

    /// Without codes of characters, and no longer than a string may be.
    PlainPiece string() {
        const char* p = p_ + 1;
        for (;; ++p) {
            if (*p == '"') {
                ++p;
                if (*p != '"') break;
            }
            if (*p == '\\' || *p == '\0' || *p == '\n' || *p == '\r') return PlainPiece::Other;
        }
        if (p > p_ + kStringCapacity + 2) return PlainPiece::Other;
        p_ = p;
        return PlainPiece::String;
    }

    const char* p_;
    const char* begin_ = nullptr;
    bool negative_ = false;
};

/// Over the tokens, where there are some: they need not be found again.
template <bool known> class PlainTokens {
  public:
    /// `at`: the '['.
    PlainTokens(const SyntaxTree& tree, TokenIndex at)
        : text_(tree.source->text().data()), at_(&tree.tokens[at]) {}

    PlainPiece next() {
        negative_ = at_->kind == TokenKind::Minus;
        at_ += negative_;
        last_ = at_++;
        const PlainPiece piece = kPieces[static_cast<size_t>(last_->kind)];
        if (piece == PlainPiece::Number) return known || isSmall(text()) ? piece : PlainPiece::Other;
        return negative_ ? PlainPiece::Other : piece;
    }
    /// After the last piece.
    const Token* end() const { return at_; }
    std::string_view text() const { return {text_ + last_->offset, last_->length}; }
    bool isNegative() const { return negative_; }

  private:
    /// A table and no switch: which token comes next is hard to foresee, and a wrong guess costs more than the rest.
    static constexpr std::array<PlainPiece, 256> kPieces = [] {
        std::array<PlainPiece, 256> table{};
        const auto set = [&](TokenKind kind, PlainPiece piece) { table[static_cast<size_t>(kind)] = piece; };
        table.fill(PlainPiece::Other);
        set(TokenKind::LeftBracket, PlainPiece::Open);
        set(TokenKind::RightBracket, PlainPiece::Close);
        set(TokenKind::Comma, PlainPiece::Comma);
        set(TokenKind::NumLiteral, PlainPiece::Number);
        set(TokenKind::StringLiteral, PlainPiece::String);
        set(TokenKind::KwTrue, PlainPiece::Bool);
        set(TokenKind::KwFalse, PlainPiece::Bool);
        return table;
    }();

    /// Digits, perhaps with a dot and a short exponent, of a number token: below the greatest num.
    static bool isSmall(std::string_view number) {
        constexpr size_t kMaxLength = 12;
        if (number.size() > kMaxLength) return false;
        size_t i = 0;
        while (i < number.size() && number[i] <= '9') // the lexer lets through digits, dots and letters only
            ++i;
        if (i == number.size()) return true;
        if ((number[i] | 0x20) != 'e') return false;
        std::string_view exponent = number.substr(i + 1);
        if (exponent.starts_with('-')) return exponent.size() <= 3;
        if (exponent.starts_with('+')) exponent.remove_prefix(1);
        return exponent.size() == 1 || (exponent.size() == 2 && exponent[0] <= '2');
    }

    const char* text_;
    const Token* at_;
    const Token* last_ = nullptr;
    bool negative_ = false;
};

/// Moves past the ']' of a plain aggregate; false when there is none. `note` is called for each piece.
template <class Pieces, class Note> bool skipPlainAggregate(Pieces& pieces, Note&& note) {
    constexpr uint32_t kMaxPlainDepth = 32;
    uint32_t depth = 0;
    bool wanted = true; // an element is
    for (;;) {
        const PlainPiece piece = pieces.next();
        note(piece);
        if (piece == PlainPiece::Comma || piece == PlainPiece::Close) {
            if (wanted) return false;
            wanted = piece == PlainPiece::Comma;
            if (!wanted && --depth == 0) return true;
        } else {
            if (!wanted || piece == PlainPiece::Other) return false;
            wanted = piece == PlainPiece::Open;
            if (wanted ? ++depth > kMaxPlainDepth : depth == 0) return false;
        }
    }
}

} // namespace rapid::syntax
