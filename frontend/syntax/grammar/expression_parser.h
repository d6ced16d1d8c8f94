#pragma once
// Expressions (manual 1.3.4 to 1.3.6) and arguments of calls (manual 1.1.5).

#include "frontend/syntax/grammar/parser_part.h"

namespace rapid::syntax {

/// expression, logical_term, relation, sum, term, primary, variable, aggregate, function_call and its arguments.
class ExpressionParser : public ParserPart {
  public:
    using ParserPart::ParserPart;

    Expr* parsePrimary();
    Expr* parseVariableOrCall(bool allowCall);
    /// Index and components. Only a whole variable takes an index, and a call result has no parts (manual 1.3.6).
    Expr* parsePostfix(Expr* base);
    /// `{1,2}`; other brackets are reported and read as if they were these.
    Expr* parseIndex(Expr* base);
    /// A whole initial value `[...]` of literals; null, and nothing is read, if something else is here.
    Expr* parsePlainAggregate();
    /// Reads a plain aggregate as any other one; `opening` is its '['.
    void parseElements(AggregateExpr& plain, TokenIndex opening);
    /// `expr {, expr}` and the closing bracket; height_ is that of the highest one.
    std::span<Expr*> parseExpressionList(K closing, TokenIndex opening);
    /// A condition; an assignment in it was meant as a comparison.
    Expr* parseCondition();
    Expr* errorExpr();
    /// The arguments of a call up to what cannot be one; sets height_ to that of the call.
    std::span<Argument*> parseArguments(bool procedure);

    Expr* parseExpression() { return parseBinary(1); }
    /// The shapes of aggregates that are one token, as the lexer has found them.
    void setLexed(const LexResult& lexed) { lexed_ = &lexed; }

  private:
    Expr* parseBinary(int minPrecedence);
    Expr* parseNot(int minPrecedence);
    Expr* parseSigned(int minPrecedence);
    Expr* parseNumber();
    void reportBadNumber(TokenIndex token);
    Expr* parseLoneNumber();
    Expr* parseFunctionCall();
    void dropDoubled(TokenIndex opening);
    void fixBrackets(diag::Diagnostic* diagnostic, const IndexExpr& node, TokenIndex opening);
    Expr* parseParenthesised();
    Expr* parseAggregate();
    uint8_t shapeAt(TokenIndex whole);
    Expr* parseForeignAggregate(TokenIndex opening, K closing);
    Expr* parseMeantEqual(TokenIndex start, size_t errorsBefore);
    Expr* tooDeepExpr();
    Argument* parseRequiredArgument(bool procedure);
    Argument* parseOptionalArgument();

    const LexResult* lexed_ = nullptr;
    size_t nextAggregate_ = 0; ///< of lexed_->aggregates
    uint32_t height_ = 0;      ///< of the expression parsed last
    std::vector<Argument*> args_;
};

} // namespace rapid::syntax
