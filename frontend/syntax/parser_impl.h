#pragma once
// The recursive-descent parser behind parse(). Private to frontend/syntax.
//
// Recovery: the first mistake of a statement or declaration is reported and sets panic_, which silences everything
// until the parser stands on firm ground again (see parser_recovery.cpp). A missing word or semicolon is reported
// and taken as if it stood there. So one mistake costs one diagnostic.

#include "frontend/syntax/lexer.h"
#include "frontend/syntax/parser.h"
#include "frontend/syntax/token_set.h"

#include <string>

namespace rapid::syntax {

inline constexpr uint32_t kMaxDepth = 1000; ///< nesting of expressions and instructions
inline constexpr size_t kMaxErrorsPerFile = 200;
inline constexpr size_t kMostWords =
    20000000; ///< words of the file that are compared, in all searches together
inline constexpr size_t kMaxNameLength = 32; // manual 1.1.2

/// Sets a member for the length of a block.
template <class T> class Restore {
  public:
    explicit Restore(T& place) : place_(place), saved_(place) {}
    ~Restore() { place_ = saved_; }
    const T& saved() const { return saved_; }
    Restore(const Restore&) = delete;
    Restore& operator=(const Restore&) = delete;

  private:
    T& place_;
    T saved_;
};

/// Words at which a list of instructions has to stop and think.
inline constexpr TokenSet kListStops = {
    TokenKind::KwEndfor,   TokenKind::KwEndfunc, TokenKind::KwEndif,     TokenKind::KwEndmodule,
    TokenKind::KwEndproc,  TokenKind::KwEndtest, TokenKind::KwEndrecord, TokenKind::KwEndtrap,
    TokenKind::KwEndwhile, TokenKind::KwElse,    TokenKind::KwElseif,    TokenKind::KwCase,
    TokenKind::KwDefault,  TokenKind::KwError,   TokenKind::KwUndo,      TokenKind::KwBackward,
    TokenKind::KwProc,     TokenKind::KwFunc,    TokenKind::KwTrap,      TokenKind::KwRecord,
    TokenKind::KwAlias,    TokenKind::KwModule,  TokenKind::PlaceTdn,    TokenKind::PlaceRdn,
    TokenKind::PlaceEit,   TokenKind::PlaceCse,  TokenKind::EndOfFile,   TokenKind::KwLocal,
    TokenKind::Identifier};
/// Words that no English comment contains.
inline constexpr TokenSet kEndWords = {TokenKind::KwEndfor,  TokenKind::KwEndfunc,   TokenKind::KwEndif,
                                       TokenKind::KwEndproc, TokenKind::KwEndmodule, TokenKind::KwEndrecord,
                                       TokenKind::KwEndtest, TokenKind::KwEndtrap,   TokenKind::KwEndwhile,
                                       TokenKind::EndOfFile};
/// Words that end the instructions of a routine or of a part of it.
inline constexpr TokenSet kRoutineEnds = {TokenKind::KwEndproc,   TokenKind::KwEndfunc, TokenKind::KwEndtrap,
                                          TokenKind::KwError,     TokenKind::KwUndo,    TokenKind::KwBackward,
                                          TokenKind::KwProc,      TokenKind::KwFunc,    TokenKind::KwTrap,
                                          TokenKind::KwRecord,    TokenKind::KwAlias,   TokenKind::KwModule,
                                          TokenKind::KwEndmodule, TokenKind::PlaceTdn,  TokenKind::PlaceRdn};
inline constexpr TokenSet kOpenBrackets = {TokenKind::LeftParen, TokenKind::LeftBracket,
                                           TokenKind::LeftBrace};
inline constexpr TokenSet kCloseBrackets = {TokenKind::RightParen, TokenKind::RightBracket,
                                            TokenKind::RightBrace};
inline constexpr TokenIndex kLongLine = 500;   ///< tokens: no search within a line goes farther
inline constexpr TokenIndex kFarTokens = 5000; ///< how far margins and END words are compared
inline constexpr TokenSet kStorageWords = {TokenKind::KwVar, TokenKind::KwPers, TokenKind::KwConst};
inline constexpr TokenSet kAccessModes = {TokenKind::KwVar, TokenKind::KwPers, TokenKind::KwInout};
/// Words that end a branch.
inline constexpr TokenSet kIfEnds = {TokenKind::KwEndif, TokenKind::KwElse, TokenKind::KwElseif,
                                     TokenKind::PlaceEit};
inline constexpr TokenSet kTestEnds = {TokenKind::KwEndtest, TokenKind::KwCase, TokenKind::KwDefault,
                                       TokenKind::PlaceCse};

/// What a routine begins and ends with, and what messages call its kind.
struct RoutineWords {
    TokenKind word, end;
    std::string_view name;
};
RoutineWords wordsOf(RoutineKind kind);

class Parser {
  public:
    Parser(SyntaxTree& tree, diag::Sink& sink, const ParseOptions& options);
    void parseFile(const LexResult& lexed);
    void parseElements(AggregateExpr& plain, TokenIndex opening);
    Expr* parseWholeExpression(const LexResult& lexed);

  private:
    using K = TokenKind;

    /// Counts nesting; false when it is too deep, which is reported.
    class Nest {
      public:
        explicit Nest(Parser& parser) : parser_(parser) { ++parser_.depth_; }
        ~Nest() { --parser_.depth_; }
        Nest(const Nest&) = delete;
        Nest& operator=(const Nest&) = delete;
        explicit operator bool() const { return parser_.depth_ <= kMaxDepth; }

      private:
        Parser& parser_;
    };

    // ---- Tokens
    K kind() const { return tokens_[pos_].kind; }
    K kindAt(TokenIndex i) const { return i < last_ ? tokens_[i].kind : K::EndOfFile; }
    K peek(uint32_t n = 1) const { return kindAt(pos_ + n); }
    TokenIndex take() { return pos_ < last_ ? pos_++ : pos_; }
    bool accept(K k) {
        if (kind() != k) return false;
        take();
        return true;
    }
    std::string_view textOf(TokenIndex i) const { return tree_.text(i); }
    bool isName(K k) const { return k == K::Identifier || k == K::PlaceId; }
    bool startsLine(TokenIndex i) const;
    uint32_t columnOf(TokenIndex i) const;
    uint32_t indentOf(TokenIndex i) const;
    bool isContextual(TokenIndex i, std::string_view upper) const {
        return kindAt(i) == K::Identifier && equalsNoCase(textOf(i), upper);
    }
    bool isTaskDirective(TokenIndex i) const {
        return isContextual(i, "TASK") && (kindAt(i + 1) == K::KwVar || kindAt(i + 1) == K::KwPers);
    }

    // ---- Nodes
    template <class T> T* make(NodeKind nodeKind) {
        T* node = tree_.arena.make<T>();
        node->kind = nodeKind;
        node->first = pos_;
        return node;
    }
    template <class T> T* makeExpr(NodeKind nodeKind) {
        T* node = make<T>(nodeKind);
        node->id = tree_.exprCount++;
        return node;
    }
    template <class T> T* finish(T* node) {
        node->last = pos_ ? pos_ - 1 : 0;
        return node;
    }
    /// Moves what was pushed since `mark` into the arena.
    template <class T> std::span<T> drain(std::vector<T>& stack, size_t mark) {
        const size_t count = stack.size() - mark;
        if (count == 0) return {};
        const std::span<T> pushed(stack.data() + mark, count);
        T* data = static_cast<T*>(tree_.arena.allocate(pushed.size_bytes(), alignof(T)));
        std::uninitialized_copy(pushed.begin(), pushed.end(), data);
        stack.resize(mark);
        return {data, count};
    }

    // ---- Reporting (parser_recovery.cpp)
    diag::Diagnostic* reportAt(diag::Code code, SourceRange range,
                               std::initializer_list<std::string> args = {});
    diag::Diagnostic* report(diag::Code code, TokenIndex at, std::initializer_list<std::string> args = {}) {
        return reportAt(code, tree_.range(at), args);
    }
    void note(diag::Diagnostic* diagnostic, TokenIndex at, std::string message);
    /// The edit that mends what was reported; nothing when it was not shown.
    void fix(diag::Diagnostic* diagnostic, SourceRange place, std::string replacement, bool certain = true) {
        if (!diagnostic) return;
        diagnostic->fix(place, std::move(replacement), certain);
        // The words behind are read as they were meant, unless a line just seems to end too early.
        if (certain && diagnostic->code != diag::Code::MissingSemicolon) lastUnread_ = kNowhere;
    }
    /// Whether nothing has been reported since lastReport_, which is gone then.
    bool isLastReport() const;
    bool joinLast(diag::Code code, SourceRange place, std::string_view message);
    bool joinLastEdit(diag::Code code, SourceRange place, std::string replacement);
    void fixParentheses(diag::Diagnostic* diagnostic, const Node& operand);
    void reportEqual();
    void takeColonAsAssign();
    bool endsBeforeLocalData() const;
    bool lacksParenthesis(TokenIndex name) const;
    bool parseReturnType(RoutineDecl* routine);
    void parseParametersWithoutParen(RoutineDecl* routine);
    Stmt* noStmt(TokenIndex first);
    bool isShownPosition() const;
    void reportSlash(TokenIndex slash);
    void takesSlashAsBackslash();
    void skipTrapArguments();
    /// `late`: behind an instruction, where no declaration may stand anyhow.
    void reportScopeInside(ScopeWord scope, bool late = false);
    /// "found X, expected Y" where an expression has ended.
    diag::Diagnostic* reportAfterExpr(diag::Code code, std::initializer_list<std::string> args);
    /// "found X, expected Y" at the current token, and panic.
    void unexpected(std::string_view expected);
    void missing(std::string_view expected);
    bool isNewsHere();
    bool assignmentBelow();
    static void cutOff(Node& node);
    std::string describe(TokenIndex i) const;
    SourceRange endOf(TokenIndex i) const { return {tree_.range(i).end, tree_.range(i).end}; }
    void reportTooDeep();
    void reportLexErrors(const LexResult& lexed);
    bool endsBrokenString(const LexError& error, const LexError* before) const;
    static bool isInBrokenString(const LexResult& lexed, const LexError& escape);
    bool startsMisspeltModule() const;
    void fixEscapes(diag::Diagnostic& diagnostic) const;
    bool isConsequence(diag::Code code, SourceRange range);
    bool followsFromLast(diag::Code code, SourceRange range) const;
    void reportBrokenStrings();
    void checkNameLength(TokenIndex name);

    // ---- Recovery (parser_recovery.cpp)
    void endStatement(std::string_view expected = "';'");
    bool quoteInText() const;
    bool reportDecimalComma();
    void syncStatement();
    bool startsAfresh() const;
    bool continuesBlock() const;
    bool looksLikeStatement(TokenIndex i) const;
    bool opensBlock(TokenIndex i) const;
    bool calleeEndsHere(TokenIndex callee, TokenIndex calleeEnd) const;
    bool endsLine(TokenIndex last) const;
    bool findOnLine(TokenIndex from, K wanted, TokenIndex& found) const;
    void expectWord(K word);
    bool expectHeadWord(K word, bool whole);
    enum class HeadPart : uint8_t { Value, CaseValue, Condition };
    Expr* parseHeadExpr(bool& whole, HeadPart part = HeadPart::Value);
    /// `inCase`: a name and a colon are a value of CASE, no label.
    bool beginsInstruction(bool inCase = false) const;
    TokenIndex missingName();
    void expectClosing(K closing, TokenIndex opening, bool inList);
    bool atReservedName() const;
    bool operandBehindSemicolon();
    void fixBrackets(diag::Diagnostic* diagnostic, const IndexExpr& node, TokenIndex opening);
    bool mayBeIndex(const Expr& index) const;
    bool isArrayOfFile(TokenIndex name);
    TokenIndex takeReservedName();
    void declareReserved(TokenIndex name);
    void laterUsesAreNames(TokenIndex declared);
    void abandonRoutine();
    TokenIndex expectNameHere();
    void skipSecond(TokenIndex word);
    TokenIndex expectName(bool newerKeywords = false);

    // ---- END words (parser_ends.cpp)
    void closeBlock(K end, TokenIndex opening, bool whole = true);
    TokenIndex outerOpenerOf(K word) const;
    bool standsInside() const;
    bool handleStray(const TokenSet& own);
    TokenIndex unmatchedWord(TokenIndex from) const;
    bool closesHere(K end) const;
    K endOfOwn(const TokenSet& own) const;
    bool retagBrace(const TokenSet& own);
    bool isPieceOf(TokenIndex i, K end) const;
    bool retagPiece(const TokenSet& own);
    bool retagLastEnd();
    bool takesEarlyEndmodule();
    K endOfRoutineBelow() const;
    bool isTestWrittenCase();
    bool endsRoutineTooEarly() const;

    // ---- Misspelt keywords (parser_typos.cpp)
    bool meant(TokenIndex i, K word, unsigned limit = 0) const;
    bool isShuffled(TokenIndex i, K word) const;
    /// Reads a token as something else from now on; relex() keeps no such tokens.
    void readAs(TokenIndex token, K kind) {
        tree_.tokens[token].kind = kind;
        tree_.retagged = true;
    }
    void retag(TokenIndex first, TokenIndex last, K word);
    bool retagIfMeant(K word);
    bool fitsAsListWord(K word, TokenIndex last) const;
    bool isHandledBelow(TokenIndex from) const;
    bool retagMisspelt(const TokenSet& own);
    bool retagOtherEnd();
    bool retagData();
    bool retagOpener();
    bool isEndlessLoop();
    bool startsForeignBlock();
    bool endsForeignBlock();
    bool retagCallee(TokenIndex callee);
    TokenIndex foreignCloser(TokenIndex opening, K closer) const;
    void noteForeignCloser(diag::Diagnostic* diagnostic, TokenIndex opening, K word);
    bool isForeignCloser(TokenIndex i) const;
    bool foreignCloserIs(TokenIndex i) const;
    bool retagDecl();
    bool retagOperator();
    bool isMisspeltOperator(const Expr* left);
    bool takesPercentAsMod();

    // ---- Words that became reserved late (parser_later_words.cpp)
    void readLaterWordsAsNames();
    bool isNameInOldFile(TokenIndex i, bool endsAtOnce) const;

    // ---- Torn names and words that ran together (parser_words.cpp)
    std::string_view spellingInFile(std::string_view wanted, TokenIndex exceptFirst, TokenIndex exceptLast);
    std::string tornName(TokenIndex second);
    diag::Diagnostic* reportTornName();
    bool isOnlyHere(TokenIndex second);
    diag::Diagnostic* reportWord(TokenIndex first, TokenIndex last, const std::string& whole, bool certain);
    void noteUnclear(uint32_t place);
    bool takeTornName(TokenIndex name, const TokenSet& after, bool endsLine = false);
    bool takesRunTogether();
    void reportMissingIf();

    // ---- Spellings of other languages (parser_foreign.cpp)
    bool isBlockBrace() const;
    StmtList parseBody(const TokenSet& own, const std::string& expected, bool& braced);
    void closeBracedBlock(K end, TokenIndex opening, bool whole, bool braced);
    bool skipBracedComment();
    Stmt* parseBareBraces();
    bool takesColonAs(std::string_view word);
    bool negatesByComment(std::string_view ending);
    bool parseForeignFor(ForStmt* node);
    bool takesForeignCounter(ForStmt* node);
    bool isWordlessData() const;
    bool parseForeignData(DataDecl* node);
    void dropEmptyParentheses();
    void parseDimensionsOf(DataDecl* node, bool beforeName);
    void noteMoreNames(const DataDecl* node);
    DataDecl* parseMoreNames();
    bool parseForeignParameter(ParamDecl* node);
    void dropForeignMode(ParamDecl* node);
    bool missesComma();
    bool valueWithoutSign(DataKind kind) const;
    bool isInstructionLine() const;
    bool listClosesBelow(TokenIndex from) const;
    bool bodyBeginsHere() const;
    void takeSlashAsBackslash();
    Expr* parseForeignAggregate(TokenIndex opening, K closing);
    bool isProse() const;
    bool skipForeignComment();

    // ---- Expressions (parser_expr.cpp)
    Expr* parseExpr() { return parseBinary(1); }
    Expr* parseBinary(int minPrecedence);
    Expr* parseNot(int minPrecedence);
    Expr* parseSigned(int minPrecedence);
    Expr* parsePrimary();
    void reportBadNumber(TokenIndex token);
    Expr* parseNumber();
    Expr* parseLoneNumber();
    Expr* parseNamed(bool allowCall);
    Expr* parseCall();
    Expr* parsePostfix(Expr* base);
    Expr* parseIndex(Expr* base);
    Expr* parseCondition();
    Expr* parseMeantEqual(TokenIndex start, size_t errorsBefore);
    Expr* parseParen();
    Expr* parseAggregate();
    Expr* parsePlainAggregate();
    uint8_t shapeAt(TokenIndex whole);
    Expr* errorExpr();
    Expr* tooDeepExpr();
    std::span<Expr*> parseExprList(K closing, TokenIndex opening);
    std::span<Argument*> parseArguments(bool procedure);
    bool commaWasSemicolon();
    bool instructionAfterComma();
    bool takesSemicolonAsComma(K closing);
    K closingOf(TokenIndex opening) const;
    Argument* parseRequiredArgument(bool procedure);
    Argument* parseOptionalArgument();
    static bool startsExpr(K k);

    // ---- Instructions (parser_stmt.cpp)
    /// `braced`: the list began with '{' and may end with '}'.
    StmtList parseList(const TokenSet& own, bool braced = false);
    Stmt* parseStmt();
    Stmt* parseStmtUnguarded();
    Stmt* parseNamedStmt();
    Stmt* parseAssignment(Expr* target, TokenIndex first);
    Stmt* parseColonAssignment();
    Stmt* parseLabel();
    Stmt* parseCallStmt();
    bool parseParenthesisedCall(CallStmt* call);
    bool isBracketTarget() const;
    bool isSplitElseif();
    Stmt* parseLateCall();

    // ---- Blocks (parser_blocks.cpp)
    Stmt* parseIf();
    void countEndifs();
    bool isBlockByMargin(TokenIndex opening);
    void parseElseOfCompact(TokenIndex opening);
    Stmt* parseIfBlocks(TokenIndex opening, Expr* condition, bool headRead);
    Stmt* parseLateMore();
    Stmt* parseFor();
    Stmt* parseForBody(ForStmt* node, TokenIndex opening, bool whole);
    bool isWhileWrittenFor() const;
    Stmt* parseWhile();
    Stmt* parseWhile(TokenIndex opening);
    Stmt* parseWhileBody(TokenIndex opening, Expr* condition, bool whole);
    Stmt* parseCompactIf(TokenIndex opening, Expr* condition);
    bool missesCondition() const;
    Stmt* parseTest();
    Stmt* parseTestCases(TokenIndex opening, Expr* subject, bool whole);
    TestCase* parseCase();
    void expectColonOfDefault();
    bool isEqualForColon() const;
    bool takesSemicolonInCase();

    // ---- Instructions of one word and an operand (parser_stmt.cpp)
    Stmt* parseGoto();
    Stmt* parseValueStmt(bool isReturn);
    Stmt* parseConnect();
    Stmt* parseSimple(NodeKind nodeKind);
    Stmt* parseLateDecl();
    Stmt* parseOrphan();
    void skipHead();
    Stmt* errorStmt(TokenIndex first);

    // ---- Declarations (parser_decl.cpp, parser_types.cpp, parser.cpp)
    void parseModule();
    void parseModuleAttributes(ModuleDecl* module);
    void fixAttributeOrder(TokenIndex first, std::vector<TokenIndex> words);
    void addAttribute(ModuleDecl* module, TokenIndex token, std::vector<TokenIndex>& seen);
    void parseModuleDecls(ModuleDecl* module);
    Decl* parseModuleDecl();
    Decl* parseScopedDecl();
    Decl* parseTaskDecl();
    void warnOutsideComment(TokenIndex next);
    Decl* parseUnknownDecl();
    void skipToDecl();
    void skipOutsideModule();
    void skipStraySemicolons();
    DataDecl* parseModuleData(ScopeWord scope, TokenIndex first) { return parseData(scope, first, true); }
    DataDecl* parseData(ScopeWord scope, TokenIndex first, bool ofModule = false);
    DataDecl* parseWordlessData();
    void parseDataTail(DataDecl* node, bool nameMissing, bool ofModule);
    Decl* parseRecord(bool local, TokenIndex first);
    RecordComponent* parseComponent();
    bool dropComponentWord();
    void dropMisplacedMode(ParamDecl* param);
    Decl* parseAlias(bool local, TokenIndex first);
    Decl* parseRoutine(bool local, TokenIndex first);
    bool isTornRoutineName();
    void parseRoutineHeader(RoutineDecl* routine);
    void correctRoutineWord(RoutineDecl* routine, TokenIndex word);
    void parseParameters(RoutineDecl* routine);
    void parseParameterGroup(uint32_t group);
    bool parseSwitch(ParamDecl* param);
    bool parseAccessMode(ParamDecl* param);
    ParamDecl* parseParameter(bool optional, uint32_t group);
    void parseDimensions(ParamDecl* param);
    bool isNative() const;
    void parseRoutineBody(RoutineDecl* routine, bool& braced);
    void parseRoutineData();
    bool parseNested(const RoutineDecl* routine);
    void parseHandlers(RoutineDecl* routine);
    void parseHandler(RoutineDecl* routine, K previous);
    void closeRoutine(RoutineDecl* routine, TokenIndex opening, bool braced);
    bool isWrittenTwice(const RoutineDecl& routine, TokenIndex opening);
    static bool isBasicType(std::string_view word);
    bool startsDecl(TokenIndex i) const;

    SyntaxTree& tree_;
    diag::Sink& sink_;
    const ParseOptions& options_;
    const Token* tokens_ = nullptr;
    TokenIndex pos_ = 0;
    TokenIndex last_ = 0; ///< index of EndOfFile
    uint32_t depth_ = 0;
    uint32_t height_ = 0; ///< height of the expression parsed last
    bool panic_ = false;
    bool abandoned_ = false; ///< the routine is nested too deep: blocks end without their words
    bool quietOutside_ = false;
    bool outsideCommentShown_ = false;
    size_t errors_ = 0;
    bool badNumbers_ = false; ///< the lexer has found some
    /// A string that ends with its line, and the place before it where the line could not be read.
    struct BrokenString {
        SourceRange range;
        SourceRange doubtful;
    };
    std::vector<BrokenString> brokenStrings_;
    std::vector<uint32_t> lexErrors_; ///< where what the lexer has reported begins
    TokenSet reservedNames_;          ///< words that data was declared with, which is reported
    std::vector<TokenIndex>
        foreignClosers_;          ///< END words of other languages whose opening word has been reported
    K routineEnd_ = K::KwEndproc; ///< the word that ends the routine
    /// What endOfRoutineBelow() has found; the same from every place in between.
    mutable struct {
        TokenIndex from = kNoToken, found = 0;
    } routineEndBelow_;
    TokenIndex signReported_ = kNoToken;   ///< the last sign that stands behind an operator
    TokenIndex foreignList_ = 0;           ///< the last bracket that another language has there
    TokenIndex strayEnd_ = kNoToken;       ///< a word for END that ends nothing, which is reported
    bool typeInName_ = false;              ///< of the next parameter: "PROC worknum n)"
    TokenIndex runTogether_ = kNoToken;    ///< the word of a declaration that what follows it has run into
    TokenIndex switchMarked_ = kNoToken;   ///< a switch without '\\', which is reported
    TokenIndex earlySemicolon_ = kNoToken; ///< the place behind an operand whose semicolon stands before it
    size_t searched_ = 0;                  ///< words of the file, for names
    TokenIndex badNumber_ = kNoToken;      ///< the place behind a number that could not be read
    bool inCaseValue_ = false;             ///< between CASE and its colon
    size_t openModules_ = 0;               ///< modules whose ENDMODULE has not been found
    size_t unreadable_ = 0;                ///< of these: parts of an instruction that could not be read
    std::string_view foreignCloser_;       ///< what ends the block of another language that has been reported
    diag::Diagnostic* lastOrder_ =
        nullptr; ///< module attributes out of order, while nothing else is reported
    static constexpr uint32_t kNowhere = 0xFFFFFFFF;
    uint32_t lastUnread_ =
        kNowhere; ///< where words begin that could not be read, the last that were reported
    diag::Diagnostic* lastReport_ =
        nullptr;                     ///< what was reported last, while reports_ says that nothing followed
    size_t reports_ = 0;             ///< of all reports
    size_t listMark_ = 0;            ///< in stmts_: the beginning of the list that is being read
    TokenSet enclosing_;             ///< words that end a list further out
    TokenIndex wrongEnd_ = kNoToken; ///< an END word that closes a block of another kind
    TokenIndex headReported_ = kNoToken; ///< a THEN or DO whose IF, FOR or WHILE is broken
    TokenIndex compactIf_ = kNoToken;    ///< the last IF without THEN
    TokenIndex compactIfEnd_ =
        kNoToken;           ///< the end of its condition, when its instruction is on another line
    int missingEndifs_ = 0; ///< of the routine, once they are counted
    bool endifsCounted_ = false;
    bool endReported_ = false;           ///< that the file ends too early
    TokenIndex wentBackTo_ = 0;          ///< in an expression that was read: ends are to be cut off; 0: never
    TokenIndex routineStart_ = 0;        ///< its first token
    bool inCondition_ = false;           ///< between IF and THEN
    bool inHead_ = false;                ///< between IF, FOR or WHILE and the block
    bool typeMissed_ = false;            ///< a parameter of the header without a data type has been reported
    uint32_t braces_ = 0;                ///< open blocks that began with '{'
    const DataDecl* moreOf_ = nullptr;   ///< a declaration that goes on with another name, at its comma
    bool inLateName_ = false;            ///< between the '%' of a late-bound call
    bool colonGiven_ = false;            ///< a DEFAULT that was written ELSE
    bool plainError_ = false;            ///< the routine has an ERROR handler without a list
    TokenIndex blockOpening_ = kNoToken; ///< the word that opened the innermost block

    const LexResult* lexed_ = nullptr;
    size_t nextAggregate_ = 0; ///< of lexed_->aggregates

    // Scratch space, shared by all levels of the recursion.
    std::vector<Expr*> exprs_;
    std::vector<Argument*> args_;
    std::vector<Stmt*> stmts_;
    std::vector<IfBranch*> branches_;
    std::vector<TestCase*> cases_;
    std::vector<Decl*> decls_;
    std::vector<DataDecl*> data_;
    std::vector<ParamDecl*> params_;
    std::vector<RecordComponent*> components_;
    std::vector<ErrorClause*> handlers_;
};

} // namespace rapid::syntax
