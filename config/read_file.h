#pragma once
// Reading what users name or folders hold: modules, configurations, settings, streams.

#include <string>

namespace rapid::config {

/// Files beyond 1 GB are refused: places in a text are numbers of 32 bits, and memory would run out first.
inline constexpr size_t kLargestFile = size_t{1} << 30;
/// Streams (pipes, devices) beyond this many bytes are refused.
inline constexpr size_t kLargestStream = size_t{1} << 28;

/// Reads a whole file. Pipes, devices and folders are refused, so that reading always ends.
///
/// Returns what went wrong, for people ("Permission denied", "it is a pipe, not an ordinary file"); empty: success.
[[nodiscard]] std::string readFile(const std::string& path, std::string& bytes);

/// Reads a file or a stream to its end: a pipe, a terminal, "-" or "/dev/stdin" for the standard input. A pipe that no
/// program opens for writing is given up after `waitSeconds`; a writer may take as long as it needs.
///
/// Returns what went wrong, for people; empty: success.
[[nodiscard]] std::string readStream(const std::string& path, std::string& bytes, double waitSeconds = 10);

} // namespace rapid::config
