// Addresses, loads, stores, copies.

#include <llvm/IR/Intrinsics.h>

#include "codegen/routine_emitter.h"
#include "ir/core/op_info.h"

namespace codegen {

using ir::Op;

bool RoutineEmitter::memory(const ir::Inst& inst, ir::ValueId id) {
    switch (inst.op) {
    case Op::ParamVal: {
        unsigned first = result_ ? 3 : 2;
        define(id, function_->getArg(first + inst.index));
        return true;
    }
    case Op::LocalAddr:
    case Op::GlobalAddr:
    case Op::TypeDescAddr:
    case Op::RoutineAddr:
    case Op::ResultAddr:
    case Op::FieldAddr:
    case Op::ElemAddr: define(id, addressOf(inst)); return true;
    case Op::Sysvar: {
        bool intno = inst.extra == static_cast<int32_t>(ir::SysvarKind::Intno);
        define(id, intno ? loadTask<&rt::TaskCore::interruptNumber>("intno")
                         : loadTask<&rt::TaskCore::errorNumber>("errno"));
        return true;
    }
    case Op::Load: define(id, load(inst.type, operand(inst, 0))); return true;
    case Op::Store: store(inst.type, operand(inst, 0), operand(inst, 1)); return true;
    case Op::Copy: copy(inst); return true;
    case Op::CopyDynamic:
        b_.CreateMemMove(operand(inst, 0), llvm::Align(1), operand(inst, 1), llvm::Align(1),
                         operand(inst, 2));
        return true;
    case Op::StackAlloc: define(id, stackAlloc(inst)); return true;
    case Op::Zero:
        if (module_.isScalar(inst.type))
            store(inst.type, llvm::Constant::getNullValue(m_.valueType(inst.type)), operand(inst, 0));
        else
            b_.CreateMemSet(operand(inst, 0), b_.getInt8(0), module_.size(inst.type),
                            llvm::Align(module_.align(inst.type)));
        return true;
    default: return false;
    }
}

llvm::Value* RoutineEmitter::byteOffset(Value* pointer, Value* offset) {
    return b_.CreateInBoundsGEP(b_.getInt8Ty(), pointer, offset);
}

llvm::Value* RoutineEmitter::addressOf(const ir::Inst& inst) {
    switch (inst.op) {
    case Op::LocalAddr: return locals_[inst.index];
    case Op::GlobalAddr: return m_.global(inst.index);
    case Op::TypeDescAddr: return m_.typeDesc(inst.index);
    case Op::RoutineAddr: return m_.cEntry(inst.index);
    case Op::ResultAddr: return result_;
    case Op::FieldAddr: {
        uint32_t offset = module_.fieldOffset(inst.type, inst.index);
        Value* base = operand(inst, 0);
        return offset ? byteOffset(base, b_.getInt64(offset)) : base;
    }
    default: {
        Value* index = b_.CreateSExt(operand(inst, 1), b_.getInt64Ty());
        return b_.CreateInBoundsGEP(m_.memoryType(inst.type), operand(inst, 0), index);
    }
    }
}

llvm::Value* RoutineEmitter::load(ir::TypeId type, Value* pointer) {
    auto* read = b_.CreateAlignedLoad(m_.memoryType(type), pointer, llvm::Align(module_.align(type)));
    read->setMetadata(llvm::LLVMContext::MD_tbaa, m_.tags().data[type]);
    if (type != ir::kBool) return read;
    return b_.CreateICmpNE(read, b_.getInt8(0));
}

void RoutineEmitter::store(ir::TypeId type, Value* content, Value* pointer) {
    if (type == ir::kBool) content = b_.CreateZExt(content, b_.getInt8Ty());
    auto* write = b_.CreateAlignedStore(content, pointer, llvm::Align(module_.align(type)));
    write->setMetadata(llvm::LLVMContext::MD_tbaa, m_.tags().data[type]);
}

/// Memory of a size known only now: it has to fit above the stack's limit.
llvm::Value* RoutineEmitter::stackAlloc(const ir::Inst& inst) {
    llvm::Type* i64 = b_.getInt64Ty();
    Value* bytes = operand(inst, 0);
    Value* top = b_.CreatePtrToInt(b_.CreateStackSave(), i64);
    auto* limit = b_.CreateLoad(i64, taskField<&rt::TaskCore::stackLimit>("stackLimit"));
    limit->setMetadata(llvm::LLVMContext::MD_tbaa, m_.tags().task);
    // Unsigned and without wrapping: the distance to the limit, 0 when it has been passed.
    Value* room = b_.CreateBinaryIntrinsic(llvm::Intrinsic::usub_sat, top, limit);
    BasicBlock *fits = newBlock("fits"), *overflow = newBlock("overflow");
    b_.CreateCondBr(b_.CreateICmpULE(bytes, room), fits, overflow, m_.unlikely());
    b_.SetInsertPoint(overflow);
    fillFrame();
    storeStatement(stmtNumber(inst));
    Value* status = m_.runtime().stackOverflow.call(b_, task_, frame_);
    b_.CreateBr(joinFrom(leaveJoin(), status));
    b_.SetInsertPoint(fits);
    auto* memory = b_.CreateAlloca(b_.getInt8Ty(), bytes);
    memory->setAlignment(llvm::Align(8));
    return memory;
}

void RoutineEmitter::copy(const ir::Inst& inst) {
    if (module_.isScalar(inst.type)) {
        store(inst.type, load(inst.type, operand(inst, 1)), operand(inst, 0));
        return;
    }
    llvm::Align align(module_.align(inst.type));
    b_.CreateMemCpy(operand(inst, 0), align, operand(inst, 1), align, module_.size(inst.type));
}

} // namespace codegen
