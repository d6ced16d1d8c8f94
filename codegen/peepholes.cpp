#include "codegen/peepholes.h"

#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/PatternMatch.h>
#include <llvm/Transforms/Utils/Local.h>

#include <algorithm>
#include <vector>

#include "codegen/preserved.h"

namespace codegen {
namespace {

using llvm::Value;
using namespace llvm::PatternMatch;

/// The member of an aggregate at the end of `block`.
Value* memberOf(Value* aggregate, unsigned index, llvm::BasicBlock* block) {
    if (Value* inserted = llvm::FindInsertedValue(aggregate, {index})) return inserted;
    return llvm::IRBuilder<>(block->getTerminator()).CreateExtractValue(aggregate, index);
}

llvm::PHINode* memberPhi(llvm::PHINode& whole, unsigned index) {
    auto* type = llvm::cast<llvm::StructType>(whole.getType())->getElementType(index);
    auto* phi =
        llvm::PHINode::Create(type, whole.getNumIncomingValues(), whole.getName(), whole.getIterator());
    for (unsigned i = 0; i < whole.getNumIncomingValues(); ++i) {
        llvm::BasicBlock* block = whole.getIncomingBlock(i);
        const int known = phi->getBasicBlockIndex(block); // a switch may lead here twice
        phi->addIncoming(known >= 0 ? phi->getIncomingValue(static_cast<unsigned>(known))
                                    : memberOf(whole.getIncomingValue(i), index, block),
                         block);
    }
    return phi;
}

/// The routine has not been inlined: two nodes would need a register more than one.
bool isOnlyReturned(const llvm::PHINode& whole) {
    return std::all_of(whole.user_begin(), whole.user_end(),
                       [](const llvm::User* user) { return llvm::isa<llvm::ReturnInst>(user); });
}

void split(llvm::PHINode& whole) {
    const unsigned count = llvm::cast<llvm::StructType>(whole.getType())->getNumElements();
    std::vector<llvm::PHINode*> members;
    for (unsigned i = 0; i < count; ++i)
        members.push_back(memberPhi(whole, i));
    llvm::IRBuilder<> b(whole.getParent(), whole.getParent()->getFirstInsertionPt());
    Value* again = llvm::PoisonValue::get(whole.getType());
    for (unsigned i = 0; i < count; ++i)
        again = b.CreateInsertValue(again, members[i], i);
    whole.replaceAllUsesWith(again);
    whole.eraseFromParent();
    for (llvm::User* user : llvm::make_early_inc_range(again->users())) {
        auto* member = llvm::dyn_cast<llvm::ExtractValueInst>(user);
        if (!member || member->getNumIndices() != 1) continue;
        member->replaceAllUsesWith(members[member->getIndices()[0]]);
        member->eraseFromParent();
    }
    llvm::RecursivelyDeleteTriviallyDeadInstructions(again);
}

/// The number whose finiteness an instruction asks for; `positive`: the answer is also no for negative numbers.
Value* checkedNumber(llvm::Instruction& inst, bool& positive) {
    Value* number = nullptr;
    llvm::CmpInst::Predicate predicate = llvm::CmpInst::BAD_ICMP_PREDICATE;
    positive = false;
    if (match(&inst,
              m_ICmp(predicate, m_Shl(m_BitCast(m_Value(number)), m_One()), m_SpecificInt(0xFF000000))))
        return predicate == llvm::CmpInst::ICMP_ULT && number->getType()->isFloatTy() ? number : nullptr;
    if (match(&inst, m_FCmp(predicate, m_FAbs(m_Value(number)), m_Inf())))
        return predicate == llvm::CmpInst::FCMP_OLT || predicate == llvm::CmpInst::FCMP_ONE ? number
                                                                                            : nullptr;
    positive = true;
    if (match(&inst, m_ICmp(predicate, m_BitCast(m_Value(number)), m_SpecificInt(0x7F800000))))
        return predicate == llvm::CmpInst::ICMP_ULT && number->getType()->isFloatTy() ? number : nullptr;
    return nullptr;
}

bool passes(const Value& number, bool positive, const llvm::SimplifyQuery& query) {
    const llvm::KnownFPClass known =
        llvm::computeKnownFPClass(&number, llvm::fcInf | llvm::fcNan | llvm::fcNegative, 0, query);
    return known.isKnownNeverInfinity() && known.isKnownNeverNaN() && (!positive || known.SignBit == false);
}

} // namespace

llvm::PreservedAnalyses SplitResults::run(llvm::Function& function, llvm::FunctionAnalysisManager&) {
    std::vector<llvm::PHINode*> found;
    for (llvm::BasicBlock& block : function)
        for (llvm::PHINode& phi : block.phis())
            if (phi.getType()->isStructTy() && !isOnlyReturned(phi)) found.push_back(&phi);
    for (llvm::PHINode* phi : found)
        split(*phi);
    return preservingBlocks(!found.empty());
}

llvm::PreservedAnalyses FiniteChecks::run(llvm::Function& function, llvm::FunctionAnalysisManager&) {
    const llvm::SimplifyQuery query(function.getDataLayout());
    bool changed = false;
    for (llvm::Instruction& inst : llvm::make_early_inc_range(llvm::instructions(function))) {
        bool positive = false;
        const Value* number = checkedNumber(inst, positive);
        if (!number || !passes(*number, positive, query.getWithInstruction(&inst))) continue;
        inst.replaceAllUsesWith(llvm::ConstantInt::getTrue(inst.getType()));
        inst.eraseFromParent();
        changed = true;
    }
    return preservingBlocks(changed);
}

} // namespace codegen
