// Parameters that get the same constant from every call: dimensions of arrays above all. LLVM finds them only where it sees all calls at
// once, which it does in small programs.

#include <vector>

#include "ir/passes/passes.h"

namespace ir {
namespace {

class ConstantParameters {
  public:
    explicit ConstantParameters(Module& module) : module_(module), params_(module.routines.size()) {
        for (size_t r = 0; r < params_.size(); ++r)
            params_[r].resize(module.routines[r].params.size());
    }

    void run() {
        const std::vector<bool> hasUnknownCalls = module_.calledFromOutside();
        for (uint32_t r = 0; r < params_.size(); ++r)
            if (hasUnknownCalls[r]) letVary(r);
        for (uint32_t r = 0; r < params_.size(); ++r)
            for (const Block& block : module_.routines[r].blocks)
                for (const ValueId id : block.insts)
                    look(r, module_.routines[r].insts[id]);
        spread();
        for (uint32_t r = 0; r < params_.size(); ++r)
            replace(r);
    }

  private:
    struct Place {
        uint32_t routine, param;
    };
    struct Parameter {
        enum : uint8_t { Unseen, Constant, Varying } state = Unseen;
        Inst value;                  ///< Constant: as the caller computes it
        std::vector<Place> passedOn; ///< the parameters that it is passed to
    };

    Parameter& at(Place place) { return params_[place.routine][place.param]; }

    void letVary(uint32_t routine) {
        for (uint32_t p = 0; p < params_[routine].size(); ++p)
            meet({routine, p}, nullptr);
    }

    void look(uint32_t caller, const Inst& inst) {
        if (inst.op == Op::RoutineAddr) letVary(inst.index);
        if (inst.op != Op::Call) return;
        const uint32_t result = module_.isScalar(module_.routines[inst.index].result) ? 0 : 1; // its address
        for (uint32_t p = 0; p < params_[inst.index].size(); ++p) {
            const Inst& passed = module_.routines[caller].insts[inst.operands[p + result]];
            if (passed.op == Op::ParamVal)
                params_[caller][passed.index].passedOn.push_back({inst.index, p});
            else
                meet({inst.index, p}, isConstant(passed) ? &passed : nullptr);
        }
    }

    /// The parameter gets this value (null: another one each time) from one more call.
    void meet(Place place, const Inst* value) {
        Parameter& param = at(place);
        if (param.state == Parameter::Varying) return;
        if (param.state == Parameter::Constant && value && isSame(param.value, *value)) return;
        const bool isFirst = param.state == Parameter::Unseen && value;
        param.state = isFirst ? Parameter::Constant : Parameter::Varying;
        if (isFirst) param.value = *value;
        changed_.push_back(place);
    }

    void spread() {
        while (!changed_.empty()) {
            const Parameter& param = at(changed_.back());
            changed_.pop_back();
            for (const Place next : param.passedOn)
                meet(next, param.state == Parameter::Constant ? &param.value : nullptr);
        }
    }

    void replace(uint32_t routine) {
        for (const Block& block : module_.routines[routine].blocks) {
            for (const ValueId id : block.insts) {
                Inst& inst = module_.routines[routine].insts[id];
                if (inst.op != Op::ParamVal) continue;
                const Parameter& param = params_[routine][inst.index];
                if (param.state != Parameter::Constant) continue;
                const StmtId stmt = inst.stmt;
                inst = param.value;
                inst.stmt = stmt;
            }
        }
    }

    static bool isConstant(const Inst& inst) { return inst.op == Op::Const || inst.op == Op::GlobalAddr; }
    static bool isSame(const Inst& a, const Inst& b) {
        if (a.op != b.op || a.type != b.type) return false;
        return a.op == Op::Const ? a.integer() == b.integer() : a.index == b.index; // numbers: by their bits
    }

    Module& module_;
    std::vector<std::vector<Parameter>> params_;
    std::vector<Place> changed_;
};

} // namespace

void foldParameters(Module& module) {
    ConstantParameters(module).run();
}

} // namespace ir
