#pragma once
// Reading what users name or folders hold: modules, configurations, settings.

#include <string>

namespace rapid::config {

/// Files beyond 1 GB are refused: places in a text are numbers of 32 bits, and memory would run out first.
inline constexpr size_t kLargestFile = size_t{1} << 30;

/// Reads a whole file. Pipes, devices and folders are refused: they have no end, or nobody writes to them.
///
/// Returns what went wrong, for people ("Permission denied", "it is no ordinary file"); empty: success.
[[nodiscard]] std::string readFile(const std::string& path, std::string& bytes);

} // namespace rapid::config
