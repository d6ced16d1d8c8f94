#pragma once
// Reader of program files (.pgf): the XML list of modules that a controller writes beside a program (manual 1.1.3).

#include <string>
#include <string_view>
#include <vector>

namespace rapid::project {

/// Module file names in a program file, in order, with '/' between folders. False: it is not a program file, or truncated.
bool readProgramFile(std::string_view text, std::vector<std::string>& modules);

} // namespace rapid::project
