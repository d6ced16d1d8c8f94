#pragma once
// Floating-point values that are whole numbers for certain: converted integers, and what is computed from them.

#include <llvm/IR/ConstantRange.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/PassManager.h>

namespace codegen {

/// Where a number equals a converted whole number other than 0 (the check of an index), the converted one takes its place:
/// the ranges of integers are known, those of floating-point numbers are not.
class WholeAfterCheck : public llvm::PassInfoMixin<WholeAfterCheck> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

/// Sums, differences, products, comparisons and conversions of converted whole numbers are computed with integers where the
/// floating-point result is exact.
class WholeArithmetic : public llvm::PassInfoMixin<WholeArithmetic> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

/// The whole number that a conversion to floating point converts; null: the value is none, or a vector.
llvm::Value* convertedWhole(const llvm::Value* value);
/// Whether nothing but converted and constant whole numbers, and what is computed from them, can reach the value. Otherwise
/// it stays a floating-point number, and converting it back would only cost time.
bool mayBecomeInteger(llvm::Value* value);
/// What is known of a whole number at an instruction: from its bits, from checks on the way there, from counted loops,
/// from its operands up to some depth.
llvm::ConstantRange rangeOfWhole(llvm::Value* whole, llvm::Instruction* at,
                                 llvm::FunctionAnalysisManager& analyses, unsigned depth = 4);
/// The same of an operand of a phi: checks at the end of the incoming block count as well.
llvm::ConstantRange rangeOfIncoming(llvm::Value* whole, const llvm::PHINode& phi, unsigned operand,
                                    llvm::FunctionAnalysisManager& analyses);
/// Bits of the whole numbers that the floating-point type holds exactly.
unsigned exactBits(const llvm::Type* type);

} // namespace codegen
