#include "codegen/short_loops.h"

#include <llvm/Analysis/BlockFrequencyInfo.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/ScalarEvolution.h>
#include <llvm/IR/Instructions.h>
#include <llvm/Transforms/Utils/LoopUtils.h>

namespace codegen {
namespace {

constexpr unsigned kMostRounds = 16;
/// Instructions of all rounds, as LLVM's limit for loops that are worth it (UnrollThreshold and its boost).
constexpr unsigned kMostInstructions = 400;

/// Instructions of a round that is not left or interrupted.
unsigned usualLength(const llvm::Loop& loop, const llvm::BlockFrequencyInfo& frequencies) {
    const auto rounds = static_cast<double>(frequencies.getBlockFreq(loop.getHeader()).getFrequency());
    unsigned length = 0;
    for (const llvm::BasicBlock* block : loop.blocks()) {
        constexpr double kSeldom = 0.01;
        if (static_cast<double>(frequencies.getBlockFreq(block).getFrequency()) < rounds * kSeldom) continue;
        for (const llvm::Instruction& inst : *block)
            length += llvm::isa<llvm::PHINode>(inst) ? 0 : 1;
    }
    return length;
}

bool isShortLoop(llvm::Loop& loop, llvm::ScalarEvolution& scev, const llvm::BlockFrequencyInfo& frequencies) {
    if (loop.isInnermost() || !loop.getLoopLatch() || loop.getSubLoops().size() > 1) return false;
    if (!loop.getSubLoops()[0]->isInnermost()) return false;
    const unsigned rounds = scev.getSmallConstantTripCount(&loop, loop.getLoopLatch());
    return rounds > 1 && rounds <= kMostRounds &&
           rounds * usualLength(loop, frequencies) <= kMostInstructions;
}

} // namespace

llvm::PreservedAnalyses ShortLoops::run(llvm::Function& function, llvm::FunctionAnalysisManager& analyses) {
    auto& loops = analyses.getResult<llvm::LoopAnalysis>(function);
    if (loops.empty()) return llvm::PreservedAnalyses::all();
    auto& scev = analyses.getResult<llvm::ScalarEvolutionAnalysis>(function);
    auto& frequencies = analyses.getResult<llvm::BlockFrequencyAnalysis>(function);
    for (llvm::Loop* loop : loops.getLoopsInPreorder())
        if (isShortLoop(*loop, scev, frequencies))
            llvm::addStringMetadataToLoop(loop, "llvm.loop.unroll.full");
    return llvm::PreservedAnalyses::all();
}

} // namespace codegen
