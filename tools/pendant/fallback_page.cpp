#include "tools/pendant/page_files.h"

namespace rapidc::pendant {

namespace {

constexpr std::string_view kPage = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>rapidc serve</title></head>
<body><h1>rapidc serve</h1>
<p>The controller is running, but this rapidc was built without its web page: node and npm were not there, or npm could
not bring its packages.</p>
<p>To build the page, install node (18 or later) and npm, make sure that npm can reach its registry, and run
<code>./dev build</code> again.</p>
<p>Robot Web Services answer at the other addresses that were printed at the start. The protocol of the page
is served at <code>/api</code>.</p>
</body></html>
)";

constexpr PageFile kFiles[] = {{"/", "text/html;charset=utf-8", kPage}};

} // namespace

PageFiles fallbackPage() {
    return kFiles;
}

} // namespace rapidc::pendant
