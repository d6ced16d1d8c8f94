#include "codegen/debug_info.h"

#include <llvm/BinaryFormat/Dwarf.h>
#include <llvm/IR/DebugInfoMetadata.h>
#include <llvm/IR/Module.h>
#include <llvm/Support/Path.h>

namespace codegen {

DebugInfo::DebugInfo(const ir::Module& module, llvm::Module& target, bool optimised)
    : module_(module), builder_(target), optimised_(optimised), files_(module.files.size()) {
    target.addModuleFlag(llvm::Module::Warning, "Debug Info Version", llvm::DEBUG_METADATA_VERSION);
    target.addModuleFlag(llvm::Module::Max, "Dwarf Version", 4);
    noFile_ = module.files.empty() ? builder_.createFile("<builtin>", ".") : file(0);
    builder_.createCompileUnit(llvm::dwarf::DW_LANG_C99, noFile_, "rapidc", optimised, "", 0, {},
                               llvm::DICompileUnit::LineTablesOnly);
    type_ = builder_.createSubroutineType(builder_.getOrCreateTypeArray({}));
}

llvm::DIFile* DebugInfo::file(uint32_t index) {
    if (index >= files_.size()) return noFile_;
    if (!files_[index]) {
        llvm::StringRef path = module_.files[index];
        llvm::StringRef directory = llvm::sys::path::parent_path(path);
        files_[index] =
            builder_.createFile(llvm::sys::path::filename(path), directory.empty() ? "." : directory);
    }
    return files_[index];
}

void DebugInfo::attach(const ir::Routine& routine, llvm::Function& function) {
    auto flags = llvm::DISubprogram::SPFlagDefinition | llvm::DISubprogram::SPFlagLocalToUnit;
    if (optimised_) flags |= llvm::DISubprogram::SPFlagOptimized;
    llvm::DIFile* place = file(routine.file);
    current_ = builder_.createFunction(place, routine.displayName, routine.name, place, routine.line, type_,
                                       routine.line, llvm::DINode::FlagPrototyped, flags);
    function.setSubprogram(current_);
}

llvm::DebugLoc DebugInfo::location(const ir::Routine& routine, ir::StmtId stmt) {
    unsigned line = routine.line, column = 0;
    if (stmt < routine.statements.size()) {
        line = routine.statements[stmt].line;
        column = routine.statements[stmt].column;
    }
    return llvm::DILocation::get(current_->getContext(), line, column, current_);
}

} // namespace codegen
