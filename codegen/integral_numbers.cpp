#include "codegen/integral_numbers.h"

#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/PatternMatch.h>

#include <algorithm>
#include <vector>

#include "codegen/preserved.h"
#include "codegen/whole_divisions.h"

namespace codegen {
namespace {

using llvm::Value;
using namespace llvm::PatternMatch;

bool isNumber(const llvm::Type* type) {
    return type->isFloatTy() || type->isDoubleTy();
}

bool hasOperation(const llvm::Instruction& inst) {
    switch (inst.getOpcode()) {
    case llvm::Instruction::PHI:
    case llvm::Instruction::Select:
    case llvm::Instruction::FAdd:
    case llvm::Instruction::FSub:
    case llvm::Instruction::FMul:
    case llvm::Instruction::FNeg:
    case llvm::Instruction::FPExt:
    case llvm::Instruction::FPTrunc:
    case llvm::Instruction::SIToFP:
    case llvm::Instruction::UIToFP: return true;
    default:
        return match(&inst, m_Intrinsic<llvm::Intrinsic::trunc>()) || match(&inst, m_FAbs(m_Value())) ||
               isWholeDivision(inst);
    }
}

} // namespace

IntegralNumbers::IntegralNumbers(llvm::Function& function) {
    std::vector<const llvm::Instruction*> candidates;
    for (const llvm::Instruction& inst : llvm::instructions(function))
        if (isNumber(inst.getType()) && hasOperation(inst)) candidates.push_back(&inst);
    known_.insert(candidates.begin(), candidates.end());
    for (bool changed = true; changed;) {
        changed = false;
        for (const llvm::Instruction* inst : candidates)
            changed |= !isMade(*inst) && known_.erase(inst);
    }
}

bool IntegralNumbers::contains(const Value* value) const {
    if (const auto* constant = llvm::dyn_cast<llvm::ConstantFP>(value))
        return constant->getValueAPF().isInteger();
    return known_.contains(value);
}

/// Whether the instruction gives such a number, by what is known so far.
bool IntegralNumbers::isMade(const llvm::Instruction& inst) const {
    if (llvm::isa<llvm::SIToFPInst, llvm::UIToFPInst>(inst) ||
        match(&inst, m_Intrinsic<llvm::Intrinsic::trunc>()) || isWholeDivision(inst))
        return true;
    if (llvm::isa<llvm::SelectInst>(inst))
        return contains(inst.getOperand(1)) && contains(inst.getOperand(2));
    if (llvm::isa<llvm::CallInst>(inst)) return contains(inst.getOperand(0)); // fabs
    return std::all_of(inst.value_op_begin(), inst.value_op_end(),
                       [&](const Value* operand) { return contains(operand); });
}

llvm::PreservedAnalyses WholeChecks::run(llvm::Function& function, llvm::FunctionAnalysisManager&) {
    std::vector<std::pair<llvm::FCmpInst*, Value*>> checks;
    for (llvm::Instruction& inst : llvm::instructions(function)) {
        auto* compare = llvm::dyn_cast<llvm::FCmpInst>(&inst);
        if (!compare || !compare->isEquality()) continue;
        Value *a = compare->getOperand(0), *b = compare->getOperand(1);
        if (match(a, m_Intrinsic<llvm::Intrinsic::trunc>(m_Specific(b))))
            checks.emplace_back(compare, b);
        else if (match(b, m_Intrinsic<llvm::Intrinsic::trunc>(m_Specific(a))))
            checks.emplace_back(compare, a);
    }
    if (checks.empty()) return llvm::PreservedAnalyses::all();
    const IntegralNumbers numbers(function);
    bool changed = false;
    for (const auto& [compare, number] : checks) {
        const bool equal = compare->getPredicate() == llvm::FCmpInst::FCMP_OEQ;
        if ((!equal && compare->getPredicate() != llvm::FCmpInst::FCMP_UNE) || !numbers.contains(number))
            continue;
        llvm::IRBuilder<> b(compare);
        if (compare->hasNoNaNs()) {
            compare->replaceAllUsesWith(b.getInt1(equal));
            compare->eraseFromParent();
            changed = true;
            continue;
        }
        compare->replaceAllUsesWith(b.CreateFCmp(equal ? llvm::FCmpInst::FCMP_ORD : llvm::FCmpInst::FCMP_UNO,
                                                 number, llvm::ConstantFP::getZero(number->getType())));
        compare->eraseFromParent();
        changed = true;
    }
    return preservingBlocks(changed);
}

} // namespace codegen
