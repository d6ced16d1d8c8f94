#pragma once
// Types of names: records, aliases (manual 1.2.1) and the parameter lists of routines (manual 1.1.5).

#include "frontend/sema/part.h"

namespace rapid::sema {

class TypeResolver : CheckerPart {
  public:
    TypeResolver(State& state, const Parts& parts);

    /// `data`: the declaration that names it, if it is one of data.
    const Type* resolveType(syntax::TokenIndex token, const syntax::DataDecl* data = nullptr);
    /// Works out a type, if that has not been done. Cycles are reported.
    const Type* ensureType(TypeSymbol& symbol);
    /// Parameters and type of a routine.
    void resolveSignature(RoutineSymbol& symbol);

  private:
    bool reportTypeAfterName(const syntax::DataDecl& decl);
    void resolveRecord(Type& type, const syntax::RecordDecl& decl);
    void resolveAlias(Type& type, const syntax::AliasDecl& decl);
    void resolveParameter(RoutineSymbol& routine, const syntax::ParamDecl& decl);
    DataSymbol& newParameter(RoutineSymbol& routine);

    Scopes& scopes_;
    UnknownNames& unknown_;
    /// Records and aliases being resolved, with the data type in them that has been reached.
    std::vector<std::pair<const Type*, syntax::TokenIndex>> resolvingParts_;
};

} // namespace rapid::sema
