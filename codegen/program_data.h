#pragma once
// The data of a program that is compiled in memory, and the rows of the run-time tables that list them, made without LLVM: large
// programs have tens of thousands of targets, each of which would cost LLVM more than its declaration costs the front end.

#include <llvm/Support/Memory.h>

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "codegen/codegen.h"
#include "codegen/data_image.h"
#include "ir/core/ir.h"
#include "runtime/abi/rt_abi.h"

namespace codegen {

class ProgramData {
  public:
    /// Data of another unit, which have no place here, are not allowed (canHold). The module stays as it is: rows refer to its
    /// texts.
    explicit ProgramData(const ir::Module& module);
    static bool canHold(const ir::Module& module);
    /// Places the data. False: out of memory.
    bool create();

    /// The data, and kDataRows and kAliasRows, for compiled code.
    const std::vector<NativeSymbol>& symbols() const { return symbols_; }
    /// Completes the rows: `typeOf` gives the description of a number in Module::typeDescs.
    void setTypes(const std::function<const rt::TypeDesc*(uint32_t)>& typeOf);

  private:
    bool placeData();
    std::vector<rt::GlobalDesc> rowsOf(const std::vector<DataDeclaration>& data) const;

    const ir::Module& module_;
    std::vector<DataDeclaration> listed_, listedAliases_;
    llvm::sys::OwningMemoryBlock memory_;
    std::vector<std::byte*> addresses_; ///< by index in Module::globals; null: not the program's
    std::vector<rt::GlobalDesc> rows_, aliasRows_;
    std::deque<std::string> names_;
    std::vector<NativeSymbol> symbols_;
};

} // namespace codegen
