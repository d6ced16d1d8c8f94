#include "codegen/paced_routines.h"

#include <algorithm>
#include <optional>

#include "ir/core/ir.h"
#include "ir/passes/counted_loop.h"

namespace codegen {
namespace {

/// IR instructions of a routine from which on its passes cost enough to save them, and for each of which there is at least one
/// instruction of the robot (a native without result): even unoptimised, that many take less time than it does.
constexpr size_t kShort = 100, kForEachNative = 128;
/// Rounds of a loop that take no longer than straight code would.
constexpr int64_t kFewRounds = 16;

class Pace {
  public:
    Pace(const ir::Module& module, const ir::Routine& routine, const NativeBodies& inlined)
        : module_(module), routine_(routine), inlined_(inlined) {}

    /// By its length and its natives alone.
    bool mayBePaced() const {
        if (routine_.insts.size() < kShort) return false;
        const auto robotInstructions = static_cast<size_t>(
            std::count_if(routine_.insts.begin(), routine_.insts.end(), [&](const ir::Inst& inst) {
                return isCalledNative(inst) && module_.natives[inst.index].result == ir::kVoid;
            }));
        return robotInstructions * kForEachNative >= routine_.insts.size();
    }

    bool isSlow(const ir::Cfg& cfg, const ir::LoopInfo& loops, size_t index) const {
        const ir::Loop& loop = loops.loops[index];
        for (const ir::BlockId b : loop.blocks)
            if (isInEachRound(cfg, loop, b) && callsNative(routine_.blocks[b])) return true;
        const std::optional<int64_t> count = rounds(cfg, loop);
        return loop.parent == ir::kNone && count && *count <= kFewRounds;
    }

  private:
    static bool isInEachRound(const ir::Cfg& cfg, const ir::Loop& loop, ir::BlockId block) {
        return std::all_of(loop.latches.begin(), loop.latches.end(),
                           [&](ir::BlockId latch) { return cfg.dominates(block, latch); });
    }

    bool callsNative(const ir::Block& block) const {
        return std::any_of(block.insts.begin(), block.insts.end(),
                           [this](ir::ValueId id) { return isCalledNative(routine_.insts[id]); });
    }

    bool isCalledNative(const ir::Inst& inst) const {
        if (inst.op != ir::Op::CallNative) return false;
        const ir::Native& native = module_.natives[inst.index];
        return native.nativeClass == ir::NativeClass::Plain && !inlined_.contains(native.symbol);
    }

    /// Rounds of a loop that counts between two constants.
    std::optional<int64_t> rounds(const ir::Cfg& cfg, const ir::Loop& loop) const {
        const auto counted = ir::recogniseCountedLoop(routine_, loop);
        if (!counted) return std::nullopt;
        const ir::BlockId entry = ir::entryByJump(routine_, cfg, loop);
        if (entry == ir::kNone) return std::nullopt;
        const auto first = storedIn(entry, counted->counter);
        const ir::Inst& bound = routine_.insts[counted->bound];
        const auto last =
            bound.op == ir::Op::Load ? storedIn(entry, localOf(bound.operands[0])) : constant(counted->bound);
        if (!first || !last) return std::nullopt;
        return std::max<int64_t>(0, (*last - *first) / counted->step + 1);
    }

    std::optional<int64_t> constant(ir::ValueId id) const {
        const ir::Inst& inst = routine_.insts[id];
        if (inst.op != ir::Op::Const) return std::nullopt;
        return inst.integer();
    }

    uint32_t localOf(ir::ValueId address) const {
        const ir::Inst& inst = routine_.insts[address];
        return inst.op == ir::Op::LocalAddr ? inst.index : ir::kNone;
    }

    /// The constant that the block leaves in the local.
    std::optional<int64_t> storedIn(ir::BlockId block, uint32_t local) const {
        std::optional<int64_t> result;
        for (const ir::ValueId id : routine_.blocks[block].insts)
            if (const ir::Inst& inst = routine_.insts[id];
                inst.op == ir::Op::Store && local != ir::kNone && localOf(inst.operands[1]) == local)
                result = constant(inst.operands[0]);
        return result;
    }

    const ir::Module& module_;
    const ir::Routine& routine_;
    const NativeBodies& inlined_;
};

} // namespace

bool isPacedByNatives(const ir::Module& module, const ir::Routine& routine, const ir::Cfg& cfg,
                      const ir::LoopInfo& loops, const NativeBodies& inlined) {
    const Pace pace(module, routine, inlined);
    if (!loops.irreducible.empty() || !pace.mayBePaced()) return false;
    for (size_t i = 0; i < loops.loops.size(); ++i)
        if (!pace.isSlow(cfg, loops, i)) return false;
    return true;
}

bool isPacedByNatives(const ir::Module& module, const ir::Routine& routine, const NativeBodies& inlined) {
    if (!Pace(module, routine, inlined).mayBePaced()) return false;
    const ir::Cfg cfg = ir::buildCfg(module, routine, ir::HandlerEdges::No);
    return isPacedByNatives(module, routine, cfg, ir::findLoops(cfg), inlined);
}

} // namespace codegen
