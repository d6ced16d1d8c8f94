// Bodies of routines: scope of parameters and data, handlers, labels and jumps (manual 1.1.5, 1.12, 1.13, 1.21).

#include "frontend/sema/analysis.h"
#include "frontend/syntax/token_set.h"

#include <algorithm>

namespace rapid::sema {

using namespace syntax;

namespace {
constexpr uint32_t kNoBlock = 0xFFFFFFFFu;
}

void Analyzer::checkRoutine(RoutineSymbol& symbol) {
    if (symbol.native) return;
    enterModule(symbol.module);
    context_.routine = &symbol;
    const RoutineDecl& decl = *symbol.routineDecl;
    blocksAreUnclear_ = hasUnclearLine(decl);
    quietLine_ = {};
    loopDepth_ = 0;
    breakSeen_ = returnSeen_ = broken_ = jumpNamesKnown_ = false;
    block_ = kNoBlock;
    blockParents_.clear();
    labels_.clear();
    labelNames_ = {};
    wideRoutine_ = nullptr;
    wideRecord_ = nullptr;
    partComparisonsLeft_ = kMaxPartComparisons;
    gotos_.clear();
    unknownRoutines_.clear();

    for (DataSymbol* param : symbol.params)
        declareInRoutine(*param);
    optionalUses_.assign(symbol.params.size(), {});
    const size_t firstOwn = symbol.data.size();
    for (const DataDecl* data : decl.data)
        if (isName(data->name)) declareRoutineData(*data);
    for (size_t i = firstOwn; i < symbol.data.size(); ++i) {
        ensureValue(*symbol.data[i]);
        context_.constant = false;
    }
    const bool completes = checkPart(Part::Body, decl.body);
    checkPart(Part::Backward, decl.backward);
    for (const ErrorClause* clause : decl.errors) {
        for (const Expr* number : clause->numbers)
            checkListedError(*number);
        checkPart(Part::Error, clause->body);
    }
    checkPart(Part::Undo, decl.undo);
    if (decl.routineKind == RoutineKind::Func && completes && !broken_) {
        if (!returnSeen_) // not even in a handler
            report(Code::FunctionWithoutReturn, range(decl.name), {symbol.name});
        else
            report(Code::FunctionPathWithoutReturn, range(decl.name), {symbol.name});
    }
    resolveJumps();
    checkBigLiterals();
    reportUntestedOptionals();
    for (const NameId name : declaredInRoutine_)
        routineNames_[name] = nullptr;
    declaredInRoutine_.clear();
}

void Analyzer::declareInRoutine(Symbol& symbol) {
    if (const Symbol* other = at(routineNames_, symbol.nameId)) {
        noteDeclared(
            report(Code::DuplicateInRoutine, range(symbol.nameToken), {symbol.name, context_.routine->name}),
            *other);
        return;
    }
    put(routineNames_, symbol.nameId, &symbol);
    declaredInRoutine_.push_back(symbol.nameId);
}

void Analyzer::declareRoutineData(const DataDecl& decl) {
    RoutineSymbol& routine = *context_.routine;
    DataSymbol& symbol = newData(decl);
    symbol.index = static_cast<uint32_t>(routine.params.size() + routine.data.size());
    routine.data.push_back(&symbol);
    declareInRoutine(symbol);
}

bool Analyzer::checkPart(Part part, StmtList list) {
    if (list.empty()) return true;
    part_ = part;
    block_ = kNoBlock;
    return block(list);
}

bool Analyzer::block(StmtList list) {
    const uint32_t outer = block_;
    block_ = static_cast<uint32_t>(blockParents_.size());
    blockParents_.push_back(outer);
    const bool completes = statements(list);
    block_ = outer;
    return completes;
}

bool Analyzer::isInside(uint32_t inner, uint32_t outer) const {
    while (inner != outer && inner != kNoBlock)
        inner = blockParents_[inner];
    return inner == outer;
}

uint32_t Analyzer::lineEnd(uint32_t from) const {
    const std::string_view source = context_.tree->source->text();
    return static_cast<uint32_t>(std::min(source.find_first_of("\r\n", from), source.size()));
}

// "n: n + 1;": what stands behind the colon in the same line is a value and no instruction.
bool Analyzer::valueFollows(const LabelStmt& s) {
    const auto& tokens = context_.tree->tokens;
    const TokenIndex next = s.last + 1;
    if (next + 1 >= tokens.size() || tokens[next].kind != TokenKind::Identifier) return false;
    const uint32_t behind = range(s.last).end;
    const std::string_view between =
        context_.tree->source->text().substr(behind, tokens[next].offset - behind);
    if (between.find_first_of("\r\n") != std::string_view::npos) return false;
    const RoutineSymbol* routine = asRoutine(lookup(idOf(next)));
    if (!lookup(idOf(next)) || (routine && routine->routineKind == RoutineKind::Proc)) return false;
    constexpr TokenSet kEnd = {TokenKind::Semicolon, TokenKind::Colon, TokenKind::Assign,
                               TokenKind::EndOfFile};
    TokenIndex end = next + 1; // "again: list{1} := 2;" is an instruction
    while (!kEnd.has(tokens[end].kind))
        ++end;
    return tokens[end].kind == TokenKind::Semicolon;
}

void Analyzer::labelStmt(const LabelStmt& s) {
    if (!isName(s.name)) return;
    const NameId name = idOf(s.name);
    if (LabelSymbol* other = labelNames_.find(name)) {
        noteDeclared(report(Code::DuplicateLabel, range(s.name), {text(s.name)}), *other);
        labels_.push_back({name, block_, part_, &s, other});
        return;
    }
    const Symbol* data = at(routineNames_, name);
    if (asData(data ? const_cast<Symbol*>(data) : lookup(name)) && valueFollows(s)) {
        report(Code::ForeignSpelling, range(s.last), {":", "':='"}).fix(range(s.last), ":=");
        const uint32_t behind = range(s.last).end;
        if (behind >= quietLine_.end) quietLine_ = {behind, lineEnd(behind)};
        return;
    }
    if (data) noteDeclared(report(Code::LabelNamedAsData, range(s.name), {text(s.name)}), *data);
    LabelSymbol& symbol = fill(facts().labels.emplace_back(), SymbolKind::Label, s, s.name, false);
    symbol.routine = context_.routine;
    labels_.push_back({name, block_, part_, &s, &symbol});
    labelNames_.set(name, &symbol);
}

std::string Analyzer::nearLabel(NameId name) {
    if (partComparisonsLeft_ < labels_.size()) return {};
    partComparisonsLeft_ -= labels_.size();
    const std::string_view written = interner_.folded(name);
    const unsigned limit = suggestionLimit(written.size());
    for (const JumpPoint& label : labels_)
        if (editDistance(written, interner_.folded(label.name), limit) <= limit) return label.label->name;
    return {};
}

// A jump may leave IF, TEST, FOR and WHILE but never enter one, and it stays in the body or in its handler.
void Analyzer::resolveJumps() {
    NameMap<const JumpPoint> byName;
    std::unordered_set<NameId> repeated; // which of them is meant is not known
    for (const JumpPoint& label : labels_)
        if (byName.find(label.name))
            repeated.insert(label.name);
        else
            byName.set(label.name, &label);
    for (const JumpPoint& jump : gotos_) {
        const TokenIndex token = as<GotoStmt>(*jump.node).label;
        const JumpPoint* target = byName.find(jump.name);
        if (!target) {
            const std::string near = nearLabel(jump.name);
            diag::Diagnostic& d = report(Code::UnknownLabel, range(token),
                                         {text(token), near.empty() ? std::string() : didYouMean(near)});
            if (!near.empty()) d.fix(range(token), near, false);
            continue;
        }
        target->label->used = true;
        facts().references[jump.node] = target->label;
        if (blocksAreUnclear_ || repeated.count(jump.name) > 0)
            continue; // where the label belongs is not known
        if (target->part != jump.part)
            noteDeclared(report(Code::GotoOtherPart, range(token), {text(token)}), *target->label);
        else if (!isInside(jump.block, target->block))
            noteDeclared(report(Code::GotoIntoBlock, range(token), {text(token)}), *target->label);
    }
}

// An omitted optional parameter must not be referenced (manual 1.1.5). A routine that never asks Present for it, nor for
// one that excludes it, cannot know.
void Analyzer::reportUntestedOptionals() {
    const std::vector<DataSymbol*>& params = context_.routine->params;
    if (hasErrorHandler()) return; // it may answer ERR_NOTPRES
    const bool any = std::any_of(optionalUses_.begin(), optionalUses_.end(),
                                 [](const OptionalUse& use) { return use.first != nullptr; });
    if (!any) return;
    std::unordered_set<uint32_t> tested; // groups
    for (size_t i = 0; i < params.size(); ++i)
        if (optionalUses_[i].tested) tested.insert(params[i]->group);
    for (size_t i = 0; i < params.size(); ++i) {
        if (!optionalUses_[i].first) continue;
        if (!tested.contains(params[i]->group))
            report(Code::OptionalWithoutPresent, range(*optionalUses_[i].first), {params[i]->name});
    }
}

void Analyzer::placeholder(const Node& node) {
    const TokenIndex first = node.first;
    // A program with placeholders can be loaded and run; ERR_EXECPHR is raised where one is reached (manual 1.1.2).
    report(Code::Placeholder, range(first), {text(first)});
}

} // namespace rapid::sema
