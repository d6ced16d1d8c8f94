#pragma once
// The interface of compiled code and the runtime. Plain C layout, no behaviour: codegen emits exactly these structures.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace rt {

/// Bytes that a string of the source language holds.
inline constexpr uint32_t kStringCapacity = 80;

/// A string: fixed, UTF-8, a plain value.
struct String {
    uint32_t length = 0;
    char bytes[kStringCapacity] = {};

    std::string_view view() const { return {bytes, size()}; }
    /// The length, of which the compiler knows that it is at most the capacity: loops over strings count with integers.
    size_t size() const {
        if (length > kStringCapacity) __builtin_unreachable();
        return length;
    }
    /// Takes no more than fits; the caller raises ERR_STRTOOLNG when text is longer.
    void assign(std::string_view text) {
        length = static_cast<uint32_t>(text.size() < kStringCapacity ? text.size() : kStringCapacity);
        std::memcpy(bytes, text.data(), length);
    }
};
static_assert(sizeof(String) == sizeof(uint32_t) + kStringCapacity && alignof(String) == alignof(uint32_t));

/// Result of every compiled routine and native call. 0: done. > 0: a recoverable error with this ERRNO is on its way
/// to a handler. < 0: the stack is being unwound (EXIT, end of the run, program pointer moved).
using Status = int32_t;
inline constexpr Status kOk = 0;
inline constexpr Status kUnwind = -1;
/// As kUnwind, but UNDO handlers are not run (the run ends, UNDO was aborted). Passed up unchanged.
inline constexpr Status kUnwindSilent = -2;
/// An error is on its way to the handler of one certain routine further out (long jump): UNDO handlers run, error
/// handlers ask rt_land. kJumpSilent: without UNDO. kJumpPast: without the UNDO of this routine, with those further out.
inline constexpr Status kJump = -3;
inline constexpr Status kJumpSilent = -4;
inline constexpr Status kJumpPast = -5;
/// The task stopped at an error and has been started again: the native is called once more, or, in the stepping profile,
/// the statement of the frame record is executed again. Never leaves a routine.
inline constexpr Status kAgain = -6;

/// Bytes: a container of bytes (rawbytes), laid out as a string of its own capacity.
enum class DescKind : uint8_t { Num, Dnum, Bool, String, Record, Array, Handle, Other, Bytes };

/// Handle of an object that the controller owns (signal, clock, file ...); 0 = not connected yet.
using Handle = int64_t;

/// Run-time description of a type of the source language.
struct TypeDesc {
    const char* name;     ///< as declared; an alias keeps its name
    const char* baseName; ///< aliases resolved
    DescKind kind;
    uint32_t size;                 ///< bytes
    uint32_t count;                ///< record: number of fields; array: number of elements in all
    int32_t dims[3];               ///< array; unused entries 0
    const TypeDesc* const* fields; ///< record: per field; array: one entry, the element
    const char* const* fieldNames; ///< record
    const uint32_t* offsets;       ///< record: byte offset per field
};

/// An argument of any type.
struct AnyRef {
    void* data = nullptr; ///< null: optional argument not present
    const TypeDesc* type = nullptr;
};

struct StmtDesc {
    uint32_t line, column, endLine, endColumn; ///< from 1
    uint8_t kind;                              ///< StmtKind
    uint8_t handled;                           ///< 1: an error here goes to the routine's error handler
    uint8_t flags;                             ///< StmtFlag; stepping profile
    uint8_t canStart;                          ///< StartMark
    int32_t previous;                          ///< the statement before it in its list, -1: it is the first
};

enum StmtKind : uint8_t {
    kStmtPlain,
    kStmtCall,
    kStmtMotion,
    kStmtControl,
    kStmtReturn,
    kStmtHandler ///< in an error or UNDO handler
};

/// StmtDesc::canStart: whether rt_step may name the statement. kCannotStart always in the release profile.
enum StartMark : uint8_t {
    kCannotStart = 0,
    kCanStart = 1,
    kStartsEarlier = 2 ///< a further condition of an IF: execution begins at the first one
};

/// StmtDesc::flags: what executing the statement backwards means.
enum StmtFlag : uint8_t {
    kStmtCallsRoutine = 1,
    kStmtCallsBackward = 2,
    kStmtForwardOnly = 4,
    kStmtInBackward = 8,
    kStmtMovement = 16,
    kStmtInHandler = 32,
    kStmtRepeatable = 64,
    kStmtReenterable = 128
};

/// A local variable or parameter that the debugger shows (stepping profile).
struct LocalDesc {
    enum Kind : uint8_t {
        Value,    ///< its address is the object's
        Reference ///< at its address is that of the object; null = parameter not given
    };
    const char* name;     ///< "": belongs to an instruction (end and step of FOR), not visible
    const TypeDesc* type; ///< of the object; when rank > 0: of its elements
    Kind kind;
    uint8_t isParam;
    uint8_t
        rank; ///< array with dimensions known at run time: they are the `rank` entries (int32_t) that follow
    uint8_t pad;
};

/// How execution continues after a detached error handler.
enum HandlerDecision : int32_t { kNotDecided, kDecidedRetry, kDecidedTryNext, kDecidedReturn, kDecidedRaise };

/// Numbers with a meaning of their own in RoutineDesc::errorFilter.
inline constexpr int32_t kAllErrors = INT32_MIN; ///< every error, wherever it is raised
inline constexpr int32_t kOtherErrors = 0; ///< the others, too, but only when they come to the routine itself

struct Frame;
struct TaskCore;
/// The error handler of a routine as a function of its own, for RaiseToUser \Continue: it runs on top of the routines in
/// progress, `caller` is the innermost of them. `data`: SteppingFrame::addresses from RoutineDesc::localCount on. 0: it has
/// said how to continue (rt_endDetached); > 0: it raises that error where the routine was called.
using DetachedHandler = Status (*)(TaskCore* task, Frame* caller, void* const* data);

/// A variable of the program that holds a number listed by an error handler.
struct ErrorVariable {
    const void* address;
    int64_t isFloat; ///< a float, otherwise an int32_t
};

struct RoutineDesc {
    const char* name; ///< as people see it
    const char* module;
    const char* file;
    const StmtDesc* statements;
    uint32_t statementCount;
    uint8_t hasErrorHandler;
    uint8_t hasUndo;
    uint8_t noStepIn;
    uint8_t hasBackward; ///< stepping profile: has a BACKWARD part
    /// Numbers the handler lists: it takes them from any depth and from traps. None listed: it takes every error that
    /// comes to the routine itself.
    const int32_t* errorFilter;
    uint32_t errorFilterCount;
    const ErrorVariable* errorVariables; ///< further listed numbers
    uint32_t errorVariableCount;
    uint32_t localCount; ///< > 0, or `stepping`, or with detachedHandler: the frame record is a SteppingFrame
    const LocalDesc* locals; ///< in their order; dimensions of arrays have rows without name and type
    uint32_t line;           ///< of its declaration
    uint8_t stepping;        ///< made for the stepping profile
    uint8_t
        callable; ///< a procedure without parameters: the program pointer can be moved to it, the system can call it
    uint8_t isDetachedHandler;       ///< of another routine, whose name and place it has
    uint8_t isBuiltin;               ///< an instruction of the standard library that is written in RAPID
    uint32_t textHash;               ///< stepping profile: another number when the source text was changed
    DetachedHandler detachedHandler; ///< null: no handler, or no RaiseToUser \Continue in the program
};

/// Marks in the chain of frame records a call of a routine by the system.
constexpr RoutineDesc boundary(const char* name) {
    RoutineDesc desc{};
    desc.name = name;
    desc.module = desc.file = "";
    return desc;
}

/// Frame record: lies in the stack frame of each routine in progress; the chain is the call stack. The caller's record
/// is passed down in a register; `statement` is stored before whatever may raise, wait or be preempted.
struct Frame {
    Frame* caller;
    const RoutineDesc* routine;
    int32_t statement;
    int32_t reserved; ///< 0 at first; kept by the runtime (retries), kFrameInUndo once the UNDO handler runs
};
inline constexpr int32_t kFrameInUndo = -1;

/// Frame record of a routine with described locals (RoutineDesc::localCount > 0) or a detached handler, and of each one made
/// for the stepping profile.
struct SteppingFrame : Frame {
    void* const* addresses; ///< one per LocalDesc, then what the detached handler needs
    int32_t failed;         ///< in the error handler: the statement that failed
};

/// The part of a task that compiled code touches directly. rt::Task begins with it.
struct TaskCore {
    int64_t
        budget; ///< instructions left in this slice; negative after a safepoint's charge: call rt_safepoint
    char* stackLimit;        ///< lowest address a routine may use; below: rt_stackOverflow
    Frame* frame;            ///< record of the innermost routine that calls natives which look at it
    int32_t errorNumber;     ///< ERRNO
    int32_t interruptNumber; ///< INTNO
    int32_t askSteps;        ///< stepping profile: not 0: rt_step is called before every statement
};

// ---- Program description: emitted once per program as the symbol `rapidc_program` ---------------------------------

using EntryFunction = Status (*)(TaskCore*, Frame*);

struct TaskDesc {
    const char* name;
    const char* type; ///< NORMAL, STATIC, SEMISTATIC
    EntryFunction entry;
    EntryFunction reset; ///< gives every variable of the task its initial value
    uint8_t motionTask;
};
struct GlobalDesc { ///< module data, for SetDataVal, the debugger, saving of persistents
    const char* name;
    const char* module;
    void* address;
    const TypeDesc* type;
    uint8_t kind;  ///< GlobalKind
    uint8_t flags; ///< DataFlag
    int32_t task;  ///< index into tasks; -1 = shared
    const char* file;
    uint32_t line;
};
enum GlobalKind : uint8_t { kGlobalVariable, kGlobalPersistent, kGlobalConstant };
/// GlobalDesc::flags.
enum DataFlag : uint8_t {
    kDataLocal = 1,      ///< visible in its module only
    kDataPredefined = 2, ///< belongs to the language, not to the program
};
/// Data of a routine, for searches by name (programs that use them).
struct RoutineDataDesc {
    const char* name;
    const char* module;
    const char* routine;
    const TypeDesc* type;
    int32_t task;
    uint8_t kind; ///< GlobalKind
};
struct ModuleDesc {
    const char* name;
    const char* file;
    int32_t task;
    int32_t* gone; ///< set to 1 when the module leaves memory; null: not needed
};
struct ExternalDesc { ///< a configured object named by the program (signal ...)
    const char* name;
    const char* kind; ///< "signaldi", ...
    Handle* slot;
    const char* file;
    uint32_t line, column;
};
/// A parameter of a routine that can be called by name.
struct ParamDesc {
    const char* name;
    const TypeDesc* type; ///< of the object; when rank > 0: of its elements; null: switch
    uint8_t mode;         ///< ParamMode
    uint8_t optional;
    uint8_t rank;
    uint8_t group; ///< equal for mutually exclusive parameters; 0 = none
};
enum ParamMode : uint8_t { kParamIn, kParamVar, kParamPers, kParamInOut };
/// An argument given to a routine by name, in the order of its parameters. `data` null: not present (a present switch has
/// any address).
struct LateArg {
    void* data;
    const TypeDesc* type;
    const String* name; ///< of the object the caller gave (ArgName); null: none
};
/// `result`: where a function's value goes.
using LateEntry = Status (*)(TaskCore*, Frame*, const LateArg*, void* result);
struct RoutineEntry { ///< for late binding
    const char* name;
    const char* module;
    int32_t task;
    uint8_t kind;    ///< RoutineKind
    uint8_t isLocal; ///< visible in its module only
    void* address;   ///< C entry; null: the routine is only listed
    const RoutineDesc* desc;
    LateEntry late; ///< procedures and functions: called with arguments by name; null: not made
    const ParamDesc* params;
    uint32_t paramCount;
};
enum RoutineKind : uint8_t { kRoutineProc, kRoutineFunc, kRoutineTrap };
struct ProgramDesc {
    const char* name;
    const TaskDesc* tasks;
    uint32_t taskCount;
    const GlobalDesc* globals;
    uint32_t globalCount;
    const ExternalDesc* externals;
    uint32_t externalCount;
    const RoutineEntry* routines;
    uint32_t routineCount;
    const char* const* configNames;
    const char* const* configTexts;
    uint32_t configCount;
    uint32_t moduleCount;
    const ModuleDesc* modules;
    const TypeDesc* const* types; ///< the types that data can be searched by, when the program does so
    const RoutineDataDesc* routineData;
    uint32_t typeCount;
    uint32_t routineDataCount;
    EntryFunction
        reset;          ///< of a unit loaded at run time (no tasks): gives its variables their initial values
    const char* folder; ///< where relative paths of files begin; "" = where the process runs
    const GlobalDesc* aliases; ///< further declarations of persistents that tasks share, one row each
    uint32_t aliasCount;
    const char* sources; ///< executables that can load modules: what the compiler needs for that; not a text
    uint64_t sourcesSize;
};

} // namespace rt

// ---- Calls from compiled code into the runtime --------------------------------------------------------------------
extern "C" {
/// Budget used up: yields, delivers interrupts. Returns 0 or a negative status (unwind).
rt::Status rt_safepoint(rt::TaskCore* task, rt::Frame* frame);
/// An error is raised at frame->statement. Finds out whether a handler in the chain takes it; if so sets ERRNO and
/// returns `errorNumber`, or kJump for a handler that is not the next one. Otherwise the system handler stops the task
/// with the stack intact; started again, the instruction fails again, so that only an unwinding status comes back.
rt::Status rt_raise(rt::TaskCore* task, rt::Frame* frame, rt::Status errorNumber);
/// A native called at frame->statement returned `status`, not 0: as rt_raise, but kAgain when the task was started again.
rt::Status rt_nativeFailed(rt::TaskCore* task, rt::Frame* frame, rt::Status status);
/// kJump or kJumpSilent has come to a routine with an error handler: the error number when that handler is meant,
/// otherwise `status`.
rt::Status rt_land(rt::TaskCore* task, rt::Frame* frame, rt::Status status);
/// 1 when the routine's own handler takes the error (for lists with variables).
rt::Status rt_takesError(rt::TaskCore* task, rt::Frame* frame, rt::Status errorNumber);
/// RAISE without number in a handler, or a handler that passes the error on: raises it again at the caller's statement.
rt::Status rt_propagate(rt::TaskCore* task, rt::Frame* frame);
/// The end of an error handler was reached (manual 1.12): system handler. Returns kUnwind.
rt::Status rt_handlerEnd(rt::TaskCore* task, rt::Frame* frame);
/// RETRY in the handler of `frame`: counts; 0, or an unwinding status when the task stopped because No Of Retry is
/// exceeded. Started again, it counts again.
rt::Status rt_retry(rt::TaskCore* task, rt::Frame* frame);
/// Stepping profile, before a statement, when the budget is used up or TaskCore::askSteps is set: the task may stop
/// here or be sent elsewhere. Returns the number of the statement to execute next (>= 0), or a negative status (unwind).
int32_t rt_step(rt::TaskCore* task, rt::Frame* frame);
/// Stepping profile, for a charge while the budget is below 0: the next statement looks at it. `cost` instructions are charged
/// after that look, as in the other profiles, which look at each charge.
void rt_chargeLater(rt::TaskCore* task, int64_t cost);
/// The stack of the task is used up. Returns kUnwind.
rt::Status rt_stackOverflow(rt::TaskCore* task, rt::Frame* frame);

/// The self-description of a compiled program; defined by the program.
extern const rt::ProgramDesc rapidc_program;
}
