// Lists of instructions, and which instruction begins here (manual 1.4).

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <algorithm>
#include <span>

namespace rapid::syntax {

namespace {

/// First letters of END, ELSE, ERROR, CASE, DEFAULT, UNDO, BACKWARD, and of words of other languages for them.
bool mayBeMisspelt(char first) {
    return std::string_view("ecdubnwor").find(static_cast<char>(first | 32)) != std::string_view::npos;
}

} // namespace

StmtList InstructionParser::parseInstructions(const TokenSet& own, bool braced) {
    const Restore restore(block().enclosing);
    const TokenSet outer = block().enclosing;
    block().enclosing = block().enclosing | own;
    const size_t bottom = nodes().stmts.size();
    const Restore outerMark(block().listMark);
    block().listMark = bottom;
    for (;;) {
        const K k = kind();
        if (kListStops.has(k)) {
            const bool isName = peek() == K::Assign && isKeyword(k); // a reserved word as the name of data
            if (k == K::EndOfFile) break;
            if (own.has(k) && !isName) {
                if (k == K::KwEndmodule && ends().takesEarlyEndmodule()) continue;
                break;
            }
            if (k == K::Identifier) {
                if (isMisspelt(own)) continue;
            } else if (isName) {
            } else if (k == K::KwLocal) {
                if (kModuleLevel.has(peek()) || ahead().endsBeforeLocalData()) break;
            } else if (outer.has(k) && !block().endsRoutineTooEarly() && !block().isInside()) {
                break;
            } else {
                const Repair* repair = recovery().repair({.place = Place::StrayWord, .own = own});
                if (repair && repair->endsList) break;
            }
        } else if (k == K::RightBrace && block().braces > 0) {
            if (braced) take();
            break;
        } else if (k == K::RightBrace && recovery().repair({.place = Place::ListBrace, .own = own})) {
            break;
        }
        const TokenIndex before = pos();
        nodes().stmts.push_back(parseInstruction());
        if (data().hasMoreNames()) nodes().stmts.push_back(parseMoreData());
        if (pos() == before) take();
    }
    return drain(nodes().stmts, bottom);
}

/// At a name: whether it was meant as a word that continues or ends this list, and is read so now.
bool InstructionParser::isMisspelt(const TokenSet& own) {
    if (!mayBeMisspelt(textOf(pos())[0]) || isMarked(Mark::StrayEnd)) return false;
    return recovery().repair({.place = Place::ListEnd, .own = own}) ||
           (!foreign().isForeignCloser(pos()) && recovery().repair({.place = Place::ListWord, .own = own}));
}

Stmt* InstructionParser::parseInstruction() {
    const Nest nest(nodes());
    if (nest) return parseEffectiveInstruction();
    const TokenIndex first = pos();
    reports().reportTooDeep();
    sync().abandonRoutine();
    return errorStmt(first);
}

/// A reserved word as the target of an assignment or as a label.
Stmt* InstructionParser::parseReservedNamed() {
    const TokenIndex first = names().takeReservedName();
    if (kindAt(first) == K::Identifier) {
        moveTo(first);
        return parseNamedInstruction();
    }
    if (kind() == K::Assign) return parseAssignment(expressions().errorExpr(), first);
    take();
    return errorStmt(first);
}

Stmt* InstructionParser::parseEffectiveInstruction() {
    const TokenIndex first = pos();
    const bool gives = kind() == K::KwReturn || kind() == K::KwRaise;
    if ((peek() == K::Assign || (peek() == K::Colon && kind() != K::KwDefault)) && isKeyword(kind()) &&
        (!gives || startsLine(pos() + 2)))
        return parseReservedNamed();
    switch (kind()) {
    case K::Identifier:
    case K::PlaceId: return parseNamedInstruction();
    case K::PlaceVar: return parseAssignment(expressions().parsePrimary(), first);
    case K::Percent: return parseLateBoundCall();
    case K::KwIf: return blocks().parseIf();
    case K::KwFor: return blocks().parseFor();
    case K::KwWhile: return blocks().parseWhile();
    case K::KwTest: return blocks().parseTest();
    case K::KwGoto: return parseGoto();
    case K::KwReturn: return parseReturnOrRaise(true);
    case K::KwRaise: return parseReturnOrRaise(false);
    case K::KwConnect: return parseConnect();
    case K::KwRetry: return parseWordInstruction(NodeKind::Retry);
    case K::KwTrynext: return parseWordInstruction(NodeKind::TryNext);
    case K::KwExit: return parseWordInstruction(NodeKind::Exit);
    case K::KwBreak: return parseWordInstruction(NodeKind::Break);
    case K::KwContinue: return parseWordInstruction(NodeKind::Continue);
    case K::Semicolon:
    case K::PlaceSmt: {
        auto* node = make<SimpleStmt>(kind() == K::Semicolon ? NodeKind::Empty : NodeKind::PlaceholderStmt);
        take();
        return finish(node);
    }
    case K::KwVar:
    case K::KwPers:
    case K::KwConst:
    case K::KwLocal:
    case K::PlaceDdn: return parseLateDeclaration();
    case K::LeftBrace: return foreign().parseBareBraces();
    case K::Minus:
        if (recovery().repair(Place::Comment)) return errorStmt(first);
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
    return parseNoInstruction(first);
}

Stmt* InstructionParser::parseNamedInstruction() {
    const TokenIndex first = pos();
    if (isMarked(Mark::StrayEnd)) {
        take();
        return errorStmt(first);
    }
    switch (peek()) {
    case K::Assign:
    case K::LeftBrace:
    case K::Dot: return parseAssignment(expressions().parseVariableOrCall(false), first);
    case K::Equal: {
        TokenIndex then = 0;
        if (ahead().findOnLine(pos() + 2, K::KwThen, then)) {
            torn().reportMissingIf();
            return blocks().parseIfBranches(first, expressions().parseCondition(), false);
        }
        return parseAssignment(expressions().parseVariableOrCall(false), first);
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
        if (peek(2) == K::Comma) break; // a call
        if (recovery().repair(Place::Instruction)) return parseEffectiveInstruction();
        if (recovery().repair(Place::Comment)) return errorStmt(first);
        if (ahead().isWordlessData()) {
            auto* node = make<DeclStmt>(NodeKind::DeclStmt);
            node->decl = data().parseWordlessData();
            return finish(node);
        }
        break;
    case K::KwTo:
        if (peek(2) == K::Identifier && equalsNoCase(textOf(first), "GO")) {
            typos().readAsKeyword(first, first + 1, K::KwGoto);
            take();
            return parseEffectiveInstruction();
        }
        break;
    case K::LeftBracket:
    case K::LeftParen: {
        if (!ahead().isBracketTarget()) break;
        auto* name = makeExpr<NameExpr>(NodeKind::Name);
        name->name = take();
        return parseAssignment(expressions().parsePostfix(expressions().parseIndex(finish(name))), first);
    }
    default: break;
    }
    if (isTaskDirective(pos())) return parseLateDeclaration();
    if (foreign().isEndlessLoop()) {
        const TokenIndex opening = take();
        return blocks().parseWhileBody(opening, expressions().errorExpr(), true);
    }
    if (foreign().endsForeignBlock() || foreign().startsForeignBlock()) return errorStmt(first);
    return parseProcedureCall();
}

/// At what begins no instruction.
Stmt* InstructionParser::parseNoInstruction(TokenIndex first) {
    // An END word has been reported as stray.
    if (kListStops.has(kind()) && kind() != K::KwLocal) {
        take();
        endPanic();
        accept(K::Semicolon);
    } else {
        unexpected(kind() == K::NumLiteral && peek() == K::Colon
                       ? "an instruction: a branch of TEST begins with CASE, a label with a letter"
                       : "an instruction");
        take();
        sync().skipInstruction();
    }
    return errorStmt(first);
}

Stmt* InstructionParser::errorStmt(TokenIndex first) {
    auto* node = make<SimpleStmt>(NodeKind::ErrorStmt);
    node->first = first;
    return finish(node);
}

Stmt* InstructionParser::parseOrphan() {
    const TokenIndex first = pos();
    const K word = kind();
    if (word == K::KwThen && !isMarked(Mark::BrokenHead)) report(say::StrayKeyword, pos(), {"THEN", "IF"});
    if (word == K::KwDo && !isMarked(Mark::BrokenHead) && startsLine(pos()) && foreign().startsForeignBlock())
        return errorStmt(first);
    if (word == K::KwDo && !isMarked(Mark::BrokenHead))
        report(say::StrayKeyword, pos(), {"DO", "FOR or WHILE"});
    TokenSet ends = {K::KwEndfor, K::KwEndwhile};
    if (word == K::KwCase || word == K::KwDefault || word == K::PlaceCse) ends = kTestEnds;
    if (kIfEnds.has(word) || word == K::KwThen) ends = kIfEnds;
    // In an IF, and in line with it: this was an ELSEIF, and the ENDIF is not its own.
    const bool isBranch = word == K::KwThen && block().opening != kNoToken &&
                          kindAt(block().opening) == K::KwIf && indentOf(first) == columnOf(block().opening);
    constexpr TokenSet kEnds = {K::KwEndif, K::KwEndfor, K::KwEndwhile, K::KwEndtest};
    do {
        if (kind() == K::KwElse && peek() == K::KwIf && !startsLine(pos() + 1)) { // the IF is none of its own
            take();
            readAs(pos(), K::KwElseif);
        }
        const bool hasCondition = kind() == K::KwElseif || kind() == K::KwCase;
        take();
        if (hasCondition) skipHead();
        if (kindAt(pos() - 1) == K::KwDefault) accept(K::Colon);
        parseInstructions(ends);
    } while (ends.has(kind()) && !kEnds.has(kind()));
    if (ends.has(kind()) && !isBranch) take();
    endPanic();
    return errorStmt(first);
}

/// Skips the condition of an ELSEIF or the values of a CASE in an orphan.
void InstructionParser::skipHead() {
    const K closing = kindAt(pos() - 1) == K::KwElseif ? K::KwThen : K::Colon;
    TokenIndex found = 0;
    if (ahead().findOnLine(pos(), closing, found)) moveTo(found + 1);
}

/// Another name of the data declared last.
Stmt* InstructionParser::parseMoreData() {
    auto* node = make<DeclStmt>(NodeKind::DeclStmt);
    node->decl = data().parseMoreNames();
    return finish(node);
}

/// Data declared after an instruction or inside a block.
Stmt* InstructionParser::parseLateDeclaration() {
    auto* node = make<DeclStmt>(NodeKind::DeclStmt);
    if (accept(K::PlaceDdn)) {
        node->kind = NodeKind::PlaceholderStmt;
        report(say::PlaceholderMisplaced, pos() - 1, {"<DDN>", "<SMT> after the first instruction"});
        return finish(node);
    }
    const TokenIndex first = pos();
    ScopeWord scope = ScopeWord::None;
    bool countBefore = false;
    if (kind() == K::KwLocal || isTaskDirective(pos())) {
        scope = kind() == K::KwLocal ? ScopeWord::Local : ScopeWord::Task;
        routines().reportScopeInside(scope, true);
        countBefore = true;
        take();
    }
    if (kind() != K::KwVar && kind() != K::KwPers && kind() != K::KwConst) {
        if (!countBefore) unexpected("a data declaration");
        sync().skipInstruction();
        return errorStmt(first);
    }
    const size_t errorsBefore = reports().errors();
    node->decl = data().parseData(scope, first);
    const auto isLost = [](const Stmt* s) { // perhaps a declaration
        return s->broken || s->kind == NodeKind::ErrorStmt || s->kind == NodeKind::DeclStmt;
    };
    constexpr size_t kMostStmts = 500;
    const auto list =
        std::span(nodes().stmts)
            .subspan(std::max(block().listMark,
                              nodes().stmts.size() - std::min(nodes().stmts.size(), kMostStmts)));
    countBefore |=
        !list.empty() && std::all_of(list.begin(), list.end(), isLost) &&
        std::any_of(list.begin(), list.end(), [](const Stmt* s) { return s->kind != NodeKind::DeclStmt; });
    if (!countBefore && reports().errors() == errorsBefore &&
        node->decl->dataKind != DataKind::Pers) { // PERS is none of a routine
        const TokenIndex name = node->decl->name;
        report(say::DeclarationAfterInstruction, name == kNoToken ? first : name,
               {std::string(textOf(name))});
    }
    return finish(node);
}

} // namespace rapid::syntax
