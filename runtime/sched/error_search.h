#pragma once
// Finds the handler of an error: the rules of manual chapter 1.12 over the chain of frame records. Pure functions.

#include "runtime/abi/rt_abi.h"
#include "runtime/sched/task.h"

#include <vector>

namespace rt {

/// True when the routine's handler takes this error if it comes to the routine itself.
bool takesError(const RoutineDesc& routine, int errorNumber);
/// True when the routine's handler lists this error (or all), so that it takes it from any depth and from traps.
bool listsError(const RoutineDesc& routine, int errorNumber);
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
/// The statement in progress belongs to the routine's error handler.
bool inErrorHandler(const Frame& frame);

/// The handler that an error goes to.
struct ErrorRoute {
    Frame* handler = nullptr; ///< null: to the system handler
    bool longJump =
        false; ///< past the routines between, error handlers among them, even out of a trap routine
};
/// Raised by the statement in progress of `at`: that routine's own handler, else the nearest handler further out that lists
/// the number. Handlers of callers without list are not asked (manual 1.12).
ErrorRoute routeOfError(Frame* at, int errorNumber);
/// Raised at the call in progress of `at` by RAISE in a handler: the nearest handler from there outwards that lists the number,
/// else the handler of `at`. The search ends at a statement of an error or UNDO handler.
ErrorRoute routeFromCall(Frame* at, int errorNumber);
/// The handler of this very routine takes the error at its statement in progress.
bool handles(const Frame& frame, int errorNumber);
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

/// For the event of an error that nothing takes.
struct UnaskedHandlers {
    static constexpr std::size_t kMost = 3, kMostBetween = 8;
    std::vector<const Frame*> between; ///< from the routine without a fitting handler on, innermost first
    std::vector<const Frame*>
        callers; ///< with a handler that would take the error; more than kMost: there are others
};
/// `stoppedAt`: the routine whose lack of a handler ended the search. Empty where no RAISE would help: in handlers, in traps.
UnaskedHandlers unaskedHandlers(const Frame* stoppedAt, int errorNumber);
/// RaiseToUser: the innermost routine in progress that is not NOSTEPIN, when its handler takes errors there.
Frame* userLevelHandler(Frame* at, int errorNumber);
SourcePlace placeOf(const RoutineDesc& routine, int32_t statement);
SourcePlace placeOf(const Frame* frame);

} // namespace rt
