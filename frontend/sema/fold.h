#pragma once
// Values of constant expressions. num results are rounded to binary32 after each operation.

#include "frontend/sema/part.h"

namespace rapid::sema {

class Folding : CheckerPart {
  public:
    explicit Folding(State& state);

    /// The expressions whose values are kept during evaluation.
    Arena& valueArena() { return context_.routine ? facts().inner : facts().values; }
    ConstValue* newConst() { return valueArena().make<ConstValue>(); }
    /// Gives the expression its value if its operands have one. Division by zero and overflow are reported.
    void foldBinary(const syntax::BinaryExpr& e);
    void foldUnary(const syntax::UnaryExpr& e, ConstValue* slot);
    /// A copy that stays when the file of `value` is checked again.
    ConstValue owned(const ConstValue& value);
    /// The value of data of a value type without an initial value: 0, FALSE, "".
    void setDefault(ConstValue& value, const Type& type);
    /// An element or component of a constant, which may be that of another file.
    const ConstValue* partOf(const ConstValue& value);

  private:
    void warnDivision(const syntax::BinaryExpr& e);
    const ConstValue* foldVectors(const syntax::BinaryExpr& e, const ConstValue& a, const ConstValue& b);
    bool foldArithmetic(const syntax::BinaryExpr& e, double a, double b, bool isDnum, double& out);
    void foldBool(ExprInfo& info, bool value);
};

} // namespace rapid::sema
