#include "frontend/query/late_calls.h"

#include "frontend/sema/names.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

/// The string with which an expression begins; null: it begins with something else.
const Expr* firstString(const Expr& expr, bool& whole) {
    const Expr& inner = bare(expr);
    if (inner.kind == NodeKind::StringLiteral) return &inner;
    whole = false;
    if (inner.kind == NodeKind::Binary && as<BinaryExpr>(inner).op == BinaryOp::Add &&
        as<BinaryExpr>(inner).left)
        return firstString(*as<BinaryExpr>(inner).left, whole);
    return nullptr;
}

bool isCallByVar(const FileView& file, const CallStmt& call) {
    if (!file.facts) return false;
    const auto bound = file.facts->calls.find(&call);
    return bound != file.facts->calls.end() && bound->second.routine &&
           bound->second.routine->role == Role::CallByVar;
}

} // namespace

std::optional<LateCall> lateCallOf(const FileView& file, const CallStmt& call) {
    const Expr* name = call.lateName;
    LateCall late;
    if (!name) {
        if (call.args.empty() || !call.args.front()->value || !isCallByVar(file, call)) return std::nullopt;
        late.byNumber = true;
        name = call.args.front()->value;
    }
    late.whole = !late.byNumber;
    const Expr* string = firstString(*name, late.whole);
    if (!string) return std::nullopt;
    late.beginning = foldName(decodeStringLiteral(file.tree->text(string->first)));
    late.range = file.tree->range(*string);
    late.call = &call;
    // "module:name" names a procedure of a module.
    if (const size_t colon = late.beginning.find(':'); colon != std::string::npos) {
        late.module = late.beginning.substr(0, colon);
        late.beginning.erase(0, colon + 1);
    }
    return late;
}

std::optional<LateCall> lateCallAt(const FileView& file, uint32_t offset) {
    for (const Node* node : nodesAt(file, offset))
        if (node->kind == NodeKind::CallStmt) {
            const auto late = lateCallOf(file, as<CallStmt>(*node));
            if (!late) return std::nullopt;
            const CallStmt& call = as<CallStmt>(*node);
            SourceRange whole =
                file.tree->range(call.lateName ? static_cast<const Node&>(*call.lateName)
                                               : static_cast<const Node&>(*call.args.front()));
            if (call.lateName && whole.begin > 0) --whole.begin; // with the '%'
            if (whole.begin <= offset && offset <= whole.end + (call.lateName ? 1 : 0)) return late;
        }
    return std::nullopt;
}

bool mayMean(const LateCall& call, std::string_view procedure) {
    const std::string name = foldName(procedure);
    if (call.whole) return name == call.beginning;
    if (call.beginning.empty() || !name.starts_with(call.beginning)) return false;
    const std::string_view rest = std::string_view(name).substr(call.beginning.size());
    if (!call.byNumber) return true;
    return !rest.empty() && rest.find_first_not_of("0123456789") == std::string_view::npos;
}

std::vector<const RoutineSymbol*> targetsOf(const Snapshot& snapshot, const FileView& file,
                                            const LateCall& call) {
    std::vector<const RoutineSymbol*> found;
    const auto consider = [&](const Module& module, bool local) {
        if (!call.module.empty() && foldName(module.name) != call.module) return;
        for (const RoutineSymbol* routine : module.routines)
            if (routine->routineKind == RoutineKind::Proc && (local || !routine->isLocal) &&
                mayMean(call, routine->name))
                found.push_back(routine);
    };
    if (file.task)
        for (const Module* module : file.task->modules)
            consider(*module, module->tree == file.tree);
    if (found.empty() && call.whole)
        for (const Module* module : snapshot.program().predefinedModules)
            consider(*module, false);
    return found;
}

} // namespace rapid::query
