// The meaning of a name: routine, module, task, configuration, library, in this order (manual 1.1.5, 1.2.2). Signals that
// nothing declares are part of the controller's configuration and are recognised by how they are used.

#include "frontend/sema/scopes.h"
#include "frontend/sema/signal_uses.h"
#include "frontend/sema/suggestions.h"
#include "frontend/sema/unknown.h"
#include "frontend/sema/wording.h"

namespace rapid::sema {

using namespace syntax;

Scopes::Scopes(State& state) : CheckerPart(state) {}

Symbol* Scopes::lookup(NameId name) const {
    if (context_.routine)
        if (Symbol* found = at(state_.routineNames, name)) return found;
    return lookupOutside(name);
}

Symbol* Scopes::inModule(NameId name) const {
    Symbol* found = state_.scopes[context_.module->id]->names.find(name);
    if (found || !state_.hasGuest || names_.intern(context_.module->name) != state_.guest) return found;
    const Module* host = task_.moduleNames.find(state_.host);
    return host ? state_.scopes[host->id]->names.find(name) : nullptr;
}

Symbol* Scopes::lookupOutside(NameId name) const {
    if (Symbol* found = inModule(name)) return found;
    if (!context_.module->predefined) {
        if (Symbol* found = at(task_.globals, name)) return found;
        if (DataSymbol* found = at(task_.configured, name)) return found;
    }
    return at(state_.predefined, name);
}

TypeSymbol* Scopes::findType(NameId name) const {
    TypeSymbol* found = asType(inModule(name));
    if (!found && !context_.module->predefined) found = asType(at(task_.globals, name));
    return found ? found : asType(at(state_.predefined, name));
}

DataSymbol* Scopes::configuredObject(NameId name, std::string spelling, const Type* type, bool assumed) {
    DataSymbol* spare = nullptr;
    if (assumed && !task_.spareAssumed.empty()) {
        spare = task_.spareAssumed.back();
        task_.spareAssumed.pop_back();
        spare->reset();
    }
    DataSymbol& symbol = spare ? *spare : program_.dataSymbols.emplace_back();
    symbol.assumed = assumed;
    if (assumed) task_.assumed.push_back(&symbol);
    symbol.kind = SymbolKind::Data;
    symbol.progress = symbol.valueProgress = Progress::Done;
    symbol.name = std::move(spelling);
    symbol.nameId = name;
    symbol.storage = Storage::Signal;
    symbol.type.type = type;
    put(task_.configured, name, &symbol);
    return &symbol;
}

void Scopes::declareConfiguration() {
    for (const SignalInfo& signal : state_.options.signals) {
        const TypeSymbol* type = asType(at(state_.predefined, names_.intern(signal.type)));
        if (type) configuredObject(names_.intern(signal.name), signal.name, type->type, false);
    }
    // Each task has an identity, and the robot of the first motion task is always there.
    const auto declare = [&](const std::string& name, KnownType known) {
        const Type* type = program_.typeOf(known);
        const NameId id = names_.intern(name);
        if (type && !at(state_.predefined, id) && !at(task_.configured, id))
            configuredObject(id, name, type, false);
    };
    for (const std::string& task : state_.taskNames)
        declare(task + "Id", KnownType::TaskIdentity);
    declare("ROB_1", KnownType::MechanicalUnit);
}

// From now on the routine has data of this name and of the type that fits everything: one mistake, one diagnostic.
void Scopes::declareUnknown(NameId name) {
    DataSymbol& symbol = facts().locals.emplace_back();
    symbol.kind = SymbolKind::Data;
    symbol.progress = symbol.valueProgress = Progress::Done;
    symbol.nameId = name;
    symbol.module = context_.module;
    symbol.storage = Storage::RoutineData;
    symbol.type.type = program_.errorType;
    symbol.routine = context_.routine;
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
