#include "runtime/sched/error_search.h"

#include "runtime/sched/interrupts.h"

namespace rt {

bool takesError(const RoutineDesc& routine, int errorNumber) {
    if (!routine.hasErrorHandler) return false;
    if (routine.errorFilter == nullptr || routine.errorFilterCount == 0) return true;
    for (uint32_t i = 0; i < routine.errorFilterCount; ++i) {
        if (routine.errorFilter[i] == errorNumber || routine.errorFilter[i] == kAllErrors) return true;
    }
    return false;
}

const StmtDesc* statementOf(const Frame& frame) {
    const RoutineDesc* routine = frame.routine;
    if (routine == nullptr || frame.statement < 0) return nullptr;
    if (static_cast<uint32_t>(frame.statement) >= routine->statementCount) return nullptr;
    return &routine->statements[frame.statement];
}

Frame* findErrorHandler(Frame* first, int errorNumber) {
    for (Frame* frame = first; frame != nullptr && frame->routine != &kTrapBoundary; frame = frame->caller) {
        if (frame->routine == nullptr) continue;
        // Errors in an UNDO handler end it; they do not reach routines that are being left.
        if (frame->routine->hasUndo && frame->reserved == kFrameInUndo) return nullptr;
        if (!frame->routine->hasErrorHandler) continue;
        const StmtDesc* statement = statementOf(*frame);
        // A statement that the handler does not cover is part of the handler itself: no recovery from there.
        if (statement == nullptr || !statement->handled) return nullptr;
        if (takesError(*frame->routine, errorNumber)) return frame;
    }
    return nullptr;
}

SourcePlace placeOf(const Frame* frame) {
    SourcePlace place;
    if (frame == nullptr || frame->routine == nullptr) return place;
    const auto text = [](const char* chars) { return std::string(chars != nullptr ? chars : ""); };
    place.module = text(frame->routine->module);
    place.routine = text(frame->routine->name);
    place.file = text(frame->routine->file);
    if (const StmtDesc* statement = statementOf(*frame)) {
        place.line = statement->line;
        place.column = statement->column;
    }
    return place;
}

} // namespace rt
