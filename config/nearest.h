#pragma once
// Which of several names a misspelt one may mean: options, commands, errors.

#include <string>
#include <string_view>
#include <vector>

namespace rapid::config {

/// Those of `names` that `name` may be a misspelling of, nearest first, without regard to case: at most a third of the
/// letters differ.
std::vector<std::string> nearestNames(std::string_view name, const std::vector<std::string>& names);

} // namespace rapid::config
