// Expressions (manual 1.3.4 to 1.3.6).

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"
#include "frontend/syntax/plain_pieces.h"

#include <algorithm>
#include <array>

namespace rapid::syntax {

namespace {

// Precedence of binary operators (manual 1.3.6): 1 OR XOR, 2 AND, 3 relations, 4 + -, 5 * / DIV MOD.
constexpr int kTermLevel = 2;
constexpr int kRelationLevel = 3;
constexpr int kSumLevel = 4;
constexpr int kProductLevel = 5;

struct Operator {
    uint8_t precedence = 0;
    BinaryOp op = BinaryOp::Add;
};

constexpr auto kOperators = [] {
    std::array<Operator, 128> table{};
    const auto set = [&](TokenKind kind, int precedence, BinaryOp op) {
        table[static_cast<size_t>(kind)] = {static_cast<uint8_t>(precedence), op};
    };
    set(TokenKind::KwOr, 1, BinaryOp::Or);
    set(TokenKind::KwXor, 1, BinaryOp::Xor);
    set(TokenKind::KwAnd, kTermLevel, BinaryOp::And);
    set(TokenKind::Less, kRelationLevel, BinaryOp::Lt);
    set(TokenKind::LessEqual, kRelationLevel, BinaryOp::Le);
    set(TokenKind::Equal, kRelationLevel, BinaryOp::Eq);
    set(TokenKind::NotEqual, kRelationLevel, BinaryOp::Ne);
    set(TokenKind::Greater, kRelationLevel, BinaryOp::Gt);
    set(TokenKind::GreaterEqual, kRelationLevel, BinaryOp::Ge);
    set(TokenKind::Plus, kSumLevel, BinaryOp::Add);
    set(TokenKind::Minus, kSumLevel, BinaryOp::Sub);
    set(TokenKind::Star, kProductLevel, BinaryOp::Mul);
    set(TokenKind::Slash, kProductLevel, BinaryOp::Div);
    set(TokenKind::KwDiv, kProductLevel, BinaryOp::IntDiv);
    set(TokenKind::KwMod, kProductLevel, BinaryOp::Mod);
    return table;
}();

Operator operatorOf(TokenKind kind) {
    return kOperators[static_cast<size_t>(kind)];
}

} // namespace

Expr* ExpressionParser::parseBinary(int minPrecedence) {
    Expr* left;
    if (kind() == K::KwNot) {
        left = parseNot(minPrecedence);
    } else if (kind() == K::Plus || kind() == K::Minus) {
        left = parseSigned(minPrecedence);
    } else {
        left = parsePrimary();
    }
    for (;;) {
        const Operator op = operatorOf(kind());
        if (op.precedence == 0 && !panic()) {
            const bool unusual = kind() == K::Identifier || kind() == K::Percent;
            if (unusual && recovery().repair({.place = Place::Operator, .left = left})) {
                if (pos() == left->first) return parseBinary(minPrecedence); // NOT
                continue;
            }
        }
        if (op.precedence == 0 || op.precedence < minPrecedence || panic()) return left;
        if (block().inCaseValue && op.op == BinaryOp::Eq && ahead().isEqualForColon()) return left;
        const uint32_t leftHeight = height_;
        auto* node = makeExpr<BinaryExpr>(NodeKind::Binary);
        node->first = left->first;
        node->op = op.op;
        node->opToken = take();
        if (node->op == BinaryOp::Eq && textOf(node->opToken) == "==")
            fix(report(say::ForeignSpelling, node->opToken, {"==", "'='"}), range(node->opToken), "=");
        if (node->op == BinaryOp::Mul && kind() == K::Star && !panic()) {
            reportAt(say::ForeignSpelling, {range(node->opToken).begin, range(pos()).end},
                     {"**", "function Pow"});
            take();
        }
        node->left = left;
        node->right = parseBinary(op.precedence + 1);
        height_ = std::max(height_, leftHeight) + 1;
        left = finish(node);
        if (height_ > kMaxDepth) return tooDeepExpr();
        if (op.precedence == kRelationLevel && operatorOf(kind()).precedence == kRelationLevel)
            report(say::ChainedRelation, pos(), {std::string(textOf(pos()))});
    }
}

/// NOT at the start of a logical term covers the whole term, after AND one relation (manual 1.3.5, 1.3.6).
Expr* ExpressionParser::parseNot(int minPrecedence) {
    const Nest nest(nodes());
    if (!nest) return tooDeepExpr();
    diag::Diagnostic* misplaced = nullptr;
    size_t countBefore = 0;
    if (minPrecedence > kRelationLevel) {
        misplaced = report(say::NotInOperand, pos());
        countBefore = reports().count();
    }
    auto* node = makeExpr<UnaryExpr>(NodeKind::Unary);
    node->op = UnaryOp::Not;
    take();
    node->operand = parseBinary(std::max(minPrecedence, kTermLevel));
    ++height_;
    finish(node);
    if (misplaced && reports().count() == countBefore) reports().fixParentheses(misplaced, *node);
    return node;
}

/// A sign belongs to the whole first term and to nothing else (manual 1.3.6).
Expr* ExpressionParser::parseSigned(int minPrecedence) {
    const Nest nest(nodes());
    if (!nest) return tooDeepExpr();
    diag::Diagnostic* misplaced = nullptr;
    size_t countBefore = 0;
    if (minPrecedence > kSumLevel) {
        if (pos() == 0 || !isMarked(Mark::SignAfterOperator, pos() - 1))
            misplaced = report(say::SignAfterOperator, pos(), {std::string(textOf(pos()))});
        mark(Mark::SignAfterOperator);
        countBefore = reports().count();
    }
    auto* node = makeExpr<UnaryExpr>(NodeKind::Unary);
    node->op = kind() == K::Minus ? UnaryOp::Minus : UnaryOp::Plus;
    take();
    const bool another = kind() == K::Plus || kind() == K::Minus;
    if (misplaced && !another && node->op == UnaryOp::Plus && kindAt(pos() - 2) == K::Plus) { // "a" ++ "b"
        fix(misplaced, range(pos() - 1), "");
        misplaced = nullptr;
    }
    node->operand = parseBinary(std::max(minPrecedence, kProductLevel));
    ++height_;
    finish(node);
    if (misplaced && !another && reports().count() == countBefore) reports().fixParentheses(misplaced, *node);
    return node;
}

Expr* ExpressionParser::parsePrimary() {
    height_ = 1;
    switch (kind()) {
    case K::Identifier:
    case K::PlaceId: return parseVariableOrCall(true);
    case K::NumLiteral: return parseNumber();
    case K::StringLiteral: {
        auto* node = makeExpr<StringLiteralExpr>(NodeKind::StringLiteral);
        take();
        return finish(node);
    }
    case K::KwTrue:
    case K::KwFalse: {
        auto* node = makeExpr<BoolLiteralExpr>(NodeKind::BoolLiteral);
        node->value = kind() == K::KwTrue;
        take();
        return finish(node);
    }
    case K::PlaceExp:
    case K::PlaceVar: {
        auto* node = makeExpr<PlaceholderExpr>(NodeKind::PlaceholderExpr);
        take();
        return finish(node);
    }
    case K::LeftParen: return parseParenthesised();
    case K::LeftBracket: return parseAggregate();
    case K::PlainAggregate:
        if (Expr* whole = parsePlainAggregate()) return whole;
        break;
    case K::Error: {
        startPanic();
        auto* node = makeExpr<ErrorExpr>(NodeKind::ErrorExpr);
        take();
        return finish(node);
    }
    default: break;
    }
    if (kind() == K::LeftBrace && !block().inHead && startsExpression(peek()) &&
        !startsLine(pos())) // x := {1, 2}
        return parseForeignAggregate(pos(), ahead().closingOf(pos()));
    if (ahead().atReservedName() && names().isReadAsName(kind())) {
        readAs(pos(), K::Identifier);
        return parseVariableOrCall(true);
    }
    if (ahead().atReservedName()) {
        report(say::ReservedWordAsName, pos(), {std::string(tokenText(kind()))});
        auto* node = makeExpr<ErrorExpr>(NodeKind::ErrorExpr);
        take();
        return finish(node);
    }
    constexpr TokenSet kLogic = {K::KwAnd, K::KwOr, K::KwXor, K::KwNot};
    constexpr TokenSet kCompares = {K::Equal,     K::NotEqual, K::Less,
                                    K::LessEqual, K::Greater,  K::GreaterEqual};
    const bool halfCompared = pos() > 0 && kLogic.has(kindAt(pos() - 1)) && kCompares.has(kind());
    if (kind() == K::Semicolon && signs().operandAfterSemicolon()) return parsePrimary();
    missing(kind() == K::Percent ? "an expression: only procedures are called by a name in a string"
            : halfCompared ? "an expression: each comparison names both of its sides, as in n > 1 AND n < 5"
                           : "an expression");
    return errorExpr();
}

Expr* ExpressionParser::parseNumber() {
    auto* node = makeExpr<NumLiteralExpr>(NodeKind::NumLiteral);
    const TokenIndex token = take();
    const NumberValue number = numberValue(textOf(token));
    if (!number.valid)
        reportBadNumber(token);
    else if (!number.inRange)
        report(say::NumberTooLarge, token, {std::string(textOf(token).substr(0, 40))});
    node->value = number.value;
    return finish(node);
}

void ExpressionParser::reportBadNumber(TokenIndex token) {
    const std::string text(textOf(token).substr(0, 40));
    const char last = text.back(), prefix = static_cast<char>(text.size() > 1 ? text[1] | 32 : 0);
    const size_t letter = text.find_first_not_of("0123456789.");
    std::string expected;
    if (text[0] == '0' && prefix == 'x') {
        expected = "hexadecimal digits (0 to 9, A to F) after '0x'";
    } else if (text[0] == '0' && prefix == 'o') {
        expected = "octal digits (0 to 7) after '0o'";
    } else if (text[0] == '0' && prefix == 'b') {
        expected = "binary digits (0 and 1) after '0b'";
    } else if (text.find("..") != std::string::npos) {
        expected = "single numbers: there are no ranges";
    } else if (letter == std::string::npos) {
        expected = "a number with one decimal point";
    } else if (letter + 1 == text.size() && (last | 32) == 'e') {
        expected = "digits after the exponent 'E'";
        if ((kind() == K::Plus || kind() == K::Minus) && !startsExpression(peek())) take(); // "1E+"
    } else {
        expected = "a number without '" + text.substr(letter) + "' after it";
    }
    report(say::BadNumber, token, {text, expected});
    mark(Mark::AfterBadNumber);
}

/// A number, with a sign or without, that is a whole element of a list; null if something else begins here. It is what
/// parseExpression() makes of it, sooner: taught points consist of such numbers.
Expr* ExpressionParser::parseLoneNumber() {
    const bool minus = kind() == K::Minus;
    if (kindAt(pos() + minus) != K::NumLiteral) return nullptr;
    const K after = kindAt(pos() + minus + 1);
    if (after != K::Comma && after != K::RightBracket) return nullptr;
    height_ = 1;
    if (!minus) return parseNumber();
    const Nest nest(nodes());
    if (!nest) return tooDeepExpr();
    auto* node = makeExpr<UnaryExpr>(NodeKind::Unary);
    node->op = UnaryOp::Minus;
    take();
    node->operand = parseNumber();
    ++height_;
    return finish(node);
}

Expr* ExpressionParser::parseVariableOrCall(bool allowCall) {
    if (allowCall && peek() == K::LeftParen) return parsePostfix(parseFunctionCall());
    auto* node = makeExpr<NameExpr>(NodeKind::Name);
    node->name = take();
    finish(node);
    const bool brace = kind() == K::LeftBrace && !block().isBlockBrace();
    if (kind() != K::Dot && !brace && (kind() != K::LeftBracket || startsLine(pos()))) return node;
    return parsePostfix(node);
}

Expr* ExpressionParser::parseFunctionCall() {
    const Nest nest(nodes());
    if (!nest) return tooDeepExpr();
    auto* node = makeExpr<CallExpr>(NodeKind::Call);
    node->name = take();
    const TokenIndex opening = take();
    node->args = parseArguments(false);
    if (kind() == K::Semicolon && !panic() &&
        !node->args.empty()) { // "f(" and an assignment in the next line
        const Argument& last = *node->args.back();
        if (last.argKind == ArgKind::Required && last.name != kNoToken && startsLine(last.first)) {
            moveTo(last.first);
            missing("an argument or ')'");
            node->args = node->args.first(node->args.size() - 1);
        }
    }
    sync().expectClosing(K::RightParen, opening, true);
    return finish(node);
}

Expr* ExpressionParser::parsePostfix(Expr* base) {
    bool countBefore = false;
    for (;;) {
        const bool bracket = kind() == K::LeftBracket && base->kind == NodeKind::Name && !startsLine(pos());
        if ((kind() != K::LeftBrace && kind() != K::Dot && !bracket) || panic() || block().isBlockBrace())
            return base;
        if (base->kind == NodeKind::Call && kind() == K::Dot && startsLine(pos() + 1)) {
            fix(report(say::UnexpectedToken, pos(), {"'.'", "';'"}), range(pos()), ";");
            readAs(pos(), K::Semicolon);
            return base;
        }
        if (base->kind == NodeKind::Call && !countBefore) {
            report(say::PartOfCallResult, pos(), {std::string(textOf(pos()))});
            countBefore = true;
        }
        const uint32_t baseHeight = height_;
        bool partIndexed = false;
        if (kind() == K::Dot) {
            auto* node = makeExpr<ComponentExpr>(NodeKind::Component);
            node->first = base->first;
            node->base = base;
            take();
            node->name = names().expectName();
            height_ = baseHeight + 1;
            base = finish(node);
        } else {
            const Nest nest(nodes());
            if (!nest) return tooDeepExpr();
            partIndexed = base->kind != NodeKind::Name;
            if (partIndexed && !countBefore) {
                report(say::IndexOnPart, pos());
                countBefore = true;
            }
            base = parseIndex(base);
            height_ = std::max(baseHeight, height_) + 1;
        }
        if (height_ > kMaxDepth) return tooDeepExpr();
        if (partIndexed) { // which type it has is not known
            auto* broken = makeExpr<ErrorExpr>(NodeKind::ErrorExpr);
            broken->first = base->first;
            base = finish(broken);
        }
    }
}

Expr* ExpressionParser::parseIndex(Expr* base) {
    if (kind() != K::LeftBrace && kCloseBrackets.has(peek())) { // "x() := 1", "f[)"
        const bool call = kind() == K::LeftBracket;
        signs().dropEmptyParentheses();
        if (!call) return base;
        auto* broken = makeExpr<ErrorExpr>(NodeKind::ErrorExpr);
        broken->first = base->first;
        return finish(broken);
    }
    auto* node = makeExpr<IndexExpr>(NodeKind::Index);
    node->first = base->first;
    node->base = base;
    const TokenIndex opening = pos();
    const K closing = kind() == K::LeftBrace ? K::RightBrace : ahead().closingOf(opening);
    const bool otherForm = kind() != K::LeftBrace;
    if (otherForm && closing == K::RightParen && ahead().hasOption(opening)) { // "NumToStr[1500, 1 \Exp)"
        fix(report(say::ForeignSpelling, opening,
                   {std::string(textOf(opening)), "'(' before the arguments of a function"}),
            range(opening), "(");
        readAs(opening, K::LeftParen);
        moveTo(base->first);
        return parseFunctionCall();
    }
    diag::Diagnostic* diagnostic = nullptr;
    if (otherForm)
        diagnostic = report(say::ForeignSpelling, pos(),
                            {std::string(textOf(pos())), closing == K::RightParen && kind() == K::LeftBracket
                                                             ? "'(' before the arguments of a function"
                                                             : "'{' before an index"});
    const size_t countBefore = reports().count();
    take();
    node->indices = parseExpressionList(closing, opening);
    if (diagnostic && !panic() && reports().count() == countBefore) fixBrackets(diagnostic, *node, opening);
    return finish(node);
}

/// After "name[...]": an array was indexed, or a function was called.
void ExpressionParser::fixBrackets(diag::Diagnostic* diagnostic, const IndexExpr& node, TokenIndex opening) {
    const SourceRange first = range(opening), last = range(pos() - 1);
    const bool called = kindAt(opening) == K::LeftBracket && kindAt(pos() - 1) == K::RightParen;
    constexpr size_t kMostDimensions = 3;
    const bool indexed = node.indices.size() <= kMostDimensions &&
                         std::all_of(node.indices.begin(), node.indices.end(),
                                     [&](const Expr* index) { return ahead().mayBeIndex(*index); });
    if (indexed) {
        const bool certain = !called && (node.base->kind != NodeKind::Name ||
                                         torn().isArrayOfFile(as<NameExpr>(*node.base).name));
        diagnostic->fixes.push_back(
            {"put the index between '{' and '}'", {{first, "{"}, {last, "}"}}, certain});
        return;
    }
    if (!called) diagnostic->message += ", or '(' before the arguments of a function";
    diagnostic->fixes.push_back(
        {"put the arguments between '(' and ')'", {{first, "("}, {last, ")"}}, false});
}

Expr* ExpressionParser::parseParenthesised() {
    const Nest nest(nodes());
    if (!nest) return tooDeepExpr();
    auto* node = makeExpr<ParenExpr>(NodeKind::Paren);
    const TokenIndex opening = take();
    const size_t errorsBefore = reports().errors();
    node->inner = parseExpression();
    TokenIndex closing = 0;
    if (kind() == K::Assign && !panic() && ahead().findOnLine(pos(), K::RightParen, closing))
        node->inner = parseMeantEqual(opening + 1, errorsBefore);
    ++height_;
    if ((kind() == K::Comma || kind() == K::Backslash) && !panic() && ahead().isDoubled(opening)) {
        dropDoubled(opening);
        return node->inner;
    }
    if (kind() == K::Comma && !panic()) {
        reports().mark(Mark::ForeignList, opening);
        return parseForeignAggregate(opening, ahead().closingOf(opening));
    }
    sync().expectClosing(K::RightParen, opening, false);
    return finish(node);
}

Expr* ExpressionParser::parseAggregate() {
    const Nest nest(nodes());
    if (!nest) return tooDeepExpr();
    auto* node = makeExpr<AggregateExpr>(NodeKind::Aggregate);
    const TokenIndex opening = take();
    node->setElements(parseExpressionList(K::RightBracket, opening));
    ++height_;
    return finish(node);
}

Expr* ExpressionParser::parsePlainAggregate() {
    TokenIndex last = pos();
    uint8_t shape = AggregateExpr::kNoShape;
    if (kind() == K::LeftBracket) {
        if (parser().lexical.hasBadNumbers()) return nullptr;
        PlainTokens<false> pieces(tree(), pos());
        if (!skipPlainAggregate(pieces, [](PlainPiece) {})) return nullptr;
        last = static_cast<TokenIndex>(pieces.end() - &tokenAt(0)) - 1;
    } else if (kind() == K::PlainAggregate) {
        shape = shapeAt(pos());
    } else {
        return nullptr;
    }
    if (kindAt(last + 1) != K::Semicolon) return nullptr;
    auto* node = makeExpr<AggregateExpr>(NodeKind::Aggregate);
    node->setPlain(tree(), shape);
    moveTo(last + 1);
    return finish(node);
}

uint8_t ExpressionParser::shapeAt(TokenIndex whole) {
    if (!lexed_) return AggregateExpr::kNoShape;
    const std::vector<WholeAggregate>& noted = lexed_->aggregates;
    while (nextAggregate_ < noted.size() && noted[nextAggregate_].token < whole)
        ++nextAggregate_;
    const bool found = nextAggregate_ < noted.size() && noted[nextAggregate_].token == whole;
    return found ? noted[nextAggregate_].shape : AggregateExpr::kNoShape;
}

void ExpressionParser::parseElements(AggregateExpr& plain, TokenIndex opening) {
    moveTo(opening + 1);
    plain.setElements(parseExpressionList(K::RightBracket, opening));
}

std::span<Expr*> ExpressionParser::parseExpressionList(K closing, TokenIndex opening) {
    const size_t bottom = nodes().exprs.size();
    uint32_t height = 0;
    do {
        Expr* number = parseLoneNumber();
        nodes().exprs.push_back(number ? number : parseExpression());
        height = std::max(height, height_);
        if (kind() == K::Semicolon) recovery().repair({.place = Place::ListSeparator, .expected = closing});
    } while (!panic() && accept(K::Comma));
    sync().expectClosing(closing, opening, true);
    height_ = height;
    return drain(nodes().exprs, bottom);
}

void ExpressionParser::dropDoubled(TokenIndex opening) {
    const std::string sign(textOf(opening));
    fix(report(say::UnexpectedToken, opening, {"a second '" + sign + "'", "an expression"}), range(opening),
        "");
}

/// `(1, 2, 3)` and `{1, 2, 3}` as a value, before or after its first member.
Expr* ExpressionParser::parseForeignAggregate(TokenIndex opening, K closing) {
    if (pos() == opening && ahead().isDoubled(opening)) {
        dropDoubled(take());
        return parseExpression();
    }
    auto* node = makeExpr<ErrorExpr>(NodeKind::ErrorExpr);
    node->first = opening;
    diag::Diagnostic* diagnostic =
        report(say::ForeignSpelling, opening,
               {std::string(textOf(opening)), "'[' around the values of a record or an array"});
    const size_t countBefore = reports().count();
    take();
    parseExpressionList(closing, opening);
    if (diagnostic && !panic() && reports().count() == countBefore)
        diagnostic->fixes.push_back({"put the values between '[' and ']'",
                                     {{range(opening), "["}, {range(pos() - 1), "]"}},
                                     kindAt(opening - 1) != K::LeftParen});
    height_ = 1;
    return finish(node);
}

Expr* ExpressionParser::parseCondition() {
    const TokenIndex start = pos();
    const size_t errorsBefore = reports().errors();
    Expr* condition = parseExpression();
    if (panic() || kind() != K::Assign) return condition;
    TokenIndex found = 0;
    if (!ahead().findOnLine(pos(), K::KwThen, found) && !ahead().findOnLine(pos(), K::KwDo, found) &&
        sync().assignmentBelow())
        return errorExpr();
    return parseMeantEqual(start, errorsBefore);
}

/// At ":=" where only "=" is possible: reads the expression at `start` once more, with the sign that was meant.
Expr* ExpressionParser::parseMeantEqual(TokenIndex start, size_t errorsBefore) {
    const bool once = reports().errors() == errorsBefore; // else its mistakes would be reported again
    fix(report(say::AssignmentInCondition, pos()), range(pos()), "=");
    if (once) {
        readAs(pos(), K::Equal);
        moveTo(start);
        return parseExpression();
    }
    take();
    parseExpression();
    return errorExpr();
}

Expr* ExpressionParser::errorExpr() {
    height_ = 1;
    return finish(makeExpr<ErrorExpr>(NodeKind::ErrorExpr));
}

Expr* ExpressionParser::tooDeepExpr() {
    reports().reportTooDeep();
    return errorExpr();
}

} // namespace rapid::syntax
