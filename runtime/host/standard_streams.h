#pragma once
// Standard output and standard error that are full, or closed, end no program and lose nothing silently.

#include <string>

namespace rt {

/// To be called before anything is opened or printed. A closed stream stays closed, so no file that is opened later takes
/// its place; messages to a standard error that takes none are lost, and that is all.
void guardStandardStreams();

/// To be called first. A write beyond the largest file that is allowed (ulimit -f) fails instead of ending the process. When
/// memory runs out, the process says so and ends with kOutOfMemory; `program` stays valid.
void guardLimits(const char* program);

/// Exit status when the machine, or a limit of the process, has no memory left.
inline constexpr int kOutOfMemory = 5;

/// Says in the name of the program that memory has run out, and ends the process. Needs no memory itself.
[[noreturn]] void endOutOfMemory();

/// Writes what is left of standard output; the exit status of the program whose status would be `status`: BadUsage, after
/// a message in the name of `program`, when something of its output was lost.
int finishStandardOutput(const std::string& program, int status);

} // namespace rt
