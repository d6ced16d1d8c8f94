// Routines (manual 1.1.5).

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

#include <algorithm>

namespace rapid::syntax {

namespace {

constexpr TokenSet kHandlers = {TokenKind::KwBackward, TokenKind::KwError, TokenKind::KwUndo};

} // namespace

Decl* RoutineParser::parseRoutine(bool local, TokenIndex first) {
    auto* node = make<RoutineDecl>(NodeKind::Routine);
    node->first = first;
    node->local = local;
    node->routineKind = kind() == K::KwProc   ? RoutineKind::Proc
                        : kind() == K::KwFunc ? RoutineKind::Func
                                              : RoutineKind::Trap;
    const TokenIndex opening = take();
    names().skipSecond(opening);
    const size_t errorsBefore = reports().errors();
    if (kind() == K::KwLocal && isName(peek()) && !startsLine(pos())) { // PROC LOCAL name()
        const SourceRange both{range(opening).begin, range(pos()).end};
        fix(report(say::UnexpectedToken, pos(), {"LOCAL", "a name: LOCAL is before " + describe(opening)}),
            both, (local ? "" : "LOCAL ") + describe(opening));
        node->local = true;
        take();
    }
    if (!parser().options.declarations) correctRoutineWord(node, opening);
    block().routineEnd = wordsOf(node->routineKind).end;
    parseRoutineHeader(node);
    if (!panic() && kind() == K::RightParen && !startsLine(pos())) { // PROC name())
        fix(report(say::UnexpectedToken, pos(), {describe(pos()), "an instruction or a declaration"}),
            range(pos()), "");
        take();
    }
    if (kind() == K::Colon) signs().takesColonAs("");
    constexpr TokenSet kNextRoutine = {K::KwProc, K::KwFunc, K::KwTrap, K::KwEndmodule};
    const bool beingWritten = kNextRoutine.has(kind() == K::KwLocal ? peek() : kind()) && startsLine(pos());
    if (reports().errors() > errorsBefore && beingWritten) {
        endPanic();
        return finish(node);
    }
    if (parser().options.declarations && ahead().isNative()) {
        node->hasBody = false;
        return finish(node);
    }
    const TokenSet outer = block().enclosing;
    block().enclosing = TokenSet();
    block().routineStart = pos();
    block().endifsCounted = false;
    block().plainError = false;
    block().opening = kNoToken;
    block().compactIf = kNoToken;
    block().foreignCloser = {};
    bool braced = false;
    parseRoutineBody(node, braced);
    const bool again = isWrittenTwice(*node, opening);
    if (!again) closeRoutine(node, opening, braced);
    block().enclosing = outer;
    block().abandoned = false;
    endPanic();
    return again ? nullptr : finish(node);
}

/// A header, and nothing but the same header below it.
bool RoutineParser::isWrittenTwice(const RoutineDecl& routine, TokenIndex opening) {
    const TokenIndex end = pos(), again = kind() == K::KwLocal ? pos() + 1 : pos();
    const bool empty = routine.body.empty() && routine.data.empty() && routine.errors.empty() &&
                       !routine.hasBackward && !routine.hasUndo;
    if (!empty || panic() || routine.name == kNoToken || kindAt(again) != kindAt(opening)) return false;
    for (TokenIndex i = opening; i < end; ++i)
        if (textOf(i) != textOf(again + i - opening)) return false;
    const SourceRange both{range(end - 1).end, range(again + end - 1 - opening).end};
    fix(report(say::UnexpectedToken, again,
               {"the first line of '" + std::string(textOf(routine.name)) + "' a second time",
                "its instructions"}),
        both, "");
    return true;
}

/// "FUNC name()" with ENDPROC, "PROC num name()" with ENDFUNC, "TRAP name()" with ENDPROC: header and END word agree, so
/// what is wrong is the first word.
void RoutineParser::correctRoutineWord(RoutineDecl* routine, TokenIndex word) {
    if (panic() || !isName(kind()) || startsLine(pos())) return;
    const bool typed = isName(peek()) && !startsLine(pos() + 1);
    const bool list = kindAt(pos() + (typed ? 2 : 1)) == K::LeftParen;
    if (!list && (typed || !startsLine(pos() + 1))) return;
    const RoutineKind shape = typed ? RoutineKind::Func : list ? RoutineKind::Proc : RoutineKind::Trap;
    const RoutineWords words = wordsOf(shape);
    if (shape == routine->routineKind || reports().isFull() || block().endOfRoutineBelow() != words.end)
        return;
    routine->routineKind = shape;
    const std::string expected(words.name);
    diag::Diagnostic* diagnostic = report(say::MisspeltKeyword, word, {describe(word), expected});
    fix(diagnostic, range(word), expected, false);
    note(diagnostic, pos(), "it ends with " + std::string(tokenText(words.end)));
}

void RoutineParser::parseRoutineHeader(RoutineDecl* routine) {
    const bool typeMissed = parseReturnType(routine);
    if (!panic() && routine->name == kNoToken)
        routine->name = isMarked(Mark::RunTogether, pos() - 1) ? pos() - 1 : names().expectName();
    names().checkNameLength(routine->name);
    const bool isTrap = routine->routineKind == RoutineKind::Trap;
    routine->broken |=
        torn().takeTornName(routine->name, isTrap ? TokenSet() : TokenSet{K::LeftParen}, isTrap);
    if (isTrap) {
        if (kind() == K::LeftParen && !panic()) {
            const TokenIndex opening = pos();
            diag::Diagnostic* diagnostic =
                report(say::TrapParameters, pos(), {std::string(textOf(routine->name))});
            if (peek() == K::RightParen) fix(diagnostic, {range(opening).begin, range(opening + 1).end}, "");
            parameters().parseParameters(routine);
            routine->params = {};
        }
    } else if (panic() || kind() == K::LeftParen) {
        parameters().parseParameters(routine);
        if (typeMissed && isName(kind()) && !startsLine(pos()) && startsLine(pos() + 1))
            routine->returnType = take(); // FUNC name(...) num
    } else {
        parameters().parseParametersWithoutParen(routine);
    }
}

/// The data type of a function, or one in a place without. True: that of a function is missing.
bool RoutineParser::parseReturnType(RoutineDecl* routine) {
    if (routine->routineKind == RoutineKind::Func) {
        const bool typed = isMarked(Mark::RunTogether, pos() - 1); // "FUNCnum name("
        routine->returnType = typed ? pos() - 1 : names().expectName();
        if (!panic() && kind() == K::LeftParen && !startsLine(pos())) { // FUNC name(...)
            routine->name = routine->returnType;
            routine->returnType = kNoToken;
            report(say::MissingReturnType, routine->name, {std::string(textOf(routine->name))});
            return true;
        }
        if (!panic() && kind() == K::LeftBrace) { // FUNC num{3} name()
            report(say::ArrayReturn, pos());
            routine->returnType = kNoToken;
            while (kind() != K::RightBrace && kind() != K::EndOfFile && !startsLine(pos()))
                take();
            accept(K::RightBrace);
        }
    } else if (isName(kind()) && isName(peek()) && !startsLine(pos() + 1) && !isTornRoutineName() &&
               !ahead().lacksParenthesis(pos()) &&
               (routine->routineKind == RoutineKind::Proc ? !isName(peek(2)) || startsLine(pos() + 2)
                                                          : isBasicType(textOf(pos())))) { // PROC num name()
        fix(report(say::ReturnTypeUnexpected, pos(),
                   {std::string(textOf(pos())), std::string(wordsOf(routine->routineKind).name)}),
            {range(pos()).begin, range(pos() + 1).begin}, "");
        take();
    }
    return false;
}

/// "PROC Pick Part()": the two words are not a data type and a name.
bool RoutineParser::isTornRoutineName() {
    constexpr std::string_view kData = "data";
    const std::string_view word = textOf(pos());
    if (isBasicType(word) || peek(2) != K::LeftParen) return false;
    const bool isData =
        word.size() > kData.size() && equalsNoCase(word.substr(word.size() - kData.size()), kData);
    return !isData || !torn().tornName(pos() + 1).empty();
}

void RoutineParser::parseRoutineBody(RoutineDecl* routine, bool& braced) {
    const size_t bottom = nodes().stmts.size();
    const size_t dataMark = data_.size();
    const RoutineWords words = wordsOf(routine->routineKind);
    const std::string expected = "an instruction: the instructions of " + std::string(words.name) +
                                 " end with " + std::string(tokenText(words.end));
    if (kind() != K::LeftBrace) parseRoutineData();
    StmtList list = foreign().parseBody(kRoutineEnds, expected, braced);
    while (!braced && parseNested(routine)) {
        nodes().stmts.insert(nodes().stmts.end(), list.begin(), list.end());
        if (nodes().stmts.size() == bottom) parseRoutineData();
        list = instructions().parseInstructions(kRoutineEnds);
    }
    routine->data = drain(data_, dataMark);
    if (nodes().stmts.size() == bottom) {
        routine->body = list;
    } else { // semicolons between the declarations are empty instructions
        nodes().stmts.insert(nodes().stmts.end(), list.begin(), list.end());
        routine->body = drain(nodes().stmts, bottom);
    }
    parseHandlers(routine);
}

/// A routine or type inside a routine: it is nested, and not the next one after a missing END word, when there are
/// enough of these for all routines that follow and for this one.
bool RoutineParser::parseNested(const RoutineDecl* routine) {
    constexpr TokenSet kRoutines = {K::KwProc, K::KwFunc, K::KwTrap};
    constexpr TokenSet kEnds = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap};
    const TokenIndex word = kind() == K::KwLocal ? pos() + 1 : pos();
    const bool isRoutine = kRoutines.has(kindAt(word));
    if ((!isRoutine && kindAt(word) != K::KwRecord && kindAt(word) != K::KwAlias) ||
        reports().errors() >= kMaxErrorsPerFile)
        return false;
    int open = 1;
    for (TokenIndex i = word; kindAt(i) != K::EndOfFile && kindAt(i) != K::KwEndmodule; ++i) {
        if (kRoutines.has(kindAt(i))) ++open;
        if (kEnds.has(kindAt(i))) --open;
    }
    const Nest nest(nodes());
    if (open > 0 || !nest) return false;
    report(say::NestedDeclaration, word,
           {describe(word), routine->name == kNoToken ? std::string() : std::string(textOf(routine->name))});
    const TokenIndex start = block().routineStart;
    if (Decl* decl = modules().parseDeclaration()) nodes().decls.push_back(decl);
    block().routineStart = start;
    block().endifsCounted = false;
    block().enclosing = TokenSet();
    return true;
}

/// The declarations at the beginning; semicolons too many do not end them.
void RoutineParser::parseRoutineData() {
    for (;;) {
        const TokenIndex first = pos();
        const K k = kind();
        if (k == K::KwVar || k == K::KwPers || k == K::KwConst) {
            data_.push_back(data().parseData(ScopeWord::None, first));
        } else if (k == K::Semicolon) {
            nodes().stmts.push_back(instructions().parseInstruction());
        } else if (k == K::PlaceDdn) {
            take();
        } else if ((k == K::KwLocal && (peek() == K::KwVar || peek() == K::KwPers || peek() == K::KwConst)) ||
                   isTaskDirective(pos())) {
            reportScopeInside(k == K::KwLocal ? ScopeWord::Local : ScopeWord::Task);
            take();
            data_.push_back(data().parseData(k == K::KwLocal ? ScopeWord::Local : ScopeWord::Task, first));
        } else if (k == K::Comma && data().hasMoreNames()) {
            data_.push_back(data().parseMoreNames());
        } else if ((k == K::KwLocal || k == K::KwInout) && isName(peek()) && isName(peek(2)) &&
                   !startsLine(pos() + 2)) {
            fix(report(say::UnexpectedToken, pos(), {describe(pos()), "VAR before the data of a routine"}),
                range(pos()), "VAR", false);
            readAs(pos(), K::KwVar);
            data_.push_back(data().parseData(ScopeWord::None, first));
        } else if (ahead().isWordlessData()) {
            data_.push_back(data().parseWordlessData());
        } else if (k != K::Identifier || !recovery().repair(Place::Data)) {
            break;
        }
    }
}

void RoutineParser::reportScopeInside(ScopeWord scope, bool late) {
    if (peek() == K::KwPers) return;
    fix(report(say::ScopeInsideRoutine, pos(), {scope == ScopeWord::Local ? "LOCAL" : "TASK"}),
        {range(pos()).begin, range(pos() + 1).begin}, "", !late);
}

void RoutineParser::parseHandlers(RoutineDecl* routine) {
    const size_t bottom = handlers_.size();
    K previous = K::EndOfFile;
    while (kHandlers.has(kind())) {
        const K word = kind();
        parseHandler(routine, previous);
        previous = word;
    }
    routine->errors = drain(handlers_, bottom);
}

/// BACKWARD, ERROR [(numbers)], UNDO; reported when repeated or out of order.
void RoutineParser::parseHandler(RoutineDecl* routine, K previous) {
    const K word = kind();
    const auto rank = [](K k) {
        return k == K::KwBackward ? 1 : k == K::KwError ? 2 : k == K::KwUndo ? 3 : 0;
    };
    const bool plainError = word == K::KwError && peek() != K::LeftParen;
    const bool repeated = (word == K::KwBackward && routine->hasBackward) ||
                          (word == K::KwUndo && routine->hasUndo) || (plainError && block().plainError);
    block().plainError |= plainError;
    if (repeated) {
        report(say::DuplicateHandler, pos(), {describe(pos())});
    } else if (word == K::KwBackward && routine->routineKind != RoutineKind::Proc) {
        report(say::BackwardOutsideProcedure, pos(), {std::string(wordsOf(routine->routineKind).name)});
    } else if (rank(word) < rank(previous)) {
        report(say::HandlerOrder, pos(), {describe(pos()), std::string(tokenText(previous))});
    }
    auto* clause = make<ErrorClause>(NodeKind::ErrorClause);
    take();
    if (word == K::KwError && kind() == K::LeftParen) {
        const TokenIndex opening = take();
        clause->hasList = true;
        clause->numbers = expressions().parseExpressionList(K::RightParen, opening);
        if (panic()) sync().skipInstruction();
    }
    signs().takesColonAs("");
    block().opening = kNoToken;
    const StmtList body = instructions().parseInstructions(kRoutineEnds);
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

void RoutineParser::closeRoutine(RoutineDecl* routine, TokenIndex opening, bool braced) {
    const RoutineWords words = wordsOf(routine->routineKind);
    constexpr TokenSet kEnds = {K::KwEndproc, K::KwEndfunc, K::KwEndtrap};
    if (accept(words.end) || braced) return;
    routine->closed = false;
    const bool endsModule = kind() == K::KwEndmodule &&
                            (peek() == K::KwEndmodule || ahead().startsDeclaration(pos() + 1)) &&
                            peek() != K::KwModule;
    const bool isOtherEnd = kEnds.has(kind()) || isMarked(Mark::WrongEnd) || endsModule;
    if (!reports().mayReportEnd() && !isOtherEnd) return;
    const std::string expected(tokenText(words.end));
    diag::Diagnostic* diagnostic = report(say::MissingBlockEnd, pos(), {describe(pos()), expected});
    note(diagnostic, opening, std::string(words.name) + " begins here");
    if (!isOtherEnd) return;
    fix(diagnostic, range(pos()), expected, false);
    take();
    routine->closed = true;
}

} // namespace rapid::syntax
