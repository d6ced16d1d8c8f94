#pragma once
// Entry to semantic analysis: files of all tasks in, checked program and diagnostics out.

#include "frontend/sema/checked.h"

namespace rapid::sema {

/// One declaration file of the standard library, embedded text.
struct LibraryText {
    std::string_view name;
    std::string_view text;
};

struct TaskInput {
    std::string name = "T_ROB1";
    std::string type = "NORMAL"; ///< NORMAL, STATIC, SEMISTATIC
    std::string entry = "main";
    std::vector<std::shared_ptr<const SourceFile>> files;
    bool incomplete = false; ///< modules are missing or encrypted: names that are not found are not reported
};

struct CheckOptions {
    bool requireMain = false;        ///< build and run: a task without entry routine is an error
    bool configurationKnown = false; ///< some EIO configuration was given: an unknown signal name is an error
    std::vector<SignalInfo> signals; ///< from the configuration
    std::span<const LibraryText> library;
};

/// Parses and checks. Always returns a program; `sink` tells whether it may be lowered.
std::unique_ptr<CheckedProgram> check(const std::vector<TaskInput>& tasks, const CheckOptions& options,
                                      diag::Sink& sink);

} // namespace rapid::sema
