#pragma once
// All names of a part of a file with their meaning, in one walk: for whoever needs every name, not one.

#include "frontend/query/meaning.h"

namespace rapid::query {

/// Calls `visit` for each name that has a meaning, in the order of the text, of the declarations that overlap `range`. `node` and
/// `access` of the meaning are set for declarations and calls only.
void forEachName(const Snapshot& snapshot, const FileView& file, SourceRange range,
                 const std::function<void(const Meaning&)>& visit, const Cancel* cancel = nullptr);

/// Calls `visit` for each node of the declarations that overlap `range`, parents first, with the routine around it (or null).
void forEachNodeOf(
    const FileView& file, SourceRange range,
    const std::function<void(const sema::Module&, const sema::RoutineSymbol*, const syntax::Node&)>& visit,
    const Cancel* cancel = nullptr);

/// The resolved call of a node; null: there is none.
const sema::BoundCall* boundCallOf(const FileView& file, const syntax::Node& node);

} // namespace rapid::query
