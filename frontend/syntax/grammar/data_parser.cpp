// Data (manual 1.2.2).

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

namespace rapid::syntax {

DataDecl* DataParser::parseData(ScopeWord scope, TokenIndex first, bool ofModule) {
    auto* node = make<DataDecl>(NodeKind::Data);
    const size_t unreadable = reports().unreadable();
    node->first = first;
    node->scope = scope;
    node->dataKind = kind() == K::KwVar    ? DataKind::Var
                     : kind() == K::KwPers ? DataKind::Pers
                                           : DataKind::Const;
    take();
    if (kStorageWords.has(kind()) && isName(peek()) && !startsLine(pos())) {
        fix(report(say::UnexpectedToken, pos(), {describe(pos()), "a data type"}),
            {range(pos()).begin, range(pos() + 1).begin}, "", kind() == kindAt(pos() - 1));
        take();
    }
    const bool typed = isMarked(Mark::RunTogether, pos() - 1); // "VARnum x"
    if (typed) node->type = pos() - 1;
    const bool otherForm = !typed && foreign().parseForeignData(node);
    if (!otherForm && !typed) node->type = names().expectName();
    parseDataTail(node, !otherForm, ofModule);
    node->broken = reports().unreadable() > unreadable;
    return finish(node);
}

DataDecl* DataParser::parseWordlessData() {
    auto* node = make<DataDecl>(NodeKind::Data);
    diag::Diagnostic* diagnostic =
        report(say::UnexpectedToken, pos(), {describe(pos()), "VAR, PERS or CONST before a data type"});
    node->type = take();
    if (kStorageWords.has(kind())) { // "num VAR x;"
        const SourceRange both{range(pos() - 1).begin, range(pos()).end};
        const std::string type(textOf(pos() - 1));
        node->dataKind = kind() == K::KwVar    ? DataKind::Var
                         : kind() == K::KwPers ? DataKind::Pers
                                               : DataKind::Const;
        fix(diagnostic, both, std::string(tokenText(kind())) + " " + type);
        take();
    } else {
        const uint32_t begin = range(node->type).begin;
        fix(diagnostic, {begin, begin}, "VAR ", false);
    }
    parseDataTail(node, true, false);
    return finish(node);
}

/// The rest after the data type: name, dimensions, value, semicolon.
void DataParser::parseDataTail(DataDecl* node, bool nameMissing, bool ofModule) {
    if (!panic() && kind() == K::LeftBrace && nameMissing) parseDimensions(node, true);
    const bool length =
        !node->dims.empty() && kind() == K::Identifier && equalsNoCase(textOf(node->type), "STRING");
    if (length && !panic()) node->dims = {}; // string{80} is a text of that length
    if (!panic() && nameMissing) node->name = names().expectName();
    if (node->name != kNoToken && isKeyword(kindAt(node->name))) names().declareReserved(node->name);
    names().checkNameLength(node->name);
    constexpr TokenSet kAfterName = {K::Semicolon, K::Assign, K::LeftBrace, K::Equal};
    if (!panic() && node->name != kNoToken && kind() == K::Identifier && !startsLine(pos()) &&
        textOf(pos()) == textOf(node->name)) {
        fix(report(say::UnexpectedToken, pos(), {describe(pos()) + " twice", "':=' or ';'"}),
            {range(node->name).end, range(pos()).end}, "");
        take();
    }
    if (kind() != K::Semicolon && kind() != K::Assign) torn().takeTornName(node->name, kAfterName);
    const bool literal = kLiterals.has(kind()) && !startsLine(pos()) && peek() == K::Semicolon;
    const bool valueFollows =
        !panic() && (literal || (kind() == K::LeftBracket && ahead().valueWithoutSign(node->dataKind)));
    if (!panic() && !valueFollows) parseDimensions(node, false);
    if (!panic()) {
        if (valueFollows) {
            diag::Diagnostic* diagnostic =
                report(say::UnexpectedToken, pos(), {describe(pos()), "':=' before the value"});
            fix(diagnostic, {range(pos()).begin, range(pos()).begin}, ":= ");
            node->init = expressions().parseExpression();
        } else if (kind() == K::Equal) {
            if (node->type != kNoToken || textOf(pos()) != "=" ||
                !reports().joinLast(say::MissingDataType.code, range(pos()), "and ':=' here"))
                signs().reportEqual();
            take();
            node->init = expressions().parseExpression();
        } else if (accept(K::Assign)) {
            if (ofModule) node->init = expressions().parsePlainAggregate();
            if (!node->init) node->init = expressions().parseExpression();
        } else if (node->dataKind == DataKind::Const && !parser().options.declarations &&
                   kind() == K::Semicolon) {
            report(say::ConstantWithoutValue, node->name, {std::string(textOf(node->name))});
        }
    }
    noteMoreNames(node);
    const bool parts = kind() == K::Comma && node->init && node->init->kind == NodeKind::Aggregate;
    if (!moreOf_)
        sync().endInstruction(parts        ? "';': a value of several parts is between '[' and ']' as a whole"
                              : node->init ? "';'"
                                           : "':=' or ';'");
}

/// Dimensions in other brackets, or before the name: `num list[10]`, `num{10} list`.
void DataParser::parseDimensions(DataDecl* node, bool beforeName) {
    const K open = kind();
    const bool otherForm = open == K::LeftBracket || open == K::LeftParen;
    if (open != K::LeftBrace && !otherForm) return;
    if (open == K::LeftParen && peek() == K::RightParen && !beforeName) return signs().dropEmptyParentheses();
    diag::Diagnostic* diagnostic = nullptr;
    if (beforeName) {
        report(say::UnexpectedToken, pos(), {describe(pos()), "a name: the dimensions follow it"});
    } else if (otherForm) {
        diagnostic =
            report(say::ForeignSpelling, pos(), {std::string(textOf(pos())), "'{' before the dimensions"});
    }
    const K closing = open == K::LeftBrace ? K::RightBrace : ahead().closingOf(pos());
    const TokenIndex opening = take();
    const size_t countBefore = reports().count();
    node->dims = expressions().parseExpressionList(closing, opening);
    if (diagnostic && !panic() && reports().count() == countBefore)
        diagnostic->fixes.push_back(
            {"put the dimensions between '{' and '}'", {{range(opening), "{"}, {range(pos() - 1), "}"}}});
}

/// `VAR num x, y;`: each name after the first is read as a declaration of its own.
void DataParser::noteMoreNames(const DataDecl* node) {
    if (panic() || kind() != K::Comma || !isName(peek()) || startsLine(pos() + 1)) return;
    report(say::UnexpectedToken, pos(), {describe(pos()), "';': a declaration has one name"});
    moreOf_ = node;
}

DataDecl* DataParser::parseMoreNames() {
    if (!moreOf_) return nullptr;
    const DataDecl* model = moreOf_;
    moreOf_ = nullptr;
    auto* node = make<DataDecl>(NodeKind::Data);
    take(); // the comma
    node->scope = model->scope;
    node->dataKind = model->dataKind;
    node->type = model->type;
    parseDataTail(node, true, false);
    return finish(node);
}

} // namespace rapid::syntax
