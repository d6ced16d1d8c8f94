#pragma once
// From a name to where it is declared, where its type is, and what a call by name may call.

#include "frontend/query/references.h"

namespace rapid::query {

/// The declaration of the name at the offset; several for a persistent that tasks share. A signal leads to its definition
/// in the configuration, the string of a call by name to the procedures.
std::vector<Location> definitionAt(const Snapshot& snapshot, const FileView& file, uint32_t offset);

/// The declaration of the type of the data, component or function at the offset; of a type: itself, of an alias: the other.
std::vector<Location> typeDefinitionAt(const Snapshot& snapshot, const FileView& file, uint32_t offset);

/// The routines with a body that a call may execute: all that a call by name may mean.
std::vector<Location> implementationAt(const Snapshot& snapshot, const FileView& file, uint32_t offset);

/// The places in this file that name what the offset names.
std::vector<Use> highlightsAt(const Snapshot& snapshot, const FileView& file, uint32_t offset,
                              const Cancel* cancel = nullptr);

} // namespace rapid::query
