#pragma once
// Data of the program as they lie in memory, and how they are declared.

#include <string>
#include <vector>

#include "ir/core/ir.h"

namespace codegen {

/// Symbols of a routine and of data.
std::string symbolOf(const ir::Routine& routine);
std::string symbolOf(const ir::Global& global);

/// Declared by the program. The others are constants that the compiler made: they are part of the code that uses them, because
/// their numbers change with every edit.
bool isNamedData(const ir::Global& global);

/// The initial value: as many bytes as the type has. Data of another unit have none.
std::string initialBytes(const ir::Module& module, const ir::Global& global);
/// In bytes; vector instructions may read what is large enough.
uint32_t alignmentOf(const ir::Module& module, const ir::Global& global);

/// One place where data are declared.
struct DataDeclaration {
    uint32_t global; ///< index into Module::globals
    const std::string &name, &moduleName;
    uint32_t task, file, line;
};
/// The rows of the run-time tables: all data that can be asked for by name, and further declarations of shared ones.
std::vector<DataDeclaration> listedData(const ir::Module& module);
std::vector<DataDeclaration> listedAliases(const ir::Module& module);

/// A task as the run-time tables say it: -1 = shared.
inline int32_t taskNumber(uint32_t task) {
    return task == ir::kNone ? -1 : static_cast<int32_t>(task);
}

} // namespace codegen
