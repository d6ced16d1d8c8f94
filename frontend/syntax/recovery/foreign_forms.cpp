// Blocks, heads and declarations in the form of other languages.

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <algorithm>
#include <utility>

namespace rapid::syntax {

namespace {

/// Blocks of other languages that RAPID writes in a different way. WHILE is what closes DO.
struct ForeignBlock {
    std::string_view word;
    std::string_view closer; ///< "A|B": one of them; "A B": both, in this order
    std::string_view expected;
};
constexpr ForeignBlock kForeignBlocks[] = {
#define FOREIGN_BLOCK(word, closer, expected) {word, closer, expected},
#include "frontend/syntax/recovery/spellings.def"
};

bool isBlank(char c) {
    return c == ' ' || c == '\t';
}

} // namespace

bool ForeignForms::isEndlessLoop() {
    if (panic() || !isContextual(pos(), "LOOP") || !ahead().endsLine(pos()) ||
        kindAt(block().unmatchedWord(pos() + 1)) != K::KwEndwhile)
        return false;
    fix(report(say::ForeignSpelling, pos(), {std::string(textOf(pos())), "WHILE TRUE DO"}), range(pos()),
        "WHILE TRUE DO");
    return true;
}

bool ForeignForms::startsForeignBlock() {
    if (!ahead().endsLine(pos())) return false;
    const std::string word = upperCase(textOf(pos()));
    for (const ForeignBlock& form : kForeignBlocks) {
        if (form.word != word) continue;
        report(say::ForeignSpelling, pos(), {word, std::string(form.expected)});
        block().foreignCloser = form.closer;
        take();
        return true;
    }
    return false;
}

bool ForeignForms::endsForeignBlock() {
    if (!isForeignCloser(pos())) return false;
    const size_t length = block().foreignCloser.find(' ');
    block().foreignCloser.remove_prefix(length == std::string_view::npos ? block().foreignCloser.size()
                                                                         : length + 1);
    take();
    if (!startsLine(pos())) sync().skipInstruction();
    return true;
}

bool ForeignForms::isForeignCloser(TokenIndex i) const {
    std::string_view closers = block().foreignCloser.substr(0, block().foreignCloser.find(' '));
    while (!closers.empty()) {
        const std::string_view one = closers.substr(0, closers.find('|'));
        if (equalsNoCase(textOf(i), one)) return true;
        closers.remove_prefix(std::min(one.size() + 1, closers.size()));
    }
    return false;
}

StmtList ForeignForms::parseBody(const TokenSet& own, const std::string& expected, bool& braced) {
    if ((kind() == K::LeftBrace && recovery().repair(Place::Braces)) || kind() != K::LeftBrace || panic())
        return instructions().parseInstructions(own);
    if (!braced &&
        !reports().joinLast(say::ForeignSpelling.code, range(pos()), "and no '{', but " + expected))
        report(say::ForeignSpelling, pos(), {"{", expected});
    else if (!braced && !reports().last()->fixes.empty())
        reports().last()->fixes.front().certain = false; // the braces are still to be corrected
    braced = true;
    take();
    ++block().braces;
    const StmtList list = instructions().parseInstructions(own, true);
    --block().braces;
    return list;
}

Stmt* ForeignForms::parseBareBraces() {
    const TokenIndex first = pos();
    if (recovery().repair(Place::Braces)) return instructions().errorStmt(first);
    bool braced = false;
    parseBody(block().enclosing, "an instruction: RAPID has no blocks in braces", braced);
    return instructions().errorStmt(first);
}

bool ForeignForms::negatesByComment(std::string_view ending) {
    if (panic() || !startsLine(pos())) return false;
    const std::string_view text = sourceText();
    uint32_t at = range(pos() - 1).end;
    while (at < text.size() && isBlank(text[at]))
        ++at;
    if (at + 1 >= text.size() || text[at] != '!' || text[at + 1] == '!') return false;
    const bool inHead = ending != ";";
    if (isBlank(text[at + 1]) && !inHead) return false;
    std::string_view comment = text.substr(at, text.find_first_of("\r\n", at) - at);
    while (isBlank(comment.back()))
        comment.remove_suffix(1);
    if (comment.size() <= ending.size() ||
        !equalsNoCase(comment.substr(comment.size() - ending.size()), ending))
        return false;
    fix(reportAt(say::ForeignSpelling, {at, at + 1}, {"!", "NOT: '!' begins a comment"}), {at, at + 1},
        "NOT ");
    return true;
}

bool ForeignForms::parseForeignFor(ForStmt* node) {
    if (panic() || kind() != K::LeftParen) return false;
    report(say::ForeignSpelling, pos(), {"(", "a head such as FOR i FROM 1 TO 10 DO"});
    uint32_t depth = 0;
    do {
        if (kind() == K::LeftParen) ++depth;
        if (kind() == K::RightParen) --depth;
        const bool assigned = peek() == K::Assign || peek() == K::Equal || peek() == K::KwFrom;
        if (node->variable == kNoToken && isName(kind()) && assigned) node->variable = pos();
        take();
    } while (depth > 0 && !startsLine(pos()) && kind() != K::EndOfFile);
    node->from = expressions().errorExpr();
    node->to = expressions().errorExpr();
    accept(K::KwDo);
    return true;
}

bool ForeignForms::parseForIn(ForStmt* node) {
    if (panic() || !isName(kind()) || !isContextual(pos() + 1, "IN") || startsLine(pos() + 1)) return false;
    report(say::ForeignSpelling, pos() + 1,
           {std::string(textOf(pos() + 1)), "a head such as FOR i FROM 1 TO 10 DO"});
    node->variable = pos();
    do
        take();
    while (!startsLine(pos()) && kind() != K::EndOfFile);
    node->from = expressions().errorExpr();
    node->to = expressions().errorExpr();
    return true;
}

bool ForeignForms::parseForeignData(DataDecl* node) {
    if (!isName(kind())) return false;
    constexpr TokenSet kAfterName = {K::Semicolon, K::Assign, K::Equal};
    const bool as = isContextual(pos() + 1, "AS") && isName(peek(2));
    const bool colon = peek() == K::Colon && isName(peek(2));
    if (as || colon) {
        report(say::ForeignSpelling, pos() + 1,
               {std::string(textOf(pos() + 1)), "the data type before the name"});
        node->name = take();
        take();
        node->type = take();
        return true;
    }
    if (!kAfterName.has(peek()) || isBasicType(textOf(pos()))) return false; // of a type, the name is missing
    report(say::MissingDataType, pos(), {std::string(textOf(pos()))});
    node->name = take();
    return true;
}

bool ForeignForms::parseForeignParameter(ParamDecl* node) {
    constexpr TokenSet kAfter = {K::Comma, K::RightParen, K::Bar, K::Backslash};
    if (!isName(kind())) return false;
    if (peek() == K::Colon && isName(peek(2))) {
        report(say::ForeignSpelling, pos() + 1, {":", "the data type before the name"});
        node->name = take();
        take();
        node->type = take();
        return true;
    }
    if (!kAfter.has(peek()) || isBasicType(textOf(pos()))) return false;
    if (!std::exchange(parameters().typeMissed, true))
        report(say::MissingDataType, pos(), {std::string(textOf(pos()))});
    node->name = take();
    return true;
}

void ForeignForms::dropForeignMode(ParamDecl* node) {
    if (parser().options.declarations || !isName(peek()) || !isName(peek(2))) return;
    struct Mode {
        std::string_view word, expected, fix;
        ParamMode mode;
    };
    static constexpr Mode kModes[] = {
#define FOREIGN_MODE(word, expected, written, mode) {word, expected, written, ParamMode::mode},
#include "frontend/syntax/recovery/spellings.def"
    };
    for (const Mode& mode : kModes) {
        if (!isContextual(pos(), mode.word)) continue;
        diag::Diagnostic* diagnostic =
            report(say::ForeignSpelling, pos(), {std::string(textOf(pos())), std::string(mode.expected)});
        if (mode.fix.empty())
            fix(diagnostic, {range(pos()).begin, range(pos() + 1).begin}, "");
        else
            fix(diagnostic, range(pos()), std::string(mode.fix));
        node->mode = mode.mode;
        take();
        return;
    }
}

bool ForeignForms::missesComma() {
    constexpr TokenSet kAfter = {K::Comma, K::RightParen, K::Backslash, K::Bar, K::LeftBrace, K::Semicolon};
    const bool semicolon = kind() == K::Semicolon;
    TokenIndex type = semicolon ? pos() + 1 : pos();
    if (kAccessModes.has(kindAt(type))) ++type;
    if (panic() || !isName(kindAt(type)) || !isName(kindAt(type + 1)) || !kAfter.has(kindAt(type + 2)) ||
        startsLine(pos()) || startsLine(type))
        return false;
    const bool isSwitch = isContextual(type, "SWITCH");
    fix(report(say::MissingClosing, pos(),
               {describe(pos()), isSwitch ? "'\\' before a switch" : "',' or ')'"}),
        semicolon ? range(pos()) : endOf(pos() - 1), isSwitch ? "\\" : ",");
    if (semicolon) take();
    if (isSwitch) mark(Mark::SwitchWithoutBackslash);
    return true;
}

} // namespace rapid::syntax
