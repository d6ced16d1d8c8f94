#pragma once
// The common part of the refactorings. Each adds what it can do at the place.

#include "frontend/query/refactoring.h"

namespace rapid::query {

struct RefactorPlace {
    RefactorPlace(const Snapshot& all, const FileView& of, SourceRange chosen, const Cancel* stop)
        : snapshot(all), file(of), tree(*of.tree), selection(chosen), cancel(stop),
          scope(all, of, chosen.begin), nodes(nodesAt(of, chosen.begin)) {}

    const Snapshot& snapshot;
    const FileView& file;
    const syntax::SyntaxTree& tree;
    SourceRange selection;
    const Cancel* cancel;
    Scope scope;
    std::vector<const syntax::Node*> nodes; ///< around the beginning of the selection, from outside

    std::string_view text(SourceRange range) const {
        return file.text().substr(range.begin, range.end - range.begin);
    }
    std::string_view text(const syntax::Node& node) const { return text(tree.range(node)); }
    /// The innermost node of the kind; null: none.
    template <class T> const T* innermost(syntax::NodeKind kind) const {
        for (size_t i = nodes.size(); i-- > 0;)
            if (nodes[i]->kind == kind) return static_cast<const T*>(nodes[i]);
        return nullptr;
    }
};
using Refactorings = std::vector<Refactoring>;

void createRoutine(const RefactorPlace& place, Refactorings& out);
void declareData(const RefactorPlace& place, Refactorings& out);
void insertArguments(const RefactorPlace& place, Refactorings& out);
void extractRoutine(const RefactorPlace& place, Refactorings& out);
void teachValue(const RefactorPlace& place, Refactorings& out);
void inlineConstant(const RefactorPlace& place, Refactorings& out);
void convertData(const RefactorPlace& place, Refactorings& out);
void sortTargets(const RefactorPlace& place, Refactorings& out);
void addHandlers(const RefactorPlace& place, Refactorings& out);

/// A parameter for a value of the type: "num x", "VAR clock c", "string list{*}".
std::string newParameter(const sema::DataType& type, std::string_view name, std::string_view mode);

} // namespace rapid::query
