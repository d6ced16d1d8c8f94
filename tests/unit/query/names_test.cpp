// Semantic tokens, hints, lenses, calls, links (editor contract 14 and 15).

#include "frontend/query/call_hierarchy.h"
#include "frontend/query/hints.h"
#include "frontend/query/links.h"
#include "frontend/query/semantic_tokens.h"
#include "query_testing.h"

#include <catch2/catch.hpp>

using namespace rapid;
using namespace rapid::query;
using namespace rapid::query::testing;

namespace {

std::string show(const FileView& file, const SemanticToken& token) {
    static constexpr const char* kNames[] = {"namespace", "type",     "function", "parameter",
                                             "variable",  "property", "label",    "keyword",
                                             "string",    "number",   "comment"};
    std::string out = std::string(file.text().substr(token.offset, token.length)) + " " +
                      kNames[static_cast<int>(token.type)];
    if (token.modifiers & kDeclaration) out += " declaration";
    if (token.modifiers & kReadonly) out += " readonly";
    if (token.modifiers & kDefaultLibrary) out += " library";
    if (token.modifiers & kStatic) out += " static";
    return out;
}

using Lines = std::vector<std::string>;

} // namespace

TEST_CASE("query: semantic tokens of every kind of name", "[query][tokens]") {
    const Program p(
        {"MODULE m\nRECORD part\nnum width;\nENDRECORD\nCONST num limit:=1;\nPERS part box:=[1];\nPROC "
         "main(num count)\n"
         "box.width:=limit+count;\nMoveL p,v100,fine,tool0\\WObj:=wobj0;\nENDPROC\nENDMODULE\n$1"});
    Lines lines;
    for (const SemanticToken& token : semanticTokens(p.snapshot(), p.file()))
        lines.push_back(show(p.file(), token));
    CHECK(lines == Lines{"m namespace declaration",
                         "part type declaration",
                         "num type library",
                         "width property declaration",
                         "num type library",
                         "limit variable declaration readonly",
                         "part type",
                         "box variable declaration static",
                         "main function declaration",
                         "num type library",
                         "count parameter declaration",
                         "box variable static",
                         "width property",
                         "limit variable readonly",
                         "count parameter",
                         "MoveL function library",
                         "v100 variable readonly library",
                         "fine variable readonly library",
                         "tool0 variable library static",
                         "WObj parameter library",
                         "wobj0 variable library static"});
}

TEST_CASE("query: semantic tokens of a range are those of the file there", "[query][tokens]") {
    const Program p({"MODULE m\nVAR num a;\nPROC one()\na:=1;\nENDPROC\nPROC two()\n$1a:=2; ! note\nTPWrite "
                     "\"x\";$2\nENDPROC\nENDMODULE\n"});
    std::vector<SemanticToken> expected;
    for (const SemanticToken& token : semanticTokens(p.snapshot(), p.file()))
        if (token.offset >= p.offset(1) && token.offset < p.offset(2)) expected.push_back(token);
    const auto part = semanticTokens(p.snapshot(), p.file(), {p.offset(1), p.offset(2)});
    REQUIRE(part.size() == expected.size());
    for (size_t i = 0; i < part.size(); ++i)
        CHECK(show(p.file(), part[i]) == show(p.file(), expected[i]));
    Lines all;
    for (const SemanticToken& token :
         semanticTokens(p.snapshot(), p.file(), {p.offset(1), p.offset(2)}, true))
        all.push_back(show(p.file(), token));
    CHECK(all ==
          Lines{"a variable", "2 number", "! note comment", "TPWrite function library", "\"x\" string"});
}

TEST_CASE("query: hints name required arguments and values of constants", "[query][hints]") {
    const Program p(
        {"MODULE m\nCONST num base:=2;\nCONST num area:=base*base;\nPROC report(string text\\num count,num "
         "level)\nENDPROC\nPROC main()\n"
         "report \"a\"\\count:=1,Abs(area);\nreport text:=\"b\",level:=1;\nENDPROC\nENDMODULE\n$1"});
    Lines lines;
    for (const InlayHint& hint : inlayHints(p.snapshot(), p.file(), {0, 10000}))
        lines.push_back(hint.label + (hint.isParameter ? " before " : " after ") +
                        std::string(p.file().text().substr(hint.isParameter ? hint.offset : hint.offset - 9,
                                                           hint.isParameter ? 3 : 9)));
    CHECK(lines ==
          Lines{"= 4 after base*base", "text: before \"a\"", "level: before Abs", "Value: before are"});
    CHECK(inlayHints(p.snapshot(), p.file(), {0, 30}).empty());
}

TEST_CASE("query: lenses of routines", "[query][hints]") {
    const Program p({"MODULE m\nPROC main()\nreport;\nreport;\nENDPROC\nPROC report(\\num a)\nENDPROC\nPROC "
                     "needs(num a)\nENDPROC\nFUNC num f()\nRETURN 1;\nENDFUNC\nENDMODULE\n$1"});
    const auto lenses = codeLenses(p.snapshot(), p.file());
    REQUIRE(lenses.size() == 4);
    CHECK((lenses[0].canRun && lenses[1].canRun));
    CHECK_FALSE((lenses[2].canRun || lenses[3].canRun));
    CHECK(lenses[0].task == "T_ROB1");
    CHECK(countReferences(p.snapshot(), lenses[1].key) == 2);
    CHECK(countReferences(p.snapshot(), lenses[0].key) == 0);
    CHECK(countReferences(p.snapshot(), "nothing") == 0);
}

TEST_CASE("query: calls of a routine, by name as well", "[query][calls]") {
    const Program p({"MODULE m\nVAR num start:=one();\nFUNC num one()\nRETURN 1;\nENDFUNC\nPROC "
                     "step1()\none;\nENDPROC\nPROC main()\nVAR intnum i;\nVAR num x;\nx:=o$1ne()+one();\n"
                     "step1;\n%\"step1\"%;\nCallByVar \"step\",x;\nCONNECT i WITH alarm;\nENDPROC\nTRAP "
                     "alarm\n$2 TPErase;\nENDTRAP\nENDMODULE\n",
                     "MODULE n\nPROC other()\nSt$3ep1;\nENDPROC\nENDMODULE\n"});
    const auto show = [](const std::vector<CallEdge>& edges) {
        Lines lines;
        for (const CallEdge& edge : edges)
            lines.push_back(edge.item.name + " " + std::to_string(edge.places.size()) +
                            (edge.byName ? " by name" : ""));
        return lines;
    };
    const auto at = [&](int m) { return callItemAt(p.snapshot(), p.file(m), p.offset(m)).value(); };
    CHECK(at(1).name == "one");
    CHECK(at(2).name == "alarm");
    const Lines callersOfOne = show(incomingCalls(p.snapshot(), at(1).key));
    CHECK(std::find(callersOfOne.begin(), callersOfOne.end(), "main 2") != callersOfOne.end());
    CHECK(show(incomingCalls(p.snapshot(), at(3).key)) == Lines{"main 3 by name", "other 1"});
    CHECK(show(incomingCalls(p.snapshot(), at(2).key)) == Lines{"main 1"});
    const auto main = incomingCalls(p.snapshot(), at(2).key).at(0).item;
    CHECK(show(outgoingCalls(p.snapshot(), main.key)) ==
          Lines{"one 2", "step1 3 by name", "CallByVar 1", "alarm 1"});
}

TEST_CASE("query: files that a program loads", "[query][links]") {
    const Program p({inMain("VAR loadsession s;\nLoad \"HOME:/part.modx\";\nLoad "
                            "\\Dynamic,\"HOME:\"\\File:=\"a.mod\";\nStartLoad \"HOME:/b.mod\",s;\n"
                            "UnLoad \"HOME:/sub\"\\File:=\"c.mod\";\nTPWrite \"HOME:/no.mod\";$1")});
    Lines paths;
    for (const FileLink& link : documentLinks(p.file())) {
        paths.push_back(link.path);
        CHECK(
            link.path.ends_with(p.file().text().substr(link.range.begin, link.range.end - link.range.begin)));
    }
    CHECK(paths == Lines{"HOME:/part.modx", "HOME:/a.mod", "HOME:/b.mod", "HOME:/sub/c.mod"});
    const std::string pgf = "<?xml version=\"1.0\"?>\n<Program>\n<!-- <Module>old.mod</Module> "
                            "-->\n<Module>main.mod</Module>\n<Module> sub\\tools.sys </Module></Program>";
    const auto links = programFileLinks(pgf);
    REQUIRE(links.size() == 2);
    CHECK(links[0].path == "main.mod");
    CHECK(links[1].path == "sub/tools.sys");
    CHECK(pgf.substr(links[1].range.begin, links[1].range.end - links[1].range.begin) == "sub\\tools.sys");
}
