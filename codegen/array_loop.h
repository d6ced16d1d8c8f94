#pragma once
// Finds out which loops over arrays can have a second form without checks (unchecked_rounds), and what it needs.

#include <llvm/Analysis/AliasAnalysis.h>
#include <llvm/Analysis/AssumptionCache.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/ScalarEvolution.h>
#include <llvm/Analysis/ScalarEvolutionExpressions.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/Instructions.h>

#include <vector>

namespace codegen {

/// Rounds between two looks at what the checks have found.
inline constexpr uint64_t kRoundsAtOnce = 64;
/// Fewer are not worth the preparations.
inline constexpr uint64_t kFewestRounds = 16;
/// The largest element of an array that is stored to.
inline constexpr uint64_t kLargestElement = 8;

struct LoopAnalyses {
    llvm::ScalarEvolution& scev;
    llvm::DominatorTree& dominators;
    llvm::LoopInfo& loops;
    llvm::AAResults& aliases;
    llvm::AssumptionCache& assumptions;
};

/// A loop that can have the second form, and what is known of it.
class ArrayLoop {
  public:
    ArrayLoop(llvm::Loop& loop, LoopAnalyses& analyses) : loop_(loop), a_(analyses) {}

    struct Access {
        llvm::Instruction* inst;
        const llvm::SCEVAddRecExpr* address; ///< null: the same in all rounds
        const llvm::SCEV* step;
    };

    bool suits();

    llvm::Loop& loop() const { return loop_; }
    const llvm::SCEV* rounds() const { return rounds_; }
    /// As many of them pass all checks of indices.
    const llvm::SCEV* unchecked() const { return unchecked_; }
    const std::vector<Access>& stores() const { return stores_; }
    /// Loads that not all rounds execute, but could.
    const std::vector<Access>& early() const { return early_; }
    /// The conditions under which a branch lets the loop continue, perhaps among others.
    struct Check {
        llvm::BranchInst* at;
        llvm::Value* condition;
        bool wanted;
    };
    const std::vector<Check>& checks() const { return checks_; }           ///< of numbers
    const std::vector<Check>& conditions() const { return conditions_; }   ///< the same in all rounds
    const std::vector<llvm::BranchInst*>& exits() const { return exits_; } ///< all but the last
    /// The distances from stores to loads, in bytes, for which the loads see what was there before the rounds.
    struct Distance {
        const llvm::SCEV* least;
        const llvm::SCEV* most;
        uint64_t span; ///< of one store in all rounds that are done at once
        bool mayBeEqual;
    };
    const std::vector<Distance>& distances() const { return distances_; }

  private:
    bool isCounted();
    bool readExits();
    bool readCondition(llvm::BranchInst& branch, llvm::Value* condition, bool wanted);
    bool boundRounds(const llvm::ICmpInst* compared, bool wanted);
    bool readPhis();
    bool readBody();
    bool readAccess(llvm::Instruction& inst);
    bool isInObject(const llvm::SCEV* address, uint64_t size) const;
    bool isIndependent();
    bool sees(const Access& load, const Access& store);
    void note(const llvm::SCEV* distance, uint64_t size, bool mayBeEqual);
    bool isBefore(const llvm::Instruction* load, const llvm::Instruction* store) const;

    llvm::Loop& loop_;
    LoopAnalyses& a_;
    const llvm::SCEV *rounds_ = nullptr, *unchecked_ = nullptr;
    std::vector<llvm::BranchInst*> exits_;
    std::vector<Check> checks_, conditions_;
    std::vector<Access> stores_, loads_, early_;
    std::vector<Distance> distances_;
};

} // namespace codegen
