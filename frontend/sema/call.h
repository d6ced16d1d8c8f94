#pragma once
// Gives the arguments of a call to the parameters of the routine (manual 1.1.5, 1.3.4).

#include "frontend/sema/part.h"

#include <deque>

namespace rapid::sema {

class CallBinder : CheckerPart {
  public:
    CallBinder(State& state, const Parts& parts);

    /// The call of a function in an expression, with its arguments.
    Typed functionCall(const syntax::CallExpr& e);
    /// The index of the optional parameter of that name, or -1.
    size_t namedOptional(const RoutineSymbol& routine, NameId name);
    /// `node`: CallStmt or CallExpr; FileFacts::calls has the outcome.
    void bindCall(const syntax::Node& node, RoutineSymbol& routine, syntax::TokenIndex name,
                  std::span<syntax::Argument* const> args);
    /// Whether the arguments were read to their end: after a syntax error nothing is reported as missing.
    bool endsWell(syntax::TokenIndex name, std::span<syntax::Argument* const> args) const;
    /// Names the required parameters without an argument.
    void reportMissing(const BoundCall& call, syntax::TokenIndex name);
    /// Checks arguments for which no parameter is known.
    void visitArguments(std::span<syntax::Argument* const> args);
    /// A call by name, or of a procedure in a module that is not here (manual 1.1.5).
    void lateCall(const syntax::CallStmt& stmt);

  private:
    void reportNotAFunction(const syntax::CallExpr& e, const Symbol& symbol);
    bool reportMisread(const RoutineSymbol& routine, const syntax::Argument& arg,
                       syntax::TokenIndex routineName);
    void reportTooMany(const RoutineSymbol& routine, std::span<syntax::Argument* const> args,
                       const syntax::Argument& first, syntax::TokenIndex routineName);
    bool reportAssignmentBelow(const syntax::Argument& arg);
    bool namesOptional(const RoutineSymbol& routine, const syntax::Argument& arg);
    /// `isLast`: nothing follows that would have to come first.
    size_t matchUnmarked(const RoutineSymbol& routine, const syntax::Argument& arg, bool isLast);
    size_t namedParameter(const RoutineSymbol& routine, NameId name);
    /// Gives each written argument its parameter; false when "missing" would only repeat what was reported.
    bool matchArguments(BoundCall& call, syntax::TokenIndex name, std::span<syntax::Argument* const> args);
    size_t matchRequired(BoundCall& call, const syntax::Argument& arg, size_t slot, bool isLast);
    size_t matchOptional(BoundCall& call, const syntax::Argument& arg, syntax::TokenIndex name);
    size_t chooseAlternative(BoundCall& call, const syntax::Argument& arg, size_t first, size_t end);
    static void dropSurplus(diag::Sink& reports);
    void checkExclusive(const BoundCall& call);
    void visitArgument(const syntax::Argument& arg);

    ArgumentOrder& order_;
    Arguments& arguments_;
    Availability& availability_;
    Expressions& expressions_;
    Places& places_;
    Remedies& remedies_;
    Scopes& scopes_;
    Suggestions& suggestions_;
    UnknownNames& unknown_;
    std::deque<diag::Sink> callSinks_; ///< one for each call around another
    size_t callDepth_ = 0;
    std::vector<const syntax::Argument*> judged_; ///< arguments judged already to choose an alternative
};

} // namespace rapid::sema
