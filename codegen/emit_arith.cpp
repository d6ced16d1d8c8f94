// Constants, arithmetic, comparison, logic, conversion.

#include <llvm/IR/Intrinsics.h>

#include "codegen/routine_emitter.h"
#include "ir/core/op_info.h"

namespace codegen {

using ir::Op;

bool RoutineEmitter::arithmetic(const ir::Inst& inst, ir::ValueId id) {
    Value* result = nullptr;
    if (inst.op == Op::Const)
        result = constant(inst);
    else if ((inst.op >= Op::FAdd && inst.op <= Op::FNeg) || inst.op == Op::FTrunc)
        result = floatArithmetic(inst);
    else if (inst.op >= Op::IAdd && inst.op <= Op::INeg)
        result = intArithmetic(inst);
    else if (inst.op == Op::IsFinite)
        result = isFinite(operand(inst, 0));
    else if (inst.op >= Op::FEq && inst.op <= Op::IULt)
        result = comparison(inst);
    else if (inst.op == Op::And)
        result = b_.CreateAnd(operand(inst, 0), operand(inst, 1));
    else if (inst.op == Op::Or)
        result = b_.CreateOr(operand(inst, 0), operand(inst, 1));
    else if (inst.op == Op::Xor)
        result = b_.CreateXor(operand(inst, 0), operand(inst, 1));
    else if (inst.op == Op::Not)
        result = b_.CreateNot(operand(inst, 0));
    else if (inst.op == Op::Select)
        result = b_.CreateSelect(operand(inst, 0), operand(inst, 1), operand(inst, 2));
    else if (ir::conversionFrom(inst.op) != ir::kVoid)
        result = conversion(inst);
    if (!result) return false;
    define(id, result);
    return true;
}

llvm::Value* RoutineEmitter::constant(const ir::Inst& inst) {
    switch (inst.type) {
    case ir::kBool: return b_.getInt1(inst.number != 0);
    case ir::kI32: return llvm::ConstantInt::getSigned(b_.getInt32Ty(), static_cast<int32_t>(inst.number));
    case ir::kI64: return llvm::ConstantInt::getSigned(b_.getInt64Ty(), static_cast<int64_t>(inst.number));
    case ir::kF32: return llvm::ConstantFP::get(m_.context(), llvm::APFloat(static_cast<float>(inst.number)));
    case ir::kF64: return llvm::ConstantFP::get(m_.context(), llvm::APFloat(inst.number));
    default: return llvm::ConstantPointerNull::get(b_.getPtrTy());
    }
}

llvm::Value* RoutineEmitter::floatArithmetic(const ir::Inst& inst) {
    Value* a = operand(inst, 0);
    switch (inst.op) {
    case Op::FAdd: return b_.CreateFAdd(a, operand(inst, 1));
    case Op::FSub: return b_.CreateFSub(a, operand(inst, 1));
    case Op::FMul: return b_.CreateFMul(a, operand(inst, 1));
    case Op::FDiv: return b_.CreateFDiv(a, operand(inst, 1));
    case Op::FNeg: return b_.CreateFNeg(a);
    default: return b_.CreateUnaryIntrinsic(llvm::Intrinsic::trunc, a);
    }
}

/// A comparison of what costs the processor least: for binary32 the bits without the sign.
llvm::Value* RoutineEmitter::isFinite(Value* number) {
    if (number->getType()->isFloatTy()) {
        Value* bits = b_.CreateShl(b_.CreateBitCast(number, b_.getInt32Ty()), 1);
        return b_.CreateICmpULT(bits, b_.getInt32(0xFF000000));
    }
    Value* size = b_.CreateUnaryIntrinsic(llvm::Intrinsic::fabs, number);
    return b_.CreateFCmpOLT(size, llvm::ConstantFP::getInfinity(number->getType()));
}

llvm::Value* RoutineEmitter::intArithmetic(const ir::Inst& inst) {
    Value* a = operand(inst, 0);
    switch (inst.op) {
    case Op::IAdd: return b_.CreateAdd(a, operand(inst, 1), "", false, inst.extra == 1);
    case Op::ISub: return b_.CreateSub(a, operand(inst, 1));
    case Op::IMul: return b_.CreateMul(a, operand(inst, 1));
    case Op::INeg: return b_.CreateNeg(a);
    default: return divide(inst);
    }
}

/// The smallest integer divided by -1 overflows, which the processor answers with a trap: -1 is set apart.
llvm::Value* RoutineEmitter::divide(const ir::Inst& inst) {
    Value *a = operand(inst, 0), *b = operand(inst, 1);
    bool quotient = inst.op == Op::IDiv;
    Value* minusOne = llvm::ConstantInt::getSigned(b->getType(), -1);
    if (auto* known = llvm::dyn_cast<llvm::ConstantInt>(b); known && !known->isMinusOne())
        return quotient ? b_.CreateSDiv(a, b) : b_.CreateSRem(a, b);
    Value* isMinusOne = b_.CreateICmpEQ(b, minusOne);
    Value* safe = b_.CreateSelect(isMinusOne, llvm::ConstantInt::get(b->getType(), 1), b);
    Value* special = quotient ? b_.CreateNeg(a) : llvm::ConstantInt::get(a->getType(), 0);
    return b_.CreateSelect(isMinusOne, special, quotient ? b_.CreateSDiv(a, safe) : b_.CreateSRem(a, safe));
}

llvm::Value* RoutineEmitter::comparison(const ir::Inst& inst) {
    Value *a = operand(inst, 0), *b = operand(inst, 1);
    switch (inst.op) {
    case Op::FEq: return b_.CreateFCmpOEQ(a, b);
    case Op::FNe: return b_.CreateFCmpUNE(a, b);
    case Op::FLt: return b_.CreateFCmpOLT(a, b);
    case Op::FLe: return b_.CreateFCmpOLE(a, b);
    case Op::FGt: return b_.CreateFCmpOGT(a, b);
    case Op::FGe: return b_.CreateFCmpOGE(a, b);
    case Op::IEq: return b_.CreateICmpEQ(a, b);
    case Op::INe: return b_.CreateICmpNE(a, b);
    case Op::ILt: return b_.CreateICmpSLT(a, b);
    case Op::ILe: return b_.CreateICmpSLE(a, b);
    case Op::IGt: return b_.CreateICmpSGT(a, b);
    case Op::IGe: return b_.CreateICmpSGE(a, b);
    default: return b_.CreateICmpULT(a, b);
    }
}

llvm::Value* RoutineEmitter::conversion(const ir::Inst& inst) {
    Value* a = operand(inst, 0);
    llvm::Type* to = m_.valueType(inst.type);
    switch (inst.op) {
    case Op::F32ToIndex:
    case Op::F64ToIndex: // out of range: arbitrary, but one and the same value
        return b_.CreateFreeze(b_.CreateFPToSI(a, to));
    case Op::F32ToI32:
    case Op::F64ToI32:
    case Op::F32ToI64:
    case Op::F64ToI64: return b_.CreateIntrinsic(llvm::Intrinsic::fptosi_sat, {to, a->getType()}, {a});
    case Op::F32ToF64: return b_.CreateFPExt(a, to);
    case Op::F64ToF32: return b_.CreateFPTrunc(a, to);
    case Op::I32ToI64: return b_.CreateSExt(a, to);
    case Op::I64ToI32: return b_.CreateTrunc(a, to);
    default: return b_.CreateSIToFP(a, to);
    }
}

} // namespace codegen
