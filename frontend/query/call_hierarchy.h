#pragma once
// Which routines call a routine, and which it calls; calls by name and trap routines included.

#include "frontend/query/references.h"

#include <optional>

namespace rapid::query {

struct CallItem {
    std::string name;
    std::string module;    ///< of the routine
    std::string detail;    ///< its declaration
    bool isModule = false; ///< a call in the data of a module
    Location place;        ///< name and whole declaration
    std::string key;       ///< for the next request, see item_key.h
};

struct CallEdge {
    CallItem item;                   ///< the caller, or the routine that is called
    std::vector<SourceRange> places; ///< of the calls: in the file of the caller
    bool byName = false;             ///< some of them are calls by name, which may mean others
};

/// The routine that is named at the offset, or the one around it.
std::optional<CallItem> callItemAt(const Snapshot& snapshot, const FileView& file, uint32_t offset);
/// `key`: of an item.
std::vector<CallEdge> incomingCalls(const Snapshot& snapshot, std::string_view key,
                                    const Cancel* cancel = nullptr);
std::vector<CallEdge> outgoingCalls(const Snapshot& snapshot, std::string_view key,
                                    const Cancel* cancel = nullptr);

} // namespace rapid::query
