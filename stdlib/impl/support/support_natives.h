#pragma once
// Entry points that compiled code calls although RAPID has no name for them. Listed in support_natives.def.

#include "runtime/abi/rt_abi.h"

namespace rt {
/// An argument of rt_lateCall.
struct LateCallArg {
    void* data; ///< null: a conditional argument that is absent; a switch: any address
    const TypeDesc* type;
    const String* objectName; ///< of the data object it is (ArgName), null: none
    const String* parameter;  ///< null: the next required one
    int32_t flags;            ///< LateFlag
};
enum LateFlag : int32_t { kLateReference = 1, kLateConstant = 2, kLateSwitch = 4 };
} // namespace rt

extern "C" {
/// a + b for strings. Raises ERR_STRTOOLNG when the result has more than 80 bytes.
rt::Status rt_strConcat(rt::TaskCore* task, rt::String* result, const rt::String* a, const rt::String* b);
/// a = b for strings, byte by byte. No task, cannot raise.
bool rt_strEqual(const rt::String* a, const rt::String* b);
/// a = b for values of one type (numbers by value, records and arrays member by member). No task, cannot
/// raise.
bool rt_anyEqual(const void* a, const void* b, const rt::TypeDesc* type);

/// A signal used as a value. Raise ERR_NO_ALIASIO_DEF for a variable without a signal behind it,
/// ERR_NORUNUNIT and ERR_SIG_NOT_VALID (manual 1.9).
rt::Status rt_readSignalNum(rt::TaskCore* task, float* result, const rt::Handle* signal);
rt::Status rt_readSignalDnum(rt::TaskCore* task, double* result, const rt::Handle* signal);

/// WaitUntil: called whenever the condition was found FALSE. Suspends the task for one poll interval
/// (PollRate in s, default 0.1). `again` 1: evaluate the condition again; 0: MaxTime is over and TimeFlag has
/// been set. Without TimeFlag, ERR_WAIT_MAXTIME is raised. `state` is 0 at first and belongs to this call of
/// WaitUntil.
rt::Status rt_waitUntilPoll(rt::TaskCore* task, bool* again, bool InPos, const float* MaxTime, bool* TimeFlag,
                            const float* PollRate, int64_t* state);

/// \InPos of WaitUntil: before the condition is looked at. Does nothing when `inPos` is false.
rt::Status rt_waitInPos(rt::TaskCore* task, bool inPos);

/// Copies what a system variable of the controller (C_MOTSET, C_PROGDISP, ROB_ID; manual 1.7, 1.8) is now to `data`, which has
/// room for its type.
rt::Status rt_systemData(rt::TaskCore* task, void* data, const rt::String* name);

/// %name% and other calls whose target is found by name when they are executed: "procedure" or "module:procedure". `kind` is
/// a rt::RoutineKind, `result` where a function's value goes. Raises ERR_REFUNKPRC (ERR_REFUNKFUN) when there is none, and
/// ERR_CALLPROC when it is no routine of that kind or the arguments do not fit.
rt::Status rt_lateCall(rt::TaskCore* task, const rt::String* name, const rt::LateCallArg* args, int32_t count,
                       int32_t kind, void* result);
/// Address of a trap routine found by name, "module:trap". Raises ERR_REFUNKTRP.
rt::Status rt_lateTrap(rt::TaskCore* task, void** result, const rt::String* name);
/// A statement that refers to something nothing declares: raises `number`.
rt::Status rt_unresolved(rt::TaskCore* task, int32_t number, const rt::String* name);
/// Description of an array whose dimensions are known at run time only (unused ones 0); lives as long as the
/// controller.
rt::Status rt_arrayDesc(rt::TaskCore* task, const rt::TypeDesc** result, const rt::TypeDesc* element,
                        int32_t dim1, int32_t dim2, int32_t dim3);

/// CONNECT interrupt WITH trap: `trap` is the address of the compiled trap routine (rt::EntryFunction). Raises
/// ERR_ALRDYCNT and ERR_INOMAX.
rt::Status rt_connect(rt::TaskCore* task, float* interrupt, void* trap);

/// EXIT: UNDO handlers run, the program ends. Returns the status of unwinding.
rt::Status rt_exitProgram(rt::TaskCore* task);
/// RAISE number: the number as an integer. Raises ERR_ILLRAISE for one that is neither 1 to 90 nor predefined nor booked.
rt::Status rt_raiseNumber(rt::TaskCore* task, int32_t* result, float number);
/// RAISE number in an error handler: raises it at the call of the routine. Never returns 0.
rt::Status rt_raiseToCaller(rt::TaskCore* task, int32_t number);
/// No clause of the error handler lists the error: the system handler. Never returns 0.
rt::Status rt_errorNotListed(rt::TaskCore* task);
/// RaiseToUser in an error handler, with \Continue: kDecidedRetry or kDecidedTryNext, to be carried out by the routine that
/// calls this. With \BreakOff it never returns 0.
rt::Status rt_raiseToUser(rt::TaskCore* task, int32_t* result, bool Continue, bool BreakOff,
                          const float* ErrorNumber);
/// In a detached error handler, which returns then: how to go on (rt::HandlerDecision).
rt::Status rt_endDetached(rt::TaskCore* task, int32_t decision);
/// First thing an error handler asks whose routine has a detached one: kNotDecided, or what that one has decided.
rt::Status rt_takeDecision(rt::TaskCore* task, int32_t* result);
/// An instruction that is not allowed in an UNDO handler: a warning.
rt::Status rt_ignoredInUndo(rt::TaskCore* task, const rt::String* instruction);
/// A predefined routine was called that is declared only: the task stops with an event, never a silent no-op.
rt::Status rt_notImplemented(rt::TaskCore* task, const rt::String* name);

/// First thing a procedure with a BACKWARD part asks (manual 1.21): is this call executed backwards? Takes the order,
/// so that calls inside are executed forwards.
rt::Status rt_takeBackward(rt::TaskCore* task, uint8_t* result);
}
