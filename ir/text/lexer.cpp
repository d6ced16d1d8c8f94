#include "ir/text/lexer.h"

#include <cctype>

namespace ir::text {
namespace {

bool isWordChar(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

} // namespace

void Lexer::skipBlanks() {
    while (peek() == ' ' || peek() == '\t' || peek() == '\r')
        ++at_;
    if (peek() != ';') return;
    while (at_ < source_.size() && peek() != '\n')
        ++at_;
}

Token Lexer::string(Token token, TokenKind kind) {
    token.kind = kind;
    ++at_;
    while (peek() != '"') {
        if (at_ >= source_.size() || peek() == '\n') {
            token.kind = TokenKind::Bad;
            token.text = "string without closing quote";
            return token;
        }
        if (peek() == '\\') {
            int high = hexDigit(peek(1)), low = high < 0 ? -1 : hexDigit(peek(2));
            if (low < 0) {
                token.kind = TokenKind::Bad;
                token.text = "'\\' in a string must be followed by two hex digits";
                return token;
            }
            token.text += static_cast<char>(high * 16 + low);
            at_ += 3;
            continue;
        }
        token.text += source_[at_++];
    }
    ++at_;
    return token;
}

Token Lexer::number(Token token) {
    token.kind = TokenKind::Number;
    size_t begin = at_++;
    while (isWordChar(peek()) || peek() == '.' ||
           ((peek() == '+' || peek() == '-') && (source_[at_ - 1] == 'e' || source_[at_ - 1] == 'E')))
        ++at_;
    token.text = source_.substr(begin, at_ - begin);
    return token;
}

Token Lexer::next() {
    skipBlanks();
    Token token;
    token.line = line_;
    token.column = static_cast<uint32_t>(at_ - lineStart_ + 1);
    if (at_ >= source_.size()) return token;
    char c = peek();
    if (c == '\n') {
        token.kind = TokenKind::NewLine;
        ++at_;
        ++line_;
        lineStart_ = at_;
        return token;
    }
    if (c == '"') return string(std::move(token), TokenKind::String);
    if (c == '@' && peek(1) == '"') {
        ++at_;
        return string(std::move(token), TokenKind::Name);
    }
    if (c == '%' && isWordChar(peek(1))) {
        size_t begin = ++at_;
        while (isWordChar(peek()))
            ++at_;
        token.kind = TokenKind::Value;
        token.text = source_.substr(begin, at_ - begin);
        return token;
    }
    // "-" is a sign before a digit or "inf".
    bool sign = c == '-' && (std::isdigit(static_cast<unsigned char>(peek(1))) || peek(1) == 'i');
    if (std::isdigit(static_cast<unsigned char>(c)) || sign) return number(std::move(token));
    if (isWordChar(c)) {
        size_t begin = at_;
        while (isWordChar(peek()))
            ++at_;
        token.kind = TokenKind::Word;
        token.text = source_.substr(begin, at_ - begin);
        return token;
    }
    token.kind = TokenKind::Punct;
    token.text = c;
    ++at_;
    return token;
}

} // namespace ir::text
