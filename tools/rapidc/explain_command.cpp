// rapidc explain: what a diagnostic means.

#include "tools/rapidc/commands.h"

#include "frontend/diag/catalogue.h"
#include "frontend/diag/explain.h"
#include "runtime/host/run_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fmt/format.h>

namespace rapidc {

namespace {

const char* areaOf(uint16_t number) {
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

std::string indented(std::string_view example) {
    std::string out = "    ";
    for (const char c : example) {
        out += c;
        if (c == '\n') out += "    ";
    }
    return out;
}

int explain(const std::string& code) {
    std::string digits;
    std::copy_if(code.begin(), code.end(), std::back_inserter(digits),
                 [](unsigned char c) { return std::isdigit(c); });
    const rapid::diag::CatalogueEntry* entry =
        digits.size() == 4 ? rapid::diag::findEntry(static_cast<uint16_t>(std::stoi(digits))) : nullptr;
    if (!entry) {
        fmt::print(stderr, "rapidc explain: '{}' is no code of rapidc, expected one such as RAP2104\n", code);
        return static_cast<int>(rt::ExitStatus::BadUsage);
    }
    fmt::print("RAP{} {} ({})\n", entry->number, entry->name, rapid::diag::severityName(entry->severity));
    fmt::print("area: {}\ntext: {}\n", areaOf(entry->number), entry->text);
    if (const rapid::diag::Explanation* explanation = rapid::diag::findExplanation(entry->number)) {
        fmt::print("\n{}\n", explanation->meaning);
        if (!explanation->wrong.empty()) fmt::print("\nwrong:\n{}\n", indented(explanation->wrong));
        fmt::print("\nright:\n{}\n", indented(explanation->right));
    }
    return 0;
}

} // namespace

void addExplainCommand(CLI::App& app, int& status) {
    auto code = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand("explain", "Say what a diagnostic means");
    command->add_option("code", *code, "A code such as RAP2104")->required();
    command->callback([code, &status] { status = explain(*code); });
}

} // namespace rapidc
