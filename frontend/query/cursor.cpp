#include "frontend/query/cursor.h"

#include "frontend/query/argument_scan.h"
#include "frontend/sema/names.h"
#include "frontend/syntax/token_set.h"

#include <algorithm>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

/// Instructions begin after these; so do declarations.
constexpr TokenSet kEndsPart = {TokenKind::Semicolon,   TokenKind::Colon,      TokenKind::KwThen,
                                TokenKind::KwDo,        TokenKind::KwElse,     TokenKind::KwEndif,
                                TokenKind::KwEndfor,    TokenKind::KwEndwhile, TokenKind::KwEndtest,
                                TokenKind::KwEndproc,   TokenKind::KwEndfunc,  TokenKind::KwEndtrap,
                                TokenKind::KwBackward,  TokenKind::KwUndo,     TokenKind::KwEndrecord,
                                TokenKind::KwEndmodule, TokenKind::FileHeader, TokenKind::PlaceSmt,
                                TokenKind::PlaceDdn,    TokenKind::PlaceTdn,   TokenKind::PlaceRdn};
/// An instruction or declaration begins with these, wherever they are.
constexpr TokenSet kBeginsPart = {
    TokenKind::KwIf,      TokenKind::KwElseif, TokenKind::KwFor,   TokenKind::KwWhile, TokenKind::KwTest,
    TokenKind::KwCase,    TokenKind::KwReturn, TokenKind::KwRaise, TokenKind::KwGoto,  TokenKind::KwConnect,
    TokenKind::KwLocal,   TokenKind::KwProc,   TokenKind::KwFunc,  TokenKind::KwTrap,  TokenKind::KwRecord,
    TokenKind::KwAlias,   TokenKind::KwModule, TokenKind::KwError, TokenKind::KwExit,  TokenKind::KwRetry,
    TokenKind::KwTrynext, TokenKind::KwDefault};
constexpr TokenSet kModeWords = {TokenKind::KwVar, TokenKind::KwPers, TokenKind::KwInout, TokenKind::KwConst};
constexpr TokenSet kBeforeParameter = {TokenKind::LeftParen, TokenKind::Comma, TokenKind::Backslash,
                                       TokenKind::Bar};

/// Classifies what is written at the offset by the tokens of its instruction.
class CursorReader {
  public:
    CursorReader(const Scope& scope, uint32_t offset)
        : scope_(scope), file_(scope.file()), tree_(*file_.tree), offset_(offset) {}

    Cursor read() {
        cursor_.word = {offset_, offset_};
        if (isInComment(file_, offset_)) return cursor_;
        if (isInString(file_, offset_)) {
            inString();
            return cursor_;
        }
        at_ = tokenFrom(file_, offset_);
        if (const TokenIndex before = tokenBefore(file_, offset_); before != kNoToken && !takeWord(before))
            return cursor_;
        start_ = findStart();
        classify(start_);
        return cursor_;
    }

  private:
    TokenKind kind(TokenIndex t) const {
        if (t >= tree_.tokens.size()) return TokenKind::EndOfFile;
        return t + 1 == at_ && !onNewLine(at_) ? kindWritten(tree_, t) : tree_.tokens[t].kind;
    }

    /// False: the offset is in something that is not a word, such as a number.
    bool takeWord(TokenIndex before) {
        const SourceRange range = tree_.range(before);
        if (range.end < offset_) return true;
        const TokenKind k = kind(before);
        if (isWord(k)) {
            at_ = before;
            cursor_.word = range;
            cursor_.prefix = file_.text().substr(range.begin, offset_ - range.begin);
            return true;
        }
        if (range.end > offset_) return false;
        return k != TokenKind::NumLiteral && k != TokenKind::StringLiteral && k != TokenKind::Error;
    }

    void inString() {
        const TokenIndex token = tokenBefore(file_, offset_);
        if (token == kNoToken || token == 0) return;
        SourceRange range = tree_.range(token);
        const bool late = kind(token - 1) == TokenKind::Percent;
        if (!late && !namesModule(range.begin)) return;
        ++range.begin;
        if (range.end > offset_ && range.end > range.begin && file_.text()[range.end - 1] == '"') --range.end;
        cursor_.expect = late ? Expect::LateName : Expect::ModuleName;
        cursor_.word = range;
        cursor_.prefix = file_.text().substr(range.begin, offset_ - range.begin);
    }
    /// The string is the argument of a parameter such as that of EraseModule.
    bool namesModule(uint32_t string) const {
        const Cursor outer = CursorReader(scope_, string).read();
        if (!outer.call || !outer.call->routine || outer.call->parameter < 0) return false;
        const auto& params = outer.call->routine->params;
        return equalsNoCase(params[static_cast<size_t>(outer.call->parameter)]->name, "MODULENAME");
    }

    bool onNewLine(TokenIndex t) const {
        if (t == 0) return true;
        const SourceRange before = tree_.range(t - 1);
        const uint32_t begin = t == at_ ? cursor_.word.begin : tree_.tokens[t].offset;
        return begin > before.end &&
               file_.text().substr(before.end, begin - before.end).find_first_of("\r\n") !=
                   std::string_view::npos;
    }

    /// The first token of the instruction or declaration; `at_` when it begins at the offset.
    TokenIndex findStart() const {
        constexpr int kFar = 20000; // tokens: larger values are data, not written by hand
        int depth = 0;
        TokenIndex t = at_;
        for (int steps = 0; t > 0 && steps < kFar; ++steps, --t) {
            const TokenKind before = kind(t - 1);
            if (before == TokenKind::RightParen || before == TokenKind::RightBracket ||
                before == TokenKind::RightBrace)
                ++depth;
            if (before == TokenKind::LeftParen || before == TokenKind::LeftBracket ||
                before == TokenKind::LeftBrace)
                --depth;
            if (kEndsPart.has(before)) return t;
            if (kBeginsPart.has(before)) return localStart(t - 1);
            if (kModeWords.has(before) && (t < 2 || !kBeforeParameter.has(kind(t - 2))))
                return localStart(t - 1);
            // A ';' is missing: two values in a row, on two lines.
            const bool word = t == at_ ? !beginsWithLiteral() : isWord(kind(t));
            if (depth == 0 && word && endsValue(before) && onNewLine(t) && (t != at_ || !continuesHeader(t)))
                return t;
        }
        return t;
    }
    /// No letters are written at the offset, and a literal begins there: it is an argument.
    bool beginsWithLiteral() const {
        const TokenKind k = kind(at_);
        return cursor_.word.begin == cursor_.word.end && at_ < tree_.tokens.size() &&
               tree_.tokens[at_].offset == offset_ &&
               (k == TokenKind::StringLiteral || k == TokenKind::NumLiteral);
    }
    /// After `PROC name` and its like no instruction begins yet.
    bool continuesHeader(TokenIndex t) const {
        return t >= 2 && (kind(t - 2) == TokenKind::KwProc || kind(t - 2) == TokenKind::KwRecord);
    }
    TokenIndex localStart(TokenIndex t) const {
        if (t > 0 && kind(t - 1) == TokenKind::KwLocal) return t - 1;
        return t > 0 && equalsNoCase(tree_.text(t - 1), "TASK") ? t - 1 : t;
    }

    // ---- By the first token ------------------------------------------------------------------------------------

    void classify(TokenIndex s) {
        if (s >= at_) return atStart();
        if (kind(s) == TokenKind::KwLocal ||
            (equalsNoCase(tree_.text(s), "TASK") && s + 1 <= at_ && kModeWords.has(kind(s + 1)))) {
            if (s + 1 == at_) {
                cursor_.expect = Expect::Keyword;
                cursor_.keywords = {TokenKind::KwVar,    TokenKind::KwPers, TokenKind::KwConst,
                                    TokenKind::KwProc,   TokenKind::KwFunc, TokenKind::KwTrap,
                                    TokenKind::KwRecord, TokenKind::KwAlias};
                return;
            }
            ++s;
        }
        switch (kind(s)) {
        case TokenKind::KwVar:
        case TokenKind::KwPers:
        case TokenKind::KwConst: return data(s);
        case TokenKind::KwModule: return module(s);
        case TokenKind::KwProc:
        case TokenKind::KwFunc:
        case TokenKind::KwTrap: return routineHeader(s);
        case TokenKind::KwRecord:
            if (s + 2 <= at_ && s + 1 != at_) type();
            if (s + 3 <= at_) cursor_.expect = Expect::Nothing;
            return;
        case TokenKind::KwAlias:
            if (s + 1 == at_) type();
            return;
        default: return instruction(s);
        }
    }

    void type() { cursor_.expect = Expect::TypeName; }

    void atStart() {
        const Surroundings& around = scope_.around();
        for (const Node* node : nodesAt(file_, offset_))
            if (node->kind == NodeKind::Record && tree_.range(*node).begin < offset_ &&
                offset_ < tree_.range(*node).end)
                return type();
        if (!around.routineDecl && inOpenRecord()) return type();
        if (around.routineDecl || (around.module && !around.module->decl))
            cursor_.expect = Expect::Statement;
        else
            cursor_.expect = around.module ? Expect::Declaration : Expect::File;
    }

    /// After RECORD and before its end, which may not be written yet.
    bool inOpenRecord() const {
        constexpr TokenSet kOther = {TokenKind::KwEndrecord, TokenKind::KwVar,     TokenKind::KwPers,
                                     TokenKind::KwConst,     TokenKind::KwEndproc, TokenKind::KwModule};
        for (TokenIndex t = at_; t-- > 0 && !kOther.has(kind(t));)
            if (kind(t) == TokenKind::KwRecord) return t + 1 < at_;
        return false;
    }

    void data(TokenIndex s) {
        if (s + 1 == at_) return type();
        if (s + 2 >= at_) return; // the new name
        cursor_.declares = tree_.text(s + 2);
        DataType declared;
        declared.type = typeNamed(scope_, tree_.text(s + 1));
        int depth = 0;
        for (TokenIndex t = s + 2; t < at_; ++t) {
            if (kind(t) == TokenKind::LeftBrace && t == s + 3) declared.rank = 1;
            if (kind(t) == TokenKind::Comma && declared.rank > 0 && declared.rank < 3) ++declared.rank;
            if (kind(t) == TokenKind::LeftBrace) ++depth;
            if (kind(t) == TokenKind::RightBrace) --depth;
            if (kind(t) == TokenKind::Assign) return expression(t + 1, declared);
        }
        if (depth > 0) expression(at_ > s + 4 ? s + 4 : at_, {scope_.snapshot().program().num, 0, {}});
    }

    void module(TokenIndex s) {
        if (s + 2 >= at_) return;
        TokenIndex close = s + 2;
        while (close < at_ && kind(close) != TokenKind::RightParen)
            ++close;
        if (kind(s + 2) == TokenKind::LeftParen && close >= at_) {
            cursor_.expect = Expect::Keyword;
            cursor_.keywords = {TokenKind::KwSysmodule, TokenKind::KwNoview, TokenKind::KwNostepin,
                                TokenKind::KwViewonly, TokenKind::KwReadonly};
            return;
        }
        classify(kind(s + 2) == TokenKind::LeftParen ? close + 1 : s + 2);
    }

    void routineHeader(TokenIndex s) {
        const bool function = kind(s) == TokenKind::KwFunc;
        if (function && s + 1 == at_) return type();
        const TokenIndex name = s + (function ? 2 : 1);
        if (name >= at_) return;
        if (kind(s) == TokenKind::KwTrap) return classify(name + 1);
        if (name + 1 >= at_) return;
        if (kind(name + 1) != TokenKind::LeftParen) return classify(name + 1);
        for (TokenIndex t = name + 2; t < at_; ++t)
            if (kind(t) == TokenKind::RightParen) return classify(t + 1);
        const TokenKind before = kind(at_ - 1);
        if (kBeforeParameter.has(before)) {
            type();
            cursor_.keywords = {TokenKind::KwVar, TokenKind::KwPers, TokenKind::KwInout};
        } else if (kModeWords.has(before)) {
            type();
        }
    }

    // ---- Instructions ------------------------------------------------------------------------------------------

    void instruction(TokenIndex s) {
        const CheckedProgram& program = scope_.snapshot().program();
        const DataType number{program.num, 0, {}}, boolean{program.boolean, 0, {}};
        switch (kind(s)) {
        case TokenKind::KwIf: follow_ = {TokenKind::KwThen}; return condition(s, boolean);
        case TokenKind::KwElseif: follow_ = {TokenKind::KwThen}; return expression(s + 1, boolean);
        case TokenKind::KwWhile: follow_ = {TokenKind::KwDo}; return expression(s + 1, boolean);
        case TokenKind::KwTest: return expression(s + 1, {});
        case TokenKind::KwCase: return expression(s + 1, subject());
        case TokenKind::KwFor: return loop(s, number);
        case TokenKind::KwReturn:
            return expression(s + 1,
                              scope_.around().routine ? scope_.around().routine->returnType : DataType{});
        case TokenKind::KwRaise: return errorNumber(s + 1);
        case TokenKind::KwError: return errorClause(s);
        case TokenKind::KwGoto:
            if (s + 1 == at_) cursor_.expect = Expect::Label;
            return;
        case TokenKind::KwConnect: return connect(s);
        case TokenKind::Percent: return lateCall(s);
        case TokenKind::Identifier: return assignmentOrCall(s);
        default: return;
        }
    }

    void errorNumber(TokenIndex from) {
        cursor_.errorNumber = true;
        expression(from, {typeNamed(scope_, "errnum"), 0, {}});
    }

    /// `IF condition instruction`: two values in a row.
    void condition(TokenIndex s, const DataType& boolean) {
        int depth = 0;
        for (TokenIndex t = s + 1; t < at_; ++t) {
            const TokenKind k = kind(t);
            if (k == TokenKind::LeftParen || k == TokenKind::LeftBrace || k == TokenKind::LeftBracket)
                ++depth;
            if (k == TokenKind::RightParen || k == TokenKind::RightBrace || k == TokenKind::RightBracket)
                --depth;
            if (depth == 0 && t > s + 1 && k == TokenKind::Identifier && endsValue(kind(t - 1)))
                return classify(t);
        }
        expression(s + 1, boolean);
        cursor_.instruction = cursor_.expect == Expect::Keyword && depth == 0;
    }

    /// Of the TEST around a CASE, which need not be complete: the value that ends before its first CASE.
    DataType subject() const {
        int depth = 0;
        TokenIndex firstCase = kNoToken;
        for (TokenIndex t = at_; t-- > 0;) {
            const TokenKind k = kind(t);
            if (k == TokenKind::KwEndtest) ++depth;
            if (k == TokenKind::KwProc || k == TokenKind::KwFunc || k == TokenKind::KwTrap) break;
            if (k == TokenKind::KwCase && depth == 0) firstCase = t;
            if (k != TokenKind::KwTest || depth-- > 0) continue;
            return firstCase == kNoToken || firstCase < t + 2 ? DataType{}
                                                              : typeOfChain(scope_, firstCase - 1);
        }
        return {};
    }

    void loop(TokenIndex s, const DataType& number) {
        if (s + 1 >= at_) return;
        cursor_.declares = tree_.text(s + 1);
        TokenIndex from = kNoToken;
        for (TokenIndex t = s + 2; t < at_; ++t) {
            const TokenKind k = kind(t);
            if (k != TokenKind::KwFrom && k != TokenKind::KwTo && k != TokenKind::KwStep) continue;
            from = t + 1;
            if (k == TokenKind::KwFrom) follow_ = {TokenKind::KwTo};
            if (k == TokenKind::KwTo) follow_ = {TokenKind::KwDo, TokenKind::KwStep};
            if (k == TokenKind::KwStep) follow_ = {TokenKind::KwDo};
        }
        if (from != kNoToken) return expression(from, number);
        cursor_.expect = Expect::Keyword;
        cursor_.keywords = {TokenKind::KwFrom};
    }

    void errorClause(TokenIndex s) {
        if (s + 1 >= at_) return atStart();
        if (kind(s + 1) != TokenKind::LeftParen) return classify(s + 1);
        for (TokenIndex t = s + 2; t < at_; ++t)
            if (kind(t) == TokenKind::RightParen) return classify(t + 1);
        errorNumber(s + 2);
    }

    void connect(TokenIndex s) {
        for (TokenIndex t = s + 1; t < at_; ++t)
            if (kind(t) == TokenKind::KwWith) {
                if (t + 1 == at_) cursor_.expect = Expect::Trap;
                return;
            }
        follow_ = {TokenKind::KwWith};
        expression(s + 1, {typeNamed(scope_, "intnum"), 0, {}});
        cursor_.mode = ParamMode::Var;
        if (cursor_.expect == Expect::Expression) cursor_.expect = Expect::Target;
    }

    void lateCall(TokenIndex s) {
        TokenIndex close = s + 1;
        while (close < at_ && kind(close) != TokenKind::Percent)
            ++close;
        if (close >= at_) return expression(s + 1, {scope_.snapshot().program().string, 0, {}});
        scanArguments(close + 1, kNoToken, {}, false);
    }

    void assignmentOrCall(TokenIndex s) {
        int depth = 0;
        for (TokenIndex t = s; t < at_; ++t) {
            const TokenKind k = kind(t);
            if (k == TokenKind::LeftBrace || k == TokenKind::LeftParen || k == TokenKind::LeftBracket)
                ++depth;
            if (k == TokenKind::RightBrace || k == TokenKind::RightParen || k == TokenKind::RightBracket)
                --depth;
            if (k == TokenKind::Backslash || (k == TokenKind::Comma && depth == 0)) break; // arguments
            if (k != TokenKind::Assign || depth != 0) continue;
            const Symbol* callee = s + 1 < t ? scope_.find(tree_.text(s)) : nullptr;
            if (routineOf(callee) && kind(s + 1) == TokenKind::Identifier) break; // a named argument
            return expression(t + 1, typeOfChain(scope_, t - 1));
        }
        const TokenKind next = kind(s + 1);
        if (s + 1 < at_ && (next == TokenKind::Dot || next == TokenKind::LeftBrace)) return expression(s, {});
        scanArguments(s + 1, s, {}, false);
    }

    void expression(TokenIndex from, const DataType& type) { scanArguments(from, kNoToken, type, true); }

    /// The rest of the work: brackets and arguments around the offset.
    void scanArguments(TokenIndex from, TokenIndex callee, const DataType& type, bool isValue) {
        ArgumentScan scan(scope_, from, at_);
        if (isValue)
            scan.run(type);
        else
            scan.runCall(callee);
        scan.fill(cursor_);
        if (cursor_.expect == Expect::Keyword && scan.outermost())
            cursor_.keywords.insert(cursor_.keywords.begin(), follow_.begin(), follow_.end());
        else if (cursor_.expect == Expect::Keyword && !isValue)
            cursor_.keywords = {};
    }

    static const RoutineSymbol* routineOf(const Symbol* symbol) {
        return symbol && symbol->kind == SymbolKind::Routine ? static_cast<const RoutineSymbol*>(symbol)
                                                             : nullptr;
    }

    const Scope& scope_;
    const FileView& file_;
    const SyntaxTree& tree_;
    uint32_t offset_;
    TokenIndex at_ = 0; ///< the word at the offset, or the first token after it
    TokenIndex start_ = 0;
    std::vector<TokenKind> follow_; ///< keywords after a value that is complete
    Cursor cursor_;
};

} // namespace

TokenKind kindWritten(const SyntaxTree& tree, TokenIndex token) {
    if (tree.tokens[token].kind != TokenKind::Semicolon) return tree.tokens[token].kind;
    const std::string_view text = tree.text(token);
    return text == "," ? TokenKind::Comma : text == "." ? TokenKind::Dot : TokenKind::Semicolon;
}

Cursor cursorAt(const Scope& scope, uint32_t offset) {
    return CursorReader(scope, offset).read();
}

} // namespace rapid::query
