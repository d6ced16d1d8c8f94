#pragma once
// Names of things as text, which a client keeps between two requests.

#include "frontend/query/meaning.h"

namespace rapid::query {

/// "offset:path" of the declaration, or "=name" for what no text declares; empty: none.
std::string keyOf(const Snapshot& snapshot, const Meaning& meaning);
std::string keyOf(const Snapshot& snapshot, const sema::Symbol& symbol);
/// Of the same or a later generation; found() is false when there is no such thing any more.
Meaning meaningOfKey(const Snapshot& snapshot, std::string_view key);

} // namespace rapid::query
