// Tokens made from those of an earlier version of a file are those of the text.

#include "frontend/syntax/lexer.h"
#include "tests/unit/syntax/syntax_test.h"

#include <catch2/catch.hpp>

#include <random>

namespace rapid::test {

namespace {

const std::string kText = R"(%%%
  VERSION:1
  LANGUAGE:ENGLISH
%%%
MODULE first(SYSMODULE)
  ! a comment with "quotes" and %%%
  CONST robtarget p1:=[[1,-2.5,3E2],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    IF a<>1 AND b!=2 THEN
      TPWrite "one \22 two""";  ! behind
      %"late"% 1;
    ENDIF
    x := 0xFF MOD 3; y{1}.z:=é;
  ENDPROC
ENDMODULE
%%%
  VERSION:1
%%%
MODULE second
ENDMODULE
)";

/// Every token with its place, and all that was said about the characters.
std::string describe(const Parsed& parsed) {
    return syntax::printTokens(*parsed.tree) + parsed.codes();
}

} // namespace

TEST_CASE("lines that are the same are not read again", "[syntax]") {
    const auto earlier = parseText(kText);
    for (const size_t at : {kText.find("TPWrite"), kText.find("ENDPROC"), kText.find("p1"), kText.size()}) {
        std::string text = kText;
        text.insert(at, "xyz ");
        syntax::SyntaxTree tree;
        tree.source = std::make_shared<const SourceFile>("test.modx", text);
        syntax::LexResult lexed;
        CHECK_FALSE(syntax::relex(tree, *earlier.tree, lexed)); // `!=` is read as '<>'
    }
    std::string plain = kText;
    plain.replace(plain.find("!="), 2, "<>");
    const auto good = parseText(plain);
    for (const size_t at : {plain.find("TPWrite"), plain.find("ENDPROC"), plain.find("p1"), plain.size()}) {
        std::string text = plain;
        text.insert(at, "xyz ");
        syntax::SyntaxTree tree;
        tree.source = std::make_shared<const SourceFile>("test.modx", text);
        syntax::LexResult lexed;
        CHECK(syntax::relex(tree, *good.tree, lexed));
        CHECK(tree.tokens.size() == good.tree->tokens.size() + 1);
    }
}

TEST_CASE("tokens of an edited text are those of the text", "[syntax]") {
    const std::vector<std::string> pieces = {"\n",         "%%%",       "\"",
                                             "!",          "ENDMODULE", "ENDMODULE\n%%%\n",
                                             "MODULE x\n", ";",         "-",
                                             "9E9",        "'",         "$",
                                             "/* ",        "\r",        std::string(1, '\0'),
                                             "é",          "!=",        "==",
                                             " ",          "\n\n",      "PROC p()\nENDPROC\n"};
    for (unsigned seed = 1; seed <= 20; ++seed) {
        std::mt19937 random(seed);
        std::string text = kText;
        auto earlier = parseText(text);
        for (int step = 0; step < 60; ++step) {
            const size_t at = random() % (text.size() + 1);
            const size_t length = random() % 3 == 0 ? std::min<size_t>(random() % 30, text.size() - at) : 0;
            text.replace(at, length, random() % 5 == 0 ? "" : pieces[random() % pieces.size()]);
            if (random() % 12 == 0) text = kText;
            Parsed again;
            syntax::ParseOptions options;
            options.earlier = earlier.tree.get();
            again.tree =
                syntax::parse(std::make_shared<const SourceFile>("test.modx", text), again.sink, options);
            const Parsed whole = parseText(text);
            INFO("seed " << seed << " step " << step << "\n" << text);
            REQUIRE(describe(again) == describe(whole));
            REQUIRE(syntax::printTree(*again.tree) == syntax::printTree(*whole.tree));
            earlier = std::move(again);
        }
    }
}

} // namespace rapid::test

TEST_CASE("tokens that were read as something else are not kept", "[syntax]") {
    for (const std::string wrong : {"TEST n\nCASE 1:\nELSE\n  n := 3;\nENDTEST", "n == 3;", "n := 7 % 3;",
                                    "WHIEL n < 3 DO\nENDWHILE", "RaiseToUser \\Continue;"}) {
        INFO(wrong);
        const auto earlier = rapid::test::parseText(rapid::test::inProcedure(wrong));
        CHECK(earlier.tree->retagged);
    }
}
