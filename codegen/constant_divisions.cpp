#include "codegen/constant_divisions.h"

#include <llvm/IR/Dominators.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/MDBuilder.h>
#include <llvm/IR/PatternMatch.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "codegen/finite_sums.h"
#include "codegen/integral_numbers.h"
#include "codegen/whole_numbers.h"

namespace codegen {
namespace {

using llvm::Value;
using namespace llvm::PatternMatch;

/// The edge that is taken where `value` equals `part`, its whole part; null for any other user.
const llvm::BranchInst* wholeCheck(const llvm::User* user, Value* value, Value* part, unsigned& edge) {
    const auto* compare = llvm::dyn_cast<llvm::FCmpInst>(user);
    if (!compare || !compare->hasOneUse() ||
        (compare->getOperand(0) != value && compare->getOperand(1) != value) ||
        (compare->getOperand(0) != part && compare->getOperand(1) != part))
        return nullptr;
    if (compare->getPredicate() == llvm::FCmpInst::FCMP_OEQ)
        edge = 0;
    else if (compare->getPredicate() == llvm::FCmpInst::FCMP_UNE)
        edge = 1;
    else
        return nullptr;
    return llvm::dyn_cast<llvm::BranchInst>(*compare->user_begin());
}

/// Whether the value has been compared with its whole part on the way to the instruction.
bool isCheckedWhole(Value* value, const llvm::Instruction& at, const llvm::DominatorTree& dominators) {
    for (llvm::User* part : value->users()) {
        if (!match(part, m_Intrinsic<llvm::Intrinsic::trunc>(m_Specific(value)))) continue;
        for (const llvm::User* user : part->users()) {
            unsigned edge = 0;
            const llvm::BranchInst* branch = wholeCheck(user, value, part, edge);
            if (branch &&
                dominators.dominates(llvm::BasicBlockEdge(branch->getParent(), branch->getSuccessor(edge)),
                                     at.getParent()))
                return true;
        }
    }
    return false;
}

template <class Test> bool allUsers(const Value& value, Test test) {
    return std::all_of(value.user_begin(), value.user_end(), test);
}

/// Whether the user asks for nothing but the finiteness of a value (RoutineEmitter::isFinite, in the forms that LLVM gives it).
bool isFiniteCheck(const llvm::User* user) {
    llvm::CmpInst::Predicate predicate = llvm::CmpInst::BAD_ICMP_PREDICATE;
    const auto isLimit = [&](const llvm::User* compared) {
        return match(compared, m_FCmp(predicate, m_Value(), m_Inf())) ||
               match(compared, m_ICmp(predicate, m_Value(), m_SpecificInt(0xFF000000)));
    };
    if (isLimit(user)) return true; // of a square
    if (match(user, m_FAbs(m_Value()))) return allUsers(*user, isLimit);
    return match(user, m_BitCast(m_Value())) && allUsers(*user, [&](const llvm::User* shifted) {
               return match(shifted, m_Shl(m_Value(), m_One())) && allUsers(*shifted, isLimit);
           });
}

/// A division and what is made of its result.
struct Division {
    llvm::Instruction* ratio = nullptr;     ///< x / c
    llvm::Instruction* quotient = nullptr;  ///< trunc(ratio)
    llvm::Instruction* remainder = nullptr; ///< x - quotient * c; null: not wanted
    double divisor = 0;

    static bool find(llvm::Instruction& inst, const llvm::DominatorTree& dominators,
                     const IntegralNumbers& numbers, Division& found) {
        const llvm::APFloat* divisor = nullptr;
        llvm::Type* type = inst.getType();
        if ((!type->isFloatTy() && !type->isDoubleTy()) ||
            !match(&inst, m_FDiv(m_Value(), m_APFloat(divisor))))
            return false;
        found = {&inst, nullptr, nullptr, divisor->convertToDouble()};
        if (!(found.divisor >= 2 && found.divisor <= largest(type) / 2) ||
            found.divisor != std::trunc(found.divisor) ||
            (!numbers.contains(inst.getOperand(0)) && !isCheckedWhole(inst.getOperand(0), inst, dominators)))
            return false;
        return found.takeUsers();
    }

    /// Whole numbers up to here and their neighbours are exact.
    static double largest(const llvm::Type* type) {
        return std::ldexp(1.0, static_cast<int>(exactBits(type)) - 1);
    }

  private:
    bool takeUsers() {
        for (llvm::User* user : ratio->users())
            if (auto* part = llvm::dyn_cast<llvm::IntrinsicInst>(user);
                part && part->getIntrinsicID() == llvm::Intrinsic::trunc)
                quotient = part;
        if (!quotient) return false;
        for (llvm::User* product : quotient->users())
            for (llvm::User* user : product->users())
                if (match(product, m_c_FMul(m_Specific(quotient), m_Specific(ratio->getOperand(1)))) &&
                    match(user, m_FSub(m_Specific(ratio->getOperand(0)), m_Specific(product))))
                    remainder = llvm::cast<llvm::Instruction>(user);
        return allUsers(*ratio, [&](const llvm::User* user) {
            return user == quotient || isFiniteCheck(user) ||
                   (remainder && match(user, m_c_FAdd(m_Specific(ratio), m_Specific(remainder))) &&
                    allUsers(*user, isFiniteCheck));
        });
    }
};

Value* isFinite(llvm::IRBuilder<>& b, Value* number) {
    return b.CreateFCmpOLT(b.CreateUnaryIntrinsic(llvm::Intrinsic::fabs, number),
                           llvm::ConstantFP::getInfinity(number->getType()));
}

void replace(const Division& division) {
    llvm::Instruction& ratio = *division.ratio;
    Value *number = ratio.getOperand(0), *divisor = ratio.getOperand(1);
    llvm::Type* type = ratio.getType();
    llvm::IRBuilder<> b(&ratio);
    llvm::IntegerType* bits = b.getIntNTy(type->getPrimitiveSizeInBits());
    // Bits of numbers that are not negative have the order of the numbers.
    const auto bitsOf = [&](Value* value) { return b.CreateBitCast(value, bits); };
    const auto remainderOf = [&](Value* quotient) {
        return b.CreateFSub(number, b.CreateFMul(quotient, divisor));
    };
    const auto whole = [&](Value* value) { return b.CreateUnaryIntrinsic(llvm::Intrinsic::trunc, value); };
    Value* inverse = b.CreateFDiv(llvm::ConstantFP::get(type, 1), divisor);
    Value* quotient = whole(b.CreateFMul(number, inverse));
    Value* remainder = remainderOf(quotient);
    Value* inRange =
        b.CreateICmpULE(bitsOf(number), bitsOf(llvm::ConstantFP::get(type, Division::largest(type))));
    Value* right = b.CreateICmpULT(bitsOf(remainder), bitsOf(divisor));
    llvm::Instruction* slow = llvm::SplitBlockAndInsertIfThen(
        b.CreateNot(b.CreateAnd(inRange, right)), ratio.getIterator(), /*Unreachable=*/false,
        llvm::MDBuilder(b.getContext()).createBranchWeights(1, 2000));
    llvm::BasicBlock *divided = slow->getParent(), *before = divided->getSinglePredecessor();
    b.SetInsertPoint(slow);
    Value* slowRatio = b.CreateFDiv(number, divisor);
    Value* slowQuotient = whole(slowRatio);
    Value* slowRemainder = division.remainder ? remainderOf(slowQuotient) : nullptr;
    llvm::BasicBlock* after = ratio.getParent();
    const auto merge = [&](llvm::Type* of, Value* fast, Value* exact) {
        b.SetInsertPoint(after, after->begin());
        llvm::PHINode* phi = b.CreatePHI(of, 2);
        phi->addIncoming(fast, before);
        phi->addIncoming(exact, divided);
        return phi;
    };
    const auto join = [&](llvm::Instruction* old, Value* fast, Value* exact) {
        if (!old) return;
        llvm::PHINode* joined = merge(type, fast, exact);
        old->replaceAllUsesWith(joined);
        old->eraseFromParent();
        // Without the division the result is finite. Checks that have no user any more are left to LLVM.
        for (const FiniteCheck& check : FiniteCheck::of(*joined)) {
            llvm::IRBuilder<> inSlow(slow);
            Value* finite = isFinite(inSlow, exact);
            if (!check.trueWhenFinite) finite = inSlow.CreateNot(finite);
            check.inst->replaceAllUsesWith(merge(b.getInt1Ty(), b.getInt1(check.trueWhenFinite), finite));
        }
    };
    join(division.remainder, remainder, slowRemainder);
    join(division.quotient, quotient, slowQuotient);
    join(division.ratio, quotient, slowRatio); // of which only the finiteness matters
}

} // namespace

llvm::PreservedAnalyses ConstantDivisions::run(llvm::Function& function,
                                               llvm::FunctionAnalysisManager& analyses) {
    std::vector<llvm::Instruction*> divisions;
    for (llvm::Instruction& inst : llvm::instructions(function))
        if (match(&inst, m_FDiv(m_Value(), m_ConstantFP()))) divisions.push_back(&inst);
    if (divisions.empty()) return llvm::PreservedAnalyses::all();
    const auto& dominators = analyses.getResult<llvm::DominatorTreeAnalysis>(function);
    const IntegralNumbers numbers(function);
    std::vector<Division> found;
    for (llvm::Instruction* inst : divisions)
        if (Division division; Division::find(*inst, dominators, numbers, division))
            found.push_back(division);
    for (const Division& division : found)
        replace(division);
    return found.empty() ? llvm::PreservedAnalyses::all() : llvm::PreservedAnalyses::none();
}

} // namespace codegen
