// New declarations for names that nothing declares.

#include "frontend/query/cursor.h"
#include "frontend/query/refactor_parts.h"
#include "frontend/sema/names.h"
#include "frontend/sema/type_rules.h"
#include "frontend/syntax/token_set.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace rapid::query {

using namespace sema;
using namespace syntax;

std::string newParameter(const DataType& type, std::string_view name, std::string_view mode) {
    const std::string typeName = type.type && type.type->kind != TypeKind::Error ? type.type->name : "num";
    const bool handle = type.type && !isValueType(*type.type) && type.type->kind != TypeKind::Error;
    std::string dims;
    for (int i = 0; i < type.rank; ++i)
        dims += i ? ",*" : "{*";
    if (!dims.empty()) dims += '}';
    return fmt::format("{}{} {}{}", mode.empty() && handle ? "VAR " : mode, typeName, name, dims);
}

namespace {

/// The parameters that the arguments of a call ask for.
std::string parametersFor(const RefactorPlace& place, std::span<Argument* const> args) {
    std::string text;
    std::set<std::string> taken;
    for (const Argument* arg : args) {
        const bool optional = arg->argKind != ArgKind::Required;
        const Expr* value = arg->value ? &bare(*arg->value) : nullptr;
        std::string name(place.tree.text(arg->name));
        if (name.empty() && value && value->kind == NodeKind::Name)
            name = place.tree.text(as<NameExpr>(*value).name);
        if (name.empty() || keywordKind(name) != TokenKind::Identifier)
            name = fmt::format("arg{}", taken.size() + 1);
        while (!taken.insert(foldName(name)).second)
            name += "_";
        if (optional)
            text += text.empty() ? "\\" : " \\";
        else if (!text.empty())
            text += ",";
        if (optional && !value)
            text += "switch " + name;
        else
            text += newParameter(value ? typeOfExpr(place.scope, *value) : DataType{}, name, "");
    }
    return text;
}

void add(const RefactorPlace& place, std::string title, std::string_view header, std::string_view body,
         std::string_view end, Refactorings& out) {
    const RoutineDecl* around = place.scope.around().routineDecl;
    const Module* module = place.scope.around().module;
    if (!around || !module) return;
    const InsertPlace where = afterRoutine(place.file, *around);
    if (!where.usable) return;
    Refactoring refactoring;
    refactoring.title = std::move(title);
    refactoring.id = "create-routine";
    refactoring.kind = RefactoringKind::QuickFix;
    const std::string unit = indentUnit(place.file, *module);
    refactoring.edits.push_back(where.edit(
        fmt::format("\n{}\n{}{}", header, body.empty() ? "" : unit + std::string(body) + "\n", end)));
    out.push_back(std::move(refactoring));
}

bool isUnknown(const RefactorPlace& place, TokenIndex name) {
    if (name == kNoToken || place.tree.tokens[name].kind != TokenKind::Identifier) return false;
    const SourceRange range = place.tree.range(name);
    return range.begin <= place.selection.begin && place.selection.begin <= range.end &&
           place.tree.text(name).size() <= 32 && !place.scope.find(place.tree.text(name));
}

} // namespace

void createRoutine(const RefactorPlace& place, Refactorings& out) {
    if (const auto* call = place.innermost<CallStmt>(NodeKind::CallStmt);
        call && isUnknown(place, call->name)) {
        const std::string name(place.tree.text(call->name));
        return add(place, fmt::format("Create procedure '{}'", name),
                   fmt::format("PROC {}({})", name, parametersFor(place, call->args)), "", "ENDPROC", out);
    }
    if (const auto* call = place.innermost<CallExpr>(NodeKind::Call); call && isUnknown(place, call->name)) {
        const std::string name(place.tree.text(call->name));
        const uint32_t offset = place.tree.range(call->name).begin;
        DataType type = cursorAt(Scope(place.snapshot, place.file, offset), offset).type;
        std::string value = initialText(type);
        if (value.empty()) {
            type = {place.snapshot.program().num, 0, {}};
            value = "0";
        }
        return add(place, fmt::format("Create function '{}'", name),
                   fmt::format("FUNC {} {}({})", type.type->name, name, parametersFor(place, call->args)),
                   "RETURN " + value + ";", "ENDFUNC", out);
    }
    if (const auto* connect = place.innermost<ConnectStmt>(NodeKind::Connect);
        connect && isUnknown(place, connect->trap)) {
        const std::string name(place.tree.text(connect->trap));
        add(place, fmt::format("Create trap routine '{}'", name), "TRAP " + name, "", "ENDTRAP", out);
    }
}

namespace {

/// What the place of an unknown name asks for.
struct Wanted {
    DataType type;
    ParamMode mode = ParamMode::In;
    bool written = false;
    int rank = 0;
};

Wanted wantedAt(const RefactorPlace& place, const NameExpr& name, bool& possible) {
    Wanted wanted;
    const Node* inner = &name;
    const Node* outer = nullptr;
    for (size_t i = place.nodes.size(); i-- > 0;)
        if (place.nodes[i] == inner && i > 0) outer = place.nodes[i - 1];
    possible = outer && outer->kind != NodeKind::Component;
    if (!possible) return wanted;
    if (outer->kind == NodeKind::Index && as<IndexExpr>(*outer).base == inner) {
        wanted.rank = static_cast<int>(std::min<size_t>(as<IndexExpr>(*outer).indices.size(), 3));
        for (size_t i = place.nodes.size(); i-- > 1;)
            if (place.nodes[i] == outer) {
                inner = outer;
                outer = place.nodes[i - 1];
                break;
            }
    }
    if (outer->kind == NodeKind::Assign && as<AssignStmt>(*outer).target == inner) {
        wanted.written = true;
        if (as<AssignStmt>(*outer).value)
            wanted.type = typeOfExpr(place.scope, *as<AssignStmt>(*outer).value);
        return wanted;
    }
    const uint32_t offset = place.tree.range(name.name).begin;
    const Cursor cursor = cursorAt(Scope(place.snapshot, place.file, offset), offset);
    wanted.type = cursor.type;
    wanted.mode = cursor.mode;
    wanted.written = cursor.mode != ParamMode::In && cursor.mode != ParamMode::Pers;
    return wanted;
}

struct Choice {
    std::string_view word;
    bool local;
};

std::vector<Choice> choicesFor(const Wanted& wanted, bool isValue, bool inRoutine) {
    const std::string_view type = wanted.type.type ? std::string_view(wanted.type.type->name) : "num";
    std::vector<Choice> choices;
    const bool kept = type == "tooldata" || type == "wobjdata" || type == "loaddata";
    if (wanted.mode == ParamMode::Pers || kept) return {{"PERS", false}};
    const bool point =
        type == "robtarget" || type == "jointtarget" || type == "speeddata" || type == "zonedata";
    if (point && !wanted.written && wanted.rank == 0) choices.push_back({"CONST", false});
    if (inRoutine && isValue) choices.push_back({"VAR", true});
    choices.push_back({"VAR", false});
    if (isValue) choices.push_back({"PERS", false});
    if (!point && !wanted.written && isValue && wanted.rank == 0) choices.push_back({"CONST", false});
    return choices;
}

} // namespace

void declareData(const RefactorPlace& place, Refactorings& out) {
    const Module* module = place.scope.around().module;
    const auto* name = place.innermost<NameExpr>(NodeKind::Name);
    if (!module || !name || !isUnknown(place, name->name)) return;
    bool possible = false;
    Wanted wanted = wantedAt(place, *name, possible);
    if (!possible || wanted.type.isArray()) return;
    if (!wanted.type.type || wanted.type.type->kind == TypeKind::Error ||
        wanted.type.type->kind == TypeKind::AnyType)
        wanted.type = {place.snapshot.program().num, 0, {}};
    if (wanted.type.type->kind == TypeKind::SemiValue) return; // a signal of the configuration
    const bool isValue = isValueType(*wanted.type.type);
    const std::string spelling(place.tree.text(name->name));
    std::string dims;
    for (int i = 0; i < wanted.rank; ++i)
        dims += i ? ",10" : "{10";
    if (!dims.empty()) dims += '}';
    const RoutineDecl* routine = place.scope.around().routineDecl;
    for (const Choice& choice : choicesFor(wanted, isValue, routine != nullptr)) {
        const InsertPlace where =
            choice.local ? routineDataPlace(place.file, *routine) : moduleDataPlace(place.file, *module);
        const std::string value = wanted.rank ? "" : initialText(wanted.type);
        if (!where.usable || (choice.word == "CONST" && value.empty())) continue;
        Refactoring refactoring;
        refactoring.title = fmt::format("Declare {}'{}' as {} {}{}", choice.local ? "local " : "", spelling,
                                        choice.word, wanted.type.type->name, dims);
        refactoring.id = "declare-data";
        refactoring.kind = RefactoringKind::QuickFix;
        const bool initial = choice.word != "VAR" && !value.empty();
        refactoring.edits.push_back(
            where.edit(fmt::format("{} {} {}{}{};", choice.word, wanted.type.type->name, spelling, dims,
                                   initial ? ":=" + value : "")));
        out.push_back(std::move(refactoring));
    }
}

} // namespace rapid::query
