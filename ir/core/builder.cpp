#include <utility>

#include "ir/core/ir.h"
#include "ir/core/op_info.h"

namespace ir {
namespace {

Inst make(Op op, TypeId type = kVoid, OperandList operands = {}) {
    Inst inst;
    inst.op = op;
    inst.type = type;
    inst.operands = std::move(operands);
    return inst;
}

Inst makeIndexed(Op op, TypeId type, uint32_t index) {
    Inst inst = make(op, type);
    inst.index = index;
    return inst;
}

Inst makeInt(TypeId type, int64_t value) {
    Inst inst = make(Op::Const, type);
    inst.setInteger(value);
    return inst;
}

Inst makeFloat(TypeId type, double number) {
    Inst inst = make(Op::Const, type);
    inst.setNumber(number);
    return inst;
}

} // namespace

uint32_t Routine::blockName(std::string_view wanted) {
    constexpr size_t kSought = 64; // the compiler uses fewer; a text may have one for each block
    for (size_t i = blockNames.size(); i-- > 0 && i + kSought >= blockNames.size();)
        if (blockNames[i] == wanted) return static_cast<uint32_t>(i);
    blockNames.emplace_back(wanted);
    return static_cast<uint32_t>(blockNames.size() - 1);
}

BlockId Builder::addBlock(std::string_view name) {
    routine_.blocks.push_back({routine_.blockName(name), {}});
    return static_cast<BlockId>(routine_.blocks.size() - 1);
}

bool Builder::terminated() const {
    const std::vector<ValueId>& insts = routine_.blocks[block_].insts;
    return !insts.empty() && opInfo(routine_.insts[insts.back()].op).terminator;
}

StmtId Builder::addStatement(const Statement& statement) {
    routine_.statements.push_back(statement);
    return static_cast<StmtId>(routine_.statements.size() - 1);
}

void Builder::setStatement(StmtId stmt) {
    stmt_ = stmt;
    emit(makeIndexed(Op::Stmt, kVoid, stmt));
}

uint32_t Builder::addLocal(std::string name, TypeId type, bool isParam) {
    Local local;
    local.name = std::move(name);
    local.type = type;
    local.isParam = isParam;
    routine_.locals.push_back(std::move(local));
    return static_cast<uint32_t>(routine_.locals.size() - 1);
}

void Builder::step(StmtId stmt) {
    emit(makeIndexed(Op::Step, kVoid, stmt));
}

ValueId Builder::emit(Inst inst) {
    // Instructions after a terminator cannot be reached; they get a block of their own, which simplifyCfg removes.
    if (terminated()) block_ = addBlock("dead");
    if (inst.stmt == kNone) inst.stmt = stmt_;
    routine_.insts.push_back(std::move(inst));
    auto id = static_cast<ValueId>(routine_.insts.size() - 1);
    routine_.blocks[block_].insts.push_back(id);
    return id;
}

ValueId Builder::constF32(double value) {
    return emit(makeFloat(kF32, static_cast<float>(value)));
}
ValueId Builder::constF64(double value) {
    return emit(makeFloat(kF64, value));
}
ValueId Builder::constInt(TypeId type, int64_t value) {
    return emit(makeInt(type, value));
}

void Builder::beginShared() {
    if (sharedIn_ == block_ && !terminated()) return;
    if (terminated()) block_ = addBlock("dead");
    sharedIn_ = block_;
    ++span_;
}

ValueId Builder::shared(SharedValue& known, Inst inst) {
    if (known.span != span_) known = {span_, emit(std::move(inst))};
    return known.value;
}

ValueId Builder::constBool(bool value) {
    if (value) return constInt(kBool, 1);
    beginShared();
    return shared(false_, makeInt(kBool, 0));
}
ValueId Builder::nullPtr() {
    beginShared();
    return shared(null_, makeInt(kPtr, 0));
}

ValueId Builder::param(uint32_t index) {
    return emit(makeIndexed(Op::ParamVal, routine_.params[index].type, index));
}
ValueId Builder::localAddr(uint32_t local) {
    beginShared();
    if (local >= localAddresses_.size()) localAddresses_.resize(routine_.locals.size());
    return shared(localAddresses_[local], makeIndexed(Op::LocalAddr, kPtr, local));
}
ValueId Builder::globalAddr(uint32_t global) {
    beginShared();
    return shared(globalAddresses_[global], makeIndexed(Op::GlobalAddr, kPtr, global));
}
ValueId Builder::typeDescAddr(uint32_t desc) {
    return emit(makeIndexed(Op::TypeDescAddr, kPtr, desc));
}
ValueId Builder::routineAddr(uint32_t routine) {
    return emit(makeIndexed(Op::RoutineAddr, kPtr, routine));
}
ValueId Builder::resultAddr() {
    return emit(make(Op::ResultAddr, kPtr));
}

ValueId Builder::sysvar(SysvarKind kind) {
    Inst inst = make(Op::Sysvar, kI32);
    inst.extra = static_cast<int32_t>(kind);
    return emit(std::move(inst));
}

ValueId Builder::load(TypeId type, ValueId ptr) {
    return emit(make(Op::Load, type, {ptr}));
}
void Builder::store(TypeId type, ValueId value, ValueId ptr) {
    emit(make(Op::Store, type, {value, ptr}));
}
void Builder::copy(TypeId type, ValueId dst, ValueId src) {
    emit(make(Op::Copy, type, {dst, src}));
}
void Builder::copyDynamic(ValueId dst, ValueId src, ValueId bytes) {
    emit(make(Op::CopyDynamic, kVoid, {dst, src, bytes}));
}
ValueId Builder::stackAlloc(ValueId bytes) {
    return emit(make(Op::StackAlloc, kPtr, {bytes}));
}
void Builder::zero(TypeId type, ValueId dst) {
    emit(make(Op::Zero, type, {dst}));
}

ValueId Builder::fieldAddr(TypeId record, ValueId ptr, uint32_t field) {
    Inst inst = make(Op::FieldAddr, record, {ptr});
    inst.index = field;
    return emit(std::move(inst));
}
ValueId Builder::elemAddr(TypeId element, ValueId ptr, ValueId zeroBasedIndex) {
    return emit(make(Op::ElemAddr, element, {ptr, zeroBasedIndex}));
}

ValueId Builder::binary(Op op, ValueId a, ValueId b) {
    TypeId type = opInfo(op).result == ResultRule::Bool ? kBool : typeOf(a);
    return emit(make(op, type, {a, b}));
}
ValueId Builder::binaryInRange(Op op, ValueId a, ValueId b) {
    Inst inst = make(op, typeOf(a), {a, b});
    inst.extra = 1;
    return emit(std::move(inst));
}
ValueId Builder::unary(Op op, ValueId a) {
    return emit(make(op, typeOf(a), {a}));
}
ValueId Builder::convert(Op op, TypeId to, ValueId a) {
    return emit(make(op, to, {a}));
}
ValueId Builder::select(ValueId cond, ValueId a, ValueId b) {
    return emit(make(Op::Select, typeOf(a), {cond, a, b}));
}

void Builder::check(ValueId cond, int32_t errorNumber) {
    Inst inst = make(Op::Check, kVoid, {cond});
    inst.extra = errorNumber;
    emit(std::move(inst));
}

ValueId Builder::call(uint32_t callee, std::vector<ValueId> args) {
    TypeId result = module_.routines[callee].result;
    Inst inst = make(Op::Call, module_.isScalar(result) ? result : kVoid, std::move(args));
    inst.index = callee;
    return emit(std::move(inst));
}
ValueId Builder::callNative(uint32_t native, std::vector<ValueId> args) {
    TypeId result = module_.natives[native].result;
    Inst inst = make(Op::CallNative, module_.isScalar(result) ? result : kVoid, std::move(args));
    inst.index = native;
    return emit(std::move(inst));
}

void Builder::br(BlockId target) {
    Inst inst = make(Op::Br);
    inst.target(0) = target;
    emit(std::move(inst));
}
void Builder::condBr(ValueId cond, BlockId ifTrue, BlockId ifFalse) {
    Inst inst = make(Op::CondBr, kVoid, {cond});
    inst.target(0) = ifTrue;
    inst.target(1) = ifFalse;
    emit(std::move(inst));
}
void Builder::switchOn(ValueId value, std::vector<SwitchCase> cases, BlockId otherwise) {
    Inst inst = make(Op::Switch, kVoid, {value});
    inst.index = static_cast<uint32_t>(routine_.caseLists.size());
    routine_.caseLists.push_back(std::move(cases));
    inst.target(0) = otherwise;
    emit(std::move(inst));
}
void Builder::ret() {
    emit(make(Op::Ret));
}
void Builder::ret(ValueId value) {
    emit(make(Op::Ret, kVoid, {value}));
}
void Builder::raise(ValueId errorNumber) {
    emit(make(Op::Raise, kVoid, {errorNumber}));
}
void Builder::propagate() {
    emit(make(Op::Propagate));
}
void Builder::retry() {
    emit(make(Op::Retry));
}
void Builder::tryNext() {
    emit(make(Op::TryNext));
}
void Builder::handlerEnd() {
    emit(make(Op::HandlerEnd));
}
void Builder::unreachable() {
    emit(make(Op::Unreachable));
}
void Builder::charge(uint32_t cost, ValueId more) {
    Inst inst = make(Op::Charge);
    inst.extra = static_cast<int32_t>(cost);
    if (more != kNone) inst.operands = {more};
    emit(std::move(inst));
}
void Builder::safepoint(int32_t cost) {
    Inst inst = make(Op::Safepoint);
    inst.extra = cost;
    emit(std::move(inst));
}

} // namespace ir
