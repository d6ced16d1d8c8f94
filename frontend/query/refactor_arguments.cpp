// Required arguments that a call lacks.

#include "frontend/query/completion_rules.h"
#include "frontend/query/refactor_parts.h"
#include "frontend/sema/names.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

/// A value that the parameter takes: what is usual for its type, data that fit, or an initial value.
std::string argumentFor(const RefactorPlace& place, const DataSymbol& param) {
    static constexpr std::pair<std::string_view, std::string_view> kUsual[] = {{"speeddata", "v100"},
                                                                               {"zonedata", "fine"},
                                                                               {"tooldata", "tool0"},
                                                                               {"wobjdata", "wobj0"},
                                                                               {"loaddata", "load0"}};
    const std::string_view type = param.type.type ? std::string_view(param.type.type->name) : "";
    for (const auto& [name, value] : kUsual)
        if (type == name && place.scope.find(value)) return std::string(value);
    Cursor cursor;
    cursor.expect = Expect::Expression;
    cursor.type = param.type;
    cursor.mode = param.mode;
    cursor.accepts = param.accepts;
    if (param.type.type && param.type.type->kind == TypeKind::AnyType) {
        cursor.anyType = true;
        cursor.type = {};
    }
    const std::string initial = param.mode == ParamMode::In && !cursor.anyType ? initialText(param.type) : "";
    if (!initial.empty()) return initial;
    const FitRules rules(cursor);
    for (const Symbol* symbol : place.scope.visible(place.cancel)) {
        const DataSymbol* data = dataOf(symbol);
        if (!data || symbol->predefined) continue;
        const Fit fit = rules.of(*symbol);
        if (fit == Fit::Exact || fit == Fit::Alike) return symbol->name;
    }
    return param.name;
}

/// Where the arguments of a call are: after its name when there are none.
struct CallParts {
    const Node* node = nullptr;
    TokenIndex name = kNoToken;
    std::span<Argument* const> args;
    bool function = false;
};

CallParts callAround(const RefactorPlace& place) {
    for (size_t i = place.nodes.size(); i-- > 0;) {
        const Node& node = *place.nodes[i];
        if (node.kind == NodeKind::Call)
            return {&node, as<CallExpr>(node).name, as<CallExpr>(node).args, true};
        if (node.kind == NodeKind::CallStmt && as<CallStmt>(node).name != kNoToken)
            return {&node, as<CallStmt>(node).name, as<CallStmt>(node).args, false};
    }
    return {};
}

int parameterOf(const RefactorPlace& place, const RoutineSymbol& routine, const Argument& arg,
                size_t& required) {
    if (arg.name != kNoToken) {
        const std::string name = foldName(place.tree.text(arg.name));
        for (size_t i = 0; i < routine.params.size(); ++i)
            if (foldName(routine.params[i]->name) == name) {
                if (!routine.params[i]->optional) ++required;
                return static_cast<int>(i);
            }
        return -1;
    }
    size_t number = 0;
    for (size_t i = 0; i < routine.params.size(); ++i)
        if (!routine.params[i]->optional && number++ == required) {
            ++required;
            return static_cast<int>(i);
        }
    return -1;
}

} // namespace

void insertArguments(const RefactorPlace& place, Refactorings& out) {
    const CallParts call = callAround(place);
    if (!call.node || call.node->broken) return;
    const RoutineSymbol* routine = routineOf(place.scope.find(place.tree.text(call.name)));
    if (!routine || routine->incomplete) return;
    for (const DataSymbol* param : routine->params)
        if (param->requiredAlternative) return;
    size_t required = 0;
    std::vector<int> given;
    for (const Argument* arg : call.args) {
        if (arg->argKind == ArgKind::Placeholder || (arg->value && arg->value->kind == NodeKind::ErrorExpr))
            return;
        given.push_back(parameterOf(place, *routine, *arg, required));
        if (given.back() < 0) return;
    }
    std::string text;
    int first = -1;
    for (size_t i = 0; i < routine->params.size(); ++i) {
        const int index = static_cast<int>(i);
        if (routine->params[i]->optional || std::find(given.begin(), given.end(), index) != given.end())
            continue;
        if (first < 0) first = index;
        text += (text.empty() ? "" : ",") + argumentFor(place, *routine->params[i]);
    }
    if (text.empty()) return;
    // Arguments keep the order of the parameters: optional ones that come later stay after the new ones.
    size_t before = 0;
    while (before < given.size() && given[before] < first)
        ++before;
    if (std::any_of(given.begin() + static_cast<std::ptrdiff_t>(before), given.end(),
                    [&](int index) { return !routine->params[static_cast<size_t>(index)]->optional; }))
        return;
    TextEdit edit;
    if (before > 0) {
        const uint32_t end = place.tree.range(*call.args[before - 1]).end;
        edit = {{end, end}, "," + text};
    } else {
        const uint32_t end = place.tree.range(call.name).end;
        const bool open = call.function && call.name + 1 < place.tree.tokens.size() &&
                          place.tree.tokens[call.name + 1].kind == TokenKind::LeftParen;
        if (call.function && !open) return;
        const uint32_t at = call.function ? place.tree.range(call.name + 1).end : end;
        edit = {{at, at}, call.function ? text : " " + text};
    }
    Refactoring refactoring;
    refactoring.title = "Insert missing arguments: " + text;
    refactoring.id = "insert-arguments";
    refactoring.kind = RefactoringKind::QuickFix;
    refactoring.edits.push_back(std::move(edit));
    out.push_back(std::move(refactoring));
}

} // namespace rapid::query
