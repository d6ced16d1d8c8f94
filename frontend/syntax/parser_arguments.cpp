// Arguments of calls (manual 1.1.5).

#include "frontend/syntax/parser_impl.h"

#include <algorithm>

namespace rapid::syntax {

using diag::Code;

/// The arguments of a call up to what cannot be one; sets height_ to that of the call.
std::span<Argument*> Parser::parseArguments(bool procedure) {
    const size_t mark = args_.size();
    uint32_t height = 0;
    bool first = true;
    while (!panic_) {
        height_ = 0;
        if (!procedure && kind() == K::Semicolon && !first) takesSemicolonAsComma(K::RightParen);
        if (first) takesSlashAsBackslash();
        if (kind() == K::Backslash) {
            args_.push_back(parseOptionalArgument());
        } else if (kind() == K::Comma) {
            if (first) {
                if (!procedure || !commaWasSemicolon()) missing("an argument");
                break;
            }
            if (procedure && peek() == K::Identifier && instructionAfterComma()) break;
            take();
            takesSlashAsBackslash();
            args_.push_back(kind() == K::Backslash ? parseOptionalArgument()
                                                   : parseRequiredArgument(procedure));
        } else if (first && (startsExpr(kind()) || kind() == K::PlaceArg || isShownPosition())) {
            args_.push_back(parseRequiredArgument(procedure));
        } else {
            break;
        }
        height = std::max(height, height_);
        first = false;
    }
    height_ = height + 1;
    return drain(args_, mark);
}

/// "MoveL *, v100, fine, tool0;"
bool Parser::isShownPosition() const {
    constexpr TokenSet kAfter = {K::Comma, K::Semicolon, K::RightParen, K::Backslash};
    return kind() == K::Star && kAfter.has(peek());
}

/// "ConfL/Off;" and "CRobT(/Tool:=tool1)": no argument begins with '/'.
void Parser::takesSlashAsBackslash() {
    constexpr TokenSet kAfterName = {K::Assign,     K::Semicolon, K::Comma,
                                     K::RightParen, K::Backslash, K::Question};
    if (kind() != K::Slash || !isName(peek()) || !kAfterName.has(peek(2))) return;
    reportSlash(pos_);
    readAs(pos_, K::Backslash);
}

void Parser::reportSlash(TokenIndex slash) {
    fix(report(Code::ForeignSpelling, slash, {"/", "'\\' before an optional argument"}), tree_.range(slash),
        "\\");
}

/// "MoveL p10; v100, fine, tool0;": the semicolon before the name was meant as a comma. No instruction begins with a name
/// and a comma.
bool Parser::commaWasSemicolon() {
    const TokenIndex semicolon = pos_ - 2;
    if (pos_ < 3 || kindAt(semicolon) != K::Semicolon || startsLine(pos_ - 1) || stmts_.empty()) return false;
    Stmt* before = stmts_.back();
    if (before->kind != NodeKind::CallStmt || before->last != semicolon) return false;
    fix(report(Code::UnexpectedToken, semicolon, {"';'", "','"}), tree_.range(semicolon), ",");
    before->broken = true; // the rest of its arguments stands here
    panic_ = true;
    return true;
}

/// At a comma that ends its line: what stands below is an instruction of its own, so ';' was meant.
bool Parser::instructionAfterComma() {
    constexpr TokenSet kNoArgument = {K::Identifier, K::NumLiteral, K::StringLiteral};
    if (!kNoArgument.has(peek(2)) || !startsLine(pos_ + 1) || startsLine(pos_ + 2)) return false;
    fix(report(Code::UnexpectedToken, pos_, {"','", "';'"}), tree_.range(pos_), ";");
    readAs(pos_, K::Semicolon);
    return true;
}

Argument* Parser::parseRequiredArgument(bool procedure) {
    auto* node = make<Argument>(NodeKind::Argument);
    if (kind() == K::PlaceArg) {
        if (!procedure) report(Code::PlaceholderMisplaced, pos_, {"<ARG>", "<EXP> in a function call"});
        node->argKind = ArgKind::Placeholder;
        take();
        return finish(node);
    }
    if (isName(kind()) && peek() == K::Assign) {
        node->name = take();
        take();
    }
    if (isShownPosition()) {
        report(Code::UnexpectedToken, pos_,
               {"'*'", "a position: manuals and the pendant show '*' for one that is not written out"});
        node->value = errorExpr();
        take();
        return finish(node);
    }
    node->value = parseExpr();
    if (!panic_ && kind() == K::Assign && node->value->kind == NodeKind::Binary) { // "tool0/WObj:=wobj1"
        const auto& slash = as<BinaryExpr>(*node->value);
        if (slash.op == BinaryOp::Div && slash.right->kind == NodeKind::Name) {
            reportSlash(slash.opToken);
            take();
            parseExpr();
            node->value = errorExpr();
        }
    }
    return finish(node);
}

Argument* Parser::parseOptionalArgument() {
    auto* node = make<Argument>(NodeKind::Argument);
    node->argKind = ArgKind::Optional;
    take();
    node->name = expectName(true);
    if (panic_) return finish(node);
    if (kind() == K::Colon && !startsLine(pos_ + 1) && (startsExpr(peek()) || peek() == K::Equal))
        takeColonAsAssign();
    if (kind() == K::Equal) {
        reportEqual();
        take();
        node->value = parseExpr();
    } else if (accept(K::Assign)) {
        node->value = parseExpr();
    } else if (accept(K::Question)) {
        node->argKind = ArgKind::Conditional;
        if (isName(kind())) {
            height_ = 1;
            node->value = parseNamed(false);
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
