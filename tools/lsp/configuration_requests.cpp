// Completion, hover, definition and references in configuration files (.cfg), and the way from them to RAPID.

#include "config/json_text.h"
#include "frontend/project/files.h"
#include "frontend/query/config_queries.h"
#include "tools/lsp/json_of_answers.h"
#include "tools/lsp/requests.h"

namespace lsp {

namespace query = rapid::query;

namespace {

/// The program that a configuration belongs to; null when the document is something else.
const query::Snapshot* snapshotOf(State& state, const Target& target) {
    if (rapid::project::extensionOf(target.path) != ".cfg") return nullptr;
    state.workspace.adopt(target.path);
    const rapid::workspace::Program* owner = state.workspace.ownerOf(target.path);
    return owner ? &state.snapshot(*owner) : nullptr;
}

} // namespace

Json configurationCompletion(State& state, const Target& target) {
    query::CompletionList list;
    if (const query::Snapshot* snapshot = snapshotOf(state, target))
        list = query::configCompletionAt(*snapshot, target.positions->file(), target.offset);
    return toJson(state, target, list);
}

Json configurationHover(State& state, const Target& target) {
    const query::Snapshot* snapshot = snapshotOf(state, target);
    if (!snapshot) return nullptr;
    const auto found = query::configHoverAt(*snapshot, target.positions->file(), target.offset);
    return found ? toJson(state, target, *found) : Json(nullptr);
}

Json configurationDefinition(State& state, const Target& target) {
    const query::Snapshot* snapshot = snapshotOf(state, target);
    if (!snapshot) return Json::array();
    return toJson(state, query::configDefinitionAt(*snapshot, target.positions->source(), target.offset));
}

Json configurationReferences(State& state, const Target& target) {
    std::vector<query::Location> found;
    if (const query::Snapshot* snapshot = snapshotOf(state, target))
        for (const query::Use& use :
             query::configUsesAt(*snapshot, target.positions->source(), target.offset))
            found.push_back(use.place);
    return toJson(state, found);
}

} // namespace lsp
