#pragma once
// DIV and MOD of whole numbers: exact for dividends of any size, without a division where the divisor is a constant.

#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/PassManager.h>

namespace codegen {

enum class WholeDivision { Quotient, Remainder };

/// The result as a call of a function without a body and without side effects, which LLVM merges, moves and drops like an
/// arithmetic instruction. WholeDivisions or replaceWholeDivisions() puts code in its place.
llvm::Value* createWholeDivision(llvm::IRBuilderBase& b, WholeDivision wanted, llvm::Value* number,
                                 llvm::Value* divisor);
bool isWholeDivision(const llvm::Value& value);
bool isWholeRemainder(const llvm::Value& value);

/// Quotient and remainder of one pair of numbers are computed together. With a constant divisor c they are computed with 1 / c:
/// when the remainder is from 0 to below c, both are exact. Otherwise the numbers are divided, and dividends whose neighbours the
/// type cannot hold go to the runtime.
class WholeDivisions : public llvm::PassInfoMixin<WholeDivisions> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

/// The same for functions that no pass has seen.
void replaceWholeDivisions(llvm::Module& module);

} // namespace codegen
