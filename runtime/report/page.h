#pragma once
// The report of a run: one page that shows everything offline.

#include "runtime/report/page_data.h"

#include <string>
#include <string_view>

namespace rt::report {

/// HTML with style, script and data inside.
std::string reportPage(const ReportContent& content);

/// The files of the folder `page`, put into the executable when it is built (embed_page.cmake).
std::string_view pageFrame();
std::string_view pageStyle();
std::string_view pageScript();

} // namespace rt::report
