#include "codegen/small_copies.h"

#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/PatternMatch.h>

#include <optional>
#include <vector>

#include "codegen/preserved.h"

namespace codegen {
namespace {

using namespace llvm::PatternMatch;

/// As much as the variables of a routine may take without a look at the stack (routine_emitter).
constexpr uint64_t kSmall = 4096;

std::optional<uint64_t> bytesOf(const llvm::AllocaInst& memory) {
    const std::optional<llvm::TypeSize> size = memory.getAllocationSize(memory.getDataLayout());
    if (!size || size->isScalable()) return std::nullopt;
    return size->getFixedValue();
}

/// The room on the stack, as RoutineEmitter::stackAlloc asks for it.
bool isRoom(llvm::Value* value) {
    return match(value, m_Intrinsic<llvm::Intrinsic::usub_sat>(
                            m_PtrToInt(m_Intrinsic<llvm::Intrinsic::stacksave>()), m_Value()));
}

/// The branch before the memory compares the room with its size.
void dropCheck(llvm::AllocaInst& memory) {
    llvm::BasicBlock* before = memory.getParent()->getSinglePredecessor();
    auto* branch = before ? llvm::dyn_cast<llvm::BranchInst>(before->getTerminator()) : nullptr;
    if (branch == nullptr || !branch->isConditional() || branch->getSuccessor(0) == branch->getSuccessor(1))
        return;
    const auto* compared = llvm::dyn_cast<llvm::ICmpInst>(branch->getCondition());
    if (compared == nullptr || (!isRoom(compared->getOperand(0)) && !isRoom(compared->getOperand(1)))) return;
    const bool isFirst = branch->getSuccessor(0) == memory.getParent();
    branch->setCondition(llvm::ConstantInt::getBool(branch->getContext(), isFirst));
}

} // namespace

llvm::PreservedAnalyses SmallCopies::run(llvm::Function& function, llvm::FunctionAnalysisManager&) {
    std::vector<llvm::AllocaInst*> found;
    uint64_t all = 0;
    for (llvm::Instruction& inst : llvm::instructions(function)) {
        auto* memory = llvm::dyn_cast<llvm::AllocaInst>(&inst);
        const std::optional<uint64_t> bytes = memory ? bytesOf(*memory) : std::nullopt;
        if (!bytes) continue;
        all += *bytes;
        if (!memory->isStaticAlloca()) found.push_back(memory);
    }
    if (found.empty() || all > kSmall) return llvm::PreservedAnalyses::all();
    llvm::BasicBlock& entry = function.getEntryBlock();
    for (llvm::AllocaInst* memory : found) {
        const uint64_t bytes = *bytesOf(*memory);
        dropCheck(*memory);
        llvm::IRBuilder<> b(&entry, entry.begin());
        llvm::AllocaInst* fixed =
            b.CreateAlloca(llvm::ArrayType::get(b.getInt8Ty(), bytes), nullptr, memory->getName());
        fixed->setAlignment(memory->getAlign());
        memory->replaceAllUsesWith(fixed);
        memory->eraseFromParent();
    }
    return preservingBlocks(true);
}

} // namespace codegen
