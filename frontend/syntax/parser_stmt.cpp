// Instructions (manual 1.1.5, 1.4, 1.5, 1.11, 1.12).

#include "frontend/syntax/parser_impl.h"

#include <algorithm>
#include <span>
#include <utility>

namespace rapid::syntax {

using diag::Code;

namespace {

/// First letters of END, ELSE, ERROR, CASE, DEFAULT, UNDO, BACKWARD, and of words of other languages for them.
bool mayBeMisspelt(char first) {
    return std::string_view("ecdubnwor").find(static_cast<char>(first | 32)) != std::string_view::npos;
}

} // namespace

namespace {
constexpr TokenSet kModuleLevel = {TokenKind::KwProc, TokenKind::KwFunc, TokenKind::KwTrap,
                                   TokenKind::KwRecord, TokenKind::KwAlias};
} // namespace

/// At LOCAL and a declaration of data in a routine: whether nothing but declarations lies between it and the next routine,
/// so that it is the END word that is missing.
bool Parser::endsBeforeLocalData() const {
    constexpr TokenIndex kFarthest = 300;
    constexpr TokenSet kData = {K::KwLocal, K::KwVar, K::KwPers, K::KwConst};
    if (!startsLine(pos_)) return false;
    TokenIndex i = pos_;
    while (i < pos_ + kFarthest) {
        const K k = kindAt(i);
        if (kModuleLevel.has(k) || k == K::KwEndmodule) return true;
        if (k == K::KwLocal && kModuleLevel.has(kindAt(i + 1))) return true;
        if (!kData.has(k) || !startsLine(i)) return false;
        while (i < pos_ + kFarthest && kindAt(i) != K::Semicolon && kindAt(i) != K::EndOfFile)
            ++i;
        ++i;
    }
    return false;
}

StmtList Parser::parseList(const TokenSet& own, bool braced) {
    const Restore restore(enclosing_);
    const TokenSet outer = enclosing_;
    enclosing_ = enclosing_ | own;
    const size_t mark = stmts_.size();
    const Restore outerMark(listMark_);
    listMark_ = mark;
    for (;;) {
        const K k = kind();
        if (kListStops.has(k)) {
            const bool isName = peek() == K::Assign && isKeyword(k); // a reserved word as the name of data
            if (k == K::EndOfFile) break;
            if (own.has(k) && !isName) {
                if (k == K::KwEndmodule && takesEarlyEndmodule()) continue;
                break;
            }
            if (k == K::Identifier) {
                if (mayBeMisspelt(textOf(pos_)[0]) && retagPiece(own)) continue;
                if (!isForeignCloser(pos_) && mayBeMisspelt(textOf(pos_)[0]) && retagMisspelt(own)) continue;
            } else if (isName || isTestWrittenCase()) {
            } else if (k == K::KwLocal) {
                if (kModuleLevel.has(peek()) || endsBeforeLocalData()) break;
            } else if (outer.has(k) && !endsRoutineTooEarly() ? !standsInside() || handleStray(own)
                                                              : handleStray(own)) {
                break;
            }
        } else if (k == K::RightBrace && braces_ > 0) {
            if (braced) take();
            break;
        } else if (k == K::RightBrace && retagBrace(own)) {
            break;
        }
        const TokenIndex before = pos_;
        stmts_.push_back(parseStmt());
        if (moreOf_) stmts_.push_back(parseLateMore());
        if (pos_ == before) take();
    }
    return drain(stmts_, mark);
}

Stmt* Parser::parseStmt() {
    const Nest nest(*this);
    if (nest) return parseStmtUnguarded();
    const TokenIndex first = pos_;
    reportTooDeep();
    abandonRoutine();
    return errorStmt(first);
}

Stmt* Parser::parseStmtUnguarded() {
    const TokenIndex first = pos_;
    const bool gives = kind() == K::KwReturn || kind() == K::KwRaise;
    if ((peek() == K::Assign || (peek() == K::Colon && kind() != K::KwDefault)) && isKeyword(kind()) &&
        (!gives || startsLine(pos_ + 2))) {
        takeReservedName();
        if (kindAt(first) == K::Identifier) {
            pos_ = first;
            return parseNamedStmt();
        }
        if (kind() == K::Assign) return parseAssignment(errorExpr(), first);
        take();
        return errorStmt(first);
    }
    switch (kind()) {
    case K::Identifier:
    case K::PlaceId: return parseNamedStmt();
    case K::PlaceVar: return parseAssignment(parsePrimary(), first);
    case K::Percent: return parseLateCall();
    case K::KwIf: return parseIf();
    case K::KwFor: return parseFor();
    case K::KwWhile: return parseWhile();
    case K::KwTest: return parseTest();
    case K::KwGoto: return parseGoto();
    case K::KwReturn: return parseValueStmt(true);
    case K::KwRaise: return parseValueStmt(false);
    case K::KwConnect: return parseConnect();
    case K::KwRetry: return parseSimple(NodeKind::Retry);
    case K::KwTrynext: return parseSimple(NodeKind::TryNext);
    case K::KwExit: return parseSimple(NodeKind::Exit);
    case K::KwBreak: return parseSimple(NodeKind::Break);
    case K::KwContinue: return parseSimple(NodeKind::Continue);
    case K::Semicolon: {
        auto* node = make<SimpleStmt>(NodeKind::Empty);
        take();
        return finish(node);
    }
    case K::PlaceSmt: {
        auto* node = make<SimpleStmt>(NodeKind::PlaceholderStmt);
        take();
        return finish(node);
    }
    case K::KwVar:
    case K::KwPers:
    case K::KwConst:
    case K::KwLocal:
    case K::PlaceDdn: return parseLateDecl();
    case K::LeftBrace: return parseBareBraces();
    case K::Minus:
        if (skipForeignComment()) return errorStmt(first);
        break;
    case K::KwElse:
    case K::KwElseif:
    case K::PlaceEit: // reported as stray; the rest of the IF belongs to it
    case K::KwThen:
    case K::KwDo:
    case K::KwCase:
    case K::KwDefault:
    case K::PlaceCse: return parseOrphan();
    default: break;
    }
    return noStmt(first);
}

/// At what begins no instruction.
Stmt* Parser::noStmt(TokenIndex first) {
    // An END word has been reported as stray.
    if (kListStops.has(kind()) && kind() != K::KwLocal) {
        take();
        panic_ = false;
        accept(K::Semicolon);
    } else {
        unexpected(kind() == K::NumLiteral && peek() == K::Colon
                       ? "an instruction: a branch of TEST begins with CASE, a label with a letter"
                       : "an instruction");
        take();
        syncStatement();
    }
    return errorStmt(first);
}

Stmt* Parser::errorStmt(TokenIndex first) {
    auto* node = make<SimpleStmt>(NodeKind::ErrorStmt);
    node->first = first;
    return finish(node);
}

/// The tail of a block whose head was broken or lost: read as the block it was meant to be, without more reports.
Stmt* Parser::parseOrphan() {
    const TokenIndex first = pos_;
    const K word = kind();
    if (word == K::KwThen && headReported_ != pos_) report(Code::StrayKeyword, pos_, {"THEN", "IF"});
    if (word == K::KwDo && headReported_ != pos_ && startsLine(pos_) && startsForeignBlock())
        return errorStmt(first);
    if (word == K::KwDo && headReported_ != pos_) report(Code::StrayKeyword, pos_, {"DO", "FOR or WHILE"});
    TokenSet ends = {K::KwEndfor, K::KwEndwhile};
    if (word == K::KwCase || word == K::KwDefault || word == K::PlaceCse) ends = kTestEnds;
    if (kIfEnds.has(word) || word == K::KwThen) ends = kIfEnds;
    // In an IF, and in line with it: this was an ELSEIF, and the ENDIF is not its own.
    const bool isBranch = word == K::KwThen && blockOpening_ != kNoToken &&
                          kindAt(blockOpening_) == K::KwIf && indentOf(first) == columnOf(blockOpening_);
    constexpr TokenSet kEnds = {K::KwEndif, K::KwEndfor, K::KwEndwhile, K::KwEndtest};
    do {
        if (kind() == K::KwElse && peek() == K::KwIf && !startsLine(pos_ + 1)) { // the IF is none of its own
            take();
            readAs(pos_, K::KwElseif);
        }
        const bool hasCondition = kind() == K::KwElseif || kind() == K::KwCase;
        take();
        if (hasCondition) skipHead();
        if (tokens_[pos_ - 1].kind == K::KwDefault) accept(K::Colon);
        parseList(ends);
    } while (ends.has(kind()) && !kEnds.has(kind()));
    if (ends.has(kind()) && !isBranch) take();
    panic_ = false;
    return errorStmt(first);
}

/// Skips the condition of an ELSEIF or the values of a CASE in an orphan.
void Parser::skipHead() {
    const K closing = tokens_[pos_ - 1].kind == K::KwElseif ? K::KwThen : K::Colon;
    TokenIndex found = 0;
    if (findOnLine(pos_, closing, found)) pos_ = found + 1;
}

// ---- Assignment, label, call -----------------------------------------------------------------------------------

Stmt* Parser::parseNamedStmt() {
    const TokenIndex first = pos_;
    if (strayEnd_ == pos_) {
        take();
        return errorStmt(first);
    }
    switch (peek()) {
    case K::Assign:
    case K::LeftBrace:
    case K::Dot: return parseAssignment(parseNamed(false), first);
    case K::Equal: {
        TokenIndex then = 0;
        if (findOnLine(pos_ + 2, K::KwThen, then)) {
            reportMissingIf();
            return parseIfBlocks(first, parseCondition(), false);
        }
        return parseAssignment(parseNamed(false), first);
    }
    case K::Colon: {
        constexpr TokenSet kNoInstruction = {K::Equal,   K::NumLiteral, K::StringLiteral, K::KwTrue,
                                             K::KwFalse, K::Minus,      K::LeftBracket};
        constexpr TokenSet kBetween = {K::Star, K::Slash, K::KwDiv, K::KwMod, K::KwAnd, K::KwOr, K::KwXor};
        const bool calculates = peek(2) == K::Identifier && kBetween.has(peek(3)) && !startsLine(first + 3);
        if ((!kNoInstruction.has(peek(2)) && !calculates) || startsLine(first + 2)) return parseLabel();
        return parseColonAssignment();
    }
    case K::Identifier:
        if (retagOpener()) return parseStmtUnguarded();
        if (skipForeignComment()) return errorStmt(first);
        if (isWordlessData()) {
            auto* node = make<DeclStmt>(NodeKind::DeclStmt);
            node->decl = parseWordlessData();
            return finish(node);
        }
        break;
    case K::KwTo:
        if (peek(2) == K::Identifier && equalsNoCase(textOf(first), "GO")) {
            retag(first, first + 1, K::KwGoto);
            ++pos_;
            return parseStmtUnguarded();
        }
        break;
    case K::LeftBracket:
    case K::LeftParen: {
        if (!isBracketTarget()) break;
        auto* name = makeExpr<NameExpr>(NodeKind::Name);
        name->name = take();
        return parseAssignment(parsePostfix(parseIndex(finish(name))), first);
    }
    default: break;
    }
    if (isTaskDirective(pos_)) return parseLateDecl();
    if (isEndlessLoop()) {
        const TokenIndex opening = take();
        return parseWhileBody(opening, errorExpr(), true);
    }
    if (endsForeignBlock() || startsForeignBlock()) return errorStmt(first);
    return parseCallStmt();
}

/// `name(1) := ...`, `name[1].x := ...`
bool Parser::isBracketTarget() const {
    uint32_t depth = 0;
    constexpr TokenIndex kSearch = 500;
    for (TokenIndex i = pos_ + 1; i < pos_ + kSearch; ++i) {
        const K k = kindAt(i);
        if (k == K::Semicolon || k == K::EndOfFile || k == K::Assign) return false;
        if (kOpenBrackets.has(k)) ++depth;
        if (kCloseBrackets.has(k) && --depth == 0)
            return kindAt(i + 1) == K::Assign || kindAt(i + 1) == K::Dot;
    }
    return false;
}

Stmt* Parser::parseAssignment(Expr* target, TokenIndex first) {
    auto* node = make<AssignStmt>(NodeKind::Assign);
    const size_t unreadable = unreadable_;
    node->first = first;
    node->target = target;
    if (kind() == K::Equal) {
        reportEqual();
        take();
    } else if (!accept(K::Assign) && !panic_) {
        missing("':='");
    }
    const bool valueLost = beginsInstruction() || (!isName(kind()) && !startsExpr(kind()));
    if (valueLost && negatesByComment(";")) {
        node->value = errorExpr();
        node->broken = true;
        return finish(node);
    }
    node->value = panic_ ? errorExpr() : parseExpr();
    const bool named = node->value->kind == NodeKind::Name && kind() != K::Semicolon && startsExpr(kind());
    endStatement(named ? "';', or '(' before the arguments of a function" : "';'");
    node->broken = unreadable_ > unreadable;
    return finish(node);
}

/// `n : = 1;`, `n : 1;`
Stmt* Parser::parseColonAssignment() {
    const TokenIndex name = pos_;
    auto* target = makeExpr<NameExpr>(NodeKind::Name);
    target->name = take();
    finish(target);
    takeColonAsAssign();
    return parseAssignment(target, name);
}

/// ':' or ': =' is to be read as ':='; the parser then stands at that.
void Parser::takeColonAsAssign() {
    const bool split = peek() == K::Equal;
    const SourceRange sign{tree_.range(pos_).begin, tree_.range(split ? pos_ + 1 : pos_).end};
    const std::string_view shown = tree_.source->text().substr(sign.begin, sign.end - sign.begin);
    fix(reportAt(Code::ForeignSpelling, sign, {std::string(shown), "':='"}), sign, ":=");
    if (split) take();
    readAs(pos_, K::Assign);
}

Stmt* Parser::parseLabel() {
    auto* node = make<LabelStmt>(NodeKind::Label);
    node->name = take();
    checkNameLength(node->name);
    take();
    return finish(node);
}

Stmt* Parser::parseCallStmt() {
    auto* node = make<CallStmt>(NodeKind::CallStmt);
    node->name = take();
    if (calleeEndsHere(node->name, node->name)) {
        fix(reportAt(Code::MissingSemicolon, endOf(node->name), {describe(node->name)}), endOf(node->name),
            ";");
        return finish(node);
    }
    if (kind() == K::LeftParen && parseParenthesisedCall(node)) return finish(node);
    if (kind() == K::Error) { // reported; perhaps no call at all
        syncStatement();
        return errorStmt(node->name);
    }
    const size_t errorsBefore = errors_;
    const size_t unreadable = unreadable_;
    node->args = parseArguments(true);
    if (!panic_ && !node->args.empty() && isName(kind()) && peek() == K::Assign && !startsLine(pos_)) {
        unexpected("'\\' or ','"); // "Move 1 speed:=2;"
    }
    if (kind() != K::Semicolon && !panic_ && errors_ == errorsBefore && retagCallee(node->name))
        return parseStmtUnguarded();
    if (node->args.empty() && atReservedName()) { // an argument
        node->args = {};
        report(Code::ReservedWordAsName, pos_, {std::string(tokenText(kind()))});
        panic_ = true;
    }
    endStatement(node->args.empty() ? "an argument or ';'" : "',' or ';'");
    node->broken = unreadable_ > unreadable;
    return finish(node);
}

/// `name(a, b);` and `name();`, which is wrong; the checker says so, because it knows whether `name` is a procedure.
/// `name(a);` and `name(a), b;` are right, since an argument may be in parentheses.
bool Parser::parseParenthesisedCall(CallStmt* call) {
    constexpr TokenIndex kSearch = 500;
    bool several = peek() == K::RightParen;
    uint32_t depth = 0;
    TokenIndex i = pos_;
    for (; i < pos_ + kSearch; ++i) {
        const K k = kindAt(i);
        if (k == K::Semicolon || k == K::EndOfFile) return false;
        if (kOpenBrackets.has(k)) ++depth;
        if (kCloseBrackets.has(k) && --depth == 0) break;
        if (depth == 1 && (k == K::Comma || k == K::Backslash)) several = true;
    }
    if (!several || kindAt(i + 1) != K::Semicolon) return false;
    const TokenIndex opening = take();
    call->args = parseArguments(true);
    expectClosing(K::RightParen, opening, true);
    endStatement();
    return true;
}

/// `%"proc" + NumToStr(i, 0)% x, y;`
Stmt* Parser::parseLateCall() {
    auto* node = make<CallStmt>(NodeKind::CallStmt);
    const TokenIndex opening = take();
    const bool outer = std::exchange(inLateName_, true);
    node->lateName = parseExpr();
    inLateName_ = outer;
    expectClosing(K::Percent, opening, false);
    if (!panic_ && !calleeEndsHere(opening, pos_ - 1)) node->args = parseArguments(true);
    endStatement(node->args.empty() ? "an argument or ';'" : "',' or ';'");
    return finish(node);
}

// ---- Instructions of one word and an operand ---------------------------------------------------------------------

Stmt* Parser::parseGoto() {
    auto* node = make<GotoStmt>(NodeKind::Goto);
    take();
    node->label = expectNameHere();
    endStatement();
    return finish(node);
}

/// RETURN and RAISE with an optional value.
Stmt* Parser::parseValueStmt(bool isReturn) {
    Expr* value = nullptr;
    const size_t unreadable = unreadable_;
    const TokenIndex first = take();
    constexpr TokenSet kSigns = {K::Assign, K::Equal, K::Colon};
    if (kSigns.has(kind()) && !startsLine(pos_) && startsExpr(peek()) &&
        !startsLine(pos_ + 1)) { // RETURN = x;
        fix(report(Code::UnexpectedToken, pos_, {describe(pos_), "a value behind " + describe(first)}),
            {tree_.range(pos_).begin, tree_.range(pos_ + 1).begin},
            tree_.range(first).end == tree_.range(pos_).begin ? " " : "");
        take();
    }
    const bool valueBelow =
        isReturn && routineEnd_ == K::KwEndfunc && isName(kind()) && peek() == K::Semicolon;
    if (kind() != K::Semicolon && startsExpr(kind()) && (valueBelow || !calleeEndsHere(first, first)) &&
        !(startsLine(pos_) && isName(kind()) && (peek() == K::Assign || peek() == K::Colon)))
        value = parseExpr();
    Stmt* result;
    if (isReturn) {
        auto* node = make<ReturnStmt>(NodeKind::Return);
        node->value = value;
        result = node;
    } else {
        auto* node = make<RaiseStmt>(NodeKind::Raise);
        node->value = value;
        result = node;
    }
    result->first = first;
    if (isReturn && !value && !panic_ && kind() == K::KwEndfunc) missing("an expression");
    endStatement(value ? "';'" : "an expression or ';'");
    const bool unfinished = !value && kindAt(pos_ - 1) != K::Semicolon;
    result->broken = unfinished || unreadable_ > unreadable;
    return finish(result);
}

Stmt* Parser::parseConnect() {
    auto* node = make<ConnectStmt>(NodeKind::Connect);
    take();
    if (isName(kind())) {
        node->target = parseNamed(false);
    } else if (kind() == K::PlaceVar) {
        node->target = parsePrimary();
    } else {
        missing("an interrupt variable");
        node->target = errorExpr();
    }
    if (!panic_) {
        if (kind() == K::Identifier && isName(peek())) retagIfMeant(K::KwWith);
        if (accept(K::KwWith)) {
            node->trap = expectNameHere();
            skipTrapArguments();
        } else {
            missing("WITH");
        }
    }
    endStatement();
    return finish(node);
}

/// "CONNECT i WITH t();": it is named, not called.
void Parser::skipTrapArguments() {
    if (panic_ || kind() != K::LeftParen || startsLine(pos_)) return;
    TokenIndex last = pos_ + 1;
    constexpr TokenIndex kFarthest = 100;
    while (kindAt(last) != K::RightParen && last < pos_ + kFarthest && !startsLine(last))
        ++last;
    if (kindAt(last) != K::RightParen || kindAt(last + 1) != K::Semicolon) return;
    const SourceRange whole{tree_.range(pos_).begin, tree_.range(last).end};
    fix(report(Code::UnexpectedToken, pos_, {"'('", "';': a trap routine is named, not called"}), whole, "");
    pos_ = last + 1;
}

Stmt* Parser::parseSimple(NodeKind nodeKind) {
    auto* node = make<SimpleStmt>(nodeKind);
    take();
    endStatement();
    return finish(node);
}

/// Another name of the data declared last.
Stmt* Parser::parseLateMore() {
    auto* node = make<DeclStmt>(NodeKind::DeclStmt);
    node->decl = parseMoreNames();
    return finish(node);
}

/// Data declared after an instruction or inside a block.
Stmt* Parser::parseLateDecl() {
    auto* node = make<DeclStmt>(NodeKind::DeclStmt);
    if (accept(K::PlaceDdn)) {
        node->kind = NodeKind::PlaceholderStmt;
        report(Code::PlaceholderMisplaced, pos_ - 1, {"<DDN>", "<SMT> after the first instruction"});
        return finish(node);
    }
    const TokenIndex first = pos_;
    ScopeWord scope = ScopeWord::None;
    bool reported = false;
    if (kind() == K::KwLocal || isTaskDirective(pos_)) {
        scope = kind() == K::KwLocal ? ScopeWord::Local : ScopeWord::Task;
        reportScopeInside(scope, true);
        reported = true;
        take();
    }
    if (kind() != K::KwVar && kind() != K::KwPers && kind() != K::KwConst) {
        if (!reported) unexpected("a data declaration");
        syncStatement();
        return errorStmt(first);
    }
    const size_t errorsBefore = errors_;
    node->decl = parseData(scope, first);
    const auto isLost = [](const Stmt* s) { // perhaps a declaration
        return s->broken || s->kind == NodeKind::ErrorStmt || s->kind == NodeKind::DeclStmt;
    };
    constexpr size_t kMostStmts = 500;
    const auto list =
        std::span(stmts_).subspan(std::max(listMark_, stmts_.size() - std::min(stmts_.size(), kMostStmts)));
    reported |=
        !list.empty() && std::all_of(list.begin(), list.end(), isLost) &&
        std::any_of(list.begin(), list.end(), [](const Stmt* s) { return s->kind != NodeKind::DeclStmt; });
    if (!reported && errors_ == errorsBefore &&
        node->decl->dataKind != DataKind::Pers) { // PERS is none of a routine
        const TokenIndex name = node->decl->name;
        report(Code::DeclarationAfterInstruction, name == kNoToken ? first : name,
               {std::string(textOf(name))});
    }
    return finish(node);
}

} // namespace rapid::syntax
