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

template <class Float> double floatArithmetic(FloatOp op, double x, double y) {
    auto a = static_cast<Float>(x), b = static_cast<Float>(y);
    switch (op) {
    case FloatOp::FAdd: return a + b;
    case FloatOp::FSub: return a - b;
    case FloatOp::FMul: return a * b;
    case FloatOp::FDiv: return b == 0 ? std::nan("") : a / b;
    case FloatOp::FNeg: return -a;
    case FloatOp::FTrunc: return std::trunc(a);
    }
    return std::nan("");
}

bool compare(CompareOp op, double a, double b) {
    switch (op) {
    case CompareOp::FEq:
    case CompareOp::IEq: return a == b;
    case CompareOp::FNe:
    case CompareOp::INe: return a != b;
    case CompareOp::FLt:
    case CompareOp::ILt: return a < b;
    case CompareOp::FLe:
    case CompareOp::ILe: return a <= b;
    case CompareOp::FGt:
    case CompareOp::IGt: return a > b;
    case CompareOp::FGe:
    case CompareOp::IGe: return a >= b;
    case CompareOp::IULt: return static_cast<uint64_t>(int64_t(a)) < static_cast<uint64_t>(int64_t(b));
    case CompareOp::IsFinite: return std::isfinite(a);
    }
    return false;
}

/// Select is dealt with before its operands are constant.
bool logic(LogicOp op, bool a, bool b) {
    switch (op) {
    case LogicOp::And: return a && b;
    case LogicOp::Or: return a || b;
    case LogicOp::Xor: return a != b;
    case LogicOp::Not: return !a;
    case LogicOp::Select: break;
    }
    return false;
}

bool intArithmetic(IntOp op, TypeId type, double x, double y, double& out) {
    auto a = static_cast<int64_t>(x), b = static_cast<int64_t>(y);
    int64_t result = 0;
    bool overflow = false;
    switch (op) {
    case IntOp::IAdd: overflow = __builtin_add_overflow(a, b, &result); break;
    case IntOp::ISub: overflow = __builtin_sub_overflow(a, b, &result); break;
    case IntOp::IMul: overflow = __builtin_mul_overflow(a, b, &result); break;
    case IntOp::INeg: overflow = __builtin_sub_overflow(int64_t{0}, a, &result); break;
    case IntOp::IDiv:
        if (b == 0 || b == -1) return false;
        result = a / b;
        break;
    case IntOp::IRem:
        if (b == 0 || b == -1) return false;
        result = a % b;
        break;
    }
    if (overflow) return false;
    out = type == kI32 ? static_cast<double>(static_cast<int32_t>(result)) : static_cast<double>(result);
    return std::abs(out) <= kExact;
}

bool convert(ConvertOp op, double value, double& out) {
    switch (op) {
    case ConvertOp::I32ToF32:
    case ConvertOp::F64ToF32: out = static_cast<float>(value); return true;
    case ConvertOp::I64ToF32: out = static_cast<float>(static_cast<int64_t>(value)); return true;
    case ConvertOp::F32ToIndex:
    case ConvertOp::F64ToIndex:
    case ConvertOp::F32ToI32:
    case ConvertOp::F64ToI32: out = saturate<int32_t>(value); return true;
    case ConvertOp::F32ToI64:
    case ConvertOp::F64ToI64: out = saturate<int64_t>(value); return std::abs(out) <= kExact;
    case ConvertOp::I64ToI32:
        out = static_cast<int32_t>(static_cast<uint32_t>(static_cast<int64_t>(value)));
        return true;
    case ConvertOp::I32ToF64:
    case ConvertOp::I64ToF64:
    case ConvertOp::F32ToF64:
    case ConvertOp::I32ToI64: out = value; return true;
    }
    return false;
}

/// The value of an instruction whose operands are constants. False when it has none that can be kept.
bool compute(const Inst& inst, TypeId type, double a, double b, double& out) {
    switch (familyOf(inst.op)) {
    case Family::Float:
        out = type == kF32 ? floatArithmetic<float>(as<FloatOp>(inst.op), a, b)
                           : floatArithmetic<double>(as<FloatOp>(inst.op), a, b);
        return true;
    case Family::Int: return intArithmetic(as<IntOp>(inst.op), type, a, b, out);
    case Family::Compare: out = compare(as<CompareOp>(inst.op), a, b); return true;
    case Family::Logic: out = logic(as<LogicOp>(inst.op), a != 0, b != 0); return inst.op != Op::Select;
    case Family::Convert: return convert(as<ConvertOp>(inst.op), a, out);
    case Family::Leaf:
    case Family::Memory:
    case Family::Action:
    case Family::End: return false;
    }
    return false;
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
        if (!compute(inst, type, a, b, out) || !std::isfinite(out)) return false;
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

void foldConstants(const Module&, Routine& routine) {
    Folder(routine).run();
}

} // namespace ir
