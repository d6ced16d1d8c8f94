#include "codegen/whole_divisions.h"

#include <llvm/ADT/MapVector.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/MDBuilder.h>
#include <llvm/IR/Module.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "codegen/abi_types.h"
#include "codegen/whole_numbers.h"
#include "runtime/abi/support_natives.h"

namespace codegen {
namespace {

using llvm::Value;

constexpr WholeDivision kKinds[] = {WholeDivision::Quotient, WholeDivision::Remainder};

/// In LLVM's unit, of which an instruction costs five: a multiplication or division with its corrections.
constexpr const char* kInlineCost = "15";

const char* nameOf(WholeDivision wanted, const llvm::Type* type) {
    if (wanted == WholeDivision::Quotient)
        return type->isFloatTy() ? "rapidc.quotient.f32" : "rapidc.quotient.f64";
    return type->isFloatTy() ? "rapidc.remainder.f32" : "rapidc.remainder.f64";
}

llvm::Function* declare(llvm::Module& module, WholeDivision wanted, llvm::Type* type) {
    const char* name = nameOf(wanted, type);
    if (llvm::Function* known = module.getFunction(name)) return known;
    auto* function = llvm::Function::Create(llvm::FunctionType::get(type, {type, type}, false),
                                            llvm::GlobalValue::ExternalLinkage, name, module);
    function->setDoesNotAccessMemory();
    function->setDoesNotThrow();
    function->setWillReturn();
    function->addFnAttr(llvm::Attribute::Speculatable);
    function->addFnAttr("call-inline-cost", kInlineCost);
    return function;
}

const llvm::Function* calleeOf(const Value& value) {
    const auto* call = llvm::dyn_cast<llvm::CallInst>(&value);
    const llvm::Function* callee = call ? call->getCalledFunction() : nullptr;
    return callee && callee->isDeclaration() && callee->getName().starts_with("rapidc.") ? callee : nullptr;
}

bool asksFor(const Value& value, WholeDivision wanted) {
    const llvm::Function* callee = calleeOf(value);
    return callee && callee->getName() == nameOf(wanted, callee->getReturnType());
}

/// Calls with the same operands; the first of them dominates the others.
using Group = std::vector<llvm::CallInst*>;

struct Results {
    Value *quotient = nullptr, *remainder = nullptr; ///< remainder: null when it is not wanted
};

class Expansion {
  public:
    explicit Expansion(const Group& group)
        : group_(group), number_(group[0]->getArgOperand(0)), divisor_(group[0]->getArgOperand(1)),
          type_(group[0]->getType()), b_(group[0]) {
        for (const llvm::CallInst* call : group)
            wantsRemainder_ |= asksFor(*call, WholeDivision::Remainder);
    }

    void replace() {
        const Results results = hasInverse() ? multiplied() : divided(group_[0]);
        for (llvm::CallInst* call : group_) {
            const bool remainder = asksFor(*call, WholeDivision::Remainder);
            call->replaceAllUsesWith(remainder ? results.remainder : results.quotient);
            call->eraseFromParent();
        }
    }

  private:
    /// Whole numbers up to here and their neighbours are exact.
    double largest() const { return std::ldexp(1.0, static_cast<int>(exactBits(type_)) - 1); }

    bool hasInverse() const {
        const auto* constant = llvm::dyn_cast<llvm::ConstantFP>(divisor_);
        if (!constant) return false;
        const double value = constant->getValueAPF().convertToDouble();
        return value >= 2 && value <= largest() / 2 && value == std::trunc(value);
    }

    Value* whole(Value* value) { return b_.CreateUnaryIntrinsic(llvm::Intrinsic::trunc, value); }

    Results withQuotient(Value* quotient, bool remainder) {
        return {quotient, remainder ? b_.CreateFSub(number_, b_.CreateFMul(quotient, divisor_)) : nullptr};
    }

    /// A block that is executed when the condition holds, which is rare. The builder inserts there.
    llvm::Instruction* rarely(Value* condition, llvm::Instruction* before) {
        llvm::Instruction* end =
            llvm::SplitBlockAndInsertIfThen(condition, before->getIterator(), /*Unreachable=*/false,
                                            llvm::MDBuilder(b_.getContext()).createBranchWeights(1, 2000));
        b_.SetInsertPoint(end);
        return end;
    }

    /// The results of the rare way that has just been made, or those of the other.
    Results join(const Results& often, const Results& rare, llvm::Instruction* rareEnd) {
        llvm::BasicBlock *from = rareEnd->getParent(), *after = from->getSingleSuccessor();
        llvm::BasicBlock* other = nullptr;
        for (llvm::BasicBlock* way : llvm::predecessors(after))
            if (way != from) other = way;
        b_.SetInsertPoint(after, after->begin());
        const auto merge = [&](Value* first, Value* second) -> Value* {
            if (!first) return nullptr;
            llvm::PHINode* phi = b_.CreatePHI(type_, 2);
            phi->addIncoming(first, other);
            phi->addIncoming(second, from);
            return phi;
        };
        return {merge(often.quotient, rare.quotient), merge(often.remainder, rare.remainder)};
    }

    Results multiplied() {
        llvm::IntegerType* bits = b_.getIntNTy(type_->getPrimitiveSizeInBits());
        // Bits of numbers that are not negative have the order of the numbers.
        const auto bitsOf = [&](Value* value) { return b_.CreateBitCast(value, bits); };
        Value* inverse = b_.CreateFDiv(llvm::ConstantFP::get(type_, 1), divisor_);
        const Results fast = withQuotient(whole(b_.CreateFMul(number_, inverse)), true);
        Value* inRange = b_.CreateICmpULE(bitsOf(number_), bitsOf(llvm::ConstantFP::get(type_, largest())));
        Value* right = b_.CreateICmpULT(bitsOf(fast.remainder), bitsOf(divisor_));
        llvm::Instruction* end = rarely(b_.CreateNot(b_.CreateAnd(inRange, right)), group_[0]);
        const Results slow = divided(end);
        return join({fast.quotient, wantsRemainder_ ? fast.remainder : nullptr}, slow, end);
    }

    /// The quotient of two exact whole numbers is truncated correctly by the rounded division, because it differs from any
    /// whole number by more than half a unit in the last place.
    Results divided(llvm::Instruction* before) {
        const Results exact = withQuotient(whole(b_.CreateFDiv(number_, divisor_)), wantsRemainder_);
        Value* size = b_.CreateUnaryIntrinsic(llvm::Intrinsic::fabs, number_);
        Value* small = b_.CreateFCmpOLE(size, llvm::ConstantFP::get(type_, 2 * largest()));
        llvm::Instruction* end = rarely(b_.CreateNot(small), before);
        const Results large{byRuntime(WholeDivision::Quotient),
                            wantsRemainder_ ? byRuntime(WholeDivision::Remainder) : nullptr};
        return join(exact, large, end);
    }

    Value* byRuntime(WholeDivision wanted) {
        const bool remainder = wanted == WholeDivision::Remainder;
        static_assert(std::is_same_v<decltype(rt_wholeQuotient), decltype(rt_wholeRemainder)>);
        llvm::Module& module = *group_[0]->getModule();
        const char* name = remainder ? RAPIDC_SYMBOL(rt_wholeRemainder) : RAPIDC_SYMBOL(rt_wholeQuotient);
        llvm::Function* function = module.getFunction(name);
        if (!function) {
            function = abi::makeFunction<decltype(rt_wholeQuotient)>(module,
                                                                     llvm::GlobalValue::ExternalLinkage, name)
                           .function();
            function->setDoesNotAccessMemory();
            function->setDoesNotThrow();
            function->setWillReturn();
            function->addFnAttr(llvm::Attribute::Cold);
        }
        const auto wide = [&](Value* value) { return b_.CreateFPExt(value, b_.getDoubleTy()); };
        Value* result = b_.CreateCall(function, {wide(number_), wide(divisor_)});
        return b_.CreateFPTrunc(result, type_);
    }

    const Group& group_;
    Value *number_, *divisor_;
    llvm::Type* type_;
    llvm::IRBuilder<> b_;
    bool wantsRemainder_ = false;
};

std::vector<llvm::CallInst*> wholeDivisionsOf(llvm::Function& function) {
    std::vector<llvm::CallInst*> found;
    for (llvm::Instruction& inst : llvm::instructions(function))
        if (isWholeDivision(inst)) found.push_back(llvm::cast<llvm::CallInst>(&inst));
    return found;
}

} // namespace

Value* createWholeDivision(llvm::IRBuilderBase& b, WholeDivision wanted, Value* number, Value* divisor) {
    return b.CreateCall(declare(*b.GetInsertBlock()->getModule(), wanted, number->getType()),
                        {number, divisor});
}

bool isWholeDivision(const Value& value) {
    return asksFor(value, WholeDivision::Quotient) || asksFor(value, WholeDivision::Remainder);
}

bool isWholeRemainder(const Value& value) {
    return asksFor(value, WholeDivision::Remainder);
}

llvm::PreservedAnalyses WholeDivisions::run(llvm::Function& function,
                                            llvm::FunctionAnalysisManager& analyses) {
    const std::vector<llvm::CallInst*> calls = wholeDivisionsOf(function);
    if (calls.empty()) return llvm::PreservedAnalyses::all();
    const auto& dominators = analyses.getResult<llvm::DominatorTreeAnalysis>(function);
    llvm::MapVector<std::pair<Value*, Value*>, std::vector<Group>> byOperands;
    for (llvm::CallInst* call : calls) {
        std::vector<Group>& groups = byOperands[{call->getArgOperand(0), call->getArgOperand(1)}];
        const auto found = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
            return dominators.dominates(group[0], call);
        });
        if (found != groups.end())
            found->push_back(call);
        else
            groups.push_back({call});
    }
    for (const auto& [operands, groups] : byOperands)
        for (const Group& group : groups)
            Expansion(group).replace();
    return llvm::PreservedAnalyses::none();
}

void replaceWholeDivisions(llvm::Module& module) {
    for (const WholeDivision wanted : kKinds) {
        for (llvm::Type* type :
             {llvm::Type::getFloatTy(module.getContext()), llvm::Type::getDoubleTy(module.getContext())}) {
            llvm::Function* function = module.getFunction(nameOf(wanted, type));
            if (!function) continue;
            while (!function->use_empty())
                Expansion({llvm::cast<llvm::CallInst>(*function->user_begin())}).replace();
            function->eraseFromParent();
        }
    }
}

} // namespace codegen
