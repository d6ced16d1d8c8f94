#pragma once
// Generic walks over the syntax tree, and what lies between its tokens.

#include "frontend/syntax/ast.h"

#include <functional>

namespace rapid::syntax {

/// Calls `visit` for each direct child of `node`, in source order. Absent children are skipped.
void forEachChild(const Node& node, const std::function<void(const Node&)>& visit);

/// "If", "Binary", ...
std::string_view nodeKindName(NodeKind kind);

/// The expression within parentheses, itself in none.
const Expr& bare(const Expr& e);

bool isExpr(NodeKind kind);
bool isStmt(NodeKind kind);
bool isDecl(NodeKind kind);

/// The word for the data type in a declaration of data, of a parameter or of a function; kNoToken: it has none.
TokenIndex typeTokenOf(const Node& declaration);

/// White space and comments before the first token of a node, without the rest of the line on which the token before
/// it ends: a comment there belongs to that line. Documentation comments (`!!`, `!@`) are found here.
std::string_view leadingTrivia(const SyntaxTree& tree, const Node& node);

/// White space and comments between a token and the one before it.
std::string_view gapBefore(const SyntaxTree& tree, TokenIndex token);

} // namespace rapid::syntax
