#pragma once
// Types of expressions and operators (manual 1.3). An expression is checked once; the facts are in its ExprInfo.

#include "frontend/sema/part.h"

namespace rapid::sema {

class Expressions : CheckerPart {
  public:
    Expressions(State& state, const Parts& parts);

    /// Checks an expression. `want`: the type that the context asks for; aggregates need it. `slot`: where to keep the value
    /// of a constant aggregate, or null.
    Typed expr(const syntax::Expr& e, const DataType* want = nullptr, ConstValue* slot = nullptr);
    /// Gives the expression the type that fits everything.
    Typed errorExpr(const syntax::Expr& e);
    /// The value of data: signals are read, data without a value are reported.
    Typed placeValue(const syntax::Expr& e);
    /// Checks an expression whose context is wrong: only its own mistakes are reported.
    void visitLoose(const syntax::Expr& e);
    /// Gives an expression of open numeric type the type `to`.
    void settle(const syntax::Expr& e, const Type* to);
    /// Whether `e` fits `want`; settles it. Nothing is reported.
    bool fits(const syntax::Expr& e, Typed t, const DataType& want);
    /// `what`: the instruction, for the message. False: reported.
    bool condition(const syntax::Expr& e, const char* what);
    /// Judges the literals that a num cannot hold, once their types are settled: all but the `first` ones, which belong to a routine
    /// in progress when data of another file is evaluated for it.
    void checkBigLiterals(size_t first = 0);
    size_t bigLiterals() const { return bigLiterals_.size(); }

  private:
    Typed literal(const syntax::NumLiteralExpr& e, const DataType* want, ConstValue* slot);
    Typed paren(const syntax::ParenExpr& e, const DataType* want, ConstValue* slot);
    Typed unary(const syntax::UnaryExpr& e, const DataType* want, ConstValue* slot);
    Typed binaryChain(const syntax::BinaryExpr& e, const DataType* want);
    Typed combine(const syntax::BinaryExpr& e, Typed left, Typed right);
    Typed arithmetic(const syntax::BinaryExpr& e, Typed left, Typed right);
    void checkIntegerOperands(const syntax::BinaryExpr& e);
    Typed vectorArithmetic(const syntax::BinaryExpr& e, Typed left, Typed right);
    Typed comparison(const syntax::BinaryExpr& e, Typed left, Typed right);
    Typed equality(const syntax::BinaryExpr& e, Typed left, Typed right);
    Typed logic(const syntax::BinaryExpr& e, Typed left, Typed right);
    bool refusesAggregate(const syntax::BinaryExpr& e, const DataType& partner);
    void reportMixed(const syntax::BinaryExpr& e);
    Typed operatorError(const syntax::BinaryExpr& e, Typed left, Typed right);
    enum class Numeric : uint8_t { Ok, Mixed, NotNumeric };
    Numeric unify(const syntax::BinaryExpr& e, Typed& left, Typed& right, Flex& flex);
    bool aggregateFits(const syntax::AggregateExpr& e, const DataType& want);
    Typed aggregate(const syntax::AggregateExpr& e, const DataType* want, ConstValue* slot);
    Typed aggregateOfVersion(const syntax::AggregateExpr& e, const DataType& want, ConstValue* slot);
    Typed result(const syntax::Expr& e, const Type* type, Flex flex = Flex::None);

    CallBinder& calls_;
    Folding& folding_;
    Places& places_;
    Remedies& remedies_;
    std::vector<const syntax::Expr*> bigLiterals_;
    std::vector<const syntax::BinaryExpr*> spine_;
    bool nonValueReported_ = false; ///< of the operand that was looked at last
};

} // namespace rapid::sema
