#pragma once
// The checked program: trees with every name resolved, every expression typed, every call matched to its parameters.
// Output of sema, input of ir/lower.

#include "frontend/diag/diagnostic.h"
#include "frontend/sema/node_map.h"
#include "frontend/sema/symbols.h"

#include <algorithm>
#include <array>

namespace rapid::sema {

/// Facts about one expression, by Expr::id in its tree.
///
/// A signal (and a part of a signal array) that is read as a value has the type `num` or, for groups where the context
/// asks for it, `dnum`: the types of info and of the symbol then differ. Passed on as a signal it keeps its own type.
/// A literal is `num` or `dnum` by context, and so is an expression of literals only; `constant` is rounded to it.
/// Programs have millions of them, so the type is held by reference.
struct ExprInfo {
    explicit ExprInfo(const Type& scalar) : type_(&scalar.scalar) {}
    /// Aggregates: the type the context gave them.
    const DataType& type() const { return *type_; }
    void setType(const Type& scalar) { type_ = &scalar.scalar; }
    /// The shape of an array is copied to `arena`, which must live as long as the facts.
    void setType(const DataType& type, Arena& arena) {
        type_ = type.rank == 0 ? &type.type->scalar : arena.copy(std::span(&type, 1)).data();
    }

    Symbol* symbol = nullptr;             ///< NameExpr: what it names; CallExpr: the function
    const ConstValue* constant = nullptr; ///< value when it is a constant expression (folded), else null

  private:
    const DataType* type_;
};

/// The ExprInfo of all expressions of a tree, by Expr::id, made where they are first asked for. A plain
/// aggregate that fits its data never has any: the symbol has its type and value.
class ExprTable {
  public:
    ExprTable(uint32_t count, const Type* unknown, Arena& arena)
        : arena_(arena), chunks_((count + kPerChunk - 1) / kPerChunk, nullptr), none_(*unknown) {}
    const ExprInfo& operator[](uint32_t id) const {
        const ExprInfo* chunk = id / kPerChunk < chunks_.size() ? chunks_[id / kPerChunk] : nullptr;
        return chunk ? chunk[id % kPerChunk] : none_;
    }
    ExprInfo& at(uint32_t id) {
        if (id / kPerChunk >= chunks_.size())
            chunks_.resize(id / kPerChunk + 1); // elements that were made since
        ExprInfo*& chunk = chunks_[id / kPerChunk];
        if (!chunk) chunk = makeChunk();
        return chunk[id % kPerChunk];
    }
    /// Forgets everything; the memory goes with the arena.
    void clear() { std::fill(chunks_.begin(), chunks_.end(), nullptr); }

  private:
    static constexpr uint32_t kPerChunk = 64;
    ExprInfo* makeChunk();

    Arena& arena_;
    std::vector<ExprInfo*> chunks_;
    ExprInfo none_; ///< not checked: the type that fits everything
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
    const Module* module = nullptr; ///< of the call
    /// Null: late binding; then `args` hold what was written, param == nullptr.
    RoutineSymbol* routine = nullptr;
    std::span<BoundArg> args;
};

/// The declarations of a file at module level. They outlive a check of its file: other files refer to them.
struct FileSymbols {
    Arena arena;
    Store<Type> types{arena};
    Store<TypeSymbol> typeSymbols{arena};
    Store<DataSymbol> dataSymbols{arena}; ///< with the parameters of routines
    Store<RoutineSymbol> routineSymbols{arena};
};

struct FileSignalUses;

/// How much of the limits that the files of a task share the check of one file has used up.
struct Spent {
    size_t comparisons = 0; ///< of names with misspelt ones
    size_t unknown = 0;     ///< names that nothing declares, kept
    bool operator==(const Spent&) const = default;
};

/// Everything that one check of a file makes, except what belongs to the whole task.
struct FileFacts {
    FileFacts(const syntax::SyntaxTree& tree, const Type* unknown, std::shared_ptr<FileSymbols> own,
              uint32_t number)
        : symbols(std::move(own)), stamp(number), exprs(tree.exprCount, unknown, inner) {}
    /// Drops per-routine facts that only diagnostics and lowering need.
    void dropInner();
    std::shared_ptr<FileSymbols> symbols;
    uint32_t stamp = 0; ///< no two checks of files have the same
    /// The outcome hangs on what others do not declare, or on how they use it: unknown names, signals known by use.
    bool open = false;
    Spent spent;
    std::vector<Symbol*> used; ///< symbols that this file refers to; some more than once
    std::vector<DataSymbol*> assigned;
    std::vector<std::pair<DataSymbol*, syntax::TokenIndex>>
        signals; ///< configured objects it names, in order
    /// How it uses names that nothing declares; null: not looked for. Valid as long as the facts: a check that changes what other
    /// files declare renews them all.
    std::shared_ptr<const FileSignalUses> signalUses;
    Arena values; ///< parts of the values of module data
    Arena inner;  ///< all that follows; values inside routines and arguments, too
    ExprTable exprs;
    NodeMap<syntax::Node, BoundCall> calls{inner}; ///< CallStmt and CallExpr
    NodeMap<syntax::ForStmt, DataSymbol*> loopVariables{inner};
    NodeMap<syntax::Node, Symbol*> references{inner}; ///< ConnectStmt -> trap; GotoStmt -> label
    Store<DataSymbol> locals{inner};                  ///< data and loop variables of routines
    Store<LabelSymbol> labels{inner};
};

struct Module {
    std::string name;
    uint32_t id = 0; ///< position in CheckedProgram::moduleStore
    const syntax::SyntaxTree* tree = nullptr;
    const syntax::ModuleDecl* decl = nullptr;
    bool predefined = false;    ///< part of stdlib
    FileFacts* facts = nullptr; ///< shared by the modules of one tree
    ExprTable* exprs = nullptr; ///< those of `facts`
    std::vector<TypeSymbol*> types;
    std::vector<DataSymbol*> data;        ///< module level, in source order
    std::vector<RoutineSymbol*> routines; ///< in source order
    std::vector<DataSymbol*> persistents; ///< of `data`: those that tasks share
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
    std::vector<DataSymbol*> signals;      ///< configured signals this task names
};

/// Everything owned here; see the accessors. Lower it only when the sink has no errors.
struct CheckedProgram {
    std::vector<std::unique_ptr<syntax::SyntaxTree>> trees; ///< files of the library, then those of the tasks
    std::vector<std::unique_ptr<Task>> tasks;
    std::vector<Module*> predefinedModules; ///< stdlib declarations
    std::vector<std::unique_ptr<Module>> moduleStore;
    std::vector<std::unique_ptr<FileFacts>> facts; ///< of `trees`, in their order
    Arena arena;
    Store<Type> types{arena};             ///< those that no file declares
    Store<TypeSymbol> typeSymbols{arena}; ///< of these
    Store<DataSymbol> dataSymbols{arena}; ///< configured objects

    // Types that the language itself needs.
    const Type *num = nullptr, *dnum = nullptr, *boolean = nullptr, *string = nullptr, *errorType = nullptr;
    std::array<const Type*, kKnownTypes> known{}; ///< by KnownType; null: the library does not declare it

    const ExprInfo& info(const Module& module, const syntax::Expr& expr) const {
        return (*module.exprs)[expr.id];
    }
    const Type* typeOf(KnownType type) const { return known[static_cast<size_t>(type)]; }
    /// Some instruction calls a predefined routine with this trait.
    bool uses(Trait trait) const;
};

} // namespace rapid::sema
