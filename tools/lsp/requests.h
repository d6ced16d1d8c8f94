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

// ---- completion.cpp, hover.cpp, navigation.cpp
Json completion(State& state, const Json& params);
Json resolveCompletion(State& state, const Json& params);
Json hover(State& state, const Json& params);
Json signatureHelp(State& state, const Json& params);
Json definition(State& state, const Json& params);
Json typeDefinition(State& state, const Json& params);
Json implementation(State& state, const Json& params);
Json references(State& state, const Json& params);
Json documentHighlight(State& state, const Json& params);
Json prepareRename(State& state, const Json& params);
Json rename(State& state, const Json& params);

// ---- outline.cpp, semantic_tokens.cpp, hints.cpp
Json documentSymbol(State& state, const Json& params);
Json workspaceSymbol(State& state, const Json& params);
Json foldingRange(State& state, const Json& params);
Json selectionRange(State& state, const Json& params);
Json semanticTokensFull(State& state, const Json& params);
Json semanticTokensDelta(State& state, const Json& params);
Json semanticTokensRange(State& state, const Json& params);
Json inlayHint(State& state, const Json& params);
Json codeLens(State& state, const Json& params);
Json resolveCodeLens(State& state, const Json& params);
Json documentLink(State& state, const Json& params);
Json prepareCallHierarchy(State& state, const Json& params);
Json incomingCalls(State& state, const Json& params);
Json outgoingCalls(State& state, const Json& params);

// ---- configuration_requests.cpp: the same for configuration files (.cfg); null or empty for all other documents
Json configurationCompletion(State& state, const Target& target);
Json configurationHover(State& state, const Target& target);
Json configurationDefinition(State& state, const Target& target);
Json configurationReferences(State& state, const Target& target);

// ---- file_operations.cpp
Json willRenameFiles(State& state, const Json& params);
void filesRenamed(State& state, const Json& params);
void filesCreatedOrDeleted(State& state, const Json& params);

} // namespace lsp
