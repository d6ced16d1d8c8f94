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

    /// Dim(array, number): which dimensions there are is known.
    void checkDim(const syntax::CallExpr& e, const RoutineSymbol& routine);
    /// Checks an argument and judges it by its parameter.
    void checkArgument(const RoutineSymbol& routine, BoundArg& bound);
    /// Checks the arguments for the parameters of type anytype of a routine that takes data of one type: an aggregate or a
    /// literal has the type of the other one. Adds them to `judged`.
    void checkSameType(const BoundCall& call, std::vector<const syntax::Argument*>& judged);
    /// Judges an argument that was checked already: a reference, or a value.
    void judgeReference(const RoutineSymbol& routine, const BoundArg& bound, const Place& place);
    /// Reports the mismatches from `firstMismatch` on, and if `missing` the parameters without an argument.
    void reportArguments(const BoundCall& call, syntax::TokenIndex name, size_t firstMismatch, bool missing);
    void judgeValue(const RoutineSymbol& routine, const BoundArg& bound, Typed t);
    /// The argument cannot be changed by the routine. `found`: what it is.
    diag::Diagnostic& reportAccess(const RoutineSymbol& routine, const BoundArg& bound, const Symbol* symbol,
                                   std::string found);
    /// The optional parameter of the routine being checked that the expression names, or null.
    DataSymbol* ownOptional(const syntax::Expr& e);
    /// The type that an undeclared name gets when it is the argument for this parameter, or null.
    const Type* handleHint(const DataSymbol& param) const;

  private:
    void checkConditional(const RoutineSymbol& routine, BoundArg& bound);
    void judgeConditional(const RoutineSymbol& routine, const BoundArg& bound, const syntax::Expr& e);
    void checkReference(const RoutineSymbol& routine, const BoundArg& bound);
    bool couldBelongTo(const syntax::Expr& value, std::span<const BoundArg> params);
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

/// The kind of argument that such a parameter needs; null when `found` is that.
const char* missingClass(ParamClass accepts, const DataType& found);

} // namespace rapid::sema
