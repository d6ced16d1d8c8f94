// The section "format" of a project file.

#include "frontend/format/read_settings.h"

#include <catch2/catch.hpp>

using namespace rapid;
using format::CommaSpacing;
using format::FormatSettings;
using format::KeywordCase;
using format::Spacing;

namespace {

struct Read {
    FormatSettings settings;
    std::vector<std::string> messages;
};

Read read(const std::string& json) {
    diag::Sink sink;
    const auto file = std::make_shared<const SourceFile>("rapidc.json", json);
    Read out;
    out.settings = format::readFormatSettings(project::readSettings(file, sink), sink);
    for (const diag::Diagnostic& diagnostic : sink.sorted())
        out.messages.push_back(diag::codeName(diagnostic.code) + " " + diagnostic.message);
    return out;
}

std::string only(const std::string& json) {
    const Read out = read(json);
    REQUIRE(out.messages.size() == 1);
    return out.messages[0];
}

} // namespace

TEST_CASE("every setting of the formatter is read", "[format][settings]") {
    const Read out = read(R"({"format": {"indent": 4, "tabs": true, "continuation": 8, "max-blank-lines": 1,
        "max-line-length": 100, "keywords": "lower", "names": "canonical", "assignments": "spaced",
        "operators": "keep", "commas": "arguments", "optional-arguments": "spaced", "labels": "code",
        "indent-module": false, "indent-case": true, "indent-handlers": true,
        "keep-comments-in-first-column": true}, "warnings": {}})");
    CHECK(out.messages.empty());
    const FormatSettings& s = out.settings;
    CHECK(s.indent == 4);
    CHECK(s.tabs);
    CHECK(s.continuation == 8);
    CHECK(s.maxBlankLines == 1);
    CHECK(s.maxLineLength == 100);
    CHECK(s.keywords == KeywordCase::Lower);
    CHECK(s.names == format::NameCase::Canonical);
    CHECK(s.assignments == Spacing::Spaced);
    CHECK(s.operators == Spacing::Keep);
    CHECK(s.commas == CommaSpacing::Arguments);
    CHECK(s.optionalArguments == Spacing::Spaced);
    CHECK(s.labels == format::LabelPlace::Code);
    CHECK_FALSE(s.indentModule);
    CHECK(s.indentCase);
    CHECK(s.indentHandlers);
    CHECK(s.keepCommentsInFirstColumn);
}

TEST_CASE("settings that are not named keep their default", "[format][settings]") {
    const Read out = read(R"({"format": {"indent": 2}})");
    CHECK(out.messages.empty());
    CHECK(out.settings.indent == 2);
    CHECK(out.settings.operators == Spacing::Tight);
    CHECK(read("{}").settings.indent == 3);
}

TEST_CASE("unknown settings and values that cannot be used are reported", "[format][settings]") {
    using Catch::Contains;
    CHECK_THAT(only(R"({"format": {"indnt": 2}})"), Contains("RAP6031") && Contains("'indent'"));
    CHECK_THAT(only(R"({"format": {"colour": "red"}})"),
               Contains("RAP6031") && Contains("'max-blank-lines'"));
    CHECK_THAT(only(R"({"format": {"indent": 0}})"), Contains("RAP6032") && Contains("from 1 to 16"));
    CHECK_THAT(only(R"({"format": {"indent": 2.5}})"), Contains("whole number"));
    CHECK_THAT(only(R"({"format": {"indent": "2"}})"), Contains("whole number"));
    CHECK_THAT(only(R"({"format": {"tabs": 1}})"), Contains("true or false"));
    CHECK_THAT(only(R"({"format": {"operators": "wide"}})"), Contains("'tight', 'spaced' or 'keep'"));
    CHECK_THAT(only(R"({"format": {"keywords": true}})"), Contains("'upper', 'lower' or 'keep'"));
}
