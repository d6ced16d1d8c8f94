#pragma once
// Routines that are executed by an interpreter instead of machine code: how compiled programs carry them. Code generation
// writes these words, runtime/interpreter executes them. A routine of this kind has a function like any other; it makes
// room for the values and locals and calls rt_interpret.
//
// A value lies in a slot of 8 bytes: a Bool as 0 or 1 and an integer sign-extended to 64 bits, so that most operations need not
// know its width; a float in the first 4 bytes. An instruction is a word with operation, type and count (wordOf), then its
// operands, a word each: slots, places in the code, numbers.

#include "runtime/abi/rt_abi.h"

namespace rt {

/// Types of scalars in code words.
enum class WordType : uint8_t { None, Bool, I8, I16, I32, I64, F32, F64, Ptr };

/// In the comments: d = slot of the result, a, b, c = slots of operands.
enum class WordOp : uint8_t {
    // values
    Number,     ///< d, low 32 bits (sign-extended)
    LongNumber, ///< d, low, high
    Move,       ///< d, a
    Place,      ///< d, offset in the memory of the activation
    Pointer,    ///< d, index into InterpretedCode::pointers
    Result,     ///< d
    ErrorNumber,
    InterruptNumber,
    // memory; type = what is accessed
    Load,        ///< d, a
    Store,       ///< a, address
    Copy,        ///< to, from, bytes
    CopyDynamic, ///< to, from, slot with the bytes
    StackAlloc,  ///< d, slot with the bytes
    Zero,        ///< a, bytes
    Field,       ///< d, a, bytes to add
    Element,     ///< d, a, slot with the index, bytes of an element
    // arithmetic: d, a, b; type = that of the operands
    FAdd,
    FSub,
    FMul,
    FDiv,
    FNeg,   ///< d, a
    FTrunc, ///< d, a
    FQuot,  ///< of whole numbers (whole_division.h)
    FRem,
    IAdd,
    ISub,
    IMul,
    IDiv,
    IRem,
    UDiv,
    URem,
    INeg, ///< d, a
    Shl,
    Shr,
    Sar,
    // comparison: d, a, b
    FEq,
    FNe,
    FLt,
    FLe,
    FGt,
    FGe,
    IEq,
    INe,
    ILt,
    ILe,
    IULt,
    IULe,
    IsFinite, ///< d, a
    And,
    Or,
    Xor,
    Not,    ///< d, a
    Select, ///< d, condition, a, b
    // conversion: d, a; type = from, count = to (WordType)
    ZExt,
    Trunc,
    SIntToFloat,
    UIntToFloat,
    FloatToSInt,
    FloatToUInt,
    FloatToIndex,
    FWiden,
    FNarrow,
    // actions
    Statement,   ///< number; count = StatementMark. Of the instructions that follow
    Check,       ///< a, error number
    CheckFinite, ///< a, error number
    Call, ///< pointer of an InterpretedCall, d (kNoSlot: none), `count` slots of arguments; type = result
    CallNative, ///< the same
    Charge,     ///< cost
    ChargeMore, ///< cost, slot with more
    Safepoint,
    SafepointMore,
    Step,          ///< number of the statement
    ForgetRetries, ///< a statement begins that RETRY has not brought here
    // ends of blocks
    Jump,        ///< place
    Branch,      ///< a, place, otherwise
    Choose,      ///< a, otherwise, number of cases, then value and place of each, in ascending order
    Return,      ///<
    ReturnValue, ///< a
    ReturnUndo,  ///< the end of an undo handler
    Raise,       ///< a
    Propagate,
    HandlerEnd,
    Retry,
    TryNext,
    Unreachable
};

/// How the Statement word describes its errors.
enum StatementMark : uint8_t { kMarkHandled = 1, kMarkInUndo = 2, kMarkStarts = 4 };

/// First word of an instruction.
constexpr uint32_t wordOf(WordOp op, WordType type = WordType::None, uint32_t count = 0) {
    return static_cast<uint32_t>(op) | static_cast<uint32_t>(type) << 8 | count << 16;
}
inline constexpr uint32_t kMostWordCount = 0xFFFF;
inline constexpr uint32_t kNoSlot = 0xFFFFFFFF, kNoPlace = 0xFFFFFFFF;

/// A local that the frame record names (SteppingFrame::addresses).
struct AddressedLocal {
    uint32_t offset;
    uint32_t zeroed; ///< bytes that are 0 at first
};

struct InterpretedCode {
    const uint32_t* words;
    const void* const* pointers;
    const RoutineDesc* routine;
    const uint32_t* starts; ///< by statement: where it begins; kNoPlace
    const uint32_t* nexts;  ///< the same of what follows it
    const AddressedLocal* addressed;
    uint32_t addressedCount;
    uint32_t addressTable; ///< offset of SteppingFrame::addresses
    uint32_t arguments;    ///< offset of the slots where arguments of calls are collected
    uint32_t errorHandler; ///< place, or kNoPlace
    uint32_t undoHandler;
    uint32_t setsTaskFrame; ///< TaskCore::frame is this routine's record while it runs
};

/// Calls a routine or a native with arguments from slots; a scalar result goes to `result`.
using InterpretedCall = Status (*)(TaskCore* task, Frame* frame, const void* arguments, void* result);

} // namespace rt

extern "C" {
/// Executes a routine. `memory`: its slots (the parameters are in the first ones), then locals; `result` receives a result
/// of any type, or null. `frame` has its caller and routine.
rt::Status rt_interpret(rt::TaskCore* task, rt::SteppingFrame* frame, const rt::InterpretedCode* code,
                        void* memory, void* result);
}
