#include "ir/passes/counted_loop.h"

#include <algorithm>

namespace ir {
namespace {

class Recogniser {
  public:
    Recogniser(const Routine& routine, const Loop& loop) : routine_(routine), loop_(loop) {}

    std::optional<CountedLoop> run() {
        if (loop_.latches.size() != 1 || !readHeader() || !readLatch()) return std::nullopt;
        if (!isPrivate(result_.counter) || storesInLoop(result_.counter) != 1) return std::nullopt;
        bool up = result_.comparison == Op::ILe || result_.comparison == Op::ILt;
        if (up ? result_.step <= 0 : result_.step >= 0) return std::nullopt;
        if (!boundIsInvariant()) return std::nullopt;
        return result_;
    }

  private:
    const Inst& inst(ValueId id) const { return routine_.insts[id]; }

    /// The local that `id` loads an I32 from; kNone when it does something else.
    uint32_t loadedLocal(ValueId id) const {
        const Inst& load = inst(id);
        if (load.op != Op::Load || load.type != kI32 || inst(load.operands[0]).op != Op::LocalAddr)
            return kNone;
        return inst(load.operands[0]).index;
    }

    bool readHeader() {
        const std::vector<ValueId>& insts = routine_.blocks[loop_.header].insts;
        const Inst& last = inst(insts.back());
        if (last.op != Op::CondBr || !loop_.contains[last.target(0)] || loop_.contains[last.target(1)])
            return false;
        const Inst& test = inst(last.operands[0]);
        bool orders = test.op == Op::ILe || test.op == Op::ILt || test.op == Op::IGe || test.op == Op::IGt;
        if (!orders || std::find(insts.begin(), insts.end(), last.operands[0]) == insts.end()) return false;
        result_.comparison = test.op;
        result_.counter = loadedLocal(test.operands[0]);
        result_.bound = test.operands[1];
        return result_.counter != kNone;
    }

    bool readLatch() {
        for (ValueId id : routine_.blocks[loop_.latches[0]].insts) {
            const Inst& store = inst(id);
            if (store.op != Op::Store || inst(store.operands[1]).op != Op::LocalAddr ||
                inst(store.operands[1]).index != result_.counter)
                continue;
            const Inst& sum = inst(store.operands[0]);
            if (sum.op != Op::IAdd || loadedLocal(sum.operands[0]) != result_.counter) return false;
            if (inst(sum.operands[1]).op != Op::Const) return false;
            result_.increment = store.operands[0];
            result_.step = static_cast<int32_t>(inst(sum.operands[1]).integer());
            return true;
        }
        return false;
    }

    /// Every address of the local is used to load from or store to it directly.
    bool isPrivate(uint32_t local) const {
        for (const Block& block : routine_.blocks) {
            for (ValueId id : block.insts) {
                const Inst& user = inst(id);
                for (size_t i = 0; i < user.operands.size(); ++i) {
                    const Inst& address = inst(user.operands[i]);
                    if (address.op != Op::LocalAddr || address.index != local) continue;
                    bool direct = (user.op == Op::Load && i == 0) || (user.op == Op::Store && i == 1);
                    if (!direct) return false;
                }
            }
        }
        return true;
    }

    int storesInLoop(uint32_t local) const {
        int count = 0;
        for (BlockId b : loop_.blocks)
            for (ValueId id : routine_.blocks[b].insts)
                if (inst(id).op == Op::Store && inst(inst(id).operands[1]).op == Op::LocalAddr &&
                    inst(inst(id).operands[1]).index == local)
                    ++count;
        return count;
    }

    bool boundIsInvariant() const {
        if (inst(result_.bound).op == Op::Const) return true;
        uint32_t local = loadedLocal(result_.bound);
        if (local != kNone) return local != result_.counter && isPrivate(local) && storesInLoop(local) == 0;
        for (BlockId b : loop_.blocks) {
            const std::vector<ValueId>& insts = routine_.blocks[b].insts;
            if (std::find(insts.begin(), insts.end(), result_.bound) != insts.end()) return false;
        }
        return true;
    }

    const Routine& routine_;
    const Loop& loop_;
    CountedLoop result_;
};

} // namespace

std::optional<CountedLoop> recogniseCountedLoop(const Routine& routine, const Loop& loop) {
    return Recogniser(routine, loop).run();
}

bool isFreeOfCalls(const Module& module, const Routine& routine, const Loop& loop) {
    for (BlockId b : loop.blocks) {
        for (ValueId id : routine.blocks[b].insts) {
            const Inst& inst = routine.insts[id];
            bool plain =
                inst.op == Op::CallNative && module.natives[inst.index].nativeClass == NativeClass::Plain;
            if (plain || inst.op == Op::Call || inst.op == Op::Safepoint) return false;
        }
    }
    return true;
}

} // namespace ir
