#pragma once
// The path of the TCP as a picture: top view and side view, coloured by speed, with zones, names of points and changes of
// signals.

#include "runtime/report/run_record.h"

#include <string>

namespace rt::report {

/// The SVG, even of a run that has not begun yet.
std::string pathPicture(const RunRecord& record);

} // namespace rt::report
