#pragma once
// The location of a data object that a program names by a text (GetDataVal, SetDataVal, SetAllDataVal).

#include "runtime/debug/debug_data.h"
#include "runtime/host/controller.h"

#include <string>
#include <string_view>
#include <vector>

namespace rt::lib {

/// The object that a datapos refers to.
struct DataPosition {
    std::string module;
    std::string routine; ///< "" for module data
    int32_t task = -1;
    bool operator==(const DataPosition&) const = default;
};

/// The positions given out by GetNextSym; a handle is the number of one, from 1.
class DataPositions {
  public:
    Handle handleOf(const DataPosition& position);
    /// Null for a handle that was never given out.
    const DataPosition* find(Handle handle) const;

  private:
    std::vector<DataPosition> positions_;
};

/// Data of the routine that `task` executes, innermost first; those of callers only with `all`. Routines that do not reach
/// for data by name are not described and give nothing.
std::vector<DebugVariable> routineData(const Task& task, bool all);

/// May the program write it? "" or why not.
std::string writeProtection(const DebugVariable& variable);

/// Copies between an object and a value of type `type`: kOk, ERR_SYMBOL_TYPE or ERR_INVDIM.
Status copyData(TaskCore* task, const DebugVariable& object, void* value, const TypeDesc& type, bool write);

} // namespace rt::lib
