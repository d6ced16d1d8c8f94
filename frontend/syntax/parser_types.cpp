// Records and aliases (manual 1.2.1).

#include "frontend/syntax/parser_impl.h"

namespace rapid::syntax {

using diag::Code;

Decl* Parser::parseRecord(bool local, TokenIndex first) {
    auto* node = make<RecordDecl>(NodeKind::Record);
    node->first = first;
    node->local = local;
    const TokenIndex opening = take();
    const size_t errorsBefore = errors_;
    const bool nameless = isName(kind()) && isName(peek()) && peek(2) == K::Semicolon &&
                          !startsLine(pos_ + 1); // a component already
    node->name = nameless ? missingName() : expectName();
    checkNameLength(node->name);
    if (!startsLine(pos_)) takeTornName(node->name, {}, true);
    if (panic_ || kind() == K::Semicolon) {
        if (!panic_) unexpected("a component");
        syncStatement();
    }
    const bool braced = kind() == K::LeftBrace;
    if (braced) {
        report(Code::ForeignSpelling, pos_, {"{", "a component: a record ends with ENDRECORD"});
        take();
    }
    const size_t mark = components_.size();
    while (kind() != K::KwEndrecord && kind() != K::EndOfFile) {
        if (braced && accept(K::RightBrace)) break;
        if (isContextual(pos_, "END") && !startsLine(pos_ + 1) && endsLine(pos_ + 1) &&
            (peek() == K::KwRecord || foreignCloserIs(pos_ + 1))) { // "END RECORD"
            retag(pos_, pos_ + 1, K::KwEndrecord);
            ++pos_;
            break;
        }
        if (kind() == K::Identifier && (endsLine(pos_) || peek() == K::Semicolon) &&
            (equalsNoCase(textOf(pos_), "END") || meant(pos_, K::KwEndrecord))) {
            retag(pos_, pos_, K::KwEndrecord);
            break;
        }
        if (startsDecl(pos_) && !dropComponentWord()) break;
        if (kind() == K::KwEndmodule || kRoutineEnds.has(kind())) break;
        const TokenIndex before = pos_;
        if (isName(kind())) {
            components_.push_back(parseComponent());
        } else {
            unexpected("a component or ENDRECORD");
            take();
            syncStatement();
        }
        if (pos_ == before) take();
    }
    node->components = drain(components_, mark);
    if (braced && kindAt(pos_ - 1) == K::RightBrace) {
        accept(K::KwEndrecord);
        return finish(node);
    }
    if (node->components.empty() && kind() == K::KwEndrecord && !options_.declarations &&
        errors_ == errorsBefore)
        report(Code::EmptyRecord, node->name == kNoToken ? opening : node->name,
               {std::string(textOf(node->name))});
    // An END word of a routine below RECORD was meant as its end.
    constexpr TokenSet kWrong = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap};
    if (kWrong.has(kind()) && startsLine(pos_) && columnOf(pos_) == indentOf(opening)) wrongEnd_ = pos_;
    if (kind() == K::KwEndmodule && startsDecl(pos_ + 1) && peek() != K::KwModule) wrongEnd_ = pos_;
    closeBlock(K::KwEndrecord, opening, node->name != kNoToken || !node->components.empty());
    return finish(node);
}

/// "VAR num x;" in a record that is closed by ENDRECORD: the word is reported and left out.
bool Parser::dropComponentWord() {
    if (!kStorageWords.has(kind()) || !isName(peek()) || !isName(peek(2))) return false;
    constexpr TokenIndex kSearch = 200;
    for (TokenIndex i = pos_ + 1; i < pos_ + kSearch && kindAt(i) != K::KwEndrecord; ++i)
        if (i + 1 == pos_ + kSearch || kRoutineEnds.has(kindAt(i)) || kindAt(i) == K::EndOfFile) return false;
    fix(report(Code::ComponentWord, pos_, {describe(pos_)}),
        {tree_.range(pos_).begin, tree_.range(pos_ + 1).begin}, "");
    take();
    return true;
}

RecordComponent* Parser::parseComponent() {
    auto* node = make<RecordComponent>(NodeKind::RecordComponent);
    if (isName(kind()) && peek() == K::Semicolon && !isBasicType(textOf(pos_)))
        report(Code::MissingDataType, pos_, {std::string(textOf(pos_))});
    else
        node->type = expectName();
    node->name = expectName();
    checkNameLength(node->name);
    if (!panic_ && kind() == K::LeftBrace) {
        report(Code::ComponentArray, pos_, {std::string(textOf(node->name))});
        panic_ = true;
    }
    endStatement(kind() == K::Comma                          ? "';': a component has one name"
                 : kind() == K::Assign || kind() == K::Equal ? "';': a component has no initial value"
                                                             : "';'");
    return finish(node);
}

Decl* Parser::parseAlias(bool local, TokenIndex first) {
    auto* node = make<AliasDecl>(NodeKind::Alias);
    node->first = first;
    node->local = local;
    take();
    node->type = expectName();
    if (!panic_) node->name = expectName();
    checkNameLength(node->name);
    endStatement(kind() == K::LeftBrace ? "';': an alias names a type, arrays are declared with their data"
                                        : "';'");
    return finish(node);
}

} // namespace rapid::syntax
