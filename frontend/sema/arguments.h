#pragma once
// Judges each argument of a call: type, mode, access (manual 1.1.5).

#include "frontend/sema/part.h"

namespace rapid::sema {

/// An argument whose type is not that of its parameter.
struct Mismatch {
    const DataSymbol* param = nullptr;
    const syntax::Expr* value = nullptr;
    DataType found;
};

class Arguments : CheckerPart {
  public:
    Arguments(State& state, const Parts& parts);

    /// Arguments of the wrong type, of the calls being checked.
    size_t mismatchCount() const { return mismatches_.size(); }
    void forgetMismatches(size_t from) { mismatches_.resize(from); }
    /// The call is judged: no argument of it was reported that may hold several.
    void forgetShape() { shapeReported_ = false; }

    void checkDim(const syntax::CallExpr& e, const RoutineSymbol& routine);
    void checkArgument(const RoutineSymbol& routine, BoundArg& bound);
    void judgeReference(const RoutineSymbol& routine, const BoundArg& bound, const Place& place);
    void reportArguments(const BoundCall& call, syntax::TokenIndex name, size_t firstMismatch, bool missing);
    void judgeValue(const RoutineSymbol& routine, const BoundArg& bound, Typed t);
    diag::Diagnostic& reportAccess(const RoutineSymbol& routine, const BoundArg& bound, const Symbol* symbol,
                                   std::string found);
    DataSymbol* ownOptional(const syntax::Expr& e);
    const Type* handleHint(const DataSymbol& param) const;

  private:
    void checkConditional(const RoutineSymbol& routine, BoundArg& bound);
    void judgeConditional(const RoutineSymbol& routine, const BoundArg& bound, const syntax::Expr& e);
    void checkReference(const RoutineSymbol& routine, const BoundArg& bound);
    bool couldStandFor(const syntax::Expr& value, std::span<const BoundArg> params);
    std::span<const BoundArg> leftOut(const BoundCall& call, std::vector<const syntax::Expr*>& moved);
    void takeBack(const std::vector<const syntax::Expr*>& moved);
    bool reportEqualAsAssign(const BoundArg& bound);
    void checkAccess(const RoutineSymbol& routine, const BoundArg& bound, const Place& place);
    bool isDotForComma(const syntax::Expr& e);
    void fixParentheses(diag::Diagnostic& d, const syntax::Expr& e);
    bool checkClass(const RoutineSymbol& routine, const BoundArg& bound, const DataType& type);
    void checkPresent(const BoundArg& bound);
    DataSymbol* ownParameter(const syntax::Expr& e);

    CallBinder& calls_;
    Expressions& expressions_;
    Places& places_;
    Remedies& remedies_;
    Scopes& scopes_;
    bool shapeReported_ = false;       ///< an argument of the call has been reported that may hold several
    std::vector<Mismatch> mismatches_; ///< arguments of the wrong type, of the calls being checked
};

const char* missingClass(ParamClass accepts, const DataType& found);

} // namespace rapid::sema
