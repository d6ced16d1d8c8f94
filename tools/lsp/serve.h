#pragma once
// The server on standard input and output: one thread reads, one works.

#include "frontend/workspace/environment.h"

#include <string>
#include <vector>

namespace lsp {

/// Serves the client at the other end until it says exit, closes its end, or dies. The exit status of the process. `warnings`:
/// options as those of -W, which hold unless the client has settings.
int serve(const rapid::workspace::Environment& environment, const std::vector<std::string>& warnings);

} // namespace lsp
