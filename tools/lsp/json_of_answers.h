#pragma once
// Answers of the query library in the words of the protocol, for modules and configurations alike.

#include "frontend/query/completion.h"
#include "frontend/query/hover.h"
#include "frontend/query/symbols.h"
#include "tools/lsp/state.h"

#include <vector>

namespace lsp {

/// CompletionList (completion.cpp)
Json toJson(State& state, const Target& target, const rapid::query::CompletionList& list);
/// Hover (hover.cpp)
Json toJson(State& state, const Target& target, const rapid::query::Hover& hover);
/// Location[]; each place once, without those that have no text (navigation.cpp)
Json toJson(State& state, const std::vector<rapid::query::Location>& places);

} // namespace lsp
