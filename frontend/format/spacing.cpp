#include "frontend/format/spacing.h"

#include "frontend/syntax/token_set.h"
#include "frontend/syntax/tree_walk.h"

namespace rapid::format {

using namespace rapid::syntax;
using K = TokenKind;

namespace {

constexpr TokenSet kNeverBefore = {K::Semicolon,  K::Comma, K::Colon,    K::RightParen, K::RightBracket,
                                   K::RightBrace, K::Dot,   K::Question, K::LeftBrace};
constexpr TokenSet kNeverAfter = {K::LeftParen, K::LeftBracket, K::LeftBrace,
                                  K::Dot,       K::Backslash,   K::Question};
constexpr TokenSet kOperators = {K::Plus,  K::Minus,    K::Star,         K::Slash,   K::Less, K::LessEqual,
                                 K::Equal, K::NotEqual, K::GreaterEqual, K::Greater, K::Bar};

struct Pair {
    const TokenPlan& left;
    const TokenPlan& right;
    K before;
    K after;
    bool wasSpaced;
};

bool choose(Spacing spacing, const Pair& pair) {
    return spacing == Spacing::Keep ? pair.wasSpaced : spacing == Spacing::Spaced;
}

bool afterComma(const FormatSettings& settings, const Pair& pair) {
    switch (settings.commas) {
    case CommaSpacing::Tight: return false;
    case CommaSpacing::Arguments: return !pair.left.has(kListComma);
    case CommaSpacing::Spaced: return true;
    case CommaSpacing::Keep: return pair.wasSpaced;
    }
    return false;
}

bool aroundAssign(const FormatSettings& settings, const Pair& pair) {
    const TokenPlan& assign = pair.after == K::Assign ? pair.right : pair.left;
    return !assign.has(kTightAssign) && choose(settings.assignments, pair);
}

bool isName(const Pair& pair, bool left) {
    const K kind = left ? pair.before : pair.after;
    const TokenPlan& plan = left ? pair.left : pair.right;
    return kind == K::Identifier || kind == K::PlaceId || plan.has(kNoKeyword);
}

bool decide(const FormatSettings& settings, const Pair& pair) {
    const bool afterSign = pair.left.has(kSign);
    if (kNeverBefore.has(pair.after) || kNeverAfter.has(pair.before) || afterSign) return false;
    if (pair.before == K::Comma) return afterComma(settings, pair);
    if (pair.before == K::Assign || pair.after == K::Assign) return aroundAssign(settings, pair);
    if (pair.left.has(kLateOpen) || pair.right.has(kLateClose)) return false;
    if (pair.after == K::Backslash) return choose(settings.optionalArguments, pair);
    if (pair.left.has(kLateClose) || pair.left.has(kCallName)) return true;
    const bool operatorLeft = kOperators.has(pair.before);
    const bool operatorRight = kOperators.has(pair.after) && !pair.right.has(kSign);
    if (operatorLeft || operatorRight) return choose(settings.operators, pair);
    if (pair.after == K::LeftParen) return !isName(pair, true); // NOT (, CASE (, but Abs(
    return true;
}

} // namespace

bool spaceBetween(const SyntaxTree& tree, const std::vector<TokenPlan>& plan, const FormatSettings& settings,
                  TokenIndex next) {
    const Pair pair{plan[next - 1], plan[next], tree.tokens[next - 1].kind, tree.tokens[next].kind,
                    !gapBefore(tree, next).empty()};
    return decide(settings, pair);
}

} // namespace rapid::format
