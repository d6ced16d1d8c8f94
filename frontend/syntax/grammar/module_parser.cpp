// Files and modules (manual 1.1.3).

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <utility>

namespace rapid::syntax {

namespace {

uint8_t attributeOf(TokenKind kind) {
    switch (kind) {
    case TokenKind::KwSysmodule: return kAttrSysmodule;
    case TokenKind::KwNoview: return kAttrNoview;
    case TokenKind::KwNostepin: return kAttrNostepin;
    case TokenKind::KwViewonly: return kAttrViewonly;
    case TokenKind::KwReadonly: return kAttrReadonly;
    default: return 0;
    }
}

} // namespace

void ModuleParser::parseFile(const LexResult& lexed) {
    expressions().setLexed(lexed);
    if (!lexed.hasModule && startsMisspeltModule()) {
        parser().lexical.report(lexed, reports());
        accept(K::FileHeader);
        typos().readAsKeyword(pos(), pos(), K::KwModule);
    } else if (!lexed.hasModule) { // not RAPID: one report, whatever its characters are
        const TokenIndex first = kind() == K::FileHeader ? 1 : 0;
        if (kindAt(first) == K::EndOfFile) {
            report(say::NoModule, first);
        } else {
            report(say::TextOutsideModule, first, {describe(first)});
        }
        return;
    } else {
        parser().lexical.report(lexed, reports());
        LaterWords(parser()).readLaterWordsAsNames();
        accept(K::FileHeader);
    }
    for (;;) {
        warnOutsideComment(pos());
        if (kind() == K::EndOfFile) break;
        if (accept(K::FileHeader)) continue;
        if (kind() == K::KwModule) {
            parseModule();
        } else if (kind() == K::Semicolon && pos() > 0 && kindAt(pos() - 1) == K::KwEndmodule) {
            skipStraySemicolons();
        } else {
            skipOutsideModule();
        }
    }
    parser().lexical.reportBrokenStrings();
    if (!sync().hasGoneBack()) return;
    for (ModuleDecl* module : tree().modules)
        cutOff(*module);
}

/// After going back: removes from nodes the tokens below an unfinished line that were read as its end.
void ModuleParser::cutOff(Node& node) {
    if (node.kind == NodeKind::Aggregate && as<AggregateExpr>(node).isPlain()) return;
    if (node.kind == NodeKind::Component && as<ComponentExpr>(node).name > node.last)
        as<ComponentExpr>(node).name = kNoToken;
    forEachChild(node, [&](const Node& each) {
        Node& child = const_cast<Node&>(each); // of the tree that is being made
        if (child.first <= child.last && child.last > node.last) {
            if (child.first > node.last) {
                if (isExpr(child.kind)) child.kind = NodeKind::ErrorExpr;
                if (child.kind == NodeKind::Argument) as<Argument>(child).name = kNoToken;
                child.first = node.last + 1;
            }
            child.last = node.last;
        }
        cutOff(child);
    });
}

/// MODUEL name
bool ModuleParser::startsMisspeltModule() const {
    const TokenIndex first = kind() == K::FileHeader ? 1 : 0;
    return typos().editsTo(first, K::KwModule) != 0 && kindAt(first + 1) == K::Identifier &&
           !startsLine(first + 1);
}

/// Comments belong inside of modules (manual 1.1.2); one report a file.
void ModuleParser::warnOutsideComment(TokenIndex next) {
    if (outsideCommentShown_) return;
    const std::string_view text = sourceText();
    const uint32_t from = next == 0 ? 0 : range(next - 1).end;
    const uint32_t to =
        kindAt(next) == K::EndOfFile ? static_cast<uint32_t>(text.size()) : tokenAt(next).offset;
    const size_t comment = text.substr(0, to).find('!', from);
    if (comment == std::string_view::npos) return;
    outsideCommentShown_ = true;
    const size_t end = std::min<size_t>(text.find_first_of("\r\n", comment), text.size());
    reportAt(say::CommentOutsideModule, {static_cast<uint32_t>(comment), static_cast<uint32_t>(end)});
}

Expr* ModuleParser::parseWholeExpression(const LexResult& lexed) {
    parser().lexical.report(lexed, reports());
    Expr* result = expressions().parseExpression();
    if (kind() != K::EndOfFile && !panic()) unexpected("the end of the expression");
    parser().lexical.reportBrokenStrings();
    return result;
}

/// Anything between modules but comments is reported once.
void ModuleParser::skipOutsideModule() {
    if (kind() == K::KwEndmodule && openModules_ > 0) { // of a module around the last one, which is reported
        --openModules_;
        take();
        return;
    }
    if (kind() != K::Error) report(say::TextOutsideModule, pos(), {describe(pos())});
    do
        take();
    while (kind() != K::EndOfFile && !(kind() == K::KwModule && startsLine(pos())));
}

/// `ENDPROC;` and the like: harmless, but no declaration.
void ModuleParser::skipStraySemicolons() {
    diag::Diagnostic* diagnostic = report(say::StraySemicolon, pos(), {describe(pos() - 1)});
    const uint32_t from = range(pos()).begin;
    while (accept(K::Semicolon)) {
    }
    if (diagnostic) diagnostic->fix({from, range(pos() - 1).end}, "");
}

void ModuleParser::parseModule() {
    auto* node = tree().arena.make<ModuleDecl>();
    node->kind = NodeKind::Module;
    node->first = pos();
    endPanic();
    quietOutside_ = false;
    const TokenIndex opening = take();
    names().skipSecond(opening);
    node->name = names().expectName();
    names().checkNameLength(node->name);
    if (!panic() && kind() == K::LeftParen) parseModuleAttributes(node);
    if (!panic() && !ahead().startsDeclaration(pos()) && !startsLine(pos()) && kind() != K::KwEndmodule &&
        kind() != K::EndOfFile && kind() != K::Semicolon)
        unexpected("'(' or a declaration");
    if (panic()) skipToDeclaration();
    parseDeclarations(node);
    if (!accept(K::KwEndmodule)) {
        ++openModules_;
        if (reports().mayReportEnd())
            note(report(say::MissingBlockEnd, pos(), {describe(pos()), "ENDMODULE"}), opening,
                 "MODULE begins here");
    }
    tree().modules.push_back(finish(node));
}

void ModuleParser::parseModuleAttributes(ModuleDecl* module) {
    const TokenIndex opening = take();
    std::vector<TokenIndex> seen;
    const TokenIndex first = pos();
    const size_t errorsBefore = reports().errors();
    do {
        if (attributeOf(kind())) {
            addAttribute(module, pos(), seen);
            take();
        } else if (kind() == K::Identifier || isKeyword(kind())) {
            report(say::UnknownModuleAttribute, pos(), {std::string(textOf(pos()))});
            take();
        } else {
            unexpected("a module attribute");
        }
    } while (!panic() && accept(K::Comma));
    if (reports().errors() == errorsBefore + 1 && lastOrder_ && !panic()) fixAttributeOrder(first, seen);
    lastOrder_ = nullptr;
    sync().expectClosing(K::RightParen, opening, true);
    module->attributeTokens = tree().arena.copy(seen);
}

/// Order and combination of the attributes (manual 1.1.3).
void ModuleParser::addAttribute(ModuleDecl* module, TokenIndex token, std::vector<TokenIndex>& seen) {
    const uint8_t attribute = attributeOf(kindAt(token));
    constexpr uint8_t kBesideNoview = kAttrSysmodule | kAttrNoview;
    const uint8_t all = module->attributes | attribute;
    if (module->attributes & attribute) {
        fix(report(say::DuplicateModuleAttribute, token, {describe(token)}),
            {range(token - 2).end, range(token).end}, "");
    } else if ((all & kAttrNoview) && (all & ~kBesideNoview)) {
        const TokenIndex other = attribute == kAttrNoview ? seen.back() : token;
        if (!(module->attributes & kAttrNoview) || !(module->attributes & ~kBesideNoview))
            report(say::ModuleAttributeConflict, token, {describe(other)});
    } else if (attribute < module->attributes) {
        lastOrder_ = report(say::ModuleAttributeOrder, token, {describe(token), describe(seen.back())});
    }
    module->attributes = all;
    seen.push_back(token);
}

/// The same words in the order of the grammar.
void ModuleParser::fixAttributeOrder(TokenIndex first, std::vector<TokenIndex> words) {
    std::sort(words.begin(), words.end(),
              [&](TokenIndex a, TokenIndex b) { return attributeOf(kindAt(a)) < attributeOf(kindAt(b)); });
    std::string sorted;
    for (const TokenIndex word : words)
        sorted += (sorted.empty() ? "" : ",") + std::string(textOf(word));
    fix(lastOrder_, {range(first).begin, range(pos() - 1).end}, sorted);
}

void ModuleParser::parseDeclarations(ModuleDecl* module) {
    const size_t bottom = nodes().decls.size();
    while (kind() != K::KwEndmodule && kind() != K::KwModule && kind() != K::EndOfFile) {
        if (kind() == K::Identifier && !quietOutside_ && recovery().repair(Place::Declaration)) continue;
        if (kind() == K::RightBrace && peek() == K::EndOfFile && !quietOutside_) {
            typos().readAsKeyword(pos(), pos(), K::KwEndmodule);
            break;
        }
        if (retagLastEnd()) break;
        const TokenIndex before = pos();
        if (kind() == K::Semicolon && !quietOutside_) {
            skipStraySemicolons();
            continue;
        }
        if (Decl* decl = parseDeclaration()) nodes().decls.push_back(decl);
        while (Decl* decl = data().parseMoreNames())
            nodes().decls.push_back(decl);
        endPanic();
        if (pos() == before) take();
    }
    module->decls = drain(nodes().decls, bottom);
}

/// The last word of the file, where ENDMODULE belongs: another END word, or a piece of that one.
bool ModuleParser::retagLastEnd() {
    if (peek() != K::EndOfFile || kind() == K::EndOfFile || !startsLine(pos())) return false;
    if (typos().isPieceOf(pos(), K::KwEndmodule)) {
        if (quietOutside_)
            readAs(pos(), K::KwEndmodule);
        else
            typos().readAsKeyword(pos(), pos(), K::KwEndmodule);
        return true;
    }
    if (!kEndWords.has(kind())) return false;
    if (!quietOutside_)
        fix(report(say::MissingBlockEnd, pos(), {describe(pos()), "ENDMODULE"}), range(pos()), "ENDMODULE");
    readAs(pos(), K::KwEndmodule);
    return true;
}

Decl* ModuleParser::parseDeclaration() {
    const TokenIndex first = pos();
    switch (kind()) {
    case K::KwVar:
    case K::KwPers:
    case K::KwConst: return data().parseData(ScopeWord::None, first, true);
    case K::KwLocal: return parseScopedDeclaration();
    case K::KwProc:
    case K::KwFunc:
    case K::KwTrap: quietOutside_ = false; return routines().parseRoutine(false, first);
    case K::KwRecord: return types().parseRecord(false, first);
    case K::KwAlias: return types().parseAlias(false, first);
    case K::PlaceTdn:
    case K::PlaceDdn:
    case K::PlaceRdn: {
        auto* node = make<PlaceholderDecl>(NodeKind::PlaceholderDecl);
        take();
        return finish(node);
    }
    default: break;
    }
    if (isTaskDirective(pos())) {
        take();
        return data().parseData(ScopeWord::Task, first, true);
    }
    if (isContextual(pos(), "TASK") && (kDeclWords.has(peek()) && !isPlaceholder(peek())))
        return parseTaskDeclaration();
    if (ahead().isWordlessData() && !quietOutside_) return data().parseWordlessData();
    return parseUnknownDeclaration();
}

/// TASK before what cannot take it: left out, or with LOCAL.
Decl* ModuleParser::parseTaskDeclaration() {
    const TokenIndex first = pos();
    const SourceRange word{range(pos()).begin, range(pos() + 1).begin};
    if (peek() == K::KwLocal) {
        report(say::ScopeConflict, pos());
    } else {
        fix(report(say::TaskDirective, pos(), {describe(pos() + 1)}), word, "");
    }
    take();
    if (Decl* decl = parseDeclaration()) return decl;
    auto* node = make<PlaceholderDecl>(NodeKind::ErrorDecl);
    node->first = first;
    return finish(node);
}

Decl* ModuleParser::parseScopedDeclaration() {
    const TokenIndex first = take();
    switch (kind()) {
    case K::KwVar:
    case K::KwPers:
    case K::KwConst: return data().parseData(ScopeWord::Local, first, true);
    case K::KwProc:
    case K::KwFunc:
    case K::KwTrap: quietOutside_ = false; return routines().parseRoutine(true, first);
    case K::KwRecord: return types().parseRecord(true, first);
    case K::KwAlias: return types().parseAlias(true, first);
    default: break;
    }
    if (isTaskDirective(pos())) {
        report(say::ScopeConflict, pos());
        take();
        return data().parseData(ScopeWord::Task, first, true);
    }
    unexpected("a declaration after LOCAL");
    quietOutside_ = true;
    skipToDeclaration();
    auto* node = make<PlaceholderDecl>(NodeKind::ErrorDecl);
    node->first = first;
    return finish(node);
}

/// Text that is not a declaration: instructions after an ENDPROC too many, misspelt words. One report up to the next routine.
Decl* ModuleParser::parseUnknownDeclaration() {
    auto* node = make<PlaceholderDecl>(NodeKind::ErrorDecl);
    constexpr TokenSet kEnds = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap};
    if (kind() != K::Error && !quietOutside_) {
        if (kEnds.has(kind())) {
            report(say::StrayKeyword, pos(), {describe(pos()), std::string(tokenText(kind()).substr(3))});
        } else if (kind() == K::KwEndrecord) {
            report(say::StrayKeyword, pos(), {describe(pos()), "RECORD"});
        } else {
            diag::Diagnostic* diagnostic = report(say::InstructionOutsideRoutine, pos(), {describe(pos())});
            if (kind() == K::Semicolon) fix(diagnostic, range(pos()), "");
        }
    }
    if (kind() != K::Semicolon) quietOutside_ = true;
    take();
    skipToDeclaration();
    return finish(node);
}

/// To the next word at the beginning of a line, or after a semicolon or END word, that begins a declaration.
void ModuleParser::skipToDeclaration() {
    endPanic();
    for (; kind() != K::EndOfFile && kind() != K::KwEndmodule; take()) {
        if (!ahead().startsDeclaration(pos())) continue;
        const K before = pos() > 0 ? kindAt(pos() - 1) : K::Semicolon;
        if (startsLine(pos()) || before == K::Semicolon || before == K::RightParen || isKeyword(before))
            return;
    }
}

} // namespace rapid::syntax
