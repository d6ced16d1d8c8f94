// The catalogue as pages for people: docs/diagnostics.

#include "frontend/diag/catalogue.h"
#include "frontend/diag/explain.h"

#include <fmt/format.h>

namespace rapid::diag {

namespace {

std::string codeOf(const CatalogueEntry& entry) {
    return fmt::format("RAP{}", entry.number);
}

} // namespace

std::string messageOf(const CatalogueEntry& entry) {
    static constexpr std::string_view kArguments[] = {"...", "...", "...", "..."};
    std::vector<std::string> args(std::begin(kArguments), std::end(kArguments));
    return formatText(entry.text, args);
}

std::string switchingOf(const CatalogueEntry& entry) {
    if (!isSwitchable(entry)) return {};
    const std::string name = kebabName(entry);
    return fmt::format("name: {0}; off by -W no-{0} or the comment ! rapidc: ignore {0}", name);
}

namespace {

std::string pageOf(const CatalogueEntry& entry) {
    std::string out = fmt::format("# {} {}\n\n", codeOf(entry), title(entry));
    out +=
        fmt::format("{}, {}\n\n> {}\n", severityName(entry.severity), areaOf(entry.number), messageOf(entry));
    if (isSwitchable(entry)) {
        const std::string name = kebabName(entry);
        out += fmt::format("\nName: `{0}`; off by `-W no-{0}` or the comment `! rapidc: ignore {0}`, see "
                           "[warnings](../warnings.md).\n",
                           name);
    }
    const Explanation* explanation = findExplanation(entry.number);
    if (explanation) {
        out += fmt::format("\n{}\n", explanation->meaning);
        const std::string_view kind = exampleKindName(explanation->kind);
        if (!explanation->wrong.empty())
            out += fmt::format("\nWrong:\n\n```text {}\n{}\n```\n", kind, explanation->wrong);
        out += fmt::format("\nRight:\n\n```{} {}\n{}\n```\n", exampleLanguage(explanation->kind), kind,
                           explanation->right);
    }
    return out + "\n[All diagnostics](README.md)\n";
}

std::string indexPage() {
    std::string out =
        "# Diagnostics of rapidc\n\nWritten by `./dev reference` from the catalogue in `frontend/diag`. "
        "`rapidc explain RAP2104` shows the same on the command line.\n";
    unsigned range = 0;
    for (const CatalogueEntry& entry : catalogue()) {
        if (entry.number / 1000u != range) {
            range = entry.number / 1000u;
            out += fmt::format("\n## {}xxx {}\n\n| code | | severity |\n|---|---|---|\n", range,
                               areaOf(entry.number));
        }
        out += fmt::format("| [{0}]({0}.md) | {1} | {2} |\n", codeOf(entry), title(entry),
                           severityName(entry.severity));
    }
    return out;
}

} // namespace

std::string_view areaOf(uint16_t number) {
    switch (number / 1000) {
    case 1: return "reading the text (lexing and parsing)";
    case 2: return "names and types";
    case 3: return "expressions and constants";
    case 4: return "calls and built-ins";
    case 5: return "program flow and use of data";
    case 6: return "projects, tasks and configuration";
    case 7: return "what is compiled and linked";
    case 8: return "style and likely mistakes";
    default: return "rapidc itself";
    }
}

std::vector<DiagnosticPage> diagnosticPages() {
    std::vector<DiagnosticPage> pages;
    pages.push_back({"README.md", indexPage()});
    for (const CatalogueEntry& entry : catalogue())
        pages.push_back({codeOf(entry) + ".md", pageOf(entry)});
    return pages;
}

} // namespace rapid::diag
