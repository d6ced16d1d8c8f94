#pragma once
// Who handles an error: the rules of manual chapter 1.12 over the chain of frame records. Pure functions.

#include "runtime/abi/rt_abi.h"
#include "runtime/sched/task.h"

namespace rt {

/// True when the routine's handler takes this error if it comes to the routine itself.
bool takesError(const RoutineDesc& routine, int errorNumber);
/// True when the routine's handler lists this error (or all), so that it takes it from any depth and from traps.
bool listsError(const RoutineDesc& routine, int errorNumber);
/// The statement in progress of a frame; null when the record names none.
const StmtDesc* statementOf(const Frame& frame);
/// The statement in progress belongs to the routine's error handler.
bool inErrorHandler(const Frame& frame);

/// Where an error goes.
struct ErrorRoute {
    Frame* handler = nullptr; ///< null: to the system handler
    bool longJump =
        false; ///< past the routines between, error handlers among them, even out of a trap routine
};
/// Raised by the statement in progress of `at`: that routine's own handler first, then as raisedAtCall.
ErrorRoute routeOfError(Frame* at, int errorNumber);
/// Raised at the call in progress of `at`: the nearest handler further out that lists the number takes it; when there is
/// none, the nearest handler without list. The search ends at a statement of an error or UNDO handler, and for handlers
/// without list where the system called a trap routine.
ErrorRoute routeFromCall(Frame* at, int errorNumber);
/// RaiseToUser: the innermost routine in progress that is not NOSTEPIN, when its handler takes errors there.
Frame* userLevelHandler(Frame* at, int errorNumber);
SourcePlace placeOf(const Frame* frame);

} // namespace rt
