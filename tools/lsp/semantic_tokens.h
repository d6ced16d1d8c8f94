#pragma once
// Semantic tokens in the numbers of the protocol, and the legend that explains them.

#include "tools/lsp/state.h"

namespace lsp {

Json semanticTokensProvider();

} // namespace lsp
