#pragma once
// DWARF line tables: a compile unit, a subprogram per routine, a location per statement.

#include <llvm/IR/DIBuilder.h>
#include <llvm/IR/Function.h>

#include <memory>
#include <vector>

#include "ir/core/ir.h"

namespace codegen {

class DebugInfo {
  public:
    DebugInfo(const ir::Module& module, llvm::Module& target, bool optimised);
    void attach(const ir::Routine& routine, llvm::Function& function);
    /// Place of a statement of the routine that was attached last; the routine's own line for kNone.
    llvm::DebugLoc location(const ir::Routine& routine, ir::StmtId stmt);
    void finish() { builder_.finalize(); }

  private:
    llvm::DIFile* file(uint32_t index);

    const ir::Module& module_;
    llvm::DIBuilder builder_;
    bool optimised_;
    std::vector<llvm::DIFile*> files_;
    llvm::DIFile* noFile_ = nullptr;
    llvm::DISubroutineType* type_ = nullptr;
    llvm::DISubprogram* current_ = nullptr;
};

} // namespace codegen
