// Records and aliases (manual 1.2.1).

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

namespace rapid::syntax {

Decl* TypeParser::parseRecord(bool local, TokenIndex first) {
    auto* node = make<RecordDecl>(NodeKind::Record);
    node->first = first;
    node->local = local;
    const TokenIndex opening = take();
    const size_t errorsBefore = reports().errors();
    const bool nameless = isName(kind()) && isName(peek()) && peek(2) == K::Semicolon &&
                          !startsLine(pos() + 1); // a component already
    node->name = nameless ? names().missingName() : names().expectName();
    names().checkNameLength(node->name);
    if (!startsLine(pos())) torn().takeTornName(node->name, {}, true);
    if (panic() || kind() == K::Semicolon) {
        if (!panic()) unexpected("a component");
        sync().skipInstruction();
    }
    const bool braced = kind() == K::LeftBrace;
    if (braced) {
        report(say::ForeignSpelling, pos(), {"{", "a component: a record ends with ENDRECORD"});
        take();
    }
    node->components = parseComponents(braced);
    if (braced && kindAt(pos() - 1) == K::RightBrace) {
        accept(K::KwEndrecord);
        return finish(node);
    }
    if (node->components.empty() && kind() == K::KwEndrecord && !parser().options.declarations &&
        reports().errors() == errorsBefore)
        report(say::EmptyRecord, node->name == kNoToken ? opening : node->name,
               {std::string(textOf(node->name))});
    // An END word of a routine below RECORD was meant as its end.
    constexpr TokenSet kWrong = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap};
    if (kWrong.has(kind()) && startsLine(pos()) && columnOf(pos()) == indentOf(opening)) mark(Mark::WrongEnd);
    if (kind() == K::KwEndmodule && ahead().startsDeclaration(pos() + 1) && peek() != K::KwModule)
        mark(Mark::WrongEnd);
    ends().closeBlock(K::KwEndrecord, opening, node->name != kNoToken || !node->components.empty());
    return finish(node);
}

/// Up to ENDRECORD, or to what no record has. `braced`: the list may end with '}'.
std::span<RecordComponent*> TypeParser::parseComponents(bool braced) {
    const size_t bottom = components_.size();
    while (kind() != K::KwEndrecord && kind() != K::EndOfFile) {
        if (braced && accept(K::RightBrace)) break;
        const bool unusual = kind() == K::Identifier || kStorageWords.has(kind());
        if (unusual && recovery().repair(Place::Component)) continue;
        if (ahead().startsDeclaration(pos())) break;
        if (kind() == K::KwEndmodule || kRoutineEnds.has(kind())) break;
        const TokenIndex before = pos();
        if (isName(kind())) {
            components_.push_back(parseComponent());
        } else {
            unexpected("a component or ENDRECORD");
            take();
            sync().skipInstruction();
        }
        if (pos() == before) take();
    }
    return drain(components_, bottom);
}

RecordComponent* TypeParser::parseComponent() {
    auto* node = make<RecordComponent>(NodeKind::RecordComponent);
    if (isName(kind()) && peek() == K::Semicolon && !isBasicType(textOf(pos())))
        report(say::MissingDataType, pos(), {std::string(textOf(pos()))});
    else
        node->type = names().expectName();
    node->name = names().expectName();
    names().checkNameLength(node->name);
    if (!panic() && kind() == K::LeftBrace) {
        report(say::ComponentArray, pos(), {std::string(textOf(node->name))});
        startPanic();
    }
    sync().endInstruction(kind() == K::Comma ? "';': a component has one name"
                          : kind() == K::Assign || kind() == K::Equal
                              ? "';': a component has no initial value"
                              : "';'");
    return finish(node);
}

Decl* TypeParser::parseAlias(bool local, TokenIndex first) {
    auto* node = make<AliasDecl>(NodeKind::Alias);
    node->first = first;
    node->local = local;
    take();
    node->type = names().expectName();
    if (!panic()) node->name = names().expectName();
    names().checkNameLength(node->name);
    sync().endInstruction(
        kind() == K::LeftBrace ? "';': an alias names a type, arrays are declared with their data" : "';'");
    return finish(node);
}

} // namespace rapid::syntax
