#include "frontend/query/hints.h"

#include "frontend/query/describe.h"
#include "frontend/query/item_key.h"
#include "frontend/query/references.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <unordered_map>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

bool isLiteral(const Expr& expr) {
    const Expr& e = bare(expr);
    if (e.kind == NodeKind::Unary) return as<UnaryExpr>(e).operand && isLiteral(*as<UnaryExpr>(e).operand);
    if (e.kind == NodeKind::Aggregate) return true; // long: it is read where it is
    return e.kind == NodeKind::NumLiteral || e.kind == NodeKind::StringLiteral ||
           e.kind == NodeKind::BoolLiteral;
}

} // namespace

std::vector<InlayHint> inlayHints(const Snapshot&, const FileView& file, SourceRange range,
                                  const Cancel* cancel) {
    std::vector<InlayHint> hints;
    const auto add = [&](uint32_t offset, std::string label, bool parameter, std::string tooltip) {
        if (offset >= range.begin && offset <= range.end)
            hints.push_back({offset, std::move(label), parameter, std::move(tooltip)});
    };
    const auto call = [&](const BoundCall& bound) {
        for (const BoundArg& arg : bound.args) {
            if (!arg.param || !arg.argument || arg.param->optional || arg.argument->name != kNoToken ||
                !arg.argument->value || arg.argument->first == kNoToken)
                continue;
            add(file.tree->tokens[arg.argument->first].offset, arg.param->name + ":", true,
                parameterText(*arg.param));
        }
    };
    std::unordered_map<const Node*, const DataSymbol*> constants;
    for (const Module* module : file.modules)
        for (const DataSymbol* data : module->data)
            if (data->dataKind == DataKind::Const && data->init && !isLiteral(*data->init) &&
                !data->type.isArray())
                constants[data->decl] = data;
    forEachNodeOf(
        file, range,
        [&](const Module&, const RoutineSymbol*, const Node& node) {
            if (node.kind == NodeKind::Call || node.kind == NodeKind::CallStmt) {
                if (const BoundCall* bound = boundCallOf(file, node)) call(*bound);
            } else if (node.kind == NodeKind::Data) {
                const auto found = constants.find(&node);
                const ConstValue* value = found == constants.end() ? nullptr : constantOf(*found->second);
                if (value)
                    add(file.tree->range(*found->second->init).end,
                        "= " + valueText(*value, found->second->type, 40), false, "");
            }
        },
        cancel);
    std::sort(hints.begin(), hints.end(),
              [](const InlayHint& a, const InlayHint& b) { return a.offset < b.offset; });
    return hints;
}

std::vector<CodeLens> codeLenses(const Snapshot& snapshot, const FileView& file) {
    std::vector<CodeLens> lenses;
    for (const Module* module : file.modules)
        for (const RoutineSymbol* routine : module->routines) {
            if (routine->nameToken == kNoToken) continue;
            CodeLens lens;
            lens.range = file.tree->range(routine->nameToken);
            lens.routine = routine->name;
            lens.module = module->name;
            lens.task = file.task ? file.task->name : "";
            lens.canRun = routine->routineKind == RoutineKind::Proc && !file.isLibrary() &&
                          std::all_of(routine->params.begin(), routine->params.end(),
                                      [](const DataSymbol* param) { return param->optional; });
            lens.key = keyOf(snapshot, *routine);
            lenses.push_back(std::move(lens));
        }
    return lenses;
}

size_t countReferences(const Snapshot& snapshot, std::string_view key, const Cancel* cancel) {
    const Meaning meaning = meaningOfKey(snapshot, key);
    return meaning.symbol ? countUses(snapshot, *meaning.symbol, cancel) : 0;
}

} // namespace rapid::query
