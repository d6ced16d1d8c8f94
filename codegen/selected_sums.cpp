#include "codegen/selected_sums.h"

#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/PatternMatch.h>

namespace codegen {
namespace {

using namespace llvm::PatternMatch;

/// Comparisons of numbers select by masks, and a branch that is nearly always taken is cheaper.
bool wouldBranch(const llvm::SelectInst& select) {
    const llvm::Value* condition = select.getCondition();
    return select.getType()->isFloatingPointTy() && condition->getType()->isIntegerTy(1) &&
           !llvm::isa<llvm::FCmpInst>(condition) && !select.hasMetadata(llvm::LLVMContext::MD_prof);
}

bool addSelected(llvm::SelectInst& select) {
    if (!wouldBranch(select)) return false;
    llvm::Value* const yes = select.getTrueValue();
    llvm::Value* const no = select.getFalseValue();
    llvm::Constant* added = nullptr;
    const auto isSum = [&](llvm::Value* sum, llvm::Value* number) {
        return match(sum, m_OneUse(m_FAdd(m_Specific(number), m_ImmConstant(added))));
    };
    const bool addsIfTrue = isSum(yes, no);
    if (!addsIfTrue && !isSum(no, yes)) return false;
    llvm::IRBuilder<> b(&select);
    llvm::Constant* const nothing = llvm::ConstantFP::getNegativeZero(select.getType());
    llvm::Value* const chosen =
        b.CreateSelect(select.getCondition(), addsIfTrue ? added : nothing, addsIfTrue ? nothing : added);
    llvm::Value* const sum = b.CreateFAdd(addsIfTrue ? no : yes, chosen);
    auto* const unused = llvm::cast<llvm::Instruction>(addsIfTrue ? yes : no);
    select.replaceAllUsesWith(sum);
    select.eraseFromParent();
    unused->eraseFromParent();
    return true;
}

} // namespace

llvm::PreservedAnalyses SelectedSums::run(llvm::Function& function, llvm::FunctionAnalysisManager&) {
    std::vector<llvm::SelectInst*> selects;
    for (llvm::Instruction& inst : llvm::instructions(function))
        if (auto* select = llvm::dyn_cast<llvm::SelectInst>(&inst)) selects.push_back(select);
    bool changed = false;
    for (llvm::SelectInst* select : selects)
        changed |= addSelected(*select);
    if (!changed) return llvm::PreservedAnalyses::all();
    llvm::PreservedAnalyses kept;
    kept.preserveSet<llvm::CFGAnalyses>();
    return kept;
}

} // namespace codegen
