// What other languages write where RAPID has blocks, negation and declarations of its own: reported once, and read as it
// was meant, so that the rest of the routine keeps its meaning.

#include "frontend/syntax/parser_impl.h"
#include "frontend/syntax/tree_walk.h"

#include <utility>

namespace rapid::syntax {

using diag::Code;

namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\t';
}

} // namespace

// ---- Blocks in braces ------------------------------------------------------------------------------------------

/// At '{' behind a name: does it begin a block? Then the line ends, and what follows is no list of indexes.
bool Parser::isBlockBrace() const {
    if (kind() != K::LeftBrace || !inHead_ || !startsLine(pos_ + 1)) return false;
    // An index goes on to its '}', with ':=' only in the arguments of a call.
    constexpr TokenSet kBlock = {K::Semicolon, K::KwIf,    K::KwFor,  K::KwWhile, K::KwTest,
                                 K::KwReturn,  K::KwRaise, K::KwGoto, K::KwExit,  K::EndOfFile};
    uint32_t depth = 0;
    TokenIndex i = pos_ + 1;
    for (; kindAt(i) != K::RightBrace && !kBlock.has(kindAt(i)); ++i) {
        if (kindAt(i) == K::LeftParen) ++depth;
        if (kindAt(i) == K::RightParen && depth > 0) --depth;
        if (kindAt(i) == K::Assign && depth == 0) return true;
    }
    return kindAt(i) != K::RightBrace || i == pos_ + 1;
}

/// A block in braces: `expected` says how RAPID writes it. The list ends at its '}', or as it should.
StmtList Parser::parseBody(const TokenSet& own, const std::string& expected, bool& braced) {
    if (skipBracedComment() || kind() != K::LeftBrace || panic_) return parseList(own);
    if (!braced && !joinLast(Code::ForeignSpelling, tree_.range(pos_), "and no '{', but " + expected))
        report(Code::ForeignSpelling, pos_, {"{", expected});
    else if (!braced && !lastReport_->fixes.empty())
        lastReport_->fixes.front().certain = false; // the braces are still to be mended
    braced = true;
    take();
    ++braces_;
    const StmtList list = parseList(own, true);
    --braces_;
    return list;
}

/// The END word of a block that may have ended with '}'. Then it is not missed, and one that stands further out belongs
/// to a block around this one.
void Parser::closeBracedBlock(K end, TokenIndex opening, bool whole, bool braced) {
    if (!braced) return closeBlock(end, opening, whole);
    const bool own = !startsLine(pos_) || columnOf(pos_) == indentOf(opening);
    if (own) accept(end);
    panic_ = false;
}

/// `{ text }` in one line, without a semicolon: a comment of another language.
bool Parser::skipBracedComment() {
    if (kind() != K::LeftBrace || panic_) return false;
    TokenIndex close = pos_ + 1;
    while (close < pos_ + kLongLine && !startsLine(close) && kindAt(close) != K::RightBrace &&
           kindAt(close) != K::Semicolon)
        ++close;
    if (kindAt(close) != K::RightBrace || startsLine(close) || close == pos_ + 1) return false;
    report(Code::ForeignSpelling, pos_, {"{", "'!' before a comment"});
    pos_ = close + 1;
    return true;
}

/// Braces that belong to nothing: a block without a word, or a comment.
Stmt* Parser::parseBareBraces() {
    const TokenIndex first = pos_;
    if (skipBracedComment()) return errorStmt(first);
    bool braced = false;
    parseBody(enclosing_, "an instruction: RAPID has no blocks in braces", braced);
    return errorStmt(first);
}

// ---- Heads -----------------------------------------------------------------------------------------------------

/// `:` in place of THEN or DO, or behind a word that takes none.
bool Parser::takesColonAs(std::string_view word) {
    if (panic_ || kind() != K::Colon || startsLine(pos_) || !startsLine(pos_ + 1)) return false;
    if (word.empty()) {
        fix(report(Code::UnexpectedToken, pos_, {describe(pos_), "an instruction"}), tree_.range(pos_), "");
    } else {
        const bool spaced = tree_.range(pos_ - 1).end < tree_.range(pos_).begin;
        const std::string meant = (spaced ? "" : " ") + std::string(word);
        constexpr TokenSet kEnds = kIfEnds | TokenSet{K::KwEndfor, K::KwEndwhile};
        const bool closed = kEnds.has(kindAt(unmatchedWord(pos_ + 1)));
        if (!joinLastEdit(Code::ForeignSpelling, tree_.range(pos_), meant)) // "if a == b:"
            fix(report(Code::MissingBlockWord, pos_, {describe(pos_), std::string(word)}), tree_.range(pos_),
                meant, closed);
        else if (!closed)
            lastReport_->fixes.front().certain = false;
    }
    take();
    return true;
}

/// "IF !ready THEN": the rest of the line is a comment, which ends with this word, and what follows is no operand.
bool Parser::negatesByComment(std::string_view ending) {
    if (panic_ || !startsLine(pos_)) return false;
    const std::string_view text = tree_.source->text();
    uint32_t at = tree_.range(pos_ - 1).end;
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
    fix(reportAt(Code::ForeignSpelling, {at, at + 1}, {"!", "NOT: '!' begins a comment"}), {at, at + 1},
        "NOT ");
    return true;
}

/// `FOR (i = 0; i < 3; i++)`: one report for the head; what is assigned first is the loop variable.
bool Parser::parseForeignFor(ForStmt* node) {
    if (panic_ || kind() != K::LeftParen) return false;
    report(Code::ForeignSpelling, pos_, {"(", "a head such as FOR i FROM 1 TO 10 DO"});
    uint32_t depth = 0;
    do {
        if (kind() == K::LeftParen) ++depth;
        if (kind() == K::RightParen) --depth;
        const bool assigned = peek() == K::Assign || peek() == K::Equal || peek() == K::KwFrom;
        if (node->variable == kNoToken && isName(kind()) && assigned) node->variable = pos_;
        take();
    } while (depth > 0 && !startsLine(pos_) && kind() != K::EndOfFile);
    node->from = errorExpr();
    node->to = errorExpr();
    accept(K::KwDo);
    return true;
}

/// `FOR VAR num i FROM 1 TO 3 DO`: without the words of a declaration. `for i in range(3):`: true, the head has been read.
bool Parser::takesForeignCounter(ForStmt* node) {
    if (panic_) return false;
    if (kStorageWords.has(kind()) && isName(peek())) {
        const TokenIndex name = isName(peek(2)) ? pos_ + 2 : pos_ + 1;
        fix(report(Code::UnexpectedToken, pos_,
                   {describe(pos_), "the name of the loop variable, which FOR declares by itself"}),
            {tree_.range(pos_).begin, tree_.range(name).begin}, "");
        pos_ = name;
        return false;
    }
    if (!isName(kind()) || !isContextual(pos_ + 1, "IN") || startsLine(pos_ + 1)) return false;
    if (TokenIndex to = 0; findOnLine(pos_ + 2, K::KwTo, to)) { // FOR i IN 1 TO 3 DO
        retag(pos_ + 1, pos_ + 1, K::KwFrom);
        return false;
    }
    report(Code::ForeignSpelling, pos_ + 1,
           {std::string(textOf(pos_ + 1)), "a head such as FOR i FROM 1 TO 10 DO"});
    node->variable = pos_;
    do
        take();
    while (!startsLine(pos_) && kind() != K::EndOfFile);
    node->from = errorExpr();
    node->to = errorExpr();
    return true;
}

// ---- Declarations ----------------------------------------------------------------------------------------------

/// `num x;`, `num x := 1;`: a word is missing before the data type.
bool Parser::isWordlessData() const {
    constexpr TokenSet kAfter = {K::Semicolon, K::Assign, K::LeftBrace, K::Equal};
    const TokenIndex name =
        kStorageWords.has(peek()) && !startsLine(pos_ + 1) ? pos_ + 2 : pos_ + 1; // "num VAR x;"
    return kind() == K::Identifier && isBasicType(textOf(pos_)) && isName(kindAt(name)) &&
           !startsLine(name) && kAfter.has(kindAt(name + 1));
}

/// Type and name of data that stand in another order, or without a type: `x : num`, `x AS num`, `x := 1`.
bool Parser::parseForeignData(DataDecl* node) {
    if (!isName(kind())) return false;
    constexpr TokenSet kAfterName = {K::Semicolon, K::Assign, K::Equal};
    const bool as = isContextual(pos_ + 1, "AS") && isName(peek(2));
    const bool colon = peek() == K::Colon && isName(peek(2));
    if (as || colon) {
        report(Code::ForeignSpelling, pos_ + 1,
               {std::string(textOf(pos_ + 1)), "the data type before the name"});
        node->name = take();
        take();
        node->type = take();
        return true;
    }
    if (!kAfterName.has(peek()) || isBasicType(textOf(pos_))) return false; // of a type, the name is missing
    report(Code::MissingDataType, pos_, {std::string(textOf(pos_))});
    node->name = take();
    return true;
}

/// At '[' behind the name of data: what it opens cannot be dimensions, so ":=" is missing before it.
bool Parser::valueWithoutSign(DataKind dataKind) const {
    constexpr TokenSet kDimension = {K::NumLiteral, K::Identifier};
    constexpr TokenIndex kMost = 6; // "[n, 2, 3]"
    bool dimensions = true;
    TokenIndex i = pos_ + 1;
    for (uint32_t open = 1; open > 0; ++i) {
        const K one = kindAt(i);
        if (one == K::EndOfFile || one == K::Semicolon) return false;
        if (one == K::LeftBracket) ++open;
        if (one == K::RightBracket) --open;
        const bool element = (i - pos_) % 2 == 1;
        dimensions = dimensions && i - pos_ <= kMost &&
                     (element ? kDimension.has(one) && textOf(i).find('.') == std::string_view::npos
                              : one == K::Comma || open == 0);
    }
    if (kindAt(i) == K::Assign || kindAt(i) == K::Equal) return false;
    return !dimensions || dataKind == DataKind::Const;
}

/// Dimensions in other brackets, or before the name: `num list[10]`, `num{10} list`.
void Parser::parseDimensionsOf(DataDecl* node, bool beforeName) {
    const K open = kind();
    const bool foreign = open == K::LeftBracket || open == K::LeftParen;
    if (open != K::LeftBrace && !foreign) return;
    if (open == K::LeftParen && peek() == K::RightParen && !beforeName) return dropEmptyParentheses();
    diag::Diagnostic* diagnostic = nullptr;
    if (beforeName) {
        report(Code::UnexpectedToken, pos_, {describe(pos_), "a name: the dimensions stand behind it"});
    } else if (foreign) {
        diagnostic =
            report(Code::ForeignSpelling, pos_, {std::string(textOf(pos_)), "'{' before the dimensions"});
    }
    const K closing = open == K::LeftBrace ? K::RightBrace : closingOf(pos_);
    const TokenIndex opening = take();
    const size_t reported = sink_.all().size();
    node->dims = parseExprList(closing, opening);
    if (diagnostic && !panic_ && sink_.all().size() == reported)
        diagnostic->fixes.push_back({"put the dimensions between '{' and '}'",
                                     {{tree_.range(opening), "{"}, {tree_.range(pos_ - 1), "}"}}});
}

/// `VAR num x();`, `x() := 1;`
void Parser::dropEmptyParentheses() {
    const SourceRange both{tree_.range(pos_).begin, tree_.range(pos_ + 1).end};
    if (kind() == K::LeftParen)
        fix(reportAt(Code::UnexpectedToken, both, {"'()'", "no parentheses behind the name of data"}), both,
            "");
    else
        fix(report(Code::ForeignSpelling, pos_,
                   {std::string(textOf(pos_)), "'(' before the arguments of a function"}),
            both, "()", false);
    take();
    take();
}

/// Behind "name[...]": an array was indexed, or a function was called.
void Parser::fixBrackets(diag::Diagnostic* diagnostic, const IndexExpr& node, TokenIndex opening) {
    const SourceRange first = tree_.range(opening), last = tree_.range(pos_ - 1);
    const bool called = kindAt(opening) == K::LeftBracket && kindAt(pos_ - 1) == K::RightParen;
    constexpr size_t kMostDimensions = 3;
    const bool indexed = node.indices.size() <= kMostDimensions &&
                         std::all_of(node.indices.begin(), node.indices.end(),
                                     [&](const Expr* index) { return mayBeIndex(*index); });
    if (indexed) {
        const bool certain =
            !called && (node.base->kind != NodeKind::Name || isArrayOfFile(as<NameExpr>(*node.base).name));
        diagnostic->fixes.push_back(
            {"put the index between '{' and '}'", {{first, "{"}, {last, "}"}}, certain});
        return;
    }
    if (!called) diagnostic->message += ", or '(' before the arguments of a function";
    diagnostic->fixes.push_back(
        {"put the arguments between '(' and ')'", {{first, "("}, {last, ")"}}, false});
}

/// Neither a text, a list, a truth value nor a number that is no place in an array.
bool Parser::mayBeIndex(const Expr& index) const {
    const Expr& inner = bare(index);
    if (inner.kind == NodeKind::NumLiteral) {
        const std::string_view digits = textOf(inner.first);
        return digits[0] != '0' && digits.find('.') == std::string_view::npos;
    }
    return inner.kind == NodeKind::Name || inner.kind == NodeKind::Binary || inner.kind == NodeKind::Index ||
           inner.kind == NodeKind::Component || inner.kind == NodeKind::Call;
}

/// Is this name declared in the file with dimensions, "num name{3}"?
bool Parser::isArrayOfFile(TokenIndex name) {
    constexpr TokenSet kOpens = {K::LeftBrace, K::LeftBracket, K::LeftParen};
    constexpr TokenSet kRoutines = {K::KwProc, K::KwFunc};
    if (searched_ >= kMostWords) return false;
    searched_ += last_;
    const std::string upper = upperCase(textOf(name));
    for (TokenIndex i = 2; i < last_; ++i) {
        const bool declared = tokens_[i].length == upper.size() && isName(kindAt(i - 1)) && !startsLine(i) &&
                              kOpens.has(kindAt(i + 1)) && !kRoutines.has(kindAt(i - 2));
        if (declared && equalsNoCase(textOf(i), upper)) return true;
    }
    return false;
}

/// `VAR num x, y;`: each name after the first is read as a declaration of its own.
void Parser::noteMoreNames(const DataDecl* node) {
    if (panic_ || kind() != K::Comma || !isName(peek()) || startsLine(pos_ + 1)) return;
    report(Code::UnexpectedToken, pos_, {describe(pos_), "';': a declaration has one name"});
    moreOf_ = node;
}

DataDecl* Parser::parseMoreNames() {
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

/// A parameter without a data type, or with it behind the name; true when it has been read.
bool Parser::parseForeignParameter(ParamDecl* node) {
    constexpr TokenSet kAfter = {K::Comma, K::RightParen, K::Bar, K::Backslash};
    if (!isName(kind())) return false;
    if (peek() == K::Colon && isName(peek(2))) {
        report(Code::ForeignSpelling, pos_ + 1, {":", "the data type before the name"});
        node->name = take();
        take();
        node->type = take();
        return true;
    }
    if (!kAfter.has(peek()) || isBasicType(textOf(pos_))) return false;
    if (!std::exchange(typeMissed_, true)) report(Code::MissingDataType, pos_, {std::string(textOf(pos_))});
    node->name = take();
    return true;
}

/// `num a num b`, `num a; num b`: another parameter, whose comma is missing.
bool Parser::missesComma() {
    constexpr TokenSet kAfter = {K::Comma, K::RightParen, K::Backslash, K::Bar, K::LeftBrace, K::Semicolon};
    const bool semicolon = kind() == K::Semicolon;
    TokenIndex type = semicolon ? pos_ + 1 : pos_;
    if (kAccessModes.has(kindAt(type))) ++type;
    if (panic_ || !isName(kindAt(type)) || !isName(kindAt(type + 1)) || !kAfter.has(kindAt(type + 2)) ||
        startsLine(pos_) || startsLine(type))
        return false;
    const bool isSwitch = isContextual(type, "SWITCH");
    fix(report(Code::MissingClosing, pos_,
               {describe(pos_), isSwitch ? "'\\' before a switch" : "',' or ')'"}),
        semicolon ? tree_.range(pos_) : endOf(pos_ - 1), isSwitch ? "\\" : ",");
    if (semicolon) take();
    if (isSwitch) switchMarked_ = pos_;
    return true;
}

/// Whether a ')' without '(' comes before anything that no list of parameters has.
bool Parser::listClosesBelow(TokenIndex from) const {
    constexpr TokenIndex kSearch = 100;
    constexpr TokenSet kOfParameters = {K::Identifier, K::Comma,     K::Semicolon,  K::Backslash,
                                        K::Bar,        K::LeftBrace, K::RightBrace, K::Star,
                                        K::KwVar,      K::KwPers,    K::KwInout};
    for (TokenIndex i = from; i < from + kSearch; ++i) {
        if (kindAt(i) == K::RightParen) return true;
        if (!kOfParameters.has(kindAt(i))) return false;
    }
    return false;
}

/// A line that ends with ';' and has what no list of parameters has: a value, a name alone between commas.
bool Parser::isInstructionLine() const {
    constexpr TokenSet kValues = {K::NumLiteral, K::StringLiteral, K::Assign, K::LeftBracket};
    constexpr TokenSet kAlone = {K::Comma, K::Semicolon};
    bool instruction = peek() == K::Backslash || // or "Incr count;"
                       (isName(peek()) && peek(2) == K::Semicolon && !isBasicType(textOf(pos_)) &&
                        !listClosesBelow(pos_ + 3));
    TokenIndex i = pos_;
    uint32_t depth = 0;
    for (; i < pos_ + kLongLine && !startsLine(i + 1); ++i) {
        if (kindAt(i) == K::LeftParen) ++depth;
        if (kindAt(i) == K::RightParen && depth-- == 0) return false;
        instruction = instruction || kValues.has(kindAt(i)) || depth > 0 ||
                      (kindAt(i) == K::Comma && isName(kindAt(i + 1)) && kAlone.has(kindAt(i + 2)));
    }
    return instruction && kindAt(i) == K::Semicolon;
}

/// In a line below '(': an instruction or a declaration with its semicolon, and no parameter.
bool Parser::bodyBeginsHere() const {
    constexpr TokenSet kNoParameter = {K::Assign, K::Semicolon, K::NumLiteral, K::StringLiteral};
    constexpr TokenSet kEndOfData = {K::Semicolon, K::Assign};
    if (isName(kind())) return kNoParameter.has(peek()) || isInstructionLine();
    if (kind() == K::KwVar || kind() == K::KwPers) return kEndOfData.has(peek(3));
    return isKeyword(kind()) && kind() != K::KwInout;
}

/// `num a /num b`
void Parser::takeSlashAsBackslash() {
    if (!isName(peek())) return;
    fix(report(Code::ForeignSpelling, pos_, {"/", "'\\' before an optional parameter"}), tree_.range(pos_),
        "\\");
    readAs(pos_, K::Backslash);
}

/// IN, REF, OUT ... before a parameter: reported and left out.
void Parser::dropForeignMode(ParamDecl* node) {
    if (options_.declarations || !isName(peek()) || !isName(peek(2))) return;
    struct Mode {
        std::string_view word, expected, fix;
        ParamMode mode;
    };
    static constexpr Mode kModes[] = {
        {"IN", "the data type: IN is what has no word", "", ParamMode::In},
        {"BYVAL", "the data type: what has no word is passed by value", "", ParamMode::In},
        {"REF", "INOUT", "INOUT", ParamMode::Inout},
        {"BYREF", "INOUT", "INOUT", ParamMode::Inout},
        {"OUT", "INOUT", "INOUT", ParamMode::Inout}};
    for (const Mode& mode : kModes) {
        if (!isContextual(pos_, mode.word)) continue;
        diag::Diagnostic* diagnostic =
            report(Code::ForeignSpelling, pos_, {std::string(textOf(pos_)), std::string(mode.expected)});
        if (mode.fix.empty())
            fix(diagnostic, {tree_.range(pos_).begin, tree_.range(pos_ + 1).begin}, "");
        else
            fix(diagnostic, tree_.range(pos_), std::string(mode.fix));
        node->mode = mode.mode;
        take();
        return;
    }
}

// ---- Lists and comments ----------------------------------------------------------------------------------------

/// `(1, 2, 3)` and `{1, 2, 3}` as a value, before or behind its first member.
Expr* Parser::parseForeignAggregate(TokenIndex opening, K closing) {
    auto* node = makeExpr<ErrorExpr>(NodeKind::ErrorExpr);
    node->first = opening;
    diag::Diagnostic* diagnostic =
        report(Code::ForeignSpelling, opening,
               {std::string(textOf(opening)), "'[' around the values of a record or an array"});
    const size_t reported = sink_.all().size();
    take();
    parseExprList(closing, opening);
    if (diagnostic && !panic_ && sink_.all().size() == reported)
        diagnostic->fixes.push_back({"put the values between '[' and ']'",
                                     {{tree_.range(opening), "["}, {tree_.range(pos_ - 1), "]"}},
                                     kindAt(opening - 1) != K::LeftParen});
    height_ = 1;
    return finish(node);
}

/// Four words or more in a line, and nothing between them that an instruction has.
bool Parser::isProse() const {
    constexpr TokenSet kOfBlocks = {K::KwThen, K::KwDo, K::KwFrom, K::KwWith, K::KwEndif, K::KwElse};
    constexpr TokenIndex kFewest = 4;
    if (!startsLine(pos_) || isBasicType(textOf(pos_ + 1))) return false;
    TokenIndex i = pos_;
    while (i < last_ && (i == pos_ || !startsLine(i)) &&
           (kindAt(i) == K::Identifier || (isKeyword(kindAt(i)) && !kOfBlocks.has(kindAt(i)))))
        ++i;
    const bool ends =
        startsLine(i) || ((kindAt(i) == K::Dot || kindAt(i) == K::Question) && startsLine(i + 1));
    return ends && i - pos_ >= kFewest;
}

/// "REM text", "-- text", and text with nothing before it: the line is skipped.
bool Parser::skipForeignComment() {
    if (kind() == K::Identifier && isProse()) {
        const SourceRange words{tree_.range(pos_).begin, tree_.range(pos_ + 1).end};
        const auto shown = std::string(tree_.source->text().substr(words.begin, words.end - words.begin));
        fix(reportAt(Code::ForeignSpelling, words, {shown, "an instruction, or '!' before a comment"}),
            {words.begin, words.begin}, "! ", false);
        do
            take();
        while (!startsLine(pos_) && kind() != K::EndOfFile);
        return true;
    }
    const bool dashes = kind() == K::Minus && peek() == K::Minus;
    if (!dashes) {
        if (!isContextual(pos_, "REM") || startsLine(pos_ + 1) || kindAt(pos_ + 1) == K::Semicolon)
            return false;
        TokenIndex last = pos_; // with a semicolon it is a call
        while (last < pos_ + kLongLine && !startsLine(last + 1))
            ++last;
        if (kindAt(last) == K::Semicolon) return false;
    }
    const SourceRange range{tree_.range(pos_).begin, tree_.range(dashes ? pos_ + 1 : pos_).end};
    fix(reportAt(Code::ForeignSpelling, range, {dashes ? "--" : "REM", "'!' before a comment"}), range, "!");
    do
        take();
    while (!startsLine(pos_) && kind() != K::EndOfFile);
    return true;
}

} // namespace rapid::syntax
