#pragma once
// One walk over a routine: flow of control, assignments, expressions, calls. Internal to frontend/lint.

#include "frontend/lint/facts.h"

#include <bitset>

namespace rapid::lint {

/// Routine variables whose assignments are followed; further ones are not judged.
inline constexpr size_t kMaxTracked = 256;
using Slots = std::bitset<kMaxTracked>;

/// The uses of a parameter or variable by its routine.
enum Access : uint8_t {
    kRead = 1,      ///< its value is used, or it is passed on
    kAssigned = 2,  ///< by an assignment
    kFromCall = 4,  ///< assigned the result of a function: RAPID needs a place for it
    kMentioned = 8, ///< by Present and the like
    kReported = 16,
    kUpdated = 32 ///< an IN parameter got a new value made from its old one, not read yet
};

/// Which parameters of a movement instruction mean what; -1: it has none such.
struct MoveParams {
    int zone = -1, zoneSize = -1, speed = -1, speedValue = -1, time = -1, inPos = -1, concurrent = -1;
};

// Size: one walk over a routine collects the facts of all warnings, because a walk for each would cost the check its speed.
class Walker {
  public:
    Walker(const sema::CheckedProgram& program, const sema::Task& task, Reporter& reporter, TaskFacts& facts)
        : program_(program), task_(task), reporter_(reporter), facts_(facts) {}

    void routine(const sema::RoutineSymbol& routine);

  private:
    using Expr = syntax::Expr;

    // ---- walker.cpp: routines and instructions
    void begin(const sema::RoutineSymbol& routine);
    void handlers(const syntax::RoutineDecl& decl, const Slots& body);
    void errorClause(const syntax::ErrorClause& clause);
    void finish();
    void unusedLabel(const syntax::LabelStmt& label);
    bool isProcedure(std::string_view name) const;
    bool list(syntax::StmtList stmts); ///< whether its end can be reached
    bool statement(const syntax::Stmt& s);
    void unreachable(syntax::StmtList stmts, size_t at);
    void assign(const syntax::AssignStmt& s);
    bool branch(syntax::StmtList body);
    bool ifStmt(const syntax::IfStmt& s);
    void duplicateConditions(const syntax::IfStmt& s);
    bool testStmt(const syntax::TestStmt& s);
    void missingDefault(const syntax::TestStmt& s);
    bool isOpenSubject(const Expr& subject) const;
    bool raises();

    // ---- loops.cpp
    struct LoopMark {
        unsigned waits = 0, exits = 0;
        size_t calls = 0, writes = 0, pending = 0;
        bool outerBreak = false;
        Slots outerWritten;
    };
    struct Label {
        const syntax::Node* node = nullptr;
        const void* list = nullptr;
        LoopMark mark;
    };
    bool whileStmt(const syntax::WhileStmt& s);
    void forStmt(const syntax::ForStmt& s);
    void judgeFor(const syntax::ForStmt& s);
    LoopMark enterLoop();
    bool leaveLoop(const LoopMark& mark); ///< whether there was a BREAK
    unsigned exits() const { return jumps_ + ends_ + errors_; }
    bool isTight(const LoopMark& mark) const { return waits_ == mark.waits && exits() == mark.exits; }
    void suspectLoop(Code code, const syntax::Node& loop, const LoopMark& mark);
    bool changesIn(const Expr& condition, const LoopMark& mark) const;
    void labelStmt(const syntax::LabelStmt& s);
    const sema::Symbol* targetOf(const syntax::GotoStmt& s) const;
    const Label* tightLoopOf(const syntax::GotoStmt& s) const;
    void gotoStmt(const syntax::GotoStmt& s);
    void judgeJumpBack(const syntax::CompactIfStmt& s);

    // ---- data.cpp: reading and writing
    void read(const Expr& name);
    void mention(const Expr& e);
    void write(const Expr& place, uint8_t access, bool fromItself = false);
    void subscripts(const Expr& place);
    void inParameter(const sema::DataSymbol& param, const Expr& place, bool fromItself);
    const sema::DataSymbol* rootOf(const Expr& place) const;
    bool isOwn(const sema::DataSymbol& data) const {
        return data.routine == routine_ && data.index < access_.size();
    }
    void usedTooEarly(const sema::DataSymbol& data, const Expr& e);
    bool isEmptyValue(const sema::DataSymbol& data) const;

    // ---- expressions.cpp
    void expr(const Expr& e, bool partOfText = false);
    void binary(const syntax::BinaryExpr& e, bool partOfText);
    void inexact(const syntax::NumLiteralExpr& e);
    void byteValue(const sema::DataType& wanted, const Expr& value);
    void identical(const syntax::BinaryExpr& e);
    void comparison(const syntax::BinaryExpr& e);
    void judgeSignal(const Expr& signal, const Expr& value);
    void judgeCase(const Expr& subject, const Expr& value);
    void judgeFraction(const Expr& other, const Expr& value, SourceRange where, std::string operation);
    void setFrom(const sema::DataSymbol& data, const Expr& value);
    void judgeFractions();
    bool sameText(const syntax::Node& a, const syntax::Node& b) const;
    void textLength(const syntax::BinaryExpr& e);
    unsigned leastLength(const Expr& e) const;
    const double* number(const Expr& e) const;
    const sema::ConstValue* constant(const Expr& e) const;

    // ---- calls.cpp
    bool call(const syntax::Node& node, std::span<syntax::Argument* const> args);
    void argument(const sema::BoundCall& call, const sema::BoundArg& arg);
    void reference(const sema::BoundCall& call, const sema::BoundArg& arg);
    bool conduct(const sema::BoundCall& call);
    void usesNames();
    void lateCall(const syntax::CallStmt& s);
    void connect(const syntax::ConnectStmt& s);
    void interrupt(const sema::BoundCall& call, const sema::BoundArg& arg);
    const sema::BoundCall* find(const syntax::Node& node) const;
    void movement(const sema::BoundCall& call);
    const MoveParams& moveParams(const sema::RoutineSymbol& routine);
    void wait(const syntax::Node& node, const sema::BoundCall& call);

    const sema::ExprInfo& info(const Expr& e) const { return (*module_->exprs)[e.id]; }
    SourceRange range(const syntax::Node& node) const { return tree_->range(node); }
    std::string text(const syntax::Node& node) const;
    template <size_t N>
    diag::Diagnostic* report(diag::Message<N> message, SourceRange where, diag::MessageArgs<N> args) {
        return reporter_.report(message, *tree_, where, args);
    }
    diag::Diagnostic* report(diag::Message<0> message, SourceRange where) {
        return reporter_.report(message.code, *tree_, where, {});
    }

    const sema::CheckedProgram& program_;
    const sema::Task& task_;
    Reporter& reporter_;
    TaskFacts& facts_;
    std::unordered_map<const sema::RoutineSymbol*, MoveParams> moves_;

    // of the routine
    const sema::RoutineSymbol* routine_ = nullptr;
    const sema::Module* module_ = nullptr;
    const syntax::SyntaxTree* tree_ = nullptr;
    std::vector<uint8_t> access_; ///< of Access, by DataSymbol::index
    std::vector<int16_t> slots_;  ///< by DataSymbol::index; -1: not followed
    std::vector<const syntax::Expr*>
        updates_; ///< of IN parameters, by DataSymbol::index: where kUpdated came from
    size_t tracked_ = 0;
    bool handlerContinues_ = false; ///< an ERROR handler has TRYNEXT: instructions after RAISE are reached
    bool inHandler_ = false;
    bool handlerResumes_ = false; ///< with RETRY or TRYNEXT: the body reads again what the handler assigns
    std::vector<FractionUse> fractions_;                           ///< of data of the routine
    std::set<std::pair<const sema::DataSymbol*, double>> numbers_; ///< fractions such data is set from

    // of the place in the routine
    Slots assigned_; ///< variables that may have been assigned on the way here
    Slots written_;  ///< variables written since the innermost loop began, on any way
    struct Pending {
        const sema::DataSymbol* data = nullptr;
        const syntax::Expr* place = nullptr;
        bool copied = false; ///< the whole value is assigned to other data
    };
    std::vector<Pending> pending_; ///< used before assignment, unless the rest of a loop or a handler assigns
    const syntax::Expr* copied_ = nullptr;        ///< the value of the assignment, if it is a name
    std::vector<const sema::DataSymbol*> writes_; ///< everything written so far, in this order
    unsigned waits_ = 0;                          ///< instructions seen that wait
    unsigned jumps_ = 0;                          ///< and RETURN and GOTO
    unsigned ends_ = 0;                           ///< and what ends the callers too: RAISE, EXIT ...
    unsigned errors_ = 0;                         ///< and what may raise an error, as a way out
    bool breakSeen_ = false;
    unsigned loopDepth_ = 0;
    unsigned branchDepth_ = 0;
    /// The last movement, when it went to a fly-by point and nothing but short instructions came after it.
    const syntax::Node* flyBy_ = nullptr;
    std::unordered_set<const syntax::Node*> targets_; ///< the labels that GOTO names
    std::vector<Label> labels_;
    std::unordered_map<const syntax::Node*, size_t> labelIndex_;
    const void* list_ = nullptr; ///< the list of instructions being walked
};

} // namespace rapid::lint
