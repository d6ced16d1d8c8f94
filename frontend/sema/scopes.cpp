// What a name means: routine, module, task, configuration, library, in this order (manual 1.1.5, 1.2.2). Signals that
// nobody declares are part of the controller's configuration and are recognised by how they are used.

#include "frontend/sema/scopes.h"
#include "frontend/sema/signal_uses.h"
#include "frontend/sema/suggestions.h"
#include "frontend/sema/unknown.h"
#include "frontend/sema/wording.h"

namespace rapid::sema {

using namespace syntax;

Scopes::Scopes(State& state) : CheckerPart(state) {}

Symbol* Scopes::lookup(NameId name) const {
    if (state_.context.routine)
        if (Symbol* found = at(state_.routineNames, name)) return found;
    return lookupOutside(name);
}

Symbol* Scopes::lookupOutside(NameId name) const {
    if (Symbol* found = state_.scopes[state_.context.module->id]->names.find(name)) return found;
    if (!state_.context.module->predefined) {
        if (Symbol* found = at(state_.task.globals, name)) return found;
        if (DataSymbol* found = at(state_.task.configured, name)) return found;
    }
    return at(state_.predefined, name);
}

TypeSymbol* Scopes::findType(NameId name) const {
    TypeSymbol* found = asType(state_.scopes[state_.context.module->id]->names.find(name));
    if (!found && !state_.context.module->predefined) found = asType(at(state_.task.globals, name));
    return found ? found : asType(at(state_.predefined, name));
}

DataSymbol* Scopes::configuredObject(NameId name, std::string spelling, const Type* type, bool assumed) {
    DataSymbol* spare = nullptr;
    if (assumed && !state_.task.spareAssumed.empty()) {
        spare = state_.task.spareAssumed.back();
        state_.task.spareAssumed.pop_back();
        spare->reset();
    }
    DataSymbol& symbol = spare ? *spare : state_.program.dataSymbols.emplace_back();
    symbol.assumed = assumed;
    if (assumed) state_.task.assumed.push_back(&symbol);
    symbol.kind = SymbolKind::Data;
    symbol.progress = symbol.valueProgress = Progress::Done;
    symbol.name = std::move(spelling);
    symbol.nameId = name;
    symbol.storage = Storage::Signal;
    symbol.type.type = type;
    put(state_.task.configured, name, &symbol);
    return &symbol;
}

void Scopes::declareConfiguration() {
    for (const SignalInfo& signal : state_.options.signals) {
        const TypeSymbol* type = asType(at(state_.predefined, state_.names.intern(signal.type)));
        if (type) configuredObject(state_.names.intern(signal.name), signal.name, type->type, false);
    }
    // Each task has an identity, and the robot of the first motion task is always there.
    const auto declare = [&](const std::string& name, const char* typeName) {
        const TypeSymbol* type = asType(at(state_.predefined, state_.names.intern(typeName)));
        const NameId id = state_.names.intern(name);
        if (type && !at(state_.predefined, id) && !at(state_.task.configured, id))
            configuredObject(id, name, type->type, false);
    };
    for (const std::string& task : state_.taskNames)
        declare(task + "Id", "taskid");
    declare("ROB_1", "mecunit");
}

// From now on the routine has data of this name and of the type that fits everything: one mistake, one diagnostic.
void Scopes::declareUnknown(NameId name) {
    DataSymbol& symbol = facts().locals.emplace_back();
    symbol.kind = SymbolKind::Data;
    symbol.progress = symbol.valueProgress = Progress::Done;
    symbol.nameId = name;
    symbol.module = state_.context.module;
    symbol.storage = Storage::RoutineData;
    symbol.type.type = state_.program.errorType;
    symbol.routine = state_.context.routine;
    symbol.index = kNoIndex;
    put<Symbol>(state_.routineNames, name, &symbol);
    state_.declaredInRoutine.push_back(name);
}

// Whether the file refers to the symbol for the first time.
bool Scopes::markUsed(Symbol& symbol) {
    FileFacts& file = facts();
    if (std::exchange(symbol.lastUser, file.stamp) == file.stamp) return false;
    symbol.used = true;
    ++symbol.users;
    file.used.push_back(&symbol);
    return true;
}

void Scopes::markAssigned(DataSymbol& symbol) {
    FileFacts& file = facts();
    if (std::exchange(symbol.lastWriter, file.stamp) == file.stamp) return;
    symbol.assigned = true;
    ++symbol.writers;
    file.assigned.push_back(&symbol);
}

} // namespace rapid::sema
