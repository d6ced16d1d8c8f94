#pragma once
// Recognises loops that count in an I32 local up or down to a bound.

#include <optional>

#include "ir/core/cfg.h"
#include "ir/core/ir.h"

namespace ir {

struct CountedLoop {
    uint32_t counter = kNone; ///< local
    ValueId bound =
        kNone; ///< instruction that yields the bound: constant, load of a local, or defined before
    Op comparison = Op::ILe;   ///< ILe, ILt (counting up), IGe, IGt (down): continue while true
    int32_t step = 0;          ///< > 0 up, < 0 down
    ValueId increment = kNone; ///< the IAdd
};

/// The counter is stored only by the single latch, the bound does not change inside, and neither's address escapes.
std::optional<CountedLoop> recogniseCountedLoop(const Routine& routine, const Loop& loop);

/// True when nothing in the loop calls, waits or is a safepoint already.
bool isFreeOfCalls(const Module& module, const Routine& routine, const Loop& loop);

} // namespace ir
