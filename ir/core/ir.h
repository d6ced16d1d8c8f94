#pragma once
// The mid-level IR: types, constants, routines made of basic blocks, statement tables, run-time descriptions.
// General on purpose (statements, handlers, tasks, persistents, calls into the runtime): nothing here knows
// a source language. Not SSA: named storage is `local`/`global` memory; instruction results are temporaries assigned
// once, used in the same routine in blocks dominated by their definition. LLVM promotes the memory later. See
// ir/LANGREF.md.

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ir/core/inst_list.h"
#include "ir/core/operand_list.h"

namespace ir {

// ---- Types -----------------------------------------------------------------------------------------------

enum class TypeKind : uint8_t {
    Void,
    Bool, ///< one byte in memory, 0 or 1
    I8,   ///< integers have no sign: an instruction says how it reads them where it matters
    I16,
    I32, ///< counters, indices, dimensions, status
    I64, ///< handles of objects that the controller owns (signals, clocks, files ...)
    F32,
    F64,
    Ptr,    ///< reference; what it points to is said by the instruction that uses it
    Str,    ///< { u32 length, Type::capacity bytes }, aligned as the length
    Record, ///< fields in order, natural C layout
    Array   ///< row-major, rank 1 to 3
};

using TypeId = uint32_t; ///< index into Module::types; the scalar types have the fixed ids below
inline constexpr TypeId kVoid = 0, kBool = 1, kI8 = 2, kI16 = 3, kI32 = 4, kI64 = 5, kF32 = 6, kF64 = 7,
                        kPtr = 8;
inline constexpr uint32_t kScalarTypes = kPtr + 1; ///< how many fixed ids there are

constexpr bool isInteger(TypeId type) {
    return type >= kI8 && type <= kI64;
}
constexpr bool isFloat(TypeId type) {
    return type == kF32 || type == kF64;
}
/// Bits of an integer or floating-point type.
constexpr unsigned bitsOf(TypeId type) {
    return isInteger(type) ? 8u << (type - kI8) : type == kF32 ? 32 : type == kF64 ? 64 : 0;
}
/// The value with its lowest `bits` bits, as a signed and as an unsigned number.
constexpr int64_t signExtended(uint64_t value, unsigned bits) {
    return static_cast<int64_t>(value << (64 - bits)) >> (64 - bits);
}
constexpr uint64_t zeroExtended(int64_t value, unsigned bits) {
    return static_cast<uint64_t>(value) << (64 - bits) >> (64 - bits);
}

struct Field {
    std::string name;
    TypeId type = kVoid;
};

struct Type {
    TypeKind kind = TypeKind::Void;
    std::string name;          ///< records
    std::vector<Field> fields; ///< records
    uint32_t capacity = 0;     ///< strings: the most bytes that one holds
    TypeId element = kVoid;    ///< arrays
    std::vector<int32_t> dims; ///< arrays, 1 to 3 entries > 0
};

// ---- Constant data ---------------------------------------------------------------------------------------

/// One scalar of constant data. Aggregates are flattened in memory order.
struct ConstScalar {
    TypeKind kind = TypeKind::F32; ///< Bool, an integer, F32, F64 or Str
    double number = 0;             ///< F32, F64
    int64_t integer = 0;           ///< Bool and integers, sign-extended
    std::string text;              ///< Str: no more bytes than its type holds
};
using ConstData = std::vector<ConstScalar>; ///< empty = all zero

// ---- Instructions ----------------------------------------------------------------------------------------

/// Opcodes: see instructions.def (family, form, operands, result, may it raise, is it a terminator).
enum class Op : uint8_t {
#define INST(family, name, text, form, operands, result, flags) name,
#include "ir/core/instructions.def"
};

using BlockId = uint32_t;
using StmtId = uint32_t; ///< index into Routine::statements
inline constexpr uint32_t kNone = 0xFFFFFFFFu;

struct SwitchCase {
    int32_t value = 0;
    BlockId target = kNone;
};

/// Programs have millions: what no instruction needs together shares its place.
struct Inst {
    /// Const: the value of F32 and F64, and of Bool, Ptr (0) and integers, sign-extended. Set after the operands.
    double number() const { return constant<double>(); }
    int64_t integer() const { return constant<int64_t>(); }
    void setNumber(double value) { std::memcpy(operands.room(), &value, sizeof value); }
    void setInteger(int64_t value) { std::memcpy(operands.room(), &value, sizeof value); }
    /// Br, CondBr, Switch: where it jumps; Br and Switch have one target. Set after the operands.
    BlockId& target(size_t i) { return operands.room()[i]; }
    BlockId target(size_t i) const { return operands.room()[i]; }

    OperandList operands; ///< values
    union {
        /// Check, CheckFinite: error number; Charge, Safepoint: cost; Sysvar: SysvarKind; CondBr: 1 = seldom goes to target[1]
        int32_t extra = 0;
        /// Local, global, param, field, routine, native, statement or type-desc number; Switch: of its cases
        uint32_t index;
    };
    StmtId stmt = kNone; ///< statement it belongs to
    TypeId type = kVoid; ///< result type; for Load/Store/Copy/Zero/FieldAddr/ElemAddr: the type accessed
    Op op{};

  private:
    template <class T> T constant() const {
        T value;
        std::memcpy(&value, operands.room(), sizeof value);
        return value;
    }
};
static_assert(sizeof(Inst) <= 32);

// ---- Statements ------------------------------------------------------------------------------------------

enum class StmtKind : uint8_t { Plain, Call, Motion, Control, Return, Handler };

/// One row of a routine's statement table; survives to run time (program pointer, events, debugger, RETRY,
/// TRYNEXT).
struct Statement {
    uint32_t line = 0, column = 0, endLine = 0, endColumn = 0; ///< from 1
    StmtKind kind = StmtKind::Plain;
    bool handled = false;  ///< an error here goes to the routine's error handler
    BlockId start = kNone; ///< where RETRY and `step` continue; kNone when it is not needed
    BlockId next = kNone;  ///< where TRYNEXT continues
    StmtId previous =
        kNone;         ///< the statement before it in its list; kNone: the first. Stepping routines only
    uint8_t flags = 0; ///< StatementFlag; stepping routines only
};

/// The meaning of a statement that is executed backwards (stepping routines only).
enum StatementFlag : uint8_t {
    kStmtCallsRoutine = 1,  ///< calls a routine of the program
    kStmtCallsBackward = 2, ///< that routine says how it is executed backwards
    kStmtForwardOnly = 4,   ///< cannot be executed backwards, the attempt gives a warning
    kStmtInBackward = 8,    ///< belongs to the backward part of its routine
    kStmtMovement = 16,     ///< moves the robot
    kStmtInHandler = 32,    ///< belongs to the error handler
    /// Interrupted while it waits, it can be executed from its beginning: nothing that has an effect comes ahead.
    kStmtRepeatable = 64,
    /// Its only call of a routine can be entered again by executing it from its beginning.
    kStmtReenterable = 128
};

// ---- Routines --------------------------------------------------------------------------------------------

struct Param {
    std::string name;
    TypeId type = kPtr; ///< scalar by value, or Ptr
};
struct Local {
    std::string name; ///< empty for temporaries
    TypeId type = kVoid;
    bool isParam = false;      ///< for the debugger: shown as a parameter
    uint32_t typeDesc = kNone; ///< of the object, for the debugger; stepping routines only
    /// The local (of type Ptr) holds the address of the object; null = not given.
    bool reference = false;
    uint32_t rank = 0;     ///< array whose dimensions are known at run time only; typeDesc is its element's
    uint32_t dims = kNone; ///< then: the first of `rank` I32 locals that hold the dimensions
};
struct Block {
    uint32_t name = 0;          ///< index into Routine::blockNames
    std::vector<ValueId> insts; ///< the last one is a terminator
};

// Size: all facts about a routine that passes and code generators read; data without behaviour.
struct Routine {
    std::string name;        ///< linkage name, unique in the module, e.g. "T_ROB1/MainModule/main"
    std::string displayName; ///< what people see: "main"
    std::string moduleName;
    uint32_t file = kNone; ///< index into Module::files
    uint32_t line = 0;
    bool noStepIn = false;
    bool isBuiltin = false; ///< an instruction of the language: errors in it come to its caller's statement
    bool stepping =
        false; ///< made for the stepping profile: every statement has a start that `step` may choose
    bool hasBackward = false; ///< stepping: has a backward part
    bool callable = false;    ///< a procedure without parameters
    uint32_t textHash = 0;    ///< stepping: another number when its source text was changed
    bool exported = false;    ///< reachable from outside (entry, late binding)
    TypeId result = kVoid; ///< scalar: returned beside the status; Str/Record/Array: through a hidden pointer
    std::vector<Param> params;
    std::vector<Local> locals;
    PieceList<Inst> insts;
    PieceList<Block> blocks; ///< block 0 is the entry
    std::vector<std::string> blockNames;
    std::vector<std::vector<SwitchCase>> caseLists; ///< Switch: by Inst::index
    std::vector<Statement> statements;
    BlockId errorHandler = kNone;
    /// When one of them is not empty: numbers the handler takes, from any depth of calls and from interrupt routines; as
    /// numbers and as global variables (I32 or F32). errorFilter may hold kEveryError and kOwnErrors.
    std::vector<int32_t> errorFilter;
    std::vector<uint32_t> errorFilterGlobals;
    /// The routine that does on top of others what the error handler would do after they are left; kNone: not needed. Its
    /// one parameter is a table with the addresses of `sharedLocals`.
    uint32_t detachedHandler = kNone;
    std::vector<uint32_t> sharedLocals;
    bool isDetachedHandler = false; ///< of another routine; `propagate` and `handlerend` act for that one
    BlockId undoHandler = kNone;    ///< the UNDO part; a `ret` without value in it continues unwinding

    /// The number of a name for blocks; a name used not long ago keeps its number.
    uint32_t blockName(std::string_view wanted);
    /// Calls `visit` with each block (BlockId&) that the terminator goes to.
    template <class Visit> void visitTargets(Inst& last, const Visit& visit) {
        const bool isSwitch = last.op == Op::Switch, isBranch = last.op == Op::CondBr;
        if (!isSwitch && !isBranch && last.op != Op::Br) return;
        visit(last.target(0));
        if (isBranch) visit(last.target(1));
        if (!isSwitch) return;
        for (SwitchCase& entry : caseLists[last.index])
            visit(entry.target);
    }
};

/// In Routine::errorFilter: every error, wherever it is raised; those of the routine and its calls.
inline constexpr int32_t kEveryError = INT32_MIN, kOwnErrors = 0;

/// The permissions of a native routine; they decide how it is called (see codegen/README.md).
enum class NativeClass : uint8_t {
    Const, ///< by-value scalars only, returns its result directly, no task, cannot raise: free to move and
           ///< merge
    Plain  ///< gets the task, returns a status, result through a pointer; may raise or suspend the task
};
struct Native {
    std::string symbol; ///< C symbol
    NativeClass nativeClass = NativeClass::Plain;
    TypeId result = kVoid;
    std::vector<TypeId> params;
    bool watches = false; ///< keeps looking at persistents it was given: stores to them become safepoints
    bool finite = false;  ///< plain; the result is never infinite or NaN
    bool bounded = false; ///< the result exceeds the largest of the numbers it takes by at most 1
    bool whole = false;   ///< the result is a whole number of at most 52 bits
};

// ---- Module ----------------------------------------------------------------------------------------------

enum class GlobalKind : uint8_t { Var, Persistent, Const, External };
struct Global {
    std::string name; ///< linkage name
    std::string displayName;
    std::string moduleName;
    TypeId type = kVoid;
    GlobalKind kind = GlobalKind::Var;
    ConstData init;
    uint32_t typeDesc = kNone; ///< index into Module::typeDescs
    uint32_t task = kNone;     ///< owning task; kNone = shared by all
    uint32_t file = kNone, line = 0;
    uint8_t flags = 0; ///< DataFlag
};
enum DataFlag : uint8_t {
    kDataLocal = 1,     ///< visible in its module only
    kDataPredefined = 2 ///< belongs to the language
};

enum class ParamMode : uint8_t { In, Variable, Persistent, Either };
/// A parameter as the source language sees it (one or more entries of Routine::params).
struct ParamEntry {
    std::string name;
    uint32_t typeDesc = kNone; ///< kNone: a switch
    ParamMode mode = ParamMode::In;
    bool optional = false;
    uint8_t rank = 0;        ///< > 0: an array of elements of that type
    uint8_t group = 0;       ///< equal for mutually exclusive parameters; 0 = none
    bool passesName = false; ///< a Ptr parameter with the name of the argument follows
};
enum class RoutineKind : uint8_t { Procedure, Function, Interrupt };
/// A routine that can be asked for by name at run time.
struct NamedRoutine {
    uint32_t routine = kNone;
    RoutineKind kind = RoutineKind::Procedure;
    bool isLocal = false;
    bool late = false; ///< callable with its arguments in a table (rt::LateEntry)
    uint32_t task = kNone;
    std::vector<ParamEntry> params;
};

/// Data of a routine, for searches by name; it has no address.
struct RoutineData {
    std::string name;
    std::string moduleName;
    std::string routine;
    uint32_t typeDesc = kNone;
    uint32_t task = kNone;
    GlobalKind kind = GlobalKind::Var;
};
/// A source module of a task.
struct ModuleEntry {
    std::string name;
    uint32_t file = kNone;
    uint32_t task = kNone;
    uint32_t gone = kNone; ///< global I32 that becomes 1 when the module leaves memory; kNone: not needed
};

enum class DescKind : uint8_t { Float, Double, Bool, String, Record, Array, Handle, Other, Bytes };
/// Run-time description of a source-language type.
struct TypeDesc {
    std::string name;     ///< as declared, an alias keeps its name
    std::string baseName; ///< with aliases resolved
    DescKind kind = DescKind::Other;
    TypeId type = kVoid;
    std::vector<std::string> fieldNames;
    std::vector<uint32_t> fieldDescs; ///< record: per field; array: one entry, the element
};

/// A signal or another configured object that the program names; resolved when the program is loaded.
struct ExternalRef {
    std::string name;
    std::string kind;        ///< as the source language says
    uint32_t global = kNone; ///< I64 slot that receives the handle
    uint32_t file = kNone, line = 0, column = 0;
};

/// A further declaration of an object that tasks share.
struct GlobalAlias {
    uint32_t global = kNone;
    std::string displayName;
    std::string moduleName;
    uint32_t task = kNone; ///< that declares it
    uint32_t file = kNone, line = 0;
};

struct TaskEntry {
    std::string name;
    std::string kind;       ///< in the words of the source language, which its runtime reads
    uint32_t entry = kNone; ///< routine
    uint32_t reset = kNone; ///< routine that gives every variable its initial value
    bool motionTask = false;
};

struct Module {
    std::string name;
    std::vector<Type> types; ///< the first ones are the scalar types
    std::vector<Global> globals;
    std::vector<Native> natives;
    std::vector<Routine> routines;
    std::vector<TypeDesc> typeDescs;
    std::vector<ExternalRef> externals;
    std::vector<GlobalAlias> aliases;
    std::vector<TaskEntry> tasks;
    std::vector<std::string> files; ///< source paths
    std::string folder;             ///< relative source paths begin here; may be empty
    std::string sources;            ///< what the host compiles further modules by (any bytes); may be empty
    std::vector<ModuleEntry> modules;
    std::vector<uint32_t> searchTypes; ///< type descriptions that data can be searched by
    std::vector<RoutineData> routineData;
    std::vector<NamedRoutine> namedRoutines;
    /// A unit that is loaded while a program runs has no tasks: number of the program's task it belongs to (-1: it is
    /// no unit), and the routine that gives its variables their initial values.
    int32_t unitTask = -1;
    uint32_t unitReset = kNone;
    /// Error number that arithmetic raises when its result is out of range; 0: infinities and NaN are values like others.
    int32_t overflowError = 0;
    std::vector<std::string> configTexts; ///< configuration known at compile time, kept for the run
    std::vector<std::string> configNames;

    Module();
    /// Of all routines: what compiling takes.
    size_t instructionCount() const;
    /// By routine: whether the runtime or another unit calls it, so that not all its calls are in the module.
    std::vector<bool> calledFromOutside() const;
    const Type& type(TypeId id) const { return types[id]; }
    TypeId arrayOf(TypeId element, std::vector<int32_t> dims); ///< interned
    TypeId stringOf(uint32_t capacity);                        ///< interned
    TypeId addRecord(std::string name, std::vector<Field> fields);
    uint32_t size(TypeId id) const; ///< bytes, C layout
    uint32_t align(TypeId id) const;
    uint32_t fieldOffset(TypeId record, uint32_t field) const;
    bool isScalar(TypeId id) const { return id < kScalarTypes; }
    uint32_t findRoutine(std::string_view name) const; ///< kNone if absent
};

/// As the textual form names it: "f32", "%12".
std::string typeName(TypeId type);

/// Type of the value the instruction yields; kVoid when it yields none. Differs from Inst::type where that
/// names the type accessed (FieldAddr, ElemAddr, Store ...).
TypeId valueType(const Inst& inst);

/// The values that the controller keeps for a task: the number of its latest error, and of the interrupt in progress. I32.
enum class SysvarKind : int32_t { Error = 0, Interrupt = 1 };

// ---- Builder ---------------------------------------------------------------------------------------------

/// Appends instructions to a routine; keeps the current block and statement.
class Builder {
  public:
    Builder(Module& module, Routine& routine) : module_(module), routine_(routine) {}

    Module& module() { return module_; }
    Routine& routine() { return routine_; }
    BlockId addBlock(std::string_view name);
    void setBlock(BlockId block) { block_ = block; }
    BlockId block() const { return block_; }
    /// True when the current block already ends in a terminator.
    bool terminated() const; ///< (emitting after a terminator starts a new, unreachable block)
    StmtId addStatement(const Statement& statement);
    void setStatement(StmtId stmt); ///< emits the Stmt marker too
    StmtId statement() const { return stmt_; }
    uint32_t addLocal(std::string name, TypeId type, bool isParam = false);

    ValueId constF32(double value);
    ValueId constF64(double value);
    ValueId constInt(TypeId type, int64_t value);
    ValueId constI32(int32_t value) { return constInt(kI32, value); }
    ValueId constI64(int64_t value) { return constInt(kI64, value); }
    ValueId constBool(bool value);
    ValueId nullPtr();
    ValueId param(uint32_t index);
    ValueId localAddr(uint32_t local);
    ValueId globalAddr(uint32_t global);
    ValueId typeDescAddr(uint32_t desc);
    ValueId routineAddr(uint32_t routine);
    ValueId sysvar(SysvarKind kind);
    ValueId load(TypeId type, ValueId ptr);
    void store(TypeId type, ValueId value, ValueId ptr);
    void copy(TypeId type, ValueId dst, ValueId src);
    void copyDynamic(ValueId dst, ValueId src, ValueId bytes);
    ValueId stackAlloc(ValueId bytes); ///< I64; memory until the routine returns, zero bytes are allowed
    void zero(TypeId type, ValueId dst);
    ValueId fieldAddr(TypeId record, ValueId ptr, uint32_t field);
    ValueId elemAddr(TypeId element, ValueId ptr, ValueId zeroBasedIndex);
    ValueId binary(Op op, ValueId a, ValueId b);        ///< result type from the operands (comparisons: Bool)
    ValueId binaryInRange(Op op, ValueId a, ValueId b); ///< IAdd, IMul whose result cannot overflow
    ValueId unary(Op op, ValueId a);                    ///< FNeg, INeg, Not
    ValueId convert(Op op, TypeId to, ValueId a);
    ValueId select(ValueId cond, ValueId a, ValueId b);
    void check(ValueId cond, int32_t errorNumber); ///< raises errorNumber when cond is false
    /// Calls a routine. Scalar result: the value of this instruction. Str/Record/Array result: args[0] is the
    /// address that receives it (then the instruction has type Void).
    ValueId call(uint32_t routine, std::vector<ValueId> args);
    /// The same for natives; the emitter adds the task argument and, for scalar results of class Plain, the
    /// result slot.
    ValueId callNative(uint32_t native, std::vector<ValueId> args);
    void br(BlockId target);
    void condBr(ValueId cond, BlockId ifTrue, BlockId ifFalse);
    void switchOn(ValueId value, std::vector<SwitchCase> cases, BlockId otherwise);
    void ret();
    void ret(ValueId value); ///< scalar result; aggregates are stored through resultAddr() first, then ret()
    ValueId resultAddr();    ///< hidden pointer of an aggregate result
    void raise(ValueId errorNumber);
    void propagate(); ///< in a handler: raise the current error again at the point of the call
    void retry();
    void tryNext();
    void handlerEnd(); ///< end of an error handler reached: system handler
    void unreachable();
    /// Takes `cost` instructions (plus `more`, an I64) from the budget of the task.
    void charge(uint32_t cost, ValueId more = kNone);
    void safepoint(int32_t cost);
    void step(StmtId stmt);
    ValueId emit(Inst inst);

  private:
    TypeId typeOf(ValueId value) const { return valueType(routine_.insts[value]); }
    Module& module_;
    /// A value that several instructions of a block use; valid while `span` is the one in progress.
    struct SharedValue {
        uint32_t span = 0;
        ValueId value = kNone;
    };
    /// Null, false and addresses of data, which calls with many optional arguments need again and again: one instruction each
    /// in a block.
    ValueId shared(SharedValue& known, Inst inst);
    void beginShared();

    Routine& routine_;
    BlockId block_ = 0;
    StmtId stmt_ = kNone;
    BlockId sharedIn_ = kNone; ///< the block that the shared values of this span are in
    uint32_t span_ =
        0; ///< counted, since emptying tables at each block would take time for all they have held
    SharedValue null_, false_;
    std::unordered_map<uint32_t, SharedValue> globalAddresses_;
    std::vector<SharedValue> localAddresses_; ///< by number of the local
};

} // namespace ir
