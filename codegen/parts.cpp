#include "codegen/parts.h"

#include "codegen/hot_code.h"
#include "codegen/paced_routines.h"
#include "codegen/task_frame.h"

namespace codegen {
namespace {

/// IR instructions of a part, and of a routine that gets one of its own.
constexpr size_t kLargestPart = 8000, kLargeRoutine = 4000;
/// Of all copies in a part.
constexpr size_t kMostCopied = 1500;

} // namespace

std::vector<uint32_t> copiesFor(const ir::Module& module, const std::vector<uint32_t>& routines,
                                size_t largest) {
    std::vector<bool> known(module.routines.size(), false);
    for (const uint32_t routine : routines)
        known[routine] = true;
    std::vector<uint32_t> callers = routines, copies;
    size_t size = 0;
    for (size_t next = 0; next < callers.size(); ++next) {
        const ir::Routine& caller = module.routines[callers[next]];
        const size_t limit = isShort(caller) || hasLoop(module, caller) ? largest : kInlinedAnywhere;
        for (const ir::Inst& inst : caller.insts) {
            if (inst.op != ir::Op::Call || known[inst.index]) continue;
            const size_t more = module.routines[inst.index].insts.size();
            if (more > limit || size + more > kMostCopied) continue;
            known[inst.index] = true;
            size += more;
            copies.push_back(inst.index);
            callers.push_back(inst.index);
        }
    }
    return copies;
}

std::vector<Part> divide(const ir::Module& module, const CodegenOptions& options) {
    std::vector<Part> parts(1);
    parts[0].tables = true;
    /// The part that the next routine of one kind goes into.
    struct Open {
        size_t part = 0, size = 0;
    };
    std::string_view current;
    Open open[2]; // the second one for routines that are paced by natives
    for (uint32_t i = 0; i < module.routines.size(); ++i) {
        const ir::Routine& routine = module.routines[i];
        const size_t more = routine.insts.size();
        if (routine.moduleName != current) open[0] = open[1] = {};
        current = routine.moduleName;
        const bool isPaced = options.optimise && isPacedByNatives(module, routine, options.bodies);
        Open& into = open[isPaced ? 1 : 0];
        if (into.part == 0 || into.size + more > kLargestPart || more > kLargeRoutine) {
            into = {parts.size(), 0};
            parts.emplace_back().isPaced = isPaced;
        }
        parts[into.part].routines.push_back(i);
        into.size += more > kLargeRoutine ? kLargestPart : more;
    }
    const auto setting = std::make_shared<const std::vector<bool>>(routinesSettingTaskFrame(module, {}));
    for (Part& part : parts) {
        part.copies = copiesFor(module, part.routines, kLargestCopy);
        part.settingTaskFrame = setting;
    }
    return parts;
}

} // namespace codegen
