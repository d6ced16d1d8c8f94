// Natives as routines call them: a function of the module calls the native, reports its error and looks after the budget, so
// that a call costs the routine one comparison.

#include "codegen/module_emitter.h"

namespace codegen {

/// Emits such a function: its parameters are the task, the statement, then those of the native that are not absent.
class CheckedNative {
  public:
    CheckedNative(ModuleEmitter& module, llvm::Function* native, llvm::Function* function,
                  const std::vector<bool>& absent)
        : m_(module), native_(native), function_(function), absent_(absent), b_(module.context()) {}

    void emit(bool thenSafepoint) {
        llvm::BasicBlock *entry = block("entry"), *attempt = block("attempt"), *failed = block("failed"),
                         *leave = block("leave"), *done = block("done");
        b_.SetInsertPoint(entry);
        abi::storeField<&rt::Frame::statement>(b_, frame(), function_->getArg(1));
        b_.CreateBr(attempt);
        b_.SetInsertPoint(attempt);
        llvm::Value* status = callNative();
        b_.CreateCondBr(isStatus(status, rt::kOk), done, failed, m_.unlikely());
        b_.SetInsertPoint(failed);
        llvm::Value* outcome = m_.runtime().nativeFailed.call(b_, task(), frame(), status);
        b_.CreateCondBr(isStatus(outcome, rt::kAgain), attempt, leave);
        b_.SetInsertPoint(leave);
        b_.CreateRet(outcome);
        b_.SetInsertPoint(done);
        if (thenSafepoint) checkBudget();
        b_.CreateRet(b_.getInt32(rt::kOk));
    }

  private:
    llvm::BasicBlock* block(const char* name) {
        return llvm::BasicBlock::Create(m_.context(), name, function_);
    }
    llvm::Value* task() { return function_->getArg(0); }
    llvm::Value* frame() {
        return b_.CreateLoad(
            b_.getPtrTy(),
            b_.CreateConstInBoundsGEP1_64(b_.getInt8Ty(), task(), abi::kOffsetOf<&rt::TaskCore::frame>));
    }
    llvm::Value* isStatus(llvm::Value* status, rt::Status value) {
        return b_.CreateICmpEQ(status, b_.getInt32(static_cast<uint32_t>(value)));
    }

    llvm::Value* callNative() {
        std::vector<llvm::Value*> arguments{task()};
        unsigned next = 2;
        for (size_t i = 1; i < absent_.size(); ++i)
            arguments.push_back(absent_[i] ? static_cast<llvm::Value*>(llvm::Constant::getNullValue(
                                                 native_->getArg(static_cast<unsigned>(i))->getType()))
                                           : function_->getArg(next++));
        return b_.CreateCall(native_, arguments);
    }

    /// Delivers the interrupts that the native caused before the next statement.
    void checkBudget() {
        llvm::BasicBlock *enough = block("enough"), *used = block("used");
        static_assert(abi::kOffsetOf<&rt::TaskCore::budget> == 0);
        llvm::Value* budget = b_.CreateLoad(b_.getInt64Ty(), task());
        b_.CreateCondBr(b_.CreateICmpSGE(budget, b_.getInt64(0)), enough, used, m_.unlikely());
        b_.SetInsertPoint(used);
        b_.CreateRet(m_.runtime().safepoint.call(b_, task(), frame()));
        b_.SetInsertPoint(enough);
    }

    ModuleEmitter& m_;
    llvm::Function* native_;
    llvm::Function* function_;
    const std::vector<bool>& absent_;
    llvm::IRBuilder<> b_;
};

llvm::Function* ModuleEmitter::checkedNative(uint32_t index, bool thenSafepoint,
                                             const std::vector<bool>& absent) {
    llvm::Function*& function = checkedNatives_[{index, thenSafepoint, absent}];
    if (function) return function;
    llvm::Function* native = nativeFunction(index);
    std::vector<llvm::Type*> params{ptr_, i32_};
    for (unsigned i = 1; i < native->arg_size(); ++i)
        if (!absent[i]) params.push_back(native->getArg(i)->getType());
    function = llvm::Function::Create(
        llvm::FunctionType::get(i32_, params, false), llvm::GlobalValue::InternalLinkage,
        (thenSafepoint ? "step." : "try.") + module_.natives[index].symbol, *target_);
    function->setCallingConv(llvm::CallingConv::Fast);
    function->setDoesNotThrow();
    function->addFnAttr(llvm::Attribute::NoInline);
    CheckedNative(*this, native, function, absent).emit(thenSafepoint);
    return function;
}

} // namespace codegen
