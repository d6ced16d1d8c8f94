// Outline, workspace symbols, folding, selection (editor contract 13).

#include "frontend/query/structure.h"

#include "frontend/query/fuzzy.h"
#include "frontend/query/symbols.h"
#include "query_testing.h"

#include <catch2/catch.hpp>

using namespace rapid;
using namespace rapid::query;
using namespace rapid::query::testing;

namespace {

void show(const std::vector<OutlineSymbol>& symbols, std::string indent, std::string& out) {
    static constexpr const char* kNames[] = {"module", "record", "component", "alias", "const",
                                             "var",    "pers",   "proc",      "func",  "trap"};
    for (const OutlineSymbol& symbol : symbols) {
        CHECK(symbol.range.begin <= symbol.selection.begin);
        CHECK(symbol.selection.end <= symbol.range.end);
        out += indent + kNames[static_cast<int>(symbol.kind)] + " " + symbol.name +
               (symbol.detail.empty() ? "" : " " + symbol.detail) + "\n";
        show(symbol.children, indent + "  ", out);
    }
}

} // namespace

TEST_CASE("query: outline of a module, in the order of the text", "[query][outline]") {
    const Program p({"MODULE m\nPROC first(num a\n  \\switch b)\nENDPROC\nRECORD part\nnum width;\nstring "
                     "name;\nENDRECORD\nCONST num c:=1;\n"
                     "ALIAS num level;\nVAR num v;\nPERS num p:=1;\nFUNC num f()\nRETURN 1;\nENDFUNC\nTRAP "
                     "t\nENDTRAP\nENDMODULE\n$1"});
    std::string out;
    show(outlineOf(*p.file().tree), "", out);
    CHECK(out == "module m\n  proc first (num a \\switch b)\n  record part\n    component width num\n    "
                 "component name string\n  const c num\n"
                 "  alias level num\n  var v num\n  pers p num\n  func f () num\n  trap t\n");
}

TEST_CASE("query: outline of a module with mistakes", "[query][outline]") {
    const Program p({"MODULE m\nVAR num ;\nPROC a(\nVAR num n\nn := ;\nENDPROC\nVAR num v;\n$1"});
    std::string out;
    show(outlineOf(*p.file().tree), "", out);
    CHECK(out.find("module m\n") == 0);
    CHECK(out.find("proc a") != std::string::npos);
}

TEST_CASE("query: workspace symbols, the best matches first", "[query][outline]") {
    const Program p({"MODULE cell\nVAR num pick;\nPROC pickPart()\nENDPROC\nPROC doPick()\nENDPROC\nLOCAL "
                     "PROC other()\nVAR num pickLocal;\nENDPROC\nENDMODULE\n$1"});
    const auto found = workspaceSymbols(p.snapshot(), "pick");
    std::vector<std::string> names;
    for (const WorkspaceSymbol& symbol : found)
        names.push_back(symbol.name);
    CHECK(names == std::vector<std::string>{"pick", "pickPart", "doPick"});
    CHECK(found[1].container == "cell");
    CHECK(workspaceSymbols(p.snapshot(), "").size() == 5);
    CHECK(workspaceSymbols(p.snapshot(), "", 2).size() == 2);
}

TEST_CASE("query: letters of names", "[query][outline]") {
    CHECK(fuzzyMatch("mol", "MoveL"));
    CHECK(fuzzyMatch("divzero", "ERR_DIVZERO"));
    CHECK(fuzzyMatch("", "x"));
    CHECK_FALSE(fuzzyMatch("ovel", "MoveL"));
    CHECK_FALSE(fuzzyMatch("lm", "MoveL"));
}

TEST_CASE("query: folding ends before the end word", "[query][structure]") {
    const Program p(
        {"MODULE m\n! one\n! two\nRECORD r\nnum a;\nENDRECORD\nPROC main()\nIF TRUE THEN\nTPWrite "
         "\"a\";\nTPWrite \"b\";\nELSE\nTPWrite \"c\";\n"
         "ENDIF\nFOR i FROM 1 TO 2 DO\nTPWrite \"d\";\nENDFOR\nERROR\nRETRY;\nENDPROC\nENDMODULE\n$1"});
    std::vector<std::string> found;
    for (const FoldingRange& range : foldingRanges(p.file()))
        found.push_back(std::to_string(range.firstLine) + "-" + std::to_string(range.lastLine) +
                        (range.isComment ? " comment" : ""));
    CHECK(found == std::vector<std::string>{"1-19", "2-3 comment", "4-5", "7-18", "8-12", "8-10", "11-12",
                                            "14-15", "17-18"});
}

TEST_CASE("query: selection grows from the word to the text", "[query][structure]") {
    const Program p({inMain("IF x=1 THEN\nx:=Abs(y$1es+2);\nENDIF", "VAR num x;\nVAR num yes;\n")});
    std::vector<std::string> texts;
    for (const SourceRange& range : selectionRanges(p.file(), p.offset()))
        texts.emplace_back(p.file().text().substr(range.begin, range.end - range.begin));
    REQUIRE(texts.size() > 6);
    CHECK(texts[0] == "yes");
    CHECK(texts[1] == "yes+2");
    CHECK(texts[2] == "Abs(yes+2)");
    CHECK(texts[3].starts_with("x:=Abs(yes+2)"));
    CHECK(texts.back() == p.file().text());
    for (size_t i = 1; i < texts.size(); ++i)
        CHECK(texts[i].find(texts[i - 1]) != std::string::npos);
}
