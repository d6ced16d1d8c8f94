#pragma once
// Types, dimensions and initial values of data, on demand and in any order (manual 1.2.2).

#include "frontend/sema/part.h"

namespace rapid::sema {

class DataResolver : CheckerPart {
  public:
    DataResolver(State& state, const Parts& parts);

    /// Works out the type of data, if that has not been done.
    void ensureData(DataSymbol& symbol);
    /// The same, and the value.
    void ensureValue(DataSymbol& symbol);

  private:
    uint64_t resolveDimensions(DataSymbol& symbol, const syntax::DataDecl& decl);
    std::string describeDimension(const syntax::Expr& e, Typed t);
    void initialise(DataSymbol& symbol, const syntax::DataDecl& decl);
    void checkDeclaration(DataSymbol& symbol);
    void reportNonConstant(const syntax::Expr& e);
    const syntax::Expr* findNonConstant(const syntax::Expr& e);
    const syntax::Expr* findNonLiteral(const syntax::Expr& expr) const;

    Expressions& expressions_;
    Folding& folding_;
    Remedies& remedies_;
    TypeResolver& types_;
};

} // namespace rapid::sema
