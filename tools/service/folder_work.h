#pragma once
// Work on the entries of an open folder of the host, by name and without following links: nothing outside of it can be reached,
// whatever happens to links and folders meanwhile. Results are 0 or the number of the error.

#include <string>
#include <string_view>
#include <vector>

namespace rapidc::service {

/// The names in a folder that is open for reading, without "." and "..". False with errno when they cannot be read.
bool namesIn(int folder, std::vector<std::string>& names);
/// The name of a temporary file or folder of this program: what was not finished.
bool isUnfinished(std::string_view name);

/// Removes a file, a link, or a folder with all that it holds.
int removeIn(int folder, const std::string& name);
/// Copies a file or a folder with all that it holds, beside it. Links in it are left out. The copy is complete or absent.
int copyIn(int folder, const std::string& name, const std::string& target);
/// Copies all entries of an open folder into another one, except the folder of the host `except` (which may lie in it) and what is not
/// finished. Links are left out.
int copyAll(int from, int to, const std::string& except);

} // namespace rapidc::service
