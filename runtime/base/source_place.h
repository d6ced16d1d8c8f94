#pragma once
// SourcePlace: where in the program something happens, for people and for the event log.

#include <cstdint>
#include <string>

namespace rt {

/// The place where a task is, was, or was called from.
struct SourcePlace {
    std::string module, routine, file;
    uint32_t line = 0, column = 0; ///< from 1; 0 = not known

    /// "Module/routine:line", as programs get it (ERRSTR_CONTEXT, ReadErrData).
    std::string reference() const;
};

} // namespace rt
