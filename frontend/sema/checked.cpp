#include "frontend/sema/checked.h"

namespace rapid::sema {

ExprInfo* ExprTable::makeChunk() {
    const std::span<ExprInfo> chunk = arena_.makeArray<ExprInfo>(kPerChunk);
    for (ExprInfo& info : chunk)
        info.type.type = none_.type.type;
    return chunk.data();
}

void FileFacts::dropInner() {
    exprs.clear();
    calls.clear();
    loopVariables.clear();
    references.clear();
    locals.clear();
    labels.clear();
    inner.clear();
    used = {}; // some are gone
    assigned = {};
}

bool CheckedProgram::uses(Trait trait) const {
    for (const Module* library : predefinedModules)
        for (const RoutineSymbol* routine : library->routines)
            if (routine->used && routine->traits.has(trait)) return true;
    return false;
}

} // namespace rapid::sema
