#pragma once
// Walks over the text of a plain aggregate (AggregateExpr), piece by piece: the one place that knows what is plain.

#include <cstdint>
#include <string_view>

namespace rapid::syntax {

enum class PlainPiece : uint8_t { Open, Close, Comma, Number, String, Bool, Other };

/// A NUL must follow the text. What a plain aggregate cannot hold is PlainPiece::Other, also what is only unusual.
/// `known`: somebody went over the text before, there is nothing unusual in it.
template <bool known> class PlainScanner {
  public:
    /// `at`: where the '[' is.
    explicit PlainScanner(const char* at) : p_(at) {}

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
    /// Behind the last piece.
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
        while (isDigit(*p))
            ++p;
        if (*p == '.') ++p;
        while (isDigit(*p))
            ++p;
        if (p == p_ || (p == p_ + 1 && *p_ == '.')) return PlainPiece::Other;
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

    /// Without codes of characters, and at most 80 bytes (manual 1.1.2).
    PlainPiece string() {
        constexpr int kMaxLength = 80;
        const char* p = p_ + 1;
        for (;; ++p) {
            if (*p == '"' && *++p != '"') break;
            if (*p == '\\' || *p == '\0' || *p == '\n' || *p == '\r') return PlainPiece::Other;
        }
        if (p > p_ + kMaxLength + 2) return PlainPiece::Other;
        p_ = p;
        return PlainPiece::String;
    }

    const char* p_;
    const char* begin_ = nullptr;
    bool negative_ = false;
};

/// The end of the plain aggregate whose '[' is at `at`, behind its ']'; null when what stands there is none.
inline const char* plainAggregateEnd(const char* at) {
    constexpr uint32_t kMaxPlainDepth = 32;
    PlainScanner<false> scanner(at);
    uint32_t depth = 0;
    bool wanted = true; // an element is
    for (;;) {
        switch (scanner.next()) {
        case PlainPiece::Open:
            if (!wanted || ++depth > kMaxPlainDepth) return nullptr;
            break;
        case PlainPiece::Close:
            if (wanted) return nullptr;
            if (--depth == 0) return scanner.end();
            break;
        case PlainPiece::Comma:
            if (wanted) return nullptr;
            wanted = true;
            break;
        case PlainPiece::Number:
        case PlainPiece::String:
        case PlainPiece::Bool:
            if (!wanted || depth == 0) return nullptr;
            wanted = false;
            break;
        case PlainPiece::Other: return nullptr;
        }
    }
}

} // namespace rapid::syntax
