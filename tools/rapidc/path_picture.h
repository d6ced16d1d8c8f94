#pragma once
// The path of the TCP as a picture: top view and side view, coloured by speed, from a trace file.

#include <string>

namespace rapidc {

/// Reads the CSV that `--trace` writes and draws an SVG. False with a message when a file cannot be read or written
/// or holds no sample.
bool writePathPicture(const std::string& traceFile, const std::string& svgFile, std::string& error);

} // namespace rapidc
