#pragma once
// Wrong usage of a command: reported to standard error, with exit status 3.

#include "runtime/host/run_options.h"

#include <cstdio>
#include <fmt/format.h>
#include <string>
#include <vector>

namespace rapidc {

inline constexpr int kBadUsage = static_cast<int>(rt::ExitStatus::BadUsage);

/// Reports a problem as "rapidc COMMAND: PROBLEM". Returns the exit status.
inline int usageError(const char* command, const std::string& problem) {
    fmt::print(stderr, "rapidc {}: {}\n", command, problem);
    return kBadUsage;
}

/// The same for several problems.
inline int usageErrors(const char* command, const std::vector<std::string>& problems) {
    for (const std::string& problem : problems)
        usageError(command, problem);
    return kBadUsage;
}

} // namespace rapidc
