#pragma once
// Standard output and standard error that are full, or closed, end no program and lose nothing silently.

#include <string>

namespace rt {

/// To be called before anything is opened or printed. A closed stream stays closed, so no file that is opened later takes
/// its place; messages to a standard error that takes none are lost, and that is all.
void guardStandardStreams();

/// Writes what is left of standard output; the exit status of the program whose status would be `status`: BadUsage, after
/// a message in the name of `program`, when something of its output was lost.
int finishStandardOutput(const std::string& program, int status);

} // namespace rt
