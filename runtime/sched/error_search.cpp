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

} // namespace

bool errorListNames(const RoutineDesc& routine, int errorNumber) {
    const ErrorVariable* const end = routine.errorVariables + routine.errorVariableCount;
    return inFilter(routine, errorNumber) || inFilter(routine, kAllErrors) ||
           std::any_of(routine.errorVariables, end, [errorNumber](const ErrorVariable& variable) {
               return variable.isFloat != 0 ? *static_cast<const float*>(variable.address) == errorNumber
                                            : *static_cast<const int32_t*>(variable.address) == errorNumber;
           });
}

bool errorListTakesOthers(const RoutineDesc& routine) {
    return inFilter(routine, kOtherErrors);
}

BypassedHandlers bypassedHandlers(const Frame* stoppedAt, int errorNumber) {
    BypassedHandlers result;
    const auto covered = [](const Frame& frame) {
        return !inUndoHandler(frame) && (!frame.routine->hasErrorHandler || coversStatement(frame));
    };
    if (stoppedAt == nullptr || !isOfProgram(*stoppedAt) || !covered(*stoppedAt)) return result;
    for (const Frame* frame = stoppedAt; frame != nullptr; frame = frame->caller) {
        if (!isOfProgram(*frame) || !covered(*frame)) break;
        if (frame->routine->isBuiltin != 0) continue;
        if (handles(*frame, errorNumber))
            result.callers.push_back(frame);
        else if (result.callers.empty())
            result.between.push_back(frame);
        if (result.callers.size() > BypassedHandlers::kMost ||
            result.between.size() > BypassedHandlers::kMostBetween)
            break;
    }
    return result;
}

Frame* userLevelHandler(Frame* at, int errorNumber) {
    for (Frame* frame = at; frame != nullptr && isOfProgram(*frame); frame = frame->caller) {
        if (frame->routine->noStepIn || frame->routine->isBuiltin) continue;
        return handles(*frame, errorNumber) ? frame : nullptr;
    }
    return nullptr;
}

SourcePlace placeOf(const RoutineDesc& routine, int32_t statement) {
    SourcePlace place;
    const auto text = [](const char* chars) { return std::string(chars != nullptr ? chars : ""); };
    place.module = text(routine.module);
    place.routine = text(routine.name);
    place.file = text(routine.file);
    if (const StmtDesc* row = statementOf(routine, statement)) {
        place.line = row->line;
        place.column = row->column;
    }
    return place;
}

SourcePlace placeOf(const Frame* frame) {
    if (frame == nullptr || frame->routine == nullptr) return {};
    return placeOf(*frame->routine, frame->statement);
}

} // namespace rt
