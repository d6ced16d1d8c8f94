#pragma once
// The analysis behind check(): one Analyzer works through the library and then each task. Internal to frontend/sema;
// its methods are spread over collect, resolve_*, expr_*, call_*, stmt_* and names_* .cpp.

#include "frontend/sema/checker.h"
#include "frontend/sema/names.h"
#include "frontend/sema/one_mistake.h"

#include <array>
#include <deque>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace rapid::sema {

using diag::Code;

/// Why the numeric type of an expression is still open.
enum class Flex : uint8_t {
    None,    ///< it is not
    Literal, ///< literals only: num unless the context asks for dnum
    Group    ///< reads group signals: dnum unless the context asks for num
};

/// Outcome of checking an expression; the facts are in its ExprInfo.
struct Typed {
    ExprInfo* info = nullptr;
    Flex flex = Flex::None;
    const Type* base() const { return info->type.type->base(); }
    bool isError() const { return info->type.type->kind == TypeKind::Error; }
    bool isScalar(TypeKind kind) const { return info->type.rank == 0 && info->type.type->kind == kind; }
};

/// A reference to data or a part of it.
struct Place {
    DataSymbol* root = nullptr; ///< null: wrong, already reported
    const syntax::Expr* name = nullptr;
    bool whole = true; ///< neither an element nor a component
};

/// Names of one module, found before global and predefined names.
struct ModuleScope {
    NameMap<Symbol> names;
};

enum class Part : uint8_t { Body, Backward, Error, Undo };

/// What a routine does with one of its optional parameters.
struct OptionalUse {
    const syntax::Expr* first = nullptr; ///< first reference outside Present and conditional arguments
    bool tested = false;                 ///< by Present
};

/// A label or a jump, judged when the whole routine is known.
struct JumpPoint {
    NameId name = 0;
    uint32_t block = 0;
    Part part = Part::Body;
    const syntax::Node* node = nullptr;
    LabelSymbol* label = nullptr;
};

/// An argument whose type is not that of its parameter.
struct Mismatch {
    const DataSymbol* param = nullptr;
    const syntax::Expr* value = nullptr;
    DataType found;
};

/// A name that nothing declares, reported.
struct UnknownName {
    const Module* module = nullptr;
    NameId name = 0;
    Code code{};
    SourceRange where;
    bool looksMisspelt = false;
    /// What is declared with nearly this name; data of routines only while their file is checked.
    const Symbol* near = nullptr;
    bool explained = false; ///< by a declaration that lost its name
};

/// The numbers that an undeclared name is compared with.
struct ComparedName {
    double least = 0, most = 0;
    bool fraction = false; ///< one of them is not an integer
    bool unknown = false;  ///< of one the value is not known
};

/// How the routines of a task use names that nothing declares; worked out when the first of them is met.
struct SignalUses {
    bool known = false;
    NameMap<const Type> arguments; ///< for parameters of a signal type
    std::unordered_map<NameId, ComparedName> compared;
    std::unordered_set<NameId> others; ///< assigned, calculated with, or declared in some routine
    std::unordered_map<NameId, syntax::TokenIndex> own; ///< names of the routine that is read; their types
};

/// What is being checked now.
struct Context {
    Module* module = nullptr;
    const syntax::SyntaxTree* tree = nullptr;
    ExprTable* exprs = nullptr;
    RoutineSymbol* routine = nullptr; ///< null at module level
    bool constant = false;            ///< inside a constant expression
};

/// A file of a task: where its tree and facts are in the program, and its modules.
struct TaskFile {
    size_t slot = 0;
    bool broken = false; ///< it has syntax errors
    std::vector<Module*> modules;
};

/// What is known about a task, kept between checks.
struct TaskScope {
    Task* task = nullptr;
    std::vector<TaskFile> files;
    std::vector<Symbol*> globals;        ///< by NameId
    std::vector<DataSymbol*> configured; ///< signals and mechanical units, by NameId
    std::vector<DataSymbol*> assumed;    ///< of these: those known by their use only
    NameMap<Module> moduleNames;
    bool incomplete = false; ///< modules are missing: names may be unknown
    std::vector<std::string> missingModules;
    bool entangled = false; ///< the outcome hangs on the order of the work: no file can be checked alone
};

class Analyzer {
  public:
    Analyzer(CheckedProgram& program, const CheckOptions& options, diag::Sink& sink);
    void loadLibrary();
    void checkTask(const TaskInput& input);

    // ---- the steps of checkTask(), for a Session (checker.cpp, recheck.cpp)
    void startTask(const TaskInput& input);
    /// `declare`: the modules of each file at once, while its tree is in the cache.
    void readFiles(const TaskInput& input, bool declare);
    void checkFiles();
    void finishTask();
    TaskScope leaveTask();
    void enterTask(TaskScope scope);
    /// Takes another tree for a file of the task. Whether its other files see no difference.
    bool replaceTree(size_t file, std::unique_ptr<syntax::SyntaxTree> tree, bool broken);
    /// Checks some files again while the facts about the others stay.
    void recheckFiles(std::span<const size_t> files);
    /// Checks the whole task again, without parsing.
    void recheckTask();
    std::vector<TaskFile>& files() { return files_; }
    bool isEntangled() const { return entangled_; }

    void keepFacts() { keeps_ = true; }
    /// Before the first task: all of them, because each can name the others.
    void setTaskNames(std::vector<std::string> names) { taskNames_ = std::move(names); }
    /// What concerns several tasks: persistents and modules they share.
    void checkAcrossTasks();
    bool leaveOut(const TaskInput& input);

  private:
    // ---- reporting (report.cpp)
    SourceRange range(const syntax::Node& node) const { return context_.tree->range(node); }
    SourceRange range(syntax::TokenIndex token) const {
        return token == syntax::kNoToken ? SourceRange{} : context_.tree->range(token);
    }
    /// False for what is missing after a syntax error and for the placeholder <ID>.
    bool isName(syntax::TokenIndex token) const {
        return token != syntax::kNoToken &&
               context_.tree->tokens[token].kind == syntax::TokenKind::Identifier;
    }
    std::string text(const syntax::Node& node) const;
    std::string text(syntax::TokenIndex token) const { return std::string(context_.tree->text(token)); }
    diag::Diagnostic& report(Code code, SourceRange where, std::initializer_list<std::string> args = {});
    bool isUnclear(SourceRange where) const;
    uint32_t lineEnd(uint32_t from) const;
    bool valueFollows(const syntax::LabelStmt& s);
    bool hasUnclearLine(const syntax::Node& node) const;
    /// Adds "declared here" at the declaration of `symbol`, when it has one in a file of the user.
    void noteDeclared(diag::Diagnostic& diagnostic, const Symbol& symbol);
    /// What stands there, and its value where that does not show: "n+1 = 4".
    std::string valueText(const syntax::Expr& e);
    static std::string typeName(const DataType& type);
    static std::string typeName(const ExprInfo& info) { return typeName(info.type); }
    /// The names of two types that are not the same: alike, they get their modules' names, "cell:part".
    static std::array<std::string, 2> typeNames(const DataType& found, const DataType& wanted);
    /// "a constant", "a procedure" ...
    static std::string describe(const Symbol& symbol);
    enum class Wanted : uint8_t { Data, Signal, Type, Procedure, Function, Trap };
    bool isWanted(const Symbol& symbol, Wanted wanted) const;
    static std::string counted(size_t count, std::string_view noun, std::string_view plural = {});
    /// Adds the fix that makes `name(e)` of an expression.
    void fixCall(diag::Diagnostic& diagnostic, const syntax::Expr& e, const std::string& name, bool certain);

    // ---- what is told once (repeats.cpp)
    void gatherUnknown(std::span<Module* const> modules);
    void explainUnknown(const Module& module);
    void explainByType(const Module& module, std::string_view declared);
    bool explainUnknown(const Module& module, SourceRange where, bool routines, size_t lost);
    /// `first`: of the errors reported while the file was checked.
    void gatherRepeats(std::span<Module* const> modules, size_t first);
    void tellOnce();

    // ---- how to mend a value that does not fit (remedies.cpp)
    struct Remedy {
        std::string words;   ///< the end of a message, ": write 1"; empty: none is known
        std::string instead; ///< to write for the expression; empty: nothing that is certain to compile
    };
    Remedy remedyFor(const syntax::Expr& whole, const DataType& found, const DataType& want);
    Remedy remedyFor(const RoutineSymbol& routine, const syntax::Expr& e, const DataType& found,
                     const DataSymbol& param);
    std::string written(const syntax::Expr& e) const;
    std::string inWords(const syntax::Expr& e) const;
    Remedy numberRemedy(const syntax::Expr& e, const DataType& found, const Type& want);
    Remedy recordRemedy(const syntax::Expr& e, const DataType& found, const DataType& want);
    Remedy signalRemedy(const RoutineSymbol& routine, const DataType& found, const DataType& want);
    static std::string targetRemedy(syntax::BinaryOp op, const DataType& operand);
    static std::string operatorRemedy(syntax::BinaryOp op, Typed left, Typed right);
    std::string namedByNumber(std::string_view number, const Type& want);
    /// Adds it to what is said about `e`.
    void offer(diag::Diagnostic& diagnostic, const syntax::Expr& e, const Remedy& remedy);
    /// "\Num:=" for data of the type of an optional parameter; empty when there is none.
    std::string optionalFor(const RoutineSymbol& routine, const syntax::Expr& e);
    std::string optionalFor(const RoutineSymbol& routine, NameId name);

    // ---- names that nothing declares (unknown.cpp)
    struct Suggestion {
        std::string name; ///< empty: none is near
        bool isKeyword = false;
        const Symbol* symbol = nullptr; ///< null: a reserved word
    };
    /// Elsewhere: a module that is not here may declare it.
    enum class Meant : uint8_t { Unknown, Keyword, Elsewhere };
    void setMissingModules(const TaskInput& input);
    bool mayReportUnknown(NameId name);
    bool reportTorn(syntax::TokenIndex token);
    void mayDeclareTorn(const syntax::SyntaxTree& tree, syntax::TokenIndex word);
    /// Reports `code`, or rather that the name is LOCAL elsewhere or may be declared in a module that is missing.
    /// A built-in whose RobotWare option the controller is known not to have.
    void checkOption(const RoutineSymbol& routine, syntax::TokenIndex name);
    Meant reportUnknown(Code code, syntax::TokenIndex token, NameId name, Wanted wanted,
                        std::string_view otherHint = {});
    bool countedAbove(syntax::TokenIndex token, NameId name);
    void reportMayBeDeclared(syntax::TokenIndex token, const std::string& hint);
    Suggestion suggestion(NameId name, Wanted wanted);
    static std::string didYouMean(std::string_view name);
    std::string inSeries(std::string_view written);
    /// "trans.z" for "z", when one part of the parts of a record is named so; empty when none or several are.
    std::string deeperComponent(const Type& record, std::string_view name);
    const Type::Component* nearComponent(const Type& record, std::string_view name);
    const DataSymbol* nearOptional(const RoutineSymbol& routine, NameId name);

    // ---- names (lookup.cpp)
    NameId idOf(syntax::TokenIndex token) { return interner_.intern(context_.tree->text(token)); }
    Symbol* lookup(NameId name) const;
    Symbol* lookupOutside(NameId name) const; ///< skips the routine
    Symbol* reportUnknownData(syntax::TokenIndex token, NameId name, const Type* handle);
    DataSymbol* configuredObject(NameId name, std::string spelling, const Type* type, bool assumed);
    void declareUnknown(NameId name);
    bool comparisonsTell() const;
    void reportSignal(syntax::TokenIndex token, NameId name, const Type& type, bool perhaps);
    void declareConfiguration();

    // ---- signals known by their use (signal_uses.cpp)
    const Type* signalType(std::string_view name);
    const Type* signalTypeByName(const std::string& name);
    const Type* signalTypeByUse(NameId name);
    const Type* signalTypeByComparison(const std::string& written, NameId name);
    bool isMisspeltNumber(NameId name);
    void gatherSignalUses();
    void gatherSignalUses(const syntax::Node& node);
    void gatherSignalUses(const RoutineSymbol& routine, std::span<syntax::Argument* const> args);
    void declareOwn(syntax::TokenIndex name, syntax::TokenIndex type);
    void operands(const syntax::BinaryExpr& e);
    void usedOtherwise(const syntax::Expr& place);
    void compared(const syntax::Expr& side, const syntax::Expr& number);
    const Type* looseType(const syntax::Expr& expr);
    bool looseNumber(const syntax::Expr& expr, double& value);

    // ---- tasks (checker.cpp)
    bool sameStructure(const Type& left, const Type& right);
    std::pair<std::string, std::string> difference(const Type& left, const Type& right,
                                                   const std::string& where);
    using DifferentRecords = std::set<std::pair<const Type*, const Type*>>;
    void checkShared(const DataSymbol& data, const DataSymbol& other, DifferentRecords& told);
    void checkSharedModules();
    void readFile(const std::shared_ptr<const SourceFile>& file);
    void declareModules(std::span<Module* const> modules);
    void checkModules(std::span<Module* const> modules);
    /// `said`: how much had been reported before.
    void finishFile(std::span<Module* const> modules, size_t said);
    void listSignals();
    void dropFacts(std::span<const size_t> files);
    void renewFacts(const TaskFile& file, std::shared_ptr<FileSymbols> symbols);
    void clearLooseEnds();
    bool markUsed(Symbol& symbol);
    void markAssigned(DataSymbol& symbol);

    // ---- collecting declarations (collect.cpp)
    void enterModule(Module* module);
    Module* addModule(const syntax::SyntaxTree& tree, const syntax::ModuleDecl& decl, bool predefined,
                      FileFacts& facts);
    void collect(Module& module);
    void declareInModule(Symbol& symbol, ModuleScope& scope);
    void checkModuleNames(std::span<Module* const> modules);
    DataSymbol& newData(const syntax::DataDecl& decl);
    RoutineSymbol& newRoutine(const syntax::RoutineDecl& decl);
    TypeSymbol& newType(const syntax::Decl& decl, syntax::TokenIndex name, bool local);
    template <class S> S& recycled(Store<S>& store, SymbolKind kind, syntax::TokenIndex name);
    template <class S>
    S& fill(S& symbol, SymbolKind kind, const syntax::Node& decl, syntax::TokenIndex name, bool local);

    // ---- attributes of library declarations (attributes.cpp)
    void applyTypeAttributes(TypeSymbol& symbol);
    void applyDataAttributes(DataSymbol& symbol);
    void applyRoutineAttributes(RoutineSymbol& symbol);

    // ---- types (resolve_types.cpp)
    /// `data`: the declaration that names it, if it is one of data.
    const Type* resolveType(syntax::TokenIndex token, const syntax::DataDecl* data = nullptr);
    TypeSymbol* findType(NameId name) const;
    bool reportTypeBehindName(const syntax::DataDecl& decl);
    const Type* ensureType(TypeSymbol& symbol);
    void resolveRecord(Type& type, const syntax::RecordDecl& decl);
    void resolveAlias(Type& type, const syntax::AliasDecl& decl);
    void resolveSignature(RoutineSymbol& symbol);
    void resolveParameter(RoutineSymbol& routine, const syntax::ParamDecl& decl);
    DataSymbol& newParameter(RoutineSymbol& routine);
    static bool isValueType(const Type& type);
    static bool isHandle(const Type& type) { return !isValueType(type) && type.kind != TypeKind::SemiValue; }
    static bool isReal(const Type& type) {
        return type.kind != TypeKind::Switch && type.kind != TypeKind::AnyType;
    }

    // ---- data (resolve_data.cpp)
    void ensureData(DataSymbol& symbol);
    void ensureValue(DataSymbol& symbol);
    uint64_t resolveDimensions(DataSymbol& symbol, const syntax::DataDecl& decl);
    std::string describeDimension(const syntax::Expr& e, Typed t);
    void initialise(DataSymbol& symbol, const syntax::DataDecl& decl);
    void checkDeclaration(DataSymbol& symbol);
    void reportNonConstant(const syntax::Expr& e);
    const syntax::Expr* findNonConstant(const syntax::Expr& e);
    const syntax::Expr* findNonLiteral(const syntax::Expr& expr) const;

    // ---- expressions (expr*.cpp)
    Typed expr(const syntax::Expr& e, const DataType* want = nullptr, ConstValue* slot = nullptr);
    ExprInfo& info(const syntax::Expr& e) { return context_.exprs->at(e.id); }
    FileFacts& facts() { return *context_.module->facts; }
    Typed errorExpr(const syntax::Expr& e);
    Typed literal(const syntax::NumLiteralExpr& e, const DataType* want, ConstValue* slot);
    Typed placeValue(const syntax::Expr& e);
    Typed paren(const syntax::ParenExpr& e, const DataType* want, ConstValue* slot);
    Typed unary(const syntax::UnaryExpr& e, const DataType* want, ConstValue* slot);
    Typed binaryChain(const syntax::BinaryExpr& e, const DataType* want);
    Typed combine(const syntax::BinaryExpr& e, Typed left, Typed right);
    Typed arithmetic(const syntax::BinaryExpr& e, Typed left, Typed right);
    void checkIntegerOperands(const syntax::BinaryExpr& e);
    Typed vectorArithmetic(const syntax::BinaryExpr& e, Typed left, Typed right);
    Typed comparison(const syntax::BinaryExpr& e, Typed left, Typed right);
    Typed equality(const syntax::BinaryExpr& e, Typed left, Typed right);
    Typed logic(const syntax::BinaryExpr& e, Typed left, Typed right);
    bool refusesAggregate(const syntax::BinaryExpr& e, const DataType& partner);
    Typed operatorError(const syntax::BinaryExpr& e, Typed left, Typed right);
    enum class Numeric : uint8_t { Ok, Mixed, NotNumeric };
    Numeric unify(const syntax::BinaryExpr& e, Typed& left, Typed& right, Flex& flex);
    bool aggregateFits(const syntax::AggregateExpr& e, const DataType& want);
    Typed aggregate(const syntax::AggregateExpr& e, const DataType* want, ConstValue* slot);
    void visitLoose(const syntax::Expr& e);
    Typed result(const syntax::Expr& e, const Type* type, Flex flex = Flex::None);
    /// Gives an expression of open numeric type the type `to`.
    void settle(const syntax::Expr& e, const Type* to);
    /// Whether `e` fits `want`; settles it. Nothing is reported.
    bool fits(const syntax::Expr& e, Typed t, const DataType& want);
    static bool sameShape(const DataType& found, const DataType& want);
    static bool equivalent(const DataType& found, const DataType& want);
    bool condition(const syntax::Expr& e, const char* what);
    void checkBigLiterals();
    std::string numDnumRemedy(Typed t, const DataType& want) const;

    // ---- references (place.cpp)
    Place place(const syntax::Expr& e, const Type* handle = nullptr);
    static bool isPlaceExpr(const syntax::Expr& e);
    Place namePlace(const syntax::NameExpr& e, const Type* handle);
    Place indexPlace(const syntax::IndexExpr& e, const Type* handle);
    int findComponent(const Type& record, std::string_view name);
    Place componentPlace(const syntax::ComponentExpr& e, const Type* handle);
    void checkIndex(const syntax::Expr& index, int32_t dimension, int64_t& value);

    // ---- folding (fold.cpp)
    /// Where the values are kept that are being worked out.
    Arena& valueArena() { return context_.routine ? facts().inner : facts().values; }
    ConstValue* newConst() { return valueArena().make<ConstValue>(); }
    void warnDivision(const syntax::BinaryExpr& e);
    void foldBinary(const syntax::BinaryExpr& e);
    bool foldArithmetic(const syntax::BinaryExpr& e, double a, double b, bool isDnum, double& out);
    void foldUnary(const syntax::UnaryExpr& e, ConstValue* slot);
    void foldBool(ExprInfo& info, bool value);
    ConstValue owned(const ConstValue& value);
    const ConstValue* partOf(const ConstValue& value);

    // ---- calls (call.cpp: matching; arguments.cpp: judging each argument)
    Typed functionCall(const syntax::CallExpr& e);
    void reportNotAFunction(const syntax::CallExpr& e, const Symbol& symbol);
    bool reportMisread(const RoutineSymbol& routine, const syntax::Argument& arg,
                       syntax::TokenIndex routineName);
    void reportTooMany(const RoutineSymbol& routine, std::span<syntax::Argument* const> args,
                       const syntax::Argument& first, syntax::TokenIndex routineName);
    bool reportAssignmentBelow(const syntax::Argument& arg);
    bool namesOptional(const RoutineSymbol& routine, const syntax::Argument& arg);
    /// `isLast`: nothing follows that would have to stand before it.
    size_t matchUnmarked(const RoutineSymbol& routine, const syntax::Argument& arg, bool isLast);
    size_t namedParameter(const RoutineSymbol& routine, NameId name);
    size_t namedOptional(const RoutineSymbol& routine, NameId name);
    void checkDim(const syntax::CallExpr& e, const RoutineSymbol& routine);
    void bindCall(const syntax::Node& node, RoutineSymbol& routine, syntax::TokenIndex name,
                  std::span<syntax::Argument* const> args);
    /// Gives each written argument its parameter; false when "missing" would only repeat what was reported.
    bool matchArguments(BoundCall& call, syntax::TokenIndex name, std::span<syntax::Argument* const> args);
    size_t matchRequired(BoundCall& call, const syntax::Argument& arg, size_t slot, bool isLast);
    size_t matchOptional(BoundCall& call, const syntax::Argument& arg, syntax::TokenIndex name);
    size_t chooseAlternative(BoundCall& call, const syntax::Argument& arg, size_t first, size_t end);
    bool endsWell(syntax::TokenIndex name, std::span<syntax::Argument* const> args) const;
    size_t alternativesEnd(const RoutineSymbol& routine, size_t first) const;
    size_t nextRequired(const RoutineSymbol& routine, size_t from) const;
    size_t requiredSlots(const RoutineSymbol& routine) const;
    /// The next required parameter without an argument; as many as there are parameters when each has its own.
    size_t nextLacking(const BoundCall& call, size_t from) const;
    void reportMissing(const BoundCall& call, syntax::TokenIndex name);
    void checkExclusive(const BoundCall& call);
    void visitArgument(const syntax::Argument& arg);
    void visitArguments(std::span<syntax::Argument* const> args);
    void lateCall(const syntax::CallStmt& stmt);

    void checkArgument(const RoutineSymbol& routine, BoundArg& bound);
    void checkConditional(const RoutineSymbol& routine, BoundArg& bound);
    void judgeConditional(const RoutineSymbol& routine, const BoundArg& bound, const syntax::Expr& e);
    void checkReference(const RoutineSymbol& routine, const BoundArg& bound);
    void judgeReference(const RoutineSymbol& routine, const BoundArg& bound, const Place& place);
    void reportArguments(const BoundCall& call, syntax::TokenIndex name, size_t firstMismatch, bool missing);
    bool couldStandFor(const syntax::Expr& value, std::span<const BoundArg> params);
    std::span<const BoundArg> leftOut(const BoundCall& call, std::vector<const syntax::Expr*>& moved);
    void takeBack(const std::vector<const syntax::Expr*>& moved);
    static std::string namesOf(std::span<const BoundArg> alternatives);
    bool explainArguments(const BoundCall& call, syntax::TokenIndex name,
                          std::span<syntax::Argument* const> args);
    bool explainComma(std::span<syntax::Argument* const> args);
    bool explainOrder(const RoutineSymbol& routine, const std::vector<const DataSymbol*>& params,
                      const std::vector<const syntax::Expr*>& given);
    bool explainCount(const RoutineSymbol& routine, syntax::TokenIndex name,
                      const std::vector<const DataSymbol*>& params,
                      const std::vector<const syntax::Expr*>& given);
    bool errorsLieIn(const std::vector<const syntax::Expr*>& given) const;
    bool couldBe(const syntax::Expr& e, const DataSymbol& param);
    static bool mayStandFor(const DataSymbol& root, syntax::ParamMode mode);
    void reportSwapped(const RoutineSymbol& routine, const DataSymbol& one, const DataSymbol& other,
                       const syntax::Expr& first, const syntax::Expr& second, bool certain);
    bool reportMisspeltSeparator(const RoutineSymbol& routine, const syntax::Argument& arg, size_t slot,
                                 bool isLast);
    bool reportEqualAsAssign(const BoundArg& bound);
    void judgeValue(const RoutineSymbol& routine, const BoundArg& bound, Typed t);
    void checkAccess(const RoutineSymbol& routine, const BoundArg& bound, const Place& place);
    bool isDotForComma(const syntax::Expr& e);
    diag::Diagnostic& reportAccess(const RoutineSymbol& routine, const BoundArg& bound, const Symbol* symbol,
                                   std::string found);
    void fixParentheses(diag::Diagnostic& d, const syntax::Expr& e);
    static const char* missingClass(ParamClass accepts, const DataType& found);
    bool checkClass(const RoutineSymbol& routine, const BoundArg& bound, const DataType& type);
    void checkPresent(const BoundArg& bound);
    DataSymbol* ownParameter(const syntax::Expr& e);
    DataSymbol* ownOptional(const syntax::Expr& e);
    const Type* handleHint(const DataSymbol& param) const;
    static std::string describeExpr(const syntax::Expr& e);

    // ---- routines and instructions (routine.cpp, stmt*.cpp, jumps.cpp)
    void checkRoutine(RoutineSymbol& symbol);
    void declareInRoutine(Symbol& symbol);
    void declareRoutineData(const syntax::DataDecl& decl);
    void checkErrorNumber(const syntax::Expr& e, const char* what);
    void checkListedError(const syntax::Expr& e);
    bool mayBeErrorNumber(const syntax::Expr& e);
    bool checkPart(Part part, syntax::StmtList list);
    bool movesRobot(const RoutineSymbol& routine) const;
    void callInUndo(const RoutineSymbol& routine, syntax::TokenIndex name);
    bool block(syntax::StmtList list); ///< a new block; whether its end can be reached
    bool statements(syntax::StmtList list);
    bool statement(const syntax::Stmt& s);
    bool isCallWord(const syntax::CallStmt& s);
    bool wholeStatement(const syntax::Stmt& s);
    bool ifStmt(const syntax::IfStmt& s);
    bool testStmt(const syntax::TestStmt& s);
    void testValues(const syntax::TestStmt& s, Typed subject);
    bool forStmt(const syntax::ForStmt& s);
    bool whileStmt(const syntax::WhileStmt& s);
    void assign(const syntax::AssignStmt& s);
    bool assignsResult(const syntax::Expr& target);
    bool assignable(const Place& place, const syntax::Expr& target);
    bool predefinedCall(const RoutineSymbol& routine, syntax::TokenIndex name);
    void raiseToUser(const syntax::CallStmt& s);
    // cyclic_condition.cpp
    void cyclicCondition(const syntax::CallStmt& s);
    std::string notCyclic(const syntax::Expr& e, const syntax::Expr*& culprit);
    std::string notCyclicData(const syntax::Expr& e);
    bool callStmt(const syntax::CallStmt& s);
    bool namesProcedure(std::span<syntax::Argument* const> args);
    bool isParenthesised(const syntax::CallStmt& s) const;
    void reportParentheses(const syntax::CallStmt& s);
    bool isCutBySemicolon(const Symbol& symbol, syntax::TokenIndex name);
    void reportNotCallable(const Symbol& symbol, syntax::TokenIndex name);
    void returnStmt(const syntax::ReturnStmt& s);
    void raiseStmt(const syntax::RaiseStmt& s);
    bool reportConnectSwapped(const syntax::ConnectStmt& s);
    void connectStmt(const syntax::ConnectStmt& s);
    bool reportLabelWithoutColon(const syntax::CallStmt& s);
    bool isLineOfText(const syntax::CallStmt& s);
    void connectTarget(const syntax::Expr& target);
    void labelStmt(const syntax::LabelStmt& s);
    void placeholder(const syntax::Node& node);
    bool callsOldProcedure(const syntax::Stmt& s);
    void loopWord(const syntax::Stmt& s, const char* word);
    void resolveJumps();
    std::string nearLabel(NameId name);
    void reportUntestedOptionals();
    bool hasErrorHandler() const {
        return context_.routine && !context_.routine->routineDecl->errors.empty();
    }
    bool isInside(uint32_t block, uint32_t outer) const;
    const Symbol* localEntry(const Task& task, NameId name);
    void checkEntry(Task& task);

    // ---- state
    CheckedProgram& program_;
    const CheckOptions& options_;
    diag::Sink& sink_;
    diag::Sink* collect_ = nullptr;    ///< what is wrong with the arguments of the call being checked
    std::deque<diag::Sink> callSinks_; ///< one for each call around another
    size_t callDepth_ = 0;
    Interner interner_;
    Context context_;
    Task* task_ = nullptr;
    Type* anyType_ = nullptr;
    Type* switchType_ = nullptr;
    const Type* intnum_ = nullptr;
    std::vector<Symbol*> predefined_; ///< by NameId
    std::vector<Symbol*> globals_;    ///< of the task, by NameId
    std::vector<std::string> taskNames_;
    std::vector<DataSymbol*> configured_; ///< signals and mechanical units of the task, by NameId
    std::vector<std::unique_ptr<ModuleScope>> scopes_; ///< by Module::id
    NameMap<Module> moduleNames_;                      ///< of the task
    std::vector<TaskFile> files_;                      ///< of the task
    std::vector<DataSymbol*> assumed_, spareAssumed_;  ///< configured objects known by use; old ones
    const NameMap<Symbol>* earlier_ = nullptr; ///< what the module declared when it was checked before
    bool keeps_ = false;       ///< facts are kept when other files change: they must not share memory
    bool entangled_ = false;   ///< see TaskScope
    bool leaveUnread_ = false; ///< the value of the name that is looked at concerns nobody
    uint32_t lastStamp_ = 0;   ///< of a check of a file
    std::vector<Symbol*> routineNames_; ///< by NameId: parameters, data and loop variables of the routine
    std::vector<NameId> declaredInRoutine_;
    SignalUses signalUses_;
    bool duplicateModule_ = false;            ///< its names collide with those of its twin, which is reported
    bool incomplete_ = false;                 ///< modules of the task are missing: names may be unknown
    std::vector<std::string> missingModules_; ///< their names, as far as they are known
    SourceRange
        quietLine_; ///< in the routine: the rest of a line that was meant in another way, which is reported
    syntax::TokenIndex tornUntil_ = syntax::kNoToken; ///< the last word of a name in two, which is reported
    const syntax::SyntaxTree* tornTree_ = nullptr;    ///< where that is
    std::vector<const syntax::SyntaxTree*> brokenTrees_; ///< with syntax errors
    std::unordered_set<NameId> maybeDeclared_;           ///< names in declarations that could not be read
    std::unordered_set<NameId> unknownRoutines_;         ///< reported in this routine
    std::unordered_set<NameId> reportedNames_;           ///< unknown signals, reported once a task
    std::vector<UnknownName> unknownNames_;
    std::vector<Repeat> repeats_; ///< errors of the files checked so far that one mistake explains
    std::vector<const syntax::Expr*> bigLiterals_;
    std::vector<const syntax::BinaryExpr*> spine_;
    std::vector<const syntax::Argument*> judged_; ///< arguments judged already to choose an alternative
    const RoutineSymbol* wideRoutine_ = nullptr;  ///< one with very many parameters, and their names
    NameMap<DataSymbol> wideNames_;
    const Type* wideRecord_ = nullptr; ///< one with very many components, and their names
    std::unordered_map<std::string, int> wideComponents_;
    /// Declarations being resolved inside each other; more than this nobody writes, and the stack is finite.
    static constexpr unsigned kMaxDepth = 500;
    unsigned depth_ = 0;
    static constexpr size_t kMaxComparisons = 4'000'000;
    size_t comparisonsLeft_ = kMaxComparisons; ///< of names with misspelt ones, in the task: they cost time
    static constexpr size_t kMaxPartComparisons = 200'000;
    size_t partComparisonsLeft_ =
        kMaxPartComparisons; ///< of labels, components and parameters, in the routine

    bool blocksAreUnclear_ = false; ///< a line of the routine could not be read: perhaps the word of a block
    /// Records and aliases being resolved, with the data type in them that has been reached.
    std::vector<std::pair<const Type*, syntax::TokenIndex>> resolvingParts_;
    bool muted_ = false; ///< in what could not be read as a whole, which is reported
    diag::Diagnostic unsaid_;
    bool shapeReported_ = false;       ///< an argument of the call has been reported that may hold several
    std::vector<Mismatch> mismatches_; ///< arguments of the wrong type, of the calls being checked

    // of the routine being checked
    Part part_ = Part::Body;
    unsigned loopDepth_ = 0;
    bool breakSeen_ = false;
    bool returnSeen_ = false;
    std::unordered_set<NameId> jumpNames_; ///< after GOTO in this routine, once they are asked for
    bool jumpNamesKnown_ = false;
    bool nonValueReported_ = false;         ///< of the operand that was looked at last
    bool broken_ = false;                   ///< an instruction could not be read
    bool presenceOnly_ = false;             ///< a name is looked at for its presence, not for its value
    std::vector<OptionalUse> optionalUses_; ///< by index of the parameter
    uint32_t block_ = 0;
    std::vector<uint32_t> blockParents_;
    std::vector<JumpPoint> labels_;
    NameMap<LabelSymbol> labelNames_;
    std::vector<JumpPoint> gotos_;
};

template <class S>
S& Analyzer::fill(S& symbol, SymbolKind kind, const syntax::Node& decl, syntax::TokenIndex name, bool local) {
    symbol.kind = kind;
    symbol.name = text(name);
    symbol.nameId = idOf(name);
    symbol.module = context_.module;
    symbol.decl = &decl;
    symbol.nameToken = name;
    symbol.isLocal = local;
    symbol.predefined = context_.module->predefined;
    return symbol;
}

// The symbol that other files refer to since an earlier check, emptied, or a new one.
template <class S> S& Analyzer::recycled(Store<S>& store, SymbolKind kind, syntax::TokenIndex name) {
    Symbol* old = earlier_ ? earlier_->find(idOf(name)) : nullptr;
    if (!old || old->kind != kind || old->decl) return store.emplace_back();
    S& symbol = static_cast<S&>(*old);
    symbol.reset();
    return symbol;
}

template <class T> T* at(const std::vector<T*>& table, NameId name) {
    return name < table.size() ? table[name] : nullptr;
}
template <class T> void put(std::vector<T*>& table, NameId name, T* value) {
    if (name >= table.size()) table.resize(name + name / 2 + 64, nullptr);
    table[name] = value;
}
template <class T> T* symbolAs(Symbol* symbol, SymbolKind kind) {
    return symbol && symbol->kind == kind ? static_cast<T*>(symbol) : nullptr;
}
inline DataSymbol* asData(Symbol* symbol) {
    return symbolAs<DataSymbol>(symbol, SymbolKind::Data);
}
inline RoutineSymbol* asRoutine(Symbol* symbol) {
    return symbolAs<RoutineSymbol>(symbol, SymbolKind::Routine);
}
inline TypeSymbol* asType(Symbol* symbol) {
    return symbolAs<TypeSymbol>(symbol, SymbolKind::Type);
}

} // namespace rapid::sema
