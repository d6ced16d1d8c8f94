// Coverage as one page of HTML, without scripts and other files.

#include "tools/testing/coverage.h"

#include <fmt/format.h>

#include <algorithm>

namespace testing {
namespace {

constexpr const char* kStyle = R"(
body{font:15px/1.45 system-ui,sans-serif;margin:2em auto;max-width:70em;padding:0 1em;color:#1c2430;background:#fff}
h1{font-size:1.4em}h2{font-size:1.1em;margin-top:2em;overflow-wrap:anywhere}
table{border-collapse:collapse;width:100%}td,th{padding:.2em .6em;text-align:left;border-bottom:1px solid #dde3ea}
td.n,th.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
.bar{display:inline-block;width:8em;height:.7em;background:#f3c4bf;border-radius:.3em;overflow:hidden}
.bar span{display:block;height:100%;background:#3f9b5c}
pre{font:13px/1.5 ui-monospace,monospace;margin:0;border:1px solid #dde3ea;border-radius:.4em;overflow-x:auto}
pre span{display:block;padding:0 .6em;white-space:pre}pre i{font-style:normal;color:#6b7683;display:inline-block;width:9.5em;text-align:right;margin-right:1em}
.hit{background:#e6f5ea}.miss{background:#fde8e5}
@media (prefers-color-scheme:dark){body{background:#14181d;color:#dbe2ea}td,th,pre{border-color:#2c343d}.hit{background:#173422}.miss{background:#46211d}pre i{color:#8994a1}}
)";

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"')
            result += "&quot;";
        else
            result += c;
    }
    return result;
}

std::string bar(uint32_t part, uint32_t whole) {
    return fmt::format("<span class=\"bar\"><span style=\"width:{:.0f}%\"></span></span>",
                       percent(part, whole));
}

std::string fileTable(const std::vector<CoveredFile>& files) {
    std::string text = "<table><tr><th>File</th><th>Coverage</th><th class=\"n\">Statements</th><th "
                       "class=\"n\">%</th></tr>\n";
    for (std::size_t i = 0; i < files.size(); ++i)
        text += fmt::format("<tr><td><a href=\"#file{}\">{}</a></td><td>{}</td><td class=\"n\">{} of {}</td>"
                            "<td class=\"n\">{:.1f}</td></tr>\n",
                            i + 1, escaped(files[i].path), bar(files[i].executed, files[i].statements),
                            files[i].executed, files[i].statements,
                            percent(files[i].executed, files[i].statements));
    return text + "</table>\n";
}

std::string routineTable(const CoveredFile& file) {
    std::string text = "<table><tr><th>Routine</th><th class=\"n\">Calls</th><th>Coverage</th><th "
                       "class=\"n\">Statements</th></tr>\n";
    for (const CoveredRoutine& routine : file.routines)
        text += fmt::format(
            "<tr><td>{}</td><td class=\"n\">{}</td><td>{}</td><td class=\"n\">{} of {}</td></tr>\n",
            escaped(routine.name), routine.calls, bar(routine.executed, routine.statements), routine.executed,
            routine.statements);
    return text + "</table>\n";
}

std::string sourceText(const CoveredFile& file, const std::string& source) {
    std::string text = "<pre>";
    uint32_t line = 1;
    for (std::size_t begin = 0; begin < source.size(); ++line) {
        const std::size_t end = std::min(source.find('\n', begin), source.size());
        std::string code = source.substr(begin, end - begin);
        if (code.ends_with('\r')) code.pop_back();
        begin = end + 1;
        const auto found = file.lines.find(line);
        const bool counted = found != file.lines.end();
        text += fmt::format("<span class=\"{}\"><i>{} {:>5}</i>{}</span>",
                            !counted            ? "none"
                            : found->second > 0 ? "hit"
                                                : "miss",
                            counted ? fmt::format("{}x", found->second) : "", line, escaped(code));
    }
    return text + "</pre>\n";
}

} // namespace

std::string coveragePage(const std::vector<CoveredFile>& files,
                         const std::function<std::string(const std::string& path)>& textOf) {
    uint32_t statements = 0, executed = 0;
    for (const CoveredFile& file : files) {
        statements += file.statements;
        executed += file.executed;
    }
    std::string page = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
        "content=\"width=device-width\"><title>Coverage</title><style>{}</style></head><body>\n"
        "<h1>Coverage by the unit tests</h1>\n<p>{} of {} statements were executed ({:.1f} %).</p>\n{}",
        kStyle, executed, statements, percent(executed, statements), fileTable(files));
    for (std::size_t i = 0; i < files.size(); ++i)
        page += fmt::format("<h2 id=\"file{}\">{}</h2>\n{}{}", i + 1, escaped(files[i].path),
                            routineTable(files[i]), sourceText(files[i], textOf(files[i].path)));
    return page + "</body></html>\n";
}

} // namespace testing
