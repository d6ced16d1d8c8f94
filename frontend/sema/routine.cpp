// Bodies of routines: scope of parameters and data, handlers, labels and jumps (manual 1.1.5, 1.12, 1.13, 1.21).

#include "frontend/sema/routine.h"
#include "frontend/diag/messages/flow.h"
#include "frontend/diag/messages/names.h"
#include "frontend/sema/collect.h"
#include "frontend/sema/expr.h"
#include "frontend/sema/jumps.h"
#include "frontend/sema/resolve_data.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/stmt.h"
#include "frontend/sema/stmt_flow.h"
#include "frontend/sema/wording.h"
#include "frontend/syntax/token_set.h"

#include <algorithm>

namespace rapid::sema {

using namespace syntax;

RoutineChecker::RoutineChecker(State& state, const Parts& parts)
    : CheckerPart(state), collector_(parts.collector), data_(parts.data), expressions_(parts.expressions),
      flow_(parts.flow), jumps_(parts.jumps), statements_(parts.statements) {}

void RoutineChecker::checkRoutine(RoutineSymbol& symbol) {
    if (symbol.native) return;
    state_.enterModule(symbol.module);
    context_.routine = &symbol;
    const RoutineDecl& decl = *symbol.routineDecl;
    routine_ = {};
    routine_.blocksAreUnclear = reports_.hasUnclearLine(decl);
    reports_.setQuietLine({});
    for (DataSymbol* param : symbol.params)
        declareInRoutine(*param);
    routine_.optionalUses.assign(symbol.params.size(), {});
    const size_t firstOwn = symbol.data.size();
    for (const DataDecl* data : decl.data)
        if (isName(data->name)) declareRoutineData(*data);
    for (size_t i = firstOwn; i < symbol.data.size(); ++i) {
        data_.ensureValue(*symbol.data[i]);
        context_.constant = false;
    }
    notePlaceholders(decl.first, decl.last);
    const bool completes = checkPart(Part::Body, decl.body);
    checkPart(Part::Backward, decl.backward);
    for (const ErrorClause* clause : decl.errors) {
        for (const Expr* number : clause->numbers)
            flow_.checkListedError(*number);
        checkPart(Part::Error, clause->body);
    }
    checkPart(Part::Undo, decl.undo);
    if (decl.routineKind == RoutineKind::Func && decl.closed && completes && !routine_.broken) {
        if (!routine_.returnSeen) // not even in a handler
            report(say::FunctionWithoutReturn, range(decl.name), {symbol.name});
        else
            report(say::FunctionPathWithoutReturn, range(decl.name), {symbol.name});
    }
    jumps_.resolveJumps();
    expressions_.checkBigLiterals();
    reportUntestedOptionals();
    for (const NameId name : state_.declaredInRoutine)
        state_.routineNames[name] = nullptr;
    state_.declaredInRoutine.clear();
}

void RoutineChecker::declareInRoutine(Symbol& symbol) {
    if (const Symbol* other = at(state_.routineNames, symbol.nameId)) {
        noteDeclared(
            report(say::DuplicateInRoutine, range(symbol.nameToken), {symbol.name, context_.routine->name}),
            *other);
        return;
    }
    put(state_.routineNames, symbol.nameId, &symbol);
    state_.declaredInRoutine.push_back(symbol.nameId);
}

void RoutineChecker::declareRoutineData(const DataDecl& decl) {
    RoutineSymbol& routine = *context_.routine;
    DataSymbol& symbol = collector_.newData(decl);
    symbol.index = static_cast<uint32_t>(routine.params.size() + routine.data.size());
    routine.data.push_back(&symbol);
    declareInRoutine(symbol);
}

bool RoutineChecker::checkPart(Part part, StmtList list) {
    if (list.empty()) return true;
    routine_.part = part;
    routine_.block = kNoBlock;
    return block(list);
}

bool RoutineChecker::block(StmtList list) {
    const uint32_t outer = routine_.block;
    routine_.block = static_cast<uint32_t>(routine_.blockParents.size());
    routine_.blockParents.push_back(outer);
    const bool completes = statements_.statements(list);
    routine_.block = outer;
    return completes;
}

// An omitted optional parameter must not be referenced (manual 1.1.5). A routine that never asks Present for it, nor for
// one that excludes it, cannot know.
void RoutineChecker::reportUntestedOptionals() {
    const std::vector<DataSymbol*>& params = context_.routine->params;
    if (hasErrorHandler()) return; // it may answer ERR_NOTPRES
    const bool any = std::any_of(routine_.optionalUses.begin(), routine_.optionalUses.end(),
                                 [](const OptionalUse& use) { return use.first != nullptr; });
    if (!any) return;
    std::unordered_set<uint32_t> tested; // groups
    for (size_t i = 0; i < params.size(); ++i)
        if (routine_.optionalUses[i].tested) tested.insert(params[i]->group);
    for (size_t i = 0; i < params.size(); ++i) {
        if (!routine_.optionalUses[i].first) continue;
        if (!tested.contains(params[i]->group))
            report(say::OptionalWithoutPresent, range(*routine_.optionalUses[i].first), {params[i]->name});
    }
}

} // namespace rapid::sema
