// Completion, hover, definition and references in configuration files (.cfg), and the way from them to RAPID; the modules that
// a program file (.pgf) lists.

#include "config/json_text.h"
#include "config/text_util.h"
#include "frontend/project/files.h"
#include "frontend/query/config_queries.h"
#include "frontend/query/links.h"
#include "tools/lsp/json_of_answers.h"
#include "tools/lsp/requests.h"

#include <algorithm>
#include <filesystem>

namespace lsp {

namespace fs = std::filesystem;

namespace query = rapid::query;

namespace {

/// The program that a configuration belongs to; null when the document is something else.
const query::Snapshot* snapshotOf(State& state, const Target& target) {
    if (rapid::project::extensionOf(target.path) != ".cfg") return nullptr;
    state.workspace.adopt(target.path);
    const rapid::workspace::Program* owner = state.workspace.ownerOf(target.path);
    return owner ? &state.snapshot(*owner) : nullptr;
}

bool isProgramFile(const Target& target) {
    return rapid::project::extensionOf(target.path) == ".pgf";
}

using Entries = std::vector<query::FileLink>;

Entries entriesOf(const Target& target) {
    return query::programFileLinks(target.positions->file().text());
}

/// The entry of a program file at the offset, whose path may be empty; null: none.
const query::FileLink* entryAt(const Entries& entries, uint32_t offset) {
    const auto found = std::find_if(entries.begin(), entries.end(), [offset](const query::FileLink& entry) {
        return entry.range.begin <= offset && offset <= entry.range.end;
    });
    return found != entries.end() ? &*found : nullptr;
}

/// The modules beside a program file that it does not list yet.
query::CompletionList programFileCompletion(const Target& target) {
    query::CompletionList list;
    const Entries listing = entriesOf(target);
    const query::FileLink* const entry = entryAt(listing, target.offset);
    if (entry == nullptr) return list;
    list.replace = entry->range;
    for (const fs::path& file : rapid::project::entries(fs::path(target.path).parent_path())) {
        const std::string name = file.filename().string();
        const bool listed = std::any_of(listing.begin(), listing.end(), [&](const query::FileLink& other) {
            return rapid::config::sameName(other.path, name) && &other != entry;
        });
        if (!rapid::project::isModule(file) || listed) continue;
        query::CompletionItem item;
        item.label = item.insertText = name;
        item.kind = query::ItemKind::Module;
        list.items.push_back(std::move(item));
    }
    return list;
}

Json programFileDefinition(State& state, const Target& target) {
    std::vector<query::Location> found;
    const Entries listing = entriesOf(target);
    const query::FileLink* const entry = entryAt(listing, target.offset);
    if (entry != nullptr && !entry->path.empty()) {
        const fs::path path = rapid::project::findPath(fs::path(target.path).parent_path(), entry->path);
        if (const auto file = path.empty() ? nullptr : state.workspace.read(path.string()))
            found.push_back({file, {}, {}});
    }
    return toJson(state, found);
}

} // namespace

Json configurationCompletion(State& state, const Target& target) {
    if (isProgramFile(target)) return toJson(state, target, programFileCompletion(target));
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
    if (isProgramFile(target)) return programFileDefinition(state, target);
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
