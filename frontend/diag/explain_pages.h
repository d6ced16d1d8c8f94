#pragma once
// The pages of docs/diagnostics inside the executable. rapidc_embed_files makes their definition.

#include "frontend/diag/explain.h"

#include <span>
#include <string_view>

namespace rapid::diag {

/// The explanation on a page of docs/diagnostics, as written by pageOf() (explain_pages.cpp), or by hand with the title and without
/// the lines of the catalogue. Views of `page`.
Explanation readPage(std::string_view page);

/// The texts of docs/diagnostics/RAP*.md, ascending by number.
std::span<const std::string_view> embeddedPages();

} // namespace rapid::diag
