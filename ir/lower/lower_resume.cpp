// Which instructions a later process can enter again in the middle (--state, manual 1.2.2 "Power on"): the routine in
// progress is called again by executing the instruction that called it from its beginning. So what that instruction does
// before the call must have no effect, and must not be needed after the call unless no other task can change it.

#include "frontend/syntax/tree_walk.h"
#include "ir/lower/routine_lowering.h"

#include <algorithm>

namespace rapid::lower {

using namespace syntax;
using sema::DataSymbol;

namespace {

/// The data object that an argument hands to its routine by reference; null for anything else.
const DataSymbol* handedOver(const sema::BoundArg& arg, const sema::Module& module) {
    if (!arg.param || !arg.value || arg.param->mode == ParamMode::In) return nullptr;
    const Expr* e = arg.value;
    for (;;) {
        if (e->kind == NodeKind::Paren)
            e = as<ParenExpr>(*e).inner;
        else if (e->kind == NodeKind::Index)
            e = as<IndexExpr>(*e).base;
        else if (e->kind == NodeKind::Component)
            e = as<ComponentExpr>(*e).base;
        else
            break;
    }
    const sema::Symbol* symbol = e->kind == NodeKind::Name ? (*module.exprs)[e->id].symbol : nullptr;
    return symbol && symbol->kind == sema::SymbolKind::Data ? static_cast<const DataSymbol*>(symbol)
                                                            : nullptr;
}

} // namespace

/// Goes through an instruction in the order in which it is executed.
struct RoutineLowering::CallSearch {
    explicit CallSearch(const sema::Module& in) : module(in) {}

    const sema::Module& module;
    size_t rows = 0;          ///< of an IF: conditions that have been visited
    int earlier = 0;          ///< effects of the conditions ahead, which are evaluated again
    int routines = 0;         ///< calls of routines of the program
    int effects = 0;          ///< calls with an effect, those included
    bool effectAhead = false; ///< a native with an effect is called before the first routine
    bool changeable =
        false; ///< a value that others may change is read before the first routine, beside its arguments
    std::vector<const DataSymbol*> shared; ///< routine data that are handed over by reference

    void collectShared(const Node& node) {
        if (const auto found = module.facts->calls.find(&node); found != module.facts->calls.end())
            for (const sema::BoundArg& arg : found->second.args)
                if (const DataSymbol* symbol = handedOver(arg, module)) shared.push_back(symbol);
        forEachChild(node, [this](const Node& child) {
            if (!isStmt(child.kind)) collectShared(child);
        });
    }

    bool isOwn(const Expr& name) const {
        const sema::ExprInfo& info = (*module.exprs)[name.id];
        if (info.constant != nullptr) return true;
        if (!info.symbol || info.symbol->kind != sema::SymbolKind::Data) return false;
        const auto& symbol = *static_cast<const DataSymbol*>(info.symbol);
        if (symbol.dataKind == DataKind::Const && symbol.storage != sema::Storage::Parameter) return true;
        const bool own = symbol.storage == sema::Storage::RoutineData ||
                         symbol.storage == sema::Storage::LoopVariable ||
                         (symbol.storage == sema::Storage::Parameter && symbol.mode == ParamMode::In);
        return own && std::find(shared.begin(), shared.end(), &symbol) == shared.end();
    }

    /// The target of an assignment: its place does not change, but its indices are values.
    void visitTarget(const Expr& target) {
        if (target.kind == NodeKind::Component) return visitTarget(*as<ComponentExpr>(target).base);
        if (target.kind == NodeKind::Paren) return visitTarget(*as<ParenExpr>(target).inner);
        if (target.kind != NodeKind::Index) return;
        visitTarget(*as<IndexExpr>(target).base);
        for (const Expr* index : as<IndexExpr>(target).indices)
            visit(*index);
    }

    void visit(const Node& node, bool ofArguments = false) {
        const auto found = module.facts->calls.find(&node);
        const sema::RoutineSymbol* callee =
            found != module.facts->calls.end() ? found->second.routine : nullptr;
        const bool native = callee != nullptr && callee->native;
        const bool routine = !native && (found != module.facts->calls.end() ||
                                         (node.kind == NodeKind::CallStmt && as<CallStmt>(node).lateName));
        const bool ahead = routines == 0 && !ofArguments;
        if (ahead && node.kind == NodeKind::Name && !isOwn(static_cast<const Expr&>(node))) changeable = true;
        forEachChild(node, [&](const Node& child) {
            if (!isStmt(child.kind)) visit(child, ofArguments || routine);
        });
        const bool effect = routine || (native && callee->effects > sema::Effects::Reads);
        effects += effect ? 1 : 0;
        if (native && routines == 0) {
            effectAhead = effectAhead || effect;
            changeable = changeable || (ahead && callee->effects == sema::Effects::Reads);
        }
        routines += routine ? 1 : 0;
    }
};

/// `row`: 0, or the number of the condition of an IF.
uint8_t RoutineLowering::resumeFlags(const Stmt& stmt, size_t row) const {
    // The rows of one IF are asked for in their order, with those of the statements in it in between.
    std::shared_ptr<CallSearch>& kept = searches_[&stmt];
    if (!kept || row == 0) {
        kept = std::make_shared<CallSearch>(*module_);
        kept->collectShared(stmt);
    }
    const std::shared_ptr<CallSearch> current = kept;
    CallSearch& search = *current;
    if (stmt.kind == NodeKind::If) {
        const auto& branches = as<IfStmt>(stmt).branches;
        for (; search.rows <= row && search.rows < branches.size(); ++search.rows) {
            search.earlier = search.effects;
            search.changeable =
                false; // what the conditions ahead decide is noticed when it is another branch now
            if (branches[search.rows]->condition) search.visit(*branches[search.rows]->condition);
        }
        if (search.rows == branches.size()) searches_.erase(&stmt);
    } else if (stmt.kind == NodeKind::Assign) {
        search.visitTarget(*as<AssignStmt>(stmt).target);
        search.visit(*as<AssignStmt>(stmt).value);
    } else {
        search.visit(stmt);
    }
    if (stmt.kind != NodeKind::If) searches_.erase(&stmt);
    const auto found = facts().calls.find(&stmt);
    const bool polls = found != facts().calls.end() && found->second.routine &&
                       std::any_of(found->second.routine->params.begin(), found->second.routine->params.end(),
                                   [](const DataSymbol* param) { return param->deferred; });
    uint8_t flags = 0;
    if (search.earlier == 0 && (search.effects <= 1 || polls)) flags |= ir::kStmtRepeatable;
    if (search.earlier == 0 && search.routines == 1 && !search.effectAhead && !search.changeable)
        flags |= ir::kStmtReenterable;
    return flags;
}

/// Says whether the text of a routine was changed; layout and comments do not count. Never 0.
uint32_t textHash(const sema::RoutineSymbol& symbol) {
    const auto& tree = *symbol.module->tree;
    uint32_t hash = 2166136261U; // FNV-1a
    const auto mix = [&hash](std::string_view text) {
        for (const char c : text)
            hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
    };
    for (TokenIndex t = symbol.routineDecl->first; t <= symbol.routineDecl->last; ++t) {
        mix(tree.text(t));
        mix("\n");
    }
    return (hash & 0x7FFFFFFFU) | 1U;
}

} // namespace rapid::lower
