#pragma once
// Texts that rapidc carries, as files an editor can open: the declarations of everything predefined, the explanations of
// diagnostics. Written on first need into a folder of the user's cache, for this version of rapidc.

#include "frontend/diag/diagnostic.h"
#include "frontend/workspace/environment.h"

#include <string>
#include <string_view>

namespace lsp {

/// $RAPIDC_CACHE, else rapidc in $XDG_CACHE_HOME or ~/.cache, else below /tmp; in it the version of rapidc.
std::string readableFolder();
/// The path of a declaration file of the library, "decl/math.sysx", which exists when this returns; "" when it cannot be written.
std::string declarationPath(const rapid::workspace::Environment& environment, std::string_view name);
/// The URI of the page about a diagnostic; "" when there is none.
std::string explanationUri(rapid::diag::Code code);

} // namespace lsp
