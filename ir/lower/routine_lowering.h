#pragma once
// Lowers one routine: statements, expressions, calls, handlers. Split over lower_*.cpp by subject.

#include "ir/lower/program_lowering.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <unordered_map>

namespace rapid::lower {

/// Signature and names of a routine whose body follows later.
ir::Routine declareRoutine(ProgramLowering& program, const sema::RoutineSymbol& symbol, uint32_t task);

/// Says whether the text of a routine was changed since an earlier compilation; layout and comments do not count.
uint32_t textHash(const sema::RoutineSymbol& symbol);

// Size: one method for each kind of node; they share the builder, the locals and the handler of one routine.
class RoutineLowering {
  public:
    /// `declared` is the result of declareRoutine(); the finished routine is returned by run().
    RoutineLowering(ProgramLowering& program, const sema::RoutineSymbol& symbol, uint32_t task,
                    const ir::Routine& declared);
    ir::Routine run();
    /// After run(): the routine needs its error handler as a routine of its own as well.
    bool needsDetachedHandler() const;
    /// That one, instead of run(). `body` has lowered the routine itself.
    ir::Routine runDetached(const RoutineLowering& body);

  private:
    using Expr = syntax::Expr;
    using ValueId = ir::ValueId;

    /// The address of a data object of the routine.
    struct Slot {
        enum class Kind : uint8_t { Local, Pointer, IntLoop } kind = Kind::Local;
        uint32_t local = ir::kNone; ///< Local: the object; Pointer: its address, if not the
                                    ///< argument itself; IntLoop: the I32 counter
        uint32_t param = ir::kNone; ///< parameters: number of the IR parameter
        uint32_t name = ir::kNone;  ///< the one with the name of the argument (ArgName)
        bool optional = false;      ///< must be checked before use
        int64_t lo = 0, hi = 0;     ///< IntLoop: range of the counter
    };
    /// An addressed data object. `dims` are I32 values where the type's dims are 0.
    struct Place {
        ValueId addr = ir::kNone;
        sema::DataType type;
        std::array<ValueId, 3> dims{ir::kNone, ir::kNone, ir::kNone};
    };
    /// Data that the detached handler reaches: positions in Routine::sharedLocals.
    struct SharedData {
        struct Parameter {
            uint32_t position = 0;
            ir::TypeId type = ir::kVoid;
        };
        std::unordered_map<uint32_t, Parameter> params; ///< by number of the IR parameter, kept in a local
        std::unordered_map<const sema::DataSymbol*, uint32_t> objects; ///< of Slot::local
        uint32_t result = ir::kNone, resultLocal = ir::kNone;
    };
    struct IntRange {
        int64_t lo = 0, hi = 0;
    };
    struct LoopTargets {
        ir::BlockId onBreak, onContinue;
    };
    /// Statements that are charged together: those of a routine or handler outside its loops, or of a loop in each round.
    struct CostScope {
        uint32_t id = 0;
        uint32_t statements = 0;
        CostScope* outer = nullptr;
        uint32_t cost() const { return statements > 0 ? statements : 1; }
    };
    /// How far the code of a scope has come at a label.
    struct LabelCost {
        uint32_t scope = 0, statements = 0;
    };
    /// A loop that counts: bounds as I32, so that the number of its rounds can be computed ahead.
    struct Counting {
        ValueId first = ir::kNone, last = ir::kNone; ///< `last` is included
        int32_t step = 1;
        ValueId upward = ir::kNone; ///< Bool, when only execution shows the direction; step is 1 then
    };
    /// How a FOR loop counts, as far as it is known at compile time.
    struct ForPlan {
        enum class Kind : uint8_t { Float, Counted, StepValue, UnknownDirection } kind = Kind::Float;
        int32_t step = 0; ///< Counted: the step; StepValue: 1 or -1, its sign
        IntRange from, variable;
    };

    // lower_routine.cpp
    void lowerParameters();
    void copyArrayParameter(const sema::DataSymbol& param, Slot& slot);
    void lowerData();
    void clearArrayBuffers(ir::BlockId entry);
    void lowerHandlers();
    void lowerBackwardHandler();
    /// Describes a local to the debugger (stepping profile only).
    void describeLocal(uint32_t local, const sema::DataType& type);
    void describeOptional(const sema::DataSymbol& param, const Slot& slot);
    void describeReference(const sema::DataSymbol& param, const Slot& slot);
    void describeSwitch(const sema::DataSymbol& param, const Slot& slot);
    void lowerErrorHandler();
    void lowerErrorClauses();
    bool lowerListedNumber(const Expr& number, ir::BlockId body);
    bool hasRetry() const { return hasErrorHandler_; }

    // lower_detached.cpp
    uint32_t share(uint32_t local);
    void shareData();
    void lowerTakeDecision();
    ValueId sharedAddress(uint32_t position);
    ValueId parameter(uint32_t number);
    void bindShared(const sema::DataSymbol& symbol, Slot slot);
    void endDetached(int32_t decision);
    void lowerRetry();
    void lowerTryNext();
    void lowerDetachedReturn(const syntax::ReturnStmt& stmt);
    void lowerRaiseToUser(const sema::BoundCall& call);

    // lower_stmt.cpp
    void lowerList(syntax::StmtList list);
    void lowerStmt(const syntax::Stmt& stmt);
    bool lowerIncomplete(const syntax::Stmt& stmt);
    uint8_t statementFlags(const syntax::Stmt& stmt) const;
    struct CallSearch; ///< lower_resume.cpp
    uint8_t resumeFlags(const syntax::Stmt& stmt, size_t row) const;
    void lowerAssign(const syntax::AssignStmt& stmt);
    void lowerIf(const syntax::IfStmt& stmt);
    void lowerCompactIf(const syntax::CompactIfStmt& stmt);
    void lowerWhile(const syntax::WhileStmt& stmt);
    void lowerTest(const syntax::TestStmt& stmt);
    void lowerReturn(const syntax::ReturnStmt& stmt);
    void lowerRaise(const syntax::RaiseStmt& stmt);
    bool isStartMoveRetry(const syntax::Stmt& stmt) const;
    void lowerIgnoredInUndo(const char* instruction);
    void lowerConnect(const syntax::ConnectStmt& stmt);
    void lowerExit();
    ir::BlockId labelBlock(const syntax::Node* label); ///< `label`: its LabelStmt
    void startStatement(const syntax::Node& node, ir::StmtKind kind);

    // lower_cost.cpp: what execution costs, equal in all profiles
    void openCosts(CostScope& scope);
    void closeCosts();
    void chargeAtFront(ir::BlockId block, uint32_t cost);
    ir::StmtId firstStatement(ir::BlockId block) const;
    void chargeJump(const syntax::Node* label);
    void chargeRounds(const Counting& counting, uint32_t cost);
    bool isFreeOfCalls(size_t firstInst) const;

    // lower_placeholder.cpp
    bool containsPlaceholder(const syntax::Node& node) const;
    bool isIncomplete(const Expr& expr) const;
    bool isIncompleteCall(const syntax::Node& node) const;
    void reachPlaceholder(const syntax::Node& node);
    void evaluate(const Expr& expr);
    bool callsAnything(const syntax::Node& node) const;
    ValueId zeroOf(ir::TypeId type);

    // lower_loops.cpp
    void lowerFor(const syntax::ForStmt& stmt);
    ForPlan planFor(const syntax::ForStmt& stmt, const sema::DataSymbol& variable) const;
    /// `stepValue`: the step when it is known at run time only; `step` then has its sign.
    void lowerIntLoop(const syntax::ForStmt& stmt, sema::DataSymbol& variable, const ForPlan& plan,
                      ValueId stepValue);
    void lowerUnknownDirection(const syntax::ForStmt& stmt, sema::DataSymbol& variable, const ForPlan& plan);
    void lowerCountedBody(const syntax::ForStmt& stmt, sema::DataSymbol& variable, ValueId first,
                          ValueId last, int32_t step, IntRange range, ValueId stepValue = ir::kNone);
    void lowerFloatLoop(const syntax::ForStmt& stmt, sema::DataSymbol& variable, const ForPlan& plan);
    /// Head, body and latch, which all forms have: another round follows while `continues` gives TRUE.
    void lowerRounds(const syntax::ForStmt& stmt, const std::optional<Counting>& counting,
                     const std::function<ValueId()>& continues, const std::function<void()>& increment);
    std::optional<Counting> countingOf(const ForPlan& plan, ValueId from, ValueId to);
    ValueId boundAsInt(ValueId value, bool roundDown); ///< num to I32, toward minus or plus infinity

    // lower_expr.cpp
    ValueId lowerValue(const Expr& expr); ///< scalar in its own type
    ValueId lowerValueAs(const Expr& expr, const sema::Type* wanted);
    ValueId lowerAddr(const Expr& expr); ///< aggregate or handle: address of storage or temporary
    void lowerInto(const Expr& expr, const sema::DataType& type, ValueId dst);
    bool isJoin(const Expr& expr) const;
    void joinInto(const syntax::BinaryExpr& expr, const sema::DataType& type, ValueId dst, ValueId buffer);
    ValueId lowerBool(const Expr& expr);
    ValueId keptUntil(const Expr& later, const Expr& expr, const sema::DataType& type, ValueId address);
    /// Of constant data with the value. In the stepping profile arguments are copies: the debugger can change parameters.
    ValueId constantAddress(const sema::ConstValue& value, const sema::DataType& type);
    void storeExpr(const Expr& expr, const sema::DataType& type, ValueId dst);
    void lowerCond(const Expr& expr, ir::BlockId ifTrue, ir::BlockId ifFalse);
    ValueId lowerBinary(const syntax::BinaryExpr& expr);
    ValueId lowerArithmetic(syntax::BinaryOp op, ValueId a, ValueId b, bool isDnum);
    ValueId lowerIntegerDivision(bool modulo, ValueId a, ValueId b, bool isDnum);
    ValueId lowerComparison(const syntax::BinaryExpr& expr);
    ValueId lowerEquality(const Expr& left, const Expr& right);
    ValueId equalPlaces(ValueId a, ValueId b, const sema::DataType& type);
    ValueId lowerShortCircuit(const syntax::BinaryExpr& expr);
    ValueId constantScalar(const sema::ConstValue& value, ir::TypeId type);
    bool namesSignal(const Expr& expr) const;
    ValueId readSignal(const Expr& expr, bool asDnum);
    bool isCheap(const Expr& expr) const;
    bool mayFail(const syntax::BinaryExpr& expr) const;
    bool mayFailHalfway(const Expr& value) const;

    // lower_vector.cpp: pos and orient arithmetic, component by component
    bool isVectorOp(const Expr& expr) const;
    std::vector<ValueId> lowerComponents(const Expr& expr);
    void lowerVectorInto(const Expr& expr, ValueId dst);

    // int_range.cpp: num expressions that are certainly integers
    std::optional<IntRange> intRange(const Expr& expr) const; ///< that lowerInt can compute
    /// The same in all profiles, for costs: loop variables count by their range even where they are kept as num.
    std::optional<IntRange> valueRange(const Expr& expr) const;
    std::optional<IntRange> rangeOfCall(const Expr& call) const;
    std::optional<IntRange> rangeOf(const Expr& expr, bool ofValue) const;
    ValueId lowerInt(const Expr& expr);

    // lower_access.cpp
    Place place(const Expr& expr);
    Place reference(const Expr& expr); ///< the object itself, even where a signal represents its value
    Place placeOf(const sema::DataSymbol& symbol);
    /// Copies the present value of ERRNO, C_MOTSET ... to `address`.
    void readSystemVariable(const sema::DataSymbol& symbol, ValueId address);
    Place elementPlace(const syntax::IndexExpr& expr);
    ValueId lowerIndex(const Expr& index, ValueId dim, int32_t knownDim, bool& safe);
    ValueId dimValue(const Place& p, int k);
    const sema::DataSymbol* rootSymbol(const Expr& expr) const;
    bool mentions(const Expr& expr, const sema::DataSymbol& target) const;
    bool mayAlias(const Expr& value, const Expr& target) const;
    void checkPresent(const Slot& slot);
    ValueId objectAddress(const Slot& slot);
    ValueId addressIfPresent(const Slot& slot);

    // lower_evaluated.cpp
    /// The value of a constant expression, or of a call that is evaluated; null for others.
    const sema::ConstValue* constantOf(const Expr& expr);
    const sema::ConstValue* evaluatedCall(const syntax::Node& node, const sema::BoundCall& call);
    std::optional<ConstArguments> constantArguments(const sema::BoundCall& call);
    ValueId lowerEvaluated(const sema::ConstValue& value, const sema::DataType& type, ValueId resultAddr);

    // lower_call.cpp
    ValueId lowerCall(const syntax::Node& node, ValueId resultAddr); ///< CallExpr or CallStmt
    ValueId lowerSpecial(const sema::BoundCall& call, bool& done);
    ValueId lowerPresent(const sema::BoundCall& call);
    ValueId lowerDim(const sema::BoundCall& call);
    void lowerWaitUntil(const sema::BoundCall& call);
    // lower_condition.cpp
    void lowerCyclicCondition(const sema::BoundCall& call);
    void lowerOperand(const Expr& outer, bool asDnum);
    void lowerCondition(const syntax::BinaryExpr& expr);
    void pushArgument(const sema::BoundArg& arg, std::vector<ValueId>& args);
    void pushValue(const sema::BoundArg& arg, std::vector<ValueId>& args);
    void pushPointerArgument(const sema::BoundArg& arg, std::vector<ValueId>& args);
    void pushConditional(const sema::BoundArg& arg, std::vector<ValueId>& args);
    void pushAny(const sema::BoundArg& arg, std::vector<ValueId>& args);
    ValueId copyOfArray(const Place& p);
    void findChangedArguments(const sema::BoundCall& call);
    bool callsRoutine(const syntax::Node& node) const;
    ValueId argumentAddress(const sema::BoundArg& arg);
    ValueId typeAddress(const Place& p); ///< description of its type, made at run time for conformant arrays
    const sema::BoundArg* findArg(const sema::BoundCall& call, std::string_view name) const;

    // lower_named.cpp
    ValueId lowerForeignCall(const sema::BoundCall& call, ValueId resultAddr);
    ValueId lowerErasableCall(const sema::BoundCall& call, ValueId resultAddr);
    ValueId isInMemory(const sema::Symbol& symbol);
    using DataTest = std::function<bool(const sema::DataSymbol&)>;
    void collectData(const syntax::Node& node, const Expr* except, const DataTest& test,
                     std::vector<const sema::DataSymbol*>& out) const;
    void requireData(ValueId condition, sema::LanguageError error, std::string_view missing);
    void checkForeignData(const syntax::Node& part);
    void checkData(const syntax::Node& part);
    void lowerLateCall(const syntax::CallStmt& stmt);
    void callByName(ValueId name, std::span<const sema::BoundArg> args, ir::RoutineKind kind, ValueId result);
    void lateValue(const sema::BoundArg& arg, ValueId present, std::vector<ValueId>& out);
    int32_t lateFlags(const sema::BoundArg& arg) const;
    ValueId argumentName(const sema::BoundArg& arg);
    void lowerArgName(const sema::BoundCall& call, ValueId resultAddr);

    // lower_array.cpp
    Place rowOf(const Place& array, ValueId addr) const;
    ValueId elementCount(const Place& array, int from); ///< I32; of the dimensions from number `from` on
    ValueId byteCount(const Place& array);              ///< I64
    void checkSameSize(const Place& a, const Place& b);
    void checkShape(const Expr& expr, const Place& target);
    void storeArray(const Expr& expr, const Place& target);
    Place arrayTemporary(const Expr& expr);
    void assignArray(const Expr& value, const Place& target, const Expr& written);
    bool isOfKnownSize(const Expr& value, const sema::DataType& target) const;

    bool reachesRoutineData(const syntax::Node& node) const; // lower_routine.cpp

    // lower_open.cpp
    void raiseUnresolved(sema::LanguageError error, std::string_view name);
    bool lowerUnresolved(const syntax::Node& statement, const syntax::Node& part, ir::StmtKind kind);
    bool lowerOpenHead(const Expr& expr);
    bool beginsWithoutValue(const sema::DataSymbol& data) const;
    void checkAssigned(const syntax::Node& part);
    void noteAssigned(const Expr& target);
    std::string_view missingReference(const syntax::Node& node, sema::LanguageError& error) const;
    std::string_view missingComponent(const syntax::Node& node) const;
    std::string_view missingInName(const syntax::NameExpr& name, sema::LanguageError& error) const;
    std::string_view missingInCall(const syntax::Node& node, syntax::TokenIndex name,
                                   sema::LanguageError& error) const;
    std::string_view missingInResult(const sema::RoutineSymbol& routine, sema::LanguageError& error) const;
    std::string_view missingInCallStmt(const syntax::CallStmt& stmt, sema::LanguageError& error) const;

    // helpers
    const sema::FileFacts& facts() const { return *module_->facts; }
    const sema::ExprInfo& info(const Expr& expr) const { return (*module_->exprs)[expr.id]; }
    const sema::Type* baseType(const Expr& expr) const { return info(expr).type().type->base(); }
    static const Expr& unparen(const Expr& expr);
    uint32_t temp(ir::TypeId type);
    ValueId tempAddr(ir::TypeId type) { return b_.localAddr(temp(type)); }
    sema::DataType scalarType(const sema::Type* type) const { return {type, 0, {0, 0, 0}}; }
    void branchIfOpen(ir::BlockId target) {
        if (!b_.terminated()) b_.br(target);
    }
    const Slot* findSlot(const sema::DataSymbol& symbol) const;

    ProgramLowering& program_;
    const sema::RoutineSymbol& symbol_;
    const sema::Module* module_;
    uint32_t task_;
    ir::Routine routine_;
    ir::Builder b_;
    std::unordered_map<const sema::DataSymbol*, Slot> slots_;
    SharedData shared_;
    const RoutineLowering* body_ = nullptr; ///< detached handler: of its routine
    mutable std::unordered_map<const syntax::Stmt*, std::shared_ptr<CallSearch>>
        searches_; ///< of resumeFlags
    std::unordered_map<const syntax::Node*, ir::BlockId> labels_;
    std::vector<LoopTargets> loops_;
    CostScope* costs_ = nullptr; ///< null: statements that another profile lacks, which cost nothing
    uint32_t costScopes_ = 0;
    std::unordered_map<const syntax::Node*, LabelCost> labelCosts_;
    std::unordered_map<const sema::DataSymbol*, IntRange> loopRanges_; ///< of FOR variables
    std::unordered_set<const sema::BoundArg*> changesBeforeUse_; ///< IN arguments that this routine copies
    std::vector<uint32_t> arrayBuffers_; ///< locals with the address of a buffer, null until it is needed
    std::multimap<ir::TypeId, uint32_t> freeTemps_;
    std::vector<std::pair<ir::TypeId, uint32_t>> usedTemps_;
    bool hasErrorHandler_ = false;
    bool routineHasPlaceholders_ = false;
    bool reachesData_ = false;    ///< calls what reads or writes data by name
    bool describesData_ = false;  ///< its data can be found by name: by the debugger, or by what it calls
    bool inInstructions_ = false; ///< past the data: from here on the error handler is responsible
    enum class Region : uint8_t { Body, Error, Undo, Backward } region_ = Region::Body;
};

} // namespace rapid::lower
