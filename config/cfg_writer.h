#pragma once
// Writer of configuration texts, as controllers write them: the reverse of cfg_parser.h.

#include "config/cfg_parser.h"

#include <string>
#include <string_view>

namespace rapid::config {

/// Whether a text can stand as a value: the format has no way to write quotation marks, control characters and ends of lines.
bool isCfgValue(std::string_view text);
/// The name of an attribute or a type: letters, digits, underscores, a letter first.
bool isCfgName(std::string_view text);

/// The whole text of a file, in UTF-8; parseCfg() reads the same sections from it. Every value must be isCfgValue().
std::string writeCfg(const CfgFile& file);

/// UTF-8 as ISO 8859-1, which controllers expect; unchanged when a letter has no place there, or the bytes would be read as UTF-8.
std::string toLatin1(std::string_view utf8);

} // namespace rapid::config
