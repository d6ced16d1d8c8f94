#pragma once
// Tokens of the textual form. Line ends count.

#include <cstdint>
#include <string>
#include <string_view>

namespace ir::text {

enum class TokenKind : uint8_t {
    Word,  ///< module, f32, b12 ...
    Value, ///< %name; text without the sign
    Name,  ///< @"name"; text = the name
    String,
    Number,
    Punct, ///< one character
    NewLine,
    End,
    Bad ///< text says what is wrong
};

struct Token {
    TokenKind kind = TokenKind::End;
    std::string text;
    uint32_t line = 1, column = 1;
};

class Lexer {
  public:
    explicit Lexer(std::string_view source) : source_(source) {}
    Token next();

  private:
    void skipBlanks();
    char peek(size_t ahead = 0) const { return at_ + ahead < source_.size() ? source_[at_ + ahead] : '\0'; }
    Token string(Token token, TokenKind kind);
    Token number(Token token);

    std::string_view source_;
    size_t at_ = 0;
    size_t lineStart_ = 0;
    uint32_t line_ = 1;
};

} // namespace ir::text
