#pragma once
// Text for people: the limits that slowed a run, and how it differs from a recording.

#include "runtime/report/comparison.h"

#include <string>

namespace rt::report {

/// Cycle time, time of moving and waiting, what time was lost to, and a line for each movement; for each instruction when
/// there are many movements.
std::string summaryText(const RunRecord& record, const Analysis& analysis);

/// `there`: the name of the recording.
std::string comparisonText(const Comparison& comparison, const Recording& recording);

} // namespace rt::report
