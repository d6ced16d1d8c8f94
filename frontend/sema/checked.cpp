#include "frontend/sema/checked.h"

namespace rapid::sema {

ExprInfo* ExprTable::makeChunk() {
    auto* chunk = static_cast<ExprInfo*>(arena_.allocate(sizeof(ExprInfo) * kPerChunk, alignof(ExprInfo)));
    std::uninitialized_fill_n(chunk, kPerChunk, none_);
    return chunk;
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
