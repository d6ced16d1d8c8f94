#pragma once
// Looks names up: routine, module, task, configuration, library, in this order (manual 1.1.5, 1.2.2).

#include "frontend/sema/part.h"

namespace rapid::sema {

class Scopes : CheckerPart {
  public:
    explicit Scopes(State& state);

    /// Null: nothing declares it.
    Symbol* lookup(NameId name) const;
    Symbol* lookupOutside(NameId name) const; ///< skips the routine
    /// Declares a signal, a mechanical unit or a task. `assumed`: known by its use only.
    DataSymbol* configuredObject(NameId name, std::string spelling, const Type* type, bool assumed);
    /// From now on the routine has data of this name and of the type that fits everything.
    void declareUnknown(NameId name);
    /// The signals of the configuration, and what each controller has.
    void declareConfiguration();
    /// Whether the file refers to the symbol for the first time.
    bool markUsed(Symbol& symbol);
    void markAssigned(DataSymbol& symbol);
    /// Types are looked up on their own: data may have the name of one.
    TypeSymbol* findType(NameId name) const;

  private:
    /// Finds what the module declares, or the one whose guest it is.
    Symbol* inModule(NameId name) const;
};

} // namespace rapid::sema
