#pragma once
// The report of a run: one page that shows everything offline.

#include "runtime/report/page_data.h"

#include <span>
#include <string>
#include <string_view>

namespace rt::report {

/// HTML with style, script and data inside.
std::string reportPage(const ReportContent& content);

/// The files of the folder `page` as they were when the library was built: frame, style, then the scripts.
std::span<const std::string_view> pageFiles();

} // namespace rt::report
