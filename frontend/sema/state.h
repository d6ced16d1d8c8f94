#pragma once
// The shared state of a check: the program, the names, the contexts, and where to report. Each check has one.

#include "frontend/sema/reports.h"

#include <memory>
#include <unordered_map>

namespace rapid::sema {

/// Names of one module, found before global and predefined names.
struct ModuleScope {
    NameMap<Symbol> names;
};

/// Declarations that are resolved inside each other: programs have far fewer, and the stack is finite.
inline constexpr unsigned kMaxDepth = 500;

struct State {
    State(CheckedProgram& checked, const CheckOptions& given, diag::Sink& target)
        : program(checked), options(given), sink(target), reports(target, context) {}
    State(const State&) = delete;

    /// From now on the check is at the level of this module.
    void enterModule(Module* module) { context = {module, module->tree, module->exprs, nullptr, false}; }

    CheckedProgram& program;
    const CheckOptions& options;
    diag::Sink& sink; ///< for what belongs to no file; see `reports`
    Interner names;
    const Type* switchType = nullptr;
    std::vector<std::string> taskNames;
    std::vector<Symbol*> predefined; ///< by NameId
    /// For names that nothing declared: what is predefined and near. It stays true, and an editor asks with every letter typed.
    std::unordered_map<NameId, std::vector<NameId>> nearPredefined;
    std::vector<std::unique_ptr<ModuleScope>> scopes; ///< by Module::id
    bool keepsFacts = false;    ///< facts are kept when other files change: they must not share memory
    uint32_t lastStamp = 0;     ///< of a check of a file
    NameId guest = 0, host = 0; ///< Session::setGuest, when there is one
    bool hasGuest = false;

    Context context;
    TaskContext task;
    RoutineContext routine;
    std::vector<Symbol*> routineNames; ///< by NameId: parameters, data and loop variables of the routine
    std::vector<NameId> declaredInRoutine;
    Reports reports;
    unsigned depth = 0;        ///< of declarations being resolved inside each other
    bool valueUnused = false;  ///< the value of the name that is looked at is not needed
    bool presenceOnly = false; ///< a name is looked at for its presence, not for its value
};

template <class T> T* at(const std::vector<T*>& table, NameId name) {
    return name < table.size() ? table[name] : nullptr;
}
template <class T> void put(std::vector<T*>& table, NameId name, T* value) {
    if (name >= table.size()) table.resize(name + name / 2 + 64, nullptr);
    table[name] = value;
}
template <class T> T* symbolAs(Symbol* symbol, SymbolKind kind) {
    return symbol && symbol->kind == kind ? static_cast<T*>(symbol) : nullptr;
}
inline DataSymbol* asData(Symbol* symbol) {
    return symbolAs<DataSymbol>(symbol, SymbolKind::Data);
}
inline RoutineSymbol* asRoutine(Symbol* symbol) {
    return symbolAs<RoutineSymbol>(symbol, SymbolKind::Routine);
}
inline TypeSymbol* asType(Symbol* symbol) {
    return symbolAs<TypeSymbol>(symbol, SymbolKind::Type);
}

} // namespace rapid::sema
