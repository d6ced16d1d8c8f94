// Constants, arithmetic, comparison, logic, conversion.

#include <llvm/IR/Intrinsics.h>

#include "codegen/finite_sums.h"
#include "codegen/routine_emitter.h"
#include "codegen/whole_divisions.h"
#include "ir/core/op_info.h"

namespace codegen {

using ir::Op;

llvm::Value* RoutineEmitter::constant(const ir::Inst& inst) {
    switch (inst.type) {
    case ir::kBool: return b_.getInt1(inst.integer() != 0);
    case ir::kF32:
        return llvm::ConstantFP::get(m_.context(), llvm::APFloat(static_cast<float>(inst.number())));
    case ir::kF64: return llvm::ConstantFP::get(m_.context(), llvm::APFloat(inst.number()));
    case ir::kPtr: return llvm::ConstantPointerNull::get(b_.getPtrTy());
    default: return llvm::ConstantInt::getSigned(m_.valueType(inst.type), inst.integer()); // integers
    }
}

llvm::Value* RoutineEmitter::floatArithmetic(const ir::Inst& inst) {
    Value* a = operand(inst, 0);
    switch (ir::as<ir::FloatOp>(inst.op)) {
    case ir::FloatOp::FAdd: {
        Value* sum = b_.CreateFAdd(a, operand(inst, 1));
        if (inst.extra == 1) markForChecks(sum);
        return sum;
    }
    case ir::FloatOp::FSub: return b_.CreateFSub(a, operand(inst, 1));
    case ir::FloatOp::FMul: return b_.CreateFMul(a, operand(inst, 1));
    case ir::FloatOp::FDiv: return b_.CreateFDiv(a, operand(inst, 1));
    case ir::FloatOp::FNeg: return b_.CreateFNeg(a);
    case ir::FloatOp::FTrunc: return b_.CreateUnaryIntrinsic(llvm::Intrinsic::trunc, a);
    case ir::FloatOp::FQuot: return createWholeDivision(b_, WholeDivision::Quotient, a, operand(inst, 1));
    case ir::FloatOp::FRem: return createWholeDivision(b_, WholeDivision::Remainder, a, operand(inst, 1));
    }
    return nullptr;
}

llvm::Value* RoutineEmitter::logic(const ir::Inst& inst) {
    switch (ir::as<ir::LogicOp>(inst.op)) {
    case ir::LogicOp::And: return b_.CreateAnd(operand(inst, 0), operand(inst, 1));
    case ir::LogicOp::Or: return b_.CreateOr(operand(inst, 0), operand(inst, 1));
    case ir::LogicOp::Xor: return b_.CreateXor(operand(inst, 0), operand(inst, 1));
    case ir::LogicOp::Not: return b_.CreateNot(operand(inst, 0));
    case ir::LogicOp::Select: return b_.CreateSelect(operand(inst, 0), operand(inst, 1), operand(inst, 2));
    }
    return nullptr;
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
    switch (ir::as<ir::IntOp>(inst.op)) {
    case ir::IntOp::IAdd: return b_.CreateAdd(a, operand(inst, 1), "", false, inst.extra == 1);
    case ir::IntOp::ISub: return b_.CreateSub(a, operand(inst, 1));
    case ir::IntOp::IMul: return b_.CreateMul(a, operand(inst, 1), "", false, inst.extra == 1);
    case ir::IntOp::INeg: return b_.CreateNeg(a);
    case ir::IntOp::IDiv:
    case ir::IntOp::IRem: return divide(inst);
    case ir::IntOp::UDiv: return b_.CreateUDiv(a, operand(inst, 1));
    case ir::IntOp::URem: return b_.CreateURem(a, operand(inst, 1));
    case ir::IntOp::Shl: return b_.CreateShl(a, shiftCount(inst));
    case ir::IntOp::Shr: return b_.CreateLShr(a, shiftCount(inst));
    case ir::IntOp::Sar: return b_.CreateAShr(a, shiftCount(inst));
    }
    return nullptr;
}

/// Modulo the width, which the processor takes for granted and LLVM does not.
llvm::Value* RoutineEmitter::shiftCount(const ir::Inst& inst) {
    return b_.CreateAnd(operand(inst, 1), ir::bitsOf(inst.type) - 1);
}

/// The smallest integer divided by -1 overflows, which stops the processor: -1 is set apart.
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
    if (inst.op == Op::IsFinite) return isFinite(operand(inst, 0));
    Value *a = operand(inst, 0), *b = operand(inst, 1);
    llvm::IRBuilder<>::FastMathFlagGuard guard(b_);
    llvm::FastMathFlags flags;
    flags.setNoNaNs(module_.overflowError != 0); // the operands have been checked
    b_.setFastMathFlags(flags);
    switch (ir::as<ir::CompareOp>(inst.op)) {
    case ir::CompareOp::FEq: return b_.CreateFCmpOEQ(a, b);
    case ir::CompareOp::FNe: return b_.CreateFCmpUNE(a, b);
    case ir::CompareOp::FLt: return b_.CreateFCmpOLT(a, b);
    case ir::CompareOp::FLe: return b_.CreateFCmpOLE(a, b);
    case ir::CompareOp::FGt: return b_.CreateFCmpOGT(a, b);
    case ir::CompareOp::FGe: return b_.CreateFCmpOGE(a, b);
    case ir::CompareOp::IEq: return b_.CreateICmpEQ(a, b);
    case ir::CompareOp::INe: return b_.CreateICmpNE(a, b);
    case ir::CompareOp::ILt: return b_.CreateICmpSLT(a, b);
    case ir::CompareOp::ILe: return b_.CreateICmpSLE(a, b);
    case ir::CompareOp::IGt: return b_.CreateICmpSGT(a, b);
    case ir::CompareOp::IGe: return b_.CreateICmpSGE(a, b);
    case ir::CompareOp::IULt: return b_.CreateICmpULT(a, b);
    case ir::CompareOp::IULe: return b_.CreateICmpULE(a, b);
    case ir::CompareOp::IUGt: return b_.CreateICmpUGT(a, b);
    case ir::CompareOp::IUGe: return b_.CreateICmpUGE(a, b);
    case ir::CompareOp::IsFinite: break;
    }
    return nullptr;
}

llvm::Value* RoutineEmitter::conversion(const ir::Inst& inst) {
    Value* a = operand(inst, 0);
    llvm::Type* to = m_.valueType(inst.type);
    switch (ir::as<ir::ConvertOp>(inst.op)) {
    case ir::ConvertOp::FloatToIndex: // out of range: arbitrary, but one and the same value
        return b_.CreateFreeze(b_.CreateFPToSI(a, to));
    case ir::ConvertOp::FloatToSInt:
        return b_.CreateIntrinsic(llvm::Intrinsic::fptosi_sat, {to, a->getType()}, {a});
    case ir::ConvertOp::FloatToUInt:
        return b_.CreateIntrinsic(llvm::Intrinsic::fptoui_sat, {to, a->getType()}, {a});
    case ir::ConvertOp::FWiden: return b_.CreateFPExt(a, to);
    case ir::ConvertOp::FNarrow: return b_.CreateFPTrunc(a, to);
    case ir::ConvertOp::SExt: return b_.CreateSExt(a, to);
    case ir::ConvertOp::ZExt: return b_.CreateZExt(a, to);
    case ir::ConvertOp::Trunc: return b_.CreateTrunc(a, to);
    case ir::ConvertOp::SIntToFloat: return b_.CreateSIToFP(a, to);
    case ir::ConvertOp::UIntToFloat: return b_.CreateUIToFP(a, to);
    }
    return nullptr;
}

} // namespace codegen
