#include "ir/core/execution_bound.h"

#include <limits>

#include "ir/core/cfg.h"

namespace ir {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

class Bound {
  public:
    explicit Bound(const Module& module) : module_(module), of_(module.routines.size(), kUnknown) {}

    double ofRoutine(uint32_t index) {
        double& known = of_[index];
        if (known != kUnknown) return known; // infinity when it is in progress: recursion
        known = kUnbounded;
        const Routine& routine = module_.routines[index];
        const LoopInfo loops = findLoops(buildCfg(module_, routine, HandlerEdges::Yes));
        if (!loops.loops.empty() || !loops.irreducible.empty()) return kUnbounded;
        double sum = 0;
        for (const Block& block : routine.blocks)
            for (const ValueId id : block.insts)
                sum += 1 + (routine.insts[id].op == Op::Call ? ofRoutine(routine.insts[id].index) : 0);
        return of_[index] = sum;
    }

  private:
    static constexpr double kUnknown = -1;

    const Module& module_;
    std::vector<double> of_;
};

} // namespace

double mostExecuted(const Module& module) {
    if (module.tasks.size() != 1) return kUnbounded;
    const TaskEntry& task = module.tasks[0];
    Bound bound(module);
    double sum = 0;
    for (uint32_t i = 0; i < module.routines.size(); ++i) {
        if (!module.routines[i].exported) continue;
        if (i != task.entry && i != task.reset) return kUnbounded;
        sum += bound.ofRoutine(i);
    }
    return sum;
}

} // namespace ir
