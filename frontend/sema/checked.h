#pragma once
// The checked program: trees with every name resolved, every expression typed, every call matched to its parameters.
// Output of sema, input of ir/lower.

#include "frontend/diag/diagnostic.h"
#include "frontend/sema/symbols.h"

#include <deque>
#include <map>
#include <unordered_map>

namespace rapid::sema {

/// Facts about one expression, by Expr::id in its tree.
///
/// A signal (and a part of a signal array) that is read as a value has the type `num` or, for groups where the context
/// asks for it, `dnum`: the types of info and of the symbol then differ. Passed on as a signal it keeps its own type.
/// A literal is `num` or `dnum` by context, and so is an expression of literals only; `constant` is rounded to it.
struct ExprInfo {
    DataType type;                        ///< aggregates: the type the context gave them
    Symbol* symbol = nullptr;             ///< NameExpr: what it names; CallExpr: the function
    int component = -1;                   ///< ComponentExpr: index of the component
    const ConstValue* constant = nullptr; ///< value when it is a constant expression (folded), else null
};

struct Module;

/// One formal parameter of a resolved call and what the call gives for it.
struct BoundArg {
    enum class Kind : uint8_t {
        Absent,
        Present,    ///< `value`; null value for a switch that is given
        Conditional ///< present if the caller's optional parameter `value` (a NameExpr) is present
    };
    DataSymbol* param = nullptr;
    Kind kind = Kind::Absent;
    const syntax::Expr* value = nullptr;
    const syntax::Argument* argument = nullptr; ///< null when nothing was written for the parameter
};

/// A resolved call: one entry per formal parameter, in their order.
struct BoundCall {
    const Module* module = nullptr; ///< where the call stands
    RoutineSymbol* routine =
        nullptr; ///< null: late binding; then `args` hold what was written, param == nullptr
    std::vector<BoundArg> args;
};

struct Module {
    std::string name;
    uint32_t id = 0; ///< position in CheckedProgram::moduleStore
    const syntax::SyntaxTree* tree = nullptr;
    const syntax::ModuleDecl* decl = nullptr;
    bool predefined = false;                ///< part of stdlib
    std::vector<ExprInfo>* exprs = nullptr; ///< shared by the modules of one tree
    std::vector<TypeSymbol*> types;
    std::vector<DataSymbol*> data;        ///< module level, in source order
    std::vector<RoutineSymbol*> routines; ///< in source order
};

/// A configured signal known at compile time.
struct SignalInfo {
    std::string name;
    std::string type; ///< "signaldi", "signaldo", "signalai", "signalao", "signalgi", "signalgo"
};

struct Task {
    std::string name = "T_ROB1";
    std::string type = "NORMAL";
    std::string entry = "main";
    std::vector<Module*> modules;          ///< user modules
    bool incomplete = false;               ///< modules are missing: they may use what seems unused
    RoutineSymbol* entryRoutine = nullptr; ///< null when there is none (reported)
    /// Resolved statement-level facts, keyed by node.
    std::unordered_map<const syntax::Node*, BoundCall> calls; ///< CallStmt and CallExpr
    std::unordered_map<const syntax::ForStmt*, DataSymbol*> loopVariables;
    std::unordered_map<const syntax::Node*, Symbol*> references; ///< ConnectStmt -> trap; GotoStmt -> label
    std::vector<DataSymbol*> signals;                            ///< configured signals this task names
};

/// Everything owned here; see the accessors. Lower it only when the sink has no errors.
struct CheckedProgram {
    std::vector<std::unique_ptr<syntax::SyntaxTree>> trees; ///< user files, then those of the library
    std::vector<std::unique_ptr<Task>> tasks;
    /// Statement-level facts of library routines that are written in RAPID; shared by all tasks.
    Task library;
    std::vector<Module*> predefinedModules; ///< stdlib declarations
    std::deque<Type> typeStore;
    std::deque<TypeSymbol> typeSymbols;
    std::deque<DataSymbol> dataSymbols;
    std::deque<RoutineSymbol> routineSymbols;
    std::deque<ModuleSymbol> moduleSymbols;
    std::deque<LabelSymbol> labelSymbols;
    std::vector<std::unique_ptr<Module>> moduleStore;
    std::vector<std::unique_ptr<std::vector<ExprInfo>>> exprStore;
    std::deque<ConstValue> constStore;

    // Types that the language itself needs.
    const Type *num = nullptr, *dnum = nullptr, *boolean = nullptr, *string = nullptr, *pos = nullptr,
               *orient = nullptr, *errorType = nullptr;

    const ExprInfo& info(const Module& module, const syntax::Expr& expr) const {
        return (*module.exprs)[expr.id];
    }
};

} // namespace rapid::sema
