// The files in tests/syntax are read without a diagnostic and without loss, and so is each beginning of them without
// a crash.

#include "syntax_test.h"

#include "frontend/syntax/tree_walk.h"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>

using namespace rapid;

namespace {

std::string readBytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string((std::istreambuf_iterator<char>(file)), {});
}

void checkRanges(const syntax::SyntaxTree& tree, const syntax::Node& node) {
    REQUIRE(node.last < tree.tokens.size());
    syntax::forEachChild(node, [&](const syntax::Node& child) {
        if (child.first <= child.last) {
            REQUIRE(child.first >= node.first);
            REQUIRE(child.last <= node.last);
        }
        checkRanges(tree, child);
    });
}

} // namespace

TEST_CASE("the syntax corpus is read without a diagnostic", "[syntax][corpus]") {
    size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(RAPIDC_SOURCE_DIR "/tests/syntax")) {
        if (entry.path().extension() == ".md") continue;
        ++files;
        const test::Parsed parsed =
            test::parseText(readBytes(entry.path()), false, entry.path().filename().string());
        INFO(entry.path() << "\n" << parsed.shown());
        for (const diag::Diagnostic& d : parsed.sink.all())
            CHECK(d.severity == diag::Severity::Note);
        CHECK(syntax::printSource(*parsed.tree) == parsed.tree->source->text());
        CHECK_FALSE(parsed.tree->modules.empty());
        for (const syntax::ModuleDecl* module : parsed.tree->modules)
            checkRanges(*parsed.tree, *module);
    }
    CHECK(files >= 7);
}

TEST_CASE("beginnings and gaps of the corpus are read without loss", "[syntax][corpus]") {
    const std::string text = readBytes(RAPIDC_SOURCE_DIR "/tests/syntax/pallet_cell.modx");
    REQUIRE_FALSE(text.empty());
    for (size_t at = 0; at < text.size(); at += 3) {
        for (const std::string& part :
             {text.substr(0, at), text.substr(at), text.substr(0, at) + text.substr(at + 1)}) {
            const test::Parsed parsed = test::parseText(part);
            REQUIRE(syntax::printSource(*parsed.tree) == part);
            for (const syntax::ModuleDecl* module : parsed.tree->modules)
                checkRanges(*parsed.tree, *module);
        }
    }
}

TEST_CASE("trees of modules with mistakes are in order", "[syntax][corpus]") {
    size_t files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(RAPIDC_SOURCE_DIR "/tests/diag")) {
        if (!entry.is_regular_file() || entry.path().extension() == ".md") continue;
        ++files;
        const test::Parsed parsed =
            test::parseText(readBytes(entry.path()), false, entry.path().filename().string());
        INFO(entry.path());
        for (const syntax::ModuleDecl* module : parsed.tree->modules)
            checkRanges(*parsed.tree, *module);
    }
    CHECK(files >= 200);
}

TEST_CASE("lines that are being written do not reach into the next instruction", "[syntax][corpus]") {
    for (const char* line :
         {"x :=", "x := f(", "x := p.", "x := 1 + a{", "x := 1 + (2 *", "p a, \\b:=", "p a,",
          "IF (x =", "IF x =", "WHILE (x < 2 +", "TEST x +", "RETURN 1 +", "x := [1, [2,", "x := -",
          "x := NOT", "FOR i FROM 1 TO", "Incr x{", "x := f(\\b:=", "x := f(1, 2 +"}) {
        const test::Parsed parsed =
            test::parseText(test::inProcedure(std::string(line) + "\n  y{1}.z := 1;\n  y := 1;"));
        INFO(line << "\n" << parsed.shown());
        CHECK(parsed.sink.hasErrors());
        for (const syntax::ModuleDecl* module : parsed.tree->modules)
            checkRanges(*parsed.tree, *module);
    }
}

TEST_CASE("each token that is missed costs few diagnostics", "[syntax][corpus]") {
    const std::string text = readBytes(RAPIDC_SOURCE_DIR "/tests/syntax/pallet_cell.modx");
    const test::Parsed whole = test::parseText(text);
    size_t total = 0, several = 0;
    for (const syntax::Token& token : whole.tree->tokens) {
        if (token.length == 0) continue;
        std::string broken = text;
        broken.replace(token.offset, token.length, " ");
        const size_t count = test::parseText(broken).sink.all().size();
        INFO("without token at " << token.offset << ": " << text.substr(token.offset, token.length));
        CHECK(count <= 3);
        ++total;
        several += count > 1;
    }
    INFO(several << " of " << total);
    CHECK(several * 50 <= total); // at most two in a hundred cost more than one
}
