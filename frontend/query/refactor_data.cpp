// Constants inlined, the kind of data changed, points in order.

#include "frontend/query/name_walk.h"
#include "frontend/query/refactor_parts.h"
#include "frontend/query/references.h"
#include "frontend/sema/names.h"
#include "frontend/sema/type_rules.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

/// The line of a declaration with its line end, when nothing else but a comment is on it.
SourceRange wholeLine(const RefactorPlace& place, const Node& decl) {
    SourceRange range = place.tree.range(decl);
    const std::string_view text = place.file.text();
    const TokenIndex next = decl.last + 1;
    if (next < tokenCountOf(place.file) && place.tree.tokens[next].kind == TokenKind::Semicolon &&
        place.tree.tokens[decl.last].kind != TokenKind::Semicolon)
        range.end = place.tree.range(next).end;
    const size_t lineStart =
        range.begin == 0 ? std::string_view::npos : text.find_last_of("\r\n", range.begin - 1);
    const size_t begin = lineStart == std::string_view::npos ? 0 : lineStart + 1;
    size_t end = std::min(text.find_first_of("\r\n", range.end), text.size());
    const std::string_view before = text.substr(begin, range.begin - begin);
    const std::string_view after = text.substr(range.end, end - range.end);
    const size_t content = after.find_first_not_of(" \t");
    if (before.find_first_not_of(" \t") != std::string_view::npos ||
        (content != std::string_view::npos && after[content] != '!'))
        return range;
    if (end < text.size()) end += text[end] == '\r' && end + 1 < text.size() && text[end + 1] == '\n' ? 2 : 1;
    return {static_cast<uint32_t>(begin), static_cast<uint32_t>(end)};
}

/// The node around a name that is used: what is done with the value.
const Node* parentOf(const FileView& file, SourceRange name) {
    const auto nodes = nodesAt(file, name.begin + 1);
    return nodes.size() >= 2 ? nodes[nodes.size() - 2] : nullptr;
}

bool isPlainLiteral(const Expr& expr) {
    const Expr& e = bare(expr);
    return e.kind == NodeKind::NumLiteral || e.kind == NodeKind::StringLiteral ||
           e.kind == NodeKind::BoolLiteral || e.kind == NodeKind::Aggregate;
}

} // namespace

void inlineConstant(const RefactorPlace& place, Refactorings& out) {
    const Meaning meaning = meaningAt(place.snapshot, place.file, place.selection.begin);
    const DataSymbol* data = dataOf(meaning.symbol);
    if (!data || data->predefined || data->dataKind != DataKind::Const || !data->init ||
        data->type.isArray() || !data->decl || data->decl->kind != NodeKind::Data || !data->module ||
        data->module->tree != &place.tree ||
        (data->storage != Storage::ModuleData && data->storage != Storage::RoutineData))
        return;
    std::string value(place.text(*data->init));
    if (value.find_first_of("\r\n") != std::string::npos) return;
    if (!isPlainLiteral(*data->init)) value = "(" + value + ")";
    Refactoring refactoring;
    for (const Use& use : usesOf(place.snapshot, meaning, true, place.cancel)) {
        if (use.place.file->path() != place.file.source().path()) return; // edits are of one file
        if (use.access == Access::Declaration) continue;
        const Node* parent = parentOf(place.file, use.place.range);
        if (use.access != Access::Read || !parent || parent->kind == NodeKind::Component ||
            parent->kind == NodeKind::Index)
            return;
        // What other constants mean may differ where the name is used: literals mean the same everywhere.
        if (!isPlainLiteral(*data->init) && data->storage != Storage::ModuleData) return;
        refactoring.edits.push_back({use.place.range, value});
    }
    if (refactoring.edits.empty() || isCancelled(place.cancel)) return;
    refactoring.edits.push_back({wholeLine(place, *data->decl), ""});
    refactoring.title = fmt::format("Inline constant '{}'", data->name);
    refactoring.id = "inline-constant";
    refactoring.kind = RefactoringKind::Inline;
    out.push_back(std::move(refactoring));
}

namespace {

/// What the uses of data allow it to be.
struct Allowed {
    bool constant = true, variable = true, persistent = true;
};

Allowed allowedFor(const RefactorPlace& place, const Meaning& meaning, const DataSymbol& data) {
    Allowed allowed;
    for (const Use& use : usesOf(place.snapshot, meaning, false, place.cancel)) {
        if (use.access == Access::Write || use.access == Access::ReadWrite) allowed.constant = false;
        const FileView* file = place.snapshot.file(use.place.file->path());
        if (!file) continue;
        const auto nodes = nodesAt(*file, use.place.range.begin + 1);
        for (size_t i = nodes.size(); i-- > 0;) {
            const Node& node = *nodes[i];
            // Dimensions, constants and CASE need a value that is known before the run.
            if (node.kind == NodeKind::Data || node.kind == NodeKind::Module)
                allowed.variable = allowed.persistent = data.dataKind != DataKind::Const;
            const BoundCall* call = boundCallOf(*file, node);
            if (!call) continue;
            for (const BoundArg& arg : call->args) {
                if (!arg.param || !arg.value) continue;
                const SourceRange own = file->tree->range(*arg.value);
                if (own.begin > use.place.range.begin || own.end < use.place.range.end) continue;
                if (arg.param->mode == ParamMode::Pers) allowed.constant = allowed.variable = false;
                if (arg.param->mode == ParamMode::Var) allowed.constant = allowed.persistent = false;
                if (arg.param->mode == ParamMode::Inout || arg.param->mode == ParamMode::Ref)
                    allowed.constant = false;
            }
            break;
        }
    }
    return allowed;
}

} // namespace

void convertData(const RefactorPlace& place, Refactorings& out) {
    const auto* decl = place.innermost<DataDecl>(NodeKind::Data);
    if (!decl || place.scope.around().routineDecl || decl->name == kNoToken || decl->broken) return;
    if (decl->init && place.tree.range(*decl->init).begin < place.selection.begin)
        return; // on the header only
    const Meaning meaning = meaningOf(place.snapshot, place.file, decl->name);
    const DataSymbol* data = dataOf(meaning.symbol);
    if (!data || !data->type.type || data->type.isArray() || !isValueType(*data->type.type)) return;
    TokenIndex word = decl->first;
    while (word < decl->type && place.tree.tokens[word].kind != TokenKind::KwVar &&
           place.tree.tokens[word].kind != TokenKind::KwPers &&
           place.tree.tokens[word].kind != TokenKind::KwConst)
        ++word;
    if (word >= decl->type) return;
    const Allowed allowed = allowedFor(place, meaning, *data);
    if (isCancelled(place.cancel)) return;
    const auto offer = [&](DataKind kind, std::string_view spelling, bool possible) {
        if (!possible || decl->dataKind == kind ||
            (kind == DataKind::Const && decl->scope == ScopeWord::Task))
            return;
        if (kind == DataKind::Pers && decl->init && !isPlainLiteral(*decl->init)) return;
        Refactoring refactoring;
        refactoring.title = fmt::format("Make '{}' {}", data->name, spelling);
        refactoring.id = "convert-data";
        refactoring.edits.push_back({place.tree.range(word), std::string(spelling)});
        if (!decl->init && kind != DataKind::Var) {
            const std::string value = initialText(data->type);
            if (value.empty()) return;
            const uint32_t end = place.tree.range(decl->name).end;
            refactoring.edits.push_back({{end, end}, ":=" + value});
        }
        out.push_back(std::move(refactoring));
    };
    offer(DataKind::Const, "CONST", allowed.constant);
    offer(DataKind::Var, "VAR", allowed.variable);
    offer(DataKind::Pers, "PERS", allowed.persistent);
}

namespace {

bool isPoint(const SyntaxTree& tree, const Decl& decl) {
    if (decl.kind != NodeKind::Data || decl.broken) return false;
    const std::string type = foldName(tree.text(as<DataDecl>(decl).type));
    return type == "robtarget" || type == "jointtarget";
}

/// p2 before p10.
std::pair<std::string, uint64_t> naturalKey(std::string_view name) {
    size_t digits = name.size();
    while (digits > 0 && name[digits - 1] >= '0' && name[digits - 1] <= '9')
        --digits;
    uint64_t number = 0;
    for (size_t i = digits; i < name.size() && i < digits + 18; ++i)
        number = number * 10 + static_cast<uint64_t>(name[i] - '0');
    return {foldName(name.substr(0, digits)), number};
}

} // namespace

void sortTargets(const RefactorPlace& place, Refactorings& out) {
    const Module* module = place.scope.around().module;
    const auto* here = place.innermost<DataDecl>(NodeKind::Data);
    if (!module || !module->decl || !here || place.scope.around().routineDecl || !isPoint(place.tree, *here))
        return;
    // The declarations on the lines around this one, one a line, without a gap.
    struct Line {
        SourceRange range;
        std::string_view name;
    };
    std::vector<Line> block;
    bool found = false;
    for (const Decl* decl : module->decl->decls) {
        const bool point = isPoint(place.tree, *decl);
        SourceRange line = point ? wholeLine(place, *decl) : SourceRange{};
        const bool alone =
            point && line != place.tree.range(*decl) && line.end > 0 &&
            std::string_view("\r\n").find(place.file.text()[line.end - 1]) != std::string_view::npos;
        if (!alone || (!block.empty() && block.back().range.end != line.begin)) {
            if (found) break;
            block.clear();
        }
        if (!alone) continue;
        block.push_back({line, place.tree.text(as<DataDecl>(*decl).name)});
        found = found || decl == here;
    }
    if (!found || block.size() < 2) return;
    std::vector<Line> sorted = block;
    std::sort(sorted.begin(), sorted.end(), [](const Line& a, const Line& b) {
        return std::pair(naturalKey(a.name), a.range.begin) < std::pair(naturalKey(b.name), b.range.begin);
    });
    std::string text;
    bool changed = false;
    for (size_t i = 0; i < block.size(); ++i) {
        text += place.text(sorted[i].range);
        changed = changed || sorted[i].range != block[i].range;
    }
    if (!changed) return;
    Refactoring refactoring;
    refactoring.title = fmt::format("Sort {} targets by name", block.size());
    refactoring.id = "sort-targets";
    refactoring.kind = RefactoringKind::Organize;
    refactoring.edits.push_back({{block.front().range.begin, block.back().range.end}, std::move(text)});
    out.push_back(std::move(refactoring));
}

} // namespace rapid::query
