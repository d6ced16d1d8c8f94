// A floating-point result beyond the range of its type is an error of the program. Infinities and NaN propagate
// through sums and products, so that a check where the value leaves an expression (is stored, passed, returned, compared,
// divided by or converted to an integer) finds what went wrong anywhere in it. Values in memory are finite. A bound of
// each magnitude shows where no check is needed: a counter that grows by 1 cannot overflow, it stops growing before.

#include <cmath>
#include <limits>

#include "ir/core/cfg.h"
#include "ir/core/op_info.h"
#include "ir/passes/passes.h"

namespace ir {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double largest(TypeId type) {
    return type == kF32 ? static_cast<double>(std::numeric_limits<float>::max())
                        : std::numeric_limits<double>::max();
}

/// Rounded to the type, as the instruction does: rounding is monotone, so a bound stays one.
double rounded(TypeId type, double value) {
    if (std::isnan(value)) return kInfinity;
    return type == kF32 ? static_cast<double>(static_cast<float>(value)) : value;
}

class OverflowChecker {
  public:
    OverflowChecker(const Module& module, Routine& routine)
        : module_(module), routine_(routine), lossy_(routine.insts.size(), false),
          bound_(routine.insts.size(), kInfinity) {}

    void run() {
        for (const Block& block : routine_.blocks)
            for (ValueId id : block.insts)
                noteUses(routine_.insts[id]);
        std::vector<bool> seen(routine_.blocks.size(), false);
        for (BlockId b : buildCfg(module_, routine_, HandlerEdges::Yes).order) {
            visit(routine_.blocks[b]);
            seen[b] = true;
        }
        // The checks may be what makes the others reachable, by TRYNEXT.
        for (BlockId b = 0; b < routine_.blocks.size(); ++b)
            if (!seen[b]) visit(routine_.blocks[b]);
    }

  private:
    const Inst& inst(ValueId id) const { return routine_.insts[id]; }

    /// Marks the operands whose infinity would not show in the result.
    void noteUses(const Inst& user) {
        if (user.op == Op::FDiv)
            lossy_[user.operands[1]] = true;
        else if (!keepsInfinity(user.op))
            for (ValueId operand : user.operands)
                lossy_[operand] = true;
    }

    /// An infinite operand makes the result infinite or NaN.
    static bool keepsInfinity(Op op) {
        switch (familyOf(op)) {
        case Family::Float: return op != Op::FTrunc;
        case Family::Convert:
            return conversionOf(op).from == NumberClass::Float && conversionOf(op).to == NumberClass::Float;
        case Family::Logic: return op == Op::Select;
        case Family::Leaf:
        case Family::Memory:
        case Family::Int:
        case Family::Compare:
        case Family::Action:
        case Family::End: return false;
        }
        return false;
    }

    void visit(Block& block) {
        std::vector<ValueId> insts;
        for (ValueId id : block.insts) {
            insts.push_back(id);
            const TypeId type = valueType(inst(id));
            if (!isFloat(type)) continue;
            bound_[id] = boundOf(inst(id), type);
            if (bound_[id] <= largest(type) || !lossy_[id]) continue;
            bound_[id] = largest(type);
            Inst check;
            check.op = Op::CheckFinite;
            check.operands = {id};
            check.extra = module_.overflowError;
            check.stmt = inst(id).stmt;
            insts.push_back(static_cast<ValueId>(routine_.insts.size()));
            routine_.insts.push_back(std::move(check));
        }
        block.insts = std::move(insts);
    }

    /// What the magnitude of the value cannot exceed; infinity: anything may come out.
    double boundOf(const Inst& value, TypeId type) const {
        switch (familyOf(value.op)) {
        case Family::Float: return boundOfFloat(value, type);
        case Family::Convert: return boundOfConversion(value, type);
        case Family::Leaf:
            return value.op == Op::Const ? rounded(type, std::abs(value.number)) : largest(type);
        case Family::Logic: // Select: no other gives a floating-point number
            return std::max(bound_[value.operands[1]], bound_[value.operands[2]]);
        case Family::Action:
            if (value.op == Op::CallNative && module_.natives[value.index].nativeClass != NativeClass::Const)
                return kInfinity;
            return largest(type);
        case Family::Memory: // memory, parameters and results of routines hold finite values
        case Family::Int:
        case Family::Compare:
        case Family::End: return largest(type);
        }
        return kInfinity;
    }

    double boundOfFloat(const Inst& value, TypeId type) const {
        const auto operand = [&](size_t i) { return bound_[value.operands[i]]; };
        switch (as<FloatOp>(value.op)) {
        case FloatOp::FAdd:
        case FloatOp::FSub: return rounded(type, operand(0) + operand(1));
        case FloatOp::FMul: return rounded(type, operand(0) * operand(1));
        case FloatOp::FDiv: {
            const Inst& divisor = inst(value.operands[1]);
            if (divisor.op != Op::Const || divisor.number == 0) return kInfinity;
            return rounded(type, operand(0) / rounded(type, std::abs(divisor.number)));
        }
        case FloatOp::FNeg:
        case FloatOp::FTrunc: return operand(0);
        }
        return kInfinity;
    }

    double boundOfConversion(const Inst& value, TypeId type) const {
        const TypeId from = valueType(inst(value.operands[0]));
        if (isInteger(from))
            return rounded(type,
                           std::ldexp(1.0, static_cast<int>(bitsOf(from)) - (value.op == Op::SIntToFloat)));
        return rounded(type, bound_[value.operands[0]]); // exact where it widens
    }

    const Module& module_;
    Routine& routine_;
    std::vector<bool> lossy_;
    std::vector<double> bound_;
};

} // namespace

void checkOverflow(const Module& module, Routine& routine) {
    if (module.overflowError != 0) OverflowChecker(module, routine).run();
}

} // namespace ir
