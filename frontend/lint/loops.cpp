// Loops and jumps: what never ends, never waits, never runs.

#include "frontend/diag/messages/warnings.h"
#include "frontend/lint/walker.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace rapid::lint {

using namespace syntax;
using sema::DataSymbol;

namespace {

bool isTrue(const sema::ConstValue* value) {
    return value && value->kind == sema::ConstValue::Kind::Bool && value->boolean;
}

} // namespace

Walker::LoopMark Walker::enterLoop() {
    ++loopDepth_;
    LoopMark mark;
    mark.waits = waits_;
    mark.exits = exits();
    mark.calls = facts_.calls.size();
    mark.writes = writes_.size();
    mark.pending = pending_.size();
    mark.outerBreak = std::exchange(breakSeen_, false);
    mark.outerWritten = std::exchange(written_, Slots());
    return mark;
}

// In its second round a loop sees what its first one assigned.
bool Walker::leaveLoop(const LoopMark& mark) {
    --loopDepth_;
    const auto assignedInside = [&](const Pending& p) {
        const int16_t slot = slots_[p.data->index];
        return slot >= 0 && written_[static_cast<size_t>(slot)];
    };
    pending_.erase(std::remove_if(pending_.begin() + static_cast<std::ptrdiff_t>(mark.pending),
                                  pending_.end(), assignedInside),
                   pending_.end());
    assigned_ |= written_;
    written_ |= mark.outerWritten;
    return std::exchange(breakSeen_, mark.outerBreak);
}

bool Walker::whileStmt(const WhileStmt& s) {
    if (!s.condition) return true;
    LoopMark mark = enterLoop();
    expr(*s.condition);
    mark.writes = writes_.size(); // what the condition looks at may be passed by reference
    const Slots before = assigned_;
    const bool forever = isTrue(constant(*s.condition));
    list(s.body);
    assigned_ |= before;
    const bool left = leaveLoop(mark);
    if (left || !isTight(mark)) return !forever || left;
    if (forever)
        suspectLoop(say::EndlessLoop.code, s, mark);
    else if (!constant(*s.condition) && facts_.calls.size() == mark.calls && !changesIn(*s.condition, mark))
        suspectLoop(say::BusyWait.code, s, mark);
    return !forever;
}

// Marks the line that opens the loop.
void Walker::suspectLoop(Code code, const Node& loop, const LoopMark& mark) {
    if (facts_.callsByName || !reporter_.isOn(code)) return;
    SourceRange where = tree_->range(loop.first);
    if (loop.kind == NodeKind::While) where.end = range(*as<WhileStmt>(loop).condition).end;
    facts_.suspicions.push_back({code,
                                 tree_,
                                 where,
                                 {},
                                 mark.calls,
                                 facts_.calls.size(),
                                 static_cast<uint8_t>(kWaits | kEnds | kRaises)});
}

/// Whether something in the loop may change what its condition reads, or the condition changes by itself.
bool Walker::changesIn(const Expr& condition, const LoopMark& mark) const {
    switch (condition.kind) {
    case NodeKind::Name:
    case NodeKind::Index:
    case NodeKind::Component: {
        const DataSymbol* root = rootOf(condition);
        if (!root) return true;
        if (condition.kind == NodeKind::Index)
            for (const Expr* i : as<IndexExpr>(condition).indices)
                if (changesIn(*i, mark)) return true;
        return std::find(writes_.begin() + static_cast<std::ptrdiff_t>(mark.writes), writes_.end(), root) !=
               writes_.end();
    }
    case NodeKind::Paren: return changesIn(*as<ParenExpr>(condition).inner, mark);
    case NodeKind::Unary: return changesIn(*as<UnaryExpr>(condition).operand, mark);
    case NodeKind::Binary:
        return changesIn(*as<BinaryExpr>(condition).left, mark) ||
               changesIn(*as<BinaryExpr>(condition).right, mark);
    case NodeKind::NumLiteral:
    case NodeKind::StringLiteral:
    case NodeKind::BoolLiteral: return false;
    case NodeKind::Call: {
        const sema::BoundCall* call = find(condition);
        if (!call || !call->routine || !call->routine->native ||
            call->routine->effects == sema::Effects::Writes)
            return true;
        for (const sema::BoundArg& arg : call->args)
            if (arg.value && changesIn(*arg.value, mark)) return true;
        return false;
    }
    default: return true;
    }
}

void Walker::forStmt(const ForStmt& s) {
    for (const Expr* bound : {s.from, s.to, s.step})
        if (bound) expr(*bound);
    const Slots before = assigned_;
    const LoopMark mark = enterLoop();
    list(s.body);
    assigned_ |= before;
    leaveLoop(mark);
    judgeFor(s);
}

// Without STEP the loop counts up or down as it needs (manual 1.5).
void Walker::judgeFor(const ForStmt& s) {
    const double* step = s.step ? number(*s.step) : nullptr;
    if (!step) return;
    if (*step != std::floor(*step) && s.step->kind != NodeKind::Paren) {
        // 0.5, 0.25 ... add up exactly
        const double fine = *step * 1024;
        if (fine != std::floor(fine)) report(say::FractionalStep, range(*s.step), {text(*s.step)});
    }
    const double* from = s.from ? number(*s.from) : nullptr;
    const double* to = s.to ? number(*s.to) : nullptr;
    if (!from || !to) return;
    if ((*step > 0 && *from > *to) || (*step < 0 && *from < *to))
        report(say::LoopNeverRuns, {range(*s.from).begin, range(*s.step).end},
               {text(*s.from), text(*s.to), text(*s.step)});
}

void Walker::labelStmt(const LabelStmt& s) {
    Label label;
    label.node = &s;
    label.list = list_;
    label.mark.waits = waits_;
    label.mark.exits = exits();
    label.mark.calls = facts_.calls.size();
    label.mark.writes = writes_.size();
    labelIndex_[&s] = labels_.size();
    labels_.push_back(label);
    assigned_.set(); // a jump may come from anywhere
}

const sema::Symbol* Walker::targetOf(const GotoStmt& s) const {
    const auto found = module_->facts->references.find(&s);
    return found == module_->facts->references.end() ? nullptr : found->second;
}

/// The label further up in the list of instructions that is being read, when nothing between it and here waits or
/// leads elsewhere.
const Walker::Label* Walker::tightLoopOf(const GotoStmt& s) const {
    const sema::Symbol* target = targetOf(s);
    const auto known = target ? labelIndex_.find(target->decl) : labelIndex_.end();
    const Label* label = known == labelIndex_.end() ? nullptr : &labels_[known->second];
    return label && label->list == list_ && isTight(label->mark) ? label : nullptr;
}

void Walker::gotoStmt(const GotoStmt& s) {
    if (const sema::Symbol* target = targetOf(s)) targets_.insert(target->decl);
    // A jump back from the end of the same list of instructions: nothing else leads on from here.
    if (const Label* label = tightLoopOf(s)) suspectLoop(say::EndlessLoop.code, s, label->mark);
    ++jumps_;
}

// "again: IF diReady = 0 GOTO again;"
void Walker::judgeJumpBack(const CompactIfStmt& s) {
    if (!s.condition || !s.body || s.body->kind != NodeKind::Goto || constant(*s.condition)) return;
    const Label* label = tightLoopOf(as<GotoStmt>(*s.body));
    if (label && facts_.calls.size() == label->mark.calls && !changesIn(*s.condition, label->mark))
        suspectLoop(say::BusyWait.code, s, label->mark);
}

} // namespace rapid::lint
