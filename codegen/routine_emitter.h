#pragma once
// One routine: IR instructions -> LLVM instructions. Split over files by family of instructions.

#include <llvm/IR/IRBuilder.h>

#include <optional>
#include <unordered_map>
#include <vector>

#include "codegen/module_emitter.h"
#include "ir/core/cfg.h"

namespace ir {
struct CountedLoop;
}

namespace codegen {

class JoinedRounds;
class WideLoop;

// Size: one method for each kind of instruction; they share the values, blocks and the frame record of one routine.
class RoutineEmitter {
  public:
    RoutineEmitter(ModuleEmitter& module, uint32_t index);
    ~RoutineEmitter();
    void run();

    /// Within a record.
    struct Scalar {
        ir::TypeId type;
        uint32_t offset;
    };

  private:
    using Value = llvm::Value;
    using BasicBlock = llvm::BasicBlock;

    // routine_emitter.cpp: frame, blocks, control flow
    void analyse();
    bool needsFrame(const ir::Inst& inst) const;
    void findFrameBlock();
    void allocate();
    void countCall();
    void prologue();
    void enterFrame();
    void fillFrame();
    void setTaskFrame(Value* frame);
    void storeTaskFrame(Value* frame);
    void fillAddresses();
    void markFrame(int32_t content);
    template <auto member> void storeFrame(Value* content) {
        abi::storeField<member>(b_, frame_, content)
            ->setMetadata(llvm::LLVMContext::MD_tbaa, m_.tags().frame);
    }
    void returnFromUndo(llvm::Value* status);
    void block(ir::BlockId id);
    void instruction(ir::ValueId id);
    void locate(const ir::Inst& inst);
    bool isNativeThenSafepoint(ir::ValueId id, ir::ValueId next) const;
    void define(ir::ValueId id, Value* value);
    Value* value(ir::ValueId id);
    Value* operand(const ir::Inst& inst, size_t i) { return value(inst.operands[i]); }
    void action(const ir::Inst& inst, ir::ValueId id);
    void terminator(const ir::Inst& inst);
    void ret(const ir::Inst& inst);
    void switchOn(const ir::Inst& inst);
    BasicBlock* newBlock(const char* name);
    BasicBlock* blockOf(ir::BlockId id) { return blocks_[id]; }

    // emit_arith.cpp
    Value* floatArithmetic(const ir::Inst& inst);
    Value* intArithmetic(const ir::Inst& inst);
    Value* divide(const ir::Inst& inst);
    Value* shiftCount(const ir::Inst& inst);
    Value* comparison(const ir::Inst& inst);
    Value* logic(const ir::Inst& inst);
    Value* conversion(const ir::Inst& inst);
    Value* constant(const ir::Inst& inst);
    Value* isFinite(Value* number);

    // joined_rounds.cpp
    void findFastLoops();
    bool entersFastLoop();
    Value* hasRounds(const ir::CountedLoop& counted, unsigned rounds);
    void joinedRounds(const JoinedRounds& joined);
    void oneOfRounds(const JoinedRounds& joined, bool isLast, BasicBlock* back, Value* (&sums)[2]);

    // wide_loop.cpp
    using WideValues = std::unordered_map<ir::ValueId, Value*>; ///< of the rounds in one vector
    using WideParts = std::vector<WideValues>;                  ///< of all rounds that are done at once
    void wideLoop(const WideLoop& wide);
    Value* misplacedElements(const WideLoop& wide);
    void wideRounds(const WideLoop& wide, BasicBlock* head, uint32_t alignment);
    void widePart(const WideLoop& wide, unsigned k, uint32_t alignment, WideParts& parts);
    Value* wideOperand(const WideLoop& wide, const ir::Inst& inst, size_t i, const WideValues& values);
    Value* wideValue(const WideLoop& wide, ir::ValueId id, Value* first, const WideValues& values);
    void addRegisters(Value* vector, std::vector<Value*>& out);
    Value* allFinite(const WideLoop& wide, const WideParts& parts);

    // emit_memory.cpp
    Value* leaf(const ir::Inst& inst);
    void memory(const ir::Inst& inst, ir::ValueId id);
    Value* fieldOf(const ir::Inst& inst);
    /// `tag`: null for that of the type.
    Value* load(ir::TypeId type, Value* pointer, llvm::MDNode* tag = nullptr);
    void store(ir::TypeId type, Value* value, Value* pointer, llvm::MDNode* tag = nullptr);
    llvm::MDNode* tagOf(ir::TypeId type, ir::ValueId address);
    void copy(const ir::Inst& inst);
    void copyScalars(const ir::Inst& inst, const std::vector<Scalar>& scalars);
    Value* stackAlloc(const ir::Inst& inst);
    Value* byteOffset(Value* pointer, Value* offset);

    // emit_calls.cpp
    void call(const ir::Inst& inst, ir::ValueId id);
    void nativeCall(const ir::Inst& inst, ir::ValueId id, bool thenSafepoint);
    bool callsChecked(const ir::Native& native) const;
    bool isHot() const;
    void constNative(const ir::Inst& inst, ir::ValueId id);
    Value* pay(Value* cost);
    Value* budgetLeft();
    Value* costOf(const ir::Inst& inst);
    void charge(const ir::Inst& inst);
    void safepoint(const ir::Inst& inst);
    void checkBudget(const ir::Inst& inst, Value* left);
    void step(const ir::Inst& inst);
    void storeStatement(Value* stmt);
    void noteStatement(const ir::Inst& inst);
    llvm::AllocaInst* resultSlot(ir::TypeId type);
    /// Address of a field of the task.
    template <auto member> Value* taskField(const char* name) {
        static_assert(std::is_same_v<abi::StructOf<member>, rt::TaskCore>);
        return b_.CreateInBoundsGEP(b_.getInt8Ty(), task_, b_.getInt64(abi::kOffsetOf<member>), name);
    }
    template <auto member> Value* loadTask(const char* name) {
        auto* address = taskField<member>(name);
        auto* read = b_.CreateLoad(abi::typeOf<abi::TypeOf<member>>(m_.context()), address);
        read->setMetadata(llvm::LLVMContext::MD_tbaa, m_.tags().task);
        return read;
    }
    Value* stmtNumber(const ir::Inst& inst) const;

    // emit_errors.cpp
    /// A cold block that several places jump to, each with its own number.
    struct ErrorJoin {
        BasicBlock* block = nullptr;
        llvm::PHINode* number = nullptr;
        llvm::PHINode* statement = nullptr; ///< where errors are raised
    };
    bool isHandled(const ir::Inst& inst) const;
    bool inUndo() const { return inUndo_[current_]; }
    /// Whether every way to the current block has filled the frame record.
    bool frameIsFilled() const {
        return frameInPrologue_ || (frameBlock_ != ir::kNone && cfg_.dominates(frameBlock_, current_));
    }
    ErrorJoin& makeJoin(ErrorJoin& join, const char* name);
    BasicBlock* joinFrom(ErrorJoin& join, Value* number);
    void check(const ir::Inst& inst, Value* condition);
    void raise(const ir::Inst& inst);
    void continueIfOk(const ir::Inst& inst, Value* status);
    void continueIfNativeOk(const ir::Inst& inst, Value* status, BasicBlock* call);
    /// rt_propagate and rt_handlerEnd.
    using HandlerCall = abi::Callee<rt::Status(rt::TaskCore*, rt::Frame*)>;
    void handlerCall(const ir::Inst& inst, HandlerCall callee);
    llvm::ConstantInt* statusValue(rt::Status value) { return b_.getInt32(static_cast<uint32_t>(value)); }
    void retry(const ir::Inst& inst);
    void keepInMemory();
    void keepInMemory(Value* address, llvm::Type* type);
    void tryNext(const ir::Inst& inst);
    void resumeSwitch(ir::BlockId ir::Statement::* where);
    BasicBlock* raiseFrom(const ir::Inst& inst, Value* number);
    ErrorJoin& dispatchJoin();
    ErrorJoin& leaveJoin();
    void emitErrorBlocks();
    void emitRaise(ErrorJoin& join);
    void emitDispatch();
    BasicBlock* enterHandler();
    void emitLeave();
    void emitSteps();
    void leaveOrAgain(Value* status);
    void returnStatus(Value* status);

    ModuleEmitter& m_;
    const ir::Module& module_;
    uint32_t index_;
    const ir::Routine& routine_;
    llvm::Function* function_;
    llvm::Constant* desc_;
    llvm::IRBuilder<> b_;
    ir::Cfg cfg_;
    std::vector<bool> inUndo_;
    std::vector<bool> inLoop_;        ///< by block; all of them when loops have several entries
    std::vector<bool> mayFail_;       ///< by statement; empty: the routine has no error handler
    std::vector<bool> beginsRetried_; ///< by block; empty: the routine has no RETRY
    std::vector<BasicBlock*> blocks_;
    std::vector<Value*> values_;
    std::vector<llvm::AllocaInst*> spills_; ///< of values that handlers may need in other blocks
    std::vector<ir::BlockId> homeOf_;
    std::vector<WideLoop> wideLoops_;
    std::vector<JoinedRounds> joinedRounds_;
    std::vector<Value*> locals_;
    bool variablesKept_ = false; ///< in memory, by keepInMemory(): once for all ways back
    llvm::AllocaInst* resultSlots_[ir::kScalarTypes] = {}; ///< for scalar results of natives, by type
    Value *task_ = nullptr, *caller_ = nullptr, *result_ = nullptr;
    llvm::AllocaInst *frame_ = nullptr, *unwinding_ = nullptr;
    Value* failed_ = nullptr;            ///< address: the statement that failed
    ir::BlockId frameBlock_ = ir::kNone; ///< where the frame record is filled; kNone: only on cold paths
    bool frameInPrologue_ = false;
    bool setsTaskFrame_; ///< TaskCore::frame is this routine's record while it runs
    ir::BlockId current_ = 0;
    std::optional<ir::StmtId> storedStmt_;  ///< what the frame record is known to hold at this point
    ErrorJoin steps_;                       ///< stepping: `number` is the statement to execute next
    llvm::AllocaInst* addresses_ = nullptr; ///< stepping: of the locals that are described
    BasicBlock* enterHandler_ = nullptr;
    ErrorJoin raiseHandled_, raiseUnhandled_, dispatch_, leave_, raiseUndo_, leaveUndo_;
    ErrorJoin raiseFrameless_; ///< like raiseUnhandled_, from where the frame record may not be filled
};

} // namespace codegen
