#include "frontend/format/same_meaning.h"

#include "config/letter_case.h"
#include "frontend/format/atoms.h"
#include "frontend/syntax/token_set.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>

namespace rapid::format {

using namespace rapid::syntax;

namespace {

std::string_view textOf(const SyntaxTree& tree, const Atom& atom) {
    return tree.source->text().substr(atom.begin, atom.end - atom.begin);
}

bool sameToken(const SyntaxTree& a, const SyntaxTree& b, TokenIndex t) {
    const TokenKind kind = a.tokens[t].kind;
    if (kind != b.tokens[t].kind) return false;
    const bool word = kind == TokenKind::Identifier || isKeyword(kind) || isPlaceholder(kind);
    return word ? config::sameName(a.text(t), b.text(t)) : a.text(t) == b.text(t);
}

/// The innermost node that differs; null when none does.
const Node* differingNode(const Node& a, const Node& b) {
    if (a.kind != b.kind || a.first != b.first || a.last != b.last) return &a;
    std::vector<const Node*> left, right;
    forEachChild(a, [&](const Node& child) { left.push_back(&child); });
    forEachChild(b, [&](const Node& child) { right.push_back(&child); });
    if (left.size() != right.size()) return &a;
    for (size_t i = 0; i < left.size(); ++i)
        if (const Node* found = differingNode(*left[i], *right[i])) return found;
    return nullptr;
}

SourceRange rangeOf(const SyntaxTree& tree, const Node& node) {
    return node.first <= node.last ? tree.range(node) : tree.range(node.first);
}

} // namespace

std::optional<SourceRange> findDifference(const SyntaxTree& before, const SyntaxTree& after, bool nodes) {
    const auto old = collectAtoms(before, 1), now = collectAtoms(after, 1);
    for (size_t i = 0; i < std::min(old.size(), now.size()); ++i) {
        const bool same = old[i].isComment == now[i].isComment && old[i].token == now[i].token &&
                          (old[i].isComment ? textOf(before, old[i]) == textOf(after, now[i])
                                            : sameToken(before, after, old[i].token));
        if (!same) return SourceRange{old[i].begin, old[i].end};
    }
    const auto size = static_cast<uint32_t>(before.source->text().size());
    if (old.size() != now.size()) return SourceRange{size, size};
    if (!nodes) return {};
    if (before.modules.size() != after.modules.size()) return SourceRange{0, size};
    for (size_t i = 0; i < before.modules.size(); ++i)
        if (const Node* node = differingNode(*before.modules[i], *after.modules[i]))
            return rangeOf(before, *node);
    return {};
}

} // namespace rapid::format
