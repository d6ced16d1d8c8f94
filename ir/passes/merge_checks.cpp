// Several `checkfinite` of a block that have nothing between them but arithmetic, loads and stores are replaced by one look at
// all of their values. When it finds something, the stores in between are undone and everything is done again in order,
// each check in its place: what is seen of an error does not change.

#include <algorithm>

#include "ir/core/cfg.h"
#include "ir/core/op_info.h"
#include "ir/passes/passes.h"

namespace ir {
namespace {

class CheckMerger {
  public:
    CheckMerger(const Module& module, Routine& routine) : module_(module), routine_(routine) {}

    void run() {
        private_ = privateLocals(routine_);
        // Blocks made on the way hold the rest of those before them; what is done again is left as it is.
        for (BlockId b = 0; b < routine_.blocks.size(); ++b) {
            if (std::find(again_.begin(), again_.end(), b) != again_.end()) continue;
            if (const Region region = findRegion(routine_.blocks[b].insts); region.checks.size() > 1)
                merge(b, region);
        }
    }

  private:
    /// Places in the list of a block: from the first check to the barrier after the last one.
    struct Region {
        size_t begin = 0, end = 0;
        std::vector<ValueId> checks;
    };

    const Inst& inst(ValueId id) const { return routine_.insts[id]; }

    ValueId add(Op op, TypeId type, std::vector<ValueId> operands, StmtId stmt) {
        Inst made;
        made.op = op;
        made.type = type;
        made.operands = std::move(operands);
        made.stmt = stmt;
        routine_.insts.push_back(std::move(made));
        return static_cast<ValueId>(routine_.insts.size() - 1);
    }

    bool isBarrier(const Inst& i) const {
        if (i.op == Op::CheckFinite || i.op == Op::Load || i.op == Op::Store || i.op == Op::Stmt)
            return false;
        if (i.op == Op::Select) return true; // what it compares may not be a number yet
        return opInfo(i.op).terminator || opInfo(i.op).touchesMemory || mayRaise(module_, i);
    }

    Region findRegion(const std::vector<ValueId>& insts) const {
        Region region;
        for (size_t i = 0; i < insts.size(); ++i) {
            if (inst(insts[i]).op == Op::CheckFinite) {
                if (region.checks.empty()) region.begin = i;
                region.checks.push_back(insts[i]);
                region.end = i + 1;
            } else if (isBarrier(inst(insts[i]))) {
                if (region.checks.size() > 1) return region;
                region = {};
            }
        }
        return region;
    }

    /// Values whose infinity shows in a value that is checked later in the region.
    std::vector<bool> findCovered(const std::vector<ValueId>& insts, const Region& region) const {
        std::vector<ValueId> stored(routine_.locals.size(), kNone); // value of a private local at this point
        std::vector<ValueId> source(routine_.insts.size(), kNone);  // of a load: what was stored there
        for (size_t i = 0; i < region.end; ++i) {
            const Inst& at = inst(insts[i]);
            if (at.op != Op::Load && at.op != Op::Store && at.op != Op::Zero) continue;
            const Inst& address = inst(at.operands[at.op == Op::Store ? 1 : 0]);
            if (address.op != Op::LocalAddr || !private_[address.index]) continue;
            if (at.op == Op::Load)
                source[insts[i]] = stored[address.index];
            else
                stored[address.index] = at.op == Op::Zero ? kNone : at.operands[0];
        }
        std::vector<bool> covered(routine_.insts.size(), false);
        for (const ValueId check : region.checks) {
            const OperandList first = passedOn(inst(check).operands[0], source);
            std::vector<ValueId> work(first.begin(), first.end());
            while (!work.empty()) {
                const ValueId value = work.back();
                work.pop_back();
                if (covered[value]) continue;
                covered[value] = true;
                for (const ValueId next : passedOn(value, source))
                    work.push_back(next);
            }
        }
        return covered;
    }

    /// The operands whose infinity the value takes over.
    OperandList passedOn(ValueId id, const std::vector<ValueId>& source) const {
        const Inst& value = inst(id);
        switch (familyOf(value.op)) {
        case Family::Float:
            if (dropsDecimals(value.op)) return {};
            return value.op == Op::FDiv ? OperandList{value.operands[0]} : value.operands;
        case Family::Convert:
            if (value.op == Op::FWiden || value.op == Op::FNarrow) return value.operands;
            return {};
        case Family::Memory:
            if (value.op != Op::Load || source[id] == kNone) return {};
            return {source[id]};
        case Family::Leaf:
        case Family::Int:
        case Family::Compare:
        case Family::Logic:
        case Family::Action:
        case Family::End: return {};
        }
        return {};
    }

    /// Of 2^level values.
    struct PartialSum {
        ValueId value;
        unsigned level;
    };

    /// Values are added where they are known, so that few have to be kept, and in pairs, so that no addition waits for all
    /// those before it.
    void include(std::vector<PartialSum>& sums, PartialSum sum, StmtId stmt, std::vector<ValueId>& out) {
        sums.push_back(sum);
        while (sums.size() > 1 && sums.back().level == sums[sums.size() - 2].level)
            joinLast(sums, stmt, out);
    }

    void joinLast(std::vector<PartialSum>& sums, StmtId stmt, std::vector<ValueId>& out) {
        const PartialSum last = sums.back();
        sums.pop_back();
        PartialSum& before = sums.back();
        out.push_back(add(Op::FAdd, valueType(inst(last.value)), {before.value, last.value}, stmt));
        routine_.insts[out.back()].extra = 1; // for the check only
        before = {out.back(), std::max(before.level, last.level) + 1};
    }

    /// Appends what says whether all values are finite. One comparison serves both widths.
    ValueId areFinite(std::vector<PartialSum> (&sums)[2], StmtId stmt, std::vector<ValueId>& out) {
        for (std::vector<PartialSum>& sum : sums)
            while (sum.size() > 1)
                joinLast(sum, stmt, out);
        if (!sums[0].empty() && !sums[1].empty()) {
            out.push_back(add(Op::FWiden, kF64, {sums[0][0].value}, stmt));
            sums[1].push_back({out.back(), 0});
            joinLast(sums[1], stmt, out);
        }
        const std::vector<PartialSum>& sum = sums[1].empty() ? sums[0] : sums[1];
        out.push_back(add(Op::IsFinite, kBool, {sum[0].value}, stmt));
        return out.back();
    }

    void merge(BlockId b, const Region& region) {
        const std::vector<ValueId> insts = std::move(routine_.blocks[b].insts);
        const std::vector<bool> covered = findCovered(insts, region);
        const StmtId stmt = inst(insts[region.end - 1]).stmt;
        std::vector<ValueId> fast(insts.begin(), insts.begin() + static_cast<std::ptrdiff_t>(region.begin));
        std::vector<ValueId> undo, again;
        std::vector<PartialSum> sums[2];
        for (size_t i = region.begin; i < region.end; ++i) {
            const ValueId id = insts[i];
            const Inst now = inst(id);
            if (now.op == Op::CheckFinite) {
                again.push_back(id);
                if (!covered[now.operands[0]])
                    include(sums[valueType(inst(now.operands[0])) == kF64], {now.operands[0], 0}, stmt, fast);
                continue;
            }
            if (now.op == Op::Store) {
                const ValueId old = add(Op::Load, now.type, {now.operands[1]}, now.stmt);
                fast.push_back(old);
                undo.push_back(add(Op::Store, now.type, {old, now.operands[1]}, now.stmt));
                again.push_back(add(Op::Store, now.type, {now.operands[0], now.operands[1]}, now.stmt));
            }
            fast.push_back(id);
        }
        const ValueId fine = areFinite(sums, stmt, fast);
        const auto rest = static_cast<BlockId>(routine_.blocks.size());
        const ValueId branch = add(Op::CondBr, kVoid, {fine}, stmt);
        routine_.insts[branch].target(0) = rest;
        routine_.insts[branch].target(1) = rest + 1;
        routine_.insts[branch].extra = 1; // the first is likely
        fast.push_back(branch);
        std::reverse(undo.begin(), undo.end());
        undo.insert(undo.end(), again.begin(), again.end());
        undo.push_back(add(Op::Br, kVoid, {}, stmt));
        routine_.insts[undo.back()].target(0) = rest;
        routine_.blocks[b].insts = std::move(fast);
        routine_.blocks.push_back({routine_.blockName("finite"),
                                   {insts.begin() + static_cast<std::ptrdiff_t>(region.end), insts.end()}});
        again_.push_back(rest + 1);
        routine_.blocks.push_back({routine_.blockName("again"), std::move(undo)});
    }

    const Module& module_;
    Routine& routine_;
    std::vector<bool> private_; ///< by local
    std::vector<BlockId> again_;
};

} // namespace

void mergeChecks(const Module& module, Routine& routine) {
    // Watchers of data are asked after each store of it.
    const bool watched = std::any_of(module.natives.begin(), module.natives.end(),
                                     [](const Native& native) { return native.watches; });
    if (!watched && !routine.stepping) CheckMerger(module, routine).run();
}

} // namespace ir
