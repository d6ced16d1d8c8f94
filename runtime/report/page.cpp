#include "runtime/report/page.h"

#include "runtime/report/markup.h"

namespace rt::report {

std::string reportPage(const ReportContent& content) {
    const auto files = pageFiles();
    std::string page(files[0]);
    std::string script;
    for (const std::string_view part : files.subspan(2))
        script += part;
    const auto fill = [&page](std::string_view place, std::string_view text) {
        const std::size_t at = page.find(place);
        if (at != std::string::npos) page.replace(at, place.size(), text);
    };
    // From the end to the start, so that no text is searched for the places that follow.
    fill("{{script}}", script);
    fill("{{data}}", pageData(content));
    fill("{{style}}", files[1]);
    fill("{{title}}", escaped(content.record.program));
    return page;
}

} // namespace rt::report
