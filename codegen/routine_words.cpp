#include "codegen/routine_words.h"

#include <algorithm>
#include <bit>

#include "codegen/retried_statements.h"
#include "ir/core/op_info.h"

namespace codegen {
namespace {

constexpr uint32_t kSlotBytes = 8;

rt::WordType wordType(ir::TypeId type) {
    using enum rt::WordType;
    constexpr rt::WordType kTypes[] = {None, Bool, I8, I16, I32, I64, F32, F64, Ptr};
    static_assert(std::size(kTypes) == ir::kScalarTypes && ir::kPtr == 8 && ir::kBool == 1);
    return type < ir::kScalarTypes ? kTypes[type] : None;
}

rt::WordOp floatOp(ir::FloatOp op) {
    switch (op) {
    case ir::FloatOp::FAdd: return rt::WordOp::FAdd;
    case ir::FloatOp::FSub: return rt::WordOp::FSub;
    case ir::FloatOp::FMul: return rt::WordOp::FMul;
    case ir::FloatOp::FDiv: return rt::WordOp::FDiv;
    case ir::FloatOp::FNeg: return rt::WordOp::FNeg;
    case ir::FloatOp::FTrunc: return rt::WordOp::FTrunc;
    case ir::FloatOp::FQuot: return rt::WordOp::FQuot;
    case ir::FloatOp::FRem: return rt::WordOp::FRem;
    }
    return rt::WordOp::Unreachable;
}

rt::WordOp intOp(ir::IntOp op) {
    switch (op) {
    case ir::IntOp::IAdd: return rt::WordOp::IAdd;
    case ir::IntOp::ISub: return rt::WordOp::ISub;
    case ir::IntOp::IMul: return rt::WordOp::IMul;
    case ir::IntOp::IDiv: return rt::WordOp::IDiv;
    case ir::IntOp::IRem: return rt::WordOp::IRem;
    case ir::IntOp::UDiv: return rt::WordOp::UDiv;
    case ir::IntOp::URem: return rt::WordOp::URem;
    case ir::IntOp::INeg: return rt::WordOp::INeg;
    case ir::IntOp::Shl: return rt::WordOp::Shl;
    case ir::IntOp::Shr: return rt::WordOp::Shr;
    case ir::IntOp::Sar: return rt::WordOp::Sar;
    }
    return rt::WordOp::Unreachable;
}

/// `swapped`: with its operands in the other order.
struct Comparison {
    rt::WordOp op;
    bool swapped = false;
};

Comparison comparisonOf(ir::CompareOp op) {
    switch (op) {
    case ir::CompareOp::FEq: return {rt::WordOp::FEq};
    case ir::CompareOp::FNe: return {rt::WordOp::FNe};
    case ir::CompareOp::FLt: return {rt::WordOp::FLt};
    case ir::CompareOp::FLe: return {rt::WordOp::FLe};
    case ir::CompareOp::FGt: return {rt::WordOp::FGt};
    case ir::CompareOp::FGe: return {rt::WordOp::FGe};
    case ir::CompareOp::IEq: return {rt::WordOp::IEq};
    case ir::CompareOp::INe: return {rt::WordOp::INe};
    case ir::CompareOp::ILt: return {rt::WordOp::ILt};
    case ir::CompareOp::ILe: return {rt::WordOp::ILe};
    case ir::CompareOp::IGt: return {rt::WordOp::ILt, true};
    case ir::CompareOp::IGe: return {rt::WordOp::ILe, true};
    case ir::CompareOp::IULt: return {rt::WordOp::IULt};
    case ir::CompareOp::IULe: return {rt::WordOp::IULe};
    case ir::CompareOp::IUGt: return {rt::WordOp::IULt, true};
    case ir::CompareOp::IUGe: return {rt::WordOp::IULe, true};
    case ir::CompareOp::IsFinite: return {rt::WordOp::IsFinite};
    }
    return {rt::WordOp::Unreachable};
}

rt::WordOp logicOp(ir::LogicOp op) {
    switch (op) {
    case ir::LogicOp::And: return rt::WordOp::And;
    case ir::LogicOp::Or: return rt::WordOp::Or;
    case ir::LogicOp::Xor: return rt::WordOp::Xor;
    case ir::LogicOp::Not: return rt::WordOp::Not;
    case ir::LogicOp::Select: return rt::WordOp::Select;
    }
    return rt::WordOp::Unreachable;
}

rt::WordOp convertOp(ir::ConvertOp op) {
    switch (op) {
    case ir::ConvertOp::SExt: return rt::WordOp::Move; // slots hold integers sign-extended
    case ir::ConvertOp::ZExt: return rt::WordOp::ZExt;
    case ir::ConvertOp::Trunc: return rt::WordOp::Trunc;
    case ir::ConvertOp::SIntToFloat: return rt::WordOp::SIntToFloat;
    case ir::ConvertOp::UIntToFloat: return rt::WordOp::UIntToFloat;
    case ir::ConvertOp::FloatToSInt: return rt::WordOp::FloatToSInt;
    case ir::ConvertOp::FloatToUInt: return rt::WordOp::FloatToUInt;
    case ir::ConvertOp::FloatToIndex: return rt::WordOp::FloatToIndex;
    case ir::ConvertOp::FWiden: return rt::WordOp::FWiden;
    case ir::ConvertOp::FNarrow: return rt::WordOp::FNarrow;
    }
    return rt::WordOp::Unreachable;
}

} // namespace

WordWriter::WordWriter(const ir::Module& module, const ir::Routine& routine, size_t addressed)
    : module_(module), routine_(routine), cfg_(ir::buildCfg(module, routine, ir::HandlerEdges::Yes)),
      inUndo_(undoBlocks(routine)),
      retried_(retriedBlocks(routine, cfg_, failingStatements(module, routine, cfg_))),
      slots_(routine.insts.size(), rt::kNoSlot), lastUser_(routine.insts.size(), ir::kNone),
      used_(routine.insts.size(), false), begins_(routine.blocks.size(), rt::kNoPlace),
      slotCount_(static_cast<uint32_t>(routine.params.size())) {
    findLastUses();
    out_.words.reserve(routine.insts.size() * 4);
    if (cfg_.order[0] != 0) { // handlers may come before the entry
        put(Op::Jump);
        place(0);
    }
    for (size_t i = 0; i < cfg_.order.size(); ++i) {
        following_ = i + 1 < cfg_.order.size() ? cfg_.order[i + 1] : ir::kNone;
        block(cfg_.order[i]);
    }
    placeLocals(addressed);
}

/// Values that other blocks use have a slot of their own, handlers and RETRY included; those of one block share theirs.
void WordWriter::findLastUses() {
    std::vector<ir::BlockId> homes(routine_.insts.size(), ir::kNone);
    for (const ir::BlockId b : cfg_.order)
        for (const ir::ValueId id : routine_.blocks[b].insts)
            homes[id] = b;
    std::vector<bool> elsewhere(routine_.insts.size(), false);
    for (const ir::BlockId b : cfg_.order)
        for (const ir::ValueId id : routine_.blocks[b].insts)
            for (const ir::ValueId used : routine_.insts[id].operands) {
                used_[used] = true;
                if (homes[used] != b) elsewhere[used] = true;
                lastUser_[used] = id;
            }
    for (size_t id = 0; id < elsewhere.size(); ++id)
        if (elsewhere[id]) lastUser_[id] = ir::kNone;
}

void WordWriter::placeLocals(size_t addressed) {
    size_t most = 0;
    for (const ir::Inst& inst : routine_.insts)
        if (inst.op == ir::Op::Call || inst.op == ir::Op::CallNative)
            most = std::max(most, inst.operands.size());
    uint32_t end = slotCount_ * kSlotBytes;
    out_.arguments = end;
    end += static_cast<uint32_t>(most) * kSlotBytes;
    out_.addressTable = end;
    end += static_cast<uint32_t>(addressed) * kSlotBytes;
    for (const ir::Local& local : routine_.locals) {
        const uint32_t align = std::max(module_.align(local.type), 1U);
        end = (end + align - 1) / align * align;
        out_.places.push_back(end);
        end += module_.size(local.type);
    }
    out_.bytes = end;
}

RoutineWords WordWriter::run() {
    for (const auto& [word, block] : jumps_)
        out_.words[word] = begins_[block];
    // Operands of Place were numbers of locals, because slots come first and their number was not known.
    for (const size_t word : places_)
        out_.words[word] = out_.places[out_.words[word]];
    const auto beginning = [&](ir::BlockId b) { return b < begins_.size() ? begins_[b] : rt::kNoPlace; };
    for (const ir::Statement& statement : routine_.statements) {
        out_.starts.push_back(beginning(statement.start));
        out_.nexts.push_back(beginning(statement.next));
    }
    out_.errorHandler = beginning(routine_.errorHandler);
    out_.undoHandler = beginning(routine_.undoHandler);
    return std::move(out_);
}

void WordWriter::put(Op op, ir::TypeId type, uint32_t count) {
    put(rt::wordOf(op, wordType(type), count));
}

void WordWriter::place(ir::BlockId block) {
    jumps_.emplace_back(out_.words.size(), block);
    put(rt::kNoPlace);
}

uint32_t WordWriter::pointer(WordPointer::Kind kind, uint32_t index) {
    const auto [known, isNew] =
        numbers_.try_emplace({kind, index}, static_cast<uint32_t>(out_.pointers.size()));
    if (isNew) out_.pointers.push_back({kind, index});
    return known->second;
}

void WordWriter::block(ir::BlockId id) {
    current_ = id;
    isNoted_ = false;
    begins_[id] = static_cast<uint32_t>(out_.words.size());
    for (const ir::ValueId value : routine_.blocks[id].insts)
        instruction(value);
}

bool WordWriter::needsStatement(const ir::Inst& inst) const {
    return ir::opInfo(inst.op).atStatement || ir::mayRaise(module_, inst);
}

void WordWriter::note(ir::StmtId statement) {
    if (isNoted_ && noted_ == statement) return;
    isNoted_ = true;
    noted_ = statement;
    uint32_t marks = inUndo_[current_] ? rt::kMarkInUndo : 0;
    if (statement < routine_.statements.size()) {
        const ir::Statement& s = routine_.statements[statement];
        if (s.handled && routine_.errorHandler != ir::kNone) marks |= rt::kMarkHandled;
        if (s.start != ir::kNone) marks |= rt::kMarkStarts;
    }
    put(Op::Statement, ir::kVoid, marks);
    put(statement);
}

void WordWriter::instruction(ir::ValueId id) {
    const ir::Inst& inst = routine_.insts[id];
    if (needsStatement(inst)) note(inst.stmt);
    made_ = rt::kNoSlot;
    if (ir::valueType(inst) != ir::kVoid) {
        if ((lastUser_[id] != ir::kNone || !used_[id]) && !free_.empty()) {
            made_ = free_.back();
            free_.pop_back();
        } else {
            made_ = slotCount_++;
        }
        slots_[id] = made_;
    }
    switch (ir::familyOf(inst.op)) {
    case ir::Family::Leaf: leaf(inst); break;
    case ir::Family::Memory: memory(inst); break;
    case ir::Family::Float: withOperands(floatOp(ir::as<ir::FloatOp>(inst.op)), inst, inst.type); break;
    case ir::Family::Int: withOperands(intOp(ir::as<ir::IntOp>(inst.op)), inst, inst.type); break;
    case ir::Family::Compare: {
        const Comparison how = comparisonOf(ir::as<ir::CompareOp>(inst.op));
        withOperands(how.op, inst, operandType(inst));
        if (how.swapped) std::swap(out_.words[out_.words.size() - 1], out_.words[out_.words.size() - 2]);
        break;
    }
    case ir::Family::Logic: withOperands(logicOp(ir::as<ir::LogicOp>(inst.op)), inst, inst.type); break;
    case ir::Family::Convert:
        withOperands(convertOp(ir::as<ir::ConvertOp>(inst.op)), inst, operandType(inst),
                     static_cast<uint32_t>(wordType(inst.type)));
        break;
    case ir::Family::Action: action(inst); break;
    case ir::Family::End: end(inst); break;
    }
    for (const ir::ValueId used : inst.operands) {
        if (lastUser_[used] != id) continue;
        free_.push_back(slots_[used]);
        lastUser_[used] = ir::kNone; // it may be an operand twice
    }
    if (made_ != rt::kNoSlot && !used_[id]) free_.push_back(made_);
}

ir::TypeId WordWriter::operandType(const ir::Inst& inst) const {
    return ir::valueType(routine_.insts[inst.operands[0]]);
}

void WordWriter::withOperands(Op op, const ir::Inst& inst, ir::TypeId type, uint32_t count) {
    put(op, type, count);
    put(made_);
    for (size_t i = 0; i < inst.operands.size(); ++i)
        operand(inst, i);
}

void WordWriter::number(int64_t value) {
    const bool isShort = value == static_cast<int32_t>(value);
    put(isShort ? Op::Number : Op::LongNumber);
    put(made_);
    put(static_cast<uint32_t>(value));
    if (!isShort) put(static_cast<uint32_t>(static_cast<uint64_t>(value) >> 32));
}

void WordWriter::leaf(const ir::Inst& inst) {
    using Kind = WordPointer::Kind;
    const auto address = [&](Kind kind) {
        put(Op::Pointer);
        put(made_);
        put(pointer(kind, inst.index));
    };
    switch (ir::as<ir::LeafOp>(inst.op)) {
    case ir::LeafOp::Const:
        if (inst.type == ir::kF32)
            return number(static_cast<int32_t>(std::bit_cast<uint32_t>(static_cast<float>(inst.number()))));
        if (inst.type == ir::kF64) return number(std::bit_cast<int64_t>(inst.number()));
        if (inst.type == ir::kBool) return number(inst.integer() != 0 ? 1 : 0);
        return number(inst.type == ir::kPtr
                          ? 0
                          : ir::signExtended(static_cast<uint64_t>(inst.integer()), ir::bitsOf(inst.type)));
    case ir::LeafOp::ParamVal:
        put(Op::Move);
        put(made_);
        put(inst.index);
        return;
    case ir::LeafOp::LocalAddr:
        put(Op::Place);
        put(made_);
        places_.push_back(out_.words.size());
        put(inst.index);
        return;
    case ir::LeafOp::GlobalAddr: return address(Kind::Global);
    case ir::LeafOp::TypeDescAddr: return address(Kind::TypeDesc);
    case ir::LeafOp::RoutineAddr: return address(Kind::RoutineEntry);
    case ir::LeafOp::ResultAddr:
        put(Op::Result);
        put(made_);
        return;
    case ir::LeafOp::Sysvar:
        put(inst.extra == static_cast<int32_t>(ir::SysvarKind::Interrupt) ? Op::InterruptNumber
                                                                          : Op::ErrorNumber);
        put(made_);
        return;
    }
}

void WordWriter::memory(const ir::Inst& inst) {
    const auto operands = [&](Op op, ir::TypeId type = ir::kVoid) {
        put(op, type);
        for (size_t i = 0; i < inst.operands.size(); ++i)
            operand(inst, i);
    };
    switch (ir::as<ir::MemoryOp>(inst.op)) {
    case ir::MemoryOp::Load: return withOperands(Op::Load, inst, inst.type);
    case ir::MemoryOp::Store: return operands(Op::Store, inst.type);
    case ir::MemoryOp::Copy:
        operands(Op::Copy);
        put(module_.size(inst.type));
        return;
    case ir::MemoryOp::CopyDynamic: return operands(Op::CopyDynamic);
    case ir::MemoryOp::StackAlloc: return withOperands(Op::StackAlloc, inst, ir::kVoid);
    case ir::MemoryOp::Zero:
        operands(Op::Zero);
        put(module_.size(inst.type));
        return;
    case ir::MemoryOp::FieldAddr:
        withOperands(Op::Field, inst, ir::kVoid);
        put(module_.fieldOffset(inst.type, inst.index));
        return;
    case ir::MemoryOp::ElemAddr:
        withOperands(Op::Element, inst, ir::kVoid);
        put(module_.size(inst.type));
        return;
    }
}

void WordWriter::call(const ir::Inst& inst, WordPointer::Kind kind, Op op) {
    put(op, ir::valueType(inst), static_cast<uint32_t>(inst.operands.size()));
    put(pointer(kind, inst.index));
    put(made_);
    for (size_t i = 0; i < inst.operands.size(); ++i)
        operand(inst, i);
}

void WordWriter::action(const ir::Inst& inst) {
    const auto pay = [&](Op op, Op more) {
        put(inst.operands.empty() ? op : more);
        put(static_cast<uint32_t>(inst.extra));
        if (!inst.operands.empty()) operand(inst, 0);
    };
    switch (ir::as<ir::ActionOp>(inst.op)) {
    case ir::ActionOp::Check:
    case ir::ActionOp::CheckFinite:
        put(inst.op == ir::Op::Check ? Op::Check : Op::CheckFinite, operandType(inst));
        operand(inst, 0);
        put(static_cast<uint32_t>(inst.extra));
        return;
    case ir::ActionOp::Call: return call(inst, WordPointer::Kind::CallRoutine, Op::Call);
    case ir::ActionOp::CallNative: return call(inst, WordPointer::Kind::CallNative, Op::CallNative);
    case ir::ActionOp::Charge: return pay(Op::Charge, Op::ChargeMore);
    case ir::ActionOp::Safepoint: return pay(Op::Safepoint, Op::SafepointMore);
    case ir::ActionOp::Step:
        note(inst.index);
        put(Op::Step);
        put(inst.index);
        return;
    case ir::ActionOp::Stmt: return; // its number travels with the instructions
    }
}

void WordWriter::end(const ir::Inst& inst) {
    if (entersRetried(routine_, current_, retried_)) put(Op::ForgetRetries);
    const auto one = [&](Op op) {
        put(op, inst.operands.empty() ? ir::kVoid : operandType(inst));
        if (!inst.operands.empty()) operand(inst, 0);
    };
    switch (ir::as<ir::EndOp>(inst.op)) {
    case ir::EndOp::Br:
        if (inst.target(0) == following_) return;
        put(Op::Jump);
        return place(inst.target(0));
    case ir::EndOp::CondBr:
        one(Op::Branch);
        place(inst.target(0));
        return place(inst.target(1));
    case ir::EndOp::Switch: return switchOn(inst);
    case ir::EndOp::Ret:
        if (inUndo_[current_]) return put(Op::ReturnUndo);
        if (inst.operands.empty() || routine_.result == ir::kVoid || !module_.isScalar(routine_.result))
            return put(Op::Return);
        return one(Op::ReturnValue);
    case ir::EndOp::Raise: return one(Op::Raise);
    case ir::EndOp::Propagate: return put(Op::Propagate);
    case ir::EndOp::Retry: return put(Op::Retry);
    case ir::EndOp::TryNext: return put(Op::TryNext);
    case ir::EndOp::HandlerEnd: return put(Op::HandlerEnd);
    case ir::EndOp::Unreachable: return put(Op::Unreachable);
    }
}

void WordWriter::switchOn(const ir::Inst& inst) {
    std::vector<ir::SwitchCase> cases = routine_.caseLists[inst.index];
    std::sort(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
    put(Op::Choose);
    operand(inst, 0);
    place(inst.target(0));
    put(static_cast<uint32_t>(cases.size()));
    for (const ir::SwitchCase& entry : cases) {
        put(static_cast<uint32_t>(entry.value));
        place(entry.target);
    }
}

} // namespace codegen
