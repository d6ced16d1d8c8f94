#pragma once
// PageFiles: the files of the web page, as the build embeds them.

#include <span>
#include <string>
#include <string_view>

namespace rapidc::pendant {

struct PageFile {
    std::string_view path; ///< "/app.js"; "/" is the page itself
    std::string_view type; ///< "text/javascript;charset=utf-8"
    std::string_view bytes;
    bool compressed = false; ///< bytes are gzip
};

/// Files in any order; they live as long as the program.
using PageFiles = std::span<const PageFile>;

/// A page that says that the page was not built.
PageFiles fallbackPage();

/// The page of web/pendant, or fallbackPage() where its packages were missing when this executable was built.
PageFiles builtPage();

/// The file for a client that does not take gzip.
std::string unpacked(const PageFile& file);

} // namespace rapidc::pendant
