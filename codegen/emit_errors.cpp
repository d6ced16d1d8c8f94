// Errors: cold blocks shared by all places of the routine. Phi nodes carry the number of the error and, where it is raised, the
// statement. A check costs one compare and one branch.

#include <algorithm>
#include <utility>

#include "codegen/routine_emitter.h"

namespace codegen {
namespace {

/// Statements of a routine with RETRY or TRYNEXT from which on its variables stay in memory.
constexpr size_t kManyWaysBack = 100;

} // namespace

bool RoutineEmitter::isHandled(const ir::Inst& inst) const {
    return routine_.errorHandler != ir::kNone && inst.stmt < routine_.statements.size() &&
           routine_.statements[inst.stmt].handled;
}

RoutineEmitter::ErrorJoin& RoutineEmitter::makeJoin(ErrorJoin& join, const char* name) {
    if (join.block) return join;
    join.block = newBlock(name);
    llvm::IRBuilder<> b(join.block);
    join.number = b.CreatePHI(b.getInt32Ty(), 4, "number");
    return join;
}

/// The block that raises errors of the instruction; the current block becomes a way there, with the number of the error.
llvm::BasicBlock* RoutineEmitter::raiseFrom(const ir::Inst& inst, Value* number) {
    ErrorJoin& join = inUndo()          ? makeJoin(raiseUndo_, "raise.undo")
                      : isHandled(inst) ? makeJoin(raiseHandled_, "raise.handled")
                      : frameIsFilled() ? makeJoin(raiseUnhandled_, "raise")
                                        : makeJoin(raiseFrameless_, "raise.frameless");
    if (!join.statement) {
        llvm::IRBuilder<> b(join.block);
        join.statement = b.CreatePHI(b.getInt32Ty(), 4, "statement");
    }
    join.statement->addIncoming(stmtNumber(inst), b_.GetInsertBlock());
    return joinFrom(join, number);
}
RoutineEmitter::ErrorJoin& RoutineEmitter::dispatchJoin() {
    return makeJoin(dispatch_, "dispatch");
}
RoutineEmitter::ErrorJoin& RoutineEmitter::leaveJoin() {
    return inUndo() ? makeJoin(leaveUndo_, "leave.undo") : makeJoin(leave_, "leave");
}

/// Adds the current block as a way into `join`; the caller branches to the block returned.
llvm::BasicBlock* RoutineEmitter::joinFrom(ErrorJoin& join, Value* number) {
    join.number->addIncoming(number, b_.GetInsertBlock());
    return join.block;
}

void RoutineEmitter::check(const ir::Inst& inst, Value* condition) {
    BasicBlock* ok = newBlock("ok");
    BasicBlock* fail = raiseFrom(inst, b_.getInt32(static_cast<uint32_t>(inst.extra)));
    b_.CreateCondBr(condition, ok, fail, m_.unlikely());
    b_.SetInsertPoint(ok);
}

void RoutineEmitter::raise(const ir::Inst& inst) {
    Value* number = operand(inst, 0);
    b_.CreateBr(raiseFrom(inst, number));
}

/// Continues when the status of a routine is 0. Its errors have been raised already.
void RoutineEmitter::continueIfOk(const ir::Inst& inst, Value* status) {
    BasicBlock* ok = newBlock("ok");
    BasicBlock* fail = joinFrom(isHandled(inst) && !inUndo() ? dispatchJoin() : leaveJoin(), status);
    b_.CreateCondBr(b_.CreateICmpEQ(status, statusValue(rt::kOk)), ok, fail, m_.unlikely());
    b_.SetInsertPoint(ok);
}

/// The same for a native, which reports its error only. When the task is started again after the system handler, the
/// native is called once more (`call`: the block that does so).
void RoutineEmitter::continueIfNativeOk(const ir::Inst& inst, Value* status, BasicBlock* call) {
    BasicBlock *ok = newBlock("ok"), *failed = newBlock("native.failed");
    b_.CreateCondBr(b_.CreateICmpEQ(status, statusValue(rt::kOk)), ok, failed, m_.unlikely());
    b_.SetInsertPoint(failed);
    if (m_.isSelfContained(module_.natives[inst.index])) {
        if (!frameIsFilled()) fillFrame();
        storeStatement(stmtNumber(inst));
    }
    Value* before = setsTaskFrame_ ? nullptr : loadTask<&rt::TaskCore::frame>("taskFrame");
    Value* outcome = m_.runtime().nativeFailed.call(b_, task_, frame_, status);
    if (before) storeTaskFrame(before); // the record of a caller: this routine does not set its own
    if (routine_.stepping && !inUndo() && inst.stmt < routine_.statements.size() &&
        routine_.statements[inst.stmt].start != ir::kNone) {
        call = newBlock("again"); // the whole statement: the data of its arguments may have been corrected
        llvm::IRBuilder<>::InsertPointGuard guard(b_);
        b_.SetInsertPoint(call);
        Value* stmt = abi::loadField<&rt::Frame::statement>(b_, frame_);
        b_.CreateBr(joinFrom(makeJoin(steps_, "step"), stmt));
    }
    BasicBlock* fail = joinFrom(isHandled(inst) && !inUndo() ? dispatchJoin() : leaveJoin(), outcome);
    b_.CreateCondBr(b_.CreateICmpEQ(outcome, statusValue(rt::kAgain)), call, fail);
    b_.SetInsertPoint(ok);
}

/// propagate, handlerend: the runtime decides, the routine is left.
void RoutineEmitter::handlerCall(const ir::Inst& inst, HandlerCall callee) {
    storeStatement(stmtNumber(inst));
    leaveOrAgain(callee.call(b_, task_, frame_));
}

/// After the system handler: leaves the routine, or, started again in the stepping profile, continues with the statement
/// of the frame record.
void RoutineEmitter::leaveOrAgain(Value* status) {
    if (!routine_.stepping || inUndo()) {
        b_.CreateBr(joinFrom(leaveJoin(), status));
        return;
    }
    BasicBlock* again = newBlock("again");
    BasicBlock* leave = joinFrom(leaveJoin(), status);
    b_.CreateCondBr(b_.CreateICmpEQ(status, statusValue(rt::kAgain)), again, leave);
    b_.SetInsertPoint(again);
    Value* stmt = abi::loadField<&rt::Frame::statement>(b_, frame_);
    b_.CreateBr(joinFrom(makeJoin(steps_, "step"), stmt));
}

void RoutineEmitter::retry(const ir::Inst& inst) {
    storeStatement(stmtNumber(inst));
    Value* status = m_.runtime().retry.call(b_, task_, frame_);
    BasicBlock* again = newBlock("retry");
    BasicBlock* fail = joinFrom(leaveJoin(), status);
    b_.CreateCondBr(b_.CreateICmpEQ(status, statusValue(rt::kOk)), again, fail, m_.unlikely());
    b_.SetInsertPoint(again);
    resumeSwitch(&ir::Statement::start);
}

void RoutineEmitter::tryNext(const ir::Inst&) {
    resumeSwitch(&ir::Statement::next);
}

/// Jumps to `where` of the statement that failed.
void RoutineEmitter::resumeSwitch(ir::BlockId ir::Statement::* where) {
    if (m_.options().optimise && routine_.statements.size() > kManyWaysBack &&
        !std::exchange(variablesKept_, true))
        keepInMemory();
    BasicBlock* never = newBlock("never");
    auto* branch = b_.CreateSwitch(b_.CreateLoad(b_.getInt32Ty(), failed_), never);
    for (uint32_t s = 0; s < routine_.statements.size(); ++s) {
        const ir::Statement& statement = routine_.statements[s];
        ir::BlockId target = statement.*where;
        if (statement.handled && mayFail_[s] && target != ir::kNone)
            branch->addCase(b_.getInt32(s), blockOf(target));
    }
    b_.SetInsertPoint(never);
    b_.CreateUnreachable();
}

/// Reads all variables in a way that LLVM leaves alone, here where it costs nothing, so that it does not put them into registers: each
/// would be alive at every way back, with a phi node in nearly every block. The main loop of a driver (900 lines, 30 counters) had 6,400
/// of them, and the register allocator took 13 s.
void RoutineEmitter::keepInMemory() {
    for (Value* local : locals_)
        if (auto* slot = llvm::dyn_cast<llvm::AllocaInst>(local))
            keepInMemory(slot, slot->getAllocatedType());
    for (llvm::AllocaInst* slot : spills_)
        if (slot) keepInMemory(slot, slot->getAllocatedType());
}

void RoutineEmitter::keepInMemory(Value* address, llvm::Type* type) {
    constexpr uint64_t kFew = 16; // larger arrays stay in memory anyway
    if (type->isSingleValueType()) {
        b_.CreateLoad(type, address, true);
    } else if (auto* record = llvm::dyn_cast<llvm::StructType>(type)) {
        for (unsigned i = 0; i < record->getNumElements(); ++i)
            keepInMemory(b_.CreateStructGEP(record, address, i), record->getElementType(i));
    } else if (auto* array = llvm::dyn_cast<llvm::ArrayType>(type);
               array && array->getNumElements() <= kFew) {
        for (unsigned i = 0; i < array->getNumElements(); ++i)
            keepInMemory(b_.CreateConstInBoundsGEP2_32(array, address, 0, i), array->getElementType());
    }
}

void RoutineEmitter::emitErrorBlocks() {
    if (m_.debug()) b_.SetCurrentDebugLocation(m_.debug()->location(routine_, ir::kNone));
    current_ = 0; // outside the undo handler
    for (ErrorJoin* join : {&raiseHandled_, &raiseUnhandled_, &raiseFrameless_, &raiseUndo_})
        if (join->block) emitRaise(*join);
    if (steps_.block) emitSteps();
    if (dispatch_.block) emitDispatch();
    if (leave_.block) emitLeave();
    if (!leaveUndo_.block) return;
    b_.SetInsertPoint(leaveUndo_.block);
    returnFromUndo(leaveUndo_.number);
}

void RoutineEmitter::emitRaise(ErrorJoin& join) {
    b_.SetInsertPoint(join.block);
    if (&join == &raiseFrameless_) fillFrame();
    storeStatement(join.statement);
    Value* status = m_.runtime().raise.call(b_, task_, frame_, join.number);
    if (&join == &raiseUndo_) {
        returnFromUndo(status);
        return;
    }
    if (&join != &raiseHandled_) return leaveOrAgain(status);
    ErrorJoin& next = dispatchJoin();
    if (routine_.stepping) {
        BasicBlock* taken = newBlock("taken");
        BasicBlock* untaken = newBlock("untaken");
        b_.CreateCondBr(b_.CreateICmpSGT(status, statusValue(rt::kOk)), taken, untaken);
        b_.SetInsertPoint(untaken);
        leaveOrAgain(status);
        b_.SetInsertPoint(taken);
    }
    next.number->addIncoming(status, b_.GetInsertBlock());
    b_.CreateBr(next.block);
}

/// An UNDO handler that ends early: the runtime may have ordered to skip those of the callers, too (kUnwindSilent).
void RoutineEmitter::returnFromUndo(Value* status) {
    Value* unwinding = b_.CreateLoad(b_.getInt32Ty(), unwinding_);
    returnStatus(b_.CreateSelect(b_.CreateICmpSLT(status, statusValue(rt::kOk)), status, unwinding));
}

/// An error on its way meets this routine's handler: notes the statement, and takes the error if the list lets it.
void RoutineEmitter::emitDispatch() {
    b_.SetInsertPoint(dispatch_.block);
    ErrorJoin& leaving = leaveJoin();
    BasicBlock* handler = enterHandler();
    leaving.number->addIncoming(dispatch_.number, dispatch_.block);
    const std::vector<int32_t>& list = routine_.errorFilter;
    auto lists = [&](int32_t number) { return std::find(list.begin(), list.end(), number) != list.end(); };
    if (!routine_.errorFilterGlobals.empty()) {
        BasicBlock* ask = newBlock("listed");
        b_.CreateCondBr(b_.CreateICmpSGT(dispatch_.number, statusValue(rt::kOk)), ask, leaving.block);
        b_.SetInsertPoint(ask);
        Value* takes = m_.runtime().takesError.call(b_, task_, frame_, dispatch_.number);
        leaving.number->addIncoming(dispatch_.number, ask);
        b_.CreateCondBr(b_.CreateICmpNE(takes, b_.getInt32(0)), handler, leaving.block);
        return;
    }
    if (list.empty() || lists(rt::kAllErrors) || lists(rt::kOtherErrors)) {
        b_.CreateCondBr(b_.CreateICmpSGT(dispatch_.number, statusValue(rt::kOk)), handler, leaving.block);
        return;
    }
    auto* filter = b_.CreateSwitch(dispatch_.number, leaving.block);
    for (int32_t number : list) {
        auto* value = b_.getInt32(static_cast<uint32_t>(number));
        if (number > 0 && filter->findCaseValue(value) == filter->case_default())
            filter->addCase(value, handler);
    }
}

/// Continues with the statement whose number the controller gave; a negative number is a status.
void RoutineEmitter::emitSteps() {
    b_.SetInsertPoint(steps_.block);
    ErrorJoin& leaving = leaveJoin();
    leaving.number->addIncoming(steps_.number, steps_.block);
    auto* branch = b_.CreateSwitch(steps_.number, leaving.block);
    for (uint32_t s = 0; s < routine_.statements.size(); ++s)
        if (routine_.statements[s].start != ir::kNone)
            branch->addCase(b_.getInt32(s), blockOf(routine_.statements[s].start));
}

/// A block that notes the failing statement and goes to the error handler.
llvm::BasicBlock* RoutineEmitter::enterHandler() {
    if (enterHandler_) return enterHandler_;
    llvm::IRBuilder<>::InsertPointGuard guard(b_);
    b_.SetInsertPoint(enterHandler_ = newBlock("enter.handler"));
    setTaskFrame(frame_);
    b_.CreateStore(abi::loadField<&rt::Frame::statement>(b_, frame_), failed_);
    b_.CreateBr(blockOf(routine_.errorHandler));
    return enterHandler_;
}

/// Leaves the routine with the status; a long jump may end here, and when the stack is being unwound the undo handler
/// runs.
void RoutineEmitter::emitLeave() {
    b_.SetInsertPoint(leave_.block);
    Value* status = leave_.number;
    if (routine_.errorHandler != ir::kNone) {
        BasicBlock *jump = newBlock("jump"), *land = newBlock("land"), *out = newBlock("out");
        // Statuses from kJump downward are the long jumps.
        b_.CreateCondBr(b_.CreateICmpSLE(status, statusValue(rt::kJump)), jump, out);
        b_.SetInsertPoint(jump);
        Value* landed = m_.runtime().land.call(b_, task_, frame_, status);
        b_.CreateCondBr(b_.CreateICmpSGT(landed, statusValue(rt::kOk)), land, out);
        b_.SetInsertPoint(land);
        b_.CreateBr(enterHandler());
        b_.SetInsertPoint(out);
        auto* way = b_.CreatePHI(b_.getInt32Ty(), 2, "status");
        way->addIncoming(status, leave_.block);
        way->addIncoming(landed, jump);
        status = way;
    }
    if (!unwinding_) {
        returnStatus(status);
        return;
    }
    BasicBlock *unwind = newBlock("unwind"), *pass = newBlock("pass");
    Value* undo = b_.CreateOr(b_.CreateICmpEQ(status, statusValue(rt::kUnwind)),
                              b_.CreateICmpEQ(status, statusValue(rt::kJump)));
    b_.CreateCondBr(undo, unwind, pass);
    b_.SetInsertPoint(unwind);
    b_.CreateStore(status, unwinding_);
    if (!frameInPrologue_) fillFrame();
    markFrame(rt::kFrameInUndo);
    setTaskFrame(frame_);
    b_.CreateBr(blockOf(routine_.undoHandler));
    b_.SetInsertPoint(pass);
    returnStatus(
        b_.CreateSelect(b_.CreateICmpEQ(status, statusValue(rt::kJumpPast)), statusValue(rt::kJump), status));
}

} // namespace codegen
