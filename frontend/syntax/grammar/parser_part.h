#pragma once
// The base of all parts of the parser.

#include "frontend/syntax/grammar/reports.h"
#include "frontend/syntax/grammar/token_cursor.h"
#include "frontend/syntax/grammar/tree_builder.h"
#include "frontend/syntax/lexer.h"
#include "frontend/syntax/parser.h"

#include <string>

namespace rapid::syntax {

struct Parser;
#define PARSER_PART(Type, name) class Type;
#include "frontend/syntax/grammar/parser_parts.def"

/// A part of the parser: short names for the tokens, the nodes and the reports, and the way to the other parts.
class ParserPart {
  public:
    explicit ParserPart(Parser& parser);
    ParserPart(const ParserPart&) = delete;
    ParserPart& operator=(const ParserPart&) = delete;

  protected:
    using K = TokenKind;

    // ---- Tokens (TokenCursor)
    K kind() const { return in_.kind(); }
    K kindAt(TokenIndex i) const { return in_.kindAt(i); }
    K peek(uint32_t n = 1) const { return in_.peek(n); }
    TokenIndex take() { return in_.take(); }
    bool accept(K k) { return in_.accept(k); }
    TokenIndex pos() const { return in_.pos(); }
    void moveTo(TokenIndex i) { in_.moveTo(i); }
    TokenIndex lastToken() const { return in_.lastToken(); }
    const Token& tokenAt(TokenIndex i) const { return in_.tokenAt(i); }
    void readAs(TokenIndex token, K kind) { in_.readAs(token, kind); }
    std::string_view textOf(TokenIndex i) const { return in_.textOf(i); }
    template <class Place> SourceRange range(const Place& place) const { return in_.range(place); }
    SourceRange endOf(TokenIndex i) const { return in_.endOf(i); }
    std::string_view sourceText() const { return in_.sourceText(); }
    SyntaxTree& tree() const { return in_.tree(); }
    std::string describe(TokenIndex i) const { return in_.describe(i); }
    bool startsLine(TokenIndex i) const { return in_.startsLine(i); }
    uint32_t columnOf(TokenIndex i) const { return in_.columnOf(i); }
    uint32_t indentOf(TokenIndex i) const { return in_.indentOf(i); }
    bool isContextual(TokenIndex i, std::string_view upper) const { return in_.isContextual(i, upper); }
    bool isTaskDirective(TokenIndex i) const { return in_.isTaskDirective(i); }

    // ---- Nodes (TreeBuilder)
    template <class T> T* make(NodeKind nodeKind) { return nodes_.make<T>(nodeKind); }
    template <class T> T* makeExpr(NodeKind nodeKind) { return nodes_.makeExpr<T>(nodeKind); }
    template <class T> T* finish(T* node) { return nodes_.finish(node); }
    template <class T> std::span<T> drain(std::vector<T>& stack, size_t mark) {
        return nodes_.drain(stack, mark);
    }

    // ---- Reports
    template <size_t N>
    diag::Diagnostic* reportAt(diag::Message<N> message, SourceRange range, diag::MessageArgs<N> args) {
        return reports_.reportAt(message, range, args);
    }
    diag::Diagnostic* reportAt(diag::Message<0> message, SourceRange range) {
        return reports_.reportAt(message, range);
    }
    template <size_t N>
    diag::Diagnostic* report(diag::Message<N> message, TokenIndex at, diag::MessageArgs<N> args) {
        return reports_.report(message, at, args);
    }
    diag::Diagnostic* report(diag::Message<0> message, TokenIndex at) { return reports_.report(message, at); }
    void note(diag::Diagnostic* diagnostic, TokenIndex at, std::string message) {
        reports_.note(diagnostic, at, std::move(message));
    }
    void fix(diag::Diagnostic* diagnostic, SourceRange place, std::string replacement, bool certain = true) {
        reports_.fix(diagnostic, place, std::move(replacement), certain);
    }
    void unexpected(std::string_view expected) { reports_.unexpected(expected); }
    void missing(std::string_view expected) { reports_.missing(expected); }
    bool panic() const { return reports_.panic(); }
    void startPanic() { reports_.setPanic(true); }
    void endPanic() { reports_.setPanic(false); }
    void mark(Mark cause) { reports_.mark(cause, pos()); }
    void mark(Mark cause, TokenIndex token) { reports_.mark(cause, token); }
    bool isMarked(Mark cause) const { return reports_.isMarked(cause, pos()); }
    bool isMarked(Mark cause, TokenIndex token) const { return reports_.isMarked(cause, token); }

    // ---- The others
    Parser& parser() const { return parser_; }
    TreeBuilder& nodes() const { return nodes_; }
    Reports& reports() const { return reports_; }
#define PARSER_PART(Type, name) Type& name() const;
#include "frontend/syntax/grammar/parser_parts.def"

  private:
    Parser& parser_;
    TokenCursor& in_;
    TreeBuilder& nodes_;
    Reports& reports_;
};

} // namespace rapid::syntax
