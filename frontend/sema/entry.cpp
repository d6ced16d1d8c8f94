// The routine that a task begins with.

#include "frontend/sema/entry.h"

#include "frontend/diag/messages/projects.h"
#include "frontend/sema/parameters.h"
#include "frontend/sema/unknown.h"
#include "frontend/sema/wording.h"

#include <algorithm>

namespace rapid::sema {

using namespace syntax;

EntryCheck::EntryCheck(State& state, const Parts& parts) : CheckerPart(state), unknown_(parts.unknown) {}

// A LOCAL routine with the name of the entry. Only of a program that is to run, or in which everything else is known:
// modules that a part of a program consists of may have a LOCAL main of their own, called by name from elsewhere.
const Symbol* EntryCheck::localEntry(const Task& task, NameId name) {
    const Symbol* local = nullptr;
    for (size_t i = 0; i < task.modules.size() && !local; ++i)
        local = state_.scopes[task.modules[i]->id]->names.find(name);
    if (!local || state_.options.requireMain) return local;
    const auto isOpen = [](const Module* module) {
        const auto& tokens = module->tree->tokens;
        return module->facts->open || std::any_of(tokens.begin(), tokens.end(), [](const Token& t) {
                   return t.kind == TokenKind::Percent; // a call by name
               });
    };
    const bool part =
        task_.incomplete || local->used || std::any_of(task.modules.begin(), task.modules.end(), isOpen);
    return part ? nullptr : local;
}

void EntryCheck::checkEntry(Task& task) {
    const NameId name = names_.intern(task.entry);
    Symbol* symbol = at(task_.globals, name);
    RoutineSymbol* routine = asRoutine(symbol);
    const bool procedure = routine && routine->routineKind == RoutineKind::Proc;
    if (procedure && nextRequired(*routine, 0) >= routine->params.size()) {
        task.entryRoutine = routine;
        ++routine->users;
        routine->used = true;
        return;
    }
    if (symbol) { // the entry of a task must be a procedure without arguments
        state_.enterModule(symbol->module);
        std::string found = procedure ? "a procedure with required parameters" : describe(*symbol);
        report(say::EntryNotProcedure, range(symbol->nameToken), {symbol->name, std::move(found)});
        return;
    }
    if (const Symbol* local = localEntry(task, name)) {
        state_.enterModule(local->module);
        report(say::EntryLocal, range(local->nameToken), {task.name, local->name});
        return;
    }
    if (!state_.options.requireMain) return;
    if (!unknown_.mayReportUnknown(name))
        return;                 // whatever a module that is missing declares, nothing can start
    if (task.modules.empty()) { // the reason is usually reported already
        if (!state_.sink.hasErrors()) state_.sink.report(say::NoEntry, nullptr, {}, {task.name, task.entry});
        return;
    }
    const ModuleDecl& first = *task.modules.front()->decl;
    state_.enterModule(task.modules.front());
    report(say::NoEntry, range(first.name == kNoToken ? first.first : first.name), {task.name, task.entry});
}

} // namespace rapid::sema
