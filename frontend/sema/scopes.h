#pragma once
// Looks names up: routine, module, task, configuration, library, in this order (manual 1.1.5, 1.2.2).

#include "frontend/sema/part.h"

namespace rapid::sema {

class Scopes : CheckerPart {
  public:
    explicit Scopes(State& state);

    Symbol* lookup(NameId name) const;
    Symbol* lookupOutside(NameId name) const; ///< skips the routine
    DataSymbol* configuredObject(NameId name, std::string spelling, const Type* type, bool assumed);
    void declareUnknown(NameId name);
    void declareConfiguration();
    bool markUsed(Symbol& symbol);
    void markAssigned(DataSymbol& symbol);
    TypeSymbol* findType(NameId name) const;
};

} // namespace rapid::sema
