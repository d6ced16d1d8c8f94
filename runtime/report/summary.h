#pragma once
// Text for people: the limits that slowed a run, and how it differs from a recording.

#include "runtime/report/page_data.h"

#include <string>
#include <vector>

namespace rt::report {

/// Of each robot: time of moving and waiting, what time was lost to, and a line for each movement; for each instruction when
/// there are many movements. Robots without a movement have one line when there are several.
std::string summaryText(const RunRecord& record, const std::vector<RobotReport>& robots);

/// For each robot that has a recording; `recordings`: all of the file.
std::string comparisonText(const RunRecord& record, const std::vector<RobotReport>& robots,
                           const std::vector<Recording>& recordings);

} // namespace rt::report
