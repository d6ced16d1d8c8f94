#include "frontend/query/call_hierarchy.h"

#include "frontend/query/describe.h"
#include "frontend/query/item_key.h"
#include "frontend/query/late_calls.h"
#include "frontend/query/name_walk.h"
#include "frontend/sema/names.h"

#include <algorithm>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

CallItem itemOf(const Snapshot& snapshot, const RoutineSymbol& routine) {
    CallItem item;
    item.name = routine.name;
    item.module = routine.module ? routine.module->name : "";
    item.detail = routineLabel(routine).text;
    item.place = locationOf(snapshot, routine);
    item.key = keyOf(snapshot, routine);
    return item;
}

CallItem itemOf(const Snapshot& snapshot, const Module& module) {
    Meaning meaning;
    meaning.module = &module;
    CallItem item;
    item.name = item.module = module.name;
    item.detail = "MODULE " + module.name;
    item.isModule = true;
    item.place = declarationOf(snapshot, meaning);
    item.key = keyOf(snapshot, meaning);
    return item;
}

/// Collects calls by caller or by routine that is called.
class Edges {
  public:
    void add(CallItem item, SourceRange place, bool byName) {
        const auto same = std::find_if(edges_.begin(), edges_.end(),
                                       [&](const CallEdge& edge) { return edge.item.key == item.key; });
        const bool isNew = same == edges_.end();
        CallEdge& edge = isNew ? edges_.emplace_back() : *same;
        if (isNew) edge.item = std::move(item);
        if (std::find(edge.places.begin(), edge.places.end(), place) == edge.places.end())
            edge.places.push_back(place);
        edge.byName = edge.byName || byName;
    }
    std::vector<CallEdge> take() {
        for (CallEdge& edge : edges_)
            std::sort(edge.places.begin(), edge.places.end(),
                      [](const SourceRange& a, const SourceRange& b) { return a.begin < b.begin; });
        return std::move(edges_);
    }

  private:
    std::vector<CallEdge> edges_;
};

void addCaller(const Snapshot& snapshot, const FileView& file, SourceRange place, bool byName, Edges& edges) {
    const Surroundings around = surroundings(file, place.begin);
    if (around.routine)
        edges.add(itemOf(snapshot, *around.routine), place, byName);
    else if (around.module)
        edges.add(itemOf(snapshot, *around.module), place, byName);
}

/// Calls by name are where `%` or CallByVar is.
void addLateCallers(const Snapshot& snapshot, const FileView& file, const RoutineSymbol& routine,
                    Edges& edges, const Cancel* cancel) {
    const std::string byVar = "callbyvar";
    for (TokenIndex t = 0; t < tokenCountOf(file) && !isCancelled(cancel); ++t) {
        const Token& token = file.tree->tokens[t];
        if (token.kind != TokenKind::Percent &&
            (token.kind != TokenKind::Identifier || token.length != byVar.size() ||
             foldName(file.tree->text(t)) != byVar))
            continue;
        for (const Node* node : nodesAt(file, token.offset + 1)) {
            if (node->kind != NodeKind::CallStmt) continue;
            const auto late = lateCallOf(file, as<CallStmt>(*node));
            if (!late || !mayMean(*late, routine.name)) continue;
            const auto targets = targetsOf(snapshot, file, *late);
            const auto isIt = [&](const RoutineSymbol* target) {
                return locationOf(snapshot, *target) == locationOf(snapshot, routine);
            };
            if (std::any_of(targets.begin(), targets.end(), isIt))
                addCaller(snapshot, file, late->range, true, edges);
        }
    }
}

const RoutineSymbol* routineOfKey(const Snapshot& snapshot, std::string_view key) {
    return routineOf(meaningOfKey(snapshot, key).symbol);
}

} // namespace

std::optional<CallItem> callItemAt(const Snapshot& snapshot, const FileView& file, uint32_t offset) {
    if (const RoutineSymbol* routine = routineOf(meaningAt(snapshot, file, offset).symbol))
        return itemOf(snapshot, *routine);
    if (const RoutineSymbol* routine = surroundings(file, offset).routine) return itemOf(snapshot, *routine);
    return std::nullopt;
}

std::vector<CallEdge> incomingCalls(const Snapshot& snapshot, std::string_view key, const Cancel* cancel) {
    Edges edges;
    const RoutineSymbol* routine = routineOfKey(snapshot, key);
    if (!routine) return {};
    Meaning meaning;
    meaning.symbol = routine;
    for (const Use& use : usesOf(snapshot, meaning, false, cancel))
        if (const FileView* file = snapshot.file(use.place.file->path()))
            addCaller(snapshot, *file, use.place.range, false, edges);
    if (routine->routineKind == RoutineKind::Proc)
        for (const auto& file : snapshot.files())
            if (!file->isLibrary()) addLateCallers(snapshot, *file, *routine, edges, cancel);
    return edges.take();
}

std::vector<CallEdge> outgoingCalls(const Snapshot& snapshot, std::string_view key, const Cancel* cancel) {
    Edges edges;
    const RoutineSymbol* routine = routineOfKey(snapshot, key);
    const FileView* file = routine && routine->module ? snapshot.fileOf(*routine->module) : nullptr;
    if (!file || !routine->decl) return {};
    const SyntaxTree& tree = *file->tree;
    const std::function<void(const Node&)> visit = [&](const Node& node) {
        if (isCancelled(cancel)) return;
        const BoundCall* bound = boundCallOf(*file, node);
        if (bound && bound->routine) {
            const TokenIndex name = node.kind == NodeKind::Call       ? as<CallExpr>(node).name
                                    : node.kind == NodeKind::CallStmt ? as<CallStmt>(node).name
                                                                      : node.first;
            if (name != kNoToken) edges.add(itemOf(snapshot, *bound->routine), tree.range(name), false);
        }
        if (node.kind == NodeKind::CallStmt)
            if (const auto late = lateCallOf(*file, as<CallStmt>(node)))
                for (const RoutineSymbol* target : targetsOf(snapshot, *file, *late))
                    edges.add(itemOf(snapshot, *target), late->range, true);
        if (node.kind == NodeKind::Connect && as<ConnectStmt>(node).trap != kNoToken && file->facts) {
            const auto trap = file->facts->references.find(&node);
            if (trap != file->facts->references.end() && routineOf(trap->second))
                edges.add(itemOf(snapshot, *routineOf(trap->second)), tree.range(as<ConnectStmt>(node).trap),
                          false);
        }
        forEachNode(node, visit);
    };
    visit(*routine->decl);
    return edges.take();
}

} // namespace rapid::query
