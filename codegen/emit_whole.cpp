// Division of whole floating-point numbers. Nearly all fit an integer of the processor, and are divided as such: that is faster,
// and tells the optimiser that the result is whole and how large it can be. Others take a way of their own.

#include <llvm/IR/Intrinsics.h>
#include <llvm/TargetParser/Triple.h>

#include <cmath>

#include "codegen/routine_emitter.h"
#include "ir/core/op_info.h"

namespace codegen {

using llvm::Value;

namespace {

/// A floating-point number as an integer of its width.
struct AsInteger {
    Value* integer;
    Value* isSame; ///< false: it is not whole, or does not fit
};

AsInteger asInteger(llvm::IRBuilder<>& b, Value* number, bool saturates) {
    llvm::Type* type = number->getType();
    llvm::IntegerType* integer = b.getIntNTy(type->getPrimitiveSizeInBits());
    AsInteger result{b.CreateFreeze(b.CreateFPToSI(number, integer)), nullptr};
    result.isSame = b.CreateFCmpOEQ(b.CreateSIToFP(result.integer, type), number);
    if (!saturates) return result;
    // The number after the largest integer becomes that integer, which is converted back to the same number.
    const auto largest = llvm::APInt::getSignedMaxValue(integer->getBitWidth());
    result.isSame =
        b.CreateAnd(result.isSame, b.CreateICmpNE(result.integer, llvm::ConstantInt::get(integer, largest)));
    return result;
}

/// The number when it is a constant that integers of its width and the type itself hold exactly, otherwise 0.
int64_t wholeConstant(const Value* number) {
    const auto* constant = llvm::dyn_cast<llvm::ConstantFP>(number);
    if (!constant) return 0;
    const double value = constant->getValueAPF().convertToDouble();
    const double limit = std::ldexp(1.0, number->getType()->isFloatTy() ? 24 : 53);
    return std::trunc(value) == value && std::abs(value) < limit ? static_cast<int64_t>(value) : 0;
}

Value* isWhole(llvm::IRBuilder<>& b, Value* number) {
    return b.CreateFCmpOEQ(b.CreateUnaryIntrinsic(llvm::Intrinsic::trunc, number), number);
}

} // namespace

/// For numbers that no integer holds, and for negative divisors. Raises the error.
Value* RoutineEmitter::exactDivision(const ir::Inst& inst, Value* a, Value* b) {
    Value* whole = isWhole(b_, a);
    if (wholeConstant(b) == 0) whole = b_.CreateAnd(whole, isWhole(b_, b));
    check(inst, whole);
    // Only +0: integers have no other.
    Value* zero = llvm::ConstantFP::get(a->getType(), 0.0);
    switch (ir::as<ir::WholeOp>(inst.op)) {
    case ir::WholeOp::FQuotient:
        return b_.CreateFAdd(b_.CreateUnaryIntrinsic(llvm::Intrinsic::trunc, b_.CreateFDiv(a, b)), zero);
    case ir::WholeOp::FRemainder: return b_.CreateFAdd(b_.CreateFRem(a, b), zero);
    }
    return nullptr;
}

Value* RoutineEmitter::wholeDivision(const ir::Inst& inst) {
    Value *a = operand(inst, 0), *b = operand(inst, 1);
    // x86 gives the smallest integer instead.
    const bool saturates = !llvm::Triple(m_.target().getTargetTriple()).isX86();
    const AsInteger dividend = asInteger(b_, a, saturates);
    Value *isFast = dividend.isSame, *by = nullptr;
    const int64_t known = wholeConstant(b);
    if (known != 0 && known != -1) {
        by = llvm::ConstantInt::getSigned(dividend.integer->getType(), known);
    } else {
        const AsInteger divisor = asInteger(b_, b, saturates);
        by = divisor.integer;
        Value* isPositive = b_.CreateICmpSGT(by, llvm::ConstantInt::get(by->getType(), 0));
        isFast = b_.CreateAnd(b_.CreateAnd(isFast, divisor.isSame), isPositive);
    }
    BasicBlock *fast = newBlock("whole"), *slow = newBlock("exact"), *join = newBlock("divided");
    b_.CreateCondBr(isFast, fast, slow, m_.unlikely());
    b_.SetInsertPoint(fast);
    const bool isRemainder = inst.op == ir::Op::FRemainder;
    Value* quick = isRemainder ? b_.CreateSRem(dividend.integer, by) : b_.CreateSDiv(dividend.integer, by);
    const bool fits = isRemainder && known != 0; // smaller than the divisor: an integer in any case
    if (!fits) quick = b_.CreateSIToFP(quick, a->getType());
    b_.CreateBr(join);
    b_.SetInsertPoint(slow);
    Value* exact = exactDivision(inst, a, b);
    if (fits) exact = b_.CreateFPToSI(exact, quick->getType());
    BasicBlock* const slowEnd = b_.GetInsertBlock();
    b_.CreateBr(join);
    b_.SetInsertPoint(join);
    llvm::PHINode* result = b_.CreatePHI(quick->getType(), 2, "division");
    result->addIncoming(quick, fast);
    result->addIncoming(exact, slowEnd);
    return fits ? b_.CreateSIToFP(result, a->getType()) : result;
}

} // namespace codegen
