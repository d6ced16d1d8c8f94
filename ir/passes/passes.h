#pragma once
// Transformations of the IR, one file each, and the manager that runs them in order and verifies after each.

#include <string>
#include <string_view>
#include <vector>

#include "ir/core/ir.h"

namespace ir {

enum class Profile : uint8_t {
    Release, ///< safepoints at loops and routine entries
    Stepping ///< a safepoint before every statement
};

struct PassOptions {
    Profile profile = Profile::Release;
    bool overflowChecks = true; ///< off to measure what they cost; results are then not those of a controller
};

/// Runs checkOverflow, simplifyCfg, foldConstants, simplifyCfg, mergeChecks, placeSafepoints on all routines. Returns the
/// verifier's findings, each prefixed with the pass after which it appeared ("input: " when the module came in broken);
/// empty = fine. Stops at the first pass with findings. Huge routines are verified before the passes and after the last one.
std::vector<std::string> runPasses(Module& module, const PassOptions& options);

/// The same for one routine. Parts outside of routines are not verified (verifyTables).
std::vector<std::string> runPasses(Module& module, uint32_t routine, const PassOptions& options);

/// Runs the named passes only ("check-overflow", "simplify-cfg", "fold-constants", "merge-checks", "place-safepoints"),
/// for tests and for emit.
std::vector<std::string> runPasses(Module& module, const PassOptions& options,
                                   const std::vector<std::string_view>& names);

/// Replaces parameters that get the same constant, or the address of the same global, from every call of the program. To be called
/// before the passes, when all routines are there; release profile only.
void foldParameters(Module& module);

// Passes look at nothing of other routines but their signatures, so routines may be transformed in any order.

/// Removes unreachable blocks, threads jumps through empty blocks, merges a block into its only predecessor.
void simplifyCfg(const Module& module, Routine& routine);
/// Evaluates instructions whose operands are constants, and branches on constants.
void foldConstants(Routine& routine);
/// Raises Module::overflowError where a floating-point result is out of range; does nothing when that is 0.
void checkOverflow(const Module& module, Routine& routine);
/// One look at several values in place of a check of each; release profile only.
void mergeChecks(const Module& module, Routine& routine);
/// Inserts the safepoints; the input must contain none.
void placeSafepoints(const Module& module, Routine& routine, Profile profile);

} // namespace ir
