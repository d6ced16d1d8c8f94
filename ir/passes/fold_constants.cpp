// Evaluates instructions whose operands are constants. Exactly what the compiled code would compute: F32 in float,
// conversions saturating. Results that are not finite are left alone: the program finds out when it gets there.

#include <cmath>
#include <utility>

#include "ir/core/op_info.h"
#include "ir/passes/passes.h"

namespace ir {
namespace {

/// The value of a constant: `number` for floating point, otherwise `integer`, sign-extended.
struct Constant {
    TypeId type = kVoid;
    double number = 0;
    int64_t integer = 0;

    uint64_t bits() const { return zeroExtended(integer, bitsOf(type)); } ///< of an integer
};

/// The result is a real number in range, or there is none that can be kept.
bool keep(double value, Constant& out) {
    out.number = value;
    return std::isfinite(value);
}

/// Integers wrap.
bool keep(uint64_t value, Constant& out) {
    out.integer = out.type == kBool ? static_cast<int64_t>(value & 1) : signExtended(value, bitsOf(out.type));
    return true;
}

/// Whole numbers up to here are exact.
template <class Float>
constexpr Float kMostExact = sizeof(Float) == sizeof(float) ? Float(0x1p24) : Float(0x1p53);

template <class Float> double floatArithmetic(FloatOp op, double x, double y) {
    auto a = static_cast<Float>(x), b = static_cast<Float>(y);
    switch (op) {
    case FloatOp::FAdd: return a + b;
    case FloatOp::FSub: return a - b;
    case FloatOp::FMul: return a * b;
    case FloatOp::FDiv: return b == 0 ? std::nan("") : a / b;
    case FloatOp::FNeg: return -a;
    case FloatOp::FTrunc: return std::trunc(a);
    case FloatOp::FQuot: // the ratio of exact numbers is rounded to no other whole number
        return b == 0 || std::abs(a) > kMostExact<Float> ? std::nan("") : std::trunc(a / b);
    case FloatOp::FRem: return b == 0 ? std::nan("") : std::fmod(a, b) + Float(0);
    }
    return std::nan("");
}

/// Comparing sign-extended integers as unsigned gives the same as comparing their bits.
bool compare(CompareOp op, const Constant& a, const Constant& b) {
    const double x = a.number, y = b.number;
    const int64_t i = a.integer, j = b.integer;
    const auto u = static_cast<uint64_t>(i), v = static_cast<uint64_t>(j);
    switch (op) {
    case CompareOp::FEq: return x == y;
    case CompareOp::FNe: return x != y;
    case CompareOp::FLt: return x < y;
    case CompareOp::FLe: return x <= y;
    case CompareOp::FGt: return x > y;
    case CompareOp::FGe: return x >= y;
    case CompareOp::IEq: return i == j;
    case CompareOp::INe: return i != j;
    case CompareOp::ILt: return i < j;
    case CompareOp::ILe: return i <= j;
    case CompareOp::IGt: return i > j;
    case CompareOp::IGe: return i >= j;
    case CompareOp::IULt: return u < v;
    case CompareOp::IULe: return u <= v;
    case CompareOp::IUGt: return u > v;
    case CompareOp::IUGe: return u >= v;
    case CompareOp::IsFinite: return std::isfinite(x);
    }
    return false;
}

/// Select is dealt with before its operands are constant.
bool logic(LogicOp op, const Constant& a, const Constant& b, Constant& out) {
    const auto x = static_cast<uint64_t>(a.integer), y = static_cast<uint64_t>(b.integer);
    switch (op) {
    case LogicOp::And: return keep(x & y, out);
    case LogicOp::Or: return keep(x | y, out);
    case LogicOp::Xor: return keep(x ^ y, out);
    case LogicOp::Not: return keep(~x, out);
    case LogicOp::Select: break;
    }
    return false;
}

bool intArithmetic(IntOp op, const Constant& a, const Constant& b, Constant& out) {
    const auto x = static_cast<uint64_t>(a.integer), y = static_cast<uint64_t>(b.integer);
    const uint64_t count = y % bitsOf(a.type);
    switch (op) {
    case IntOp::IAdd: return keep(x + y, out);
    case IntOp::ISub: return keep(x - y, out);
    case IntOp::IMul: return keep(x * y, out);
    case IntOp::INeg: return keep(0 - x, out);
    case IntOp::IDiv: // by -1: a negation, which wraps
        if (y == 0) return false;
        return keep(b.integer == -1 ? 0 - x : static_cast<uint64_t>(a.integer / b.integer), out);
    case IntOp::IRem:
        if (y == 0) return false;
        return keep(b.integer == -1 ? 0 : static_cast<uint64_t>(a.integer % b.integer), out);
    case IntOp::UDiv: return y != 0 && keep(a.bits() / b.bits(), out);
    case IntOp::URem: return y != 0 && keep(a.bits() % b.bits(), out);
    case IntOp::Shl: return keep(x << count, out);
    case IntOp::Shr: return keep(a.bits() >> count, out);
    case IntOp::Sar: return keep(static_cast<uint64_t>(a.integer >> count), out);
    }
    return false;
}

/// Toward zero and saturating. The limits are powers of two: exact as floating-point numbers.
uint64_t saturated(double value, unsigned bits, bool hasSign) {
    const int magnitude = static_cast<int>(bits) - (hasSign ? 1 : 0);
    const double limit = std::ldexp(1.0, magnitude);
    const uint64_t largest = ~uint64_t{0} >> (64 - magnitude);
    if (std::isnan(value)) return 0;
    if (value >= limit) return largest;
    if (!hasSign) return value <= 0 ? 0 : static_cast<uint64_t>(value);
    return value <= -limit ? ~largest : static_cast<uint64_t>(static_cast<int64_t>(value));
}

bool convert(ConvertOp op, const Constant& a, Constant& out) {
    const auto floating = [&](auto value) {
        return keep(out.type == kF32 ? static_cast<double>(static_cast<float>(value))
                                     : static_cast<double>(value),
                    out);
    };
    switch (op) {
    case ConvertOp::SExt:
    case ConvertOp::Trunc: return keep(static_cast<uint64_t>(a.integer), out);
    case ConvertOp::ZExt: return keep(a.bits(), out);
    case ConvertOp::SIntToFloat: return floating(a.integer);
    case ConvertOp::UIntToFloat: return floating(a.bits());
    case ConvertOp::FloatToIndex:
    case ConvertOp::FloatToSInt: return keep(saturated(a.number, bitsOf(out.type), true), out);
    case ConvertOp::FloatToUInt: return keep(saturated(a.number, bitsOf(out.type), false), out);
    case ConvertOp::FWiden:
    case ConvertOp::FNarrow: return floating(a.number);
    }
    return false;
}

/// The value of an instruction whose operands are constants, in `out`, which has its type. False when it has none that can be
/// kept.
bool compute(const Inst& inst, const Constant& a, const Constant& b, Constant& out) {
    switch (familyOf(inst.op)) {
    case Family::Float:
        return keep(out.type == kF32 ? floatArithmetic<float>(as<FloatOp>(inst.op), a.number, b.number)
                                     : floatArithmetic<double>(as<FloatOp>(inst.op), a.number, b.number),
                    out);
    case Family::Int: return intArithmetic(as<IntOp>(inst.op), a, b, out);
    case Family::Compare: return keep(uint64_t{compare(as<CompareOp>(inst.op), a, b)}, out);
    case Family::Logic: return logic(as<LogicOp>(inst.op), a, b, out);
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
    Constant valueOf(ValueId id) const {
        const Inst& inst = routine_.insts[id];
        if (isFloat(inst.type)) return {inst.type, inst.number(), 0};
        return {inst.type, 0, inst.integer()};
    }

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
        const int64_t value = valueOf(inst.operands[0]).integer;
        if (inst.op == Op::CondBr && value == 0) inst.target(0) = inst.target(1);
        if (inst.op == Op::Switch)
            for (const SwitchCase& entry : std::exchange(routine_.caseLists[inst.index], {}))
                if (entry.value == value) inst.target(0) = entry.target;
        inst.op = Op::Br;
        inst.operands.clear();
        return true;
    }

    bool choose(const Inst& inst, ValueId id) {
        if (inst.op != Op::Select || !isConst(inst.operands[0])) return false;
        replacement_[id] = valueOf(inst.operands[0]).integer != 0 ? inst.operands[1] : inst.operands[2];
        return true;
    }

    bool evaluate(Inst& inst) {
        TypeId type = valueType(inst);
        if (type == kVoid || type == kPtr) return false;
        if (opInfo(inst.op).touchesMemory) return false;
        for (ValueId operand : inst.operands)
            if (!isConst(operand)) return false;
        Constant out{type};
        if (!compute(inst, out)) return false;
        inst.op = Op::Const;
        inst.type = type;
        inst.operands.clear();
        if (isFloat(type))
            inst.setNumber(out.number);
        else
            inst.setInteger(out.integer);
        inst.extra = 0;
        return true;
    }

    bool compute(const Inst& inst, Constant& out) const {
        const Constant a = valueOf(inst.operands[0]);
        const Constant b = inst.operands.size() > 1 ? valueOf(inst.operands[1]) : Constant{};
        return ir::compute(inst, a, b, out);
    }

    void dropTrueChecks() {
        auto passes = [&](ValueId id) {
            const Inst& inst = routine_.insts[id];
            if (inst.op != Op::Check && inst.op != Op::CheckFinite) return false;
            if (!isConst(inst.operands[0])) return false;
            const Constant value = valueOf(inst.operands[0]);
            return inst.op == Op::Check ? value.integer != 0 : std::isfinite(value.number);
        };
        for (Block& block : routine_.blocks)
            std::erase_if(block.insts, passes);
    }

    Routine& routine_;
    std::vector<ValueId> replacement_; ///< of a select whose condition is constant
};

} // namespace

void foldConstants(Routine& routine) {
    Folder(routine).run();
}

} // namespace ir
