#pragma once
// Checks a program with edits in its files: a refactoring must leave a program that still checks.

#include "frontend/edit/edit_set.h"
#include "frontend/query/snapshot.h"
#include "frontend/sema/checker.h"

namespace rapid::query {

/// The tasks with the changed files; a problem of an edit (overlap, a character that the encoding cannot hold) in `problem`.
std::vector<sema::TaskInput> withEdits(const std::vector<sema::TaskInput>& tasks,
                                       const std::vector<edit::FileEdits>& files, std::string& problem);

/// Why edits that give names another spelling would change the program: a mistake that is not there without them, or a name that would
/// mean something else. Empty: they do not.
std::string meaningProblem(const Snapshot& snapshot, const std::vector<sema::TaskInput>& tasks,
                           const sema::CheckOptions& options, const std::vector<edit::FileEdits>& files);

} // namespace rapid::query
