#include "codegen/routine_emitter.h"

#include <algorithm>

#include "codegen/joined_rounds.h"
#include "codegen/paced_routines.h"
#include "codegen/retried_statements.h"
#include "codegen/wide_loop.h"
#include "ir/core/op_info.h"

namespace codegen {
namespace {

/// Larger locals are allocated after the check of the stack, so that overflow is found before they are touched.
constexpr uint64_t kLargeLocal = 4096;

} // namespace

RoutineEmitter::RoutineEmitter(ModuleEmitter& module, uint32_t index)
    : m_(module), module_(module.source()), index_(index), routine_(module_.routines[index]),
      function_(module.routine(index)), desc_(module.routineDesc(index)), b_(module.context()),
      setsTaskFrame_(module.setsTaskFrame(index)) {}

RoutineEmitter::~RoutineEmitter() = default;

void RoutineEmitter::run() {
    if (m_.debug()) m_.debug()->attach(routine_, *function_);
    analyse();
    BasicBlock* entry = BasicBlock::Create(m_.context(), "entry", function_);
    for (const ir::Block& source : routine_.blocks)
        blocks_.push_back(BasicBlock::Create(m_.context(), routine_.blockNames[source.name], function_));
    b_.SetInsertPoint(entry);
    if (m_.debug()) b_.SetCurrentDebugLocation(m_.debug()->location(routine_, ir::kNone));
    allocate();
    if (m_.countsCalls(index_)) countCall();
    prologue();
    b_.CreateBr(blocks_[0]);
    // Reverse postorder: definitions are met before their uses in other blocks.
    for (ir::BlockId id : cfg_.order)
        block(id);
    for (ir::BlockId id = 0; id < blocks_.size(); ++id) {
        if (cfg_.reachable(id)) continue;
        b_.SetInsertPoint(blocks_[id]);
        b_.CreateUnreachable();
    }
    emitErrorBlocks();
}

/// The call that brings the countdown to 0 orders better code for the calls to come.
void RoutineEmitter::countCall() {
    llvm::Module& target = m_.target();
    llvm::Type* i32 = b_.getInt32Ty();
    Value* counter = b_.CreateConstInBoundsGEP1_64(i32, target.getOrInsertGlobal(kCallCounts, i32), index_);
    Value* left = b_.CreateSub(b_.CreateLoad(i32, counter), b_.getInt32(1));
    b_.CreateStore(left, counter);
    BasicBlock *hot = newBlock("hot"), *go = newBlock("counted");
    b_.CreateCondBr(b_.CreateICmpNE(left, b_.getInt32(0)), go, hot, m_.unlikely());
    b_.SetInsertPoint(hot);
    b_.CreateCall(target.getOrInsertFunction(kRoutineIsHot, b_.getVoidTy(), b_.getPtrTy(), i32),
                  {target.getOrInsertGlobal(kThisProgram, b_.getInt8Ty()), b_.getInt32(index_)});
    b_.CreateBr(go);
    b_.SetInsertPoint(go);
}

bool RoutineEmitter::needsFrame(const ir::Inst& inst) const {
    if (inst.op == ir::Op::Call) return true;
    return inst.op == ir::Op::CallNative && ir::mayRaise(module_, inst) &&
           (!m_.isSelfContained(module_.natives[inst.index]) || callsChecked(module_.natives[inst.index]));
}

void RoutineEmitter::analyse() {
    cfg_ = ir::buildCfg(module_, routine_, ir::HandlerEdges::Yes);
    values_.assign(routine_.insts.size(), nullptr);
    spills_.assign(routine_.insts.size(), nullptr);
    homeOf_.assign(routine_.insts.size(), ir::kNone);
    for (ir::BlockId b = 0; b < routine_.blocks.size(); ++b)
        for (ir::ValueId id : routine_.blocks[b].insts)
            homeOf_[id] = b;
    inUndo_ = undoBlocks(routine_);
    mayFail_ = failingStatements(module_, routine_, cfg_);
    beginsRetried_ = retriedBlocks(routine_, cfg_, mayFail_);
    // Ways back out of error handlers do not count as loops.
    const ir::Cfg straight = ir::buildCfg(module_, routine_, ir::HandlerEdges::No);
    const ir::LoopInfo loops = ir::findLoops(straight);
    if (m_.options().optimise && isPacedByNatives(module_, routine_, straight, loops, m_.options().bodies))
        function_->addFnAttr(kPaced);
    for (ir::BlockId b = 0; b < routine_.blocks.size(); ++b)
        inLoop_.push_back(!loops.irreducible.empty() || loops.loopOf[b] != ir::kNone);
    findFrameBlock();
    findFastLoops();
}

/// The frame record is filled where all calls are still ahead, but no earlier: a routine that returns before its first
/// call pays nothing. Never inside a loop. Routines with handlers fill it at once, because handlers look at it.
void RoutineEmitter::findFrameBlock() {
    bool handlers =
        routine_.errorHandler != ir::kNone || routine_.undoHandler != ir::kNone || routine_.isDetachedHandler;
    if (handlers || routine_.stepping) {
        frameInPrologue_ = true;
        return;
    }
    for (ir::BlockId b : cfg_.order) {
        bool calls = false;
        current_ = b;
        for (ir::ValueId id : routine_.blocks[b].insts)
            calls = calls || needsFrame(routine_.insts[id]);
        if (!calls) continue;
        if (frameBlock_ == ir::kNone) frameBlock_ = b;
        while (!cfg_.dominates(frameBlock_, b))
            frameBlock_ = cfg_.idom[frameBlock_];
    }
    current_ = 0;
    if (frameBlock_ == ir::kNone) return;
    while (frameBlock_ != 0 && inLoop_[frameBlock_])
        frameBlock_ = cfg_.idom[frameBlock_];
    if (frameBlock_ == 0 || !m_.options().optimise) frameInPrologue_ = true;
}

llvm::BasicBlock* RoutineEmitter::newBlock(const char* name) {
    return BasicBlock::Create(m_.context(), name, function_);
}

void RoutineEmitter::allocate() {
    task_ = function_->getArg(0);
    caller_ = function_->getArg(1);
    if (!module_.isScalar(routine_.result)) result_ = function_->getArg(2);
    const size_t addresses = addressedLocals(routine_).size();
    const bool extended = routine_.stepping || addresses > 0;
    frame_ = b_.CreateAlloca(extended ? abi::structType<rt::SteppingFrame>(m_.context())
                                      : abi::structType<rt::Frame>(m_.context()),
                             nullptr, "frame");
    if (addresses > 0)
        addresses_ = b_.CreateAlloca(llvm::ArrayType::get(b_.getPtrTy(), addresses), nullptr, "addresses");
    llvm::Type* i32 = b_.getInt32Ty();
    static_assert(std::is_same_v<abi::TypeOf<&rt::SteppingFrame::failed>, int32_t>, "as in the alloca");
    if (routine_.errorHandler != ir::kNone)
        failed_ = extended ? abi::fieldAddress<&rt::SteppingFrame::failed>(b_, frame_, "failed")
                           : b_.CreateAlloca(i32, nullptr, "failed");
    if (routine_.undoHandler != ir::kNone) unwinding_ = b_.CreateAlloca(i32, nullptr, "unwinding");
    for (const ir::Local& local : routine_.locals) {
        if (module_.size(local.type) > kLargeLocal) {
            locals_.push_back(nullptr);
            continue;
        }
        auto* slot = b_.CreateAlloca(m_.memoryType(local.type), nullptr, local.name);
        slot->setAlignment(llvm::Align(module_.align(local.type)));
        locals_.push_back(slot);
    }
    // A handler, retry and trynext make paths that LLVM's dominance would not allow for values used in other blocks.
    if (!failed_ && !unwinding_ && !routine_.stepping) return;
    for (ir::BlockId b = 0; b < routine_.blocks.size(); ++b) {
        for (ir::ValueId id : routine_.blocks[b].insts) {
            for (ir::ValueId operand : routine_.insts[id].operands) {
                if (homeOf_[operand] == b || spills_[operand]) continue;
                spills_[operand] = b_.CreateAlloca(m_.valueType(ir::valueType(routine_.insts[operand])));
            }
        }
    }
}

void RoutineEmitter::prologue() {
    uint64_t small = 0, large = 0;
    for (const ir::Local& local : routine_.locals) {
        uint64_t size = module_.size(local.type);
        (size > kLargeLocal ? large : small) += size;
    }
    bool leaf = frameBlock_ == ir::kNone;
    frameInPrologue_ = frameInPrologue_ || large > 0 || (leaf && small > kLargeLocal);
    if (frameInPrologue_) enterFrame();
    for (size_t i = 0; i < locals_.size(); ++i) {
        if (locals_[i]) continue;
        const ir::Local& local = routine_.locals[i];
        auto* slot = b_.CreateAlloca(m_.memoryType(local.type), nullptr, local.name);
        slot->setAlignment(llvm::Align(16));
        locals_[i] = slot;
    }
    if (addresses_) fillAddresses();
}

/// Gives the debugger, and the handler that runs on top of others, the places of the locals. A loop variable can be looked at
/// before its loop: it is 0 there.
void RoutineEmitter::fillAddresses() {
    const std::vector<uint32_t> addressed = addressedLocals(routine_);
    for (uint32_t i = 0; i < addressed.size(); ++i) {
        const ir::TypeId type = routine_.locals[addressed[i]].type;
        if (module_.isScalar(type))
            b_.CreateStore(llvm::Constant::getNullValue(m_.memoryType(type)), locals_[addressed[i]]);
        b_.CreateStore(locals_[addressed[i]],
                       b_.CreateConstInBoundsGEP2_32(addresses_->getAllocatedType(), addresses_, 0, i));
    }
    abi::storeField<&rt::SteppingFrame::addresses>(b_, frame_, addresses_);
}

/// Checks that the stack suffices and fills the frame record.
void RoutineEmitter::enterFrame() {
    uint64_t bytes = 0;
    for (const ir::Local& local : routine_.locals)
        bytes += module_.size(local.type);
    llvm::Value* lowest = b_.CreatePtrToInt(frame_, b_.getInt64Ty());
    if (bytes > kLargeLocal) lowest = b_.CreateSub(lowest, b_.getInt64(bytes));
    auto* limit = b_.CreateLoad(b_.getInt64Ty(), taskField<&rt::TaskCore::stackLimit>("stackLimit"));
    limit->setMetadata(llvm::LLVMContext::MD_tbaa, m_.tags().task);
    BasicBlock *ok = newBlock("enter"), *overflow = newBlock("overflow");
    b_.CreateCondBr(b_.CreateICmpUGE(lowest, limit), ok, overflow, m_.unlikely());
    b_.SetInsertPoint(overflow);
    fillFrame();
    storeStatement(b_.getInt32(0));
    returnStatus(m_.runtime().stackOverflow.call(b_, task_, frame_));
    b_.SetInsertPoint(ok);
    fillFrame();
}

/// Everything but the statement.
void RoutineEmitter::fillFrame() {
    storeFrame<&rt::Frame::caller>(caller_);
    storeFrame<&rt::Frame::routine>(desc_);
    // The runtime counts retries here and finds out whether the routine is in its UNDO handler.
    if (routine_.errorHandler != ir::kNone || unwinding_ || routine_.stepping) markFrame(0);
    setTaskFrame(frame_);
}

/// Natives find the record of their caller in the task. It is set where the record is filled and where a handler begins, and set back
/// to the caller's wherever the routine is left.
void RoutineEmitter::setTaskFrame(Value* frame) {
    if (setsTaskFrame_) storeTaskFrame(frame);
}

void RoutineEmitter::storeTaskFrame(Value* frame) {
    b_.CreateStore(frame, taskField<&rt::TaskCore::frame>("taskFrame"))
        ->setMetadata(llvm::LLVMContext::MD_tbaa, m_.tags().task);
}

/// The key by which the runtime counts RETRYs.
void RoutineEmitter::markFrame(int32_t content) {
    storeFrame<&rt::Frame::reserved>(b_.getInt32(static_cast<uint32_t>(content)));
}

void RoutineEmitter::block(ir::BlockId id) {
    current_ = id;
    storedStmt_.reset();
    b_.SetInsertPoint(blocks_[id]);
    if (id == frameBlock_ && !frameInPrologue_) enterFrame();
    const std::vector<ir::ValueId>& insts = routine_.blocks[id].insts;
    for (size_t i = 0; i < insts.size(); ++i) {
        if (i + 1 < insts.size() && isNativeThenSafepoint(insts[i], insts[i + 1])) {
            locate(routine_.insts[insts[i]]);
            nativeCall(routine_.insts[insts[i]], insts[i], true);
            ++i;
        } else {
            instruction(insts[i]);
        }
    }
}

/// A native and the look at what it caused: one call.
bool RoutineEmitter::isNativeThenSafepoint(ir::ValueId id, ir::ValueId next) const {
    if (routine_.insts[id].op != ir::Op::CallNative) return false;
    const ir::Inst& after = routine_.insts[next];
    return after.op == ir::Op::Safepoint && after.operands.empty() && after.extra == 0 &&
           after.stmt == routine_.insts[id].stmt &&
           module_.natives[routine_.insts[id].index].nativeClass != ir::NativeClass::Const;
}

void RoutineEmitter::define(ir::ValueId id, Value* result) {
    values_[id] = result;
    if (spills_[id]) b_.CreateStore(result, spills_[id]);
}

llvm::Value* RoutineEmitter::value(ir::ValueId id) {
    if (spills_[id] && homeOf_[id] != current_)
        return b_.CreateLoad(spills_[id]->getAllocatedType(), spills_[id]);
    return values_[id];
}

void RoutineEmitter::locate(const ir::Inst& inst) {
    if (m_.debug()) b_.SetCurrentDebugLocation(m_.debug()->location(routine_, inst.stmt));
}

void RoutineEmitter::instruction(ir::ValueId id) {
    const ir::Inst& inst = routine_.insts[id];
    locate(inst);
    switch (ir::familyOf(inst.op)) {
    case ir::Family::Leaf: return define(id, leaf(inst));
    case ir::Family::Memory: return memory(inst, id);
    case ir::Family::Float: return define(id, floatArithmetic(inst));
    case ir::Family::Int: return define(id, intArithmetic(inst));
    case ir::Family::Compare: return define(id, comparison(inst));
    case ir::Family::Logic: return define(id, logic(inst));
    case ir::Family::Convert: return define(id, conversion(inst));
    case ir::Family::Action: return action(inst, id);
    case ir::Family::End: return terminator(inst);
    }
}

void RoutineEmitter::action(const ir::Inst& inst, ir::ValueId id) {
    switch (ir::as<ir::ActionOp>(inst.op)) {
    case ir::ActionOp::Check: return check(inst, operand(inst, 0));
    case ir::ActionOp::CheckFinite: return check(inst, isFinite(operand(inst, 0)));
    case ir::ActionOp::Call: return call(inst, id);
    case ir::ActionOp::CallNative: return nativeCall(inst, id, false);
    case ir::ActionOp::Charge: return charge(inst);
    case ir::ActionOp::Safepoint: return safepoint(inst);
    case ir::ActionOp::Step: return step(inst);
    case ir::ActionOp::Stmt: return; // its number travels with the instructions
    }
}

void RoutineEmitter::terminator(const ir::Inst& inst) {
    if (entersRetried(routine_, current_, beginsRetried_)) markFrame(0);
    switch (ir::as<ir::EndOp>(inst.op)) {
    case ir::EndOp::Br:
        if (entersFastLoop()) return;
        b_.CreateBr(blockOf(inst.target(0)));
        return;
    case ir::EndOp::CondBr:
        b_.CreateCondBr(operand(inst, 0), blockOf(inst.target(0)), blockOf(inst.target(1)),
                        inst.extra == 1 ? m_.unlikely() : nullptr);
        return;
    case ir::EndOp::Switch: return switchOn(inst);
    case ir::EndOp::Ret: return ret(inst);
    case ir::EndOp::Raise: return raise(inst);
    case ir::EndOp::Propagate: return handlerCall(inst, m_.runtime().propagate);
    case ir::EndOp::HandlerEnd: return handlerCall(inst, m_.runtime().handlerEnd);
    case ir::EndOp::Retry: return retry(inst);
    case ir::EndOp::TryNext: return tryNext(inst);
    case ir::EndOp::Unreachable: b_.CreateUnreachable(); return;
    }
}

void RoutineEmitter::switchOn(const ir::Inst& inst) {
    const std::vector<ir::SwitchCase>& cases = routine_.caseLists[inst.index];
    auto* branch =
        b_.CreateSwitch(operand(inst, 0), blockOf(inst.target(0)), static_cast<unsigned>(cases.size()));
    for (const ir::SwitchCase& entry : cases)
        branch->addCase(b_.getInt32(static_cast<uint32_t>(entry.value)), blockOf(entry.target));
}

void RoutineEmitter::ret(const ir::Inst& inst) {
    if (inUndo()) {
        returnStatus(b_.CreateLoad(b_.getInt32Ty(), unwinding_));
        return;
    }
    llvm::Value* ok = statusValue(rt::kOk);
    // No result, or the end of what nothing reaches.
    if (inst.operands.empty() || !function_->getReturnType()->isStructTy()) return returnStatus(ok);
    setTaskFrame(caller_);
    llvm::Value* both = llvm::PoisonValue::get(function_->getReturnType());
    both = b_.CreateInsertValue(both, ok, 0);
    b_.CreateRet(b_.CreateInsertValue(both, operand(inst, 0), 1));
}

void RoutineEmitter::returnStatus(Value* status) {
    setTaskFrame(caller_);
    if (!function_->getReturnType()->isStructTy()) {
        b_.CreateRet(status);
        return;
    }
    llvm::Value* both = llvm::PoisonValue::get(function_->getReturnType());
    b_.CreateRet(b_.CreateInsertValue(both, status, 0));
}

} // namespace codegen
