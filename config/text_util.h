#pragma once
// Small things that the readers of foreign text share.

#include "config/letter_case.h"

#include <string>
#include <string_view>
#include <vector>

namespace rapid::config {

/// Without blanks, tabs and carriage returns at both ends.
std::string_view trimmed(std::string_view text);
/// The whole text is one finite decimal number (sign, fraction, exponent); `value` is left alone otherwise.
bool parseNumber(std::string_view text, double& value);
/// UTF-8 stays (a byte order mark is dropped); anything else is read as ISO 8859-1.
std::string toUtf8(std::string_view text);
/// The segments between slashes; empty ones do not count.
std::vector<std::string> splitPath(std::string_view path);
/// Shortest decimal form: of the binary32 value when nothing is lost by that, as RAPID's num shows it.
std::string shortestNumber(double value);
/// With four blanks before each line.
std::string indented(std::string_view text);

} // namespace rapid::config
