#include "ir/lower/argument_copies.h"

#include "frontend/syntax/tree_walk.h"
#include "ir/lower/program_lowering.h"

#include <algorithm>

namespace rapid::lower {

using namespace syntax;
using sema::BoundArg;
using sema::BoundCall;
using sema::DataSymbol;
using sema::RoutineSymbol;
using sema::Storage;
using sema::Type;

namespace {

/// A value of type `part` may lie within one of type `whole`.
bool contains(const Type& whole, const Type& part) {
    if (whole.base() == part.base()) return true;
    const std::vector<Type::Component>& components = whole.base()->components;
    return std::any_of(components.begin(), components.end(),
                       [&](const Type::Component& c) { return contains(*c.type, part); });
}

bool isReference(const DataSymbol& object) {
    return object.storage == Storage::Parameter && object.mode != ParamMode::In;
}

} // namespace

const DataSymbol* referredData(const Expr* written, const sema::Module& module) {
    if (!written) return nullptr;
    const Expr* expr = &bare(*written);
    while (expr->kind == NodeKind::Index || expr->kind == NodeKind::Component)
        expr = &bare(expr->kind == NodeKind::Index ? *as<IndexExpr>(*expr).base
                                                   : *as<ComponentExpr>(*expr).base);
    if (expr->kind != NodeKind::Name) return nullptr;
    const sema::Symbol* symbol = (*module.exprs)[expr->id].symbol;
    return symbol && symbol->kind == sema::SymbolKind::Data ? static_cast<const DataSymbol*>(symbol)
                                                            : nullptr;
}

bool isShared(const DataSymbol& object) {
    return (object.storage == Storage::ModuleData && object.dataKind != DataKind::Const) ||
           isReference(object);
}

bool mayOverlap(const DataSymbol& a, const DataSymbol& b) {
    if (&a == &b) return true;
    if (!isShared(a) || !isShared(b) || (!isReference(a) && !isReference(b))) return false;
    return contains(*a.type.type, *b.type.type) || contains(*b.type.type, *a.type.type);
}

ArgumentCopies::ArgumentCopies(const sema::CheckedProgram& program, bool unknownCode, bool handlersOnTop)
    : program_(program), unknownCode_(unknownCode), handlersOnTop_(handlersOnTop) {
    const auto readAll = [&](const sema::Module& module) {
        for (const RoutineSymbol* routine : module.routines)
            if (routine->routineDecl && !routine->native) read(*routine);
    };
    std::unordered_set<const sema::Module*> modules;
    for (const auto& task : program.tasks)
        for (const sema::Module* module : task->modules) {
            if (!modules.insert(module).second) sharedModules_.insert(module);
            readAll(*module);
        }
    for (const sema::Module* module : program.predefinedModules)
        readAll(*module);
    propagate();
    findAsynchronous();
    for (const auto& [routine, body] : bodies_)
        for (const BoundCall* call : body.calls)
            judge(*call);
}

void ArgumentCopies::read(const RoutineSymbol& routine) {
    auto [at, isNew] = bodies_.try_emplace(&routine);
    if (!isNew) return;
    at->second.routine = &routine;
    visit(*routine.routineDecl, *routine.module, at->second);
}

/// Own data of the routine do not count: other code reaches them only when the call itself passes them.
void ArgumentCopies::write(const DataSymbol* object, Body& body) {
    if (object && isShared(*object)) body.written.insert(object);
}

void ArgumentCopies::visit(const Node& node, const sema::Module& module, Body& body) {
    if (node.kind == NodeKind::Assign) write(referredData(as<AssignStmt>(node).target, module), body);
    if (node.kind == NodeKind::Connect) write(referredData(as<ConnectStmt>(node).target, module), body);
    if (node.kind == NodeKind::CallStmt || node.kind == NodeKind::Call) {
        const auto found = module.facts->calls.find(&node);
        const RoutineSymbol* callee = found == module.facts->calls.end() ? nullptr : found->second.routine;
        if (callee && !callee->traits.has(sema::Trait::DataNames) &&
            !callee->traits.has(sema::Trait::CallsByName))
            body.calls.push_back(&found->second);
        else
            body.unknown = true;
    }
    forEachChild(node, [&](const Node& child) { visit(child, module, body); });
}

/// Data that the call may write belong to its caller's effects. True when some are new.
bool ArgumentCopies::addEffects(Body& body, const BoundCall& call) {
    const size_t before = body.written.size();
    const bool unknown = body.unknown;
    const auto found = bodies_.find(call.routine);
    const Body* callee = found == bodies_.end() ? nullptr : &found->second;
    if (callee && callee != &body) {
        body.unknown = body.unknown || callee->unknown;
        for (const DataSymbol* object : callee->written)
            if (object->storage == Storage::ModuleData) body.written.insert(object);
    }
    for (const BoundArg& arg : call.args)
        if (arg.param && arg.value && arg.param->mode != ParamMode::In &&
            (!callee || callee->written.contains(arg.param)))
            write(referredData(arg.value, *body.routine->module), body);
    return body.written.size() != before || body.unknown != unknown;
}

void ArgumentCopies::propagate() {
    for (bool changed = true; changed;) {
        changed = false;
        for (auto& [routine, body] : bodies_)
            for (const BoundCall* call : body.calls)
                changed = addEffects(body, *call) || changed;
    }
}

/// Trap routines are executed between any two instructions; so are procedures of movements (MoveLSync), found by name.
void ArgumentCopies::findAsynchronous() {
    unknownCode_ = unknownCode_ || program_.uses(sema::Trait::CallsLater);
    for (const auto& [routine, body] : bodies_) {
        if (routine->routineKind != RoutineKind::Trap) continue;
        asynchronous_.insert(body.written.begin(), body.written.end());
        unknownCode_ = unknownCode_ || body.unknown;
    }
}

bool ArgumentCopies::isWrittenMeanwhile(const DataSymbol& object) const {
    if (unknownCode_) return true;
    if (program_.tasks.size() > 1) { // other tasks see persistents, and variables of shared modules
        const bool mayBePersistent =
            isReference(object) ? object.mode != ParamMode::Var : object.dataKind == DataKind::Pers;
        if (mayBePersistent ||
            (isReference(object) ? !sharedModules_.empty() : sharedModules_.contains(object.module)))
            return true;
    }
    if (!isReference(object)) return asynchronous_.contains(&object);
    return std::any_of(asynchronous_.begin(), asynchronous_.end(),
                       [&](const DataSymbol* written) { return mayOverlap(object, *written); });
}

bool ArgumentCopies::mayBeWritten(const DataSymbol& object, const BoundArg& arg, const BoundCall& call,
                                  const Body& callee) const {
    for (const BoundArg& other : call.args) {
        if (&other == &arg || !other.param || other.param->mode == ParamMode::In) continue;
        const DataSymbol* root = referredData(other.value, *call.module);
        if (root && callee.written.contains(other.param) && mayOverlap(object, *root)) return true;
    }
    if (handlersOnTop_) return object.dataKind != DataKind::Const || object.storage == Storage::Parameter;
    if (!isShared(object)) return false;
    if (callee.unknown || isWrittenMeanwhile(object)) return true;
    if (!isReference(object)) return callee.written.contains(&object);
    return std::any_of(callee.written.begin(), callee.written.end(), [&](const DataSymbol* written) {
        return written->storage == Storage::ModuleData && mayOverlap(object, *written);
    });
}

void ArgumentCopies::judge(const BoundCall& call) {
    const auto callee = bodies_.find(call.routine);
    if (callee == bodies_.end() || !call.module) return;
    for (const BoundArg& arg : call.args) {
        if (!arg.param || arg.param->mode != ParamMode::In || passingOf(*arg.param) != Passing::Pointer ||
            copied_.contains(arg.param))
            continue;
        const DataSymbol* object = referredData(arg.value, *call.module);
        if (object && mayBeWritten(*object, arg, call, callee->second)) copied_.insert(arg.param);
    }
}

} // namespace rapid::lower
