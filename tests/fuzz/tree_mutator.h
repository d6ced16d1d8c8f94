#pragma once
// Changes of checked programs that mostly leave them valid: expressions become others of their type, operators others of their
// class, literals values at boundaries; statements go, come twice, are swapped, get an IF or a loop around them; routines get
// handlers.

#include "frontend/sema/checked.h"
#include "tests/fuzz/text_mutator.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::fuzz {

/// A piece of the text of a task, in bytes, becomes another.
struct Edit {
    size_t task = 0;
    uint32_t begin = 0, end = 0;
    std::string text;
};

class TreeMutator {
  public:
    /// The program has no errors and one file for each task.
    TreeMutator(const sema::CheckedProgram& program, Random& random);
    /// One change of a kind and at a place chosen at random; empty when the place does not allow it.
    std::optional<Edit> change();

  private:
    /// The place of an expression or an instruction.
    struct Scope {
        size_t task = 0;
        const sema::Module* module = nullptr;
        const sema::RoutineSymbol* routine = nullptr; ///< null: module level
    };
    /// Value: any expression of the type may be here. Constant: those known when the program is compiled. Reference: data that
    /// is written or passed as VAR, PERS or INOUT. Fixed: left as it is.
    enum class Role : uint8_t { Value, Constant, Reference, Fixed };
    struct Site {
        const syntax::Expr* expr;
        sema::DataType type;
        Scope scope;
        Role role;
    };
    struct StatementSite {
        const syntax::Stmt* statement;
        const syntax::Stmt* next; ///< of the same list; null for the last one
        Scope scope;
    };

    // tree_sites.cpp: finds the places
    void visit(const syntax::Node& node, const Scope& scope);
    void visitRoutine(const syntax::RoutineDecl& routine, Scope scope);
    void visitArguments(const syntax::Node& call, const Scope& scope, Role role);
    void visitStatements(syntax::StmtList list, const Scope& scope);
    void visitExpr(const syntax::Expr& expr, const Scope& scope, Role role);

    // tree_mutator.cpp: changes
    std::optional<Edit> replaceValue();
    std::optional<Edit> combineValue();
    std::optional<Edit> exchangeOperator();
    std::optional<Edit> changeLiteral();
    std::optional<Edit> swapName();
    std::optional<Edit> moveStatement();
    std::optional<Edit> wrapStatement();
    std::optional<Edit> insertStatement();
    std::optional<Edit> addHandler();

    std::string madeStatement(const Scope& scope, uint32_t at);
    std::string handlerBody(const Scope& scope, uint32_t at);
    /// An expression of the type that can be written at `at` (bytes); empty when none is found.
    std::string value(const sema::DataType& type, const Scope& scope, uint32_t at, Role role = Role::Value);
    std::string condition(const Scope& scope, uint32_t at);
    std::string literal(const sema::Type& type);
    /// Data of the type that are visible in `scope`, parameters among them. `like`: as writable as this one; null: any.
    std::vector<const sema::DataSymbol*> dataOf(const sema::DataType& type, const Scope& scope,
                                                const sema::DataSymbol* like) const;
    /// All local data that the node names are those of the routine, and its loop variables have a value at `at`.
    bool isVisible(const syntax::Node& node, const Scope& from, const Scope& scope, uint32_t at) const;

    static const syntax::SyntaxTree& tree(const Scope& scope) { return *scope.module->tree; }
    static std::string textOf(const syntax::Node& node, const Scope& scope);
    static Edit replaced(const syntax::Node& node, const Scope& scope, std::string text);
    static Edit inserted(uint32_t at, const Scope& scope, std::string text);
    template <class T> const T* oneOf(const std::vector<T>& all) {
        return all.empty() ? nullptr : &all[below(random_, all.size())];
    }
    bool chance(size_t percent) { return below(random_, 100) < percent; }

    const sema::CheckedProgram& program_;
    Random& random_;
    std::vector<Site> sites_;
    std::vector<StatementSite> statements_;
    std::vector<Scope> routines_;
};

} // namespace rapid::fuzz
