// Addresses, loads, stores, copies.

#include <llvm/IR/Intrinsics.h>

#include "codegen/routine_emitter.h"
#include "ir/core/op_info.h"

namespace codegen {

namespace {

using Scalar = RoutineEmitter::Scalar;

/// Records with more are copied in one piece.
constexpr size_t kMostScalars = 16;

/// False: there are too many, or some are arrays or strings.
bool scalarsOf(const ir::Module& module, ir::TypeId type, uint32_t offset, std::vector<Scalar>& out) {
    if (module.isScalar(type)) {
        out.push_back({type, offset});
        return out.size() <= kMostScalars;
    }
    if (module.types[type].kind != ir::TypeKind::Record) return false;
    for (uint32_t i = 0; i < module.types[type].fields.size(); ++i)
        if (!scalarsOf(module, module.types[type].fields[i].type, offset + module.fieldOffset(type, i), out))
            return false;
    return true;
}

} // namespace

llvm::Value* RoutineEmitter::leaf(const ir::Inst& inst) {
    switch (ir::as<ir::LeafOp>(inst.op)) {
    case ir::LeafOp::Const: return constant(inst);
    case ir::LeafOp::ParamVal: return function_->getArg((result_ ? 3 : 2) + inst.index);
    case ir::LeafOp::LocalAddr: return locals_[inst.index];
    case ir::LeafOp::GlobalAddr: return m_.global(inst.index);
    case ir::LeafOp::TypeDescAddr: return m_.typeDesc(inst.index);
    case ir::LeafOp::RoutineAddr: return m_.cEntry(inst.index);
    case ir::LeafOp::ResultAddr: return result_;
    case ir::LeafOp::Sysvar:
        return inst.extra == static_cast<int32_t>(ir::SysvarKind::Interrupt)
                   ? loadTask<&rt::TaskCore::interruptNumber>("interrupt")
                   : loadTask<&rt::TaskCore::errorNumber>("error");
    }
    return nullptr;
}

void RoutineEmitter::memory(const ir::Inst& inst, ir::ValueId id) {
    switch (ir::as<ir::MemoryOp>(inst.op)) {
    case ir::MemoryOp::FieldAddr: return define(id, fieldOf(inst));
    case ir::MemoryOp::ElemAddr: {
        Value* index = b_.CreateSExt(operand(inst, 1), b_.getInt64Ty());
        return define(id, b_.CreateInBoundsGEP(m_.memoryType(inst.type), operand(inst, 0), index));
    }
    case ir::MemoryOp::Load:
        return define(id, load(inst.type, operand(inst, 0), tagOf(inst.type, inst.operands[0])));
    case ir::MemoryOp::Store:
        return store(inst.type, operand(inst, 0), operand(inst, 1), tagOf(inst.type, inst.operands[1]));
    case ir::MemoryOp::Copy: return copy(inst);
    case ir::MemoryOp::CopyDynamic:
        b_.CreateMemMove(operand(inst, 0), llvm::Align(1), operand(inst, 1), llvm::Align(1),
                         operand(inst, 2));
        return;
    case ir::MemoryOp::StackAlloc: return define(id, stackAlloc(inst));
    case ir::MemoryOp::Zero:
        if (module_.isScalar(inst.type))
            store(inst.type, llvm::Constant::getNullValue(m_.valueType(inst.type)), operand(inst, 0));
        else
            b_.CreateMemSet(operand(inst, 0), b_.getInt8(0), module_.size(inst.type),
                            llvm::Align(module_.align(inst.type)));
        return;
    }
}

llvm::Value* RoutineEmitter::byteOffset(Value* pointer, Value* offset) {
    return b_.CreateInBoundsGEP(b_.getInt8Ty(), pointer, offset);
}

llvm::Value* RoutineEmitter::fieldOf(const ir::Inst& inst) {
    const uint32_t offset = module_.fieldOffset(inst.type, inst.index);
    Value* base = operand(inst, 0);
    return offset ? byteOffset(base, b_.getInt64(offset)) : base;
}

/// Which component of which record the address names.
llvm::MDNode* RoutineEmitter::tagOf(ir::TypeId type, ir::ValueId address) {
    uint32_t offset = 0;
    ir::TypeId record = ir::kVoid;
    for (const ir::Inst* at = &routine_.insts[address]; at->op == ir::Op::FieldAddr;
         at = &routine_.insts[at->operands[0]]) {
        record = at->type;
        offset += module_.fieldOffset(record, at->index);
    }
    return record == ir::kVoid ? nullptr : m_.componentTag(record, offset, type);
}

llvm::Value* RoutineEmitter::load(ir::TypeId type, Value* pointer, llvm::MDNode* tag) {
    auto* read = b_.CreateAlignedLoad(m_.memoryType(type), pointer, llvm::Align(module_.align(type)));
    read->setMetadata(llvm::LLVMContext::MD_tbaa, tag ? tag : m_.tags().data[type]);
    if (type != ir::kBool) return read;
    return b_.CreateICmpNE(read, b_.getInt8(0));
}

void RoutineEmitter::store(ir::TypeId type, Value* content, Value* pointer, llvm::MDNode* tag) {
    if (type == ir::kBool) content = b_.CreateZExt(content, b_.getInt8Ty());
    auto* write = b_.CreateAlignedStore(content, pointer, llvm::Align(module_.align(type)));
    write->setMetadata(llvm::LLVMContext::MD_tbaa, tag ? tag : m_.tags().data[type]);
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

/// One by one: what was stored one by one has not reached the memory yet, and the processor does not put a wider load together
/// of several stores that are under way.
void RoutineEmitter::copyScalars(const ir::Inst& inst, const std::vector<Scalar>& scalars) {
    const auto at = [&](size_t pointer, const Scalar& scalar) {
        return byteOffset(operand(inst, pointer), b_.getInt64(scalar.offset));
    };
    const auto mark = [&](llvm::Instruction* access, const Scalar& scalar) {
        access->setMetadata(llvm::LLVMContext::MD_tbaa,
                            m_.componentTag(inst.type, scalar.offset, scalar.type));
    };
    std::vector<Value*> contents;
    for (const Scalar& scalar : scalars) {
        auto* read = b_.CreateAlignedLoad(m_.memoryType(scalar.type), at(1, scalar),
                                          llvm::Align(module_.align(scalar.type)));
        mark(read, scalar);
        contents.push_back(read);
    }
    for (size_t i = 0; i < scalars.size(); ++i)
        mark(b_.CreateAlignedStore(contents[i], at(0, scalars[i]),
                                   llvm::Align(module_.align(scalars[i].type))),
             scalars[i]);
}

void RoutineEmitter::copy(const ir::Inst& inst) {
    if (module_.isScalar(inst.type)) {
        store(inst.type, load(inst.type, operand(inst, 1)), operand(inst, 0));
        return;
    }
    if (std::vector<Scalar> scalars; m_.options().optimise && scalarsOf(module_, inst.type, 0, scalars))
        return copyScalars(inst, scalars);
    llvm::Align align(module_.align(inst.type));
    b_.CreateMemCpy(operand(inst, 0), align, operand(inst, 1), align, module_.size(inst.type));
}

} // namespace codegen
