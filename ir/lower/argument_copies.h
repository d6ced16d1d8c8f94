#pragma once
// Which IN parameters are copied. The manual calls them values; passed by address, they are values as long as nothing writes
// the argument before the routine returns. docs/language/arguments.md.

#include "frontend/sema/checked.h"

#include <unordered_map>
#include <unordered_set>

namespace rapid::lower {

/// The data object that a reference names as a whole or in part; null for anything else.
const sema::DataSymbol* referredData(const syntax::Expr* expr, const sema::Module& module);

/// Some other code of the program may be able to reach the object by its address: data of modules, and the
/// argument of a parameter by reference.
bool isShared(const sema::DataSymbol& object);

/// The two names may refer to objects that overlap.
bool mayOverlap(const sema::DataSymbol& a, const sema::DataSymbol& b);

class ArgumentCopies {
  public:
    /// `unknownCode`: code that is not part of `program` may be executed in between. `handlersOnTop`: so may error handlers
    /// of the callers, which reach their own data.
    ArgumentCopies(const sema::CheckedProgram& program, bool unknownCode, bool handlersOnTop);

    /// The routine works on a copy of this parameter (IN, passed by address).
    bool copies(const sema::DataSymbol& param) const { return copied_.contains(&param); }

  private:
    struct Body {
        const sema::RoutineSymbol* routine = nullptr;
        std::vector<const sema::BoundCall*> calls;
        std::unordered_set<const sema::DataSymbol*> written; ///< data of modules, own parameters by reference
        bool unknown = false;                                ///< may write whatever can be reached
    };
    void read(const sema::RoutineSymbol& routine);
    void visit(const syntax::Node& node, const sema::Module& module, Body& body);
    void write(const sema::DataSymbol* object, Body& body);
    bool addEffects(Body& body, const sema::BoundCall& call);
    void propagate();
    void findAsynchronous();
    void judge(const sema::BoundCall& call);
    bool mayBeWritten(const sema::DataSymbol& object, const sema::BoundArg& arg, const sema::BoundCall& call,
                      const Body& callee) const;
    bool isWrittenMeanwhile(const sema::DataSymbol& object) const;

    const sema::CheckedProgram& program_;
    bool unknownCode_;
    bool handlersOnTop_;
    std::unordered_map<const sema::RoutineSymbol*, Body> bodies_;
    std::unordered_set<const sema::Module*> sharedModules_;    ///< several tasks have them
    std::unordered_set<const sema::DataSymbol*> asynchronous_; ///< written by trap routines
    std::unordered_set<const sema::DataSymbol*> copied_;
};

} // namespace rapid::lower
