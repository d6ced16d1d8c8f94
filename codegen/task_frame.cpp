#include "codegen/task_frame.h"

#include "codegen/hot_code.h"

namespace codegen {
namespace {

bool callsNatives(const ir::Module& module, const ir::Routine& routine, const NativeBodies& inlined) {
    if (routine.stepping || routine.errorHandler != ir::kNone || routine.undoHandler != ir::kNone ||
        routine.isDetachedHandler)
        return true;
    for (const ir::Inst& inst : routine.insts) {
        if (inst.op != ir::Op::CallNative) continue;
        const ir::Native& native = module.natives[inst.index];
        if (native.nativeClass == ir::NativeClass::Const) continue;
        if (!isShort(routine) || !inlined.contains(native.symbol)) return true;
    }
    return false;
}

} // namespace

std::vector<bool> routinesSettingTaskFrame(const ir::Module& module, const NativeBodies& inlined) {
    std::vector<std::vector<uint32_t>> callers(module.routines.size());
    std::vector<bool> result(module.routines.size(), false);
    std::vector<uint32_t> work;
    for (uint32_t i = 0; i < module.routines.size(); ++i) {
        for (const ir::Inst& inst : module.routines[i].insts)
            if (inst.op == ir::Op::Call) callers[inst.index].push_back(i);
        if (!callsNatives(module, module.routines[i], inlined)) continue;
        result[i] = true;
        work.push_back(i);
    }
    while (!work.empty()) {
        const uint32_t callee = work.back();
        work.pop_back();
        for (const uint32_t caller : callers[callee]) {
            if (result[caller]) continue;
            result[caller] = true;
            work.push_back(caller);
        }
    }
    return result;
}

} // namespace codegen
