#pragma once
// Who handles an error: the rules of manual chapter 1.12 over the chain of frame records. Pure functions.

#include "runtime/abi/rt_abi.h"
#include "runtime/sched/task.h"

namespace rt {

/// In the list of an ERROR clause: every error (LONG_JMP_ALL_ERR).
inline constexpr int kAllErrors = 999;

/// True when the routine's handler takes this error (its list is empty, names it, or names all).
bool takesError(const RoutineDesc& routine, int errorNumber);
/// The statement in progress of a frame; null when the record names none.
const StmtDesc* statementOf(const Frame& frame);
/// The frame whose error handler takes an error raised at first->statement; null: the system handler. The search goes
/// outward and ends at a statement of an error or UNDO handler and where the system called a trap routine.
Frame* findErrorHandler(Frame* first, int errorNumber);
SourcePlace placeOf(const Frame* frame);

} // namespace rt
