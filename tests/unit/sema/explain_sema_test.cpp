// Explanations of the checker's diagnostics: one for each code, and their examples do what they say.

#include "unit/lint/lint_testing.h"
#include "unit/sema/sema_testing.h"

#include "frontend/diag/catalogue.h"
#include "frontend/diag/explain.h"

#include <catch2/catch.hpp>

namespace {

using namespace rapid;

std::string whole(const diag::Explanation& e, std::string_view example) {
    return diag::exampleProject(e.kind, example).files.front().bytes;
}

bool isWarning(const diag::Explanation& e) {
    return e.number / 1000 == 8;
}

void checkExamples() {
    for (const diag::Explanation& e : diag::explanations()) {
        if (e.number < 2000 || isWarning(e)) continue;
        if (e.kind == diag::ExampleKind::Files) continue; // explain_files_test.cpp
        INFO(e.number << "\nwrong: " << e.wrong << "\nright: " << e.right);
        CHECK(diag::findEntry(e.number) != nullptr);
        CHECK(sema::testing::checkTexts({whole(e, e.right)})->messages() == std::vector<std::string>{});
        if (e.wrong.empty()) continue;
        const auto wrong = sema::testing::checkTexts({whole(e, e.wrong)});
        REQUIRE(wrong->sink.all().size() == 1);
        CHECK(static_cast<int>(wrong->sink.all()[0].code) == e.number);
    }
}

} // namespace

TEST_CASE("every code of the checker is explained", "[sema][diag]") {
    for (const diag::CatalogueEntry& entry : diag::catalogue()) {
        if (entry.number < 2000 || (entry.number >= 6040 && entry.number < 8000) || entry.number >= 9000)
            continue;
        INFO(entry.number);
        CHECK(diag::findExplanation(entry.number) != nullptr);
    }
}

TEST_CASE("wrong examples of the checker cause their diagnostic, right ones none", "[sema][diag]") {
    checkExamples();
}

TEST_CASE("wrong examples of warnings cause their warning, right ones none", "[lint][diag]") {
    for (const diag::Explanation& e : diag::explanations()) {
        if (!isWarning(e)) continue;
        INFO(e.number << "\nwrong: " << e.wrong << "\nright: " << e.right);
        CHECK(lint::testing::messages({whole(e, e.right)}) == std::vector<std::string>{});
        REQUIRE(lint::testing::messages({whole(e, e.wrong)}).size() == 1);
        CHECK(lint::testing::messages({whole(e, e.wrong)})[0].rfind("RAP" + std::to_string(e.number), 0) ==
              0);
    }
}
