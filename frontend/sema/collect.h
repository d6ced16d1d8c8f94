#pragma once
// Declares the names of modules: modules themselves, types, data, routines (manual 1.1.3, 1.1.5, 1.2.2).

#include "frontend/sema/part.h"

namespace rapid::sema {

class Collector : CheckerPart {
  public:
    explicit Collector(State& state);

    void declareModules(std::span<Module* const> modules);
    /// A module of the program, with nothing declared yet.
    Module* addModule(const syntax::SyntaxTree& tree, const syntax::ModuleDecl& decl, bool predefined,
                      FileFacts& facts);
    /// Declares what is declared at the level of the module.
    void collect(Module& module);
    /// Global names must not be those of modules (manual 1.1.3).
    void checkModuleNames(std::span<Module* const> modules);
    /// Symbols of `earlier`, what the module declared when it was checked before, are used again.
    void collectAgain(Module& module, const NameMap<Symbol>& earlier);
    /// Data of the module or the routine of the context, not declared yet.
    DataSymbol& newData(const syntax::DataDecl& decl);

  private:
    template <class S> S& recycled(Store<S>& store, SymbolKind kind, syntax::TokenIndex name);
    void declareInModule(Symbol& symbol, ModuleScope& scope);
    RoutineSymbol& newRoutine(const syntax::RoutineDecl& decl);
    TypeSymbol& newType(const syntax::Decl& decl, syntax::TokenIndex name, bool local);

    const NameMap<Symbol>* earlier_ = nullptr; ///< what the module declared when it was checked before
    bool duplicateModule_ = false; ///< its names collide with those of its twin, which is reported
};

} // namespace rapid::sema
