#pragma once
// Settings of the client, section `rapidc`: {"warnings": ["no-NAME", "error=NAME", ...]}, as with -W.

#include "tools/lsp/state.h"

namespace lsp {

/// Takes over the section itself. Null means that there are none; what cannot be understood is shown to the user and left out.
void applySettings(State& state, const Json& settings);
/// Asks the client for the section; the answer is taken over when it comes.
void askForSettings(State& state);
/// workspace/didChangeConfiguration
void configurationChanged(State& state, const Json& params);

} // namespace lsp
