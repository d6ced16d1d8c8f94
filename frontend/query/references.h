#pragma once
// Every place that names a thing, in all tasks.

#include "frontend/query/meaning.h"

namespace rapid::query {

struct Use {
    Location place;
    Access access = Access::Read;
};

/// In the order of files and text, each place once. Found by the spelling of the name, so that only places with it are
/// looked at.
std::vector<Use> usesOf(const Snapshot& snapshot, const Meaning& meaning, bool withDeclaration = true,
                        const Cancel* cancel = nullptr);
/// The same within one file.
std::vector<Use> usesIn(const Snapshot& snapshot, const FileView& file, const Meaning& meaning,
                        const Cancel* cancel = nullptr);

/// Number of places that name the symbol, without declarations.
size_t countUses(const Snapshot& snapshot, const sema::Symbol& symbol, const Cancel* cancel = nullptr);

/// The string literals that spell the name, in the user's modules: late binding, data reached by name.
std::vector<Location> stringsSpelling(const Snapshot& snapshot, std::string_view name,
                                      const Cancel* cancel = nullptr);

} // namespace rapid::query
