#include "codegen/integral_values.h"

#include <llvm/ADT/DenseMap.h>
#include <llvm/Analysis/LazyValueInfo.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/Transforms/InstCombine/InstCombine.h>
#include <llvm/Transforms/Scalar/EarlyCSE.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "codegen/whole_divisions.h"
#include "codegen/whole_numbers.h"

namespace codegen {
namespace {

using llvm::Value;

/// The operands on which the number depends.
std::vector<unsigned> operandsOf(const llvm::Instruction& node) {
    if (llvm::isa<llvm::SelectInst>(node)) return {1, 2};
    if (!llvm::isa<llvm::PHINode>(node)) return {0, 1};
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
            if ((inst.getType()->isFloatTy() || inst.getType()->isDoubleTy()) && mayBeNode(inst)) {
                order_.push_back(&inst);
                nodes_.insert({&inst, nullptr});
            }
        do
            dropUnless([&](const llvm::Instruction& node) { return isMadeOfWholes(node); });
        while (dropLarge());
        // If no value is divided, converted back or compared with a converted one, the floating-point number is the result.
        dropUnless([&](const llvm::Instruction& node) {
            return isWholeDivision(node) ||
                   std::any_of(node.user_begin(), node.user_end(), [&](const llvm::User* user) {
                       return llvm::isa<llvm::FPToSIInst>(user) || llvm::isa<llvm::FPToUIInst>(user) ||
                              comparesWholes(*user) || contains(user);
                   });
        });
        dropUnless([&](const llvm::Instruction& node) { return isMadeOfWholes(node); });
        if (nodes_.empty()) return false;
        replace();
        return true;
    }

  private:
    /// Sums and products become integers with what they are divided by; others do in WholeArithmetic.
    static bool mayBeNode(const llvm::Instruction& inst) {
        switch (inst.getOpcode()) {
        case llvm::Instruction::PHI:
        case llvm::Instruction::Select:
        case llvm::Instruction::FAdd:
        case llvm::Instruction::FMul: return true;
        default: return isWholeDivision(inst);
        }
    }

    bool contains(const Value* value) const {
        const auto* inst = llvm::dyn_cast<llvm::Instruction>(value);
        return inst && nodes_.contains(inst);
    }

    /// Removes nodes until all that are left meet the condition.
    template <class Keep> bool dropUnless(Keep keep) {
        const size_t before = order_.size();
        for (size_t left = before + 1; order_.size() < left;) {
            left = order_.size();
            llvm::erase_if(order_,
                           [&](llvm::Instruction* node) { return !keep(*node) && nodes_.erase(node); });
        }
        return order_.size() < before;
    }

    static bool comparesWholes(const llvm::User& user) {
        return llvm::isa<llvm::FCmpInst>(user) &&
               (convertedWhole(user.getOperand(0)) || convertedWhole(user.getOperand(1)));
    }

    bool isMadeOfWholes(const llvm::Instruction& node) {
        const std::vector<unsigned> operands = operandsOf(node);
        return std::all_of(operands.begin(), operands.end(),
                           [&](unsigned i) { return contains(node.getOperand(i)) || isWhole(node, i); });
    }

    bool isWhole(const llvm::Instruction& node, unsigned i) {
        const double most = largest(node, i);
        return most <= exact(node) && (most >= 1 || i == 0 || !isWholeDivision(node));
    }

    /// Whole numbers up to here are exact.
    static double exact(const llvm::Instruction& node) {
        return std::ldexp(1.0, static_cast<int>(exactBits(node.getType()))) - 1;
    }

    /// The largest value of an operand that is not a node; infinity: it may be negative, or have decimals.
    double largest(const llvm::Instruction& node, unsigned i) {
        const auto [found, isNew] = known_.try_emplace(&node.getOperandUse(i), kUnlimited);
        if (isNew) found->second = findLargest(node, i);
        return found->second;
    }

    double findLargest(const llvm::Instruction& node, unsigned i) const {
        Value* value = node.getOperand(i);
        if (llvm::isa<llvm::UndefValue>(value)) return 0;
        if (const auto* constant = llvm::dyn_cast<llvm::ConstantFP>(value)) {
            const double number = constant->getValueAPF().convertToDouble();
            return number >= 0 && !std::signbit(number) && number == std::trunc(number) ? number : kUnlimited;
        }
        Value* from = convertedWhole(value);
        if (!from) return kUnlimited;
        // Checks on the way to where it takes effect bound it.
        const auto* phi = llvm::dyn_cast<llvm::PHINode>(&node);
        const llvm::ConstantRange range =
            phi ? rangeOfIncoming(from, *phi, i, analyses_)
                : rangeOfWhole(from, const_cast<llvm::Instruction*>(&node), analyses_);
        return range.getUnsignedMax().roundToDouble(/*isSigned=*/false);
    }

    /// By what is known so far.
    double largestNow(const llvm::Instruction& node, unsigned i) {
        const auto found = most_.find(node.getOperand(i));
        return found == most_.end() ? largest(node, i) : found->second;
    }

    double largestResult(const llvm::Instruction& node) {
        if (node.getOpcode() == llvm::Instruction::FAdd) return largestNow(node, 0) + largestNow(node, 1);
        if (node.getOpcode() == llvm::Instruction::FMul) return largestNow(node, 0) * largestNow(node, 1);
        if (isWholeDivision(node)) {
            const double number = largestNow(node, 0);
            const auto* constant = llvm::dyn_cast<llvm::ConstantFP>(node.getOperand(1));
            if (isWholeRemainder(node)) return std::min(number, std::max(0.0, largestNow(node, 1) - 1));
            return constant ? std::trunc(number / constant->getValueAPF().convertToDouble()) : number;
        }
        double most = 0;
        for (const unsigned i : operandsOf(node))
            most = std::max(most, largestNow(node, i));
        return most;
    }

    /// Finds the largest number of each node; removes those that may be too large. True when there were some.
    bool dropLarge() {
        constexpr unsigned kRounds = 10; // what still grows then is unlimited
        most_.clear();
        for (const llvm::Instruction* node : order_)
            most_[node] = 0;
        bool changed = true;
        for (unsigned round = 0; changed; ++round) {
            changed = false;
            for (const llvm::Instruction* node : order_) {
                double& most = most_[node];
                const double now = largestResult(*node);
                if (!(now > most)) continue;
                most = round < kRounds ? now : kUnlimited;
                changed = true;
            }
        }
        return dropUnless([&](const llvm::Instruction& node) { return most_[&node] <= exact(node); });
    }

    /// Of whole numbers up to this one.
    static unsigned bitsFor(double most) {
        return static_cast<unsigned>(std::ilogb(std::max(1.0, most))) + 1;
    }

    unsigned bitsOf(const Value* node) const { return bitsFor(most_.lookup(node)); }

    /// Bytes stay bytes: of a wider integer, the upper bits would have to be cleared in each round of a loop.
    llvm::IntegerType* integerFor(const llvm::Instruction& node) {
        constexpr unsigned kByte = 8, kWord = 32;
        unsigned bits = bitsOf(&node);
        const bool chooses = llvm::isa<llvm::PHINode>(node) || llvm::isa<llvm::SelectInst>(node);
        if (!chooses)
            for (const unsigned i : operandsOf(node))
                bits = std::max(bits, bitsFor(largestNow(node, i)));
        const unsigned width = chooses && bits <= kByte ? kByte : bits < kWord ? kWord : 2 * kWord;
        return llvm::IntegerType::get(function_.getContext(), width);
    }

    Value* integer(Value* value, llvm::Type* type, llvm::Instruction* before) {
        const auto* inst = llvm::dyn_cast<llvm::Instruction>(value);
        if (const auto found = nodes_.find(inst); inst != nullptr && found != nodes_.end())
            return llvm::IRBuilder<>(before).CreateZExtOrTrunc(found->second, type);
        if (llvm::isa<llvm::UndefValue>(value)) return llvm::ConstantInt::get(type, 0);
        if (const auto* constant = llvm::dyn_cast<llvm::ConstantFP>(value))
            return llvm::ConstantInt::get(type,
                                          static_cast<uint64_t>(constant->getValueAPF().convertToDouble()));
        return llvm::IRBuilder<>(before).CreateZExtOrTrunc(convertedWhole(value), type);
    }

    /// The integer instruction in place of a node; operands follow when all are made.
    llvm::Instruction* make(llvm::Instruction& node) {
        llvm::Type* type = integerFor(node);
        Value* none = llvm::PoisonValue::get(type);
        if (const auto* phi = llvm::dyn_cast<llvm::PHINode>(&node))
            return llvm::IRBuilder<>(&node).CreatePHI(type, phi->getNumIncomingValues());
        if (llvm::isa<llvm::SelectInst>(node))
            return llvm::SelectInst::Create(node.getOperand(0), none, none, "", node.getIterator());
        const auto operation = node.getOpcode() == llvm::Instruction::FAdd   ? llvm::Instruction::Add
                               : node.getOpcode() == llvm::Instruction::FMul ? llvm::Instruction::Mul
                               : isWholeRemainder(node)                      ? llvm::Instruction::URem
                                                                             : llvm::Instruction::UDiv;
        auto* made = llvm::BinaryOperator::Create(operation, none, none, "", node.getIterator());
        if (isWholeDivision(node)) return made;
        made->setHasNoUnsignedWrap();
        made->setHasNoSignedWrap();
        return made;
    }

    void connect(llvm::Instruction& node, llvm::Instruction& made) {
        llvm::Type* type = made.getType();
        if (const auto* phi = llvm::dyn_cast<llvm::PHINode>(&node)) {
            for (unsigned i = 0; i < phi->getNumIncomingValues(); ++i)
                llvm::cast<llvm::PHINode>(made).addIncoming(
                    integer(phi->getIncomingValue(i), type, phi->getIncomingBlock(i)->getTerminator()),
                    phi->getIncomingBlock(i));
            return;
        }
        for (const unsigned i : operandsOf(node))
            made.setOperand(i, integer(node.getOperand(i), type, &made));
        // A division by 0 may have been moved before the check of the divisor, which must not end the process.
        if (isWholeDivision(node))
            made.setOperand(
                1, llvm::IRBuilder<>(&made).CreateBinaryIntrinsic(llvm::Intrinsic::umax, made.getOperand(1),
                                                                  llvm::ConstantInt::get(type, 1)));
    }

    void replace() {
        for (auto* node : order_)
            nodes_[node] = make(*node);
        for (auto* node : order_)
            connect(*node, *nodes_[node]);
        for (auto* node : order_) {
            llvm::Instruction* made = nodes_[node];
            const bool isPhi = llvm::isa<llvm::PHINode>(node);
            llvm::IRBuilder<> b(isPhi ? &*node->getParent()->getFirstInsertionPt() : made->getNextNode());
            Value* bounded = made;
            if (isPhi || llvm::isa<llvm::SelectInst>(node)) {
                // Ranges of numbers get lost in loops; the mask keeps them.
                bounded = b.CreateAnd(
                    made, llvm::ConstantInt::get(made->getType(), (uint64_t{1} << bitsOf(node)) - 1));
                masks_.emplace_back(bounded);
            }
            node->replaceAllUsesWith(b.CreateUIToFP(bounded, node->getType()));
        }
        for (auto* node : order_)
            node->eraseFromParent();
    }

    static constexpr double kUnlimited = std::numeric_limits<double>::infinity();

    llvm::Function& function_;
    llvm::FunctionAnalysisManager& analyses_;
    std::vector<llvm::WeakTrackingVH>& masks_;
    std::vector<llvm::Instruction*> order_;                              ///< of the nodes
    llvm::DenseMap<const llvm::Instruction*, llvm::Instruction*> nodes_; ///< and what replaces them
    llvm::DenseMap<const Value*, double> most_;                          ///< the largest number of a node
    llvm::DenseMap<const llvm::Use*, double> known_;                     ///< of other operands
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
