#include "frontend/format/same_meaning.h"

#include "frontend/format/atoms.h"
#include "frontend/syntax/token_set.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapid::format {

using namespace rapid::syntax;

namespace {

std::string_view textOf(const SyntaxTree& tree, const Atom& atom) {
    return tree.source->text().substr(atom.begin, atom.end - atom.begin);
}

bool equalsAnyCase(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](char x, char y) { return lower(x) == lower(y); });
}

bool sameToken(const SyntaxTree& a, const SyntaxTree& b, TokenIndex t) {
    const TokenKind kind = a.tokens[t].kind;
    if (kind != b.tokens[t].kind) return false;
    const bool word = kind == TokenKind::Identifier || isKeyword(kind) || isPlaceholder(kind);
    return word ? equalsAnyCase(a.text(t), b.text(t)) : a.text(t) == b.text(t);
}

bool sameNode(const Node& a, const Node& b) {
    if (a.kind != b.kind || a.first != b.first || a.last != b.last) return false;
    std::vector<const Node*> left, right;
    forEachChild(a, [&](const Node& child) { left.push_back(&child); });
    forEachChild(b, [&](const Node& child) { right.push_back(&child); });
    return std::equal(left.begin(), left.end(), right.begin(), right.end(),
                      [](const Node* x, const Node* y) { return sameNode(*x, *y); });
}

std::string differsAt(const SyntaxTree& before, const Atom& atom) {
    return fmt::format("line {} would change", before.source->lineColumn(atom.begin).line);
}

} // namespace

std::string findDifference(const SyntaxTree& before, const SyntaxTree& after, bool nodes) {
    const auto old = collectAtoms(before, 1), now = collectAtoms(after, 1);
    for (size_t i = 0; i < std::min(old.size(), now.size()); ++i) {
        const bool same = old[i].isComment == now[i].isComment && old[i].token == now[i].token &&
                          (old[i].isComment ? textOf(before, old[i]) == textOf(after, now[i])
                                            : sameToken(before, after, old[i].token));
        if (!same) return differsAt(before, old[i]);
    }
    if (old.size() != now.size()) return "the end would change";
    if (!nodes) return {};
    if (before.modules.size() != after.modules.size()) return "the modules would change";
    for (size_t i = 0; i < before.modules.size(); ++i)
        if (!sameNode(*before.modules[i], *after.modules[i])) return "the structure would change";
    return {};
}

} // namespace rapid::format
