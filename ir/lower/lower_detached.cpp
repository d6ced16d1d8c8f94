// RaiseToUser \Continue (manual 1.12): the error handler of a routine at user level is executed while the NOSTEPIN routines
// that it called are still in progress. So it exists a second time, as a routine of its own that runs on top of them and
// reaches the data of its routine by a table of addresses. It reports its decision (RETRY, TRYNEXT, RETURN) to the runtime.

#include "ir/lower/routine_lowering.h"

namespace rapid::lower {

using namespace syntax;
using sema::DataSymbol;

namespace {

/// Equal to rt::HandlerDecision.
enum Decision : int32_t { kRetry = 1, kTryNext = 2, kReturn = 3, kRaise = 4 };

} // namespace

/// Routines at user level can be asked for it: those of programs in which \Continue occurs.
bool RoutineLowering::needsDetachedHandler() const {
    return hasErrorHandler_ && !symbol_.noStepIn && !symbol_.predefined && program_.continuesAtUserLevel();
}

// ---- The routine itself ----------------------------------------------------------------------------------------------

uint32_t RoutineLowering::share(uint32_t local) {
    routine_.sharedLocals.push_back(local);
    return static_cast<uint32_t>(routine_.sharedLocals.size() - 1);
}

/// Everything its handler may name gets a place in memory and in the table.
void RoutineLowering::shareData() {
    const auto shareParameter = [this](uint32_t number) {
        const ir::TypeId type = routine_.params[number].type;
        const uint32_t kept = b_.addLocal("", type);
        b_.store(type, b_.param(number), b_.localAddr(kept));
        shared_.params[number] = {share(kept), type};
    };
    for (const DataSymbol* param : symbol_.params) {
        const Slot& slot = slots_.at(param);
        const rt::ParamShape shape = shapeOf(*param);
        for (uint32_t k = 0; rt::passingOf(shape) != Passing::Value && k < rt::slotCount(shape); ++k)
            shareParameter(slot.param + k);
        if (slot.name != ir::kNone) shareParameter(slot.name);
        if (slot.local != ir::kNone) shared_.objects[param] = share(slot.local);
    }
    for (const DataSymbol* data : symbol_.data)
        if (data->storage == sema::Storage::RoutineData && findSlot(*data))
            shared_.objects[data] = share(findSlot(*data)->local);
    if (symbol_.routineKind != RoutineKind::Func) return;
    shared_.resultLocal = b_.addLocal("", program_.irType(symbol_.returnType));
    shared_.result = share(shared_.resultLocal);
}

/// First thing in the handler: the detached handler may have been executed already and have decided to leave the routine.
void RoutineLowering::lowerTakeDecision() {
    startStatement(*symbol_.routineDecl, ir::StmtKind::Handler);
    const ValueId decision = b_.callNative(program_.support(Support::rt_takeDecision), {});
    const ir::BlockId returns = b_.addBlock("returns"), raises = b_.addBlock("raises"),
                      handler = b_.addBlock("handler");
    b_.switchOn(decision, {{kReturn, returns}, {kRaise, raises}}, handler);
    b_.setBlock(raises);
    b_.propagate();
    b_.setBlock(returns);
    if (symbol_.routineKind != RoutineKind::Func) {
        b_.ret();
    } else {
        const ir::TypeId type = program_.irType(symbol_.returnType);
        if (program_.module().isScalar(type)) {
            b_.ret(b_.load(type, b_.localAddr(shared_.resultLocal)));
        } else {
            b_.copy(type, b_.resultAddr(), b_.localAddr(shared_.resultLocal));
            b_.ret();
        }
    }
    b_.setBlock(handler);
}

// ---- The detached handler ----------------------------------------------------------------------------------------------

ir::Routine RoutineLowering::runDetached(const RoutineLowering& body) {
    body_ = &body;
    region_ = Region::Error;
    b_.setBlock(b_.addBlock("entry"));
    for (const DataSymbol* param : symbol_.params)
        bindShared(*param, body.slots_.at(param));
    for (const DataSymbol* data : symbol_.data)
        if (data->storage == sema::Storage::RoutineData && body.findSlot(*data))
            bindShared(*data, *body.findSlot(*data));
    CostScope costs;
    openCosts(costs);
    lowerErrorClauses();
    closeCosts();
    if (costs.statements > 0) chargeAtFront(0, costs.cost());
    clearArrayBuffers(0);
    routine_.errorFilter.clear(); // the routine's own: it is asked before this one runs
    routine_.errorFilterGlobals.clear();
    return std::move(routine_);
}

ir::ValueId RoutineLowering::sharedAddress(uint32_t position) {
    const ValueId row = b_.elemAddr(ir::kPtr, b_.param(0), b_.constI32(static_cast<int32_t>(position)));
    return b_.load(ir::kPtr, row);
}

/// The argument of the caller for the IR parameter.
ir::ValueId RoutineLowering::parameter(uint32_t number) {
    if (!body_) return b_.param(number);
    const SharedData::Parameter& kept = body_->shared_.params.at(number);
    return b_.load(kept.type, sharedAddress(kept.position));
}

/// `slot`: where the routine has the object. Here a local holds its address.
void RoutineLowering::bindShared(const DataSymbol& symbol, Slot slot) {
    const bool own = slot.kind == Slot::Kind::Local;
    const bool isArray = !own && symbol.type.isArray();
    if (slot.local != ir::kNone) {
        ValueId address = sharedAddress(body_->shared_.objects.at(&symbol));
        if (!own) address = b_.load(ir::kPtr, address);
        if (slot.optional)
            address =
                b_.select(b_.binary(ir::Op::INe, parameter(slot.param), b_.nullPtr()), address, b_.nullPtr());
        slot.kind = Slot::Kind::Pointer;
        slot.local = b_.addLocal(symbol.name, ir::kPtr, symbol.storage == sema::Storage::Parameter);
        b_.store(ir::kPtr, address, b_.localAddr(slot.local));
    }
    slots_[&symbol] = slot;
    if (!describesData_) return;
    if (symbol.isSwitch) return describeSwitch(symbol, slot);
    if (isArray || slot.local == ir::kNone) return describeReference(symbol, slot);
    routine_.locals[slot.local].reference = true;
    routine_.locals[slot.local].typeDesc = program_.typeDesc(symbol.type);
}

void RoutineLowering::endDetached(int32_t decision) {
    b_.callNative(program_.support(Support::rt_endDetached), {b_.constI32(decision)});
    b_.ret();
}

void RoutineLowering::lowerRetry() {
    body_ ? endDetached(kRetry) : b_.retry();
}

void RoutineLowering::lowerTryNext() {
    body_ ? endDetached(kTryNext) : b_.tryNext();
}

void RoutineLowering::lowerDetachedReturn(const ReturnStmt& stmt) {
    if (stmt.value && symbol_.routineKind == RoutineKind::Func) {
        const ir::TypeId type = program_.irType(symbol_.returnType);
        if (program_.module().isScalar(type)) {
            const ValueId value = lowerValueAs(*stmt.value, symbol_.returnType.type);
            b_.store(type, value, sharedAddress(body_->shared_.result));
        } else {
            lowerInto(*stmt.value, symbol_.returnType, sharedAddress(body_->shared_.result));
        }
    }
    endDetached(kReturn);
}

// ---- The NOSTEPIN routine that raises ------------------------------------------------------------------------------------

/// RaiseToUser \Continue in an error handler: comes back when the handler at user level has executed RETRY or TRYNEXT, which
/// is then carried out here.
void RoutineLowering::lowerRaiseToUser(const sema::BoundCall& call) {
    std::vector<ValueId> args;
    for (const sema::BoundArg& arg : call.args)
        pushArgument(arg, args);
    const uint32_t native = program_.support(Support::rt_raiseToUser);
    const ValueId decision = b_.callNative(native, std::move(args));
    const ir::BlockId again = b_.addBlock("again"), next = b_.addBlock("after");
    b_.condBr(b_.binary(ir::Op::IEq, decision, b_.constI32(kRetry)), again, next);
    b_.setBlock(again);
    lowerRetry();
    b_.setBlock(next);
    lowerTryNext();
}

} // namespace rapid::lower
