#pragma once
// Routines of hundreds or thousands of statements: what costs LLVM more than in proportion is kept away from them.

#include <llvm/IR/Module.h>

namespace codegen {

/// Keeps the optimiser out of huge routines, and their floating-point constants out of tables that LLVM searches from the
/// beginning. True when there are any.
bool spareHugeRoutines(llvm::Module& module);

/// Gives routines of many basic blocks that are not huge few passes, as those that are paced by natives get (kPaced).
void saveWorkOnLargeRoutines(llvm::Module& module);

} // namespace codegen
