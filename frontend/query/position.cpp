#include "frontend/query/position.h"

#include "frontend/syntax/token_set.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>

namespace rapid::query {

using namespace syntax;

uint32_t tokenCountOf(const FileView& file) {
    if (file.tokenCount == 0) {
        const auto tokens = file.tree->tokens;
        const auto end = std::find_if(tokens.begin(), tokens.end(),
                                      [](const Token& t) { return t.kind == TokenKind::EndOfFile; });
        file.tokenCount = static_cast<uint32_t>(end - tokens.begin()) + (end == tokens.end() ? 0 : 1);
    }
    return file.tokenCount;
}

TokenIndex tokenFrom(const FileView& file, uint32_t offset) {
    const auto tokens = file.tree->tokens.first(tokenCountOf(file));
    const auto found = std::lower_bound(tokens.begin(), tokens.end(), offset,
                                        [](const Token& t, uint32_t at) { return t.offset < at; });
    const auto index = static_cast<uint32_t>(found - tokens.begin());
    return index < tokens.size() ? index
           : tokens.empty()      ? kNoToken
                                 : static_cast<uint32_t>(tokens.size()) - 1;
}

TokenIndex tokenBefore(const FileView& file, uint32_t offset) {
    const auto tokens = file.tree->tokens.first(tokenCountOf(file));
    const auto found = std::lower_bound(tokens.begin(), tokens.end(), offset,
                                        [](const Token& t, uint32_t at) { return t.offset < at; });
    return found == tokens.begin() ? kNoToken : static_cast<uint32_t>(found - tokens.begin()) - 1;
}

bool isWord(TokenKind kind) {
    return kind == TokenKind::Identifier || isKeyword(kind);
}

TokenIndex tokenAt(const FileView& file, uint32_t offset) {
    const auto covers = [&](TokenIndex t, bool end) {
        if (t == kNoToken) return false;
        const Token& token = file.tree->tokens[t];
        if (token.kind == TokenKind::EndOfFile) return false;
        return token.offset <= offset &&
               (offset < token.offset + token.length || (end && offset == token.offset + token.length));
    };
    const TokenIndex after = tokenBefore(file, offset + 1); // begins at the offset or before it
    const TokenIndex before = tokenBefore(file, offset);
    if (covers(after, false) && isWord(file.tree->tokens[after].kind)) return after;
    if (covers(before, true) && isWord(file.tree->tokens[before].kind)) return before;
    if (covers(after, false)) return after;
    return covers(before, true) ? before : kNoToken;
}

TokenIndex wordAt(const FileView& file, uint32_t offset) {
    const TokenIndex token = tokenAt(file, offset);
    return token != kNoToken && isWord(file.tree->tokens[token].kind) ? token : kNoToken;
}

bool isInString(const FileView& file, uint32_t offset) {
    const TokenIndex token = tokenBefore(file, offset);
    if (token == kNoToken) return false;
    const Token& t = file.tree->tokens[token];
    const uint32_t end = t.offset + t.length;
    if (t.kind == TokenKind::StringLiteral) return offset < end;
    // A string that is not closed is an unreadable token up to the end of the line.
    return t.kind == TokenKind::Error && offset <= end && file.text()[t.offset] == '"';
}

bool isInComment(const FileView& file, uint32_t offset) {
    const std::string_view text = file.text();
    offset = std::min(offset, static_cast<uint32_t>(text.size()));
    const TokenIndex token = tokenBefore(file, offset);
    uint32_t from = 0;
    if (token != kNoToken) from = file.tree->tokens[token].offset + file.tree->tokens[token].length;
    if (from > offset) return false;
    const std::string_view gap = text.substr(from, offset - from);
    const size_t mark =
        gap.find('!', gap.find_last_of("\r\n") == std::string_view::npos ? 0 : gap.find_last_of("\r\n"));
    return mark != std::string_view::npos;
}

namespace {

bool contains(const SyntaxTree& tree, const Node& node, uint32_t offset) {
    if (node.first == kNoToken || node.first > node.last) return false;
    const SourceRange range = tree.range(node);
    return range.begin <= offset && offset <= range.end;
}

/// The end word of a routine is there.
bool hasEnd(const SyntaxTree& tree, const Decl& routine) {
    if (routine.last >= tree.tokens.size() || routine.last <= routine.first) return false;
    const TokenKind end = tree.tokens[routine.last].kind;
    return end == TokenKind::KwEndproc || end == TokenKind::KwEndfunc || end == TokenKind::KwEndtrap;
}

} // namespace

void forEachNode(const Node& node, const std::function<void(const Node&)>& visit) {
    if (node.kind == NodeKind::Aggregate && static_cast<const AggregateExpr&>(node).isPlain()) return;
    forEachChild(node, visit);
}

namespace {

/// The declarations of a module that may contain the offset: those that begin before it, the last two.
std::span<Decl* const> declsNear(const SyntaxTree& tree, const ModuleDecl& module, uint32_t offset) {
    const std::span<Decl* const> decls = module.decls;
    const auto end = std::partition_point(decls.begin(), decls.end(), [&](const Decl* decl) {
        return decl->first != kNoToken && tree.tokens[decl->first].offset <= offset;
    });
    const auto count = static_cast<size_t>(end - decls.begin());
    const size_t from = count < 2 ? 0 : count - 2;
    return decls.subspan(from, count - from);
}

} // namespace

std::vector<const Node*> nodesAt(const FileView& file, uint32_t offset) {
    std::vector<const Node*> path;
    const Node* node = nullptr;
    for (const ModuleDecl* module : file.tree->modules)
        if (contains(*file.tree, *module, offset)) node = module;
    while (node) {
        path.push_back(node);
        const Node* inner = nullptr;
        const auto consider = [&](const Node& child) {
            if (!contains(*file.tree, child, offset)) return;
            // Two nodes that touch: the one that begins here, unless it is the end of a name that is wanted.
            if (!inner || file.tree->range(child).begin == offset ||
                file.tree->range(*inner).end < file.tree->range(child).end)
                inner = &child;
        };
        if (node->kind == NodeKind::Module) {
            for (const Decl* decl : declsNear(*file.tree, as<ModuleDecl>(*node), offset))
                consider(*decl);
        } else {
            forEachNode(*node, consider);
        }
        node = inner;
    }
    return path;
}

Surroundings surroundings(const FileView& file, uint32_t offset) {
    Surroundings found;
    const SyntaxTree& tree = *file.tree;
    for (const sema::Module* module : file.modules)
        if (module->decl && (contains(tree, *module->decl, offset) ||
                             (tree.modules.size() == 1 && offset > tree.range(*module->decl).begin)))
            found.module = module;
    if (!found.module) {
        if (file.modules.size() == 1 && !file.modules.front()->decl) found.module = file.modules.front();
        return found;
    }
    for (const Decl* decl : declsNear(tree, *found.module->decl, offset)) {
        if (decl->first == kNoToken || tree.tokens[decl->first].offset >= offset) continue;
        found.routineDecl = nullptr; // the one before ends where this one begins
        if (decl->kind != NodeKind::Routine) continue;
        // The end of ENDPROC is outside of the routine; without it the routine is still being written.
        if (offset < tree.range(*decl).end || !hasEnd(tree, *decl))
            found.routineDecl = &as<RoutineDecl>(*decl);
    }
    if (found.routineDecl)
        for (const sema::RoutineSymbol* routine : found.module->routines)
            if (routine->routineDecl == found.routineDecl) found.routine = routine;
    return found;
}

Location locationOf(const Snapshot& snapshot, const sema::Symbol& symbol) {
    Location place;
    if (!symbol.module || symbol.nameToken == kNoToken || !symbol.decl) return place;
    const SyntaxTree& tree = *symbol.module->tree;
    if (symbol.nameToken >= tree.tokens.size()) return place;
    place.file = tree.source;
    place.range = tree.range(symbol.nameToken);
    place.whole = tree.range(*symbol.decl);
    if (place.whole.begin > place.range.begin || place.whole.end < place.range.end) place.whole = place.range;
    const FileView* file = snapshot.fileOf(*symbol.module);
    place.isLibrary = file && file->isLibrary();
    return place;
}

} // namespace rapid::query
