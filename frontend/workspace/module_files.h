#pragma once
// Module files for commands that change them one by one (fmt, rename): no tasks, no configuration.

#include "frontend/source/source_file.h"

#include <memory>
#include <string>
#include <vector>

namespace rapid::workspace {

struct ModuleFiles {
    std::vector<std::string> paths;    ///< in the order of the inputs; those of a folder sorted
    std::vector<std::string> problems; ///< inputs that are no modules
};

/// Files are taken as they are named; of a folder all modules in it and below it, encrypted ones left out.
ModuleFiles findModuleFiles(const std::vector<std::string>& inputs);

/// The module in a file; null, with `problem` set, when it cannot be read.
std::shared_ptr<const SourceFile> readModuleFile(const std::string& path, std::string& problem);

} // namespace rapid::workspace
