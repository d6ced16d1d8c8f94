#pragma once
// Finds the handler of an error: the rules of manual chapter 1.12 over the chain of frame records. Pure functions.

#include "runtime/abi/rt_abi.h"
#include "runtime/sched/task.h"

#include <vector>

namespace rt {

// The functions below that every raised error passes through are inline: a program may raise millions.

/// The error handler of the routine lists the errors that it takes.
inline bool hasErrorList(const RoutineDesc& routine) {
    return routine.errorFilterCount != 0 || routine.errorVariableCount != 0;
}
/// One of the listed numbers is this error, or the list says that it takes all. The routine has a list.
bool errorListNames(const RoutineDesc& routine, int errorNumber);
/// The list takes the others too, but only when they come to the routine itself.
bool errorListTakesOthers(const RoutineDesc& routine);
/// True when the routine's handler takes this error if it comes to the routine itself.
inline bool takesError(const RoutineDesc& routine, int errorNumber) {
    if (routine.hasErrorHandler == 0) return false;
    return !hasErrorList(routine) || errorListTakesOthers(routine) || errorListNames(routine, errorNumber);
}
/// True when the routine's handler lists this error (or all), so that it takes it from any depth and from traps.
inline bool listsError(const RoutineDesc& routine, int errorNumber) {
    return routine.hasErrorHandler != 0 && hasErrorList(routine) && errorListNames(routine, errorNumber);
}
/// A statement of a routine; null when it has none of that number.
inline const StmtDesc* statementOf(const RoutineDesc& routine, int32_t number) {
    const bool isThere = number >= 0 && static_cast<uint32_t>(number) < routine.statementCount;
    return isThere ? &routine.statements[number] : nullptr;
}
/// The statement in progress of a frame; null when the record names none.
inline const StmtDesc* statementOf(const Frame& frame) {
    return frame.routine != nullptr ? statementOf(*frame.routine, frame.statement) : nullptr;
}
/// The record of a place where the system calls a routine.
inline bool isBoundary(const Frame& frame) {
    return frame.routine == &kTrapBoundary || frame.routine == &kEventBoundary;
}
/// A statement that the handler does not cover is part of a handler: no recovery from there.
inline bool coversStatement(const Frame& frame) {
    const StmtDesc* statement = statementOf(frame);
    return statement != nullptr && statement->handled != 0;
}
inline bool inUndoHandler(const Frame& frame) {
    return frame.routine->hasUndo != 0 && frame.reserved == kFrameInUndo;
}
/// Not a place where the system calls a routine.
inline bool isOfProgram(const Frame& frame) {
    return frame.routine != nullptr && !isBoundary(frame);
}
/// The statement in progress belongs to the routine's error or UNDO handler.
inline bool inHandler(const Frame& frame) {
    const StmtDesc* statement = statementOf(frame);
    return statement != nullptr && statement->kind == kStmtHandler;
}
/// The statement in progress belongs to the routine's error handler.
inline bool inErrorHandler(const Frame& frame) {
    return inHandler(frame) && !inUndoHandler(frame);
}

/// The handler that an error goes to.
struct ErrorRoute {
    Frame* handler = nullptr; ///< null: to the system handler
    bool longJump =
        false; ///< past the routines between, error handlers among them, even out of a trap routine
};
/// The frame whose statement the user sees as the instruction in progress: instructions of the standard library that are
/// written in RAPID belong to their caller's statement.
inline const Frame* callSeenByUser(const Frame* at) {
    while (at != nullptr && at->routine != nullptr && at->routine->isBuiltin != 0)
        at = at->caller;
    return at;
}
inline Frame* callSeenByUser(Frame* at) {
    return const_cast<Frame*>(callSeenByUser(static_cast<const Frame*>(at)));
}

/// The handler of this very routine takes the error at its statement in progress.
inline bool handles(const Frame& frame, int errorNumber) {
    return isOfProgram(frame) && !inUndoHandler(frame) && coversStatement(frame) &&
           takesError(*frame.routine, errorNumber);
}
/// The nearest handler from `at` outwards that lists the number, past trap routines too; null: none. The search ends at a
/// statement of an error or UNDO handler: errors there do not reach routines that are being left.
inline Frame* listingHandler(Frame* at, int errorNumber) {
    for (Frame* frame = at; frame != nullptr && frame->routine != &kEventBoundary; frame = frame->caller) {
        if (!isOfProgram(*frame)) continue;
        if (inUndoHandler(*frame)) break;
        if (frame->routine->hasErrorHandler == 0) continue;
        if (!coversStatement(*frame)) break;
        if (listsError(*frame->routine, errorNumber)) return frame;
    }
    return nullptr;
}
/// Raised by the statement in progress of `at`: that routine's own handler, else the nearest handler further out that lists
/// the number. Handlers of callers without list are not asked (manual 1.12).
inline ErrorRoute routeOfError(Frame* at, int errorNumber) {
    at = callSeenByUser(at);
    if (at == nullptr || at->routine == &kEventBoundary) return {};
    if (isOfProgram(*at)) {
        if (inUndoHandler(*at)) return {};
        if (at->routine->hasErrorHandler != 0) {
            if (!coversStatement(*at)) return {};
            if (takesError(*at->routine, errorNumber)) return {at, false};
        }
    }
    Frame* const listing = listingHandler(at->caller, errorNumber);
    return {listing, listing != nullptr};
}
/// Raised at the call in progress of `at` by RAISE in a handler: the nearest handler from there outwards that lists the number,
/// else the handler of `at`. The search ends at a statement of an error or UNDO handler.
inline ErrorRoute routeFromCall(Frame* at, int errorNumber) {
    at = callSeenByUser(at);
    if (Frame* const listing = listingHandler(at, errorNumber)) return {listing, true};
    return {at != nullptr && handles(*at, errorNumber) ? at : nullptr, false};
}

/// For the event of an error that nothing takes.
struct BypassedHandlers {
    static constexpr std::size_t kMost = 3, kMostBetween = 8;
    std::vector<const Frame*> between; ///< from the routine without a fitting handler on, innermost first
    std::vector<const Frame*>
        callers; ///< with a handler that would take the error; more than kMost: there are others
};
/// `stoppedAt`: the routine whose lack of a handler ended the search. Empty where no RAISE would help: in handlers, in traps.
BypassedHandlers bypassedHandlers(const Frame* stoppedAt, int errorNumber);
/// RaiseToUser: the innermost routine in progress that is not NOSTEPIN, when its handler takes errors there.
Frame* userLevelHandler(Frame* at, int errorNumber);
SourcePlace placeOf(const RoutineDesc& routine, int32_t statement);
SourcePlace placeOf(const Frame* frame);

} // namespace rt
