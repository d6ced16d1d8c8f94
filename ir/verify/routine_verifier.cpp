#include "ir/verify/routine_verifier.h"

#include <fmt/format.h>

#include <algorithm>

#include "ir/core/op_info.h"

namespace ir {

void RoutineVerifier::add(const std::string& text) {
    std::string place = "routine " + routine_.name;
    if (block_ != kNone) place += fmt::format(", b{}", block_);
    if (inst_ != kNone)
        place += fmt::format(", instruction {} ({})", placeOf_[inst_], opInfo(routine_.insts[inst_].op).text);
    out_.push_back(place + ": " + text);
}

void RoutineVerifier::inRange(uint32_t index, size_t size, std::string_view what) {
    if (index >= size) add(fmt::format("{} {} does not exist", what, index == kNone ? -1 : int64_t{index}));
}

bool RoutineVerifier::header() {
    size_t before = out_.size();
    if (routine_.blocks.empty()) add("has no blocks");
    if (routine_.result >= module_.types.size()) add("result type does not exist");
    for (const Param& param : routine_.params)
        if (param.type == kVoid || param.type >= module_.types.size() || !module_.isScalar(param.type))
            add(fmt::format("parameter {} is neither scalar nor ptr", param.name));
    for (const Local& local : routine_.locals)
        localEntry(local);
    if (routine_.file != kNone) inRange(routine_.file, module_.files.size(), "file");
    if (routine_.errorHandler != kNone)
        inRange(routine_.errorHandler, routine_.blocks.size(), "error handler block");
    if (routine_.undoHandler != kNone)
        inRange(routine_.undoHandler, routine_.blocks.size(), "undo handler block");
    if (routine_.errorHandler == kNone &&
        !(routine_.errorFilter.empty() && routine_.errorFilterGlobals.empty()))
        add("error filter without error handler");
    detachedHandler();
    for (uint32_t global : routine_.errorFilterGlobals) {
        inRange(global, module_.globals.size(), "global in the error filter");
        if (global >= module_.globals.size()) continue;
        const TypeId type = module_.globals[global].type;
        if (type != kI32 && type != kF32) add("global in the error filter is neither i32 nor f32");
    }
    return out_.size() == before;
}

void RoutineVerifier::detachedHandler() {
    for (uint32_t local : routine_.sharedLocals)
        inRange(local, routine_.locals.size(), "shared local");
    if (routine_.detachedHandler == kNone) return;
    if (routine_.errorHandler == kNone) add("detached handler without error handler");
    inRange(routine_.detachedHandler, module_.routines.size(), "detached handler");
    if (routine_.detachedHandler >= module_.routines.size()) return;
    const Routine& handler = module_.routines[routine_.detachedHandler];
    const bool fits = handler.isDetachedHandler && handler.result == kVoid && handler.params.size() == 1 &&
                      handler.params[0].type == kPtr && handler.errorHandler == kNone;
    if (!fits) add(fmt::format("{} cannot be its detached handler", handler.name));
}

void RoutineVerifier::localEntry(const Local& local) {
    if (local.type == kVoid || local.type >= module_.types.size())
        add(fmt::format("local {} has no type", local.name));
    if (local.typeDesc != kNone) inRange(local.typeDesc, module_.typeDescs.size(), "type description");
    if (local.reference && local.type != kPtr)
        add(fmt::format("local {} is a reference, but no ptr", local.name));
    if (local.rank == 0) return;
    bool dims = local.rank <= 3 && local.dims < routine_.locals.size() &&
                local.dims + local.rank <= routine_.locals.size();
    for (uint32_t k = 0; dims && k < local.rank; ++k)
        dims = routine_.locals[local.dims + k].type == kI32;
    if (!dims) add(fmt::format("local {} has no locals for its dimensions", local.name));
}

/// Every block ends in its one terminator, every instruction occurs once, targets and operands exist.
bool RoutineVerifier::structure() {
    size_t before = out_.size();
    blockOf_.assign(routine_.insts.size(), kNone);
    placeOf_.assign(routine_.insts.size(), 0);
    for (block_ = 0; block_ < routine_.blocks.size(); ++block_) {
        const std::vector<ValueId>& insts = routine_.blocks[block_].insts;
        inst_ = kNone;
        if (insts.empty()) add("has no terminator");
        for (uint32_t place = 0; place < insts.size(); ++place) {
            inst_ = kNone;
            if (insts[place] >= routine_.insts.size()) {
                add("instruction id does not exist");
                continue;
            }
            if (blockOf_[insts[place]] != kNone)
                add(fmt::format("instruction id {} occurs twice", insts[place]));
            inst_ = insts[place];
            blockOf_[inst_] = block_;
            placeOf_[inst_] = place;
            const Inst& inst = routine_.insts[inst_];
            bool last = place + 1 == insts.size();
            if (opInfo(inst.op).terminator != last)
                add(last ? "the block does not end in a terminator" : "terminator inside the block");
            if (inst.type >= module_.types.size()) add("type does not exist");
            for (ValueId operand : inst.operands)
                inRange(operand, routine_.insts.size(), "operand");
            if (inst.op == Op::Br || inst.op == Op::CondBr || inst.op == Op::Switch)
                for (BlockId target : successors(routine_, block_))
                    inRange(target, routine_.blocks.size(), "block");
            retries_ = retries_ || inst.op == Op::Retry;
            triesNext_ = triesNext_ || inst.op == Op::TryNext;
        }
    }
    block_ = inst_ = kNone;
    return out_.size() == before;
}

void RoutineVerifier::statements() {
    for (size_t i = 0; i < routine_.statements.size(); ++i) {
        const Statement& s = routine_.statements[i];
        for (BlockId block : {s.start, s.next})
            if (block != kNone && block >= routine_.blocks.size())
                add(fmt::format("stmt {}: block does not exist", i));
        if (s.previous != kNone) inRange(s.previous, routine_.statements.size(), "previous statement");
    }
}

std::vector<bool> RoutineVerifier::reachableFrom(BlockId root) const {
    std::vector<bool> seen(routine_.blocks.size(), false);
    std::vector<BlockId> work{root};
    while (!work.empty()) {
        BlockId b = work.back();
        work.pop_back();
        if (b >= seen.size() || seen[b]) continue;
        seen[b] = true;
        for (BlockId succ : successors(routine_, b))
            work.push_back(succ);
    }
    return seen;
}

void RoutineVerifier::handlers() {
    std::vector<bool> inBody = reachableFrom(0), inError = reachableFrom(routine_.errorHandler);
    inUndo_ = reachableFrom(routine_.undoHandler);
    reached_.assign(inBody.size(), false);
    for (size_t i = 0; i < inBody.size(); ++i)
        reached_[i] = inBody[i] || inError[i] || inUndo_[i];
    for (block_ = 0; block_ < routine_.blocks.size(); ++block_) {
        if (inUndo_[block_] && (inBody[block_] || inError[block_]))
            add("is reached from the undo handler and from elsewhere");
        if (routine_.blocks[block_].insts.empty()) continue;
        inst_ = routine_.blocks[block_].insts.back();
        Op op = routine_.insts[inst_].op;
        const bool leaves = op == Op::Propagate || op == Op::HandlerEnd;
        if (leaves && routine_.isDetachedHandler) continue;
        bool handlerOnly = op == Op::Retry || op == Op::TryNext || leaves;
        bool reached = inBody[block_] || inUndo_[block_];
        if (handlerOnly && reached) add("is outside the error handler");
        if (handlerOnly && routine_.errorHandler == kNone) add("there is no error handler");
        inst_ = kNone;
    }
    block_ = kNone;
}

void RoutineVerifier::raising(const Inst& inst) {
    if (inst.stmt == kNone) {
        if (mayRaise(module_, inst)) add("may raise, but belongs to no statement");
        return;
    }
    inRange(inst.stmt, routine_.statements.size(), "statement");
    if (inst.stmt >= routine_.statements.size() || !mayRaise(module_, inst)) return;
    const Statement& s = routine_.statements[inst.stmt];
    if (!s.handled || routine_.errorHandler == kNone) return;
    if (inUndo_[block_]) add("a statement of the undo handler is marked as handled");
    if (retries_ && s.start == kNone)
        add(fmt::format("statement {} is handled but has no start for retry", inst.stmt));
    if (triesNext_ && s.next == kNone)
        add(fmt::format("statement {} is handled but has no next for trynext", inst.stmt));
}

/// Definitions come before uses on every path that the control flow knows, the ways into handlers and back
/// included.
void RoutineVerifier::dominance() {
    for (block_ = 0; block_ < routine_.blocks.size(); ++block_) {
        if (!cfg_.reachable(block_)) continue;
        for (ValueId id : routine_.blocks[block_].insts) {
            inst_ = id;
            for (ValueId operand : routine_.insts[id].operands) {
                BlockId home = blockOf_[operand];
                if (home == kNone)
                    add("operand belongs to no block");
                else if (home == block_ ? placeOf_[operand] >= placeOf_[id] : !cfg_.dominates(home, block_))
                    add(fmt::format("operand ({}, b{}) is not defined on every path",
                                    opInfo(routine_.insts[operand].op).text, home));
            }
        }
    }
    block_ = inst_ = kNone;
}

void RoutineVerifier::run() {
    if (!header() || !structure()) return;
    statements();
    handlers();
    for (block_ = 0; block_ < routine_.blocks.size(); ++block_) {
        for (ValueId id : routine_.blocks[block_].insts) {
            inst_ = id;
            instruction(routine_.insts[id]);
        }
    }
    block_ = inst_ = kNone;
    cfg_ = buildCfg(module_, routine_, HandlerEdges::Yes);
    dominance();
}

void RoutineVerifier::instruction(const Inst& inst) {
    raising(inst);
    size_t before = out_.size();
    indices(inst);
    if (operandCount(inst) && out_.size() == before) types(inst);
}

bool RoutineVerifier::operandCount(const Inst& inst) {
    int wanted = opInfo(inst.op).operands;
    size_t count = inst.operands.size();
    bool ok = wanted >= 0
                  ? count == static_cast<size_t>(wanted)
                  : (inst.op != Op::Ret && inst.op != Op::Safepoint && inst.op != Op::Charge) || count <= 1;
    if (!ok) add(fmt::format("has {} operands", count));
    return ok;
}

void RoutineVerifier::indices(const Inst& inst) {
    switch (opInfo(inst.op).form) {
    case Form::Param: inRange(inst.index, routine_.params.size(), "parameter"); return;
    case Form::Local: inRange(inst.index, routine_.locals.size(), "local"); return;
    case Form::Global: inRange(inst.index, module_.globals.size(), "global"); return;
    case Form::TypeDesc: inRange(inst.index, module_.typeDescs.size(), "type description"); return;
    case Form::Routine:
    case Form::CallRoutine: inRange(inst.index, module_.routines.size(), "routine"); return;
    case Form::CallNative: inRange(inst.index, module_.natives.size(), "native"); return;
    case Form::Statement:
        inRange(inst.index, routine_.statements.size(), "statement");
        if (inst.op == Op::Step && !routine_.stepping) add("the routine is not made for stepping");
        return;
    case Form::Field:
        if (module_.types[inst.type].kind != TypeKind::Record)
            add("type is not a record");
        else
            inRange(inst.index, module_.types[inst.type].fields.size(), "field");
        return;
    case Form::Plain:
    case Form::Number:
    case Form::Sysvar:
    case Form::Error:
    case Form::Cost:
    case Form::Jump:
    case Form::Branch:
    case Form::Switch: return; // no index
    }
}

} // namespace ir
