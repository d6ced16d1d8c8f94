// Handlers that a routine does not have yet: BACKWARD, ERROR, UNDO, in this order (manual 1.12, 1.13).

#include "frontend/query/refactor_parts.h"

#include <fmt/format.h>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

/// Before the line of a token.
InsertPlace linesBefore(const RefactorPlace& place, TokenIndex token) {
    InsertPlace where;
    const std::string_view text = place.file.text();
    const uint32_t offset = place.tree.tokens[token].offset;
    where.indent = indentAt(text, offset);
    const size_t line = offset == 0 ? std::string_view::npos : text.find_last_of("\r\n", offset - 1);
    const size_t begin = line == std::string_view::npos ? 0 : line + 1;
    if (text.substr(begin, offset - begin).find_first_not_of(" \t") != std::string_view::npos) return where;
    where.offset = static_cast<uint32_t>(begin);
    where.eol = text.find("\r\n") != std::string_view::npos ? "\r\n" : "\n";
    where.lineBefore = false;
    where.usable = true;
    return where;
}

/// The first token of the kind at the level of the routine, from its body on; the end word when there is none.
TokenIndex handlerToken(const SyntaxTree& tree, const RoutineDecl& routine, TokenKind kind) {
    for (TokenIndex t = routine.name + 1; t < routine.last; ++t)
        if (tree.tokens[t].kind == kind) return t;
    return routine.last;
}

} // namespace

void addHandlers(const RefactorPlace& place, Refactorings& out) {
    const RoutineDecl* routine = place.scope.around().routineDecl;
    const Module* module = place.scope.around().module;
    if (!routine || !module || routine->name == kNoToken || routine->first == kNoToken ||
        routine->last <= routine->name)
        return;
    // All of them on the header; elsewhere in the routine that for errors only, so that they do not disturb.
    const SourceRange header = {place.tree.range(routine->first).begin, place.tree.range(routine->name).end};
    const uint32_t at = place.selection.begin;
    if (at < header.begin || at > place.tree.range(routine->last).end) return;
    const bool onHeader = at <= header.end;
    const TokenKind end = place.tree.tokens[routine->last].kind;
    if (end != TokenKind::KwEndproc && end != TokenKind::KwEndfunc && end != TokenKind::KwEndtrap) return;
    const TokenIndex undo =
        routine->hasUndo ? handlerToken(place.tree, *routine, TokenKind::KwUndo) : routine->last;
    const TokenIndex error = routine->errors.empty() ? undo : routine->errors.front()->first;
    const std::string unit = indentUnit(place.file, *module);
    const auto offer = [&](std::string_view word, TokenIndex before, std::string_view body) {
        const InsertPlace where = linesBefore(place, before);
        if (!where.usable) return;
        Refactoring refactoring;
        refactoring.title = fmt::format("Add {} handler", word);
        refactoring.id = "add-handler";
        refactoring.edits.push_back(where.edit(fmt::format("{}\n{}{}", word, unit, body)));
        out.push_back(std::move(refactoring));
    };
    if (routine->errors.empty()) offer("ERROR", undo, "RAISE;");
    if (!onHeader) return;
    if (!routine->hasUndo) offer("UNDO", routine->last, "! executed when the routine is left before its end");
    if (!routine->hasBackward && routine->routineKind == RoutineKind::Proc)
        offer("BACKWARD", error, "! executed instead of the body in backward execution");
}

} // namespace rapid::query
