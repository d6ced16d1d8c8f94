// A value that is written out becomes data with a name, so that it can be taught.

#include "frontend/query/cursor.h"
#include "frontend/query/refactor_parts.h"
#include "frontend/sema/names.h"
#include "frontend/sema/type_rules.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

/// Literals and brackets only: such a value means the same in a declaration of the module.
bool isWrittenOut(const RefactorPlace& place, const Node& node) {
    for (TokenIndex t = node.first; t <= node.last; ++t)
        if (place.tree.tokens[t].kind == TokenKind::Identifier) return false;
    return !node.broken;
}

/// The outermost list in brackets around the selection, or the literal that is selected as a whole. Null: none where data
/// may be used instead.
const Node* valueAt(const RefactorPlace& place) {
    const Node* value = nullptr;
    for (size_t i = place.nodes.size(); i-- > 0;) {
        const Node& node = *place.nodes[i];
        switch (node.kind) {
        case NodeKind::Aggregate: value = &node; break;
        case NodeKind::NumLiteral:
        case NodeKind::StringLiteral:
        case NodeKind::BoolLiteral:
            if (!value && place.tree.range(node) == place.selection) value = &node;
            break;
        case NodeKind::CallStmt:
        case NodeKind::Assign:
        case NodeKind::Return: return value;
        // Labels, dimensions and initial values need a constant.
        case NodeKind::TestCase:
        case NodeKind::Data:
        case NodeKind::Routine: return nullptr;
        default: break;
        }
    }
    return nullptr;
}

std::string_view usualName(std::string_view type) {
    static constexpr std::pair<std::string_view, std::string_view> kNames[] = {
        {"robtarget", "p"},     {"jointtarget", "jpos"}, {"tooldata", "tool"}, {"wobjdata", "wobj"},
        {"speeddata", "speed"}, {"zonedata", "zone"},    {"loaddata", "load"}};
    const auto* found = std::find_if(std::begin(kNames), std::end(kNames),
                                     [&](const auto& entry) { return entry.first == type; });
    return found == std::end(kNames) ? "value" : found->second;
}

} // namespace

void teachValue(const RefactorPlace& place, Refactorings& out) {
    const Module* module = place.scope.around().module;
    const Node* value = valueAt(place);
    if (!module || !value || !place.scope.around().routineDecl || !isWrittenOut(place, *value)) return;
    const SourceRange range = place.tree.range(*value);
    const DataType type = cursorAt(Scope(place.snapshot, place.file, range.begin), range.begin).type;
    if (!type.type || type.isArray() || type.type->kind == TypeKind::Error || !isValueType(*type.type))
        return;
    const InsertPlace where = moduleDataPlace(place.file, *module);
    if (!where.usable) return;
    const bool point = type.type->name == "robtarget" || type.type->name == "jointtarget";
    const std::string name =
        freeName(place.scope, usualName(type.type->name), point ? 10 : 1, point ? 10 : 1);
    std::string text(place.text(range));
    text.erase(std::remove(text.begin(), text.end(), '\r'), text.end());
    for (const std::string_view word : {"PERS", "CONST"}) {
        Refactoring refactoring;
        refactoring.title = word == "PERS"
                                ? fmt::format("Teach the value into PERS {} '{}'", type.type->name, name)
                                : fmt::format("Extract constant '{}'", name);
        refactoring.id = word == "PERS" ? "teach-value" : "extract-constant";
        refactoring.kind = RefactoringKind::Extract;
        refactoring.edits.push_back({range, name});
        const TextEdit declaration =
            where.edit(fmt::format("{} {} {}:={};", word, type.type->name, name, text));
        if (declaration.range.begin <= range.begin) {
            const auto begin = static_cast<uint32_t>(range.begin + declaration.replacement.size());
            refactoring.name = {begin, begin + static_cast<uint32_t>(name.size())};
        } else {
            refactoring.name = {range.begin, range.begin + static_cast<uint32_t>(name.size())};
        }
        refactoring.edits.push_back(declaration);
        out.push_back(std::move(refactoring));
    }
}

} // namespace rapid::query
