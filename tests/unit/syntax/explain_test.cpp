// Explanations: there is one for each code of the parser, and its examples do what they say.

#include "syntax_test.h"

#include "frontend/diag/catalogue.h"
#include "frontend/diag/explain.h"

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
