// Labels and jumps of a routine (manual 1.21).

#include "frontend/sema/jumps.h"

#include "frontend/diag/messages/flow.h"
#include "frontend/diag/messages/names.h"
#include "frontend/diag/messages/syntax.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/wording.h"
#include "frontend/syntax/token_set.h"

namespace rapid::sema {

using namespace syntax;

Jumps::Jumps(State& state, const Parts& parts) : CheckerPart(state), scopes_(parts.scopes) {}

bool Jumps::isInside(uint32_t inner, uint32_t outer) const {
    while (inner != outer && inner != kNoBlock)
        inner = routine_.blockParents[inner];
    return inner == outer;
}

uint32_t Jumps::lineEnd(uint32_t from) const {
    const std::string_view source = context_.tree->source->text();
    return static_cast<uint32_t>(std::min(source.find_first_of("\r\n", from), source.size()));
}

// "n: n + 1;": a value follows the colon in the same line, not an instruction.
bool Jumps::valueFollows(const LabelStmt& s) {
    const auto& tokens = context_.tree->tokens;
    const TokenIndex next = s.last + 1;
    if (next + 1 >= tokens.size() || tokens[next].kind != TokenKind::Identifier) return false;
    const uint32_t after = range(s.last).end;
    const std::string_view between = context_.tree->source->text().substr(after, tokens[next].offset - after);
    if (between.find_first_of("\r\n") != std::string_view::npos) return false;
    const RoutineSymbol* routine = asRoutine(scopes_.lookup(idOf(next)));
    if (!scopes_.lookup(idOf(next)) || (routine && routine->routineKind == RoutineKind::Proc)) return false;
    constexpr TokenSet kEnd = {TokenKind::Semicolon, TokenKind::Colon, TokenKind::Assign,
                               TokenKind::EndOfFile};
    TokenIndex end = next + 1; // "again: list{1} := 2;" is an instruction
    while (!kEnd.has(tokens[end].kind))
        ++end;
    return tokens[end].kind == TokenKind::Semicolon;
}

void Jumps::labelStmt(const LabelStmt& s) {
    if (!isName(s.name)) return;
    const NameId name = idOf(s.name);
    if (LabelSymbol* other = routine_.labelNames.find(name)) {
        noteDeclared(report(say::DuplicateLabel, range(s.name), {text(s.name)}), *other);
        routine_.labels.push_back({name, routine_.block, routine_.part, &s, other});
        return;
    }
    const Symbol* data = at(state_.routineNames, name);
    if (asData(data ? const_cast<Symbol*>(data) : scopes_.lookup(name)) && valueFollows(s)) {
        report(say::ForeignSpelling, range(s.last), {":", "':='"}).fix(range(s.last), ":=");
        const uint32_t after = range(s.last).end;
        if (after >= reports_.quietLine().end) reports_.setQuietLine({after, lineEnd(after)});
        return;
    }
    if (data) noteDeclared(report(say::LabelNamedAsData, range(s.name), {text(s.name)}), *data);
    LabelSymbol& symbol = fill(facts().labels.emplace_back(), SymbolKind::Label, s, s.name, false);
    symbol.routine = context_.routine;
    routine_.labels.push_back({name, routine_.block, routine_.part, &s, &symbol});
    routine_.labelNames.set(name, &symbol);
}

std::string Jumps::nearLabel(NameId name) {
    if (routine_.partComparisonsLeft < routine_.labels.size()) return {};
    routine_.partComparisonsLeft -= routine_.labels.size();
    const std::string_view written = names_.folded(name);
    const unsigned limit = suggestionLimit(written.size());
    for (const JumpPoint& label : routine_.labels)
        if (editDistance(written, names_.folded(label.name), limit) <= limit) return label.label->name;
    return {};
}

// A jump may leave IF, TEST, FOR and WHILE but never enter one, and it stays in the body or in its handler.
void Jumps::resolveJumps() {
    NameMap<const JumpPoint> byName;
    std::unordered_set<NameId> repeated; // which of them is meant is not known
    for (const JumpPoint& label : routine_.labels)
        if (byName.find(label.name))
            repeated.insert(label.name);
        else
            byName.set(label.name, &label);
    for (const JumpPoint& jump : routine_.gotos) {
        const TokenIndex token = as<GotoStmt>(*jump.node).label;
        const JumpPoint* target = byName.find(jump.name);
        if (!target) {
            const std::string near = nearLabel(jump.name);
            diag::Diagnostic& d = report(say::UnknownLabel, range(token),
                                         {text(token), near.empty() ? std::string() : didYouMean(near)});
            if (!near.empty()) d.fix(range(token), near, false);
            continue;
        }
        target->label->used = true;
        facts().references[jump.node] = target->label;
        if (routine_.blocksAreUnclear || repeated.count(jump.name) > 0)
            continue; // where the label belongs is not known
        if (target->part != jump.part)
            noteDeclared(report(say::GotoOtherPart, range(token), {text(token)}), *target->label);
        else if (!isInside(jump.block, target->block))
            noteDeclared(report(say::GotoIntoBlock, range(token), {text(token)}), *target->label);
    }
}

} // namespace rapid::sema
