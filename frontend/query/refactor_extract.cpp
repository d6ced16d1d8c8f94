// Instructions become a procedure of their own.

#include "frontend/query/name_walk.h"
#include "frontend/query/refactor_parts.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

/// Lists of instructions within a node.
void listsOf(const Node& node, const std::function<void(StmtList)>& visit) {
    switch (node.kind) {
    case NodeKind::Routine: {
        const auto& routine = as<RoutineDecl>(node);
        visit(routine.body);
        visit(routine.backward);
        visit(routine.undo);
        break;
    }
    case NodeKind::ErrorClause: visit(as<ErrorClause>(node).body); break;
    case NodeKind::If: visit(as<IfStmt>(node).elseBody); break;
    case NodeKind::IfBranch: visit(as<IfBranch>(node).body); break;
    case NodeKind::For: visit(as<ForStmt>(node).body); break;
    case NodeKind::While: visit(as<WhileStmt>(node).body); break;
    case NodeKind::Test: visit(as<TestStmt>(node).defaultBody); break;
    case NodeKind::TestCase: visit(as<TestCase>(node).body); break;
    default: break;
    }
}

/// The instructions that the selection covers, all of one list.
std::vector<const Stmt*> selected(const RefactorPlace& place) {
    SourceRange range = place.selection;
    const std::string_view text = place.file.text();
    const auto blank = [&](uint32_t at) {
        return std::string_view(" \t\r\n").find(text[at]) != std::string_view::npos;
    };
    while (range.begin < range.end && blank(range.begin))
        ++range.begin;
    while (range.end > range.begin && blank(range.end - 1))
        --range.end;
    std::vector<const Stmt*> found;
    if (range.begin >= range.end) return found;
    const TokenIndex first = tokenFrom(place.file, range.begin), last = tokenBefore(place.file, range.end);
    const auto nodes = nodesAt(place.file, range.begin);
    for (size_t i = nodes.size(); i-- > 0 && found.empty();)
        listsOf(*nodes[i], [&](StmtList list) {
            std::vector<const Stmt*> inside;
            for (const Stmt* stmt : list)
                if (stmt->first != kNoToken && stmt->first <= stmt->last && stmt->first >= first &&
                    stmt->last <= last)
                    inside.push_back(stmt);
            // Nothing else is selected, apart from the last ';'.
            if (!inside.empty() && inside.front()->first == first && inside.back()->last + 1 >= last)
                found = inside;
        });
    return found;
}

/// What the instructions take from the routine around them.
class Needs {
  public:
    Needs(const RefactorPlace& place, const std::vector<const Stmt*>& stmts) : place_(place), stmts_(stmts) {
        for (const Stmt* stmt : stmts)
            visit(*stmt);
        if (possible_) gather();
    }
    bool possible() const { return possible_; }
    std::string parameters() const {
        std::string text;
        for (const auto& [data, written] : inOrder()) {
            const bool persistent = data->storage == Storage::Parameter ? data->mode == ParamMode::Pers
                                                                        : data->dataKind == DataKind::Pers;
            text += (text.empty() ? "" : ",") + newParameter(data->type, data->name,
                                                             persistent ? "PERS "
                                                             : written  ? "INOUT "
                                                                        : "");
        }
        return text;
    }
    std::string arguments() const {
        std::string text;
        for (const auto& [data, written] : inOrder())
            text += (text.empty() ? "" : ",") + data->name;
        return text;
    }

  private:
    void visit(const Node& node) {
        switch (node.kind) {
        case NodeKind::Return:
        case NodeKind::Label:
        case NodeKind::Goto:
        case NodeKind::Retry:
        case NodeKind::TryNext:
        case NodeKind::DeclStmt:
        case NodeKind::ErrorStmt:
        case NodeKind::ErrorExpr: possible_ = false; break;
        case NodeKind::Raise: possible_ = possible_ && as<RaiseStmt>(node).value; break;
        default: possible_ = possible_ && !node.broken; break;
        }
        forEachNode(node, [this](const Node& child) { visit(child); });
    }

    void gather() {
        for (const Stmt* stmt : stmts_)
            for (TokenIndex t = stmt->first; t <= stmt->last; ++t) {
                if (place_.tree.tokens[t].kind != TokenKind::Identifier) continue;
                const Meaning meaning = meaningOf(place_.snapshot, place_.file, t);
                const DataSymbol* data = dataOf(meaning.symbol);
                if (!data || data->routine != place_.scope.around().routine || !data->routine) continue;
                if (isDeclaredInside(*data)) continue;
                if (data->storage == Storage::Parameter && isArgumentName(t)) continue;
                // Whether an optional argument is there is known in its own routine only.
                if (data->optional || data->isSwitch || !data->type.type) possible_ = false;
                bool& written = needs_[data->nameToken].second;
                needs_[data->nameToken].first = data;
                written = written || meaning.access == Access::Write || meaning.access == Access::ReadWrite;
            }
    }
    bool isDeclaredInside(const DataSymbol& data) const {
        return std::any_of(stmts_.begin(), stmts_.end(), [&](const Stmt* stmt) {
            return data.nameToken >= stmt->first && data.nameToken <= stmt->last;
        });
    }
    bool isArgumentName(TokenIndex t) const {
        return t > 0 && place_.tree.tokens[t - 1].kind == TokenKind::Backslash;
    }
    std::vector<std::pair<const DataSymbol*, bool>> inOrder() const {
        std::vector<std::pair<const DataSymbol*, bool>> all;
        for (const auto& [token, need] : needs_)
            all.push_back(need);
        return all;
    }

    const RefactorPlace& place_;
    const std::vector<const Stmt*>& stmts_;
    bool possible_ = true;
    std::map<TokenIndex, std::pair<const DataSymbol*, bool>>
        needs_; ///< by declaration: data and whether it is written
};

/// The lines of the instructions with another indentation.
std::string moved(std::string_view text, std::string_view from, std::string_view to, std::string_view eol) {
    std::string out;
    bool first = true;
    while (true) {
        const size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (!first && line.starts_with(from)) line.remove_prefix(from.size());
        out += (first ? std::string() : std::string(eol)) +
               (line.empty() ? "" : std::string(to) + std::string(line));
        first = false;
        if (end == std::string_view::npos) return out;
        text.remove_prefix(end + 1);
    }
}

} // namespace

void extractRoutine(const RefactorPlace& place, Refactorings& out) {
    const RoutineDecl* around = place.scope.around().routineDecl;
    const Module* module = place.scope.around().module;
    if (!around || !module || place.selection.begin == place.selection.end || !place.scope.around().routine)
        return;
    const std::vector<const Stmt*> stmts = selected(place);
    if (stmts.empty()) return;
    const Needs needs(place, stmts);
    const InsertPlace where = afterRoutine(place.file, *around);
    if (!needs.possible() || !where.usable) return;
    SourceRange range = {place.tree.range(*stmts.front()).begin, place.tree.range(*stmts.back()).end};
    const TokenIndex next = stmts.back()->last + 1;
    if (next < place.tree.tokens.size() && place.tree.tokens[next].kind == TokenKind::Semicolon &&
        place.tree.tokens[stmts.back()->last].kind != TokenKind::Semicolon)
        range.end = place.tree.range(next).end;
    const std::string name = freeName(place.scope, "extracted");
    const std::string from = indentAt(place.file.text(), range.begin);
    const std::string body = where.indent + indentUnit(place.file, *module);
    const std::string arguments = needs.arguments();
    Refactoring refactoring;
    refactoring.title = "Extract procedure";
    refactoring.id = "extract-routine";
    refactoring.kind = RefactoringKind::Extract;
    refactoring.edits.push_back({range, name + (arguments.empty() ? "" : " " + arguments) + ";"});
    TextEdit routine = where.edit(fmt::format("\nPROC {}({})", name, needs.parameters()));
    routine.replacement +=
        where.eol + moved(place.text(range), from, body, where.eol) + where.eol + where.indent + "ENDPROC";
    refactoring.edits.push_back(std::move(routine));
    refactoring.name = {range.begin, range.begin + static_cast<uint32_t>(name.size())};
    out.push_back(std::move(refactoring));
}

} // namespace rapid::query
