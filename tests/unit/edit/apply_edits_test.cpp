// Edits change the bytes they mean and no others, in every encoding and with every line end.

#include "frontend/edit/apply_edits.h"

#include <catch2/catch.hpp>
#include <random>

using namespace rapid;
using edit::applyEdits;

namespace {

SourceRange find(const SourceFile& file, std::string_view part) {
    const size_t at = file.text().find(part);
    REQUIRE(at != std::string_view::npos);
    return {static_cast<uint32_t>(at), static_cast<uint32_t>(at + part.size())};
}

edit::EditResult replaceOne(const SourceFile& file, std::string_view part, const std::string& by) {
    const TextEdit change{find(file, part), by};
    return applyEdits(file, {&change, 1});
}

} // namespace

TEST_CASE("a source file gives its bytes back, whatever they are", "[edit][source]") {
    std::mt19937 random(7);
    const std::string pieces[] = {"a",    "!",    "\r\n", "\n", "\xE9", "\xC3\xA9", "\xE4\xB8\xAD",
                                  "\xC3", "\xA9", "\xFF"};
    for (int round = 0; round < 3000; ++round) {
        std::string bytes = round % 3 == 0 ? "\xEF\xBB\xBF" : "";
        for (uint32_t i = 0, n = random() % 12; i < n; ++i)
            bytes += pieces[random() % std::size(pieces)];
        for (const char* name : {"m.mod", "m.modx"}) {
            const SourceFile file(name, bytes);
            INFO(name << " " << bytes);
            REQUIRE(file.bytes() == bytes);
        }
    }
}

TEST_CASE("a replacement is written in the encoding of the file", "[edit]") {
    SECTION("ISO 8859-1") {
        const SourceFile file("m.mod", "! gr\xF6\xDF"
                                       "e\r\nx := 1;\r\n");
        CHECK(replaceOne(file, "1", "\"h\xC3\xB6her\"").bytes == "! gr\xF6\xDF"
                                                                 "e\r\nx := \"h\xF6her\";\r\n");
    }
    SECTION("UTF-8") {
        const SourceFile file("m.modx", "! gr\xC3\xB6\xC3\x9F"
                                        "e\nx := 1;\n");
        CHECK(replaceOne(file, "1", "\xE4\xB8\xAD").bytes == "! gr\xC3\xB6\xC3\x9F"
                                                             "e\nx := \xE4\xB8\xAD;\n");
    }
    SECTION("UTF-8 with byte order mark") {
        const SourceFile file("m.mod", "\xEF\xBB\xBFx := 1;\r");
        CHECK(replaceOne(file, "1", "\xC3\xB6").bytes == "\xEF\xBB\xBFx := \xC3\xB6;\r");
    }
    SECTION("a file of ASCII characters takes the encoding of its type") {
        CHECK(replaceOne(SourceFile("m.SYS", "x := 1;"), "1", "\xC3\xB6").bytes == "x := \xF6;");
        CHECK(replaceOne(SourceFile("m.sysx", "x := 1;"), "1", "\xC3\xB6").bytes == "x := \xC3\xB6;");
    }
    SECTION("bytes that are not UTF-8 stay in a file that should be UTF-8") {
        const SourceFile file("m.modx", "! \xE9 \xC3\xA9\nx := 1;\n");
        CHECK(replaceOne(file, "1", "2").bytes == "! \xE9 \xC3\xA9\nx := 2;\n");
    }
}

TEST_CASE("several edits in any order, and insertions at one place", "[edit]") {
    const SourceFile file("m.modx", "abcdef");
    const TextEdit edits[] = {{{4, 6}, "X"}, {{0, 1}, ""}, {{2, 2}, "1"}, {{2, 2}, "2"}, {{2, 3}, "Y"}};
    CHECK(applyEdits(file, edits).bytes == "b12YdX");
    CHECK(applyEdits(file, {}).bytes == "abcdef");
    const TextEdit end[] = {{{6, 6}, "!"}};
    CHECK(applyEdits(file, end).bytes == "abcdef!");
}

TEST_CASE("edits that do not fit are refused", "[edit]") {
    const SourceFile utf8("m.modx", "ab\xC3\xB6"
                                    "cd");
    const auto problem = [](const SourceFile& file, std::vector<TextEdit> edits) {
        const auto result = applyEdits(file, edits);
        CHECK(result.bytes.empty());
        return result.problem;
    };
    using Catch::Contains;
    CHECK_THAT(problem(utf8, {{{0, 2}, "x"}, {{1, 4}, "y"}}), Contains("overlap"));
    CHECK_THAT(problem(utf8, {{{0, 4}, "x"}, {{1, 1}, "y"}}), Contains("overlap"));
    CHECK_THAT(problem(utf8, {{{3, 3}, "x"}}), Contains("cuts a character"));
    CHECK_THAT(problem(utf8, {{{5, 9}, "x"}}), Contains("does not lie in the text"));
    CHECK_THAT(problem(utf8, {{{2, 1}, "x"}}), Contains("does not lie in the text"));
    CHECK_THAT(problem(utf8, {{{0, 1}, "\xE9"}}), Contains("not UTF-8"));
    CHECK_THAT(problem(SourceFile("m.mod", "x\xE9"), {{{0, 1}, "\xE4\xB8\xAD"}}), Contains("ISO 8859-1"));
    CHECK_THAT(problem(SourceFile("m.mod", "x"), {{{0, 1}, "\xE2\x82\xAC"}}), Contains("ISO 8859-1"));
    CHECK_THAT(problem(SourceFile("m.mod", "\xFC secret"), {{{0, 1}, "x"}}), Contains("encrypted"));
}

TEST_CASE("an edit that would turn one encoding into another is refused", "[edit]") {
    // In ISO 8859-1 the comment says "Ã©"; without the last byte the file would be UTF-8 and say "é".
    const SourceFile file("m.mod", "! \xC3\xA9 \xE9");
    REQUIRE(file.encoding() == Encoding::Latin1);
    const TextEdit removal{
        {static_cast<uint32_t>(file.text().size() - 2), static_cast<uint32_t>(file.text().size())}, ""};
    const auto result = applyEdits(file, {&removal, 1});
    CHECK_THAT(result.problem, Catch::Contains("another encoding"));
}

TEST_CASE("bytes outside of the edits are equal", "[edit][property]") {
    std::mt19937 random(11);
    const std::string marks[] = {"", "\xEF\xBB\xBF"};
    const std::string pieces[] = {"a",  "!",    " ",        "\r\n",         "\n",
                                  "\r", "\xE9", "\xC3\xA9", "\xE4\xB8\xAD", "\xFF"};
    int applied = 0;
    for (int round = 0; round < 4000; ++round) {
        // Pieces that are kept and pieces that are replaced, in turns; the expected bytes are built beside.
        const std::string name = round % 2 ? "m.mod" : "m.modx";
        std::string bytes = marks[random() % 2], wanted = bytes;
        std::string upTo = bytes;
        std::vector<std::pair<size_t, size_t>> replaced;
        const auto append = [&](bool keep) {
            const size_t from = bytes.size();
            for (uint32_t i = 0, n = 1 + random() % 4; i < n; ++i)
                bytes += pieces[random() % std::size(pieces)];
            if (keep)
                wanted += bytes.substr(from);
            else
                wanted += "<>", replaced.emplace_back(from, bytes.size());
        };
        for (uint32_t i = 0, n = 1 + random() % 4; i < n; ++i)
            append(true), append(false);
        append(true);
        const SourceFile file(name, bytes);
        const SourceFile expected(name, wanted);
        if (expected.encoding() != file.encoding()) continue; // refused, see above
        // Offsets in the text of byte positions: the text of the bytes before, in the same encoding.
        const auto textOffset = [&](size_t at) {
            uint32_t offset = 0;
            const size_t mark = file.encoding() == Encoding::Utf8Bom ? 3 : 0;
            while (file.bytes({0, offset}).size() + mark < at)
                ++offset;
            return offset;
        };
        std::vector<TextEdit> edits;
        for (const auto& [from, to] : replaced)
            edits.push_back({{textOffset(from), textOffset(to)}, "<>"});
        std::shuffle(edits.begin(), edits.end(), random);
        const auto result = applyEdits(file, edits);
        if (!result.ok()) continue; // pieces of a cut sequence that come together
        ++applied;
        INFO("round " << round);
        REQUIRE(result.bytes == wanted);
    }
    CHECK(applied > 2000);
}

TEST_CASE("the line end of most lines", "[edit]") {
    CHECK(edit::lineEnd("") == "\n");
    CHECK(edit::lineEnd("a\r\nb\r\nc\n") == "\r\n");
    CHECK(edit::lineEnd("a\nb\nc\r\n") == "\n");
    CHECK(edit::lineEnd("a\rb\r") == "\r");
}
