#pragma once
// Calls by a name in a string: `%"name"%`, `%"name"+NumToStr(n,0)%`, `CallByVar "name",n` (manual 1.1.5).

#include "frontend/query/meaning.h"

#include <optional>

namespace rapid::query {

/// The procedures that a call by name may mean.
struct LateCall {
    std::string module;    ///< that the string names before a colon, folded; empty: any
    std::string beginning; ///< of the name, folded; all of it when `whole`
    bool whole = false;
    bool byNumber = false; ///< CallByVar: a number follows
    SourceRange range;     ///< of the string, or of the expression
    const syntax::CallStmt* call = nullptr;
};

/// Of an instruction; none: it calls no procedure by name, or nothing is known about the name.
std::optional<LateCall> lateCallOf(const FileView& file, const syntax::CallStmt& call);
/// The call by name around an offset.
std::optional<LateCall> lateCallAt(const FileView& file, uint32_t offset);

bool mayMean(const LateCall& call, std::string_view procedure);
/// The procedures of the task that it may mean.
std::vector<const sema::RoutineSymbol*> targetsOf(const Snapshot& snapshot, const FileView& file,
                                                  const LateCall& call);

} // namespace rapid::query
