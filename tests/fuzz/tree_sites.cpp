// Finds the expressions, instructions and routines that TreeMutator may change.

#include "frontend/syntax/tree_walk.h"
#include "tests/fuzz/tree_mutator.h"

namespace rapid::fuzz {

using namespace syntax;

TreeMutator::TreeMutator(const sema::CheckedProgram& program, Random& random)
    : program_(program), random_(random) {
    for (size_t task = 0; task < program.tasks.size(); ++task)
        for (const sema::Module* module : program.tasks[task]->modules)
            forEachChild(*module->decl, [&](const Node& decl) { visit(decl, {task, module, nullptr}); });
}

void TreeMutator::visitRoutine(const RoutineDecl& routine, Scope scope) {
    for (const sema::RoutineSymbol* symbol : scope.module->routines)
        if (symbol->routineDecl == &routine) scope.routine = symbol;
    if (!scope.routine) return;
    routines_.push_back(scope);
    for (const DataDecl* data : routine.data)
        visit(*data, scope);
    visitStatements(routine.body, scope);
    visitStatements(routine.backward, scope);
    for (const ErrorClause* clause : routine.errors)
        visitStatements(clause->body, scope);
    visitStatements(routine.undo, scope);
}

void TreeMutator::visitStatements(StmtList list, const Scope& scope) {
    for (size_t i = 0; i < list.size(); ++i) {
        statements_.push_back({list[i], i + 1 < list.size() ? list[i + 1] : nullptr, scope});
        visit(*list[i], scope);
    }
}

// Size: one case for each kind of node.
void TreeMutator::visit(const Node& node, const Scope& scope) {
    const auto expr = [&](const Expr* e, Role role) {
        if (e) visitExpr(*e, scope, role);
    };
    switch (node.kind) {
    case NodeKind::Routine: return visitRoutine(as<RoutineDecl>(node), scope);
    case NodeKind::Data: return expr(as<DataDecl>(node).init, Role::Constant);
    case NodeKind::Assign:
        expr(as<AssignStmt>(node).target, Role::Reference);
        return expr(as<AssignStmt>(node).value, Role::Value);
    case NodeKind::CallStmt:
        expr(as<CallStmt>(node).lateName, Role::Value);
        return visitArguments(node, scope, Role::Value);
    case NodeKind::If:
        for (const IfBranch* branch : as<IfStmt>(node).branches) {
            expr(branch->condition, Role::Value);
            visitStatements(branch->body, scope);
        }
        return visitStatements(as<IfStmt>(node).elseBody, scope);
    case NodeKind::CompactIf:
        expr(as<CompactIfStmt>(node).condition, Role::Value);
        return visit(*as<CompactIfStmt>(node).body, scope);
    case NodeKind::For:
        expr(as<ForStmt>(node).from, Role::Value);
        expr(as<ForStmt>(node).to, Role::Value);
        expr(as<ForStmt>(node).step, Role::Value);
        return visitStatements(as<ForStmt>(node).body, scope);
    case NodeKind::While:
        expr(as<WhileStmt>(node).condition, Role::Value);
        return visitStatements(as<WhileStmt>(node).body, scope);
    case NodeKind::Test:
        expr(as<TestStmt>(node).subject, Role::Value);
        for (const TestCase* testCase : as<TestStmt>(node).cases) {
            for (const Expr* value : testCase->values)
                expr(value, Role::Value);
            visitStatements(testCase->body, scope);
        }
        return visitStatements(as<TestStmt>(node).defaultBody, scope);
    case NodeKind::Return: return expr(as<ReturnStmt>(node).value, Role::Value);
    case NodeKind::Connect: return expr(as<ConnectStmt>(node).target, Role::Reference);
    default: return;
    }
}

void TreeMutator::visitArguments(const Node& call, const Scope& scope, Role role) {
    const auto& calls = scope.module->facts->calls;
    const auto found = calls.find(&call);
    if (found == calls.end()) return;
    for (const sema::BoundArg& arg : found->second.args)
        if (arg.kind == sema::BoundArg::Kind::Present && arg.value)
            visitExpr(*arg.value, scope,
                      !arg.param                         ? Role::Fixed
                      : arg.param->mode != ParamMode::In ? Role::Reference
                                                         : role);
}

void TreeMutator::visitExpr(const Expr& expr, const Scope& scope, Role role) {
    const sema::DataType& type = program_.info(*scope.module, expr).type();
    if (type.type->kind != sema::TypeKind::Error) sites_.push_back({&expr, type, scope, role});
    // The parts of a reference are values or references like it.
    const Role part = role == Role::Constant ? Role::Constant : Role::Value;
    switch (expr.kind) {
    case NodeKind::Index:
        visitExpr(*as<IndexExpr>(expr).base, scope, Role::Reference);
        for (const Expr* index : as<IndexExpr>(expr).indices)
            visitExpr(*index, scope, part);
        return;
    case NodeKind::Component: return visitExpr(*as<ComponentExpr>(expr).base, scope, Role::Reference);
    case NodeKind::Call: return visitArguments(expr, scope, part);
    default: forEachChild(expr, [&](const Node& child) { visitExpr(as<Expr>(child), scope, part); });
    }
}

} // namespace rapid::fuzz
