#pragma once
// The data of a run as the page of its report reads them: JSON, with long series as whole numbers.

#include "runtime/report/comparison.h"

#include <string>

namespace rt::report {

/// Everything that a report shows.
struct ReportContent {
    const RunRecord& record;
    const Analysis& analysis;
    const Recording* recording = nullptr; ///< null: nothing to compare with
    const Comparison* comparison = nullptr;
};

/// A JSON object without `<`, so that it can be part of a page. A series is {"unit":u,"d":[...]}: differences of successive
/// values in that unit, the first one from 0.
std::string pageData(const ReportContent& content);

} // namespace rt::report
