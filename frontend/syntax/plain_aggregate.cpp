// Aggregates of nothing but literals: their elements are made when somebody asks (see AggregateExpr).

#include "frontend/syntax/parser_impl.h"
#include "frontend/syntax/plain_pieces.h"

#include <algorithm>

namespace rapid::syntax {

/// A whole initial value `[...]` of literals; null, and nothing is read, if something else stands here.
Expr* Parser::parsePlainAggregate() {
    TokenIndex last = pos_;
    uint8_t shape = AggregateExpr::kNoShape;
    if (kind() == K::LeftBracket) {
        if (badNumbers_) return nullptr;
        PlainTokens<false> pieces(tree_, pos_);
        if (!skipPlainAggregate(pieces, [](PlainPiece) {})) return nullptr;
        last = static_cast<TokenIndex>(pieces.end() - tokens_) - 1;
    } else if (kind() == K::PlainAggregate) {
        shape = shapeAt(pos_);
    } else {
        return nullptr;
    }
    if (kindAt(last + 1) != K::Semicolon) return nullptr;
    auto* node = makeExpr<AggregateExpr>(NodeKind::Aggregate);
    node->setPlain(tree_, shape);
    pos_ = last + 1;
    return finish(node);
}

uint8_t Parser::shapeAt(TokenIndex whole) {
    if (!lexed_) return AggregateExpr::kNoShape;
    const std::vector<WholeAggregate>& noted = lexed_->aggregates;
    while (nextAggregate_ < noted.size() && noted[nextAggregate_].token < whole)
        ++nextAggregate_;
    const bool found = nextAggregate_ < noted.size() && noted[nextAggregate_].token == whole;
    return found ? noted[nextAggregate_].shape : AggregateExpr::kNoShape;
}

/// Reads a plain aggregate as any other one; `opening` is its '['.
void Parser::parseElements(AggregateExpr& plain, TokenIndex opening) {
    pos_ = opening + 1;
    plain.setElements(parseExprList(K::RightBracket, opening));
}

namespace {

/// The tokens of which a whole aggregate consists, behind all others of the tree; the place of the first.
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
    Parser(*tree_, none, options).parseElements(const_cast<AggregateExpr&>(*this), opening);
}

} // namespace rapid::syntax
