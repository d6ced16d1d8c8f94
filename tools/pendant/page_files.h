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
    bool isCompressed = false; ///< bytes are gzip
};

/// Files in any order; they live as long as the program.
using PageFiles = std::span<const PageFile>;

/// The page; where it could not be built, fallbackPage(). Generated (web/pendant/page.cmake).
PageFiles builtPage();
/// A page that says how the page is built.
PageFiles fallbackPage();
/// The bytes of a file for clients that do not take gzip.
std::string plainBytes(const PageFile& file);

} // namespace rapidc::pendant
