#include "codegen/wide_loop.h"

#include <algorithm>

#include <llvm/IR/Intrinsics.h>

#include "ir/core/op_info.h"

namespace codegen {

using ir::Inst;
using ir::Op;
using ir::ValueId;

namespace {

/// Bytes that the results of one step over the array take: eight registers.
constexpr unsigned kBytesAtOnce = 128;
constexpr unsigned kRegister = 16;

bool isVectorOp(Op op) {
    if (ir::familyOf(op) == ir::Family::Float) return !ir::dropsDecimals(op);
    return op == Op::FWiden || op == Op::FNarrow;
}

} // namespace

std::optional<WideLoop> WideLoop::plan(const ir::Module& module, const ir::Routine& routine,
                                       const ir::Cfg& cfg, const ir::Loop& loop) {
    WideLoop wide(module, routine, loop);
    if (!loop.innermost || !wide.read(cfg)) return std::nullopt;
    return wide;
}

bool WideLoop::read(const ir::Cfg& cfg) {
    const auto counted = recogniseCountedLoop(routine_, loop_);
    const bool up = counted && (counted->comparison == Op::ILe || counted->comparison == Op::ILt);
    if (!up || counted->step != 1) return false;
    counted_ = *counted;
    header_ = loop_.header;
    entry_ = ir::entryByJump(routine_, cfg, loop_);
    if (entry_ == ir::kNone) return false;
    return readBody() && !checks_.empty() && isIndependent();
}

/// One way through the loop, block after block.
bool WideLoop::readBody() {
    size_t blocks = 0;
    for (ir::BlockId b = header_;;) {
        ++blocks;
        const std::vector<ValueId>& insts = routine_.blocks[b].insts;
        const Inst& last = routine_.insts[insts.back()];
        const ValueId test = b == header_ ? last.operands[0] : ir::kNone;
        for (const ValueId id : insts) {
            if (id == insts.back() || id == test || routine_.insts[id].op == Op::Stmt) continue;
            if (!classify(id)) return false;
            insts_.push_back(id);
        }
        if (b != header_ && last.op != Op::Br) return false;
        b = last.target(0);
        if (b == header_) break;
        if (!loop_.contains[b] || blocks > loop_.blocks.size()) return false;
    }
    return blocks == loop_.blocks.size() && !stores_.empty() && stores_.size() <= 4 && chooseWidth();
}

/// As many rounds as registers hold the results of; a number that divides all rounds, if these are known, so that none is left.
bool WideLoop::chooseWidth() {
    unsigned largest = 4, smallest = 8;
    const auto note = [&](ir::TypeId type) {
        if (!ir::isFloat(type)) return;
        largest = std::max(largest, module_.size(type));
        smallest = std::min(smallest, module_.size(type));
    };
    for (const ValueId id : checks_)
        note(ir::valueType(routine_.insts[routine_.insts[id].operands[0]]));
    for (const ValueId id : insts_)
        note(ir::valueType(routine_.insts[id]));
    part_ = kRegister / smallest;
    const unsigned usual = kBytesAtOnce / largest / static_cast<unsigned>(stores_.size()) / part_ * part_;
    width_ = usual;
    if (const auto rounds = knownRounds())
        for (unsigned width = (usual + usual / 4) / part_ * part_; width >= usual / 2 && width > 0;
             width -= part_)
            if (*rounds % width == 0) {
                width_ = width;
                break;
            }
    return width_ >= part_;
}

std::optional<int64_t> WideLoop::knownRounds() const {
    const Inst& bound = routine_.insts[counted_.bound];
    std::optional<int64_t> last;
    if (bound.op == Op::Const) last = bound.integer();
    if (bound.op == Op::Load) last = initialValue(bound.operands[0]);
    for (const ValueId id : routine_.blocks[header_].insts) {
        const Inst& load = routine_.insts[id];
        if (load.op != Op::Load || loadedLocal(load) != counted_.counter) continue;
        const auto first = initialValue(load.operands[0]);
        if (!first || !last) return std::nullopt;
        return std::max<int64_t>(0, *last - *first + (counted_.comparison == Op::ILe ? 1 : 0));
    }
    return std::nullopt;
}

/// The constant that the block in front of the loop stores to a local.
std::optional<int64_t> WideLoop::initialValue(ValueId address) const {
    const uint32_t local = routine_.insts[address].index;
    std::optional<int64_t> result;
    for (const ValueId id : routine_.blocks[entry_].insts) {
        const Inst& store = routine_.insts[id];
        if (store.op != Op::Store || loadedLocal(store) != local) continue;
        const Inst& stored = routine_.insts[store.operands[0]];
        result = stored.op == Op::Const ? std::optional(stored.integer()) : std::nullopt;
    }
    return result;
}

const WideLoop::Lane* WideLoop::lane(ValueId id) const {
    const auto found = lanes_.find(id);
    return found == lanes_.end() ? nullptr : &found->second;
}

WideLoop::Kind WideLoop::kindOf(ValueId id) const {
    const Lane* known = lane(id);
    return known ? known->kind : Kind::Uniform; // defined before the loop
}

/// The local that is loaded from or stored to directly; kNone: something else is.
uint32_t WideLoop::loadedLocal(const Inst& inst) const {
    const Inst& address = routine_.insts[inst.operands[inst.op == Op::Store ? 1 : 0]];
    return address.op == Op::LocalAddr ? address.index : ir::kNone;
}

bool WideLoop::isStored(uint32_t local) const {
    for (const ir::BlockId b : loop_.blocks)
        for (const ValueId id : routine_.blocks[b].insts)
            if (routine_.insts[id].op == Op::Store && loadedLocal(routine_.insts[id]) == local) return true;
    return false;
}

bool WideLoop::classify(ValueId id) {
    const Inst& inst = routine_.insts[id];
    Lane out;
    if (inst.op == Op::Load) return classifyLoad(id);
    if (inst.op == Op::Store) return classifyStore(id);
    if (inst.op == Op::CheckFinite) {
        checks_.push_back(id);
        return true;
    }
    if (ir::opInfo(inst.op).touchesMemory || ir::opInfo(inst.op).mayRaise) return false;
    const bool uniform = std::all_of(inst.operands.begin(), inst.operands.end(),
                                     [&](ValueId o) { return kindOf(o) == Kind::Uniform; });
    if (uniform) {
        if (inst.op == Op::LocalAddr || inst.op == Op::GlobalAddr) out.object = id;
        if (inst.op == Op::FieldAddr || inst.op == Op::ElemAddr) return false;
    } else if (inst.op == Op::IAdd || inst.op == Op::ISub) {
        const bool second = kindOf(inst.operands[0]) != Kind::Index; // uniform + index
        const ValueId other = inst.operands[second ? 0 : 1];
        if (kindOf(other) != Kind::Uniform || (second && inst.op == Op::ISub)) return false;
        out.kind = Kind::Index;
        const Inst& amount = routine_.insts[other];
        const auto before = lanes_.at(inst.operands[second ? 1 : 0]).offset;
        if (before && amount.op == Op::Const)
            out.offset = *before + (inst.op == Op::IAdd ? amount.integer() : -amount.integer());
    } else if (inst.op == Op::SIntToFloat) {
        out.kind = Kind::Vector;
    } else if (inst.op == Op::ElemAddr) {
        const Lane* base = lane(inst.operands[0]);
        const ValueId object = base ? base->object : inst.operands[0];
        if (object == ir::kNone || kindOf(inst.operands[0]) != Kind::Uniform || !ir::isFloat(inst.type))
            return false;
        out = {Kind::Address, lanes_.at(inst.operands[1]).offset, object};
    } else if (isVectorOp(inst.op)) {
        const auto fits = [&](ValueId o) { return kindOf(o) == Kind::Uniform || kindOf(o) == Kind::Vector; };
        if (!std::all_of(inst.operands.begin(), inst.operands.end(), fits)) return false;
        out.kind = Kind::Vector;
    } else {
        return false;
    }
    lanes_[id] = out;
    return true;
}

bool WideLoop::classifyLoad(ValueId id) {
    const Inst& inst = routine_.insts[id];
    const uint32_t local = loadedLocal(inst);
    if (local != ir::kNone) {
        if (local == counted_.counter)
            lanes_[id] = {Kind::Index, 0, ir::kNone};
        else if (!module_.isScalar(routine_.locals[local].type) || isStored(local))
            return false;
        else
            lanes_[id] = {};
        return true;
    }
    const Lane* address = lane(inst.operands[0]);
    if (address && address->kind == Kind::Uniform && address->object != ir::kNone) {
        scalars_.push_back(address->object);
        lanes_[id] = {};
        return true;
    }
    if (!address || address->kind != Kind::Address || !ir::isFloat(inst.type)) return false;
    if (routine_.insts[inst.operands[0]].type != inst.type) return false;
    loads_.push_back(id);
    lanes_[id] = {Kind::Vector, std::nullopt, ir::kNone};
    return true;
}

bool WideLoop::classifyStore(ValueId id) {
    const Inst& inst = routine_.insts[id];
    if (loadedLocal(inst) == counted_.counter) return true;
    const Lane* address = lane(inst.operands[1]);
    if (!address || address->kind != Kind::Address || !address->offset || !ir::isFloat(inst.type))
        return false;
    if (routine_.insts[inst.operands[1]].type != inst.type || kindOf(inst.operands[0]) == Kind::Index)
        return false;
    stores_.push_back(id);
    return true;
}

bool WideLoop::sameObject(ValueId a, ValueId b) const {
    const Inst &x = routine_.insts[a], &y = routine_.insts[b];
    return x.op == y.op && x.index == y.index;
}

/// Data that a round stores are not read or stored by another round; and a round reads them before it stores.
bool WideLoop::isIndependent() const {
    const auto named = [&](ValueId object) {
        const Inst& inst = routine_.insts[object];
        if (inst.op == Op::LocalAddr) return true;
        // Two external names can be aliases of one object.
        return inst.op == Op::GlobalAddr && module_.globals[inst.index].kind != ir::GlobalKind::External;
    };
    for (const ValueId s : stores_) {
        const Lane& stored = lanes_.at(routine_.insts[s].operands[1]);
        if (!named(stored.object)) return false;
        for (const ValueId scalar : scalars_)
            if (sameObject(scalar, stored.object)) return false;
        for (const ValueId l : loads_) {
            const Lane& loaded = lanes_.at(routine_.insts[l].operands[0]);
            if (!named(loaded.object)) return false;
            if (!sameObject(stored.object, loaded.object)) continue;
            const bool before =
                std::find(insts_.begin(), insts_.end(), l) < std::find(insts_.begin(), insts_.end(), s);
            if (loaded.offset != stored.offset || !before) return false;
        }
        for (const ValueId other : stores_)
            if (other != s && sameObject(stored.object, lanes_.at(routine_.insts[other].operands[1]).object))
                return false;
    }
    return true;
}

// ---- Emission ------------------------------------------------------------------------------------------------------

/// Emits the wide loop at the end of the block that enters the original one; in two forms when the elements may be
/// aligned to registers.
void RoutineEmitter::wideLoop(const WideLoop& wide) {
    BasicBlock* anywhere = newBlock("wide");
    if (Value* misplaced = misplacedElements(wide)) {
        BasicBlock* aligned = newBlock("wide.aligned");
        b_.CreateCondBr(b_.CreateICmpEQ(misplaced, b_.getInt32(0)), aligned, anywhere);
        wideRounds(wide, aligned, kRegister);
    } else {
        b_.CreateBr(anywhere);
    }
    wideRounds(wide, anywhere, 1);
    storedStmt_.reset();
}

/// A number that is 0 when all elements of the first round begin a register; null: that is not known.
llvm::Value* RoutineEmitter::misplacedElements(const WideLoop& wide) {
    Value* first = load(ir::kI32, locals_[wide.counted_.counter]);
    Value* misplaced = b_.getInt32(0);
    for (const auto& [id, lane] : wide.lanes_) {
        if (lane.kind != WideLoop::Kind::Address) continue;
        const Inst& object = routine_.insts[lane.object];
        if (!lane.offset || object.op != Op::GlobalAddr) return nullptr;
        const auto* global = llvm::dyn_cast<llvm::GlobalVariable>(m_.global(object.index));
        if (!global || global->getAlign().valueOrOne().value() < kRegister) return nullptr;
        const uint32_t perRegister = kRegister / module_.size(routine_.insts[id].type);
        Value* index = b_.CreateAdd(first, b_.getInt32(static_cast<uint32_t>(*lane.offset)));
        misplaced = b_.CreateOr(misplaced, b_.CreateAnd(index, b_.getInt32(perRegister - 1)));
    }
    return misplaced;
}

/// `alignment`: of the elements at the counter, as far as it exceeds that of their type.
void RoutineEmitter::wideRounds(const WideLoop& wide, BasicBlock* head, uint32_t alignment) {
    BasicBlock *body = newBlock("wide.body"), *storing = newBlock("wide.store");
    BasicBlock* rest = blockOf(wide.header());
    Value* counter = locals_[wide.counted_.counter];
    b_.SetInsertPoint(head);
    Value* first = load(ir::kI32, counter);
    b_.CreateCondBr(hasRounds(wide.counted_, wide.width_), body, rest);
    b_.SetInsertPoint(body);
    WideParts parts(wide.width_ / wide.part_);
    for (unsigned k = 0; k < parts.size(); ++k)
        widePart(wide, k, alignment, parts);
    b_.CreateCondBr(allFinite(wide, parts), storing, rest, m_.unlikely());
    b_.SetInsertPoint(storing);
    for (const WideValues& values : parts)
        for (const ValueId id : wide.stores_) {
            const Inst& inst = routine_.insts[id];
            auto* write =
                b_.CreateAlignedStore(wideOperand(wide, inst, 0, values), values.at(inst.operands[1]),
                                      llvm::Align(std::max(alignment, module_.align(inst.type))));
            write->setMetadata(llvm::LLVMContext::MD_tbaa, m_.tags().data[inst.type]);
        }
    store(ir::kI32, b_.CreateAdd(first, b_.getInt32(wide.width_)), counter);
    b_.CreateBr(head);
}

/// The rounds of vector `k`.
void RoutineEmitter::widePart(const WideLoop& wide, unsigned k, uint32_t alignment, WideParts& parts) {
    WideValues& values = parts[k];
    const uint32_t before = k * wide.part_;
    Value* first = load(ir::kI32, locals_[wide.counted_.counter]);
    if (k > 0) first = b_.CreateAdd(first, b_.getInt32(before));
    for (const ValueId id : wide.insts_) {
        const WideLoop::Lane* lane = wide.lane(id);
        if (!lane) continue;
        if (k > 0 && lane->kind == WideLoop::Kind::Address) {
            llvm::Type* type = m_.memoryType(routine_.insts[id].type);
            values[id] = b_.CreateConstInBoundsGEP1_32(type, parts[0].at(id), before);
        } else {
            values[id] = wideValue(wide, id, first, values);
        }
    }
    for (const ValueId id : wide.loads_)
        llvm::cast<llvm::LoadInst>(values.at(id))
            ->setAlignment(llvm::Align(std::max(alignment, module_.align(routine_.insts[id].type))));
}

llvm::Value* RoutineEmitter::wideOperand(const WideLoop& wide, const ir::Inst& inst, size_t i,
                                         const WideValues& values) {
    const ValueId id = inst.operands[i];
    const auto found = values.find(id);
    if (found != values.end() && found->second->getType()->isVectorTy()) return found->second;
    return b_.CreateVectorSplat(wide.part_, found != values.end() ? found->second : value(id));
}

llvm::Value* RoutineEmitter::wideValue(const WideLoop& wide, ir::ValueId id, Value* first,
                                       const WideValues& values) {
    const Inst& inst = routine_.insts[id];
    const auto scalar = [&](size_t i) {
        const auto found = values.find(inst.operands[i]);
        return found != values.end() ? found->second : value(inst.operands[i]);
    };
    const auto wideType = [&](llvm::Type* type) { return llvm::FixedVectorType::get(type, wide.part_); };
    switch (wide.lane(id)->kind) {
    case WideLoop::Kind::Uniform: instruction(id); return value(id);
    case WideLoop::Kind::Index: // in the first of the rounds
        if (inst.op == Op::Load) return first;
        return inst.op == Op::IAdd ? b_.CreateAdd(scalar(0), scalar(1)) : b_.CreateSub(scalar(0), scalar(1));
    case WideLoop::Kind::Address:
        return b_.CreateInBoundsGEP(m_.memoryType(inst.type), scalar(0),
                                    b_.CreateSExt(scalar(1), b_.getInt64Ty()));
    case WideLoop::Kind::Vector: break;
    }
    if (inst.op == Op::Load) {
        auto* read = b_.CreateAlignedLoad(wideType(m_.memoryType(inst.type)), scalar(0),
                                          llvm::Align(module_.align(inst.type)));
        read->setMetadata(llvm::LLVMContext::MD_tbaa, m_.tags().data[inst.type]);
        return read;
    }
    if (inst.op == Op::SIntToFloat) {
        std::vector<llvm::Constant*> rounds;
        for (unsigned i = 0; i < wide.part_; ++i)
            rounds.push_back(b_.getInt32(i));
        Value* numbers =
            b_.CreateAdd(b_.CreateVectorSplat(wide.part_, scalar(0)), llvm::ConstantVector::get(rounds));
        return b_.CreateSIToFP(numbers, wideType(m_.valueType(inst.type)));
    }
    const auto operand = [&](size_t i) { return wideOperand(wide, inst, i, values); };
    if (inst.op == Op::FWiden) return b_.CreateFPExt(operand(0), wideType(b_.getDoubleTy()));
    if (inst.op == Op::FNarrow) return b_.CreateFPTrunc(operand(0), wideType(b_.getFloatTy()));
    switch (ir::as<ir::FloatOp>(inst.op)) {
    case ir::FloatOp::FAdd: return b_.CreateFAdd(operand(0), operand(1));
    case ir::FloatOp::FSub: return b_.CreateFSub(operand(0), operand(1));
    case ir::FloatOp::FMul: return b_.CreateFMul(operand(0), operand(1));
    case ir::FloatOp::FDiv: return b_.CreateFDiv(operand(0), operand(1));
    case ir::FloatOp::FNeg: return b_.CreateFNeg(operand(0));
    case ir::FloatOp::FTrunc:
    case ir::FloatOp::FQuot:
    case ir::FloatOp::FRem: break; // not among those that plan() takes
    }
    return nullptr;
}

/// `vector` in pieces that fill a register.
void RoutineEmitter::addRegisters(Value* vector, std::vector<Value*>& out) {
    auto* type = llvm::cast<llvm::FixedVectorType>(vector->getType());
    const unsigned half = type->getNumElements() / 2;
    if (type->getPrimitiveSizeInBits() <= kRegister * 8) {
        out.push_back(vector);
        return;
    }
    std::vector<int> low, high;
    for (unsigned i = 0; i < half; ++i) {
        low.push_back(static_cast<int>(i));
        high.push_back(static_cast<int>(half + i));
    }
    addRegisters(b_.CreateShuffleVector(vector, low), out);
    addRegisters(b_.CreateShuffleVector(vector, high), out);
}

/// One look at all results: a sum of them shows infinities and NaN. It may overflow where none of them does; then the
/// loop itself does the work.
llvm::Value* RoutineEmitter::allFinite(const WideLoop& wide, const WideParts& parts) {
    Value* fine = b_.getTrue();
    for (const ValueId id : wide.checks_) {
        std::vector<Value*> sums;
        for (const WideValues& values : parts)
            addRegisters(wideOperand(wide, routine_.insts[id], 0, values), sums);
        // Two chains: each register more that a tree needs is copied, and rounds overlap anyhow.
        while (sums.size() > 2) {
            Value* last = sums.back();
            sums.pop_back();
            Value*& chain = sums[sums.size() % 2];
            chain = b_.CreateFAdd(chain, last);
        }
        if (sums.size() == 2) sums[0] = b_.CreateFAdd(sums[0], sums[1]);
        // x - x is +0 when x is finite, otherwise NaN.
        Value* difference = b_.CreateFSub(sums[0], sums[0]);
        const auto bits = static_cast<unsigned>(difference->getType()->getPrimitiveSizeInBits());
        Value* none = b_.CreateIsNull(b_.CreateBitCast(difference, b_.getIntNTy(bits)));
        fine = b_.CreateAnd(fine, none);
    }
    return fine;
}

} // namespace codegen
