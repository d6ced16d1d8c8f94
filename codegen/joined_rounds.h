#pragma once
// Counted loops that add up (`sum := sum + a{i} * b{i}`): an infinity stays in the sum, so one check after several rounds
// shows whether any of them overflowed. A loop that does several rounds at once is emitted before such a loop. When its check
// fails, it restores the variables of these rounds, and the original loop repeats them.

#include <optional>

#include "codegen/routine_emitter.h"
#include "ir/passes/counted_loop.h"

namespace codegen {

class JoinedRounds {
  public:
    static constexpr unsigned kRounds = 8;

    /// Nothing when the loop writes anything but private variables, branches, or keeps no sum.
    static std::optional<JoinedRounds> plan(const ir::Module& module, const ir::Routine& routine,
                                            const ir::Cfg& cfg, const ir::Loop& loop);
    /// The block that enters the loop by a jump.
    ir::BlockId entry() const { return entry_; }
    ir::BlockId header() const { return header_; }
    const ir::CountedLoop& counted() const { return counted_; }
    const std::vector<ir::ValueId>& insts() const { return insts_; }     ///< of one round
    const std::vector<uint32_t>& written() const { return written_; }    ///< locals
    const std::vector<ir::ValueId>& checked() const { return checked_; } ///< values
    /// The infinity of this value shows in the value that the next round computes.
    bool isKept(ir::ValueId value) const;

  private:
    bool read(const ir::Module& module, const ir::Routine& routine, const ir::Cfg& cfg, const ir::Loop& loop);
    bool readBody(const ir::Module& module, const ir::Routine& routine, const ir::Loop& loop);
    bool reaches(const ir::Routine& routine, ir::ValueId value, uint32_t local) const;

    ir::BlockId entry_ = ir::kNone, header_ = ir::kNone;
    ir::CountedLoop counted_;
    std::vector<ir::ValueId> insts_, checked_, kept_;
    std::vector<uint32_t> written_;
};

} // namespace codegen
