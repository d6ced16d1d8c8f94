// Expressions (manual 1.3.4 to 1.3.6).

#include "frontend/syntax/parser_impl.h"

#include <algorithm>
#include <array>

namespace rapid::syntax {

using diag::Code;

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

constexpr TokenSet kExprStart = {TokenKind::Identifier, TokenKind::NumLiteral,  TokenKind::StringLiteral,
                                 TokenKind::KwTrue,     TokenKind::KwFalse,     TokenKind::KwNot,
                                 TokenKind::Plus,       TokenKind::Minus,       TokenKind::LeftParen,
                                 TokenKind::PlaceId,    TokenKind::LeftBracket, TokenKind::PlaceExp,
                                 TokenKind::PlaceVar,   TokenKind::Error};

} // namespace

bool Parser::startsExpr(K k) {
    return kExprStart.has(k);
}

Expr* Parser::errorExpr() {
    height_ = 1;
    return finish(makeExpr<ErrorExpr>(NodeKind::ErrorExpr));
}

Expr* Parser::tooDeepExpr() {
    reportTooDeep();
    return errorExpr();
}

Expr* Parser::parseBinary(int minPrecedence) {
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
        if (op.precedence == 0 && !panic_) {
            if (kind() == K::Identifier && isMisspeltOperator(left)) {
                if (pos_ == left->first) return parseBinary(minPrecedence); // NOT
                continue;
            }
            if (kind() == K::Percent && takesPercentAsMod()) continue;
        }
        if (op.precedence == 0 || op.precedence < minPrecedence || panic_) return left;
        if (inCaseValue_ && op.op == BinaryOp::Eq && isEqualForColon()) return left;
        const uint32_t leftHeight = height_;
        auto* node = makeExpr<BinaryExpr>(NodeKind::Binary);
        node->first = left->first;
        node->op = op.op;
        node->opToken = take();
        if (node->op == BinaryOp::Eq && textOf(node->opToken) == "==")
            fix(report(Code::ForeignSpelling, node->opToken, {"==", "'='"}), tree_.range(node->opToken), "=");
        if (node->op == BinaryOp::Mul && kind() == K::Star && !panic_) {
            reportAt(Code::ForeignSpelling, {tree_.range(node->opToken).begin, tree_.range(pos_).end},
                     {"**", "function Pow"});
            take();
        }
        node->left = left;
        node->right = parseBinary(op.precedence + 1);
        height_ = std::max(height_, leftHeight) + 1;
        left = finish(node);
        if (height_ > kMaxDepth) return tooDeepExpr();
        if (op.precedence == kRelationLevel && operatorOf(kind()).precedence == kRelationLevel)
            report(Code::ChainedRelation, pos_, {std::string(textOf(pos_))});
    }
}

/// A misspelt operator at the current token, or a misspelt NOT before it; the parser then stands there.
bool Parser::isMisspeltOperator(const Expr* left) {
    if (left->kind == NodeKind::Name && !startsLine(pos_) && startsExpr(kind()) &&
        meant(left->first, K::KwNot) && isShuffled(left->first, K::KwNot)) {
        TokenIndex then = 0;
        if (inHead_ && blockOpening_ != kNoToken && kindAt(blockOpening_) == K::KwFor)
            return false; // a bound
        if (inCondition_ && !findOnLine(pos_, K::KwThen, then)) return false;
        pos_ = left->first;
        retag(pos_, pos_, K::KwNot);
        return true;
    }
    return retagOperator();
}

/// "5 % 3": not the name of a late-bound call, nor one that begins behind the condition of an IF.
bool Parser::takesPercentAsMod() {
    TokenIndex then = 0;
    if (inLateName_ || startsLine(pos_) || !startsExpr(peek())) return false;
    if (inCondition_ && !findOnLine(pos_, K::KwThen, then)) return false;
    const SourceRange sign = tree_.range(pos_);
    const bool before = tree_.range(pos_ - 1).end == sign.begin, after = tokens_[pos_ + 1].offset == sign.end;
    fix(report(Code::ForeignSpelling, pos_, {"%", "MOD"}), sign,
        std::string(before ? " " : "") + "MOD" + (after ? " " : ""));
    readAs(pos_, K::KwMod);
    return true;
}

/// A condition; an assignment in it was meant as a comparison.
Expr* Parser::parseCondition() {
    const TokenIndex start = pos_;
    const size_t errorsBefore = errors_;
    Expr* condition = parseExpr();
    if (panic_ || kind() != K::Assign) return condition;
    TokenIndex found = 0;
    if (!findOnLine(pos_, K::KwThen, found) && !findOnLine(pos_, K::KwDo, found) && assignmentBelow())
        return errorExpr();
    return parseMeantEqual(start, errorsBefore);
}

/// At ":=" where only "=" can stand: what begins at `start` once more, with the sign that was meant.
Expr* Parser::parseMeantEqual(TokenIndex start, size_t errorsBefore) {
    const bool once = errors_ == errorsBefore; // else its mistakes would be told again
    fix(report(Code::AssignmentInCondition, pos_), tree_.range(pos_), "=");
    if (once) {
        readAs(pos_, K::Equal);
        pos_ = start;
        return parseExpr();
    }
    take();
    parseExpr();
    return errorExpr();
}

/// NOT at the start of a logical term covers the whole term, after AND one relation (manual 1.3.5, 1.3.6).
Expr* Parser::parseNot(int minPrecedence) {
    const Nest nest(*this);
    if (!nest) return tooDeepExpr();
    diag::Diagnostic* misplaced = nullptr;
    size_t reported = 0;
    if (minPrecedence > kRelationLevel) {
        misplaced = report(Code::NotInOperand, pos_);
        reported = sink_.all().size();
    }
    auto* node = makeExpr<UnaryExpr>(NodeKind::Unary);
    node->op = UnaryOp::Not;
    take();
    node->operand = parseBinary(std::max(minPrecedence, kTermLevel));
    ++height_;
    finish(node);
    if (misplaced && sink_.all().size() == reported) fixParentheses(misplaced, *node);
    return node;
}

/// A sign belongs to the whole first term and to nothing else (manual 1.3.6).
Expr* Parser::parseSigned(int minPrecedence) {
    const Nest nest(*this);
    if (!nest) return tooDeepExpr();
    diag::Diagnostic* misplaced = nullptr;
    size_t reported = 0;
    if (minPrecedence > kSumLevel) {
        if (pos_ == 0 || signReported_ != pos_ - 1)
            misplaced = report(Code::SignAfterOperator, pos_, {std::string(textOf(pos_))});
        signReported_ = pos_;
        reported = sink_.all().size();
    }
    auto* node = makeExpr<UnaryExpr>(NodeKind::Unary);
    node->op = kind() == K::Minus ? UnaryOp::Minus : UnaryOp::Plus;
    take();
    const bool another = kind() == K::Plus || kind() == K::Minus;
    if (misplaced && !another && node->op == UnaryOp::Plus && kindAt(pos_ - 2) == K::Plus) { // "a" ++ "b"
        fix(misplaced, tree_.range(pos_ - 1), "");
        misplaced = nullptr;
    }
    node->operand = parseBinary(std::max(minPrecedence, kProductLevel));
    ++height_;
    finish(node);
    if (misplaced && !another && sink_.all().size() == reported) fixParentheses(misplaced, *node);
    return node;
}

Expr* Parser::parsePrimary() {
    height_ = 1;
    switch (kind()) {
    case K::Identifier:
    case K::PlaceId: return parseNamed(true);
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
    case K::LeftParen: return parseParen();
    case K::LeftBracket: return parseAggregate();
    case K::PlainAggregate:
        if (Expr* whole = parsePlainAggregate()) return whole;
        break;
    case K::Error: {
        panic_ = true;
        auto* node = makeExpr<ErrorExpr>(NodeKind::ErrorExpr);
        take();
        return finish(node);
    }
    default: break;
    }
    if (kind() == K::LeftBrace && !inHead_ && startsExpr(peek()) && !startsLine(pos_)) // x := {1, 2}
        return parseForeignAggregate(pos_, closingOf(pos_));
    if (atReservedName() && reservedNames_.has(kind())) {
        readAs(pos_, K::Identifier);
        return parseNamed(true);
    }
    if (atReservedName()) {
        report(Code::ReservedWordAsName, pos_, {std::string(tokenText(kind()))});
        auto* node = makeExpr<ErrorExpr>(NodeKind::ErrorExpr);
        take();
        return finish(node);
    }
    constexpr TokenSet kLogic = {K::KwAnd, K::KwOr, K::KwXor, K::KwNot};
    constexpr TokenSet kCompares = {K::Equal,     K::NotEqual, K::Less,
                                    K::LessEqual, K::Greater,  K::GreaterEqual};
    const bool halfCompared = pos_ > 0 && kLogic.has(kindAt(pos_ - 1)) && kCompares.has(kind());
    if (kind() == K::Semicolon && operandBehindSemicolon()) return parsePrimary();
    missing(kind() == K::Percent ? "an expression: only procedures are called by a name in a string"
            : halfCompared ? "an expression: each comparison names both of its sides, as in n > 1 AND n < 5"
                           : "an expression");
    return errorExpr();
}

/// "x := a + ;b": the operand of one word behind the semicolon ends the line. The parser then stands at it.
bool Parser::operandBehindSemicolon() {
    constexpr TokenSet kOperands = {K::Identifier, K::NumLiteral, K::StringLiteral, K::KwTrue, K::KwFalse};
    if (panic_ || startsLine(pos_) || !kOperands.has(peek()) || startsLine(pos_ + 1) || !startsLine(pos_ + 2))
        return false;
    if (diag::Diagnostic* d = report(Code::UnexpectedToken, pos_, {describe(pos_), "an expression"}))
        d->fixes.push_back({"write ';' behind it", {{tree_.range(pos_), ""}, {endOf(pos_ + 1), ";"}}});
    lastUnread_ = kNowhere;
    take();
    earlySemicolon_ = pos_ + 1;
    return true;
}

/// A reserved word where an operand stands, followed by what can follow an operand.
bool Parser::atReservedName() const {
    constexpr TokenSet kAfter = {K::Semicolon,    K::Comma,     K::RightParen, K::RightBrace, K::Dot,
                                 K::RightBracket, K::LeftBrace, K::Plus,       K::Minus,      K::Star,
                                 K::Slash,        K::Equal,     K::Less,       K::Greater,    K::LessEqual,
                                 K::GreaterEqual, K::NotEqual};
    return isKeyword(kind()) && !startsLine(pos_) && !startsLine(pos_ + 1) && kAfter.has(peek());
}

void Parser::reportBadNumber(TokenIndex token) {
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
        if ((kind() == K::Plus || kind() == K::Minus) && !startsExpr(peek())) take(); // "1E+"
    } else {
        expected = "a number without '" + text.substr(letter) + "' behind it";
    }
    report(Code::BadNumber, token, {text, expected});
    badNumber_ = pos_;
}

Expr* Parser::parseNumber() {
    auto* node = makeExpr<NumLiteralExpr>(NodeKind::NumLiteral);
    const TokenIndex token = take();
    const NumberValue number = numberValue(textOf(token));
    if (!number.valid)
        reportBadNumber(token);
    else if (!number.inRange)
        report(Code::NumberTooLarge, token, {std::string(textOf(token).substr(0, 40))});
    node->value = number.value;
    return finish(node);
}

Expr* Parser::parseParen() {
    const Nest nest(*this);
    if (!nest) return tooDeepExpr();
    auto* node = makeExpr<ParenExpr>(NodeKind::Paren);
    const TokenIndex opening = take();
    const size_t errorsBefore = errors_;
    node->inner = parseExpr();
    TokenIndex closing = 0;
    if (kind() == K::Assign && !panic_ && findOnLine(pos_, K::RightParen, closing))
        node->inner = parseMeantEqual(opening + 1, errorsBefore);
    ++height_;
    if (kind() == K::Comma && !panic_) {
        foreignList_ = opening;
        return parseForeignAggregate(opening, closingOf(opening));
    }
    expectClosing(K::RightParen, opening, false);
    return finish(node);
}

Expr* Parser::parseAggregate() {
    const Nest nest(*this);
    if (!nest) return tooDeepExpr();
    auto* node = makeExpr<AggregateExpr>(NodeKind::Aggregate);
    const TokenIndex opening = take();
    node->setElements(parseExprList(K::RightBracket, opening));
    ++height_;
    return finish(node);
}

/// A number, with a sign or without, that is a whole element of a list; null if something else begins here. It is what
/// parseExpr() makes of it, sooner: taught points consist of such numbers.
Expr* Parser::parseLoneNumber() {
    const bool minus = kind() == K::Minus;
    if (kindAt(pos_ + minus) != K::NumLiteral) return nullptr;
    const K after = kindAt(pos_ + minus + 1);
    if (after != K::Comma && after != K::RightBracket) return nullptr;
    height_ = 1;
    if (!minus) return parseNumber();
    const Nest nest(*this);
    if (!nest) return tooDeepExpr();
    auto* node = makeExpr<UnaryExpr>(NodeKind::Unary);
    node->op = UnaryOp::Minus;
    take();
    node->operand = parseNumber();
    ++height_;
    return finish(node);
}

/// `expr {, expr}` and the closing bracket; height_ is that of the highest one.
std::span<Expr*> Parser::parseExprList(K closing, TokenIndex opening) {
    const size_t mark = exprs_.size();
    uint32_t height = 0;
    do {
        Expr* number = parseLoneNumber();
        exprs_.push_back(number ? number : parseExpr());
        height = std::max(height, height_);
        if (kind() == K::Semicolon) takesSemicolonAsComma(closing);
    } while (!panic_ && accept(K::Comma));
    expectClosing(closing, opening, true);
    height_ = height;
    return drain(exprs_, mark);
}

Expr* Parser::parseNamed(bool allowCall) {
    if (allowCall && peek() == K::LeftParen) return parsePostfix(parseCall());
    auto* node = makeExpr<NameExpr>(NodeKind::Name);
    node->name = take();
    finish(node);
    const bool brace = kind() == K::LeftBrace && !isBlockBrace();
    if (kind() != K::Dot && !brace && (kind() != K::LeftBracket || startsLine(pos_))) return node;
    return parsePostfix(node);
}

Expr* Parser::parseCall() {
    const Nest nest(*this);
    if (!nest) return tooDeepExpr();
    auto* node = makeExpr<CallExpr>(NodeKind::Call);
    node->name = take();
    const TokenIndex opening = take();
    node->args = parseArguments(false);
    if (kind() == K::Semicolon && !panic_ && !node->args.empty()) { // "f(" and an assignment in the next line
        const Argument& last = *node->args.back();
        if (last.argKind == ArgKind::Required && last.name != kNoToken && startsLine(last.first)) {
            pos_ = last.first;
            missing("an argument or ')'");
            node->args = node->args.first(node->args.size() - 1);
        }
    }
    expectClosing(K::RightParen, opening, true);
    return finish(node);
}

/// Index and components. Only a whole variable takes an index, and a call result has no parts (manual 1.3.6).
Expr* Parser::parsePostfix(Expr* base) {
    bool reported = false;
    for (;;) {
        const bool bracket = kind() == K::LeftBracket && base->kind == NodeKind::Name && !startsLine(pos_);
        if ((kind() != K::LeftBrace && kind() != K::Dot && !bracket) || panic_ || isBlockBrace()) return base;
        if (base->kind == NodeKind::Call && kind() == K::Dot && startsLine(pos_ + 1)) {
            fix(report(Code::UnexpectedToken, pos_, {"'.'", "';'"}), tree_.range(pos_), ";");
            readAs(pos_, K::Semicolon);
            return base;
        }
        if (base->kind == NodeKind::Call && !reported) {
            report(Code::PartOfCallResult, pos_, {std::string(textOf(pos_))});
            reported = true;
        }
        const uint32_t baseHeight = height_;
        bool partIndexed = false;
        if (kind() == K::Dot) {
            auto* node = makeExpr<ComponentExpr>(NodeKind::Component);
            node->first = base->first;
            node->base = base;
            take();
            node->name = expectName();
            height_ = baseHeight + 1;
            base = finish(node);
        } else {
            const Nest nest(*this);
            if (!nest) return tooDeepExpr();
            partIndexed = base->kind != NodeKind::Name;
            if (partIndexed && !reported) {
                report(Code::IndexOnPart, pos_);
                reported = true;
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

/// `{1,2}`; other brackets are reported and read as if they were these.
Expr* Parser::parseIndex(Expr* base) {
    if (kind() != K::LeftBrace && kCloseBrackets.has(peek())) { // "x() := 1", "f[)"
        const bool call = kind() == K::LeftBracket;
        dropEmptyParentheses();
        if (!call) return base;
        auto* broken = makeExpr<ErrorExpr>(NodeKind::ErrorExpr);
        broken->first = base->first;
        return finish(broken);
    }
    auto* node = makeExpr<IndexExpr>(NodeKind::Index);
    node->first = base->first;
    node->base = base;
    const TokenIndex opening = pos_;
    const K closing = kind() == K::LeftBrace ? K::RightBrace : closingOf(opening);
    const bool foreign = kind() != K::LeftBrace;
    diag::Diagnostic* diagnostic = nullptr;
    if (foreign)
        diagnostic = report(Code::ForeignSpelling, pos_,
                            {std::string(textOf(pos_)), closing == K::RightParen && kind() == K::LeftBracket
                                                            ? "'(' before the arguments of a function"
                                                            : "'{' before an index"});
    const size_t reported = sink_.all().size();
    take();
    node->indices = parseExprList(closing, opening);
    if (diagnostic && !panic_ && sink_.all().size() == reported) fixBrackets(diagnostic, *node, opening);
    return finish(node);
}

/// What closes the bracket at `opening`, which another language writes: of its own kind, or the one RAPID has there.
TokenKind Parser::closingOf(TokenIndex opening) const {
    const K own = kindAt(opening) == K::LeftBracket ? K::RightBracket
                  : kindAt(opening) == K::LeftParen ? K::RightParen
                                                    : K::RightBrace;
    constexpr TokenIndex kSearch = 200;
    uint32_t depth = 0;
    for (TokenIndex i = opening; i < opening + kSearch && kindAt(i) != K::Semicolon; ++i) {
        if (kOpenBrackets.has(kindAt(i))) ++depth;
        if (kCloseBrackets.has(kindAt(i)) && --depth == 0) return kindAt(i);
    }
    return own;
}

/// "(a; b)": in a list that goes on in the same line to its closing bracket.
bool Parser::takesSemicolonAsComma(K closing) {
    if (panic_ || kind() != K::Semicolon || startsLine(pos_ + 1) ||
        (!startsExpr(peek()) && peek() != K::Backslash))
        return false;
    uint32_t depth = 0;
    for (TokenIndex i = pos_ + 1; i < pos_ + kLongLine && !startsLine(i); ++i) {
        const K k = kindAt(i);
        if (kOpenBrackets.has(k)) ++depth;
        if (k == K::Semicolon || (depth == 0 && k == K::Assign && kindAt(pos_ + 1) != K::Backslash))
            return false;
        if (!kCloseBrackets.has(k)) continue;
        if (depth == 0) {
            if (k != closing) return false;
            fix(report(Code::UnexpectedToken, pos_, {describe(pos_), "','"}), tree_.range(pos_), ",");
            readAs(pos_, K::Comma);
            return true;
        }
        --depth;
    }
    return false;
}

} // namespace rapid::syntax
