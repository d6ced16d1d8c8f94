#include "codegen/hot_code.h"

#include "ir/core/cfg.h"

namespace codegen {

bool isShort(const ir::Routine& routine) {
    constexpr size_t kMost = 150;
    return routine.insts.size() <= kMost;
}

bool hasLoop(const ir::Module& module, const ir::Routine& routine) {
    const ir::Cfg cfg = ir::buildCfg(module, routine, ir::HandlerEdges::No);
    const ir::LoopInfo loops = ir::findLoops(cfg);
    return !loops.loops.empty() || !loops.irreducible.empty();
}

} // namespace codegen
