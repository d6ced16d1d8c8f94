#pragma once
// Bounds of the magnitudes of floating-point values, by the instructions that make them. Loops are included: what is
// stored to a local that nothing else reaches bounds what is loaded from it.

#include <limits>
#include <vector>

#include "ir/core/ir.h"

namespace ir {

/// The largest finite magnitude of F32 or F64.
double largest(TypeId type);

class ValueBounds {
  public:
    ValueBounds(const Module& module, const Routine& routine);

    /// The value may be infinite or NaN, and no value computed from it would be: it has to be checked. What has been computed
    /// from it counts on that.
    bool needsCheck(ValueId id) const { return lossy_[id] && bound_[id].magnitude == kUnbounded; }

  private:
    static constexpr double kUnbounded = std::numeric_limits<double>::infinity();

    struct Bound {
        double magnitude = 0;
        bool whole = true; ///< without fraction; never so when unbounded
    };
    /// Facts that the block has found out about a value.
    struct Known {
        BlockId notZero = kNone, whole = kNone;
    };

    const Inst& inst(ValueId id) const { return routine_.insts[id]; }
    Bound taken(ValueId id) const;
    void findPrivateLocals();
    void noteUses(const Inst& user);
    bool visit(BlockId block, bool widen);
    void noteCheck(const Inst& check);
    bool noteStore(const Inst& store, bool widen);
    uint32_t privateLocal(ValueId address) const;
    Bound boundOf(const Inst& value) const;
    Bound boundOfLeaf(const Inst& value) const;
    Bound boundOfFloat(const Inst& value) const;
    Bound boundOfConversion(const Inst& value) const;
    Bound boundOfCall(const Inst& call) const;
    double quotient(const Inst& division) const;
    bool isZero(ValueId id) const;
    bool isAtLeastOne(ValueId id) const;

    const Module& module_;
    const Routine& routine_;
    std::vector<bool> lossy_;  ///< by value: an infinity would not show in the result of some user
    std::vector<Bound> bound_; ///< by value
    std::vector<Known> known_; ///< by value
    std::vector<bool>
        private_; ///< by local: all its loads and stores are seen here; empty: no local is followed
    std::vector<Bound> local_; ///< by local
    BlockId block_ = kNone;    ///< the one in progress
};

} // namespace ir
