#pragma once
// The files of a run: which of its options read and which write, so that nothing is overwritten.

#include "config/output_guard.h"
#include "runtime/host/run_options.h"

namespace rt {

/// Takes in every file that the options name.
void guardOutputs(const RunOptions& options, rapid::config::OutputGuard& guard);

/// The files that --state keeps in the folder.
inline constexpr const char* kStateFile = "state.json";
inline constexpr const char* kStateAside = "state.broken.json";
inline constexpr const char* kStateLock = "lock";

} // namespace rt
