// Calls of routines and natives, the built-ins that the compiler treats itself, late binding.

#include "config/letter_case.h"
#include "frontend/syntax/tree_walk.h"
#include "ir/lower/routine_lowering.h"

namespace rapid::lower {

using namespace syntax;
using ir::Op;
using sema::BoundArg;
using sema::BoundCall;
using sema::DataSymbol;
using sema::LanguageError;

const BoundArg* RoutineLowering::findArg(const BoundCall& call, std::string_view name) const {
    const std::string wanted = config::lowerCase(name);
    for (const BoundArg& arg : call.args)
        if (arg.param && config::lowerCase(arg.param->name) == wanted) return &arg;
    return nullptr;
}

ir::ValueId RoutineLowering::argumentAddress(const BoundArg& arg) {
    const Expr& value = unparen(*arg.value);
    const sema::DataType& wanted = arg.param->type;
    const Place p = [&] {
        const bool reference = value.kind == NodeKind::Name || value.kind == NodeKind::Index ||
                               value.kind == NodeKind::Component;
        const bool sameShape = !info(value).constant || arg.param->mode != ParamMode::In ||
                               info(value).type().type->base() == wanted.type->base();
        if (reference && sameShape) return place(value);
        Place temporary;
        temporary.type = wanted.isArray() ? info(value).type() : wanted;
        if (info(value).constant && arg.param->mode == ParamMode::In && !program_.stepping()) {
            temporary.addr = constantAddress(*info(value).constant, temporary.type);
            return temporary;
        }
        temporary.addr = tempAddr(program_.irType(temporary.type));
        storeExpr(value, temporary.type, temporary.addr);
        return temporary;
    }();
    return p.addr;
}

void RoutineLowering::pushPointerArgument(const BoundArg& arg, std::vector<ValueId>& args) {
    const bool copied = arg.param->mode == ParamMode::In && changesBeforeUse_.contains(&arg);
    if (!arg.param->type.isArray()) {
        const ValueId address = argumentAddress(arg);
        args.push_back(address);
        if (!copied) return;
        args.back() = tempAddr(program_.irType(arg.param->type));
        b_.copy(program_.irType(arg.param->type), args.back(), address);
        return;
    }
    const Place p = place(*arg.value);
    args.push_back(copied ? copyOfArray(p) : p.addr);
    for (int k = 0; k < arg.param->type.rank; ++k)
        args.push_back(dimValue(p, k));
}

/// A copy of an array whose size may be known at run time only. Each place of the program has one buffer, made when it is
/// needed for the first time: the size of an array does not change while the routine runs.
ir::ValueId RoutineLowering::copyOfArray(const Place& p) {
    const ir::TypeId element = program_.irType(p.type.type);
    if (p.type.dims[0] > 0) {
        const ir::TypeId type = program_.irType(p.type);
        const ValueId buffer = tempAddr(type);
        b_.copy(type, buffer, p.addr);
        return buffer;
    }
    ValueId count = dimValue(p, 0);
    for (int k = 1; k < p.type.rank; ++k)
        count = b_.binary(Op::IMul, count, dimValue(p, k));
    const ValueId bytes = b_.binary(Op::IMul, b_.convert(Op::SExt, ir::kI64, count),
                                    b_.constI64(program_.module().size(element)));
    const uint32_t buffer = b_.addLocal("", ir::kPtr);
    arrayBuffers_.push_back(buffer);
    const ir::BlockId make = b_.addBlock("buffer");
    const ir::BlockId have = b_.addBlock("copy");
    b_.condBr(b_.binary(Op::IEq, b_.load(ir::kPtr, b_.localAddr(buffer)), b_.nullPtr()), make, have);
    b_.setBlock(make);
    b_.store(ir::kPtr, b_.stackAlloc(bytes), b_.localAddr(buffer));
    b_.br(have);
    b_.setBlock(have);
    b_.copyDynamic(b_.load(ir::kPtr, b_.localAddr(buffer)), p.addr, bytes);
    return b_.load(ir::kPtr, b_.localAddr(buffer));
}

/// IN arguments that a native may overwrite while it still reads them, those that a function called for a later
/// argument may change, and those that the debugger may change.
void RoutineLowering::findChangedArguments(const BoundCall& call) {
    for (size_t i = 0; i < call.args.size(); ++i) {
        const BoundArg& arg = call.args[i];
        const DataSymbol* root = referredData(arg.value, *module_);
        if (!root || !arg.param || arg.param->mode != ParamMode::In) continue;
        // The debugger changes parameters, not the constants that were passed.
        bool changes = program_.stepping() && !call.routine->native && root->dataKind == DataKind::Const;
        for (size_t k = 0; k < call.args.size() && !changes; ++k) {
            const BoundArg& other = call.args[k];
            if (k == i || !other.value || !other.param) continue;
            const DataSymbol* written =
                other.param->mode == ParamMode::In ? nullptr : referredData(other.value, *module_);
            changes =
                (call.routine->native && written && mayOverlap(*root, *written)) ||
                (k > i && callsRoutine(*other.value) && (isShared(*root) || mentions(*other.value, *root)));
        }
        if (changes) changesBeforeUse_.insert(&arg);
    }
}

/// A routine of the program is called: it may change whatever it reaches.
bool RoutineLowering::callsRoutine(const Node& node) const {
    if (node.kind == NodeKind::Call) {
        const auto found = facts().calls.find(&node);
        if (found == facts().calls.end() || !found->second.routine || !found->second.routine->native)
            return true;
    }
    bool calls = false;
    forEachChild(node, [&](const Node& child) { calls = calls || callsRoutine(child); });
    return calls;
}

/// \x?y: what the caller got for y is passed on, absent or not.
void RoutineLowering::pushConditional(const BoundArg& arg, std::vector<ValueId>& args) {
    const auto* source = static_cast<const DataSymbol*>(info(unparen(*arg.value)).symbol);
    const Slot* slot = findSlot(*source);
    if (source->isSwitch) {
        args.push_back(parameter(slot->param));
        return;
    }
    args.push_back(addressIfPresent(*slot));
    for (int k = 0; k < arg.param->type.rank; ++k)
        args.push_back(parameter(slot->param + 1 + static_cast<uint32_t>(k)));
}

void RoutineLowering::pushAny(const BoundArg& arg, std::vector<ValueId>& args) {
    if (arg.kind == BoundArg::Kind::Absent) {
        args.push_back(b_.nullPtr());
        args.push_back(b_.nullPtr());
        return;
    }
    const Place p = place(unparen(*arg.value));
    args.push_back(p.addr);
    args.push_back(typeAddress(p));
}

ir::ValueId RoutineLowering::typeAddress(const Place& p) {
    if (p.type.isArray() && p.type.dims[0] == 0) {
        // Conformant: its size is known at run time only; the runtime makes the description.
        const uint32_t native = program_.support(Support::rt_arrayDesc);
        const ValueId element = b_.typeDescAddr(program_.typeDesc(scalarType(p.type.type)));
        std::vector<ValueId> dims{element};
        for (int k = 0; k < 3; ++k)
            dims.push_back(k < p.type.rank ? dimValue(p, k) : b_.constI32(0));
        return b_.callNative(native, std::move(dims));
    }
    return b_.typeDescAddr(program_.typeDesc(p.type));
}

void RoutineLowering::pushArgument(const BoundArg& arg, std::vector<ValueId>& args) {
    pushValue(arg, args);
    if (program_.passesName(*arg.param)) args.push_back(argumentName(arg));
}

void RoutineLowering::pushValue(const BoundArg& arg, std::vector<ValueId>& args) {
    const Passing passing = passingOf(*arg.param);
    if (passing == Passing::Any) return pushAny(arg, args);
    switch (arg.kind) {
    case BoundArg::Kind::Absent:
        if (passing == Passing::Switch) {
            args.push_back(b_.constBool(false));
        } else {
            args.push_back(b_.nullPtr());
            for (int k = 0; k < arg.param->type.rank; ++k)
                args.push_back(b_.constI32(0));
        }
        return;
    case BoundArg::Kind::Conditional: return pushConditional(arg, args);
    case BoundArg::Kind::Present: break;
    }
    switch (passing) {
    case Passing::Switch: args.push_back(b_.constBool(true)); return;
    case Passing::Value: args.push_back(lowerValueAs(*arg.value, arg.param->type.type)); return;
    case Passing::Pointer: return pushPointerArgument(arg, args);
    case Passing::Any: return;
    }
}

ir::ValueId RoutineLowering::lowerCall(const Node& node, ValueId resultAddr) {
    if (isIncompleteCall(node)) {
        reachPlaceholder(node);
        return b_.constF32(0);
    }
    const auto& calls = facts().calls;
    auto found = calls.find(&node);
    if (found == calls.end() || !found->second.routine) return b_.constF32(0);
    const BoundCall& call = found->second;
    const sema::RoutineSymbol& callee = *call.routine;
    if (callee.native) {
        if (callee.role == sema::Role::ArgName) {
            lowerArgName(call, resultAddr);
            return ir::kNone;
        }
        bool done = false;
        const ValueId value = lowerSpecial(call, done);
        if (done) return value;
        if (!program_.implemented(callee)) {
            const uint32_t native = program_.support(Support::rt_notImplemented);
            b_.callNative(native, {b_.globalAddr(program_.stringGlobal(callee.name))});
            if (callee.routineKind != RoutineKind::Func) return ir::kNone;
            const ir::TypeId type = program_.irType(callee.returnType);
            if (type == ir::kF32) return b_.constF32(0);
            if (type == ir::kF64) return b_.constF64(0);
            if (type == ir::kBool) return b_.constBool(false);
            if (resultAddr != ir::kNone) b_.zero(type, resultAddr);
            return ir::kNone;
        }
    }
    if (const sema::ConstValue* value = evaluatedCall(node, call))
        return lowerEvaluated(*value, callee.returnType, resultAddr);
    findChangedArguments(call);
    if (program_.isForeign(callee)) return lowerForeignCall(call, resultAddr);
    if (program_.mayBeErased(callee, module_)) return lowerErasableCall(call, resultAddr);
    std::vector<ValueId> args;
    const bool isFunction = callee.routineKind == RoutineKind::Func;
    const ir::TypeId result = isFunction ? program_.irType(callee.returnType) : ir::kVoid;
    const bool aggregate = isFunction && !program_.module().isScalar(result);
    if (aggregate) args.push_back(resultAddr == ir::kNone ? tempAddr(result) : resultAddr);
    for (const BoundArg& arg : call.args)
        pushArgument(arg, args);
    if (callee.native) return b_.callNative(program_.nativeFor(callee), std::move(args));
    return b_.call(program_.routineFor(callee, task_), std::move(args));
}

ir::ValueId RoutineLowering::lowerSpecial(const BoundCall& call, bool& done) {
    done = true;
    switch (call.routine->role) {
    case sema::Role::Present: return lowerPresent(call);
    case sema::Role::Dim: return lowerDim(call);
    case sema::Role::RaiseToUser:
        if (region_ != Region::Error || findArg(call, "Continue")->kind == BoundArg::Kind::Absent) break;
        lowerRaiseToUser(call);
        return ir::kNone;
    case sema::Role::WaitUntil: lowerWaitUntil(call); return ir::kNone;
    case sema::Role::CyclicBool: // then the native with the present value
        lowerCyclicCondition(call);
        break;
    case sema::Role::None:
    case sema::Role::ArgName:        // needs the place of the result
    case sema::Role::StartMoveRetry: // the native first
    case sema::Role::CallByVar: break;
    }
    done = false;
    return ir::kNone;
}

ir::ValueId RoutineLowering::lowerPresent(const BoundCall& call) {
    const Expr& value = unparen(*call.args[0].value);
    const auto* symbol = static_cast<const DataSymbol*>(info(value).symbol);
    const Slot* slot = symbol ? findSlot(*symbol) : nullptr;
    if (!slot || slot->param == ir::kNone || !symbol->optional) return b_.constBool(true);
    if (symbol->isSwitch) return parameter(slot->param);
    return b_.binary(Op::INe, parameter(slot->param), b_.nullPtr());
}

ir::ValueId RoutineLowering::lowerDim(const BoundCall& call) {
    const Place p = place(*call.args[0].value);
    const Expr& number = unparen(*call.args[1].value);
    const int32_t illegal = program_.errorNumber(LanguageError::Dimension);
    if (const auto* constant = info(number).constant) {
        const int k = static_cast<int>(constant->number);
        if (k >= 1 && k <= p.type.rank) return b_.convert(Op::SIntToFloat, ir::kF32, dimValue(p, k - 1));
        b_.check(b_.constBool(false), illegal);
        return b_.constF32(0);
    }
    const ValueId wanted = lowerValueAs(number, program_.program().num);
    ValueId result = b_.constI32(0);
    for (int k = 0; k < p.type.rank; ++k)
        result = b_.select(b_.binary(Op::FEq, wanted, b_.constF32(k + 1)), dimValue(p, k), result);
    b_.check(b_.binary(Op::INe, result, b_.constI32(0)), illegal);
    return b_.convert(Op::SIntToFloat, ir::kF32, result);
}

/// WaitUntil evaluates its condition again and again (manual 1.20: every 100 ms unless \PollRate says otherwise).
void RoutineLowering::lowerWaitUntil(const BoundCall& call) {
    auto pointer = [&](std::string_view name) {
        const BoundArg* arg = findArg(call, name);
        std::vector<ValueId> out;
        if (!arg || arg->kind == BoundArg::Kind::Absent) return b_.nullPtr();
        pushArgument(*arg, out);
        return out[0];
    };
    const uint32_t native = program_.support(Support::rt_waitUntilPoll);
    const BoundArg* inPosArg = findArg(call, "InPos");
    std::vector<ValueId> inPosValue;
    if (inPosArg) pushArgument(*inPosArg, inPosValue);
    const uint32_t inPos = temp(ir::kBool);
    b_.store(ir::kBool, inPosArg ? inPosValue[0] : b_.constBool(false), b_.localAddr(inPos));
    const ValueId maxTime = pointer("MaxTime");
    const ValueId timeFlag = pointer("TimeFlag");
    const ValueId pollRate = pointer("PollRate");
    const uint32_t state = temp(ir::kI64);
    b_.store(ir::kI64, b_.constI64(0), b_.localAddr(state));
    const ir::BlockId head = b_.addBlock("waituntil");
    const ir::BlockId poll = b_.addBlock("poll");
    const ir::BlockId met = b_.addBlock("met");
    const ir::BlockId end = b_.addBlock("waited");
    if (inPosArg && inPosArg->kind != BoundArg::Kind::Absent) {
        // \InPos: first the robot comes to rest, then the condition counts.
        b_.callNative(program_.support(Support::rt_waitInPos), {inPosValue[0]});
    }
    b_.br(head);
    b_.setBlock(head);
    lowerCond(*findArg(call, "Cond")->value, met, poll);
    b_.setBlock(poll);
    const ValueId again = b_.callNative(
        native, {b_.load(ir::kBool, b_.localAddr(inPos)), maxTime, timeFlag, pollRate, b_.localAddr(state)});
    b_.charge(1); // each evaluation takes time
    b_.condBr(again, head, end);
    b_.setBlock(met);
    const BoundArg* flag = findArg(call, "TimeFlag");
    if (flag && flag->kind == BoundArg::Kind::Present) b_.store(ir::kBool, b_.constBool(false), timeFlag);
    b_.br(end);
    b_.setBlock(end);
}

} // namespace rapid::lower
