#pragma once
// Text inside of SVG and HTML.

#include <string>
#include <string_view>

namespace rt::report {

/// With the characters that mean something there written as entities.
std::string escaped(std::string_view text);

} // namespace rt::report
