// Aggregates of nothing but literals: their elements are made when they are asked for (see AggregateExpr).

#include "frontend/syntax/grammar/parts.h"

#include <algorithm>

namespace rapid::syntax {

namespace {

/// The tokens of a whole aggregate, after all others of the tree; the place of the first.
TokenIndex appendTokens(SyntaxTree& tree, TokenIndex whole) {
    const SourceRange range = tree.range(whole);
    std::vector<Token> parts = lexPart(tree.source->text(), range.begin, range.end, TokenKind::Assign).tokens;
    parts.push_back({range.end, 0, TokenKind::EndOfFile});
    const size_t before = tree.tokens.size(), size = before + parts.size();
    if (size > tree.tokenRoom) {
        tree.tokenRoom = 2 * size;
        const std::span<Token> larger = tree.arena.makeArray<Token>(tree.tokenRoom);
        std::copy(tree.tokens.begin(), tree.tokens.end(), larger.begin());
        tree.tokens = larger;
    }
    tree.tokens = {tree.tokens.data(), size};
    std::copy(parts.begin(), parts.end(), tree.tokens.begin() + static_cast<std::ptrdiff_t>(before));
    return static_cast<TokenIndex>(before);
}

} // namespace

void AggregateExpr::makeElements() const {
    diag::Sink none; // there is nothing to report
    const ParseOptions options;
    const bool whole = tree_->tokens[first].kind == TokenKind::PlainAggregate;
    const TokenIndex opening = whole ? appendTokens(*tree_, first) : first;
    Parser(*tree_, none, options).expressions.parseElements(const_cast<AggregateExpr&>(*this), opening);
}

} // namespace rapid::syntax
