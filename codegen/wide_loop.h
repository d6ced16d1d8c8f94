#pragma once
// Counted loops over arrays that check their results (`checkfinite`): LLVM does not vectorise a loop with an exit in its
// middle. A loop that computes many elements at once is emitted before such a loop; it checks all results together before it
// stores any. The original loop does the remaining rounds, and all rounds from the first result that is out of range.

#include <optional>
#include <unordered_map>

#include "codegen/routine_emitter.h"
#include "ir/passes/counted_loop.h"

namespace codegen {

class WideLoop {
  public:
    /// Nothing when the loop does anything else than combine elements at the counter with each other.
    static std::optional<WideLoop> plan(const ir::Module& module, const ir::Routine& routine,
                                        const ir::Cfg& cfg, const ir::Loop& loop);

    /// The block that enters the loop by a jump.
    ir::BlockId entry() const { return entry_; }
    ir::BlockId header() const { return header_; }

  private:
    friend class RoutineEmitter;

    enum class Kind : uint8_t { Uniform, Index, Vector, Address };
    /// What an instruction of the loop yields in the round with counter c.
    struct Lane {
        Kind kind = Kind::Uniform;
        std::optional<int64_t> offset; ///< Index, Address: c + offset, when that is known
        ir::ValueId object =
            ir::kNone; ///< Address, and addresses that are Uniform: the instruction that names the object
    };

    WideLoop(const ir::Module& module, const ir::Routine& routine, const ir::Loop& loop)
        : module_(module), routine_(routine), loop_(loop) {}
    bool read(const ir::Cfg& cfg);
    bool readBody();
    bool classify(ir::ValueId id);
    bool classifyLoad(ir::ValueId id);
    bool classifyStore(ir::ValueId id);
    bool isIndependent() const;
    bool sameObject(ir::ValueId a, ir::ValueId b) const;
    const Lane* lane(ir::ValueId id) const;
    Kind kindOf(ir::ValueId id) const;
    uint32_t loadedLocal(const ir::Inst& inst) const;
    bool isStored(uint32_t local) const;
    bool chooseWidth();
    std::optional<int64_t> knownRounds() const;
    std::optional<int64_t> initialValue(ir::ValueId value) const;

    const ir::Module& module_;
    const ir::Routine& routine_;
    const ir::Loop& loop_; ///< while the plan is made
    ir::BlockId entry_ = ir::kNone, header_ = ir::kNone;
    ir::CountedLoop counted_;
    std::vector<ir::ValueId> insts_; ///< of one round, without those that count
    std::unordered_map<ir::ValueId, Lane> lanes_;
    std::vector<ir::ValueId> scalars_;                 ///< objects that are read as a whole
    std::vector<ir::ValueId> loads_, stores_, checks_; ///< of elements
    unsigned part_ = 0;                                ///< rounds in one vector
    unsigned width_ = 0;                               ///< rounds at once: a multiple of part_
};

} // namespace codegen
