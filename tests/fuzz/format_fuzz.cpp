// libFuzzer target: what can be read is formatted with some settings. The formatter's own check must never find a
// change, and formatting again must change nothing; around mistakes, tokens and comments must stay.
//
//   rapidc_fuzz_format -dict=tests/fuzz/dictionaries/rapid.dict <own corpus folder> tests/fuzz/corpus/format

#include "frontend/edit/apply_edits.h"
#include "frontend/format/formatter.h"
#include "frontend/syntax/parser.h"

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

namespace {

using namespace rapid;

void require(bool condition, const std::string& what) {
    if (condition) return;
    std::fprintf(stderr, "%s\n", what.c_str());
    std::abort();
}

/// Settings from a few bits of the input.
format::FormatSettings settingsFrom(uint32_t bits) {
    format::FormatSettings s;
    s.indent = 1 + bits % 5;
    s.tabs = (bits & 1) != 0;
    s.maxBlankLines = bits >> 1 & 3;
    s.maxLineLength = (bits & 8) != 0 ? 20 : 0;
    s.keywords = static_cast<format::KeywordCase>((bits >> 4) % 3);
    s.operators = static_cast<format::Spacing>((bits >> 5) % 3);
    s.commas = static_cast<format::CommaSpacing>((bits >> 6) % 4);
    s.keepCommentsInFirstColumn = (bits & 2) != 0;
    return s;
}

/// The formatted bytes; empty with `refused` set when there are none.
std::string formatOnce(const std::string& bytes, const format::FormatRequest& request, bool& refused) {
    const auto source = std::make_shared<const SourceFile>("fuzz.modx", bytes);
    diag::Sink sink;
    const auto tree = syntax::parse(source, sink);
    const auto result = format::format(*tree, format::errorRanges(sink), request);
    require(result.problem.find("please report") == std::string::npos, result.problem);
    refused = !result.ok();
    if (refused) return {};
    const auto changed = edit::applyEdits(*source, result.edits);
    refused = !changed.ok(); // for example repaired bytes that come together
    return changed.bytes;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string bytes(reinterpret_cast<const char*>(data), size);
    uint32_t bits = 0;
    for (const char c : bytes)
        bits = bits * 31 + static_cast<unsigned char>(c);
    format::FormatRequest request;
    request.settings = bits % 4 == 0 ? format::FormatSettings() : settingsFrom(bits);
    bool refused = false;
    const std::string once = formatOnce(bytes, request, refused);
    if (!refused) {
        const std::string twice = formatOnce(once, request, refused);
        require(!refused && once == twice, "formatting again changes the text");
        return 0;
    }
    request.keepErrors = true;
    formatOnce(bytes, request, refused);
    request.keepErrors = false;
    request.firstLine = 2;
    request.lastLine = 5;
    formatOnce(bytes, request, refused);
    return 0;
}
