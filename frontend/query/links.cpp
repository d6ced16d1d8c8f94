#include "frontend/query/links.h"

#include "frontend/sema/names.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

/// The literal that a parameter gets; null: none, or something that is known at run time only.
const Expr* literalFor(const BoundCall& call, std::string_view parameter) {
    for (const BoundArg& arg : call.args)
        if (arg.param && arg.value && foldName(arg.param->name) == parameter) {
            const Expr& value = bare(*arg.value);
            return value.kind == NodeKind::StringLiteral ? &value : nullptr;
        }
    return nullptr;
}

std::string textOf(const SyntaxTree& tree, const Expr& literal) {
    std::string text = decodeStringLiteral(tree.text(literal.first));
    std::replace(text.begin(), text.end(), '\\', '/');
    return text;
}

void addLink(const SyntaxTree& tree, const BoundCall& call, std::string_view pathName,
             std::string_view fileName, std::vector<FileLink>& links) {
    const Expr *path = literalFor(call, pathName), *name = literalFor(call, fileName);
    if (!path) return;
    std::string whole = textOf(tree, *path);
    if (name) {
        if (!whole.empty() && whole.back() != '/') whole += '/';
        whole += textOf(tree, *name);
    }
    if (whole.empty() || whole.back() == '/') return;
    const SourceRange range = tree.range(name ? name->first : path->first);
    links.push_back({{range.begin + 1, std::max(range.begin + 1, range.end - 1)}, std::move(whole)});
}

} // namespace

std::vector<FileLink> documentLinks(const FileView& file, const Cancel* cancel) {
    std::vector<FileLink> links;
    const auto all = SourceRange{0, static_cast<uint32_t>(file.text().size())};
    forEachNodeOf(
        file, all,
        [&](const Module&, const RoutineSymbol*, const Node& node) {
            if (node.kind != NodeKind::CallStmt) return;
            const BoundCall* call = boundCallOf(file, node);
            if (!call || !call->routine || !call->routine->predefined) return;
            addLink(*file.tree, *call, "filepath", "file", links);
            addLink(*file.tree, *call, "unloadpath", "unloadfile", links);
        },
        cancel);
    return links;
}

std::vector<FileLink> programFileLinks(std::string_view text) {
    std::vector<FileLink> links;
    const std::string folded = foldName(text);
    constexpr std::string_view kOpen = "<module>", kClose = "</module>", kBegin = "<!--", kEnd = "-->";
    size_t at = 0;
    while (at < text.size()) {
        const size_t comment = folded.find(kBegin, at), open = folded.find(kOpen, at);
        if (open == std::string::npos) break;
        if (comment < open) {
            const size_t end = folded.find(kEnd, comment);
            at = end == std::string::npos ? text.size() : end + kEnd.size();
            continue;
        }
        size_t begin = open + kOpen.size();
        size_t end = folded.find(kClose, begin);
        if (end == std::string::npos) break;
        at = end + kClose.size();
        constexpr std::string_view kBlanks = " \t\r\n";
        while (begin < end && kBlanks.find(text[begin]) != std::string_view::npos)
            ++begin;
        while (end > begin && kBlanks.find(text[end - 1]) != std::string_view::npos)
            --end;
        std::string path(text.substr(begin, end - begin));
        std::replace(path.begin(), path.end(), '\\', '/');
        links.push_back({{static_cast<uint32_t>(begin), static_cast<uint32_t>(end)}, std::move(path)});
    }
    return links;
}

} // namespace rapid::query
