#include "codegen/budget_loops.h"

#include <llvm/Analysis/AliasAnalysis.h>
#include <llvm/Analysis/AssumptionCache.h>
#include <llvm/Analysis/BlockFrequencyInfo.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Instructions.h>
#include <llvm/Transforms/Utils/LoopSimplify.h>
#include <llvm/Transforms/Utils/PromoteMemToReg.h>

#include <vector>

#include "codegen/abi_fields.h"
#include "runtime/abi/rt_abi.h"

namespace codegen {
namespace {

using llvm::BasicBlock;

static_assert(abi::kOffsetOf<&rt::TaskCore::budget> == 0, "the address of the task is that of its budget");

class Budget {
  public:
    Budget(llvm::Function& function, llvm::FunctionAnalysisManager& analyses)
        : task_(function.getArg(0)), dominators_(analyses.getResult<llvm::DominatorTreeAnalysis>(function)),
          loops_(analyses.getResult<llvm::LoopAnalysis>(function)),
          frequencies_(analyses.getResult<llvm::BlockFrequencyAnalysis>(function)),
          aliases_(analyses.getResult<llvm::AAManager>(function)),
          assumptions_(analyses.getResult<llvm::AssumptionAnalysis>(function)) {}

    bool run() {
        std::vector<llvm::Loop*> chosen;
        for (llvm::Loop* loop : loops_)
            choose(*loop, chosen);
        for (llvm::Loop* loop : chosen)
            keepInRegister(*loop);
        return !chosen.empty();
    }

  private:
    /// The outermost loops that pay, and call what looks at the budget on cold paths only.
    void choose(llvm::Loop& loop, std::vector<llvm::Loop*>& chosen) const {
        if (isWorthwhile(loop))
            chosen.push_back(&loop);
        else
            for (llvm::Loop* inner : loop)
                choose(*inner, chosen);
    }

    bool isWorthwhile(const llvm::Loop& loop) const {
        constexpr uint64_t kCold = 64;
        bool pays = false;
        for (const BasicBlock* block : loop.blocks()) {
            const bool isCold = frequencies_.getBlockFreq(block).getFrequency() * kCold <
                                frequencies_.getBlockFreq(loop.getHeader()).getFrequency();
            for (const llvm::Instruction& inst : *block) {
                if (isAccess(inst))
                    pays |= llvm::isa<llvm::StoreInst>(inst);
                else if (!isCold && mayAccess(inst))
                    return false;
            }
        }
        return pays;
    }

    bool isAccess(const llvm::Instruction& inst) const {
        return llvm::getLoadStorePointerOperand(&inst) == task_ &&
               llvm::getLoadStoreType(const_cast<llvm::Instruction*>(&inst))->isIntegerTy(64);
    }

    bool mayAccess(const llvm::Instruction& inst) const {
        if (!llvm::isa<llvm::CallBase>(inst)) return false; // other memory of the program lies elsewhere
        const llvm::MemoryLocation budget(task_, llvm::LocationSize::precise(sizeof(int64_t)));
        return llvm::isModOrRefSet(aliases_.getModRefInfo(&inst, budget));
    }

    void keepInRegister(llvm::Loop& loop) {
        llvm::simplifyLoop(&loop, &dominators_, &loops_, nullptr, &assumptions_, nullptr, false);
        if (!loop.getLoopPreheader() || !loop.hasDedicatedExits()) return;
        llvm::IRBuilder<> b(&*task_->getParent()->getEntryBlock().begin());
        llvm::AllocaInst* budget = b.CreateAlloca(b.getInt64Ty(), nullptr, "budget");
        const auto copy = [&](llvm::Value* to, llvm::Value* from) {
            b.CreateStore(b.CreateLoad(b.getInt64Ty(), from), to);
        };
        for (BasicBlock* block : loop.blocks()) {
            for (llvm::Instruction& inst : llvm::make_early_inc_range(*block)) {
                if (isAccess(inst)) {
                    inst.setOperand(llvm::isa<llvm::StoreInst>(inst) ? 1 : 0, budget);
                    inst.setMetadata(llvm::LLVMContext::MD_tbaa, nullptr);
                } else if (mayAccess(inst)) {
                    b.SetInsertPoint(&inst);
                    copy(task_, budget);
                    b.SetInsertPoint(inst.getNextNode());
                    copy(budget, task_);
                }
            }
        }
        b.SetInsertPoint(loop.getLoopPreheader()->getTerminator());
        copy(budget, task_);
        llvm::SmallVector<BasicBlock*> exits;
        loop.getUniqueExitBlocks(exits);
        for (BasicBlock* exit : exits) {
            b.SetInsertPoint(exit, exit->getFirstInsertionPt());
            copy(task_, budget);
        }
        llvm::PromoteMemToReg({budget}, dominators_, &assumptions_);
    }

    llvm::Argument* task_;
    llvm::DominatorTree& dominators_;
    llvm::LoopInfo& loops_;
    llvm::BlockFrequencyInfo& frequencies_;
    llvm::AAResults& aliases_;
    llvm::AssumptionCache& assumptions_;
};

} // namespace

llvm::PreservedAnalyses BudgetLoops::run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses) {
    if (!function.hasFnAttribute(kTakesTask) || !Budget(function, analyses).run())
        return llvm::PreservedAnalyses::all();
    return llvm::PreservedAnalyses::none();
}

} // namespace codegen
