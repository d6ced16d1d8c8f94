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
    /// The outermost loops where it is worthwhile.
    void choose(llvm::Loop& loop, std::vector<llvm::Loop*>& chosen) const {
        if (isWorthwhile(loop))
            chosen.push_back(&loop);
        else
            for (llvm::Loop* inner : loop)
                choose(*inner, chosen);
    }

    /// A call that may look at the budget costs a store and a load; each payment that stays in the register saves both, and the
    /// time that the load waits for the store before.
    bool isWorthwhile(const llvm::Loop& loop) const {
        double payments = 0, calls = 0;
        for (const BasicBlock* block : loop.blocks()) {
            const auto often = static_cast<double>(frequencies_.getBlockFreq(block).getFrequency());
            for (const llvm::Instruction& inst : *block) {
                if (isAccess(inst))
                    payments += llvm::isa<llvm::StoreInst>(inst) ? often : 0;
                else if (mayAccess(inst))
                    calls += often;
            }
        }
        return payments > 0 && payments >= 2 * calls;
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
    // A routine that does not use its task may have lost the argument.
    const bool takesTask = function.hasFnAttribute(kTakesTask) && !function.arg_empty();
    if (!takesTask || !Budget(function, analyses).run()) return llvm::PreservedAnalyses::all();
    return llvm::PreservedAnalyses::none();
}

} // namespace codegen
