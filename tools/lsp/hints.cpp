// Texts that an editor shows between the lines: inlay hints, code lenses; links; the calls of routines.

#include "frontend/query/hints.h"
#include "config/json_text.h"
#include "frontend/project/files.h"
#include "frontend/query/call_hierarchy.h"
#include "frontend/query/links.h"
#include "tools/lsp/requests.h"
#include "tools/lsp/uri.h"

#include <filesystem>
#include <fmt/format.h>

namespace lsp {

namespace fs = std::filesystem;
namespace query = rapid::query;

namespace {

constexpr int kParameter = 2; ///< InlayHintKind
constexpr int kFunction = 12; ///< SymbolKind
constexpr int kModule = 2;

/// The snapshot that `data` of an item refers to; null when its program is gone.
const query::Snapshot* snapshotOf(State& state, const Json& data) {
    if (!data.is_object())
        throw RequestError{error::kInvalidParams, "'data': expected what the server has sent"};
    const rapid::workspace::Program* program = state.workspace.programOf(textField(data, "path"));
    return program ? &state.snapshot(*program) : nullptr;
}

Json toJson(State& state, const std::string& path, const query::CallItem& item) {
    const auto positions = state.positions(item.place.file);
    return {{"name", item.name},
            {"kind", item.isModule ? kModule : kFunction},
            {"detail", item.detail},
            {"uri", state.uriOf(item.place)},
            {"range", lsp::toJson(positions->range(item.place.whole))},
            {"selectionRange", lsp::toJson(positions->range(item.place.range))},
            {"data", {{"path", path}, {"key", item.key}}}};
}

/// `mine`: the file in which the calls of an outgoing edge are; null: in that of the item.
Json edges(State& state, const std::string& path, const std::vector<query::CallEdge>& found, const char* name,
           const std::shared_ptr<const rapid::SourceFile>& mine) {
    Json out = Json::array();
    for (const query::CallEdge& edge : found) {
        if (!edge.item.place.file) continue;
        const auto positions = state.positions(mine ? mine : edge.item.place.file);
        Json ranges = Json::array();
        for (const rapid::SourceRange range : edge.places)
            ranges.push_back(lsp::toJson(positions->range(range)));
        out.push_back({{name, toJson(state, path, edge.item)}, {"fromRanges", std::move(ranges)}});
    }
    return out;
}

/// The file that a controller's path means: below HOME of the program, its folder, or beside the module.
std::string fileOf(const Target& target, const std::string& path) {
    const size_t colon = path.find(':');
    const std::string inside = path.substr(colon == std::string::npos ? 0 : colon + 1);
    std::vector<fs::path> places{fs::path(target.path).parent_path()};
    if (target.program) {
        const fs::path root = target.program->isFolder() ? fs::path(target.program->root()) : places.front();
        if (const std::string& home = target.program->loaded().homeFolder; !home.empty())
            places.insert(places.begin(), home);
        places.push_back(rapid::project::findEntry(root, "HOME"));
        places.push_back(root);
    }
    for (const fs::path& place : places) {
        if (place.empty()) continue;
        const fs::path found = rapid::project::findPath(place, inside);
        if (!found.empty() && found != place && !rapid::project::isFolder(found))
            return found.lexically_normal().string();
    }
    return {};
}

} // namespace

Json inlayHint(State& state, const Json& params) {
    const Target target = state.target(params);
    const rapid::SourceRange range = target.positions->offsets(rangeOf(field(params, "range")));
    Json out = Json::array();
    if (!target.isModule()) return out;
    for (const query::InlayHint& hint :
         query::inlayHints(*target.snapshot, *target.view, range, state.cancel)) {
        if (hint.offset < range.begin || hint.offset > range.end) continue;
        Json item{{"position", lsp::toJson(target.positions->at(hint.offset))}, {"label", hint.label}};
        if (hint.isParameter) item["kind"] = kParameter;
        item[hint.isParameter ? "paddingRight" : "paddingLeft"] = true;
        if (!hint.tooltip.empty()) item["tooltip"] = hint.tooltip;
        out.push_back(std::move(item));
    }
    return out;
}

Json codeLens(State& state, const Json& params) {
    const Target target = state.target(params);
    Json out = Json::array();
    if (!target.isModule()) return out;
    for (const query::CodeLens& lens : query::codeLenses(*target.snapshot, *target.view)) {
        const Json range = lsp::toJson(target.positions->range(lens.range));
        out.push_back({{"range", range}, {"data", {{"path", target.path}, {"key", lens.key}}}});
        if (!lens.canRun) continue;
        const Json argument{{"uri", state.documents.uriOf(target.path)},
                            {"program", target.program->root()},
                            {"task", lens.task},
                            {"module", lens.module},
                            {"routine", lens.routine}};
        out.push_back(
            {{"range", range},
             {"command",
              {{"title", "Run"}, {"command", "rapidc.runRoutine"}, {"arguments", Json::array({argument})}}}});
    }
    return out;
}

Json resolveCodeLens(State& state, const Json& params) {
    rangeOf(field(params, "range"));
    Json lens = params;
    const Json* data = optionalField(params, "data");
    if (!data) return lens;
    const query::Snapshot* snapshot = snapshotOf(state, *data);
    const size_t count =
        snapshot ? query::countReferences(*snapshot, textField(*data, "key"), state.cancel) : 0;
    lens["command"] = {{"title", fmt::format("{} reference{}", count, count == 1 ? "" : "s")},
                       {"command", ""}};
    return lens;
}

Json documentLink(State& state, const Json& params) {
    const Target target = state.target(params);
    std::vector<query::FileLink> links;
    if (target.isModule())
        links = query::documentLinks(*target.view, state.cancel);
    else if (rapid::project::extensionOf(target.path) == ".pgf")
        links = query::programFileLinks(target.positions->file().text());
    Json out = Json::array();
    for (const query::FileLink& link : links)
        if (const std::string path = fileOf(target, link.path); !path.empty())
            out.push_back({{"range", lsp::toJson(target.positions->range(link.range))},
                           {"target", state.documents.uriOf(path)}});
    return out;
}

Json prepareCallHierarchy(State& state, const Json& params) {
    const Target target = state.targetAt(params);
    if (!target.isModule()) return nullptr;
    const auto item = query::callItemAt(*target.snapshot, *target.view, target.offset);
    if (!item || !item->place.file) return nullptr;
    return Json::array({toJson(state, target.path, *item)});
}

Json incomingCalls(State& state, const Json& params) {
    const Json& data = objectField(objectField(params, "item"), "data");
    const query::Snapshot* snapshot = snapshotOf(state, data);
    if (!snapshot) return nullptr;
    return edges(state, textField(data, "path"),
                 query::incomingCalls(*snapshot, textField(data, "key"), state.cancel), "from", nullptr);
}

Json outgoingCalls(State& state, const Json& params) {
    const Json& item = objectField(params, "item");
    const Json& data = objectField(item, "data");
    const query::Snapshot* snapshot = snapshotOf(state, data);
    if (!snapshot) return nullptr;
    const query::FileView* file = snapshot->file(state.documents.pathOfUri(textField(item, "uri")));
    if (!file) return Json::array(); // predefined: it calls nothing that can be shown
    return edges(state, textField(data, "path"),
                 query::outgoingCalls(*snapshot, textField(data, "key"), state.cancel), "to",
                 file->tree->source);
}

} // namespace lsp
