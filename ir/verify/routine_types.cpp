// The typing rules of the instructions.

#include <fmt/format.h>

#include <algorithm>

#include "ir/core/op_info.h"
#include "ir/verify/routine_verifier.h"

namespace ir {
TypeId RoutineVerifier::operandType(const Inst& inst, size_t operand) const {
    return valueType(routine_.insts[inst.operands[operand]]);
}

void RoutineVerifier::want(const Inst& inst, size_t operand, TypeId type) {
    TypeId found = operandType(inst, operand);
    if (found != type)
        add(fmt::format("operand {} is {} where {} is wanted", operand, typeName(found), typeName(type)));
}

void RoutineVerifier::types(const Inst& inst) {
    switch (familyOf(inst.op)) {
    case Family::Leaf: typesOfLeaf(inst); return;
    case Family::Memory: typesOfMemory(inst); return;
    case Family::Float: sameTypes(inst, isFloat(operandType(inst, 0))); return;
    case Family::Int: sameTypes(inst, isInteger(operandType(inst, 0))); return;
    case Family::Compare: typesOfComparison(inst); return;
    case Family::Logic: typesOfLogic(inst); return;
    case Family::Convert:
        if (!converts(inst.op, operandType(inst, 0), inst.type))
            add(fmt::format("cannot turn {} into {}", typeName(operandType(inst, 0)), typeName(inst.type)));
        return;
    case Family::Action: typesOfAction(inst); return;
    case Family::End: typesOfEnd(inst); return;
    }
}

/// All operands have the type of the first; the result has it as well, or is Bool. `fits`: the instruction works on that type.
void RoutineVerifier::sameTypes(const Inst& inst, bool fits) {
    const TypeId type = operandType(inst, 0);
    for (size_t i = 1; i < inst.operands.size(); ++i)
        want(inst, i, type);
    if (!fits) add(fmt::format("cannot work on {}", typeName(type)));
    const TypeId result = opInfo(inst.op).result == ResultRule::Bool ? kBool : type;
    if (inst.type != result) add("result type differs from the operands");
}

void RoutineVerifier::typesOfComparison(const Inst& inst) {
    const TypeId type = operandType(inst, 0);
    switch (as<CompareOp>(inst.op)) {
    case CompareOp::FEq:
    case CompareOp::FNe:
    case CompareOp::FLt:
    case CompareOp::FLe:
    case CompareOp::FGt:
    case CompareOp::FGe:
    case CompareOp::IsFinite: return sameTypes(inst, isFloat(type));
    case CompareOp::IEq:
    case CompareOp::INe: return sameTypes(inst, isInteger(type) || type == kBool || type == kPtr);
    case CompareOp::ILt:
    case CompareOp::ILe:
    case CompareOp::IGt:
    case CompareOp::IGe:
    case CompareOp::IULt:
    case CompareOp::IULe:
    case CompareOp::IUGt:
    case CompareOp::IUGe: return sameTypes(inst, isInteger(type));
    }
}

void RoutineVerifier::typesOfLogic(const Inst& inst) {
    switch (as<LogicOp>(inst.op)) {
    case LogicOp::And:
    case LogicOp::Or:
    case LogicOp::Xor:
    case LogicOp::Not: {
        const TypeId type = operandType(inst, 0);
        return sameTypes(inst, type == kBool || isInteger(type));
    }
    case LogicOp::Select:
        want(inst, 0, kBool);
        want(inst, 2, operandType(inst, 1));
        if (inst.type != operandType(inst, 1) || inst.type == kVoid)
            add("result type differs from the operands");
        return;
    }
}

void RoutineVerifier::typesOfLeaf(const Inst& inst) {
    switch (as<LeafOp>(inst.op)) {
    case LeafOp::Const:
        if (!module_.isScalar(inst.type) || inst.type == kVoid) add("constant that is not a scalar");
        if (inst.type == kPtr && inst.integer() != 0) add("the only pointer constant is 0");
        if (isInteger(inst.type) &&
            signExtended(static_cast<uint64_t>(inst.integer()), bitsOf(inst.type)) != inst.integer())
            add(fmt::format("{} is not a value of {}", inst.integer(), typeName(inst.type)));
        return;
    case LeafOp::ParamVal:
        if (inst.type != routine_.params[inst.index].type) add("type differs from the parameter's");
        return;
    case LeafOp::RoutineAddr:
        if (!module_.routines[inst.index].exported) add("address of a routine that is not exported");
        return;
    case LeafOp::ResultAddr:
        if (module_.isScalar(routine_.result)) add("the routine has no result in memory");
        return;
    case LeafOp::Sysvar:
        if (inst.type != kI32) add("system variables are i32");
        if (inst.extra < 0 || inst.extra > 1) add("no such system variable");
        return;
    case LeafOp::LocalAddr:
    case LeafOp::GlobalAddr:
    case LeafOp::TypeDescAddr: return;
    }
}

void RoutineVerifier::typesOfMemory(const Inst& inst) {
    const bool scalar = module_.isScalar(inst.type) && inst.type != kVoid;
    switch (as<MemoryOp>(inst.op)) {
    case MemoryOp::Load:
        if (!scalar) add("loads something that is not a scalar");
        want(inst, 0, kPtr);
        return;
    case MemoryOp::Store:
        if (!scalar) add("stores something that is not a scalar");
        want(inst, 0, inst.type);
        want(inst, 1, kPtr);
        return;
    case MemoryOp::StackAlloc: want(inst, 0, kI64); return;
    case MemoryOp::CopyDynamic: want(inst, 2, kI64); [[fallthrough]];
    case MemoryOp::Copy: want(inst, 1, kPtr); [[fallthrough]];
    case MemoryOp::Zero:
        want(inst, 0, kPtr);
        if (inst.op != Op::CopyDynamic && inst.type == kVoid) add("has no type");
        return;
    case MemoryOp::ElemAddr:
        want(inst, 1, kI32);
        if (inst.type == kVoid) add("has no element type");
        [[fallthrough]];
    case MemoryOp::FieldAddr: want(inst, 0, kPtr); return;
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
    if (!reached_[block_]) return; // it is not known whether it belongs to the undo handler
    bool value = routine_.result != kVoid && module_.isScalar(routine_.result) && !inUndo_[block_];
    if (inst.operands.size() != (value ? 1 : 0))
        add(value ? "returns no value" : "returns a value that is not used");
    else if (value)
        want(inst, 0, routine_.result);
}

void RoutineVerifier::typesOfAction(const Inst& inst) {
    switch (as<ActionOp>(inst.op)) {
    case ActionOp::CheckFinite:
        if (!isFloat(operandType(inst, 0))) add("checks something that is not a floating-point number");
        if (inst.extra <= 0) add(fmt::format("error number {}", inst.extra));
        return;
    case ActionOp::Check:
        want(inst, 0, kBool);
        if (inst.extra <= 0) add(fmt::format("error number {}", inst.extra));
        return;
    case ActionOp::Call: {
        std::vector<TypeId> params;
        for (const Param& param : module_.routines[inst.index].params)
            params.push_back(param.type);
        arguments(inst, params, module_.routines[inst.index].result);
        return;
    }
    case ActionOp::CallNative:
        arguments(inst, module_.natives[inst.index].params, module_.natives[inst.index].result);
        return;
    case ActionOp::Charge:
    case ActionOp::Safepoint:
        if (!inst.operands.empty()) want(inst, 0, kI64);
        if (inst.extra < 0) add("negative cost");
        return;
    case ActionOp::Stmt:
    case ActionOp::Step: return;
    }
}

void RoutineVerifier::typesOfEnd(const Inst& inst) {
    switch (as<EndOp>(inst.op)) {
    case EndOp::CondBr: want(inst, 0, kBool); return;
    case EndOp::Switch: {
        want(inst, 0, kI32);
        std::vector<int32_t> values;
        for (const SwitchCase& entry : routine_.caseLists[inst.index])
            values.push_back(entry.value);
        std::sort(values.begin(), values.end());
        if (std::adjacent_find(values.begin(), values.end()) != values.end())
            add("a case value is listed twice");
        return;
    }
    case EndOp::Ret: ret(inst); return;
    case EndOp::Raise: want(inst, 0, kI32); return;
    case EndOp::Br:
    case EndOp::Propagate:
    case EndOp::Retry:
    case EndOp::TryNext:
    case EndOp::HandlerEnd:
    case EndOp::Unreachable: return;
    }
}

} // namespace ir
