#include "runtime/sched/error_search.h"

#include "runtime/sched/event_routines.h"
#include "runtime/sched/interrupts.h"

#include <algorithm>

namespace rt {
namespace {

bool inFilter(const RoutineDesc& routine, int number) {
    const int32_t* const end = routine.errorFilter + routine.errorFilterCount;
    return std::find(routine.errorFilter, end, number) != end;
}

/// A statement that the handler does not cover is part of a handler: no recovery from there.
bool coversStatement(const Frame& frame) {
    const StmtDesc* statement = statementOf(frame);
    return statement != nullptr && statement->handled != 0;
}

bool inUndoHandler(const Frame& frame) {
    return frame.routine->hasUndo && frame.reserved == kFrameInUndo;
}

} // namespace

bool listsError(const RoutineDesc& routine, int errorNumber) {
    if (!routine.hasErrorHandler) return false;
    const float* const* const end = routine.errorVariables + routine.errorVariableCount;
    return inFilter(routine, errorNumber) || inFilter(routine, kAllErrors) ||
           std::any_of(routine.errorVariables, end,
                       [errorNumber](const float* variable) { return *variable == errorNumber; });
}

bool takesError(const RoutineDesc& routine, int errorNumber) {
    if (!routine.hasErrorHandler) return false;
    const bool withoutList = routine.errorFilterCount == 0 && routine.errorVariableCount == 0;
    return withoutList || inFilter(routine, kOtherErrors) || listsError(routine, errorNumber);
}

const StmtDesc* statementOf(const Frame& frame) {
    const RoutineDesc* routine = frame.routine;
    if (routine == nullptr || frame.statement < 0) return nullptr;
    if (static_cast<uint32_t>(frame.statement) >= routine->statementCount) return nullptr;
    return &routine->statements[frame.statement];
}

bool inErrorHandler(const Frame& frame) {
    const StmtDesc* statement = statementOf(frame);
    return statement != nullptr && statement->kind == kStmtHandler && !inUndoHandler(frame);
}

ErrorRoute routeOfError(Frame* at, int errorNumber) {
    if (at == nullptr || at->routine == &kEventBoundary) return {};
    if (at->routine == nullptr || at->routine == &kTrapBoundary)
        return routeFromCall(at->caller, errorNumber);
    if (inUndoHandler(*at)) return {};
    if (at->routine->hasErrorHandler) {
        if (!coversStatement(*at)) return {};
        if (takesError(*at->routine, errorNumber)) return {at, false};
    }
    return routeFromCall(at->caller, errorNumber);
}

ErrorRoute routeFromCall(Frame* at, int errorNumber) {
    Frame* nearest = nullptr;
    bool trap = false; // past a trap routine only lists are asked
    for (Frame* frame = at; frame != nullptr; frame = frame->caller) {
        if (frame->routine == &kEventBoundary) break;
        trap = trap || frame->routine == &kTrapBoundary;
        if (frame->routine == nullptr || frame->routine == &kTrapBoundary) continue;
        // Errors in an UNDO handler end it; they do not reach routines that are being left.
        if (inUndoHandler(*frame)) break;
        if (!frame->routine->hasErrorHandler) continue;
        if (!coversStatement(*frame)) break;
        if (listsError(*frame->routine, errorNumber)) return {frame, true};
        if (nearest == nullptr && !trap && takesError(*frame->routine, errorNumber)) nearest = frame;
    }
    return {nearest, false};
}

Frame* userLevelHandler(Frame* at, int errorNumber) {
    for (Frame* frame = at; frame != nullptr; frame = frame->caller) {
        if (frame->routine == nullptr || frame->routine == &kTrapBoundary ||
            frame->routine == &kEventBoundary)
            return nullptr;
        if (frame->routine->noStepIn) continue;
        const bool takes = !inUndoHandler(*frame) && frame->routine->hasErrorHandler &&
                           coversStatement(*frame) && takesError(*frame->routine, errorNumber);
        return takes ? frame : nullptr;
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
