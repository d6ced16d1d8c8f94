#pragma once
// What is wrong with several arguments of a call explained by one mistake: another order, one missing or too many,
// a comma.

#include "frontend/sema/part.h"

namespace rapid::sema {

class ArgumentOrder : CheckerPart {
  public:
    ArgumentOrder(State& state, const Parts& parts);

    /// Whether one mistake explained the errors of the call, which are replaced by it.
    bool explainArguments(const BoundCall& call, syntax::TokenIndex name,
                          std::span<syntax::Argument* const> args);
    /// The same for a decimal comma.
    bool explainComma(std::span<syntax::Argument* const> args);
    /// The same for '/' before an optional argument.
    bool explainSlash(const RoutineSymbol& routine, std::span<syntax::Argument* const> args);
    /// "SetDO do1 := 1;": a comma or a backslash is missing. False: nothing was reported.
    bool reportMisspeltSeparator(const RoutineSymbol& routine, const syntax::Argument& arg, size_t slot,
                                 bool isLast);

  private:
    bool explainOrder(const RoutineSymbol& routine, const std::vector<const DataSymbol*>& params,
                      const std::vector<const syntax::Expr*>& given);
    bool explainCount(const RoutineSymbol& routine, syntax::TokenIndex name,
                      const std::vector<const DataSymbol*>& params,
                      const std::vector<const syntax::Expr*>& given);
    bool errorsLieIn(const std::vector<const syntax::Expr*>& given) const;
    bool isDeclaredData(syntax::TokenIndex name) const;
    bool couldBe(const syntax::Expr& e, const DataSymbol& param);
    void reportSwapped(const RoutineSymbol& routine, const DataSymbol& one, const DataSymbol& other,
                       const syntax::Expr& first, const syntax::Expr& second, bool certain);

    Arguments& arguments_;
    CallBinder& calls_;
    Remedies& remedies_;
    Scopes& scopes_;
};

/// Whether a parameter of this mode can take the data.
bool acceptsData(const DataSymbol& root, syntax::ParamMode mode);

} // namespace rapid::sema
