#pragma once
// Every request and notification of the protocol that the server knows, by name. A handler is a function of the state; it
// throws RequestError when there is no answer.

#include "tools/lsp/state.h"

#include <map>
#include <string_view>

namespace lsp {

using RequestHandler = Json (*)(State& state, const Json& params);
using NotificationHandler = void (*)(State& state, const Json& params);

/// Without those of the lifecycle, which the server answers itself, and those for diagnostics.
const std::map<std::string_view, RequestHandler>& requests();
const std::map<std::string_view, NotificationHandler>& notifications();

/// The answer to initialize.
Json capabilities(State& state);
/// Those of requests() about the language.
void addLanguageCapabilities(Json& offered);
/// Takes over folders, settings and the encoding of positions from the parameters of initialize. Throws RequestError.
void initialize(State& state, const Json& params);
/// What the client is asked for after `initialized`: its settings, and to watch files.
void afterInitialized(State& state);

// ---- formatting.cpp
Json formatting(State& state, const Json& params);
Json rangeFormatting(State& state, const Json& params);
Json onTypeFormatting(State& state, const Json& params);

// ---- code_actions.cpp
Json codeActions(State& state, const Json& params);

// ---- file_operations.cpp
Json willRenameFiles(State& state, const Json& params);
void filesRenamed(State& state, const Json& params);
void filesCreatedOrDeleted(State& state, const Json& params);

} // namespace lsp
