// The targets of names: definition and its like, references, highlight, rename.

#include "frontend/query/navigation.h"
#include "config/json_text.h"
#include "frontend/query/config_queries.h"
#include "frontend/query/renaming.h"
#include "tools/lsp/json_of_answers.h"
#include "tools/lsp/requests.h"

#include <fmt/format.h>
#include <set>
#include <string>

namespace lsp {

namespace query = rapid::query;

Json toJson(State& state, const std::vector<query::Location>& places) {
    Json out = Json::array();
    std::set<std::string> seen;
    for (const query::Location& location : places) {
        Json place = state.location(location);
        if (!place.is_null() && seen.insert(place.dump()).second) out.push_back(std::move(place));
    }
    return out;
}

namespace {

using Find = std::vector<query::Location> (*)(const query::Snapshot&, const query::FileView&, uint32_t);

Json find(State& state, const Json& params, Find find) {
    const Target target = state.targetAt(params);
    if (!target.isModule()) return Json::array();
    return toJson(state, find(*target.snapshot, *target.view, target.offset));
}

/// DocumentHighlightKind
int kindOf(query::Access access) {
    switch (access) {
    case query::Access::Write:
    case query::Access::ReadWrite: return 3;
    case query::Access::Read: return 2;
    default: return 1;
    }
}

} // namespace

Json definition(State& state, const Json& params) {
    const Target target = state.targetAt(params);
    if (!target.isModule()) return configurationDefinition(state, target);
    return toJson(state, query::definitionAt(*target.snapshot, *target.view, target.offset));
}

Json typeDefinition(State& state, const Json& params) {
    return find(state, params, query::typeDefinitionAt);
}

Json implementation(State& state, const Json& params) {
    return find(state, params, query::implementationAt);
}

Json references(State& state, const Json& params) {
    const Target target = state.targetAt(params);
    const bool declaration = boolField(objectField(params, "context"), "includeDeclaration", false);
    if (!target.isModule()) return configurationReferences(state, target);
    const query::Meaning meaning = query::meaningAt(*target.snapshot, *target.view, target.offset);
    std::vector<query::Location> found;
    if (meaning.found())
        for (const query::Use& use : query::usesOf(*target.snapshot, meaning, declaration, state.cancel))
            found.push_back(use.place);
    for (query::Location& place : query::signalInConfiguration(*target.snapshot, meaning, declaration))
        found.push_back(std::move(place));
    return toJson(state, found);
}

Json documentHighlight(State& state, const Json& params) {
    const Target target = state.targetAt(params);
    Json out = Json::array();
    if (!target.isModule()) return out;
    for (const query::Use& use :
         query::highlightsAt(*target.snapshot, *target.view, target.offset, state.cancel))
        out.push_back(
            {{"range", toJson(target.positions->range(use.place.range))}, {"kind", kindOf(use.access)}});
    return out;
}

Json prepareRename(State& state, const Json& params) {
    const Target target = state.targetAt(params);
    if (!target.isModule()) throw RequestError{error::kRequestFailed, "only names in modules can be renamed"};
    const query::RenameTarget found = query::renameTargetAt(*target.snapshot, *target.view, target.offset);
    if (!found.problem.empty()) throw RequestError{error::kRequestFailed, found.problem};
    return {{"range", toJson(target.positions->range(found.range))}, {"placeholder", found.name}};
}

Json rename(State& state, const Json& params) {
    constexpr int kInformation = 3;
    const Target target = state.targetAt(params);
    const std::string name = textField(params, "newName");
    if (!target.isModule()) throw RequestError{error::kRequestFailed, "only names in modules can be renamed"};
    const auto& loaded = target.program->loaded();
    const query::RenameResult result = query::renameAt(*target.snapshot, *target.view, target.offset, name,
                                                       loaded.tasks, loaded.options, state.cancel);
    if (query::isCancelled(state.cancel)) return nullptr; // no half of a renaming
    if (!result.problem.empty()) throw RequestError{error::kRequestFailed, result.problem};
    std::vector<std::pair<std::shared_ptr<const rapid::SourceFile>, std::vector<rapid::TextEdit>>> files;
    for (const rapid::edit::FileEdits& file : result.files)
        files.emplace_back(file.file, file.edits);
    std::string notes;
    for (const query::RenameNote& note : result.notes) {
        const Position place = state.positions(note.place.file)->at(note.place.range.begin);
        notes += fmt::format("{}{}:{}:{}: {}", notes.empty() ? "" : "\n", note.place.file->path(),
                             place.line + 1, place.character + 1, note.text);
    }
    if (!notes.empty()) state.show(kInformation, notes);
    return state.workspaceEdit(files);
}

} // namespace lsp
