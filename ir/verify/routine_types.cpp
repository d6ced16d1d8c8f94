// The typing rules of the instructions.

#include <fmt/format.h>

#include <algorithm>

#include "ir/core/op_info.h"
#include "ir/verify/routine_verifier.h"

namespace ir {
namespace {

bool isFloat(TypeId type) {
    return type == kF32 || type == kF64;
}
bool isInt(TypeId type) {
    return type == kI32 || type == kI64;
}

} // namespace

TypeId RoutineVerifier::operandType(const Inst& inst, size_t operand) const {
    return valueType(routine_.insts[inst.operands[operand]]);
}

void RoutineVerifier::want(const Inst& inst, size_t operand, TypeId type) {
    TypeId found = operandType(inst, operand);
    if (found != type) add(fmt::format("operand {} has type {}, type {} is wanted", operand, found, type));
}

void RoutineVerifier::types(const Inst& inst) {
    switch (inst.op) {
    case Op::Const:
    case Op::ParamVal:
    case Op::LocalAddr:
    case Op::GlobalAddr:
    case Op::TypeDescAddr:
    case Op::RoutineAddr:
    case Op::ResultAddr:
    case Op::Sysvar:
    case Op::Load:
    case Op::Store:
    case Op::Copy:
    case Op::CopyDynamic:
    case Op::StackAlloc:
    case Op::Zero:
    case Op::FieldAddr:
    case Op::ElemAddr: typesOfMemory(inst); return;
    case Op::Check:
    case Op::CheckFinite:
    case Op::Call:
    case Op::CallNative:
    case Op::Charge:
    case Op::Safepoint:
    case Op::Stmt:
    case Op::Step:
    case Op::Br:
    case Op::CondBr:
    case Op::Switch:
    case Op::Ret:
    case Op::Raise:
    case Op::Propagate:
    case Op::Retry:
    case Op::TryNext:
    case Op::HandlerEnd:
    case Op::Unreachable: typesOfControl(inst); return;
    default: typesOfArithmetic(inst); return;
    }
}

void RoutineVerifier::typesOfArithmetic(const Inst& inst) {
    TypeId from = conversionFrom(inst.op);
    if (from != kVoid) {
        want(inst, 0, from);
        if (inst.type != conversionTo(inst.op)) add("result type does not fit the conversion");
        return;
    }
    if (inst.op == Op::Select) {
        want(inst, 0, kBool);
        want(inst, 2, operandType(inst, 1));
        if (inst.type != operandType(inst, 1) || inst.type == kVoid)
            add("result type differs from the operands");
        return;
    }
    TypeId type = operandType(inst, 0);
    for (size_t i = 1; i < inst.operands.size(); ++i)
        want(inst, i, type);
    bool ok = false;
    if (inst.op >= Op::FAdd && inst.op <= Op::FNeg)
        ok = isFloat(type);
    else if (inst.op == Op::IsFinite)
        ok = isFloat(type);
    else if (inst.op >= Op::IAdd && inst.op <= Op::INeg)
        ok = isInt(type);
    else if (inst.op == Op::FTrunc || (inst.op >= Op::FEq && inst.op <= Op::FGe))
        ok = isFloat(type);
    else if (inst.op == Op::IEq || inst.op == Op::INe)
        ok = isInt(type) || type == kBool || type == kPtr;
    else if (inst.op >= Op::ILt && inst.op <= Op::IULt)
        ok = isInt(type);
    else if (inst.op >= Op::And && inst.op <= Op::Not)
        ok = type == kBool;
    if (!ok) add(fmt::format("cannot work on type {}", type));
    TypeId result = opInfo(inst.op).result == ResultRule::Bool ? kBool : type;
    if (inst.type != result) add("result type differs from the operands");
}

void RoutineVerifier::typesOfMemory(const Inst& inst) {
    bool scalar = module_.isScalar(inst.type) && inst.type != kVoid;
    switch (inst.op) {
    case Op::Const:
        if (!scalar) add("constant that is not a scalar");
        if (inst.type == kPtr && inst.number != 0) add("the only pointer constant is 0");
        return;
    case Op::ParamVal:
        if (inst.type != routine_.params[inst.index].type) add("type differs from the parameter's");
        return;
    case Op::RoutineAddr:
        if (!module_.routines[inst.index].exported) add("address of a routine that is not exported");
        return;
    case Op::ResultAddr:
        if (module_.isScalar(routine_.result)) add("the routine has no result in memory");
        return;
    case Op::Sysvar:
        if (inst.type != kF32) add("system variables are f32");
        if (inst.extra < 0 || inst.extra > 1) add("no such system variable");
        return;
    case Op::Load:
        if (!scalar) add("loads something that is not a scalar");
        want(inst, 0, kPtr);
        return;
    case Op::Store:
        if (!scalar) add("stores something that is not a scalar");
        want(inst, 0, inst.type);
        want(inst, 1, kPtr);
        return;
    case Op::StackAlloc: want(inst, 0, kI64); return;
    case Op::CopyDynamic: want(inst, 2, kI64); [[fallthrough]];
    case Op::Copy: want(inst, 1, kPtr); [[fallthrough]];
    case Op::Zero:
        want(inst, 0, kPtr);
        if (inst.op != Op::CopyDynamic && inst.type == kVoid) add("has no type");
        return;
    case Op::ElemAddr:
        want(inst, 1, kI32);
        if (inst.type == kVoid) add("has no element type");
        [[fallthrough]];
    case Op::FieldAddr: want(inst, 0, kPtr); return;
    default: return;
    }
}

void RoutineVerifier::arguments(const Inst& inst, const std::vector<TypeId>& params, TypeId result) {
    bool inMemory = !module_.isScalar(result);
    size_t hidden = inMemory ? 1 : 0;
    if (inst.operands.size() != params.size() + hidden) {
        add(fmt::format("has {} arguments, {} are wanted", inst.operands.size(), params.size() + hidden));
        return;
    }
    if (inMemory) want(inst, 0, kPtr);
    for (size_t i = 0; i < params.size(); ++i)
        want(inst, i + hidden, params[i]);
    if (inst.type != (inMemory ? kVoid : result)) add("type differs from the result of the callee");
}

void RoutineVerifier::ret(const Inst& inst) {
    if (!reached_[block_]) return; // nothing tells whether it belongs to the undo handler
    bool value = routine_.result != kVoid && module_.isScalar(routine_.result) && !inUndo_[block_];
    if (inst.operands.size() != (value ? 1 : 0))
        add(value ? "returns no value" : "returns a value that nobody takes");
    else if (value)
        want(inst, 0, routine_.result);
}

void RoutineVerifier::typesOfControl(const Inst& inst) {
    switch (inst.op) {
    case Op::CheckFinite:
        if (!isFloat(operandType(inst, 0))) add("checks something that is not a floating-point number");
        if (inst.extra <= 0) add(fmt::format("error number {}", inst.extra));
        return;
    case Op::Check:
        want(inst, 0, kBool);
        if (inst.extra <= 0) add(fmt::format("error number {}", inst.extra));
        return;
    case Op::Call: {
        std::vector<TypeId> params;
        for (const Param& param : module_.routines[inst.index].params)
            params.push_back(param.type);
        arguments(inst, params, module_.routines[inst.index].result);
        return;
    }
    case Op::CallNative:
        arguments(inst, module_.natives[inst.index].params, module_.natives[inst.index].result);
        return;
    case Op::Charge:
    case Op::Safepoint:
        if (!inst.operands.empty()) want(inst, 0, kI64);
        if (inst.extra < 0) add("negative cost");
        return;
    case Op::CondBr: want(inst, 0, kBool); return;
    case Op::Switch: {
        want(inst, 0, kI32);
        std::vector<int32_t> values;
        for (const SwitchCase& entry : inst.cases)
            values.push_back(entry.value);
        std::sort(values.begin(), values.end());
        if (std::adjacent_find(values.begin(), values.end()) != values.end())
            add("a case value stands twice");
        return;
    }
    case Op::Ret: ret(inst); return;
    case Op::Raise:
        if (operandType(inst, 0) != kF32 && operandType(inst, 0) != kI32)
            add("error number is neither i32 nor f32");
        return;
    default: return;
    }
}

} // namespace ir
