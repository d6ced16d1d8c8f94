// Calls of routines and natives, safepoints.

#include <llvm/ADT/StringSwitch.h>
#include <llvm/IR/Intrinsics.h>

#include "codegen/hot_code.h"
#include "codegen/routine_emitter.h"

namespace codegen {
namespace {

/// Functions whose result IEEE 754 fixes to the last bit: the instruction gives the same as the library.
llvm::Intrinsic::ID exactIntrinsic(llvm::StringRef symbol) {
    return llvm::StringSwitch<llvm::Intrinsic::ID>(symbol)
        .Cases("sqrt", "sqrtf", llvm::Intrinsic::sqrt)
        .Cases("fabs", "fabsf", llvm::Intrinsic::fabs)
        .Cases("floor", "floorf", llvm::Intrinsic::floor)
        .Cases("ceil", "ceilf", llvm::Intrinsic::ceil)
        .Cases("trunc", "truncf", llvm::Intrinsic::trunc)
        .Cases("rint", "rintf", llvm::Intrinsic::rint)
        .Default(llvm::Intrinsic::not_intrinsic);
}

/// Optional parameters without argument, and switches that are off.
std::vector<bool> absentArguments(const std::vector<llvm::Value*>& arguments) {
    std::vector<bool> absent;
    for (const llvm::Value* argument : arguments) {
        const auto* constant = llvm::dyn_cast<llvm::Constant>(argument);
        absent.push_back(constant != nullptr && constant->isNullValue() &&
                         !constant->getType()->isFloatingPointTy());
    }
    return absent;
}

} // namespace

llvm::Value* RoutineEmitter::stmtNumber(const ir::Inst& inst) const {
    // kNone becomes -1: no statement.
    return llvm::ConstantInt::getSigned(llvm::Type::getInt32Ty(m_.context()),
                                        static_cast<int32_t>(inst.stmt));
}

void RoutineEmitter::storeStatement(Value* stmt) {
    storeFrame<&rt::Frame::statement>(stmt);
}

/// Stores the statement before a call, unless the call before it in this block did.
void RoutineEmitter::noteStatement(const ir::Inst& inst) {
    if (storedStmt_ == inst.stmt) return;
    storeStatement(stmtNumber(inst));
    storedStmt_ = inst.stmt;
}

void RoutineEmitter::call(const ir::Inst& inst, ir::ValueId id) {
    const ir::Routine& callee = module_.routines[inst.index];
    std::vector<Value*> args{task_, frame_};
    for (ir::ValueId operandId : inst.operands)
        args.push_back(value(operandId));
    noteStatement(inst);
    llvm::CallInst* result = b_.CreateCall(m_.callee(b_, inst.index), args);
    result->setCallingConv(llvm::CallingConv::Fast);
    result->setDoesNotThrow();
    if (!isHot() && callee.insts.size() > kInlinedAnywhere) result->setIsNoInline();
    bool byValue = callee.result != ir::kVoid && module_.isScalar(callee.result);
    continueIfOk(inst, byValue ? b_.CreateExtractValue(result, 0) : result);
    if (byValue) define(id, b_.CreateExtractValue(result, 1));
}

void RoutineEmitter::nativeCall(const ir::Inst& inst, ir::ValueId id, bool thenSafepoint) {
    const ir::Native& native = module_.natives[inst.index];
    if (native.nativeClass == ir::NativeClass::Const) return constNative(inst, id);
    std::vector<Value*> args{task_};
    bool byValue = native.result != ir::kVoid && module_.isScalar(native.result);
    llvm::AllocaInst* slot = nullptr;
    if (byValue) args.push_back(slot = resultSlot(native.result));
    size_t hidden = !byValue && native.result != ir::kVoid ? 1 : 0;
    for (size_t i = 0; i < inst.operands.size(); ++i) {
        Value* argument = operand(inst, i);
        if (i >= hidden && native.params[i - hidden] == ir::kBool)
            argument = b_.CreateZExt(argument, b_.getInt8Ty());
        args.push_back(argument);
    }
    if (callsChecked(native)) {
        const std::vector<bool> absent = absentArguments(args);
        std::vector<Value*> passed{task_, stmtNumber(inst)};
        for (size_t i = 1; i < args.size(); ++i)
            if (!absent[i]) passed.push_back(args[i]);
        llvm::CallInst* status = b_.CreateCall(m_.checkedNative(inst.index, thenSafepoint, absent), passed);
        status->setCallingConv(llvm::CallingConv::Fast);
        continueIfOk(inst, status);
        storedStmt_ = inst.stmt;
    } else {
        if (!m_.isSelfContained(native)) noteStatement(inst);
        BasicBlock* again = newBlock("native");
        b_.CreateBr(again);
        b_.SetInsertPoint(again);
        continueIfNativeOk(inst, b_.CreateCall(m_.nativeFunction(inst.index), args), again);
        if (thenSafepoint) checkBudget(inst, budgetLeft());
    }
    if (byValue) define(id, load(native.result, slot));
}

/// Whether a function of the module calls the native and looks after its errors: where the body is not inlined, and where
/// the statement is not to be executed again from its start.
bool RoutineEmitter::callsChecked(const ir::Native& native) const {
    if (routine_.stepping && !inUndo()) return false;
    return !m_.options().optimise || !isHot() || !m_.isSelfContained(native);
}

/// Whether the place that is being compiled may be executed often enough to be worth more code: a loop, or a routine so short that
/// others may call it in theirs.
bool RoutineEmitter::isHot() const {
    return isShort(routine_) || inLoop_[current_];
}

/// One slot for each type is enough: the result is taken out at once.
llvm::AllocaInst* RoutineEmitter::resultSlot(ir::TypeId type) {
    if (!resultSlots_[type]) {
        llvm::BasicBlock& entry = function_->getEntryBlock();
        llvm::IRBuilder<> b(&entry, entry.begin());
        resultSlots_[type] = b.CreateAlloca(m_.memoryType(type), nullptr, "native.result");
    }
    return resultSlots_[type];
}

void RoutineEmitter::constNative(const ir::Inst& inst, ir::ValueId id) {
    const ir::Native& native = module_.natives[inst.index];
    bool isFloat = native.result == ir::kF32 || native.result == ir::kF64;
    llvm::Intrinsic::ID intrinsic = exactIntrinsic(native.symbol);
    if (isFloat && intrinsic != llvm::Intrinsic::not_intrinsic && inst.operands.size() == 1 &&
        native.params[0] == native.result) {
        define(id, b_.CreateUnaryIntrinsic(intrinsic, operand(inst, 0)));
        return;
    }
    std::vector<Value*> args;
    for (size_t i = 0; i < inst.operands.size(); ++i) {
        Value* argument = operand(inst, i);
        if (native.params[i] == ir::kBool) argument = b_.CreateZExt(argument, b_.getInt8Ty());
        args.push_back(argument);
    }
    Value* result = b_.CreateCall(m_.nativeFunction(inst.index), args);
    if (native.result == ir::kBool) result = b_.CreateICmpNE(result, b_.getInt8(0));
    define(id, result);
}

llvm::Value* RoutineEmitter::budgetLeft() {
    return loadTask<&rt::TaskCore::budget>("budget");
}

/// Takes the cost from the budget; returns what is left.
llvm::Value* RoutineEmitter::pay(Value* cost) {
    Value* after = b_.CreateSub(budgetLeft(), cost);
    Value* budget = taskField<&rt::TaskCore::budget>("budget");
    b_.CreateStore(after, budget)->setMetadata(llvm::LLVMContext::MD_tbaa, m_.tags().task);
    return after;
}

/// Without a look at the budget. While one is due, the cost is for the time after it.
void RoutineEmitter::charge(const ir::Inst& inst) {
    Value* cost = costOf(inst);
    BasicBlock *now = newBlock("now"), *later = newBlock("later"), *charged = newBlock("charged");
    b_.CreateCondBr(b_.CreateICmpSGE(budgetLeft(), b_.getInt64(0)), now, later, m_.unlikely());
    b_.SetInsertPoint(later);
    m_.runtime().chargeLater.call(b_, task_, cost);
    b_.CreateBr(charged);
    b_.SetInsertPoint(now);
    pay(cost);
    b_.CreateBr(charged);
    b_.SetInsertPoint(charged);
}

/// Of a charge or a safepoint.
llvm::Value* RoutineEmitter::costOf(const ir::Inst& inst) {
    Value* cost = llvm::ConstantInt::getSigned(b_.getInt64Ty(), inst.extra);
    return inst.operands.empty() ? cost : b_.CreateAdd(cost, operand(inst, 0));
}

void RoutineEmitter::safepoint(const ir::Inst& inst) {
    const bool isFree = inst.operands.empty() && inst.extra == 0;
    checkBudget(inst, isFree ? budgetLeft() : pay(costOf(inst)));
}

/// Calls the runtime when the budget is used up.
void RoutineEmitter::checkBudget(const ir::Inst& inst, Value* left) {
    BasicBlock *go = newBlock("go"), *slow = newBlock("safepoint");
    b_.CreateCondBr(b_.CreateICmpSGE(left, b_.getInt64(0)), go, slow, m_.unlikely());
    b_.SetInsertPoint(slow);
    llvm::CallInst* outcome =
        m_.runtime().safepointSlow.call(b_, task_, frame_, caller_, desc_, stmtNumber(inst));
    outcome->setCallingConv(llvm::CallingConv::PreserveAll);
    ErrorJoin& leave = leaveJoin();
    BasicBlock* target = joinFrom(leave, outcome);
    b_.CreateCondBr(b_.CreateICmpEQ(outcome, statusValue(rt::kOk)), go, target, m_.unlikely());
    b_.SetInsertPoint(go);
    storedStmt_.reset(); // the slow path stores its own
}

/// If a debugger is attached, ask it which statement to execute next; usually it is this one. As a rule none is attached.
void RoutineEmitter::step(const ir::Inst& inst) {
    Value* here = b_.getInt32(inst.index);
    storeStatement(here);
    Value* after = budgetLeft();
    Value* asked = b_.CreateLoad(abi::typeOf<abi::TypeOf<&rt::TaskCore::askSteps>>(m_.context()),
                                 taskField<&rt::TaskCore::askSteps>("askSteps"));
    BasicBlock *go = newBlock("go"), *ask = newBlock("ask");
    Value* mayGo = b_.CreateAnd(b_.CreateICmpSGE(after, llvm::ConstantInt::get(b_.getInt64Ty(), 0)),
                                b_.CreateICmpEQ(asked, b_.getInt32(0)));
    b_.CreateCondBr(mayGo, go, ask, m_.unlikely());
    b_.SetInsertPoint(ask);
    Value* wanted = m_.runtime().step.call(b_, task_, frame_);
    BasicBlock* elsewhere = joinFrom(makeJoin(steps_, "step"), wanted);
    b_.CreateCondBr(b_.CreateICmpEQ(wanted, here), go, elsewhere, m_.unlikely());
    b_.SetInsertPoint(go);
    storedStmt_ = inst.index;
}

} // namespace codegen
