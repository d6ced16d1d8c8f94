// rapidc explain: what a diagnostic means.

#include "tools/rapidc/commands.h"
#include "tools/rapidc/explain_runtime.h"
#include "tools/rapidc/usage.h"

#include "config/atomic_file.h"
#include "config/text_util.h"
#include "frontend/diag/catalogue.h"
#include "frontend/diag/explain.h"
#include "runtime/host/command_line.h"
#include "runtime/host/run_options.h"
#include "stdlib/native_table.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace rapidc {

namespace {

int explain(const std::string& code) {
    std::string digits;
    std::copy_if(code.begin(), code.end(), std::back_inserter(digits),
                 [](unsigned char c) { return std::isdigit(c); });
    const rapid::diag::CatalogueEntry* entry =
        digits.size() == 4 ? rapid::diag::findEntry(static_cast<uint16_t>(std::stoi(digits))) : nullptr;
    for (const rapid::diag::CatalogueEntry& named : rapid::diag::catalogue())
        if (!entry && kebabName(named) == code) entry = &named;
    if (!entry || code.starts_with("ERR_")) {
        std::string text = explainEvent(code);
        if (text.empty()) text = explainError(code);
        if (!text.empty()) {
            fmt::print("{}", text);
            return 0;
        }
    }
    if (!entry) {
        fmt::print(
            stderr,
            "rapidc explain: '{}' is not known; expected a code such as RAP2104, the name of a warning such "
            "as "
            "unused-variable, the number of an event such as 40229, or an error such as ERR_DIVZERO{}\n",
            code, nearestError(code));
        return kBadUsage;
    }
    fmt::print("RAP{} {} ({})\n", entry->number, entry->name, rapid::diag::severityName(entry->severity));
    fmt::print("area: {}\ntext: {}\n", rapid::diag::areaOf(entry->number), rapid::diag::messageOf(*entry));
    if (const std::string switching = rapid::diag::switchingOf(*entry); !switching.empty())
        fmt::print("{}\n", switching);
    if (const rapid::diag::Explanation* explanation = rapid::diag::findExplanation(entry->number)) {
        fmt::print("\n{}\n", explanation->meaning);
        if (!explanation->wrong.empty())
            fmt::print("\nwrong:\n{}\n", rapid::config::indented(explanation->wrong));
        fmt::print("\nright:\n{}\n", rapid::config::indented(explanation->right));
    }
    if (const char* error = code == digits ? rt::errorName(entry->number) : nullptr)
        fmt::print("\nThe event log shows {} as the ERRNO of {}: see rapidc explain {}\n", code, error,
                   error);
    return 0;
}

/// Writes what changed and removes the pages of codes that are gone.
int writePages(const std::string& folder) {
    namespace fs = std::filesystem;
    std::error_code error;
    fs::create_directories(folder, error);
    std::set<std::string> names;
    for (const rapid::diag::DiagnosticPage& page : rapid::diag::diagnosticPages()) {
        names.insert(page.fileName);
        const std::string path = (fs::path(folder) / page.fileName).string();
        const std::string problem = rapid::config::replaceFile(path, page.text);
        if (problem.empty()) continue;
        fmt::print(stderr, "rapidc explain: {}\n", problem);
        return 1;
    }
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with("RAP") && name.ends_with(".md") && !names.contains(name))
            fs::remove(entry.path(), error);
    }
    return 0;
}

} // namespace

void addExplainCommand(rt::CommandLine& line) {
    auto code = std::make_shared<std::string>();
    auto folder = std::make_shared<std::string>();
    const auto body = [code, folder] {
        if (code->empty() && folder->empty()) {
            fmt::print(stderr, "rapidc explain: code is required\nrapidc explain --help says more\n");
            return kBadUsage;
        }
        return folder->empty() ? explain(*code) : writePages(*folder);
    };
    const rt::Command command =
        line.addCommand("explain", "Explain a diagnostic, an event or an error", body);
    const rt::Option one = command.add(
        "code", *code, "RAP2104, the name of a warning, the number of an event (40229), or ERR_NAME");
    const rt::Option all = command.add("--pages", *folder, "Write a page for every code into this folder");
    one.excludes(all);
}

} // namespace rapidc
