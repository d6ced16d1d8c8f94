#include "codegen/integral_values.h"

#include <llvm/ADT/MapVector.h>
#include <llvm/Analysis/LazyValueInfo.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/Transforms/InstCombine/InstCombine.h>
#include <llvm/Transforms/Scalar/EarlyCSE.h>

#include <algorithm>
#include <cmath>

#include "codegen/whole_numbers.h"

namespace codegen {
namespace {

using llvm::Value;

/// A phi or a select: it has the value of one of its operands.
std::vector<unsigned> choices(const llvm::Instruction& node) {
    if (llvm::isa<llvm::SelectInst>(node)) return {1, 2};
    std::vector<unsigned> all(node.getNumOperands());
    for (unsigned i = 0; i < all.size(); ++i)
        all[i] = i;
    return all;
}

class Web {
  public:
    /// `masks`: receives what only says how large numbers are.
    Web(llvm::Function& function, llvm::FunctionAnalysisManager& analyses,
        std::vector<llvm::WeakTrackingVH>& masks)
        : function_(function), analyses_(analyses), masks_(masks) {}

    bool run() {
        for (llvm::Instruction& inst : llvm::instructions(function_))
            if ((llvm::isa<llvm::PHINode>(inst) || llvm::isa<llvm::SelectInst>(inst)) &&
                (inst.getType()->isFloatTy() || inst.getType()->isDoubleTy()))
                nodes_.insert({&inst, nullptr});
        dropUnless([&](const llvm::Instruction& node) { return isOneOfWholes(node); });
        // If no value is converted back or compared with a converted one, the floating-point number is the result.
        dropUnless([&](const llvm::Instruction& node) {
            return std::any_of(node.user_begin(), node.user_end(), [&](const llvm::User* user) {
                return llvm::isa<llvm::FPToSIInst>(user) || llvm::isa<llvm::FPToUIInst>(user) ||
                       comparesWholes(*user) || contains(user);
            });
        });
        dropUnless([&](const llvm::Instruction& node) { return isOneOfWholes(node); });
        if (nodes_.empty()) return false;
        replace();
        return true;
    }

  private:
    bool contains(const Value* value) const {
        const auto* inst = llvm::dyn_cast<llvm::Instruction>(value);
        return inst && nodes_.contains(const_cast<llvm::Instruction*>(inst));
    }

    /// Removes nodes until all that are left meet the condition.
    template <class Keep> void dropUnless(Keep keep) {
        for (bool changed = true; changed;) {
            changed = false;
            std::vector<llvm::Instruction*> others;
            for (const auto& [node, made] : nodes_)
                if (!keep(*node)) others.push_back(node);
            for (llvm::Instruction* node : others)
                changed |= nodes_.erase(node) > 0;
        }
    }

    static bool comparesWholes(const llvm::User& user) {
        return llvm::isa<llvm::FCmpInst>(user) &&
               (convertedWhole(user.getOperand(0)) || convertedWhole(user.getOperand(1)));
    }

    bool isOneOfWholes(const llvm::Instruction& node) const {
        const std::vector<unsigned> operands = choices(node);
        return std::all_of(operands.begin(), operands.end(), [&](unsigned i) { return isWhole(node, i); });
    }

    bool isWhole(const llvm::Instruction& node, unsigned i) const {
        const Value* value = node.getOperand(i);
        if (contains(value) || llvm::isa<llvm::UndefValue>(value)) return true;
        if (const auto* constant = llvm::dyn_cast<llvm::ConstantFP>(value)) {
            const double number = constant->getValueAPF().convertToDouble();
            return number >= 0 && !std::signbit(number) && number == std::trunc(number) &&
                   number < std::ldexp(1.0, static_cast<int>(exactBits(value->getType())));
        }
        Value* from = convertedWhole(value);
        return from && bitsOf(from, node, i) <= exactBits(value->getType());
    }

    /// Bits of a whole number where it is an operand of the node, as many as it has when it may be negative. Checks on the way
    /// there bound it.
    unsigned bitsOf(Value* whole, const llvm::Instruction& node, unsigned i) const {
        const auto* phi = llvm::dyn_cast<llvm::PHINode>(&node);
        const llvm::ConstantRange range =
            phi ? rangeOfIncoming(whole, *phi, i, analyses_)
                : rangeOfWhole(whole, const_cast<llvm::Instruction*>(&node), analyses_);
        return range.getUnsignedMax().getActiveBits();
    }

    unsigned bitsOfOperand(const llvm::Instruction& node, unsigned i) const {
        Value* operand = node.getOperand(i);
        if (const auto found = bits_.find(operand); found != bits_.end()) return found->second;
        if (const auto* constant = llvm::dyn_cast<llvm::ConstantFP>(operand))
            return static_cast<unsigned>(
                       std::ilogb(std::max(1.0, constant->getValueAPF().convertToDouble()))) +
                   1;
        Value* from = convertedWhole(operand);
        return from ? bitsOf(from, node, i) : 1;
    }

    /// The widest number that comes into each node.
    void measure() {
        for (const auto& [node, made] : nodes_)
            bits_[node] = 1;
        for (bool changed = true; changed;) {
            changed = false;
            for (const auto& [node, made] : nodes_) {
                unsigned& bits = bits_[node];
                const unsigned before = bits;
                for (const unsigned i : choices(*node))
                    bits = std::max(bits, bitsOfOperand(*node, i));
                changed |= bits != before;
            }
        }
    }

    /// Bytes stay bytes: of a wider integer, the upper bits would have to be cleared in each round of a loop.
    llvm::IntegerType* integerFor(llvm::Instruction* node) const {
        const unsigned whole = node->getType()->isFloatTy() ? 32 : 64;
        return llvm::IntegerType::get(function_.getContext(), bits_.at(node) <= 8 ? 8 : whole);
    }

    Value* integer(Value* value, llvm::IntegerType* type, llvm::Instruction* before) {
        if (const auto found = nodes_.find(llvm::dyn_cast<llvm::Instruction>(value)); found != nodes_.end())
            return llvm::IRBuilder<>(before).CreateZExtOrTrunc(found->second, type);
        if (llvm::isa<llvm::UndefValue>(value)) return llvm::ConstantInt::get(type, 0);
        if (const auto* constant = llvm::dyn_cast<llvm::ConstantFP>(value))
            return llvm::ConstantInt::get(type,
                                          static_cast<uint64_t>(constant->getValueAPF().convertToDouble()));
        return llvm::IRBuilder<>(before).CreateZExtOrTrunc(convertedWhole(value), type);
    }

    void replace() {
        measure();
        for (auto& [node, made] : nodes_) {
            llvm::IRBuilder<> b(node);
            llvm::IntegerType* type = integerFor(node);
            if (const auto* phi = llvm::dyn_cast<llvm::PHINode>(node))
                made = b.CreatePHI(type, phi->getNumIncomingValues());
            else
                made = llvm::cast<llvm::Instruction>(
                    llvm::SelectInst::Create(node->getOperand(0), llvm::PoisonValue::get(type),
                                             llvm::PoisonValue::get(type), "", node->getIterator()));
        }
        for (auto& [node, made] : nodes_) {
            auto* type = llvm::cast<llvm::IntegerType>(made->getType());
            if (const auto* phi = llvm::dyn_cast<llvm::PHINode>(node)) {
                for (unsigned i = 0; i < phi->getNumIncomingValues(); ++i)
                    llvm::cast<llvm::PHINode>(made)->addIncoming(
                        integer(phi->getIncomingValue(i), type, phi->getIncomingBlock(i)->getTerminator()),
                        phi->getIncomingBlock(i));
            } else {
                made->setOperand(1, integer(node->getOperand(1), type, node));
                made->setOperand(2, integer(node->getOperand(2), type, node));
            }
        }
        for (auto& [node, made] : nodes_) {
            llvm::Instruction* after = llvm::isa<llvm::PHINode>(node)
                                           ? &*node->getParent()->getFirstInsertionPt()
                                           : made->getNextNode();
            llvm::IRBuilder<> b(after);
            // Ranges of numbers get lost in loops; the mask keeps them.
            Value* bounded =
                b.CreateAnd(made, llvm::ConstantInt::get(made->getType(), (uint64_t{1} << bits_[node]) - 1));
            masks_.emplace_back(bounded);
            node->replaceAllUsesWith(b.CreateUIToFP(bounded, node->getType()));
        }
        for (auto& [node, made] : nodes_)
            node->eraseFromParent();
    }

    llvm::Function& function_;
    llvm::FunctionAnalysisManager& analyses_;
    std::vector<llvm::WeakTrackingVH>& masks_;
    llvm::DenseMap<Value*, unsigned> bits_;
    llvm::MapVector<llvm::Instruction*, llvm::Instruction*> nodes_; ///< and what replaces them
};

/// True when something has changed.
bool simplifyWholes(llvm::Function& function, llvm::FunctionAnalysisManager& analyses) {
    const llvm::PreservedAnalyses replaced = WholeAfterCheck().run(function, analyses);
    analyses.invalidate(function, replaced);
    const llvm::PreservedAnalyses computed = WholeArithmetic().run(function, analyses);
    if (computed.areAllPreserved()) return !replaced.areAllPreserved();
    analyses.invalidate(function, computed);
    analyses.invalidate(function, llvm::InstCombinePass().run(function, analyses));
    return true;
}

/// The number of rounds that a loop makes is found where its counter is a phi, not the lowest bits of one.
void dropMasks(const std::vector<llvm::WeakTrackingVH>& masks) {
    for (const llvm::WeakTrackingVH& mask : masks) {
        auto* lowest = llvm::dyn_cast_or_null<llvm::BinaryOperator>(static_cast<Value*>(mask));
        if (lowest == nullptr || lowest->getOpcode() != llvm::Instruction::And) continue;
        auto* phi = llvm::dyn_cast<llvm::PHINode>(lowest->getOperand(0));
        if (phi != nullptr && llvm::isa<llvm::ConstantInt>(lowest->getOperand(1)))
            lowest->replaceAllUsesWith(phi);
    }
}

} // namespace

llvm::PreservedAnalyses IntegralValues::run(llvm::Function& function,
                                            llvm::FunctionAnalysisManager& analyses) {
    constexpr int kMostRounds = 4; // a variable may depend on another one that has become an integer
    llvm::PreservedAnalyses preserved;
    preserved.preserveSet<llvm::CFGAnalyses>();
    llvm::PreservedAnalyses asKnownBefore = llvm::PreservedAnalyses::all();
    asKnownBefore.abandon<llvm::LazyValueAnalysis>(); // it keeps what it once could not tell
    analyses.invalidate(function, asKnownBefore);
    bool changed = simplifyWholes(function, analyses);
    std::vector<llvm::WeakTrackingVH> masks;
    for (int round = 0; round < kMostRounds && Web(function, analyses, masks).run(); ++round) {
        changed = true;
        analyses.invalidate(function, preserved);
        analyses.invalidate(function, llvm::InstCombinePass().run(function, analyses));
        analyses.invalidate(function, llvm::EarlyCSEPass().run(function, analyses));
        analyses.invalidate(function, llvm::InstCombinePass().run(function, analyses));
        simplifyWholes(function, analyses);
    }
    dropMasks(masks);
    return changed ? llvm::PreservedAnalyses::none() : llvm::PreservedAnalyses::all();
}

} // namespace codegen
