#include "codegen/whole_numbers.h"

#include <llvm/ADT/APSInt.h>
#include <llvm/Analysis/LazyValueInfo.h>
#include <llvm/Analysis/ScalarEvolution.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/PatternMatch.h>
#include <llvm/Transforms/Utils/Local.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "codegen/preserved.h"

namespace codegen {
namespace {

using llvm::Value;
using namespace llvm::PatternMatch;

/// Whether the whole number is never 0 when the branch is taken.
bool isNeverZero(Value* whole, llvm::BranchInst& branch, llvm::LazyValueInfo& ranges) {
    const llvm::ConstantRange range =
        ranges.getConstantRangeOnEdge(whole, branch.getParent(), branch.getSuccessor(0), &branch);
    return !range.contains(llvm::APInt::getZero(range.getBitWidth()));
}

/// Computes with integers what floating-point instructions compute exactly.
class Wholes {
  public:
    Wholes(llvm::Function& function, llvm::FunctionAnalysisManager& analyses)
        : function_(function), analyses_(analyses) {}

    bool run() {
        std::vector<llvm::Instruction*> found;
        for (llvm::Instruction& inst : llvm::instructions(function_))
            if (!inst.getType()->isVectorTy() && mayBeCandidate(inst)) found.push_back(&inst);
        bool changed = false;
        for (llvm::Instruction* inst : found) {
            // Its operands may be what has just been made.
            Value* made = isCandidate(*inst) ? replacement(*inst) : nullptr;
            if (!made) continue;
            inst->replaceAllUsesWith(made);
            changed = true;
        }
        for (llvm::Instruction* inst : found)
            if (inst->use_empty()) inst->eraseFromParent();
        return changed;
    }

  private:
    /// A whole number as a signed integer of kWide bits, and its bounds.
    struct Whole {
        Value* value = nullptr; ///< as converted; null: a constant
        bool isSigned = true;
        llvm::ConstantRange range{kWide, true};
    };
    static constexpr unsigned kWide = 128; // room for a product

    static bool mayBeCandidate(const llvm::Instruction& inst) {
        switch (inst.getOpcode()) {
        case llvm::Instruction::FAdd:
        case llvm::Instruction::FSub:
        case llvm::Instruction::FMul:
        case llvm::Instruction::FCmp:
        case llvm::Instruction::FPToSI: return true;
        default: return isSaturated(inst);
        }
    }

    static bool isCandidate(const llvm::Instruction& inst) {
        return convertedWhole(inst.getOperand(0)) ||
               (!llvm::isa<llvm::CastInst>(inst) && !isSaturated(inst) && convertedWhole(inst.getOperand(1)));
    }

    /// A conversion that gives the nearest integer where the number is out of range (bounds of loops).
    static bool isSaturated(const llvm::Instruction& inst) {
        const auto* call = llvm::dyn_cast<llvm::IntrinsicInst>(&inst);
        return call && call->getIntrinsicID() == llvm::Intrinsic::fptosi_sat;
    }

    /// A constant; null: it is not a whole number.
    static std::optional<Whole> wholeConstant(const Value* value) {
        const auto* constant = llvm::dyn_cast<llvm::ConstantFP>(value);
        if (!constant || constant->getValueAPF().isNegZero()) return std::nullopt;
        llvm::APSInt number(kWide, /*isUnsigned=*/false);
        bool isExact = false;
        if (constant->getValueAPF().convertToInteger(number, llvm::APFloat::rmTowardZero, &isExact) !=
            llvm::APFloat::opOK)
            return std::nullopt;
        Whole result;
        result.range = llvm::ConstantRange(number);
        return result;
    }

    /// One of two constants: the step of a loop that counts up or down.
    static std::optional<Whole> wholeChoice(Value* value) {
        auto* select = llvm::dyn_cast<llvm::SelectInst>(value);
        if (!select || select->getType()->isVectorTy()) return std::nullopt;
        const auto a = wholeConstant(select->getTrueValue()), b = wholeConstant(select->getFalseValue());
        constexpr unsigned kStepBits = 16;
        if (!a || !b || !fits(a->range, kStepBits) || !fits(b->range, kStepBits)) return std::nullopt;
        llvm::IRBuilder<> builder(select);
        const auto integer = [&](const Whole& whole) {
            return builder.getInt32(static_cast<uint32_t>(whole.range.getSingleElement()->getSExtValue()));
        };
        Whole result;
        result.value = builder.CreateSelect(select->getCondition(), integer(*a), integer(*b));
        result.range = a->range.unionWith(b->range, llvm::ConstantRange::Signed);
        return result;
    }

    std::optional<Whole> whole(Value* value, llvm::Instruction& at) {
        if (const auto constant = wholeConstant(value))
            return fits(constant->range, exactBits(value->getType()) + 1) ? constant : std::nullopt;
        Whole result;
        Value* converted = convertedWhole(value);
        if (!converted) return wholeChoice(value);
        result.value = converted;
        result.isSigned = llvm::isa<llvm::SIToFPInst>(value);
        const llvm::ConstantRange known = rangeOfWhole(converted, &at, analyses_);
        result.range = result.isSigned ? known.signExtend(kWide) : known.zeroExtend(kWide);
        if (!fits(result.range, exactBits(value->getType()) + 1)) return std::nullopt;
        return result;
    }

    static bool fits(const llvm::ConstantRange& range, unsigned bits) {
        return !range.isEmptySet() && range.getSignedMin().isSignedIntN(bits) &&
               range.getSignedMax().isSignedIntN(bits);
    }

    Value* replacement(llvm::Instruction& inst) {
        const auto a = whole(inst.getOperand(0), inst);
        if (!a) return nullptr;
        llvm::IRBuilder<> b(&inst);
        if (llvm::isa<llvm::FPToSIInst>(inst) || isSaturated(inst)) {
            auto* type = llvm::cast<llvm::IntegerType>(inst.getType());
            return fits(a->range, type->getBitWidth()) ? integer(b, *a, type) : nullptr;
        }
        const auto c = whole(inst.getOperand(1), inst);
        if (!c) return nullptr;
        auto* type = b.getIntNTy(inst.getOperand(0)->getType()->isFloatTy() ? 32 : 64);
        if (const auto* compare = llvm::dyn_cast<llvm::FCmpInst>(&inst)) {
            const auto predicate = integerPredicate(compare->getPredicate());
            if (predicate == llvm::CmpInst::BAD_ICMP_PREDICATE) return nullptr;
            return b.CreateICmp(predicate, integer(b, *a, type), integer(b, *c, type));
        }
        const auto operation = static_cast<llvm::Instruction::BinaryOps>(
            inst.getOpcode() == llvm::Instruction::FAdd   ? llvm::Instruction::Add
            : inst.getOpcode() == llvm::Instruction::FSub ? llvm::Instruction::Sub
                                                          : llvm::Instruction::Mul);
        if (operation == llvm::Instruction::Mul && mayGiveMinusZero(a->range, c->range)) return nullptr;
        if (!fits(a->range.binaryOp(operation, c->range), exactBits(inst.getType()) + 1)) return nullptr;
        auto* result = b.CreateBinOp(operation, integer(b, *a, type), integer(b, *c, type));
        if (auto* made = llvm::dyn_cast<llvm::BinaryOperator>(result)) made->setHasNoSignedWrap();
        return b.CreateSIToFP(result, inst.getType());
    }

    static bool mayGiveMinusZero(const llvm::ConstantRange& a, const llvm::ConstantRange& b) {
        const llvm::APInt zero = llvm::APInt::getZero(kWide);
        return (a.contains(zero) && b.getSignedMin().isNegative()) ||
               (b.contains(zero) && a.getSignedMin().isNegative());
    }

    static Value* integer(llvm::IRBuilder<>& b, const Whole& whole, llvm::IntegerType* type) {
        if (!whole.value)
            return llvm::ConstantInt::get(type, whole.range.getSingleElement()->trunc(type->getBitWidth()));
        return whole.isSigned ? b.CreateSExtOrTrunc(whole.value, type)
                              : b.CreateZExtOrTrunc(whole.value, type);
    }

    /// Neither side is NaN.
    static llvm::CmpInst::Predicate integerPredicate(llvm::FCmpInst::Predicate predicate) {
        switch (predicate) {
        case llvm::CmpInst::FCMP_OEQ:
        case llvm::CmpInst::FCMP_UEQ: return llvm::CmpInst::ICMP_EQ;
        case llvm::CmpInst::FCMP_ONE:
        case llvm::CmpInst::FCMP_UNE: return llvm::CmpInst::ICMP_NE;
        case llvm::CmpInst::FCMP_OLT:
        case llvm::CmpInst::FCMP_ULT: return llvm::CmpInst::ICMP_SLT;
        case llvm::CmpInst::FCMP_OLE:
        case llvm::CmpInst::FCMP_ULE: return llvm::CmpInst::ICMP_SLE;
        case llvm::CmpInst::FCMP_OGT:
        case llvm::CmpInst::FCMP_UGT: return llvm::CmpInst::ICMP_SGT;
        case llvm::CmpInst::FCMP_OGE:
        case llvm::CmpInst::FCMP_UGE: return llvm::CmpInst::ICMP_SGE;
        default: return llvm::CmpInst::BAD_ICMP_PREDICATE;
        }
    }

    llvm::Function& function_;
    llvm::FunctionAnalysisManager& analyses_;
};

} // namespace

llvm::Value* convertedWhole(const llvm::Value* value) {
    const auto* cast = llvm::dyn_cast<llvm::CastInst>(value);
    const bool converts = cast && (cast->getOpcode() == llvm::Instruction::SIToFP ||
                                   cast->getOpcode() == llvm::Instruction::UIToFP);
    return converts && !cast->getType()->isVectorTy() ? cast->getOperand(0) : nullptr;
}

namespace {

/// Finds the range of a whole number. In large routines LazyValueInfo gives up soon, so operands are looked at as well.
class RangeSearch {
  public:
    /// The use of a number: an instruction, or the edge from that, the end of a block, to another block.
    struct Place {
        llvm::Instruction* at = nullptr;
        llvm::BasicBlock* to = nullptr;
    };

    explicit RangeSearch(llvm::FunctionAnalysisManager& analyses) : analyses_(analyses) {}

    llvm::ConstantRange range(Value* whole, Place place, unsigned depth) {
        llvm::Function& function = *place.at->getFunction();
        llvm::ConstantRange range = llvm::ConstantRange::fromKnownBits(
            llvm::computeKnownBits(whole, function.getDataLayout()), /*IsSigned=*/false);
        auto& ranges = analyses_.getResult<llvm::LazyValueAnalysis>(function);
        range = range.intersectWith(ranges.getConstantRange(whole, place.at, /*UndefAllowed=*/false));
        if (place.to != nullptr)
            range = range.intersectWith(
                ranges.getConstantRangeOnEdge(whole, place.at->getParent(), place.to, place.at));
        auto& evolution = analyses_.getResult<llvm::ScalarEvolutionAnalysis>(function);
        if (evolution.isSCEVable(whole->getType()))
            range = range.intersectWith(evolution.getUnsignedRange(evolution.getSCEV(whole)));
        auto* inst = llvm::dyn_cast<llvm::Instruction>(whole);
        if (inst && range.getUnsignedMax().getActiveBits() > kUseful)
            range = range.intersectWith(fromChecks(*inst, place));
        if (depth == 0 || !inst || range.getUnsignedMax().getActiveBits() <= kKnownWell) return range;
        return range.intersectWith(fromOperands(*inst, place, depth - 1));
    }

  private:
    static constexpr unsigned kKnownWell = 8; // positions and bytes: operands would hardly tell more
    static constexpr unsigned kUseful = 24;   // exact in F32
    static constexpr unsigned kMostOperands = 12;
    static constexpr unsigned kMostLooks = 40;  // in one search
    static constexpr unsigned kMostChecks = 16; // on the way to a place

    /// The range that the branches on the way from the instruction to the place leave. LazyValueInfo gives up where the way leads through
    /// another loop.
    llvm::ConstantRange fromChecks(llvm::Instruction& whole, Place place) {
        llvm::Function& function = *whole.getFunction();
        auto& ranges = analyses_.getResult<llvm::LazyValueAnalysis>(function);
        auto& dominators = analyses_.getResult<llvm::DominatorTreeAnalysis>(function);
        llvm::ConstantRange range(whole.getType()->getIntegerBitWidth(), /*isFullSet=*/true);
        auto* node = dominators.getNode(place.at->getParent());
        for (unsigned i = 0; node != nullptr && i < kMostChecks; ++i, node = node->getIDom()) {
            llvm::BasicBlock* block = node->getBlock();
            if (block == whole.getParent()) break;
            llvm::BasicBlock* before = block->getSinglePredecessor();
            if (before == nullptr) continue;
            range = range.intersectWith(ranges.getConstantRangeOnEdge(&whole, before, block, place.at));
        }
        return range;
    }

    /// Operands are looked at where the result is used: checks of them that follow count as well.
    llvm::ConstantRange fromOperands(llvm::Instruction& inst, Place place, unsigned depth) {
        const llvm::ConstantRange unknown(inst.getType()->getIntegerBitWidth(), /*isFullSet=*/true);
        if (++looks_ > kMostLooks) return unknown;
        const auto operand = [&](unsigned i) { return range(inst.getOperand(i), place, depth); };
        if (const auto* operation = llvm::dyn_cast<llvm::BinaryOperator>(&inst))
            return operand(0).binaryOp(operation->getOpcode(), operand(1));
        if (llvm::isa<llvm::ZExtInst>(inst) || llvm::isa<llvm::SExtInst>(inst) ||
            llvm::isa<llvm::TruncInst>(inst))
            return operand(0).castOp(llvm::cast<llvm::CastInst>(inst).getOpcode(),
                                     inst.getType()->getIntegerBitWidth());
        if (llvm::isa<llvm::SelectInst>(inst)) return operand(1).unionWith(operand(2));
        // Only conversions, which have no operand here, give poison where their result is used.
        if (llvm::isa<llvm::FreezeInst>(inst) && !llvm::isa<llvm::FPToSIInst>(inst.getOperand(0)))
            return operand(0);
        if (const auto* extreme = llvm::dyn_cast<llvm::MinMaxIntrinsic>(&inst))
            return llvm::ConstantRange::intrinsic(extreme->getIntrinsicID(), {operand(0), operand(1)});
        auto* phi = llvm::dyn_cast<llvm::PHINode>(&inst);
        if (!phi || phi->getNumIncomingValues() > kMostOperands) return unknown;
        llvm::ConstantRange all(unknown.getBitWidth(), /*isFullSet=*/false);
        for (unsigned i = 0; i < phi->getNumIncomingValues() && !all.isFullSet(); ++i)
            all = all.unionWith(range(phi->getIncomingValue(i),
                                      {phi->getIncomingBlock(i)->getTerminator(), phi->getParent()}, depth));
        return all;
    }

    llvm::FunctionAnalysisManager& analyses_;
    unsigned looks_ = 0;
};

} // namespace

llvm::ConstantRange rangeOfWhole(llvm::Value* whole, llvm::Instruction* at,
                                 llvm::FunctionAnalysisManager& analyses, unsigned depth) {
    return RangeSearch(analyses).range(whole, {at, nullptr}, depth);
}

llvm::ConstantRange rangeOfIncoming(llvm::Value* whole, const llvm::PHINode& phi, unsigned operand,
                                    llvm::FunctionAnalysisManager& analyses) {
    auto* to = const_cast<llvm::BasicBlock*>(phi.getParent());
    constexpr unsigned kDepth = 4;
    return RangeSearch(analyses).range(whole, {phi.getIncomingBlock(operand)->getTerminator(), to}, kDepth);
}

unsigned exactBits(const llvm::Type* type) {
    return type->isFloatTy() ? 24 : 53;
}

bool mayBecomeInteger(Value* value) {
    constexpr size_t kMost = 64;
    std::vector<Value*> reached{value};
    for (size_t i = 0; i < reached.size(); ++i) {
        if (reached.size() > kMost) return false;
        if (llvm::isa<llvm::Constant>(reached[i]) || convertedWhole(reached[i])) continue;
        const auto* inst = llvm::dyn_cast<llvm::Instruction>(reached[i]);
        if (!inst) return false;
        const bool isSelect = inst->getOpcode() == llvm::Instruction::Select;
        if (!isSelect && !llvm::isa<llvm::PHINode>(inst) && inst->getOpcode() != llvm::Instruction::FAdd &&
            inst->getOpcode() != llvm::Instruction::FSub && inst->getOpcode() != llvm::Instruction::FMul)
            return false;
        for (unsigned k = isSelect ? 1 : 0; k < inst->getNumOperands(); ++k)
            if (std::find(reached.begin(), reached.end(), inst->getOperand(k)) == reached.end())
                reached.push_back(inst->getOperand(k));
    }
    return true;
}

llvm::PreservedAnalyses WholeAfterCheck::run(llvm::Function& function,
                                             llvm::FunctionAnalysisManager& analyses) {
    auto& dominators = analyses.getResult<llvm::DominatorTreeAnalysis>(function);
    auto& ranges = analyses.getResult<llvm::LazyValueAnalysis>(function);
    bool changed = false;
    for (llvm::BasicBlock& block : function) {
        auto* branch = llvm::dyn_cast<llvm::BranchInst>(block.getTerminator());
        if (!branch || !branch->isConditional() || branch->getSuccessor(0) == branch->getSuccessor(1))
            continue;
        llvm::FCmpInst::Predicate predicate = llvm::FCmpInst::BAD_FCMP_PREDICATE;
        Value *number = nullptr, *converted = nullptr, *whole = nullptr;
        if (!match(branch->getCondition(), m_FCmp(predicate, m_Value(number), m_Value(converted))) ||
            predicate != llvm::CmpInst::FCMP_OEQ)
            continue;
        if (!match(converted, m_SIToFP(m_Value(whole))) && !match(converted, m_UIToFP(m_Value(whole))))
            std::swap(number, converted);
        if (!match(converted, m_SIToFP(m_Value(whole))) && !match(converted, m_UIToFP(m_Value(whole))))
            continue;
        if (llvm::isa<llvm::Constant>(number) || match(number, m_SIToFP(m_Value())) ||
            match(number, m_UIToFP(m_Value())) || whole->getType()->isVectorTy() ||
            !mayBecomeInteger(number) || !isNeverZero(whole, *branch, ranges))
            continue;
        const llvm::BasicBlockEdge edge(&block, branch->getSuccessor(0));
        changed |= llvm::replaceDominatedUsesWith(number, converted, dominators, edge) > 0;
    }
    return preservingBlocks(changed);
}

llvm::PreservedAnalyses WholeArithmetic::run(llvm::Function& function,
                                             llvm::FunctionAnalysisManager& analyses) {
    return preservingBlocks(Wholes(function, analyses).run());
}

} // namespace codegen
