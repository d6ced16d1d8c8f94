#pragma once
// The tokens of a file and a place among them.

#include "frontend/syntax/grammar/token_groups.h"

namespace rapid::syntax {

/// A position in the tokens. Only this class moves it, and only this class changes the kind a token is read as.
class TokenCursor {
  public:
    explicit TokenCursor(SyntaxTree& tree)
        : tree_(tree), tokens_(tree.tokens.data()), last_(static_cast<TokenIndex>(tree.tokens.size()) - 1) {}

    TokenKind kind() const { return tokens_[pos_].kind; }
    TokenKind kindAt(TokenIndex i) const { return i < last_ ? tokens_[i].kind : TokenKind::EndOfFile; }
    TokenKind peek(uint32_t n = 1) const { return kindAt(pos_ + n); }
    TokenIndex take() { return pos_ < last_ ? pos_++ : pos_; }
    bool accept(TokenKind k) {
        if (kind() != k) return false;
        take();
        return true;
    }
    TokenIndex pos() const { return pos_; }
    void moveTo(TokenIndex i) { pos_ = i; }
    /// EndOfFile.
    TokenIndex lastToken() const { return last_; }
    const Token& tokenAt(TokenIndex i) const { return tokens_[i]; }
    /// Reads a token as something else from now on; relex() keeps no such tokens.
    void readAs(TokenIndex token, TokenKind kind) {
        tree_.tokens[token].kind = kind;
        tree_.retagged = true;
    }

    std::string_view textOf(TokenIndex i) const { return tree_.text(i); }
    SourceRange range(TokenIndex i) const { return tree_.range(i); }
    SourceRange range(const Node& node) const { return tree_.range(node); }
    SourceRange endOf(TokenIndex i) const { return {tree_.range(i).end, tree_.range(i).end}; }
    std::string_view sourceText() const { return tree_.source->text(); }
    SyntaxTree& tree() const { return tree_; }
    /// As messages show it: a keyword in capitals, anything else between quotes, cut when it is long.
    std::string describe(TokenIndex i) const;

    /// True when only white space and comments separate the token from the end of an earlier line, and at the end of the
    /// file.
    bool startsLine(TokenIndex i) const;
    /// Bytes between the start of the line and the token; only compared with others of its kind.
    uint32_t columnOf(TokenIndex i) const;
    /// The column of the first token in the line of a token.
    uint32_t indentOf(TokenIndex i) const;
    /// A word that is reserved only here and there, `upper` in capitals.
    bool isContextual(TokenIndex i, std::string_view upper) const {
        return kindAt(i) == TokenKind::Identifier && equalsNoCase(textOf(i), upper);
    }
    bool isTaskDirective(TokenIndex i) const {
        return isContextual(i, "TASK") &&
               (kindAt(i + 1) == TokenKind::KwVar || kindAt(i + 1) == TokenKind::KwPers);
    }

  private:
    SyntaxTree& tree_;
    const Token* tokens_;
    TokenIndex pos_ = 0;
    TokenIndex last_;
};

} // namespace rapid::syntax
