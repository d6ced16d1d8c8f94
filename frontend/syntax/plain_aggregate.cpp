// Aggregates of nothing but literals, recognised by their tokens (see AggregateExpr).

#include "frontend/syntax/parser_impl.h"

namespace rapid::syntax {

namespace {

constexpr uint32_t kMaxPlainDepth = 32;

/// Digits, perhaps with a dot and a short exponent: valid and, by its length, below the greatest num. Anything else is
/// for numberValue() to judge.
bool isPlainNumber(std::string_view text) {
    constexpr size_t kMaxLength = 12;
    if (text.size() > kMaxLength) return false;
    size_t i = 0;
    while (i < text.size() && text[i] <= '9') // the lexer lets through digits, dots and letters only
        ++i;
    if (i == text.size()) return true;
    if ((text[i] | 0x20) != 'e') return false;
    std::string_view exponent = text.substr(i + 1);
    if (exponent.starts_with('-')) return exponent.size() <= 3;
    if (exponent.starts_with('+')) exponent.remove_prefix(1);
    return exponent.size() == 1 || (exponent.size() == 2 && exponent[0] <= '2');
}

} // namespace

/// Goes from the '[' at `at` behind its ']' and counts the nodes. False when there is anything but plain literals.
bool Parser::skipPlainAggregate(TokenIndex& at, uint32_t& count) const {
    uint32_t depth = 0;
    bool wanted = true; // an element is
    for (;; ++at) {
        const K k = tokens_[at].kind;
        if (k == K::Comma || k == K::RightBracket) {
            if (wanted) return false;
            wanted = k == K::Comma;
            if (k == K::RightBracket && --depth == 0) break;
            continue;
        }
        if (!wanted) return false;
        ++count;
        switch (k) {
        case K::LeftBracket:
            if (++depth > kMaxPlainDepth) return false;
            continue;
        case K::Minus:
            if (tokens_[at + 1].kind != K::NumLiteral) return false;
            continue;
        case K::NumLiteral:
            if (!isPlainNumber(textOf(at))) return false;
            break;
        case K::StringLiteral:
        case K::KwTrue:
        case K::KwFalse: break;
        default: return false;
        }
        wanted = false;
    }
    ++at;
    return true;
}

/// A whole initial value `[...]` of literals; null, and nothing is read, if something else stands here.
Expr* Parser::parsePlainAggregate() {
    TokenIndex end = pos_;
    uint32_t count = 0;
    if (kind() != K::LeftBracket || !skipPlainAggregate(end, count) || kindAt(end) != K::Semicolon)
        return nullptr;
    auto* node = make<AggregateExpr>(NodeKind::Aggregate);
    node->id = tree_.exprCount;
    node->setPlain(tree_);
    tree_.exprCount += count;
    pos_ = end;
    return finish(node);
}

/// Reads a plain aggregate as any other one; the nodes get the ids kept for them.
void Parser::parseElements(AggregateExpr& plain) {
    const uint32_t count = std::exchange(tree_.exprCount, plain.id);
    pos_ = plain.first;
    const Expr& read = *parseAggregate();
    tree_.exprCount = count;
    plain.setElements(as<AggregateExpr>(read).elements());
}

void AggregateExpr::makeElements() const {
    diag::Sink none; // there is nothing to report
    const ParseOptions options;
    Parser(*tree_, none, options).parseElements(const_cast<AggregateExpr&>(*this));
}

} // namespace rapid::syntax
