#pragma once
// Wrong usage of a command line in words, for rapidc and for the executables it makes.

#include <string>

namespace CLI {
class App;
class ParseError;
} // namespace CLI

namespace rt {

/// Prints "NAME: what is wrong; where help is" to stderr, or the help that was asked for to stdout. Returns the exit
/// status: 0 when help was asked for, otherwise BadUsage.
int reportUsage(const CLI::App& app, const CLI::ParseError& error, const std::string& name);

} // namespace rt
