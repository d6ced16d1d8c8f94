// Evaluates instructions whose operands are constants. Exactly what the compiled code would compute: F32 in float,
// conversions saturating. Results that are not finite are left alone: the program finds out when it gets there.

#include <cmath>
#include <limits>

#include "ir/core/op_info.h"
#include "ir/passes/passes.h"

namespace ir {
namespace {

template <class Int> double saturate(double value) {
    if (std::isnan(value)) return 0;
    if (value <= static_cast<double>(std::numeric_limits<Int>::min()))
        return double(std::numeric_limits<Int>::min());
    if (value >= static_cast<double>(std::numeric_limits<Int>::max()))
        return double(std::numeric_limits<Int>::max());
    return std::trunc(value);
}

/// Integers beyond this are not exact in Inst::number.
constexpr double kExact = 9007199254740992.0;

template <class Float> bool floatArithmetic(Op op, double x, double y, double& out) {
    auto a = static_cast<Float>(x), b = static_cast<Float>(y);
    switch (op) {
    case Op::FAdd: out = a + b; return true;
    case Op::FSub: out = a - b; return true;
    case Op::FMul: out = a * b; return true;
    case Op::FDiv: out = b == 0 ? std::nan("") : a / b; return true;
    case Op::FNeg: out = -a; return true;
    case Op::FTrunc: out = std::trunc(a); return true;
    default: return false;
    }
}

bool compare(Op op, double a, double b, double& out) {
    switch (op) {
    case Op::FEq:
    case Op::IEq: out = a == b; return true;
    case Op::FNe:
    case Op::INe: out = a != b; return true;
    case Op::FLt:
    case Op::ILt: out = a < b; return true;
    case Op::FLe:
    case Op::ILe: out = a <= b; return true;
    case Op::FGt:
    case Op::IGt: out = a > b; return true;
    case Op::FGe:
    case Op::IGe: out = a >= b; return true;
    case Op::IULt: out = static_cast<uint64_t>(int64_t(a)) < static_cast<uint64_t>(int64_t(b)); return true;
    case Op::And: out = a != 0 && b != 0; return true;
    case Op::Or: out = a != 0 || b != 0; return true;
    case Op::Xor: out = (a != 0) != (b != 0); return true;
    case Op::Not: out = a == 0; return true;
    default: return false;
    }
}

bool intArithmetic(Op op, TypeId type, double x, double y, double& out) {
    auto a = static_cast<int64_t>(x), b = static_cast<int64_t>(y);
    int64_t result = 0;
    bool overflow = false;
    switch (op) {
    case Op::IAdd: overflow = __builtin_add_overflow(a, b, &result); break;
    case Op::ISub: overflow = __builtin_sub_overflow(a, b, &result); break;
    case Op::IMul: overflow = __builtin_mul_overflow(a, b, &result); break;
    case Op::INeg: overflow = __builtin_sub_overflow(int64_t{0}, a, &result); break;
    case Op::IDiv:
        if (b == 0 || b == -1) return false;
        result = a / b;
        break;
    case Op::IRem:
        if (b == 0 || b == -1) return false;
        result = a % b;
        break;
    default: return false;
    }
    if (overflow) return false;
    out = type == kI32 ? static_cast<double>(static_cast<int32_t>(result)) : static_cast<double>(result);
    return std::abs(out) <= kExact;
}

bool convert(Op op, double value, double& out) {
    switch (op) {
    case Op::I32ToF32:
    case Op::F64ToF32: out = static_cast<float>(value); return true;
    case Op::I64ToF32: out = static_cast<float>(static_cast<int64_t>(value)); return true;
    case Op::F32ToIndex:
    case Op::F64ToIndex:
    case Op::F32ToI32:
    case Op::F64ToI32: out = saturate<int32_t>(value); return true;
    case Op::F32ToI64:
    case Op::F64ToI64: out = saturate<int64_t>(value); return std::abs(out) <= kExact;
    case Op::I64ToI32:
        out = static_cast<int32_t>(static_cast<uint32_t>(static_cast<int64_t>(value)));
        return true;
    case Op::I32ToF64:
    case Op::I64ToF64:
    case Op::F32ToF64:
    case Op::I32ToI64: out = value; return true;
    default: return false;
    }
}

class Folder {
  public:
    explicit Folder(Routine& routine) : routine_(routine), replacement_(routine.insts.size(), kNone) {}

    void run() {
        for (bool changed = true; changed;) {
            changed = false;
            for (Block& block : routine_.blocks)
                for (ValueId id : block.insts)
                    changed = visit(id) || changed;
        }
        dropTrueChecks();
    }

  private:
    bool isConst(ValueId id) const { return routine_.insts[id].op == Op::Const; }
    double numberOf(ValueId id) const { return routine_.insts[id].number; }

    bool visit(ValueId id) {
        Inst& inst = routine_.insts[id];
        if (inst.op == Op::Const) return false;
        bool changed = false;
        for (ValueId& operand : inst.operands) {
            while (replacement_[operand] != kNone) {
                operand = replacement_[operand];
                changed = true;
            }
        }
        if (inst.operands.empty() || replacement_[id] != kNone) return changed;
        return branch(inst) || choose(inst, id) || evaluate(inst) || changed;
    }

    bool branch(Inst& inst) {
        if ((inst.op != Op::CondBr && inst.op != Op::Switch) || !isConst(inst.operands[0])) return false;
        double value = numberOf(inst.operands[0]);
        BlockId target = inst.op == Op::CondBr && value == 0 ? inst.target[1] : inst.target[0];
        for (const SwitchCase& entry : inst.cases)
            if (entry.value == value) target = entry.target;
        inst.op = Op::Br;
        inst.operands.clear();
        inst.cases.clear();
        inst.target[0] = target;
        inst.target[1] = kNone;
        return true;
    }

    bool choose(const Inst& inst, ValueId id) {
        if (inst.op != Op::Select || !isConst(inst.operands[0])) return false;
        replacement_[id] = numberOf(inst.operands[0]) != 0 ? inst.operands[1] : inst.operands[2];
        return true;
    }

    bool evaluate(Inst& inst) {
        TypeId type = valueType(inst);
        if (type == kVoid || type == kPtr || opInfo(inst.op).touchesMemory) return false;
        for (ValueId operand : inst.operands)
            if (!isConst(operand)) return false;
        double a = numberOf(inst.operands[0]);
        double b = inst.operands.size() > 1 ? numberOf(inst.operands[1]) : 0;
        double out = 0;
        bool done = compare(inst.op, a, b, out) || convert(inst.op, a, out);
        if (!done && type == kF32) done = floatArithmetic<float>(inst.op, a, b, out);
        if (!done && type == kF64) done = floatArithmetic<double>(inst.op, a, b, out);
        if (!done && (type == kI32 || type == kI64)) done = intArithmetic(inst.op, type, a, b, out);
        if (!done || !std::isfinite(out)) return false;
        inst.op = Op::Const;
        inst.type = type;
        inst.operands.clear();
        inst.number = out;
        inst.extra = 0;
        return true;
    }

    void dropTrueChecks() {
        auto passes = [&](ValueId id) {
            const Inst& inst = routine_.insts[id];
            if (inst.op != Op::Check && inst.op != Op::CheckFinite) return false;
            if (!isConst(inst.operands[0])) return false;
            const double number = numberOf(inst.operands[0]);
            return inst.op == Op::Check ? number != 0 : std::isfinite(number);
        };
        for (Block& block : routine_.blocks)
            std::erase_if(block.insts, passes);
    }

    Routine& routine_;
    std::vector<ValueId> replacement_; ///< of a select whose condition is constant
};

} // namespace

void foldConstants(Module& module) {
    for (Routine& routine : module.routines)
        Folder(routine).run();
}

} // namespace ir
