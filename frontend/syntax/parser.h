#pragma once
// Tokens -> lossless tree, with recovery: one mistake, one diagnostic.

#include "frontend/diag/diagnostic.h"
#include "frontend/syntax/ast.h"

namespace rapid::syntax {

struct ParseOptions {
    /// Reads the declarations of built-ins: a routine header without a body is native; mode word REF; alternatives
    /// between required parameters. The body of a routine is absent when the token after its ')' cannot continue it.
    bool declarations = false;
    /// The tree of an earlier version of the file, if there is one: saves time, changes nothing.
    const SyntaxTree* earlier = nullptr;
    /// Plain aggregates after ':=' are one token each when the file has no mistakes: half the time and memory for files
    /// of taught points, for who does not look at tokens.
    bool wholeAggregates = false;
};

/// Parses a whole file. Never fails: what cannot be read is reported to `sink` and left as Error nodes.
std::unique_ptr<SyntaxTree> parse(std::shared_ptr<const SourceFile> source, diag::Sink& sink,
                                  const ParseOptions& options = {});

/// An expression on its own, for debuggers and for values given as text.
struct ParsedExpr {
    std::unique_ptr<SyntaxTree> tree; ///< owns `expr`; it has no modules
    Expr* expr = nullptr;             ///< never null; an ErrorExpr when nothing could be read
};

/// Parses a text that is one expression and nothing else. Mistakes are reported to `sink`.
ParsedExpr parseExpression(std::shared_ptr<const SourceFile> source, diag::Sink& sink);

/// Indented text form of a tree, for `rapidc emit --as=tree` and the tests.
std::string printTree(const SyntaxTree& tree);
/// One token a line: kind, position, text.
std::string printTokens(const SyntaxTree& tree);
/// The source text put together again from tokens and gaps; equals the source byte for byte.
std::string printSource(const SyntaxTree& tree);

} // namespace rapid::syntax
