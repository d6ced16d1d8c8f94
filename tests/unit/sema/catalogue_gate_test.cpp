// The catalogue is whole: every code is used by the program, explained, described by a page, and caused by a test.

#include "sema_testing.h"

#include "frontend/diag/catalogue.h"
#include "frontend/diag/explain.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <map>
#include <regex>
#include <set>

namespace {

using namespace rapid;
namespace fs = std::filesystem;

const fs::path kRoot = RAPIDC_SOURCE_DIR;

/// Calls visit(path, text) for the files below a folder whose names end in one of `suffixes`.
template <class F>
void forEachFile(const fs::path& folder, const std::set<std::string>& suffixes, const F& visit) {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && suffixes.contains(entry.path().extension().string()))
            visit(entry.path(), sema::testing::readFile(entry.path().string()));
}

void gather(std::set<std::string>& found, const std::string& text, const std::regex& pattern) {
    for (std::sregex_iterator m(text.begin(), text.end(), pattern), end; m != end; ++m)
        found.insert((*m)[1]);
}

} // namespace

TEST_CASE("every code of the catalogue is used by the program", "[diag][gate]") {
    static const std::regex use(R"(\b(?:Code|say)::(\w+))");
    std::set<std::string> used;
    for (const char* folder : {"frontend", "ir", "codegen", "tools"})
        forEachFile(kRoot / folder, {".cpp", ".h"},
                    [&](const fs::path&, const std::string& text) { gather(used, text, use); });
    for (const diag::CatalogueEntry& entry : diag::catalogue()) {
        INFO("RAP" << entry.number << " " << entry.name << ": retire it or report it");
        CHECK(used.contains(std::string(entry.name)));
    }
}

TEST_CASE("every code of the catalogue is explained", "[diag][gate]") {
    for (const diag::CatalogueEntry& entry : diag::catalogue()) {
        INFO("RAP" << entry.number << " " << entry.name);
        const diag::Explanation* explanation = diag::findExplanation(entry.number);
        REQUIRE(explanation);
        CHECK(explanation->meaning.size() > 20);
        CHECK_FALSE(explanation->right.empty());
    }
}

TEST_CASE("every code of the catalogue is caused by a test", "[diag][gate]") {
    // Programs with annotations, command lines, or unit tests for what no single file can cause.
    static const std::regex number(R"(\bRAP(\d{4})\b)");
    static const std::regex name(R"(\bsay::(\w+))");
    std::set<std::string> numbers, names;
    forEachFile(kRoot / "tests", {".modx", ".sysx", ".mod", ".sys", ".test", ".cpp", ".err"},
                [&](const fs::path&, const std::string& text) {
                    gather(numbers, text, number);
                    gather(names, text, name);
                });
    // Codes that nothing can cause from outside, and why.
    static const std::map<int, std::string> kExempt = {{9001, "only a mistake of rapidc itself causes it"}};
    for (const diag::CatalogueEntry& entry : diag::catalogue()) {
        if (kExempt.contains(entry.number)) continue;
        INFO("RAP" << entry.number << " " << entry.name);
        CHECK((numbers.contains(std::to_string(entry.number)) || names.contains(std::string(entry.name))));
    }
}

TEST_CASE("docs/diagnostics is up to date: ./dev reference writes it", "[diag][gate]") {
    std::set<std::string> names;
    for (const diag::DiagnosticPage& page : diag::diagnosticPages()) {
        INFO(page.fileName);
        names.insert(page.fileName);
        const bool current =
            sema::testing::readFile((kRoot / "docs/diagnostics" / page.fileName).string()) == page.text;
        CHECK(current);
    }
    for (const auto& entry : fs::directory_iterator(kRoot / "docs/diagnostics")) {
        INFO(entry.path().string());
        CHECK(names.contains(entry.path().filename().string()));
    }
}
