// Explanations: there is one for each code of the parser, and its examples do what they say.

#include "syntax_test.h"

#include "frontend/diag/catalogue.h"
#include "frontend/diag/explain.h"
#include "frontend/diag/explain_pages.h"

#include <catch2/catch.hpp>

using namespace rapid;

namespace {

std::string whole(const diag::Explanation& e, std::string_view example) {
    return diag::exampleProject(e.kind, example).files.front().bytes;
}

} // namespace

TEST_CASE("every code of lexer and parser is explained", "[diag]") {
    for (const diag::CatalogueEntry& entry : diag::catalogue()) {
        if (entry.number >= 2000) break;
        INFO(entry.number);
        CHECK(diag::findExplanation(entry.number) != nullptr);
    }
    for (const diag::Explanation& e : diag::explanations())
        CHECK(diag::findEntry(e.number) != nullptr);
    CHECK(diag::findExplanation(9) == nullptr);
}

TEST_CASE("wrong examples cause their diagnostic, right ones none", "[diag]") {
    for (const diag::Explanation& e : diag::explanations()) {
        if (e.number >= 2000) break;
        if (e.kind == diag::ExampleKind::Files) continue; // explain_files_test.cpp
        INFO(e.number << ": " << e.wrong);
        CHECK(test::parseText(whole(e, e.right)).sink.all().empty());
        if (e.wrong.empty()) continue;
        const test::Parsed wrong = test::parseText(whole(e, e.wrong));
        INFO(wrong.shown());
        REQUIRE(wrong.sink.all().size() == 1);
        CHECK(static_cast<int>(wrong.sink.all()[0].code) == e.number);
    }
}

TEST_CASE("a page may be begun by hand: title, meaning, examples", "[diag]") {
    const std::string begun =
        "# RAP2104 Type mismatch\n\nIt does not fit.\n\nWrong:\n\n```text body\nn := \"1\";\n```\n"
        "\nRight:\n\n```rapid body\nn := 1;\n```\n";
    const std::string written =
        "# RAP2104 Type mismatch\n\nerror, names and types\n\n> cannot assign ...\n\nName: `x`; off by `-W "
        "no-x`\n" +
        begun.substr(begun.find("\n\nIt") + 1) + "\n[All diagnostics](README.md)\n";
    for (const std::string& page : {begun, written}) {
        INFO(page);
        const diag::Explanation e = diag::readPage(page);
        CHECK(e.number == 2104);
        CHECK(e.meaning == "It does not fit.");
        CHECK(e.wrong == "n := \"1\";");
        CHECK(e.right == "n := 1;");
        CHECK(e.kind == diag::ExampleKind::Body);
    }
    CHECK(diag::readPage("# RAP2104 Type mismatch\n").meaning.empty());
}
