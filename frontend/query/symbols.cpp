#include "frontend/query/symbols.h"

#include "frontend/query/fuzzy.h"

#include <algorithm>
#include <set>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

OutlineKind kindOf(DataKind kind) {
    return kind == DataKind::Const  ? OutlineKind::Constant
           : kind == DataKind::Pers ? OutlineKind::Persistent
                                    : OutlineKind::Variable;
}
OutlineKind kindOf(RoutineKind kind) {
    return kind == RoutineKind::Func   ? OutlineKind::Function
           : kind == RoutineKind::Trap ? OutlineKind::Trap
                                       : OutlineKind::Procedure;
}

bool begin(const SyntaxTree& tree, const Node& node, TokenIndex name, OutlineKind kind, OutlineSymbol& out) {
    if (name == kNoToken || tree.text(name).empty()) return false;
    out.name = std::string(tree.text(name));
    out.kind = kind;
    out.selection = tree.range(name);
    out.range = tree.range(node);
    out.range.begin = std::min(out.range.begin, out.selection.begin);
    out.range.end = std::max(out.range.end, out.selection.end);
    return true;
}

/// The parameters as they are written, on one line.
std::string parametersOf(const SyntaxTree& tree, const RoutineDecl& routine) {
    if (routine.routineKind == RoutineKind::Trap) return {};
    std::string text;
    if (!routine.params.empty() && routine.params.front()->first != kNoToken) {
        const uint32_t from = tree.tokens[routine.params.front()->first].offset;
        const uint32_t to = tree.range(*routine.params.back()).end;
        bool blank = false;
        for (const char c : tree.source->text().substr(from, to > from ? to - from : 0)) {
            const bool space = c == ' ' || c == '\t' || c == '\r' || c == '\n';
            if (!space && std::exchange(blank, false)) text += ' ';
            if (space)
                blank = true;
            else
                text += c;
        }
    }
    const std::string result = std::string(tree.text(routine.returnType));
    return "(" + text + ")" + (result.empty() ? "" : " " + result);
}

bool declaration(const SyntaxTree& tree, const Decl& decl, OutlineSymbol& out) {
    switch (decl.kind) {
    case NodeKind::Record: {
        const auto& record = as<RecordDecl>(decl);
        if (!begin(tree, decl, record.name, OutlineKind::Record, out)) return false;
        for (const RecordComponent* component : record.components) {
            OutlineSymbol child;
            if (!begin(tree, *component, component->name, OutlineKind::Component, child)) continue;
            child.detail = std::string(tree.text(component->type));
            out.children.push_back(std::move(child));
        }
        return true;
    }
    case NodeKind::Alias:
        out.detail = std::string(tree.text(as<AliasDecl>(decl).type));
        return begin(tree, decl, as<AliasDecl>(decl).name, OutlineKind::Alias, out);
    case NodeKind::Data: {
        const auto& data = as<DataDecl>(decl);
        out.detail = std::string(tree.text(data.type));
        return begin(tree, decl, data.name, kindOf(data.dataKind), out);
    }
    case NodeKind::Routine: {
        const auto& routine = as<RoutineDecl>(decl);
        out.detail = parametersOf(tree, routine);
        return begin(tree, decl, routine.name, kindOf(routine.routineKind), out);
    }
    default: return false;
    }
}

} // namespace

std::vector<OutlineSymbol> outlineOf(const SyntaxTree& tree) {
    std::vector<OutlineSymbol> all;
    for (const ModuleDecl* module : tree.modules) {
        OutlineSymbol symbol;
        if (!begin(tree, *module, module->name, OutlineKind::Module, symbol)) {
            if (module->first == kNoToken || module->first > module->last) continue;
            symbol.name = "MODULE";
            symbol.range = tree.range(*module);
            symbol.selection = tree.range(module->first);
        }
        for (const Decl* decl : module->decls) {
            OutlineSymbol child;
            if (declaration(tree, *decl, child)) symbol.children.push_back(std::move(child));
        }
        all.push_back(std::move(symbol));
    }
    return all;
}

std::vector<WorkspaceSymbol> workspaceSymbols(const Snapshot& snapshot, std::string_view letters,
                                              size_t limit, const Cancel* cancel) {
    std::vector<std::pair<int, WorkspaceSymbol>> found;
    std::set<std::string> seen;
    for (const auto& file : snapshot.files()) {
        if (isCancelled(cancel)) break;
        if (file->isLibrary() || !seen.insert(file->source().path()).second) continue;
        const auto add = [&](std::string_view name, const Module& module, OutlineKind kind, Location place) {
            const int rank = letters.empty() ? 1 : fuzzyRank(letters, name);
            if (rank < 0 || !place.file) return;
            found.push_back({rank,
                             {std::string(name), kind == OutlineKind::Module ? "" : module.name, kind,
                              std::move(place)}});
        };
        for (const Module* module : file->modules) {
            Meaning self;
            self.module = module;
            if (!module->name.empty())
                add(module->name, *module, OutlineKind::Module, declarationOf(snapshot, self));
            for (const TypeSymbol* type : module->types)
                add(type->name, *module,
                    type->type && type->type->aliasOf ? OutlineKind::Alias : OutlineKind::Record,
                    locationOf(snapshot, *type));
            for (const DataSymbol* data : module->data)
                add(data->name, *module, kindOf(data->dataKind), locationOf(snapshot, *data));
            for (const RoutineSymbol* routine : module->routines)
                add(routine->name, *module, kindOf(routine->routineKind), locationOf(snapshot, *routine));
        }
    }
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
        if (a.first != b.first) return a.first < b.first;
        if (a.second.name != b.second.name) return a.second.name < b.second.name;
        return a.second.place.range.begin < b.second.place.range.begin;
    });
    if (found.size() > limit) found.resize(limit);
    std::vector<WorkspaceSymbol> symbols;
    for (auto& [rank, symbol] : found)
        symbols.push_back(std::move(symbol));
    return symbols;
}

} // namespace rapid::query
