// Names of warnings, and the ways to switch them: settings, options, comments.

#include "lint_testing.h"

#include "frontend/diag/catalogue.h"
#include "frontend/diag/messages/flow.h"
#include "frontend/diag/messages/warnings.h"

#include <catch2/catch.hpp>
#include <set>

using namespace rapid;
namespace say = diag::say;
using lint::Level;
using Codes = std::vector<std::string>;

namespace {

std::string module(const std::string& body) {
    return "MODULE m\nPROC main()\n" + body + "\nENDPROC\nENDMODULE\n";
}

project::Settings settings(const std::string& json, diag::Sink& sink) {
    return project::readSettings(std::make_shared<const SourceFile>("rapidc.json", json), sink);
}

Codes codesOf(const diag::Sink& sink) {
    Codes found;
    for (const diag::Diagnostic& d : sink.sorted())
        found.push_back(diag::codeName(d.code));
    return found;
}

} // namespace

TEST_CASE("names of warnings are the names of the catalogue in kebab-case, each once", "[lint]") {
    CHECK(diag::kebabName(*diag::findEntry(8003)) == "unused-variable");
    CHECK(diag::kebabName(*diag::findEntry(5015)) == "optional-without-present");
    std::set<std::string> seen;
    for (const diag::CatalogueEntry& entry : diag::catalogue())
        CHECK(seen.insert(diag::kebabName(entry)).second);
}

TEST_CASE("options switch warnings off, on, and make errors of them", "[lint]") {
    lint::WarningLevels levels;
    std::string problem;
    CHECK(levels.of(say::UnusedVariable.code) == Level::Warning);
    REQUIRE(lint::applyOption("no-unused-variable", levels, problem));
    CHECK(levels.of(say::UnusedVariable.code) == Level::Off);
    CHECK(levels.of(say::UnusedLabel.code) == Level::Warning);
    REQUIRE(lint::applyOption("unused-variable", levels, problem));
    CHECK(levels.of(say::UnusedVariable.code) == Level::Warning);
    REQUIRE(lint::applyOption("error=unused-label", levels, problem));
    CHECK(levels.of(say::UnusedLabel.code) == Level::Error);
    // A warning whose name begins with "no-" is meant before its opposite.
    REQUIRE(lint::applyOption("no-lint", levels, problem));
    CHECK(levels.of(say::UnusedLabel.code) == Level::Off);
    CHECK(levels.of(say::DuplicateCase.code) == Level::Warning);
    CHECK_FALSE(levels.anyLint());
    // All warnings are errors: those that are off stay off.
    REQUIRE(lint::applyOption("error", levels, problem));
    CHECK(levels.of(say::DuplicateCase.code) == Level::Error);
    CHECK(levels.of(say::UnusedLabel.code) == Level::Off);
}

TEST_CASE("options with names that are not warnings are reported", "[lint]") {
    lint::WarningLevels levels;
    std::string problem;
    CHECK_FALSE(lint::applyOption("unused-varable", levels, problem));
    CHECK(problem.find("unused-variable") != std::string::npos);
    CHECK_FALSE(lint::applyOption("no-", levels, problem));
    CHECK_FALSE(lint::applyOption("", levels, problem));
    CHECK_FALSE(lint::applyOption("error=", levels, problem));
    // An error cannot be switched off.
    CHECK_FALSE(lint::applyOption("no-unknown-name", levels, problem));
}

TEST_CASE("settings give levels to warnings; names say more than groups", "[lint]") {
    lint::WarningLevels levels;
    diag::Sink sink;
    lint::applySettings(
        settings(R"({"warnings": {"unused-label": "error", "lint": "off", "all": "warning"}})", sink), levels,
        sink);
    CHECK(sink.all().empty());
    CHECK(levels.of(say::UnusedLabel.code) == Level::Error);
    lint::WarningLevels others;
    lint::applySettings(settings(R"({"warnings": {"unused-label": "off"}})", sink), others, sink);
    CHECK(others.of(say::UnusedLabel.code) == Level::Off);
    CHECK(others.of(say::UnusedVariable.code) == Level::Warning);
}

TEST_CASE("settings that cannot be used are reported at their place", "[lint]") {
    lint::WarningLevels levels;
    diag::Sink sink;
    const auto read = settings("{\n  \"warnings\": {\n    \"unused-labels\": \"off\",\n"
                               "    \"unused-variable\": \"maybe\",\n    \"unused-type\": 3\n  }\n}",
                               sink);
    lint::applySettings(read, levels, sink);
    REQUIRE(codesOf(sink) == Codes{"RAP8001", "RAP6032", "RAP6032"});
    CHECK(sink.sorted()[0].file->lineColumn(sink.sorted()[0].range.begin).line == 3);
    CHECK(sink.sorted()[0].message.find("unused-label'") != std::string::npos);
    CHECK(sink.sorted()[1].file->lineColumn(sink.sorted()[1].range.begin).line == 4);
}

TEST_CASE("a project file that is not JSON or has unknown sections is reported", "[lint]") {
    const auto codes = [](const std::string& json) {
        diag::Sink sink;
        settings(json, sink);
        return codesOf(sink);
    };
    CHECK(codes("{}") == Codes{});
    CHECK(codes("{\"warnings\": {}, \"format\": {\"indent\": 3}} // remark") == Codes{});
    CHECK(codes("") == Codes{"RAP6030"});
    CHECK(codes("{\"warnings\": {") == Codes{"RAP6030"});
    CHECK(codes("[1]") == Codes{"RAP6030"});
    CHECK(codes("{\"warning\": {}}") == Codes{"RAP6031"});
    CHECK(codes("{\"warnings\": 3}") == Codes{"RAP6032"});
    CHECK(codes("{\"warnings\": {\"unused-label\": {}}}") == Codes{"RAP6032"});
    CHECK(codes(std::string(100000, '[')) == Codes{"RAP6030"});
    CHECK(codes("\xFF\xFE\x00") == Codes{"RAP6030"});
}

TEST_CASE("a comment on the line or alone before it switches a warning off", "[lint]") {
    CHECK(lint::testing::codes({module("VAR num a;")}) == Codes{"RAP8003"});
    CHECK(lint::testing::codes({module("VAR num a; ! rapidc: ignore unused-variable")}) == Codes{});
    CHECK(lint::testing::codes({module("! rapidc: ignore unused-variable\nVAR num a;\nVAR num b;")}) ==
          Codes{"RAP8003"});
    // Further comments and empty lines may stand between.
    CHECK(lint::testing::codes(
              {module("!rapidc: ignore unused-variable -- the PLC reads it\n\n! a\nVAR num a;")}) == Codes{});
    // After code it applies to its own line only.
    CHECK(lint::testing::codes({module("VAR num a; ! rapidc: ignore unused-variable\nVAR num b;")}) ==
          Codes{"RAP8003"});
    CHECK(lint::testing::codes({module("VAR num a; ! rapidc: ignore unused-label")}) == Codes{"RAP8003"});
    CHECK(lint::testing::codes({module("VAR num a; ! rapidc: ignore unused-label, unused-variable")}) ==
          Codes{});
    CHECK(lint::testing::codes({module("VAR num a; ! rapidc: ignore lint")}) == Codes{});
    CHECK(lint::testing::codes({module("VAR num a; ! rapidc: ignore all")}) == Codes{});
}

TEST_CASE("off and on enclose a range, off alone reaches to the end of the file", "[lint]") {
    CHECK(lint::testing::codes({module("! rapidc: off unused-variable\nVAR num a;\n"
                                       "! rapidc: on unused-variable\nVAR num b;")}) == Codes{"RAP8003"});
    CHECK(lint::testing::codes({"! rapidc: off unused-variable\n" + module("VAR num a;\nVAR num b;")}) ==
          Codes{});
    CHECK(lint::testing::codes({module("VAR num a;\n! rapidc: off unused-variable")}) == Codes{"RAP8003"});
    CHECK(lint::testing::codes({module("VAR num a;"), "! rapidc: off all\nMODULE n\nENDMODULE\n"}) ==
          Codes{"RAP8003"});
}

TEST_CASE("comments that cannot be understood are reported; other texts are none of them", "[lint]") {
    CHECK(lint::testing::codes({module("! rapidc: ignore unused-varable")}) == Codes{"RAP8001"});
    CHECK(lint::testing::codes({module("! rapidc: ignore")}) == Codes{"RAP8002"});
    CHECK(lint::testing::codes({module("! rapidc:")}) == Codes{"RAP8002"});
    CHECK(lint::testing::codes({module("! rapidc: disable unused-variable")}) == Codes{"RAP8002"});
    CHECK(lint::testing::codes({module("! see rapidc: it has warnings")}) == Codes{});
    CHECK(lint::testing::codes({module("TPWrite \"! rapidc: nonsense\";")}) == Codes{});
    // Reports about comments can be switched off like others.
    CHECK(lint::testing::codes({module("! rapidc: ignore unknown-warning, nonsense")}) == Codes{});
}

TEST_CASE("errors stay, whatever is switched off; warnings of other ranges have names too", "[lint]") {
    CHECK(lint::testing::codes({module("reg1 := \"x\"; ! rapidc: ignore all")}) == Codes{"RAP2104"});
    CHECK(lint::testing::codes({module("reg1 := reg2 / 0; ! rapidc: ignore division-by-zero")}) == Codes{});
    lint::WarningLevels levels;
    levels.set("division-by-zero", Level::Error);
    const auto raised = lint::testing::messages({module("reg1 := reg2 / 0;")}, levels);
    REQUIRE(raised.size() == 1);
    CHECK(raised[0].rfind("RAP3034", 0) == 0);
}
