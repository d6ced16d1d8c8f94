// Tokens of a changed file from those of its earlier version (lexer.h). No token but the file header spans a line end, and
// nothing that a line holds depends on other lines but `%%%` after ENDMODULE.

#include "frontend/source/same_ends.h"
#include "frontend/syntax/lexer.h"

#include <algorithm>

namespace rapid::syntax {

namespace {

/// Two texts begin and end with the same lines: `from` bytes, and those from `oldTo` and `newTo` on.
struct Change {
    size_t from = 0;
    size_t oldTo = 0;
    size_t newTo = 0;
};

Change findChange(std::string_view before, std::string_view now) {
    auto [head, tail] = sameEnds(before, now);
    while (head > 0 && now[head - 1] != '\n')
        --head;
    size_t end = now.size() - tail;
    while (end < now.size() && now[end] != '\n')
        ++end;
    end = std::min(end + 1, now.size());
    return {head, before.size() - (now.size() - end), end};
}

} // namespace

bool relex(SyntaxTree& tree, const SyntaxTree& earlier, LexResult& lexed) {
    if (earlier.retagged) return false;
    const std::string_view before = earlier.source->text(), now = tree.source->text();
    const Change change = findChange(before, now);
    const auto startsBefore = [](const Token& token, size_t offset) { return token.offset < offset; };
    const std::span<Token> old = earlier.tokens;
    const auto headEnd = std::lower_bound(old.begin(), old.end(), change.from, startsBefore);
    const auto tailBegin = std::lower_bound(headEnd, old.end(), change.oldTo, startsBefore);
    if (headEnd == old.begin() || tailBegin == old.end()) return false;
    const Token& lastKept = *std::prev(headEnd);
    if (lastKept.offset + lastKept.length > change.from) return false;
    if (tailBegin != headEnd && std::prev(tailBegin)->offset + std::prev(tailBegin)->length > change.oldTo)
        return false;
    if (now.substr(tailBegin->offset + (change.newTo - change.oldTo)).starts_with("%%%")) return false;

    LexResult part = lexPart(now, change.from, change.newTo, lastKept.kind);
    const std::vector<Token>& fresh = part.tokens;
    if (!fresh.empty() && fresh.back().kind != TokenKind::EndOfFile &&
        fresh.back().offset + fresh.back().length > change.newTo)
        return false;
    const bool ended = !fresh.empty() && fresh.back().kind == TokenKind::EndOfFile;
    const auto head = static_cast<size_t>(headEnd - old.begin());
    const size_t tail = ended ? 0 : static_cast<size_t>(old.end() - tailBegin);
    tree.tokens = tree.arena.makeArray<Token>(head + fresh.size() + tail);
    auto to = std::copy(old.begin(), headEnd, tree.tokens.begin());
    to = std::copy(fresh.begin(), fresh.end(), to);
    const auto shift = static_cast<uint32_t>(change.newTo - change.oldTo); // modulo 2^32
    std::transform(tailBegin, tailBegin + static_cast<std::ptrdiff_t>(tail), to, [shift](Token token) {
        token.offset += shift;
        return token;
    });
    lexed.errors = std::move(part.errors);
    lexed.hasModule = std::any_of(tree.tokens.begin(), tree.tokens.end(),
                                  [](const Token& token) { return token.kind == TokenKind::KwModule; });
    return true;
}

} // namespace rapid::syntax
