// Diagnostics: catalogue, order, renderers.

#include "syntax_test.h"

#include "frontend/diag/catalogue.h"
#include "frontend/diag/messages/calls.h"
#include "frontend/diag/messages/projects.h"
#include "frontend/diag/messages/syntax.h"
#include "frontend/diag/messages/warnings.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

using namespace rapid;
namespace say = diag::say;

namespace {

std::shared_ptr<const SourceFile> file(std::string text) {
    return std::make_shared<const SourceFile>("a.modx", std::move(text));
}

/// Whether a report of the message with `args` compiles.
template <class M, class Args>
concept Reportable = requires(diag::Sink& sink, M message, const Args& args) {
    sink.report(message, nullptr, SourceRange{}, args);
};
template <size_t N> using Words = std::string[N];

// Rule: a wrong number or type of arguments does not compile.
static_assert(Reportable<diag::Message<2>, Words<2>>);
static_assert(!Reportable<diag::Message<2>, Words<1>>);
static_assert(!Reportable<diag::Message<2>, Words<3>>);
static_assert(!Reportable<diag::Message<0>, Words<1>>);
static_assert(!Reportable<diag::Message<1>, int[1]>);
static_assert(std::is_same_v<decltype(diag::say::MissingArgument), const diag::Message<2>>);

} // namespace

TEST_CASE("every text of the catalogue follows the wording rules", "[diag]") {
    for (const diag::CatalogueEntry& entry : diag::catalogue()) {
        INFO(entry.number << " " << entry.text);
        const char first = entry.text.front();
        // Lower-case start, unless the sentence starts with a word of RAPID or a quoted name.
        const bool upperWord = entry.text.size() > 1 && std::isupper(static_cast<unsigned char>(first)) &&
                               std::isupper(static_cast<unsigned char>(entry.text[1]));
        CHECK((!std::isupper(static_cast<unsigned char>(first)) || upperWord));
        CHECK(entry.text.back() != '.');
        CHECK(entry.text.find("illegal") == std::string_view::npos);
        CHECK(diag::findEntry(entry.number) == &entry);
    }
    CHECK(diag::findEntry(1) == nullptr);
    CHECK(diag::codeName(say::UnexpectedCharacter.code) == "RAP1001");
}

TEST_CASE("braces in a catalogue text are not placeholders", "[diag]") {
    const std::string args[] = {"x"};
    CHECK(diag::formatText("a {0} b", args) == "a x b");
    CHECK(diag::formatText("found '{' and {0} and '}'", args) == "found '{' and x and '}'");
}

TEST_CASE("mistakes that are in no file are limited, too", "[diag]") {
    diag::Sink sink;
    for (int i = 0; i < 1500; ++i)
        sink.report(say::FileNotFound.code, nullptr, {}, {"a"});
    CHECK(sink.all().size() == 1001);
    CHECK(sink.all().back().code == say::TooManyErrors.code);
    CHECK(sink.errorCount() == 1500);
}

TEST_CASE("a message stays readable whatever it quotes", "[diag]") {
    const std::string args[] = {std::string(299, 'a') + "\xC3\xA4" + std::string(1000000, 'b')};
    CHECK(diag::formatText("'{0}' is not declared", args) ==
          "'" + std::string(299, 'a') + "...' is not declared");
}

TEST_CASE("diagnostics are sorted by place, the limit comes last", "[diag]") {
    diag::Sink sink;
    const auto source = file("abc\ndef\n");
    sink.report(say::TooManyErrors.code, source, {0, 1}, {"errors"});
    sink.report(say::EqualInAssignment.code, source, {5, 6});
    sink.report(say::UnterminatedString.code, source, {1, 2});
    const auto sorted = sink.sorted();
    REQUIRE(sorted.size() == 3);
    CHECK(sorted[0].range.begin == 1);
    CHECK(sorted[1].range.begin == 5);
    CHECK(sorted[2].code == say::TooManyErrors.code);
    CHECK(sink.errorCount() == 2);
    CHECK(sink.hasErrors());
}

TEST_CASE("so many errors and so many warnings are kept of a file, and a note reports more", "[diag]") {
    diag::Sink sink;
    const auto source = file("abc"), other = file("def");
    constexpr size_t kMost = diag::Sink::kMaxPerFile;
    for (size_t i = 0; i < kMost + 500; ++i) {
        sink.report(say::EqualInAssignment.code, source, {0, 1}).fix({0, 1}, ":=");
        sink.report(say::UnusedVariable.code, source, {1, 2}, {"a"})
            .notes.push_back({source, {1, 2}, "here"});
    }
    CHECK(sink.errorCount() == kMost + 500);
    CHECK(sink.all().size() == 2 * kMost + 2);
    const auto notes = std::count_if(sink.all().begin(), sink.all().end(), [](const diag::Diagnostic& d) {
        return d.code == say::TooManyErrors.code && d.severity == diag::Severity::Note;
    });
    CHECK(notes == 2);
    sink.report(say::EqualInAssignment.code, other, {0, 1});
    CHECK(sink.all().back().file == other);
    CHECK(sink.all().back().code == say::EqualInAssignment.code);
}

TEST_CASE("columns count characters, also far out in a line", "[source]") {
    std::string line;
    for (int i = 0; i < 10000; ++i)
        line += "aä€";
    const auto source = file("x\n" + line + "\ny");
    CHECK(source->lineColumn(2).column == 1);
    for (const uint32_t triple : {1u, 680u, 683u, 700u, 1400u, 9999u}) {
        const LineColumn at = source->lineColumn(2 + triple * 6 + 3);
        CHECK(at.line == 2);
        CHECK(at.column == triple * 3 + 3);
    }
    CHECK(source->lineColumn(2 + 60000).column == 30001);
    CHECK(source->lineColumn(2 + 60001).line == 3);
}

TEST_CASE("text: heading, excerpt, marks", "[diag]") {
    diag::Sink sink;
    const auto source = file("MODULE m\n\tx\t= größer;\nENDMODULE\n");
    auto& d = sink.report(say::EqualInAssignment.code, source, {12, 13});
    d.notes.push_back({source, {0, 6}, "MODULE begins here"});
    CHECK(renderText(d, false) == "a.modx:2:4: error[RAP1205]: found '=', expected ':='\n"
                                  "    2 |     x   = größer;\n"
                                  "      |         ^\n"
                                  "a.modx:1:1: note: MODULE begins here\n"
                                  "    1 | MODULE m\n"
                                  "      | ^~~~~~\n");
    CHECK(renderText(d, true).find("\x1b[") != std::string::npos);
}

TEST_CASE("text: places at ends and over several lines", "[diag]") {
    diag::Sink sink;
    const auto source = file("ab\ncd");
    CHECK(renderText(sink.report(say::EqualInAssignment.code, source, {2, 2}), false)
              .find(" ab\n      |   ^\n") != std::string::npos);
    CHECK(renderText(sink.report(say::EqualInAssignment.code, source, {1, 5}), false)
              .find(" ab\n      |  ^\n") != std::string::npos);
    CHECK(renderText(sink.report(say::EqualInAssignment.code, source, {5, 5}), false)
              .find(" cd\n      |   ^\n") != std::string::npos);
}

TEST_CASE("text: a long line is cut around the place, control characters are not passed on", "[diag]") {
    diag::Sink sink;
    const std::string line = std::string(5000, 'a') + "HERE" + std::string(5000, 'b');
    const std::string shown =
        renderText(sink.report(say::EqualInAssignment.code, file(line), {5000, 5004}), false);
    CHECK(shown.size() < 400);
    CHECK(shown.find("aHEREb") != std::string::npos);
    const size_t row = shown.find("...a");
    REQUIRE(row != std::string::npos);
    const size_t lineStart = shown.rfind('\n', row) + 1;
    const size_t marks = shown.find("^~~~");
    const size_t markStart = shown.rfind('\n', marks) + 1;
    CHECK(shown.find("HERE") - lineStart == marks - markStart);

    const std::string evil =
        renderText(sink.report(say::EqualInAssignment.code, file("a\x1b[31mb"), {0, 1}), false);
    CHECK(evil.find('\x1b') == std::string::npos);
}

TEST_CASE("a message without a file", "[diag]") {
    diag::Sink sink;
    const auto& d = sink.report(say::NoModule.code, nullptr, {0, 0});
    CHECK(renderText(d, false) == "rapidc: error[RAP1301]: file contains no module, expected MODULE\n");
    const auto json = nlohmann::json::parse(renderJson(sink.sorted()));
    CHECK(json[0]["file"] == "");
    CHECK(json[0]["line"] == 1);
    CHECK(json[0]["column"] == 1);
}

TEST_CASE("JSON: an array of objects, columns count characters", "[diag]") {
    CHECK(nlohmann::json::parse(diag::renderJson({})) == nlohmann::json::array());
    diag::Sink sink;
    const auto source = file("é = 1;\n");
    sink.report(say::EqualInAssignment.code, source, {3, 4});
    const auto json = nlohmann::json::parse(renderJson(sink.sorted()));
    REQUIRE(json.size() == 1);
    CHECK(json[0] == nlohmann::json({{"file", "a.modx"},
                                     {"line", 1},
                                     {"column", 3},
                                     {"endLine", 1},
                                     {"endColumn", 4},
                                     {"severity", "error"},
                                     {"code", "RAP1205"},
                                     {"message", "found '=', expected ':='"}}));
}

TEST_CASE("comments outside of modules are noted once", "[diag]") {
    const auto notes = [](const char* text) {
        const test::Parsed parsed = test::parseText(text);
        size_t count = 0;
        for (const diag::Diagnostic& d : parsed.sink.all())
            count += d.code == say::CommentOutsideModule.code && d.severity == diag::Severity::Note ? 1 : 0;
        return std::make_pair(count, parsed.sink.all().size());
    };
    using Count = std::pair<size_t, size_t>;
    CHECK(notes("! a\n! b\nMODULE m\nENDMODULE\n! c\n") == Count{1, 1});
    CHECK(notes("MODULE m\nENDMODULE ! c") == Count{1, 1});
    CHECK(notes("%%%\n VERSION:1\n%%%\n! a\nMODULE m\nENDMODULE\n") == Count{1, 1});
    CHECK(notes("MODULE m ! a\n! b\nENDMODULE\nMODULE n\nENDMODULE\n") == Count{0, 0});
}

TEST_CASE("JSON: bytes that are not UTF-8 in a path", "[diag]") {
    diag::Sink sink;
    sink.report(say::NoModule.code, std::make_shared<const SourceFile>("\xFF.modx", ""), {0, 0});
    CHECK(nlohmann::json::parse(renderJson(sink.sorted())).size() == 1);
    CHECK_FALSE(nlohmann::json::parse(renderSarif(sink.sorted())).empty());
}

TEST_CASE("a fix is worded by what it changes", "[diag]") {
    diag::Sink sink;
    const auto source = file("x = 1\n");
    auto& d = sink.report(say::EqualInAssignment.code, source, {2, 3});
    d.fix({2, 3}, ":=").fix({5, 5}, ";", false).fix({1, 3}, "");
    REQUIRE(d.fixes.size() == 3);
    CHECK(d.fixes[0].message == "replace '=' with ':='");
    CHECK(d.fixes[0].certain);
    CHECK(d.fixes[1].message == "insert ';'");
    CHECK_FALSE(d.fixes[1].certain);
    CHECK(d.fixes[2].message == "remove '='");
    CHECK(renderText(d, false).find("\n      = help: insert ';'\n") != std::string::npos);
    const auto json = nlohmann::json::parse(renderJson(sink.sorted()));
    CHECK(json[0]["fixes"][0] == nlohmann::json({{"message", "replace '=' with ':='"},
                                                 {"certain", true},
                                                 {"edits", nlohmann::json::array({{{"file", "a.modx"},
                                                                                   {"line", 1},
                                                                                   {"column", 3},
                                                                                   {"endLine", 1},
                                                                                   {"endColumn", 4},
                                                                                   {"text", ":="}}})}}));
    const auto sarif = nlohmann::json::parse(renderSarif(sink.sorted()));
    const auto& change = sarif["runs"][0]["results"][0]["fixes"][1];
    CHECK(change["description"]["text"] == "insert ';'");
    CHECK(change["artifactChanges"][0]["artifactLocation"]["uri"] == "a.modx");
    const auto& replacement = change["artifactChanges"][0]["replacements"][0];
    CHECK(replacement["deletedRegion"] ==
          nlohmann::json({{"startLine", 1}, {"startColumn", 6}, {"endLine", 1}, {"endColumn", 6}}));
    CHECK(replacement["insertedContent"]["text"] == ";");
}

TEST_CASE("SARIF 2.1.0", "[diag]") {
    diag::Sink sink;
    const auto source = std::make_shared<const SourceFile>("my folder/a.modx", "x = 1;\n");
    auto& d = sink.report(say::EqualInAssignment.code, source, {2, 3});
    d.notes.push_back({source, {0, 1}, "here"});
    const auto sarif = nlohmann::json::parse(renderSarif(sink.sorted()));
    CHECK(sarif["version"] == "2.1.0");
    const auto& run = sarif["runs"][0];
    CHECK(run["tool"]["driver"]["name"] == "rapidc");
    CHECK(run["tool"]["driver"]["rules"][0]["id"] == "RAP1205");
    const auto& result = run["results"][0];
    CHECK(result["ruleId"] == "RAP1205");
    CHECK(result["level"] == "error");
    CHECK(result["message"]["text"] == "found '=', expected ':='");
    const auto& place = result["locations"][0]["physicalLocation"];
    CHECK(place["artifactLocation"]["uri"] == "my%20folder/a.modx");
    CHECK(place["region"]["startLine"] == 1);
    CHECK(place["region"]["startColumn"] == 3);
    CHECK(result["relatedLocations"][0]["message"]["text"] == "here");
}

TEST_CASE("SARIF: paths are relative to the root, outside of it file URIs", "[diag]") {
    diag::Sink sink;
    const auto uri = [](const std::string& path) {
        diag::Sink one;
        one.report(say::EqualInAssignment.code, std::make_shared<const SourceFile>(path, "x = 1;\n"), {2, 3});
        const auto sarif = nlohmann::json::parse(renderSarif(one.sorted(), "/work/cell 1"));
        CHECK(sarif["runs"][0]["originalUriBaseIds"]["%SRCROOT%"]["uri"] == "file:///work/cell%201/");
        const auto artifact =
            sarif["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"];
        return artifact["uri"].get<std::string>() + (artifact.contains("uriBaseId") ? "" : " absolute");
    };
    CHECK(uri("a.mod") == "a.mod");
    CHECK(uri("./RAPID/../a.mod") == "a.mod");
    CHECK(uri("/work/cell 1/RAPID/a.mod") == "RAPID/a.mod");
    CHECK(uri("/work/other/a.mod") == "file:///work/other/a.mod absolute");
    CHECK(uri("../a.mod") == "file:///work/a.mod absolute");
}

TEST_CASE("SARIF: what a code scanning service needs is there", "[diag]") {
    diag::Sink sink;
    const auto source = file("x = 1;\n\n  x  = 1;\nx = 2;\n");
    for (const uint32_t at : {2u, 13u, 19u})
        sink.report(say::EqualInAssignment.code, source, {at, at + 1});
    sink.report(say::NoInput.code, nullptr, {0, 0});
    const auto sarif = nlohmann::json::parse(renderSarif(sink.sorted(), "/work"));
    CHECK(sarif["$schema"].get<std::string>().find("sarif-2.1.0") != std::string::npos);
    REQUIRE(sarif["runs"].size() == 1);
    const auto& run = sarif["runs"][0];
    CHECK(run["columnKind"] == "unicodeCodePoints");
    const auto& rules = run["tool"]["driver"]["rules"];
    for (const auto& rule : rules) {
        for (const char* text : {"shortDescription", "fullDescription", "help"}) {
            INFO(rule["id"] << text);
            CHECK_FALSE(rule[text]["text"].get<std::string>().empty());
        }
        CHECK(rule["defaultConfiguration"]["level"] == "error");
    }
    std::set<std::string> fingerprints;
    for (const auto& result : run["results"]) {
        CHECK(rules[result["ruleIndex"].get<size_t>()]["id"] == result["ruleId"]);
        CHECK(result["locations"].size() == 1);
        const std::string mark = result["partialFingerprints"]["primaryLocationLineHash"];
        CHECK(fingerprints.insert(mark).second);
    }
    REQUIRE(run["results"].size() == 4);
    // The same text again is the same finding, counted.
    const std::string first = run["results"][1]["partialFingerprints"]["primaryLocationLineHash"];
    const std::string second = run["results"][2]["partialFingerprints"]["primaryLocationLineHash"];
    CHECK(first.substr(0, 17) == second.substr(0, 17));
    CHECK(first.substr(17) == "1");
    CHECK(second.substr(17) == "2");
}
