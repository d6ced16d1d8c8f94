// Data and routines (manual 1.1.5, 1.2).

#include "frontend/syntax/parser_impl.h"

#include <algorithm>

namespace rapid::syntax {

using diag::Code;

namespace {

constexpr TokenSet kHandlers = {TokenKind::KwBackward, TokenKind::KwError, TokenKind::KwUndo};

} // namespace

RoutineWords wordsOf(RoutineKind kind) {
    switch (kind) {
    case RoutineKind::Proc: break;
    case RoutineKind::Func: return {TokenKind::KwFunc, TokenKind::KwEndfunc, "FUNC"};
    case RoutineKind::Trap: return {TokenKind::KwTrap, TokenKind::KwEndtrap, "TRAP"};
    }
    return {TokenKind::KwProc, TokenKind::KwEndproc, "PROC"};
}

/// Data types that are certainly no procedures: what begins with such a word is a declaration.
bool Parser::isBasicType(std::string_view word) {
    for (const std::string_view type :
         {"NUM", "DNUM", "BOOL", "STRING", "ROBTARGET", "JOINTTARGET", "POS", "ORIENT", "POSE", "INTNUM",
          "TOOLDATA", "WOBJDATA", "SPEEDDATA", "ZONEDATA", "LOADDATA", "CLOCK", "BYTE"})
        if (equalsNoCase(word, type)) return true;
    return false;
}

// ---- Data -----------------------------------------------------------------------------------------------------

/// `VAR type name{dims} := value;`, from the word VAR, PERS or CONST; `first` is that of the scope word.
DataDecl* Parser::parseData(ScopeWord scope, TokenIndex first, bool ofModule) {
    auto* node = make<DataDecl>(NodeKind::Data);
    const size_t unreadable = unreadable_;
    node->first = first;
    node->scope = scope;
    node->dataKind = kind() == K::KwVar    ? DataKind::Var
                     : kind() == K::KwPers ? DataKind::Pers
                                           : DataKind::Const;
    take();
    if (kStorageWords.has(kind()) && isName(peek()) && !startsLine(pos_)) {
        fix(report(Code::UnexpectedToken, pos_, {describe(pos_), "a data type"}),
            {tree_.range(pos_).begin, tree_.range(pos_ + 1).begin}, "", kind() == kindAt(pos_ - 1));
        take();
    }
    const bool typed = runTogether_ != kNoToken && runTogether_ + 1 == pos_; // "VARnum x"
    if (typed) node->type = runTogether_;
    const bool foreign = !typed && parseForeignData(node);
    if (!foreign && !typed) node->type = expectName();
    parseDataTail(node, !foreign, ofModule);
    node->broken = unreadable_ > unreadable;
    return finish(node);
}

/// `num x;`: read as if VAR stood before it.
DataDecl* Parser::parseWordlessData() {
    auto* node = make<DataDecl>(NodeKind::Data);
    diag::Diagnostic* diagnostic =
        report(Code::UnexpectedToken, pos_, {describe(pos_), "VAR, PERS or CONST before a data type"});
    node->type = take();
    if (kStorageWords.has(kind())) { // "num VAR x;"
        const SourceRange both{tree_.range(pos_ - 1).begin, tree_.range(pos_).end};
        const std::string type(textOf(pos_ - 1));
        node->dataKind = kind() == K::KwVar    ? DataKind::Var
                         : kind() == K::KwPers ? DataKind::Pers
                                               : DataKind::Const;
        fix(diagnostic, both, std::string(tokenText(kind())) + " " + type);
        take();
    } else {
        const uint32_t begin = tree_.range(node->type).begin;
        fix(diagnostic, {begin, begin}, "VAR ", false);
    }
    parseDataTail(node, true, false);
    return finish(node);
}

/// What follows the data type: name, dimensions, value, semicolon.
void Parser::parseDataTail(DataDecl* node, bool nameMissing, bool ofModule) {
    if (!panic_ && kind() == K::LeftBrace && nameMissing) parseDimensionsOf(node, true);
    const bool length =
        !node->dims.empty() && kind() == K::Identifier && equalsNoCase(textOf(node->type), "STRING");
    if (length && !panic_) node->dims = {}; // string{80} is a text of that length
    if (!panic_ && nameMissing) node->name = expectName();
    if (node->name != kNoToken && isKeyword(kindAt(node->name))) declareReserved(node->name);
    checkNameLength(node->name);
    constexpr TokenSet kAfterName = {K::Semicolon, K::Assign, K::LeftBrace, K::Equal};
    if (!panic_ && node->name != kNoToken && kind() == K::Identifier && !startsLine(pos_) &&
        textOf(pos_) == textOf(node->name)) {
        fix(report(Code::UnexpectedToken, pos_, {describe(pos_) + " twice", "':=' or ';'"}),
            {tree_.range(node->name).end, tree_.range(pos_).end}, "");
        take();
    }
    if (kind() != K::Semicolon && kind() != K::Assign) takeTornName(node->name, kAfterName);
    constexpr TokenSet kLiterals = {K::NumLiteral, K::StringLiteral, K::KwTrue, K::KwFalse};
    const bool literal = kLiterals.has(kind()) && !startsLine(pos_) && peek() == K::Semicolon;
    const bool valueFollows =
        !panic_ && (literal || (kind() == K::LeftBracket && valueWithoutSign(node->dataKind)));
    if (!panic_ && !valueFollows) parseDimensionsOf(node, false);
    if (!panic_) {
        if (valueFollows) {
            diag::Diagnostic* diagnostic =
                report(Code::UnexpectedToken, pos_, {describe(pos_), "':=' before the value"});
            fix(diagnostic, {tree_.range(pos_).begin, tree_.range(pos_).begin}, ":= ");
            node->init = parseExpr();
        } else if (kind() == K::Equal) {
            if (node->type != kNoToken || textOf(pos_) != "=" ||
                !joinLast(Code::MissingDataType, tree_.range(pos_), "and ':=' here"))
                reportEqual();
            take();
            node->init = parseExpr();
        } else if (accept(K::Assign)) {
            if (ofModule) node->init = parsePlainAggregate();
            if (!node->init) node->init = parseExpr();
        } else if (node->dataKind == DataKind::Const && !options_.declarations && kind() == K::Semicolon) {
            report(Code::ConstantWithoutValue, node->name, {std::string(textOf(node->name))});
        }
    }
    noteMoreNames(node);
    const bool parts = kind() == K::Comma && node->init && node->init->kind == NodeKind::Aggregate;
    if (!moreOf_)
        endStatement(parts        ? "';': a value of several parts stands between '[' and ']' as a whole"
                     : node->init ? "';'"
                                  : "':=' or ';'");
}

// ---- Routines --------------------------------------------------------------------------------------------------

Decl* Parser::parseRoutine(bool local, TokenIndex first) {
    auto* node = make<RoutineDecl>(NodeKind::Routine);
    node->first = first;
    node->local = local;
    node->routineKind = kind() == K::KwProc   ? RoutineKind::Proc
                        : kind() == K::KwFunc ? RoutineKind::Func
                                              : RoutineKind::Trap;
    const TokenIndex opening = take();
    skipSecond(opening);
    const size_t errorsBefore = errors_;
    if (kind() == K::KwLocal && isName(peek()) && !startsLine(pos_)) { // PROC LOCAL name()
        const SourceRange both{tree_.range(opening).begin, tree_.range(pos_).end};
        fix(report(Code::UnexpectedToken, pos_,
                   {"LOCAL", "a name: LOCAL stands before " + describe(opening)}),
            both, (local ? "" : "LOCAL ") + describe(opening));
        node->local = true;
        take();
    }
    if (!options_.declarations) correctRoutineWord(node, opening);
    routineEnd_ = wordsOf(node->routineKind).end;
    parseRoutineHeader(node);
    if (!panic_ && kind() == K::RightParen && !startsLine(pos_)) { // PROC name())
        fix(report(Code::UnexpectedToken, pos_, {describe(pos_), "an instruction or a declaration"}),
            tree_.range(pos_), "");
        take();
    }
    if (kind() == K::Colon) takesColonAs("");
    constexpr TokenSet kNextRoutine = {K::KwProc, K::KwFunc, K::KwTrap, K::KwEndmodule};
    const bool beingWritten = kNextRoutine.has(kind() == K::KwLocal ? peek() : kind()) && startsLine(pos_);
    if (errors_ > errorsBefore && beingWritten) {
        panic_ = false;
        return finish(node);
    }
    if (options_.declarations && isNative()) {
        node->hasBody = false;
        return finish(node);
    }
    const TokenSet outer = enclosing_;
    enclosing_ = TokenSet();
    routineStart_ = pos_;
    endifsCounted_ = false;
    plainError_ = false;
    blockOpening_ = kNoToken;
    compactIf_ = kNoToken;
    foreignCloser_ = {};
    bool braced = false;
    parseRoutineBody(node, braced);
    const bool again = isWrittenTwice(*node, opening);
    if (!again) closeRoutine(node, opening, braced);
    enclosing_ = outer;
    abandoned_ = false;
    panic_ = false;
    return again ? nullptr : finish(node);
}

/// A header, and nothing but the same header below it.
bool Parser::isWrittenTwice(const RoutineDecl& routine, TokenIndex opening) {
    const TokenIndex end = pos_, again = kind() == K::KwLocal ? pos_ + 1 : pos_;
    const bool empty = routine.body.empty() && routine.data.empty() && routine.errors.empty() &&
                       !routine.hasBackward && !routine.hasUndo;
    if (!empty || panic_ || routine.name == kNoToken || kindAt(again) != kindAt(opening)) return false;
    for (TokenIndex i = opening; i < end; ++i)
        if (textOf(i) != textOf(again + i - opening)) return false;
    const SourceRange both{tree_.range(end - 1).end, tree_.range(again + end - 1 - opening).end};
    fix(report(Code::UnexpectedToken, again,
               {"the first line of '" + std::string(textOf(routine.name)) + "' a second time",
                "its instructions"}),
        both, "");
    return true;
}

/// "FUNC name()" with ENDPROC, "PROC num name()" with ENDFUNC, "TRAP name()" with ENDPROC: header and END word agree, so
/// what is wrong is the first word.
void Parser::correctRoutineWord(RoutineDecl* routine, TokenIndex word) {
    if (panic_ || !isName(kind()) || startsLine(pos_)) return;
    const bool typed = isName(peek()) && !startsLine(pos_ + 1);
    const bool list = kindAt(pos_ + (typed ? 2 : 1)) == K::LeftParen;
    if (!list && (typed || !startsLine(pos_ + 1))) return;
    const RoutineKind shape = typed ? RoutineKind::Func : list ? RoutineKind::Proc : RoutineKind::Trap;
    const RoutineWords words = wordsOf(shape);
    if (shape == routine->routineKind || errors_ > kMaxErrorsPerFile || endOfRoutineBelow() != words.end)
        return;
    routine->routineKind = shape;
    const std::string expected(words.name);
    diag::Diagnostic* diagnostic = report(Code::MisspeltKeyword, word, {describe(word), expected});
    fix(diagnostic, tree_.range(word), expected, false);
    note(diagnostic, pos_, "it ends with " + std::string(tokenText(words.end)));
}

/// After the header of a built-in: true when what follows is the next declaration.
bool Parser::isNative() const {
    constexpr TokenSet kNext = {K::KwProc,  K::KwFunc,   K::KwTrap,      K::KwLocal,  K::KwRecord,
                                K::KwAlias, K::KwModule, K::KwEndmodule, K::EndOfFile};
    return kNext.has(kind()) || isTaskDirective(pos_);
}

void Parser::parseRoutineBody(RoutineDecl* routine, bool& braced) {
    const size_t mark = stmts_.size();
    const size_t dataMark = data_.size();
    const RoutineWords words = wordsOf(routine->routineKind);
    const std::string expected = "an instruction: the instructions of " + std::string(words.name) +
                                 " end with " + std::string(tokenText(words.end));
    if (kind() != K::LeftBrace) parseRoutineData();
    StmtList list = parseBody(kRoutineEnds, expected, braced);
    while (!braced && parseNested(routine)) {
        stmts_.insert(stmts_.end(), list.begin(), list.end());
        if (stmts_.size() == mark) parseRoutineData();
        list = parseList(kRoutineEnds);
    }
    routine->data = drain(data_, dataMark);
    if (stmts_.size() == mark) {
        routine->body = list;
    } else { // semicolons between the declarations are empty instructions
        stmts_.insert(stmts_.end(), list.begin(), list.end());
        routine->body = drain(stmts_, mark);
    }
    parseHandlers(routine);
}

/// A routine or type inside a routine: it is nested, and not the next one after a missing END word, when there are
/// enough of these for all routines that follow and for this one.
bool Parser::parseNested(const RoutineDecl* routine) {
    constexpr TokenSet kRoutines = {K::KwProc, K::KwFunc, K::KwTrap};
    constexpr TokenSet kEnds = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap};
    const TokenIndex word = kind() == K::KwLocal ? pos_ + 1 : pos_;
    const bool isRoutine = kRoutines.has(kindAt(word));
    if ((!isRoutine && kindAt(word) != K::KwRecord && kindAt(word) != K::KwAlias) ||
        errors_ >= kMaxErrorsPerFile)
        return false;
    int open = 1;
    for (TokenIndex i = word; kindAt(i) != K::EndOfFile && kindAt(i) != K::KwEndmodule; ++i) {
        if (kRoutines.has(kindAt(i))) ++open;
        if (kEnds.has(kindAt(i))) --open;
    }
    const Nest nest(*this);
    if (open > 0 || !nest) return false;
    report(Code::NestedDeclaration, word,
           {describe(word), routine->name == kNoToken ? std::string() : std::string(textOf(routine->name))});
    const TokenIndex start = routineStart_;
    if (Decl* decl = parseModuleDecl()) decls_.push_back(decl);
    routineStart_ = start;
    endifsCounted_ = false;
    enclosing_ = TokenSet();
    return true;
}

/// The declarations at the beginning; semicolons too many do not end them.
void Parser::parseRoutineData() {
    for (;;) {
        const TokenIndex first = pos_;
        const K k = kind();
        if (k == K::KwVar || k == K::KwPers || k == K::KwConst) {
            data_.push_back(parseData(ScopeWord::None, first));
        } else if (k == K::Semicolon) {
            stmts_.push_back(parseStmt());
        } else if (k == K::PlaceDdn) {
            take();
        } else if ((k == K::KwLocal && (peek() == K::KwVar || peek() == K::KwPers || peek() == K::KwConst)) ||
                   isTaskDirective(pos_)) {
            reportScopeInside(k == K::KwLocal ? ScopeWord::Local : ScopeWord::Task);
            take();
            data_.push_back(parseData(k == K::KwLocal ? ScopeWord::Local : ScopeWord::Task, first));
        } else if (k == K::Comma && moreOf_) {
            data_.push_back(parseMoreNames());
        } else if ((k == K::KwLocal || k == K::KwInout) && isName(peek()) && isName(peek(2)) &&
                   !startsLine(pos_ + 2)) {
            fix(report(Code::UnexpectedToken, pos_, {describe(pos_), "VAR before the data of a routine"}),
                tree_.range(pos_), "VAR", false);
            readAs(pos_, K::KwVar);
            data_.push_back(parseData(ScopeWord::None, first));
        } else if (isWordlessData()) {
            data_.push_back(parseWordlessData());
        } else if (k != K::Identifier || !retagData()) {
            break;
        }
    }
}

/// LOCAL or TASK in front of routine data; PERS there is a mistake of its own.
void Parser::reportScopeInside(ScopeWord scope, bool late) {
    if (peek() == K::KwPers) return;
    fix(report(Code::ScopeInsideRoutine, pos_, {scope == ScopeWord::Local ? "LOCAL" : "TASK"}),
        {tree_.range(pos_).begin, tree_.range(pos_ + 1).begin}, "", !late);
}

void Parser::parseHandlers(RoutineDecl* routine) {
    const size_t mark = handlers_.size();
    K previous = K::EndOfFile;
    while (kHandlers.has(kind())) {
        const K word = kind();
        parseHandler(routine, previous);
        previous = word;
    }
    routine->errors = drain(handlers_, mark);
}

/// BACKWARD, ERROR [(numbers)], UNDO; reported when repeated or out of order.
void Parser::parseHandler(RoutineDecl* routine, K previous) {
    const K word = kind();
    const auto rank = [](K k) {
        return k == K::KwBackward ? 1 : k == K::KwError ? 2 : k == K::KwUndo ? 3 : 0;
    };
    const bool plainError = word == K::KwError && peek() != K::LeftParen;
    const bool repeated = (word == K::KwBackward && routine->hasBackward) ||
                          (word == K::KwUndo && routine->hasUndo) || (plainError && plainError_);
    plainError_ |= plainError;
    if (repeated) {
        report(Code::DuplicateHandler, pos_, {describe(pos_)});
    } else if (word == K::KwBackward && routine->routineKind != RoutineKind::Proc) {
        report(Code::BackwardOutsideProcedure, pos_, {std::string(wordsOf(routine->routineKind).name)});
    } else if (rank(word) < rank(previous)) {
        report(Code::HandlerOrder, pos_, {describe(pos_), std::string(tokenText(previous))});
    }
    auto* clause = make<ErrorClause>(NodeKind::ErrorClause);
    take();
    if (word == K::KwError && kind() == K::LeftParen) {
        const TokenIndex opening = take();
        clause->hasList = true;
        clause->numbers = parseExprList(K::RightParen, opening);
        if (panic_) syncStatement();
    }
    takesColonAs("");
    blockOpening_ = kNoToken;
    const StmtList body = parseList(kRoutineEnds);
    if (word == K::KwError) {
        clause->body = body;
        handlers_.push_back(finish(clause));
    } else if (word == K::KwBackward && !repeated) {
        routine->hasBackward = true;
        routine->backward = body;
    } else if (word == K::KwUndo && !repeated) {
        routine->hasUndo = true;
        routine->undo = body;
    }
}

void Parser::closeRoutine(RoutineDecl* routine, TokenIndex opening, bool braced) {
    const RoutineWords words = wordsOf(routine->routineKind);
    constexpr TokenSet kEnds = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap};
    if (accept(words.end) || braced) return;
    if (!isNewsHere()) return;
    const std::string expected(tokenText(words.end));
    diag::Diagnostic* diagnostic = report(Code::MissingBlockEnd, pos_, {describe(pos_), expected});
    note(diagnostic, opening, std::string(words.name) + " begins here");
    const bool endsModule = kind() == K::KwEndmodule && (peek() == K::KwEndmodule || startsDecl(pos_ + 1)) &&
                            peek() != K::KwModule;
    if (!kEnds.has(kind()) && wrongEnd_ != pos_ && !endsModule) return;
    fix(diagnostic, tree_.range(pos_), expected, false);
    take();
}

} // namespace rapid::syntax
