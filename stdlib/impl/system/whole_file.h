#pragma once
// Files of volumes that are read or written in one go: text tables, configurations.

#include "runtime/host/controller.h"

#include <string>
#include <string_view>

namespace rt::lib {

/// Reads a file of at most 4 MB. Returns "" or why it cannot be read, for people.
std::string readWhole(Controller& controller, std::string_view path, std::string& bytes);
/// Replaces the file, or makes it. Returns "" or why it cannot be written, for people.
std::string writeWhole(Controller& controller, std::string_view path, std::string_view bytes);

} // namespace rt::lib
