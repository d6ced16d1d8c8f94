#pragma once
// The cheapest form of checks of finiteness, made after everything that recognises them (RoutineEmitter::isFinite).

#include <llvm/IR/PassManager.h>

#include <vector>

namespace codegen {

/// A comparison that says whether a number is finite, in the forms that LLVM gives to RoutineEmitter::isFinite.
struct FiniteCheck {
    llvm::Instruction* inst = nullptr; ///< null: it is none
    llvm::Value* number = nullptr;
    bool trueWhenFinite = true;
    bool onlyUser = false; ///< of the number

    static FiniteCheck find(llvm::Instruction& inst);
    /// Those of a number.
    static std::vector<FiniteCheck> of(llvm::Value& number);
    void replaceBy(llvm::Value* test) const;
};

/// Marks a sum of which only the finiteness matters (by a flag that means nothing for sums; a pass that drops it does no harm).
void markForChecks(llvm::Value* sum);
bool isForChecks(const llvm::Instruction& sum);

/// A number that cannot be negative is compared with infinity; of one that nothing else needs, x - x is NaN when it is not finite.
/// Sums that are marked are formed of whole vectors, where their terms are the elements of vectors.
class FiniteSums : public llvm::PassInfoMixin<FiniteSums> {
  public:
    llvm::PreservedAnalyses run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses);
};

} // namespace codegen
