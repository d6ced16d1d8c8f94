#pragma once
// Small things that the readers of foreign text share.

#include <string>
#include <string_view>

namespace rapid::config {

/// Without blanks, tabs and carriage returns at both ends.
std::string_view trimmed(std::string_view text);
/// ASCII letters in upper case.
std::string upperCase(std::string_view text);
/// Equal without regard to the case of ASCII letters.
bool sameName(std::string_view a, std::string_view b);
/// The whole text is one finite decimal number (sign, fraction, exponent); `value` is left alone otherwise.
bool parseNumber(std::string_view text, double& value);
/// UTF-8 stays (a byte order mark is dropped); anything else is read as ISO 8859-1.
std::string toUtf8(std::string_view text);
/// Shortest decimal form: of the binary32 value when nothing is lost by that, as RAPID's num shows it.
std::string shortestNumber(double value);

} // namespace rapid::config
