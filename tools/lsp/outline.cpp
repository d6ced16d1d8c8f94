// The parts of a document: symbols, folding, selection; symbols of the workspace.

#include "config/json_text.h"
#include "frontend/project/files.h"
#include "frontend/query/config_queries.h"
#include "frontend/query/structure.h"
#include "frontend/query/symbols.h"
#include "tools/lsp/requests.h"

#include <set>

namespace lsp {

namespace query = rapid::query;
using query::OutlineKind;
using query::OutlineSymbol;

namespace {

/// SymbolKind
int kindOf(OutlineKind kind) {
    switch (kind) {
    case OutlineKind::Module: return 2;
    case OutlineKind::Record: return 23;
    case OutlineKind::Component: return 8;
    case OutlineKind::Alias: return 26; // TypeParameter
    case OutlineKind::Constant: return 14;
    case OutlineKind::Variable:
    case OutlineKind::Persistent: return 13;
    case OutlineKind::Procedure:
    case OutlineKind::Function:
    case OutlineKind::Trap: return 12;
    }
    return 13;
}

Json tree(const PositionMap& positions, const OutlineSymbol& symbol) {
    Json out{{"name", symbol.name},
             {"kind", kindOf(symbol.kind)},
             {"range", toJson(positions.range(symbol.range))},
             {"selectionRange", toJson(positions.range(symbol.selection))}};
    if (!symbol.detail.empty()) out["detail"] = symbol.detail;
    if (symbol.children.empty()) return out;
    Json children = Json::array();
    for (const OutlineSymbol& child : symbol.children)
        children.push_back(tree(positions, child));
    out["children"] = std::move(children);
    return out;
}

/// For clients that know no trees.
void flatten(State& state, const PositionMap& positions, const OutlineSymbol& symbol,
             const std::string& container, Json& out) {
    Json item{{"name", symbol.name},
              {"kind", kindOf(symbol.kind)},
              {"location", state.location(positions.source(), symbol.range)}};
    if (!container.empty()) item["containerName"] = container;
    out.push_back(std::move(item));
    for (const OutlineSymbol& child : symbol.children)
        flatten(state, positions, child, symbol.name, out);
}

} // namespace

Json documentSymbol(State& state, const Json& params) {
    const Target target = state.target(params);
    Json out = Json::array();
    std::vector<OutlineSymbol> symbols;
    if (target.tree)
        symbols = query::outlineOf(*target.tree);
    else if (rapid::project::extensionOf(target.path) == ".cfg")
        symbols = query::configOutline(target.positions->file().text());
    const bool trees = state.can("textDocument.documentSymbol.hierarchicalDocumentSymbolSupport");
    for (const OutlineSymbol& symbol : symbols) {
        if (trees)
            out.push_back(tree(*target.positions, symbol));
        else
            flatten(state, *target.positions, symbol, "", out);
    }
    return out;
}

Json workspaceSymbol(State& state, const Json& params) {
    const std::string letters = textField(params, "query");
    Json out = Json::array();
    std::set<std::string> seen; // a file may be part of several programs
    for (const rapid::workspace::Program* program : state.workspace.programs())
        for (const query::WorkspaceSymbol& symbol :
             query::workspaceSymbols(state.snapshot(*program), letters, 500, state.cancel)) {
            Json place = state.location(symbol.place);
            if (place.is_null() || !seen.insert(place.dump() + symbol.name).second) continue;
            out.push_back({{"name", symbol.name},
                           {"kind", kindOf(symbol.kind)},
                           {"containerName", symbol.container},
                           {"location", std::move(place)}});
        }
    return out;
}

Json foldingRange(State& state, const Json& params) {
    const Target target = state.target(params);
    Json out = Json::array();
    if (!target.isModule()) return out;
    for (const query::FoldingRange& fold : query::foldingRanges(*target.view, state.cancel)) {
        Json item{{"startLine", fold.firstLine - 1}, {"endLine", fold.lastLine - 1}};
        if (fold.isComment) item["kind"] = "comment";
        out.push_back(std::move(item));
    }
    return out;
}

/// Each is an object inside of another one, and readers of JSON limit their depth (to 128, for example).
constexpr std::ptrdiff_t kMostSelections = 100;

Json selectionRange(State& state, const Json& params) {
    const Target target = state.target(params);
    Json out = Json::array();
    for (const Json& position : arrayField(params, "positions")) {
        const Position place = positionOf(position);
        const uint32_t offset = target.positions->offset(place);
        Json around;
        if (target.isModule()) {
            auto ranges = query::selectionRanges(*target.view, offset);
            if (std::ssize(ranges) > kMostSelections) // the innermost ones and the file
                ranges.erase(ranges.begin() + kMostSelections - 1, ranges.end() - 1);
            for (size_t i = ranges.size(); i-- > 0;) {
                Json next{{"range", toJson(target.positions->range(ranges[i]))}};
                if (!around.is_null()) next["parent"] = std::move(around);
                around = std::move(next);
            }
        }
        if (around.is_null()) around = {{"range", toJson(Range{place, place})}};
        out.push_back(std::move(around));
    }
    return out;
}

} // namespace lsp
