#pragma once
// ProgramSources: what a program was made of, as far as modules that come while it runs are compiled beside it. Built
// executables carry it along.

#include "tools/program/pipeline.h"

#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rapidc {

struct ProgramSources {
    struct Task {
        rapid::sema::TaskInput input;
        std::vector<std::vector<std::string>> modules; ///< their names, file by file
    };
    std::vector<Task> tasks; ///< their places are the numbers that the running program uses
    rapid::sema::CheckOptions options;
    std::vector<rapid::sema::LibraryText> library; ///< that the options refer to
    std::set<std::string> sharedModules;
    bool stepping = false;
    bool optimise = true;
};

/// Of a program that has been checked without errors.
std::unique_ptr<ProgramSources> sourcesOf(const Compilation& compilation, bool stepping, bool optimise);

/// The bytes that an executable carries.
std::string pack(const ProgramSources& sources);
/// Null, with the reason in `problem`, when another version of rapidc has packed them.
std::unique_ptr<ProgramSources> unpack(std::string_view bytes, std::string& problem);

} // namespace rapidc
