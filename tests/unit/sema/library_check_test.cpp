// The declarations of the standard library are checked like a program. Programs with expected diagnostics: tests/diag, read by
// tests/harness/diagnostics.py.

#include "sema_testing.h"

#include <catch2/catch.hpp>

namespace {

using namespace rapid;

std::string describe(const diag::Diagnostic& d) {
    const LineColumn from = d.file->lineColumn(d.range.begin), to = d.file->lineColumn(d.range.end);
    return d.file->path() + ":" + std::to_string(from.line) + ":" + std::to_string(from.column) + "-" +
           std::to_string(to.column) + " " + std::string(diag::severityName(d.severity)) + "[" +
           diag::codeName(d.code) + "]: " + d.message;
}

} // namespace

TEST_CASE("the library checks without diagnostics", "[sema]") {
    diag::Sink sink;
    sema::CheckOptions options;
    options.library = sema::testing::library();
    REQUIRE(!options.library.empty());
    sema::check({}, options, sink);
    std::string problems;
    for (const diag::Diagnostic& d : sink.sorted())
        problems += describe(d) + "\n";
    CHECK(problems == "");
}
