#pragma once
// --task=NAME[:TYPE]=INPUT[,INPUT]: what the command line says of tasks.

#include "frontend/project/project.h"

#include <set>
#include <string>
#include <vector>

namespace rapid::workspace {

/// Reads the values of --task. Several for one task add up. `typesTold` gets the tasks whose type is given; what cannot
/// be read is added to `problems`.
std::vector<project::TaskSpec> readTaskSpecs(const std::vector<std::string>& options,
                                             std::set<std::string>& typesTold,
                                             std::vector<std::string>& problems);

} // namespace rapid::workspace
