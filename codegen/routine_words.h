#pragma once
// IR instructions of a routine -> the words of runtime/abi/interpreted.h, in linear time. Free of LLVM: what lies at addresses is
// numbered here and placed by the caller.

#include <cstdint>
#include <map>
#include <vector>

#include "ir/core/cfg.h"
#include "ir/core/ir.h"
#include "runtime/abi/interpreted.h"

namespace codegen {

/// Something whose address the words need.
struct WordPointer {
    enum class Kind : uint8_t { Global, TypeDesc, RoutineEntry, CallRoutine, CallNative };
    Kind kind;
    uint32_t index; ///< of the kind, in the module
    auto operator<=>(const WordPointer&) const = default;
};

struct RoutineWords {
    std::vector<uint32_t> words;
    std::vector<WordPointer> pointers;
    std::vector<uint32_t> starts, nexts; ///< by statement
    std::vector<uint32_t> places;        ///< offsets of the locals in the memory of an activation
    uint32_t arguments = 0;              ///< offset of the slots for arguments
    uint32_t addressTable = 0;           ///< offset of the table of addressed locals
    uint32_t bytes = 0;                  ///< of the memory
    uint32_t errorHandler = rt::kNoPlace, undoHandler = rt::kNoPlace;
};

class WordWriter {
  public:
    /// `addressed`: locals that get an entry in the table of addresses.
    WordWriter(const ir::Module& module, const ir::Routine& routine, size_t addressed);
    RoutineWords run();

  private:
    using Op = rt::WordOp;

    void findLastUses();
    void placeLocals(size_t addressed);
    void block(ir::BlockId id);
    void instruction(ir::ValueId id);
    void leaf(const ir::Inst& inst);
    void memory(const ir::Inst& inst);
    void action(const ir::Inst& inst);
    void call(const ir::Inst& inst, WordPointer::Kind kind, Op op);
    void end(const ir::Inst& inst);
    void switchOn(const ir::Inst& inst);
    void note(ir::StmtId statement);
    bool needsStatement(const ir::Inst& inst) const;
    void number(int64_t value);
    void withOperands(Op op, const ir::Inst& inst, ir::TypeId type, uint32_t count = 0);
    void put(Op op, ir::TypeId type = ir::kVoid, uint32_t count = 0); ///< the first word of an instruction
    void put(uint32_t word) { out_.words.push_back(word); }
    void operand(const ir::Inst& inst, size_t i) { put(slots_[inst.operands[i]]); }
    void place(ir::BlockId block);
    uint32_t pointer(WordPointer::Kind kind, uint32_t index);
    ir::TypeId operandType(const ir::Inst& inst) const;

    const ir::Module& module_;
    const ir::Routine& routine_;
    const ir::Cfg cfg_;
    const std::vector<bool> inUndo_, retried_;
    RoutineWords out_;
    std::vector<uint32_t> slots_;       ///< by value
    std::vector<ir::ValueId> lastUser_; ///< by value, when all users are in its block; kNone otherwise
    std::vector<bool> used_;            ///< by value
    std::vector<uint32_t> free_;        ///< slots
    std::vector<uint32_t> begins_;      ///< by block: place
    std::vector<std::pair<size_t, ir::BlockId>> jumps_;
    std::vector<size_t> places_;              ///< words with the number of a local
    std::map<WordPointer, uint32_t> numbers_; ///< of out_.pointers
    uint32_t slotCount_ = 0, made_ = rt::kNoSlot;
    ir::BlockId current_ = 0, following_ = ir::kNone;
    ir::StmtId noted_ = 0;
    bool isNoted_ = false;
};

} // namespace codegen
