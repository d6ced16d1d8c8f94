// Whatever is formatted keeps its tokens and comments, and formatting it again changes nothing.

#include "format_testing.h"
#include "unit/syntax/ebnf.h"

#include "frontend/format/atoms.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace rapid;
using format::CommaSpacing;
using format::FormatRequest;
using format::KeywordCase;
using format::Spacing;

namespace {

std::string readBytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string((std::istreambuf_iterator<char>(file)), {});
}

/// Settings far from each other.
FormatRequest someSettings(uint32_t number) {
    FormatRequest request;
    auto& s = request.settings;
    if (number == 0) return request;
    s.indent = 1 + number % 8;
    s.tabs = number % 3 == 0;
    s.continuation = number % 5;
    s.maxBlankLines = number % 4;
    s.maxLineLength = number % 2 ? 20 + number % 60 : 0;
    s.keywords = static_cast<KeywordCase>(number % 3);
    s.assignments = static_cast<Spacing>(number / 3 % 3);
    s.operators = static_cast<Spacing>(number / 5 % 3);
    s.commas = static_cast<CommaSpacing>(number / 7 % 4);
    s.optionalArguments = static_cast<Spacing>(number / 2 % 3);
    s.labels = static_cast<format::LabelPlace>(number % 2);
    s.indentModule = number % 5 != 0;
    s.indentCase = number % 4 == 1;
    s.indentHandlers = number % 4 == 2;
    s.keepCommentsInFirstColumn = number % 7 == 3;
    return request;
}

/// Tokens and comments in order, names and words in lower case: the meaning, seen without the formatter's own check.
std::string essence(const std::string& text, bool declarations, const std::string& path) {
    const test::Parsed parsed = test::parseText(text, declarations, path);
    std::string out;
    for (const format::Atom& atom : format::collectAtoms(*parsed.tree, 1)) {
        std::string piece(parsed.tree->source->text().substr(atom.begin, atom.end - atom.begin));
        if (!atom.isComment && piece[0] != '"' && piece.find('\n') == std::string::npos)
            for (char& c : piece)
                c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        out += piece + '\n';
    }
    return out;
}

void checkFormatting(const std::string& text, FormatRequest request, const std::string& path = "test.modx") {
    const std::string once = test::formatText(text, request, path);
    const std::string twice = test::formatText(once, request, path);
    const bool good = !once.starts_with("refused") && once == twice &&
                      essence(text, request.declarations, path) == essence(once, request.declarations, path);
    if (good) return;
    INFO("text\n" << text << "\nonce\n" << once << "\ntwice\n" << twice);
    REQUIRE_FALSE(once.starts_with("refused"));
    REQUIRE(once == twice);
    REQUIRE(essence(text, request.declarations, path) == essence(once, request.declarations, path));
}

/// The same tokens and comments with other white space between them.
std::string mangle(const std::string& text, bool declarations, std::mt19937& random) {
    const test::Parsed parsed = test::parseText(text, declarations);
    const auto atoms = format::collectAtoms(*parsed.tree, 4);
    std::string out;
    uint32_t end = 0;
    for (size_t i = 0; i < atoms.size(); ++i) {
        const bool needed = atoms[i].begin > end && i > 0;
        const bool afterComment = i > 0 && atoms[i - 1].isComment;
        const uint32_t choice = random() % 20;
        if (needed && atoms[i].newlines == 0 && !afterComment)
            out += choice < 2 ? "\t" : choice < 4 ? "   " : choice < 5 && !atoms[i].isComment ? "\n  " : " ";
        if (atoms[i].newlines > 0 || afterComment)
            out +=
                std::string(atoms[i].newlines + (choice < 2 ? 3 : 0), '\n') + std::string(random() % 9, ' ');
        if (choice == 7 && i > 0 && !afterComment && atoms[i].newlines > 0) out += "! added\n";
        out += text.substr(atoms[i].begin, atoms[i].end - atoms[i].begin);
        end = atoms[i].end;
    }
    return out;
}

std::vector<std::filesystem::path> modulesBelow(const std::string& folder) {
    std::vector<std::filesystem::path> out;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(RAPIDC_SOURCE_DIR "/" + folder)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".mod" || extension == ".modx" || extension == ".sys" || extension == ".sysx")
            out.push_back(entry.path());
    }
    std::sort(out.begin(), out.end());
    return out;
}

} // namespace

TEST_CASE("random sentences keep their tokens when formatted, and formatting is idempotent",
          "[format][property][slow]") {
    const auto grammar = test::readGrammar(readBytes(RAPIDC_SOURCE_DIR "/frontend/rapid.ebnf"));
    for (uint32_t seed = 0; seed < 800; ++seed) {
        std::mt19937 random(seed + 77);
        const auto sentence = test::deriveSentence(grammar, "file", 12 + seed % 24, random);
        const std::string text = test::layOut(sentence, random);
        INFO("seed " << seed);
        checkFormatting(text, someSettings(seed % 50 == 0 ? 0 : seed));
    }
}

TEST_CASE("every module of this repository can be formatted", "[format][property][slow]") {
    size_t formatted = 0;
    for (const char* folder : {"samples", "tests", "stdlib/decl", "stdlib/data"})
        for (const auto& path : modulesBelow(folder)) {
            const std::string text = readBytes(path);
            const bool declarations = std::string(folder).starts_with("stdlib");
            const std::string name = path.filename().string();
            const test::Parsed parsed = test::parseText(text, declarations, name);
            if (parsed.sink.hasErrors() || parsed.tree->source->isBinary()) continue;
            INFO(path);
            for (const uint32_t number : {0u, 1u, 2u, 3u, 11u, 40u}) {
                FormatRequest request = someSettings(number);
                request.declarations = declarations;
                checkFormatting(text, request, name);
            }
            ++formatted;
        }
    CHECK(formatted > 150);
}

TEST_CASE("modules with mangled white space are formatted", "[format][property]") {
    std::mt19937 random(5);
    size_t count = 0;
    for (const char* folder : {"samples", "tests/golden", "tests/syntax"})
        for (const auto& path : modulesBelow(folder)) {
            const std::string text(
                test::parseText(readBytes(path), false, path.filename().string()).tree->source->text());
            for (uint32_t round = 0; round < 3; ++round) {
                const std::string mangled = mangle(text, false, random);
                if (test::parseText(mangled).sink.hasErrors())
                    continue; // a line end too many may be a mistake
                INFO(path);
                checkFormatting(mangled, someSettings(round == 0 ? 0 : random() % 1000));
                ++count;
            }
        }
    CHECK(count > 200);
}
