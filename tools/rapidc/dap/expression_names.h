#pragma once
// The names that a text mentions, before anybody knows what they mean.

#include <set>
#include <string>
#include <string_view>

namespace rapidc::dap {

/// In upper case; what stands in strings and comments does not count.
std::set<std::string> namesIn(std::string_view text);

} // namespace rapidc::dap
