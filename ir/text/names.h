#pragma once
// Words of the textual form that printer and parser share. Order = the enums of ir.h.

#include <string_view>

#include "ir/core/ir.h"

namespace ir {

inline constexpr std::string_view kDescKindNames[] = {"float",  "double", "bool",   "string",
                                                      "record", "array",  "handle", "other"};
inline constexpr std::string_view kGlobalKindNames[] = {"var", "persistent", "const", "external"};
inline constexpr std::string_view kStmtKindNames[] = {"plain",   "call",   "motion",
                                                      "control", "return", "handler"};
inline constexpr std::string_view kRoutineKindNames[] = {"procedure", "function", "interrupt"};
inline constexpr std::string_view kSysvarNames[] = {"error", "interrupt"};
inline constexpr std::string_view kParamModeNames[] = {"in", "variable", "persistent", "either"};

/// The name by which the textual form refers to an item.
inline const std::string& nameOf(const Global& global) {
    return global.name;
}
inline const std::string& nameOf(const Routine& routine) {
    return routine.name;
}
inline const std::string& nameOf(const Native& native) {
    return native.symbol;
}

} // namespace ir
