#pragma once
// PageFiles: the files of the web page, as the build embeds them.

#include <span>
#include <string_view>

namespace rapidc::pendant {

struct PageFile {
    std::string_view path; ///< "/app.js"; "/" is the page itself
    std::string_view type; ///< "text/javascript;charset=utf-8"
    std::string_view bytes;
};

/// Files in any order; they live as long as the program.
using PageFiles = std::span<const PageFile>;

/// A page that says that the page was not built.
PageFiles fallbackPage();

} // namespace rapidc::pendant
