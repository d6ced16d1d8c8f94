#pragma once
// Types of several tasks that have to stay alike because the tasks share persistents of them.

#include "frontend/query/meaning.h"

namespace rapid::query {

/// The record, or the component of a record, in every task that shares a persistent made of it: `meaning` first. Types of a
/// shared persistent have the same names and components in all tasks, though each task may declare them in a file of its own
/// (manual 1.20). Just `meaning` for everything else.
std::vector<Meaning> alikeInAllTasks(const Snapshot& snapshot, const Meaning& meaning);

} // namespace rapid::query
