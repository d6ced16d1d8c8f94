#pragma once
// The rules that hold inside one routine.

#include <string>
#include <vector>

#include "ir/core/cfg.h"
#include "ir/core/ir.h"

namespace ir {

class RoutineVerifier {
  public:
    RoutineVerifier(const Module& module, const Routine& routine, std::vector<std::string>& out)
        : module_(module), routine_(routine), out_(out) {}
    void run();

  private:
    void add(const std::string& text); ///< a finding at the current block and instruction
    bool header();
    void detachedHandler();
    void localEntry(const Local& local);
    void statements();
    bool structure();
    void instruction(const Inst& inst);
    bool operandCount(const Inst& inst);
    void indices(const Inst& inst);
    void types(const Inst& inst);
    void sameTypes(const Inst& inst, bool fits);
    void typesOfLeaf(const Inst& inst);
    void typesOfMemory(const Inst& inst);
    void typesOfComparison(const Inst& inst);
    void typesOfLogic(const Inst& inst);
    void typesOfAction(const Inst& inst);
    void typesOfEnd(const Inst& inst);
    void arguments(const Inst& inst, const std::vector<TypeId>& params, TypeId result);
    void ret(const Inst& inst);
    void raising(const Inst& inst);
    void dominance();
    void handlers();

    void want(const Inst& inst, size_t operand, TypeId type);
    void inRange(uint32_t index, size_t size, std::string_view what);
    TypeId operandType(const Inst& inst, size_t operand) const;
    /// Blocks that can be reached from `root` along `cfg_`.
    std::vector<bool> reachableFrom(BlockId root) const;

    const Module& module_;
    const Routine& routine_;
    std::vector<std::string>& out_;
    BlockId block_ = kNone;
    ValueId inst_ = kNone;
    bool retries_ = false, triesNext_ = false;
    std::vector<BlockId> blockOf_;  ///< per instruction
    std::vector<uint32_t> placeOf_; ///< position inside its block
    std::vector<bool> inUndo_;      ///< per block: only the undo handler reaches it
    std::vector<bool> reached_;     ///< per block: from the entry or a handler, without RETRY and TRYNEXT
    Cfg cfg_;
};

} // namespace ir
