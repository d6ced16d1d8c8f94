// Executes the words of runtime/abi/interpreted.h. The ways of errors are the same as in machine code: see
// codegen/emit_errors.cpp, whose functions have the same names.

#include <algorithm>

#include "runtime/abi/whole_division.h"
#include "runtime/interpreter/conversions.h"
#include "runtime/interpreter/words.h"

namespace rt {
namespace {

using namespace words;

class Activation {
  public:
    Activation(TaskCore* task, SteppingFrame* frame, const InterpretedCode& code, void* memory, void* result)
        : task_(task), frame_(frame), caller_(frame->caller), code_(code),
          memory_(static_cast<char*>(memory)), slots_(static_cast<Slot*>(memory)),
          arguments_(reinterpret_cast<Slot*>(memory_ + code.arguments)), result_(result) {}

    Status run();

  private:
    /// The rest of the frame record: handlers and natives look at it.
    void begin() {
        frame_->reserved = 0;
        frame_->failed = 0;
        frame_->statement = 0;
        auto* const table = reinterpret_cast<void**>(memory_ + code_.addressTable);
        for (uint32_t i = 0; i < code_.addressedCount; ++i) {
            table[i] = memory_ + code_.addressed[i].offset;
            std::memset(table[i], 0, code_.addressed[i].zeroed);
        }
        frame_->addresses = table;
        if (code_.setsTaskFrame != 0) task_->frame = frame_;
    }

    Slot& slot(uint32_t word) { return slots_[word]; }
    const uint32_t* place(uint32_t word) const { return code_.words + word; }
    bool isInUndo() const { return (marks_ & kMarkInUndo) != 0; }

    // ---- errors ----

    const uint32_t* end(Status status) {
        status_ = status;
        return nullptr;
    }

    const uint32_t* returnFromUndo(Status status) { return end(status < kOk ? status : unwinding_); }

    const uint32_t* enterHandler() {
        if (code_.setsTaskFrame != 0) task_->frame = frame_;
        frame_->failed = frame_->statement;
        return place(code_.errorHandler);
    }

    bool lists(Status number) const {
        const RoutineDesc& routine = *code_.routine;
        const int32_t* const first = routine.errorFilter;
        const int32_t* const last = first + routine.errorFilterCount;
        return std::any_of(first, last, [&](int32_t listed) {
            return listed == number || listed == kAllErrors || listed == kOtherErrors;
        });
    }

    /// An error on its way meets this routine's handler.
    const uint32_t* dispatch(Status number) {
        if (number <= kOk) return leave(number);
        const RoutineDesc& routine = *code_.routine;
        const bool takes = routine.errorVariableCount > 0 ? rt_takesError(task_, frame_, number) != 0
                           : routine.errorFilterCount > 0 ? lists(number)
                                                          : true;
        return takes ? enterHandler() : leave(number);
    }

    const uint32_t* leave(Status status) {
        if (code_.errorHandler != kNoPlace && status <= kJump) {
            status = rt_land(task_, frame_, status);
            if (status > kOk) return enterHandler();
        }
        if (code_.undoHandler == kNoPlace) return end(status);
        if (status != kUnwind && status != kJump) return end(status == kJumpPast ? kJump : status);
        unwinding_ = status;
        frame_->reserved = kFrameInUndo;
        if (code_.setsTaskFrame != 0) task_->frame = frame_;
        return place(code_.undoHandler);
    }

    const uint32_t* leaveOrUndo(Status status) { return isInUndo() ? returnFromUndo(status) : leave(status); }

    /// Continues with the statement whose number the controller gave; a negative number is a status.
    const uint32_t* stepTo(int32_t statement) {
        if (statement >= 0 && static_cast<uint32_t>(statement) < code_.routine->statementCount &&
            code_.starts[statement] != kNoPlace)
            return place(code_.starts[statement]);
        return leave(statement);
    }

    const uint32_t* leaveOrAgain(Status status) {
        const bool mayStep = code_.routine->stepping != 0 && !isInUndo();
        return mayStep && status == kAgain ? stepTo(frame_->statement) : leaveOrUndo(status);
    }

    const uint32_t* raise(Status number) {
        const Status status = rt_raise(task_, frame_, number);
        if (isInUndo()) return returnFromUndo(status);
        const bool handled = (marks_ & kMarkHandled) != 0;
        if (!handled || (code_.routine->stepping != 0 && status <= kOk)) return leaveOrAgain(status);
        return dispatch(status);
    }

    /// The errors of a routine have been raised already.
    const uint32_t* failed(Status status) {
        return (marks_ & kMarkHandled) != 0 && !isInUndo() ? dispatch(status) : leaveOrUndo(status);
    }

    /// `again`: the call, which is executed once more when the task is started again after the system handler; in the stepping
    /// profile the whole statement, because the data of its arguments may have been corrected.
    const uint32_t* nativeFailed(const uint32_t* again, Status status) {
        Frame* const before = task_->frame;
        const Status outcome = rt_nativeFailed(task_, frame_, status);
        if (code_.setsTaskFrame == 0) task_->frame = before;
        if (outcome != kAgain) return failed(outcome);
        const bool wholeStatement =
            code_.routine->stepping != 0 && !isInUndo() && (marks_ & kMarkStarts) != 0;
        return wholeStatement ? stepTo(frame_->statement) : again;
    }

    const uint32_t* retry() {
        const Status status = rt_retry(task_, frame_);
        return status == kOk ? place(code_.starts[frame_->failed]) : leaveOrUndo(status);
    }

    // ---- calls, time ----

    const uint32_t* call(const uint32_t* at, bool isNative) {
        const uint32_t count = countOf(at[0]);
        const auto function = reinterpret_cast<InterpretedCall>(const_cast<void*>(code_.pointers[at[1]]));
        const uint32_t to = at[2];
        for (uint32_t i = 0; i < count; ++i)
            arguments_[i] = slot(at[3 + i]);
        Slot made;
        made.bits = 0;
        const Status status = function(task_, frame_, arguments_, &made);
        if (status != kOk) return isNative ? nativeFailed(at, status) : failed(status);
        if (to != kNoSlot) slot(to) = load(typeOf(at[0]), &made);
        return at + 3 + count;
    }

    void charge(int64_t cost) {
        if (task_->budget < 0)
            rt_chargeLater(task_, cost);
        else
            task_->budget -= cost;
    }

    const uint32_t* safepoint(int64_t cost, const uint32_t* next) {
        task_->budget -= cost;
        if (task_->budget >= 0) return next;
        Frame* const before = task_->frame;
        const Status outcome = rt_safepoint(task_, frame_);
        task_->frame = before;
        return outcome == kOk ? next : leaveOrUndo(outcome);
    }

    const uint32_t* step(const uint32_t* at) {
        if (task_->budget >= 0 && task_->askSteps == 0) return at + 2;
        const auto here = static_cast<int32_t>(at[1]);
        const int32_t wanted = rt_step(task_, frame_);
        return wanted == here ? at + 2 : stepTo(wanted);
    }

    const uint32_t* choose(const uint32_t* at) const {
        const auto wanted = static_cast<int32_t>(slots_[at[1]].integer);
        const uint32_t* const cases = at + 4;
        uint32_t low = 0, high = at[3];
        while (low < high) {
            const uint32_t middle = (low + high) / 2;
            if (static_cast<int32_t>(cases[2 * middle]) < wanted)
                low = middle + 1;
            else
                high = middle;
        }
        const bool found = low < at[3] && static_cast<int32_t>(cases[2 * low]) == wanted;
        return place(found ? cases[2 * low + 1] : at[2]);
    }

    template <class Operation> const uint32_t* floats(const uint32_t* at, Operation operation) {
        const Slot a = slot(at[2]), b = slot(at[3]);
        Slot made;
        made.bits = 0;
        if (typeOf(at[0]) == WordType::F32)
            made.single = operation(a.single, b.single);
        else
            made.twofold = operation(a.twofold, b.twofold);
        slot(at[1]) = made;
        return at + 4;
    }
    template <class Operation> const uint32_t* oneFloat(const uint32_t* at, Operation operation) {
        Slot made;
        made.bits = 0;
        if (typeOf(at[0]) == WordType::F32)
            made.single = operation(slot(at[2]).single);
        else
            made.twofold = operation(slot(at[2]).twofold);
        slot(at[1]) = made;
        return at + 3;
    }
    template <class Operation> const uint32_t* integers(const uint32_t* at, Operation operation) {
        slot(at[1]).integer = canonical(
            typeOf(at[0]), static_cast<uint64_t>(operation(slot(at[2]).integer, slot(at[3]).integer)));
        return at + 4;
    }
    /// Operands without sign.
    template <class Operation> const uint32_t* naturals(const uint32_t* at, Operation operation) {
        const WordType type = typeOf(at[0]);
        slot(at[1]).integer = canonical(
            type, operation(withoutSign(type, slot(at[2]).integer), withoutSign(type, slot(at[3]).integer)));
        return at + 4;
    }
    template <class Operation> const uint32_t* compareFloats(const uint32_t* at, Operation operation) {
        const Slot a = slot(at[2]), b = slot(at[3]);
        slot(at[1]) = truth(typeOf(at[0]) == WordType::F32 ? operation(a.single, b.single)
                                                           : operation(a.twofold, b.twofold));
        return at + 4;
    }
    template <class Operation> const uint32_t* compare(const uint32_t* at, Operation operation) {
        slot(at[1]) = truth(operation(slot(at[2]).integer, slot(at[3]).integer));
        return at + 4;
    }
    template <class Operation> const uint32_t* convert(const uint32_t* at, Operation operation) {
        slot(at[1]) = operation(slot(at[2]), typeOf(at[0]), static_cast<WordType>(countOf(at[0])));
        return at + 3;
    }

    TaskCore* task_;
    SteppingFrame* frame_;
    Frame* caller_;
    const InterpretedCode& code_;
    char* memory_;
    Slot* slots_;
    Slot* arguments_;
    void* result_;
    Status status_ = kOk, unwinding_ = kOk;
    uint8_t marks_ = 0; ///< StatementMark, of the statement that was noted last
};

// Size: one function, because `alloca` gives memory until it returns; so run() calls nothing else.
Status Activation::run() {
    begin();
    const uint32_t* at = code_.words;
    while (at != nullptr) {
        const uint32_t word = at[0];
        switch (opOf(word)) {
        case WordOp::Number:
            slot(at[1]).integer = static_cast<int32_t>(at[2]);
            at += 3;
            break;
        case WordOp::LongNumber:
            slot(at[1]).bits = at[2] | static_cast<uint64_t>(at[3]) << 32;
            at += 4;
            break;
        case WordOp::Move:
            slot(at[1]) = slot(at[2]);
            at += 3;
            break;
        case WordOp::Place:
            slot(at[1]).pointer = memory_ + at[2];
            at += 3;
            break;
        case WordOp::Pointer:
            slot(at[1]).pointer = const_cast<void*>(code_.pointers[at[2]]);
            at += 3;
            break;
        case WordOp::Result:
            slot(at[1]).pointer = result_;
            at += 2;
            break;
        case WordOp::ErrorNumber:
            slot(at[1]).integer = task_->errorNumber;
            at += 2;
            break;
        case WordOp::InterruptNumber:
            slot(at[1]).integer = task_->interruptNumber;
            at += 2;
            break;
        case WordOp::Load:
            slot(at[1]) = load(typeOf(word), slot(at[2]).pointer);
            at += 3;
            break;
        case WordOp::Store:
            store(typeOf(word), slot(at[1]), slot(at[2]).pointer);
            at += 3;
            break;
        case WordOp::Copy:
            std::memmove(slot(at[1]).pointer, slot(at[2]).pointer, at[3]);
            at += 4;
            break;
        case WordOp::CopyDynamic:
            std::memmove(slot(at[1]).pointer, slot(at[2]).pointer, slot(at[3]).bits);
            at += 4;
            break;
        case WordOp::StackAlloc: {
            const uint64_t bytes = slot(at[2]).bits;
            auto* const top = static_cast<char*>(__builtin_alloca(sizeof(Slot)));
            const uint64_t room =
                top > task_->stackLimit ? static_cast<uint64_t>(top - task_->stackLimit) : 0;
            if (bytes > room) {
                at = leaveOrUndo(rt_stackOverflow(task_, frame_));
                break;
            }
            slot(at[1]).pointer = __builtin_alloca(bytes);
            at += 3;
            break;
        }
        case WordOp::Zero:
            std::memset(slot(at[1]).pointer, 0, at[2]);
            at += 3;
            break;
        case WordOp::Field:
            slot(at[1]).pointer = static_cast<char*>(slot(at[2]).pointer) + at[3];
            at += 4;
            break;
        case WordOp::Element:
            slot(at[1]).pointer =
                static_cast<char*>(slot(at[2]).pointer) + slot(at[3]).integer * static_cast<int64_t>(at[4]);
            at += 5;
            break;
        case WordOp::FAdd: at = floats(at, [](auto a, auto b) { return a + b; }); break;
        case WordOp::FSub: at = floats(at, [](auto a, auto b) { return a - b; }); break;
        case WordOp::FMul: at = floats(at, [](auto a, auto b) { return a * b; }); break;
        case WordOp::FDiv: at = floats(at, [](auto a, auto b) { return a / b; }); break;
        case WordOp::FNeg: at = oneFloat(at, [](auto a) { return -a; }); break;
        case WordOp::FTrunc: at = oneFloat(at, [](auto a) { return std::trunc(a); }); break;
        case WordOp::FQuot: at = floats(at, [](auto a, auto b) { return wholeQuotient(a, b); }); break;
        case WordOp::FRem: at = floats(at, [](auto a, auto b) { return wholeRemainder(a, b); }); break;
        case WordOp::IAdd: at = naturals(at, [](uint64_t a, uint64_t b) { return a + b; }); break;
        case WordOp::ISub: at = naturals(at, [](uint64_t a, uint64_t b) { return a - b; }); break;
        case WordOp::IMul: at = naturals(at, [](uint64_t a, uint64_t b) { return a * b; }); break;
        case WordOp::IDiv:
            at = integers(at, [&](int64_t a, int64_t b) { return divide(typeOf(word), a, b); });
            break;
        case WordOp::IRem: at = integers(at, [](int64_t a, int64_t b) { return remainder(a, b); }); break;
        case WordOp::UDiv: at = naturals(at, [](uint64_t a, uint64_t b) { return a / b; }); break;
        case WordOp::URem: at = naturals(at, [](uint64_t a, uint64_t b) { return a % b; }); break;
        case WordOp::INeg:
            slot(at[1]).integer = canonical(typeOf(word), 0 - slot(at[2]).bits);
            at += 3;
            break;
        case WordOp::Shl:
            at = naturals(at, [&](uint64_t a, uint64_t b) { return a << (b & (bitsOf(typeOf(word)) - 1)); });
            break;
        case WordOp::Shr:
            at = naturals(at, [&](uint64_t a, uint64_t b) { return a >> (b & (bitsOf(typeOf(word)) - 1)); });
            break;
        case WordOp::Sar:
            at = integers(at, [&](int64_t a, int64_t b) {
                return a >> (static_cast<uint64_t>(b) & (bitsOf(typeOf(word)) - 1));
            });
            break;
        case WordOp::FEq: at = compareFloats(at, [](auto a, auto b) { return a == b; }); break;
        case WordOp::FNe: at = compareFloats(at, [](auto a, auto b) { return a != b; }); break;
        case WordOp::FLt: at = compareFloats(at, [](auto a, auto b) { return a < b; }); break;
        case WordOp::FLe: at = compareFloats(at, [](auto a, auto b) { return a <= b; }); break;
        case WordOp::FGt: at = compareFloats(at, [](auto a, auto b) { return a > b; }); break;
        case WordOp::FGe: at = compareFloats(at, [](auto a, auto b) { return a >= b; }); break;
        case WordOp::IEq: at = compare(at, [](int64_t a, int64_t b) { return a == b; }); break;
        case WordOp::INe: at = compare(at, [](int64_t a, int64_t b) { return a != b; }); break;
        case WordOp::ILt: at = compare(at, [](int64_t a, int64_t b) { return a < b; }); break;
        case WordOp::ILe: at = compare(at, [](int64_t a, int64_t b) { return a <= b; }); break;
        case WordOp::IULt:
            at = compare(
                at, [](int64_t a, int64_t b) { return static_cast<uint64_t>(a) < static_cast<uint64_t>(b); });
            break;
        case WordOp::IULe:
            at = compare(at, [](int64_t a, int64_t b) {
                return static_cast<uint64_t>(a) <= static_cast<uint64_t>(b);
            });
            break;
        case WordOp::IsFinite:
            slot(at[1]) = truth(std::isfinite(numberIn(typeOf(word), slot(at[2]))));
            at += 3;
            break;
        case WordOp::And:
            slot(at[1]).bits = slot(at[2]).bits & slot(at[3]).bits;
            at += 4;
            break;
        case WordOp::Or:
            slot(at[1]).bits = slot(at[2]).bits | slot(at[3]).bits;
            at += 4;
            break;
        case WordOp::Xor:
            slot(at[1]).bits = slot(at[2]).bits ^ slot(at[3]).bits;
            at += 4;
            break;
        case WordOp::Not:
            slot(at[1]).bits = typeOf(word) == WordType::Bool ? slot(at[2]).bits ^ 1 : ~slot(at[2]).bits;
            at += 3;
            break;
        case WordOp::Select:
            slot(at[1]) = slot(at[2]).bits != 0 ? slot(at[3]) : slot(at[4]);
            at += 5;
            break;
        case WordOp::ZExt: at = convert(at, zeroExtended); break;
        case WordOp::Trunc: at = convert(at, truncated); break;
        case WordOp::SIntToFloat: at = convert(at, signedToReal); break;
        case WordOp::UIntToFloat: at = convert(at, unsignedToReal); break;
        case WordOp::FloatToSInt:
        case WordOp::FloatToIndex: at = convert(at, realToSigned); break; // out of range: any value
        case WordOp::FloatToUInt: at = convert(at, realToUnsigned); break;
        case WordOp::FWiden:
        case WordOp::FNarrow: at = convert(at, realToReal); break;
        case WordOp::Statement:
            frame_->statement = static_cast<int32_t>(at[1]);
            marks_ = static_cast<uint8_t>(countOf(word));
            at += 2;
            break;
        case WordOp::Check: at = slot(at[1]).bits != 0 ? at + 3 : raise(static_cast<int32_t>(at[2])); break;
        case WordOp::CheckFinite:
            at = std::isfinite(numberIn(typeOf(word), slot(at[1]))) ? at + 3
                                                                    : raise(static_cast<int32_t>(at[2]));
            break;
        case WordOp::Call: at = call(at, false); break;
        case WordOp::CallNative: at = call(at, true); break;
        case WordOp::Charge:
            charge(static_cast<int32_t>(at[1]));
            at += 2;
            break;
        case WordOp::ChargeMore:
            charge(static_cast<int32_t>(at[1]) + slot(at[2]).integer);
            at += 3;
            break;
        case WordOp::Safepoint: at = safepoint(static_cast<int32_t>(at[1]), at + 2); break;
        case WordOp::SafepointMore:
            at = safepoint(static_cast<int32_t>(at[1]) + slot(at[2]).integer, at + 3);
            break;
        case WordOp::Step: at = step(at); break;
        case WordOp::ForgetRetries:
            frame_->reserved = 0;
            ++at;
            break;
        case WordOp::Jump: at = place(at[1]); break;
        case WordOp::Branch: at = place(slot(at[1]).bits != 0 ? at[2] : at[3]); break;
        case WordOp::Choose: at = choose(at); break;
        case WordOp::Return: at = end(kOk); break;
        case WordOp::ReturnValue:
            store(typeOf(word), slot(at[1]), result_);
            at = end(kOk);
            break;
        case WordOp::ReturnUndo: at = end(unwinding_); break;
        case WordOp::Raise: at = raise(static_cast<int32_t>(slot(at[1]).integer)); break;
        case WordOp::Propagate: at = leaveOrAgain(rt_propagate(task_, frame_)); break;
        case WordOp::HandlerEnd: at = leaveOrAgain(rt_handlerEnd(task_, frame_)); break;
        case WordOp::Retry: at = retry(); break;
        case WordOp::TryNext: at = place(code_.nexts[frame_->failed]); break;
        case WordOp::Unreachable: __builtin_trap();
        }
    }
    if (code_.setsTaskFrame != 0) task_->frame = caller_;
    return status_;
}

} // namespace
} // namespace rt

rt::Status rt_interpret(rt::TaskCore* task, rt::SteppingFrame* frame, const rt::InterpretedCode* code,
                        void* memory, void* result) {
    return rt::Activation(task, frame, *code, memory, result).run();
}
