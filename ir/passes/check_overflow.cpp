// A floating-point result beyond the range of its type is an error of the program. Infinities and NaN propagate
// through sums and products, so that a check where the value leaves an expression (is stored, passed, returned, compared,
// divided by or converted to an integer) finds what went wrong anywhere in it. Values in memory are finite. A bound of
// each magnitude shows where no check is needed: a counter that grows by 1 cannot overflow, it stops growing before.

#include <algorithm>

#include "ir/core/op_info.h"
#include "ir/passes/passes.h"
#include "ir/passes/value_bounds.h"

namespace ir {

void checkOverflow(const Module& module, Routine& routine) {
    if (module.overflowError == 0) return;
    const ValueBounds bounds(module, routine);
    const auto needsCheck = [&](ValueId id) {
        return isFloat(valueType(routine.insts[id])) && bounds.needsCheck(id);
    };
    for (Block& block : routine.blocks) {
        // Most blocks remain as they are; routines may have millions of them.
        if (std::none_of(block.insts.begin(), block.insts.end(), needsCheck)) continue;
        std::vector<ValueId> insts;
        for (const ValueId id : block.insts) {
            insts.push_back(id);
            if (!needsCheck(id)) continue;
            const Inst& value = routine.insts[id];
            Inst check;
            check.op = Op::CheckFinite;
            check.operands = {id};
            check.extra = module.overflowError;
            check.stmt = value.stmt;
            insts.push_back(static_cast<ValueId>(routine.insts.size()));
            routine.insts.push_back(std::move(check));
        }
        block.insts = std::move(insts);
    }
}

} // namespace ir
