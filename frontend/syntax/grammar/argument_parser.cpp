// Arguments of calls (manual 1.1.5).

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <algorithm>

namespace rapid::syntax {

std::span<Argument*> ExpressionParser::parseArguments(bool procedure) {
    const size_t bottom = args_.size();
    uint32_t height = 0;
    bool first = true;
    while (!panic()) {
        height_ = 0;
        if (!procedure && kind() == K::Semicolon && !first)
            recovery().repair({.place = Place::ListSeparator, .expected = K::RightParen});
        if (first && kind() == K::Slash) recovery().repair(Place::Argument);
        if (kind() == K::Backslash) {
            args_.push_back(parseOptionalArgument());
        } else if (kind() == K::Comma) {
            if (first) {
                if (!procedure || !signs().commaWasSemicolon()) missing("an argument");
                break;
            }
            if (procedure && peek() == K::Identifier && recovery().repair(Place::ArgumentComma)) break;
            take();
            if (kind() == K::Slash) recovery().repair(Place::Argument);
            args_.push_back(kind() == K::Backslash ? parseOptionalArgument()
                                                   : parseRequiredArgument(procedure));
        } else if (first &&
                   (startsExpression(kind()) || kind() == K::PlaceArg || ahead().isShownPosition())) {
            args_.push_back(parseRequiredArgument(procedure));
        } else {
            break;
        }
        height = std::max(height, height_);
        first = false;
    }
    height_ = height + 1;
    return drain(args_, bottom);
}

Argument* ExpressionParser::parseRequiredArgument(bool procedure) {
    auto* node = make<Argument>(NodeKind::Argument);
    if (kind() == K::PlaceArg) {
        if (!procedure) report(say::PlaceholderMisplaced, pos(), {"<ARG>", "<EXP> in a function call"});
        node->argKind = ArgKind::Placeholder;
        take();
        return finish(node);
    }
    if (isName(kind()) && peek() == K::Assign) {
        node->name = take();
        take();
    }
    if (ahead().isShownPosition()) {
        report(say::UnexpectedToken, pos(),
               {"'*'", "a position: manuals and the pendant show '*' for one that is not written out"});
        node->value = errorExpr();
        take();
        return finish(node);
    }
    node->value = parseExpression();
    if (!panic() && kind() == K::Assign && node->value->kind == NodeKind::Binary) { // "tool0/WObj:=wobj1"
        const auto& slash = as<BinaryExpr>(*node->value);
        if (slash.op == BinaryOp::Div && slash.right->kind == NodeKind::Name) {
            signs().reportSlash(slash.opToken);
            take();
            parseExpression();
            node->value = errorExpr();
        }
    }
    return finish(node);
}

Argument* ExpressionParser::parseOptionalArgument() {
    auto* node = make<Argument>(NodeKind::Argument);
    node->argKind = ArgKind::Optional;
    take();
    node->name = names().expectName(true);
    if (panic()) return finish(node);
    if (kind() == K::Colon && !startsLine(pos() + 1) && (startsExpression(peek()) || peek() == K::Equal))
        recovery().repair(Place::Assignment);
    if (kind() == K::Equal) {
        signs().reportEqual();
        take();
        node->value = parseExpression();
    } else if (accept(K::Assign)) {
        node->value = parseExpression();
    } else if (accept(K::Question)) {
        node->argKind = ArgKind::Conditional;
        if (isName(kind())) {
            height_ = 1;
            node->value = parseVariableOrCall(false);
        } else if (kind() == K::PlaceVar) {
            node->value = parsePrimary();
        } else {
            missing("the name of an optional parameter");
            node->value = errorExpr();
        }
    }
    return finish(node);
}

} // namespace rapid::syntax
