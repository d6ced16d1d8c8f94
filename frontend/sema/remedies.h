#pragma once
// Proposes how to correct a value that does not fit where it is.

#include "frontend/sema/part.h"

namespace rapid::sema {

/// How a value that does not fit can be corrected.
struct Remedy {
    std::string words;   ///< the end of a message, ": write 1"; empty: none is known
    std::string instead; ///< to write for the expression; empty: nothing that is certain to compile
};

class Remedies : CheckerPart {
  public:
    Remedies(State& state, const Parts& parts);

    /// Adds the fix that makes `name(e)` of an expression.
    void fixCall(diag::Diagnostic& diagnostic, const syntax::Expr& e, const std::string& name, bool certain);
    /// Proposes a change that makes a value of type `found` fit.
    Remedy remedyFor(const syntax::Expr& whole, const DataType& found, const DataType& want);
    Remedy remedyFor(const RoutineSymbol& routine, const syntax::Expr& e, const DataType& found,
                     const DataSymbol& param);
    /// All of the text of an expression, for a fix; text() shortens it.
    std::string written(const syntax::Expr& e) const;
    /// Adds it to what is said about `e`.
    void offer(diag::Diagnostic& diagnostic, const syntax::Expr& e, const Remedy& remedy);
    /// "\Num:=" for data of the type of an optional parameter; empty when there is none.
    std::string optionalFor(const RoutineSymbol& routine, const syntax::Expr& e);
    std::string optionalFor(const RoutineSymbol& routine, NameId name);

  private:
    std::string inWords(const syntax::Expr& e) const;
    Remedy numberRemedy(const syntax::Expr& e, const DataType& found, const Type& want);
    Remedy recordRemedy(const syntax::Expr& e, const DataType& found, const DataType& want);
    Remedy signalRemedy(const RoutineSymbol& routine, const DataType& found, const DataType& want);
    std::string namedByNumber(std::string_view number, const Type& want);

    Scopes& scopes_;
};

/// The end of a message about an operator that data of these types do not have; empty: none is known.
std::string targetRemedy(syntax::BinaryOp op, const DataType& operand);
std::string operatorRemedy(syntax::BinaryOp op, Typed left, Typed right);
/// "NumToDnum" or "DnumToNum", if one of them helps.
std::string numDnumRemedy(Typed t, const DataType& want);

} // namespace rapid::sema
