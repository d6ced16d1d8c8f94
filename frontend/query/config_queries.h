#pragma once
// Queries in configuration files (EIO.cfg, SYS.cfg ...): attributes and their values, links between instances, and from signals and
// routines to the program.

#include "frontend/query/completion.h"
#include "frontend/query/config_text.h"
#include "frontend/query/hover.h"
#include "frontend/query/references.h"
#include "frontend/query/symbols.h"

namespace rapid::query {

/// Types at the beginning of a line, attributes after `-` that the instance does not have yet, values where they are known.
CompletionList configCompletionAt(const Snapshot& snapshot, const SourceFile& file, uint32_t offset);

/// Of an attribute, a type, or a signal that the program uses.
std::optional<Hover> configHoverAt(const Snapshot& snapshot, const SourceFile& file, uint32_t offset);

/// The instance that a value names (a signal of a cross connection, the task of a module), the entry routine of a task, the routine of
/// an event.
std::vector<Location> configDefinitionAt(const Snapshot& snapshot,
                                         const std::shared_ptr<const SourceFile>& file, uint32_t offset);

/// The places in programs and configuration that name the signal at the offset.
std::vector<Use> configUsesAt(const Snapshot& snapshot, const std::shared_ptr<const SourceFile>& file,
                              uint32_t offset, const Cancel* cancel = nullptr);
/// The places in configuration files that name a signal.
std::vector<Location> signalInConfiguration(const Snapshot& snapshot, std::string_view name);
/// The same of a name in a module; none when that does not mean a signal.
std::vector<Location> signalInConfiguration(const Snapshot& snapshot, const Meaning& meaning,
                                            bool withDeclaration);

/// Sections with their instances: OutlineKind::Module and ::Constant.
std::vector<OutlineSymbol> configOutline(std::string_view text);

} // namespace rapid::query
