#pragma once
// The data of a run as the page of its report reads them: JSON, with long series as whole numbers.

#include "runtime/report/comparison.h"

#include <string>

namespace rt::report {

/// The report of one robot.
struct RobotReport {
    Analysis analysis;
    const Recording* recording = nullptr; ///< null: nothing to compare with
    Comparison comparison;                ///< with a recording
};

/// Everything that a report shows; `robots` in the order of the record.
struct ReportContent {
    const RunRecord& record;
    const std::vector<RobotReport>& robots;
};

/// Analyses each robot, and compares it with its recording.
std::vector<RobotReport> robotReports(const RunRecord& record, const std::vector<Recording>& recordings);

/// A JSON object without `<`, so that it can be part of a page. A series is {"unit":u,"d":[...]}: differences of successive
/// values in that unit, the first one from 0.
std::string pageData(const ReportContent& content);

} // namespace rt::report
