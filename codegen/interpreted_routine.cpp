#include "codegen/interpreted_routine.h"

#include <llvm/IR/IRBuilder.h>

#include <algorithm>
#include <utility>

#include "codegen/abi_row.h"
#include "codegen/module_emitter.h"
#include "codegen/paced_routines.h"
#include "codegen/routine_words.h"

namespace codegen {
namespace {

/// IR instructions from which on a routine is interpreted: any, and one that waits for natives most of the time.
constexpr size_t kHuge = 60'000, kLong = 4'000;

class InterpretedRoutine {
  public:
    InterpretedRoutine(ModuleEmitter& module, uint32_t index)
        : m_(module), module_(module.source()), index_(index), routine_(module_.routines[index]),
          function_(module.routine(index)), b_(module.context()), addressed_(addressedLocals(routine_)),
          words_(WordWriter(module_, routine_, addressed_.size()).run()) {}

    void emit() {
        if (m_.debug()) {
            m_.debug()->attach(routine_, *function_);
            b_.SetCurrentDebugLocation(m_.debug()->location(routine_, ir::kNone));
        }
        b_.SetInsertPoint(block("entry"));
        auto* frame = b_.CreateAlloca(abi::structType<rt::SteppingFrame>(m_.context()), nullptr, "frame");
        auto* memory = b_.CreateAlloca(llvm::ArrayType::get(b_.getInt8Ty(), std::max(words_.bytes, 8U)),
                                       nullptr, "memory");
        memory->setAlignment(llvm::Align(16));
        llvm::Value* const task = function_->getArg(0);
        abi::storeField<&rt::Frame::caller>(b_, frame, function_->getArg(1));
        abi::storeField<&rt::Frame::routine>(b_, frame, m_.routineDesc(index_));
        checkStack(task, frame, memory);
        const bool inMemory = !module_.isScalar(routine_.result);
        for (unsigned i = 0; i < routine_.params.size(); ++i)
            b_.CreateStore(inSlot(function_->getArg((inMemory ? 3 : 2) + i)),
                           b_.CreateConstInBoundsGEP1_64(b_.getInt64Ty(), memory, i));
        const bool byValue = !inMemory && routine_.result != ir::kVoid;
        llvm::Value* result = llvm::ConstantPointerNull::get(b_.getPtrTy());
        if (inMemory) result = function_->getArg(2);
        if (byValue) {
            llvm::IRBuilder<> first(&function_->getEntryBlock(), function_->getEntryBlock().begin());
            result = first.CreateAlloca(b_.getInt64Ty(), nullptr, "result");
            b_.CreateStore(b_.getInt64(0), result);
        }
        llvm::CallInst* status = interpreter().call(b_, task, frame, code(), memory, result);
        leave(status, byValue ? result : nullptr);
    }

  private:
    using Value = llvm::Value;

    llvm::BasicBlock* block(const char* name) {
        return llvm::BasicBlock::Create(m_.context(), name, function_);
    }

    /// As slots hold it: Bool and integers in 64 bits.
    Value* inSlot(Value* value) {
        if (!value->getType()->isIntegerTy()) return value;
        return value->getType()->isIntegerTy(1) ? b_.CreateZExt(value, b_.getInt64Ty())
                                                : b_.CreateSExt(value, b_.getInt64Ty());
    }

    /// Memory below the frame record counts, too: it may be large.
    void checkStack(Value* task, Value* frame, Value* memory) {
        auto* limit = b_.CreateLoad(
            b_.getInt64Ty(),
            b_.CreateConstInBoundsGEP1_64(b_.getInt8Ty(), task, abi::kOffsetOf<&rt::TaskCore::stackLimit>));
        llvm::BasicBlock *enough = block("enough"), *overflow = block("overflow");
        b_.CreateCondBr(b_.CreateICmpUGE(b_.CreatePtrToInt(memory, b_.getInt64Ty()), limit), enough, overflow,
                        m_.unlikely());
        b_.SetInsertPoint(overflow);
        abi::storeField<&rt::Frame::statement>(b_, frame, b_.getInt32(0));
        abi::storeField<&rt::Frame::reserved>(b_, frame, b_.getInt32(0));
        setTaskFrame(task, frame);
        Value* const status = m_.runtime().stackOverflow.call(b_, task, frame);
        setTaskFrame(task, function_->getArg(1));
        leave(status, nullptr);
        b_.SetInsertPoint(enough);
    }

    void setTaskFrame(Value* task, Value* frame) {
        if (m_.setsTaskFrame(index_))
            b_.CreateStore(frame, b_.CreateConstInBoundsGEP1_64(b_.getInt8Ty(), task,
                                                                abi::kOffsetOf<&rt::TaskCore::frame>));
    }

    /// `result`: where a scalar one lies.
    void leave(Value* status, Value* result) {
        if (!function_->getReturnType()->isStructTy()) {
            b_.CreateRet(status);
            return;
        }
        Value* both = llvm::PoisonValue::get(function_->getReturnType());
        both = b_.CreateInsertValue(both, status, 0);
        if (result) both = b_.CreateInsertValue(both, fromMemory(routine_.result, result), 1);
        b_.CreateRet(both);
    }

    Value* fromMemory(ir::TypeId type, Value* place) {
        Value* const value = b_.CreateLoad(m_.memoryType(type), place);
        return type == ir::kBool ? b_.CreateICmpNE(value, b_.getInt8(0)) : value;
    }

    abi::Callee<decltype(rt_interpret)> interpreter() {
        if (llvm::Function* known = m_.target().getFunction("rt_interpret"))
            return abi::Callee<decltype(rt_interpret)>(known);
        return RAPIDC_DECLARE_RUNTIME(m_.target(), rt_interpret);
    }

    // ---- tables ----

    llvm::GlobalVariable* constant(llvm::Constant* value, const char* name) {
        return new llvm::GlobalVariable(m_.target(), value->getType(), true,
                                        llvm::GlobalValue::PrivateLinkage, value, name);
    }
    llvm::Constant* numbers(std::vector<uint32_t> values, const char* name) {
        constexpr size_t kWorthHolding = size_t{1} << 14;
        if (values.empty()) return llvm::ConstantPointerNull::get(b_.getPtrTy());
        if (const HoldTable& hold = m_.options().holdTable; hold && values.size() > kWorthHolding) {
            const auto place = reinterpret_cast<uintptr_t>(hold(std::move(values)));
            return llvm::ConstantExpr::getIntToPtr(b_.getInt64(place), b_.getPtrTy());
        }
        // As a text: LLVM writes that in one piece, and other arrays number by number.
        const llvm::StringRef bytes(reinterpret_cast<const char*>(values.data()),
                                    values.size() * sizeof(uint32_t));
        llvm::GlobalVariable* const global =
            constant(llvm::ConstantDataArray::getString(m_.context(), bytes, false), name);
        global->setAlignment(llvm::Align(alignof(uint32_t)));
        return global;
    }

    llvm::Constant* code() {
        std::vector<uint32_t> addressed;
        for (const uint32_t local : addressed_) {
            const ir::TypeId type = routine_.locals[local].type;
            addressed.push_back(words_.places[local]);
            addressed.push_back(module_.isScalar(type) ? module_.size(type) : 0);
        }
        static_assert(sizeof(rt::AddressedLocal) == 2 * sizeof(uint32_t));
        std::vector<llvm::Constant*> pointers;
        for (const WordPointer& pointer : words_.pointers)
            pointers.push_back(address(pointer));
        if (pointers.empty()) pointers.push_back(llvm::ConstantPointerNull::get(b_.getPtrTy()));
        auto* const table =
            constant(llvm::ConstantArray::get(llvm::ArrayType::get(b_.getPtrTy(), pointers.size()), pointers),
                     "pointers");
        using Code = rt::InterpretedCode;
        return constant(abi::Row<Code>(m_.context())
                            .set<&Code::words>(numbers(std::move(words_.words), "words"))
                            .set<&Code::pointers>(table)
                            .set<&Code::routine>(static_cast<llvm::Constant*>(m_.routineDesc(index_)))
                            .set<&Code::starts>(numbers(std::move(words_.starts), "starts"))
                            .set<&Code::nexts>(numbers(std::move(words_.nexts), "nexts"))
                            .set<&Code::addressed>(numbers(std::move(addressed), "addressed"))
                            .set<&Code::addressedCount>(addressed_.size())
                            .set<&Code::addressTable>(words_.addressTable)
                            .set<&Code::arguments>(words_.arguments)
                            .set<&Code::errorHandler>(words_.errorHandler)
                            .set<&Code::undoHandler>(words_.undoHandler)
                            .set<&Code::setsTaskFrame>(m_.setsTaskFrame(index_))
                            .finish(),
                        "code");
    }

    llvm::Constant* address(const WordPointer& pointer) {
        switch (pointer.kind) {
        case WordPointer::Kind::Global: return m_.global(pointer.index);
        case WordPointer::Kind::TypeDesc: return m_.typeDesc(pointer.index);
        case WordPointer::Kind::RoutineEntry: return m_.cEntry(pointer.index);
        case WordPointer::Kind::CallRoutine: return routineCaller(pointer.index);
        case WordPointer::Kind::CallNative: return nativeCaller(pointer.index);
        }
        return nullptr;
    }

    // ---- functions that take arguments out of slots ----

    llvm::Function* caller(const std::string& name) {
        const std::string symbol = "slots." + name;
        if (llvm::Function* known = m_.target().getFunction(symbol)) return known;
        llvm::Function* function =
            abi::makeFunction<rt::InterpretedCall>(m_.target(), llvm::GlobalValue::InternalLinkage, symbol)
                .function();
        function->setDoesNotThrow();
        return function;
    }

    static Value* argument(llvm::IRBuilder<>& b, llvm::Function* function, size_t i, llvm::Type* type) {
        return b.CreateLoad(type, b.CreateConstInBoundsGEP1_64(b.getInt64Ty(), function->getArg(2), i));
    }

    llvm::Constant* routineCaller(uint32_t index) {
        const ir::Routine& callee = module_.routines[index];
        llvm::Function* const function = caller(callee.name);
        if (!function->empty()) return function;
        llvm::IRBuilder<> b(llvm::BasicBlock::Create(m_.context(), "", function));
        const bool inMemory = !module_.isScalar(callee.result);
        std::vector<Value*> args{function->getArg(0), function->getArg(1)};
        size_t next = 0;
        if (inMemory) args.push_back(argument(b, function, next++, b.getPtrTy()));
        for (const ir::Param& param : callee.params) {
            Value* value = argument(b, function, next++, m_.memoryType(param.type));
            if (param.type == ir::kBool) value = b.CreateICmpNE(value, b.getInt8(0));
            args.push_back(value);
        }
        llvm::CallInst* const call = b.CreateCall(m_.callee(b, index), args);
        call->setCallingConv(llvm::CallingConv::Fast);
        call->setIsNoInline(); // no place in the source is known here
        if (inMemory || callee.result == ir::kVoid) {
            b.CreateRet(call);
            return function;
        }
        Value* value = b.CreateFreeze(b.CreateExtractValue(call, 1));
        if (callee.result == ir::kBool) value = b.CreateZExt(value, b.getInt8Ty());
        b.CreateStore(value, function->getArg(3));
        b.CreateRet(b.CreateExtractValue(call, 0));
        return function;
    }

    llvm::Constant* nativeCaller(uint32_t index) {
        const ir::Native& native = module_.natives[index];
        llvm::Function* const function = caller(native.symbol);
        if (!function->empty()) return function;
        llvm::IRBuilder<> b(llvm::BasicBlock::Create(m_.context(), "", function));
        llvm::Function* const target = m_.nativeFunction(index);
        const bool isConst = native.nativeClass == ir::NativeClass::Const;
        const bool byValue = native.result != ir::kVoid && module_.isScalar(native.result);
        std::vector<Value*> args;
        if (!isConst) args.push_back(function->getArg(0));
        if (!isConst && byValue) args.push_back(function->getArg(3));
        for (size_t next = 0; args.size() < target->arg_size(); ++next)
            args.push_back(
                argument(b, function, next, target->getArg(static_cast<unsigned>(args.size()))->getType()));
        llvm::CallInst* const call = b.CreateCall(target, args);
        if (!isConst) {
            b.CreateRet(call);
            return function;
        }
        b.CreateStore(call, function->getArg(3));
        b.CreateRet(b.getInt32(rt::kOk));
        return function;
    }

    ModuleEmitter& m_;
    const ir::Module& module_;
    uint32_t index_;
    const ir::Routine& routine_;
    llvm::Function* function_;
    llvm::IRBuilder<> b_;
    const std::vector<uint32_t> addressed_;
    RoutineWords words_;
};

} // namespace

bool isInterpreted(const ir::Module& module, const ir::Routine& routine, const CodegenOptions& options) {
    if (routine.isDetachedHandler) return false;
    const size_t size = routine.insts.size();
    const auto fits = [&] {
        return std::all_of(routine.insts.begin(), routine.insts.end(),
                           [](const ir::Inst& inst) { return inst.operands.size() <= rt::kMostWordCount; });
    };
    if (options.interpretsAll || size >= kHuge) return fits();
    return size >= kLong && isPacedByNatives(module, routine, options.bodies) && fits();
}

void emitInterpreted(ModuleEmitter& module, uint32_t index) {
    InterpretedRoutine(module, index).emit();
}

} // namespace codegen
