#pragma once
// The value of an aggregate of literals, read from its text or tokens. Internal to frontend/sema.

#include "frontend/sema/types.h"
#include "frontend/syntax/ast.h"

namespace rapid::sema {

struct ConstValue;

/// Whether each literal of a plain aggregate has the type that `want` asks for at its place, and none is missing.
bool isLiteralOf(const DataType& want, const syntax::SyntaxTree& tree, const syntax::AggregateExpr& plain);

/// Type::literalShape; empty for records of many parts, and where no literal can be one.
std::vector<syntax::PlainPiece> literalShape(const Type& record);

/// The value of a plain aggregate for which isLiteralOf() is true; its parts lie in `arena`.
ConstValue literalValue(const DataType& want, const syntax::SyntaxTree& tree,
                        const syntax::AggregateExpr& plain, Arena& arena);

} // namespace rapid::sema
