#include "frontend/query/structure.h"

#include <algorithm>
#include <set>

namespace rapid::query {

using namespace syntax;

namespace {

class Folder {
  public:
    Folder(const FileView& file, const Cancel* cancel) : file_(file), tree_(*file.tree), cancel_(cancel) {}

    std::vector<FoldingRange> run() {
        for (const ModuleDecl* module : tree_.modules)
            node(*module);
        comments();
        std::sort(out_.begin(), out_.end(), [](const FoldingRange& a, const FoldingRange& b) {
            return a.firstLine != b.firstLine ? a.firstLine < b.firstLine : a.lastLine > b.lastLine;
        });
        return std::move(out_);
    }

  private:
    uint32_t lineOf(uint32_t offset) const { return file_.source().lineColumn(offset).line; }
    void add(uint32_t first, uint32_t last, bool comment = false) {
        if (last > first && seen_.insert({first, last}).second) out_.push_back({first, last, comment});
    }
    /// Up to the line before the last token: ENDPROC, ENDIF.
    void untilEnd(const Node& n) {
        if (n.first == kNoToken || n.first >= n.last) return;
        const SourceRange range = tree_.range(n);
        const uint32_t last = lineOf(tree_.tokens[n.last].offset);
        if (range.end > range.begin && last > 1) add(lineOf(range.begin), last - 1);
    }
    void untilLast(uint32_t firstLine, StmtList body) {
        if (body.empty() || body.back()->first == kNoToken || body.back()->first > body.back()->last) return;
        add(firstLine, lineOf(tree_.range(*body.back()).end));
    }
    /// A part that begins with a word before its first instruction: ELSE, DEFAULT, UNDO.
    void part(StmtList body, TokenKind word) {
        if (body.empty() || body.front()->first == kNoToken) return;
        for (TokenIndex t = body.front()->first; t-- > 0 && t + 4 > body.front()->first;)
            if (tree_.tokens[t].kind == word) return untilLast(lineOf(tree_.tokens[t].offset), body);
    }
    uint32_t firstLine(const Node& n) const {
        return n.first == kNoToken ? 1 : lineOf(tree_.tokens[n.first].offset);
    }

    void node(const Node& n) {
        if (isCancelled(cancel_)) return;
        switch (n.kind) {
        case NodeKind::Module:
        case NodeKind::Record:
        case NodeKind::For:
        case NodeKind::While:
        case NodeKind::Aggregate: untilEnd(n); break;
        case NodeKind::Routine: {
            const auto& routine = as<RoutineDecl>(n);
            untilEnd(n);
            part(routine.backward, TokenKind::KwBackward);
            part(routine.undo, TokenKind::KwUndo);
            break;
        }
        case NodeKind::If:
            untilEnd(n);
            part(as<IfStmt>(n).elseBody, TokenKind::KwElse);
            break;
        case NodeKind::Test:
            untilEnd(n);
            part(as<TestStmt>(n).defaultBody, TokenKind::KwDefault);
            break;
        case NodeKind::IfBranch: untilLast(firstLine(n), as<IfBranch>(n).body); break;
        case NodeKind::TestCase: untilLast(firstLine(n), as<TestCase>(n).body); break;
        case NodeKind::ErrorClause: untilLast(firstLine(n), as<ErrorClause>(n).body); break;
        default: break;
        }
        forEachNode(n, [this](const Node& child) { node(child); });
    }

    /// Lines that hold nothing but a comment, two or more in a row.
    void comments() {
        const uint32_t count = file_.source().lineCount();
        uint32_t begin = 0;
        for (uint32_t line = 1; line <= count + 1; ++line) {
            bool comment = false;
            if (line <= count) {
                const std::string_view text = file_.source().lineText(line);
                const size_t at = text.find_first_not_of(" \t");
                comment = at != std::string_view::npos && text[at] == '!';
            }
            if (comment && begin == 0) begin = line;
            if (comment || begin == 0) continue;
            add(begin, line - 1, true);
            begin = 0;
        }
    }

    const FileView& file_;
    const SyntaxTree& tree_;
    const Cancel* cancel_;
    std::vector<FoldingRange> out_;
    std::set<std::pair<uint32_t, uint32_t>> seen_;
};

} // namespace

std::vector<FoldingRange> foldingRanges(const FileView& file, const Cancel* cancel) {
    return Folder(file, cancel).run();
}

std::vector<SourceRange> selectionRanges(const FileView& file, uint32_t offset) {
    const auto size = static_cast<uint32_t>(file.text().size());
    offset = std::min(offset, size);
    std::vector<SourceRange> inwards = {{0, size}};
    const auto add = [&](SourceRange range) {
        const SourceRange outer = inwards.back();
        if (range.begin >= outer.begin && range.end <= outer.end && range != outer && range.begin <= offset &&
            offset <= range.end)
            inwards.push_back(range);
    };
    for (const Node* node : nodesAt(file, offset))
        add(file.tree->range(*node));
    if (const TokenIndex token = tokenAt(file, offset); token != kNoToken) {
        const SourceRange range = file.tree->range(token);
        add(range);
        if (file.tree->tokens[token].kind == TokenKind::StringLiteral && range.end > range.begin + 2)
            add({range.begin + 1, range.end - 1});
    }
    if (inwards.back().begin == inwards.back().end && inwards.size() > 1) inwards.pop_back();
    return {inwards.rbegin(), inwards.rend()};
}

} // namespace rapid::query
