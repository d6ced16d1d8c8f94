#pragma once
// The pages of docs/diagnostics inside the executable. rapidc_embed_files makes their definition.

#include <span>
#include <string_view>

namespace rapid::diag {

/// The texts of docs/diagnostics/RAP*.md, ascending by number.
std::span<const std::string_view> embeddedPages();

} // namespace rapid::diag
