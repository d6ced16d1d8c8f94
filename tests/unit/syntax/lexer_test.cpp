// Tokens, literals and encodings (manual 1.1.2, 1.1.3).

#include "syntax_test.h"

#include "frontend/syntax/lexer.h"
#include "frontend/syntax/token_set.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace rapid;
using syntax::TokenKind;

namespace {

/// Kinds of the tokens, without EndOfFile: "KwIf Identifier".
std::string kinds(const std::string& text) {
    const SourceFile file("a.modx", text);
    std::string out;
    for (const syntax::Token& token : syntax::lex(file.text()).tokens) {
        if (token.kind == TokenKind::EndOfFile) break;
        if (!out.empty()) out += ' ';
        out += syntax::tokenKindName(token.kind);
    }
    return out;
}

size_t errorCount(const std::string& text) {
    const SourceFile file("a.modx", text);
    return syntax::lex(file.text()).errors.size();
}

} // namespace

TEST_CASE("every keyword is found in any case", "[syntax][lexer]") {
    for (auto k = static_cast<int>(TokenKind::KwAlias); k <= static_cast<int>(TokenKind::KwXor); ++k) {
        const auto kind = static_cast<TokenKind>(k);
        std::string word(syntax::tokenText(kind));
        CHECK(syntax::keywordKind(word) == kind);
        for (char& c : word)
            c = static_cast<char>(c + 32);
        CHECK(syntax::keywordKind(word) == kind);
        word[0] = static_cast<char>(word[0] - 32);
        CHECK(syntax::keywordKind(word) == kind);
        CHECK(syntax::keywordKind(word + "x") == TokenKind::Identifier);
        CHECK(syntax::keywordKind(word.substr(1) + "_") == TokenKind::Identifier);
    }
    CHECK(syntax::keywordKind("TASK") == TokenKind::Identifier);
    CHECK(syntax::keywordKind("switch") == TokenKind::Identifier);
}

TEST_CASE("punctuation, relations and placeholders", "[syntax][lexer]") {
    CHECK(
        kinds("; , : := . ( ) { } [ ] \\ ? | % + - * / < <= = <> >= >") ==
        "Semicolon Comma Colon Assign Dot LeftParen RightParen LeftBrace RightBrace LeftBracket RightBracket "
        "Backslash Question Bar Percent Plus Minus Star Slash Less LessEqual Equal NotEqual GreaterEqual "
        "Greater");
    CHECK(
        kinds("<TDN><ddn><Rdn><PAR><ALT><DIM><SMT><VAR><EIT><CSE><EXP><ARG><ID>") ==
        "PlaceTdn PlaceDdn PlaceRdn PlacePar PlaceAlt PlaceDim PlaceSmt PlaceVar PlaceEit PlaceCse PlaceExp "
        "PlaceArg PlaceId");
    CHECK(kinds("a<b") == "Identifier Less Identifier");
    CHECK(kinds("a< ID>b") == "Identifier Less Identifier Greater Identifier");
    CHECK(kinds("a:=<EXP>;") == "Identifier Assign PlaceExp Semicolon");
    CHECK(kinds("a<=b<>c") == "Identifier LessEqual Identifier NotEqual Identifier");
}

TEST_CASE("white space and comments are gaps", "[syntax][lexer]") {
    CHECK(kinds("a\tb\fc\r\nd\re\nf") == "Identifier Identifier Identifier Identifier Identifier Identifier");
    CHECK(kinds("a ! b ; \"c\" 中 🤖\nd!\n!") == "Identifier Identifier");
    CHECK(kinds("a!\rb") == "Identifier Identifier");
    CHECK(kinds("a\x1a") == "Identifier");
    CHECK(errorCount("a\x1a") == 0);
}

TEST_CASE("letters of ISO 8859-1 belong to names", "[syntax][lexer]") {
    CHECK(kinds("Größe_1 ÿ Àb") == "Identifier Identifier Identifier");
    CHECK(kinds("a×b") == "Identifier Star Identifier");
    CHECK(kinds("a÷b") == "Identifier Slash Identifier");
    CHECK(kinds("Ωa") == "Error Identifier");
    CHECK(errorCount("Ωa") == 1);
}

TEST_CASE("numbers", "[syntax][lexer]") {
    struct Number {
        const char* text;
        double value;
        bool isInteger;
    };
    const Number numbers[] = {{"0", 0, true},
                              {"3", 3, true},
                              {"3E2", 300, true},
                              {"1e-3", 0.001, true},
                              {"2E+1", 20, true},
                              {"5.", 5, false},
                              {".5", 0.5, false},
                              {"3.25", 3.25, false},
                              {"5.E1", 50, false},
                              {".5e1", 5, false},
                              {"9E9", 9e9, true},
                              {"9E+09", 9e9, true},
                              {"0x1F", 31, true},
                              {"0XfF", 255, true},
                              {"0o17", 15, true},
                              {"0B101", 5, true},
                              {"4503599627370496", 4503599627370496.0, true},
                              {"0.1", 0.1, false},
                              {"123456789.123456789", 123456789.123456789, false},
                              {"1E308", 1e308, true},
                              {"1E-400", 0, true}};
    for (const Number& number : numbers) {
        INFO(number.text);
        CHECK(kinds(number.text) == "NumLiteral");
        CHECK(errorCount(number.text) == 0);
        const syntax::NumberValue value = syntax::numberValue(number.text);
        CHECK(value.valid);
        CHECK(value.inRange);
        CHECK(value.value == number.value);
        CHECK(value.isInteger == number.isInteger);
    }
    CHECK_FALSE(syntax::numberValue("1E309").inRange);
    CHECK(kinds("1-2") == "NumLiteral Minus NumLiteral");
    CHECK(kinds("a.b") == "Identifier Dot Identifier");
    for (const char* bad : {"1a", "0x", "0xg", "0b2", "0o8", "1e", "1e+", "1.2.3", "1..2", "5.x"}) {
        INFO(bad);
        CHECK(kinds(bad).starts_with("NumLiteral"));
        CHECK(errorCount(bad) == 1);
    }
}

TEST_CASE("strings", "[syntax][lexer]") {
    struct Text {
        const char* literal;
        const char* value;
    };
    const Text texts[] = {
        {R"("")", ""},
        {R"("abc")", "abc"},
        {R"("contains a "" character")", R"(contains a " character)"},
        {R"("contains a \\ character")", R"(contains a \ character)"},
        {R"("ends with BEL \07")", "ends with BEL \x07"},
        {R"("\0D\0a")", "\r\n"},
        {R"("\\0D")", R"(\0D)"},
        {R"("! no comment")", "! no comment"},
        {R"("中文 🤖")", "中文 🤖"},
        {R"("""")", "\""},
    };
    for (const Text& text : texts) {
        INFO(text.literal);
        CHECK(kinds(text.literal) == "StringLiteral");
        CHECK(errorCount(text.literal) == 0);
        CHECK(syntax::decodeStringLiteral(text.literal) == text.value);
    }
    CHECK(errorCount("\"" + std::string(80, 'a') + "\"") == 0);
    CHECK(errorCount("\"" + std::string(81, 'a') + "\"") == 1);
    std::string codes, quotes, wide;
    for (int i = 0; i < 80; ++i)
        codes += "\\41";
    for (int i = 0; i < 80; ++i)
        quotes += "\"\"";
    for (int i = 0; i < 41; ++i)
        wide += "é";
    CHECK(errorCount("\"" + codes + "\"") == 0);
    CHECK(errorCount("\"" + quotes + "\"") == 0);
    CHECK(errorCount("\"" + wide + "\"") == 1); // 82 bytes
    CHECK(errorCount("\"a\nb\"") == 2);
    CHECK(errorCount("\"a") == 1);
    CHECK(errorCount("\"\\q\"") == 1);
    CHECK(errorCount("\"\\0\"") == 1);
}

TEST_CASE("what a character is does not hang on an unreadable one before it", "[syntax][lexer]") {
    for (const char* text :
         {"a\u00A0b", "a \u2013 b", "\u201Ctext\u201D x", "\u201Copen", "'text' x", "a & b", "\"a\" & b",
          "~a", "a ^ b", "a\uFF1B b", "\u00AB a \u00BB b", "_a", "a \u2264 b"}) {
        INFO(text);
        CHECK(kinds(std::string("@ ") + text) == "Error " + kinds(text));
        CHECK(kinds(std::string("@ x ") + text) == "Error Identifier " + kinds(text));
        if (*text != '_') CHECK(errorCount(std::string("@ ") + text) == 1); // one report for the line
        CHECK(errorCount(std::string("@\n") + text) == 1 + errorCount(text));
    }
    CHECK(kinds("@\u00A0@ x") == "Error Error Identifier");
    CHECK(errorCount("@ \u201Ctext\u201D @") == 1);
    CHECK(errorCount("\u201Ctext\u201D @ @") == 2);
}

TEST_CASE("spaces of web pages are one mistake as long as nothing else is between them", "[syntax][lexer]") {
    CHECK(errorCount("\u00A0\u00A0\u00A0a") == 1);
    CHECK(errorCount("\u00A0 \u00A0  \u2007\u3000 a") == 1);
    CHECK(errorCount("\u00A0a\u00A0b") == 2);
    CHECK(errorCount("\u00A0a\n\u00A0b") == 2);
    const SourceFile file("a.modx", "a \u00A0 \u00A0b");
    const auto errors = syntax::lex(file.text()).errors;
    REQUIRE(errors.size() == 1);
    CHECK(errors[0].range.begin == 2);
    CHECK(errors[0].range.end == 7);
    CHECK(errors[0].fix == "   ");
}

TEST_CASE("the file header is one token", "[syntax][lexer]") {
    CHECK(kinds("%%%\nVERSION:1\nLANGUAGE:ENGLISH\n%%%\nMODULE m") == "FileHeader KwModule Identifier");
    CHECK(kinds("MODULE m ENDMODULE\n%%%\n  VERSION:1\n%%%\nMODULE n") ==
          "KwModule Identifier KwEndmodule FileHeader KwModule Identifier");
    CHECK(kinds(std::string("MODULE m ENDMODULE \x1A\n\0\0\0", 24)) == "KwModule Identifier KwEndmodule");
    CHECK(kinds("! c\n\n%%%\r\n  VERSION:1\r\n%%%\r\nMODULE m") == "FileHeader KwModule Identifier");
    CHECK(kinds("MODULE %%%") == "KwModule Percent Percent Percent");
}

TEST_CASE("old file types are ISO 8859-1, new ones UTF-8", "[syntax][source]") {
    const std::string latin1 = "MODULE m\n  ! gr\xFC\xDF\n  VAR num \xE4;\nENDMODULE\n";
    const test::Parsed old = test::parseText(latin1, false, "A.MOD");
    CHECK(old.codes().empty());
    CHECK(old.tree->source->encoding() == Encoding::Latin1);
    CHECK(old.tree->source->text() == "MODULE m\n  ! grüß\n  VAR num ä;\nENDMODULE\n");
    CHECK(syntax::printSource(*old.tree) == old.tree->source->text());

    const test::Parsed wrong = test::parseText(latin1, false, "a.modx");
    CHECK(wrong.codes() == "RAP1004@2:7");
    CHECK(wrong.sink.all()[0].message.find("0xFC") != std::string::npos);

    const test::Parsed utf8 = test::parseText("MODULE m\n  VAR num ä; ! Ω\nENDMODULE\n", false, "a.mod");
    CHECK(utf8.codes().empty());
    CHECK(utf8.tree->source->encoding() == Encoding::Utf8);

    const test::Parsed bom = test::parseText("\xEF\xBB\xBFMODULE m\nENDMODULE\n");
    CHECK(bom.codes() == "RAP1005@1:1");
    CHECK_FALSE(bom.sink.hasErrors());
    CHECK(bom.tree->source->encoding() == Encoding::Utf8Bom);
}

TEST_CASE("overlong forms and surrogates are not UTF-8", "[syntax][source]") {
    for (const char* bytes : {"\xC0\x80", "\xC1\xBF", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80",
                              "\xF5", "\x80", "\xE4\xB8", "\xFF"}) {
        const SourceFile file("a.modx", std::string("! ") + bytes + "\n");
        CHECK(file.badUtf8Offset() == 2);
    }
    for (const char* bytes :
         {"\xC2\x80", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80", "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"})
        CHECK(SourceFile("a.modx", bytes).badUtf8Offset() == -1);
}

TEST_CASE("a binary file costs one diagnostic", "[syntax][source]") {
    using namespace std::string_literals;
    CHECK(test::parseText("MODULE m\0ENDMODULE\n"s).codes() == "RAP1002@1:1");
    CHECK(test::parseText("\xFC\x01\x02\x80 abc"s, false, "a.mod").codes() == "RAP6027@1:1"); // encrypted
    CHECK(test::parseText("\xFE\x10garbage\xFF"s, false, "a.sysx").codes() == "RAP6027@1:1");
    CHECK(test::parseText("\x80\x01\x02\x03\x04 abc"s, false, "a.mod").codes() == "RAP1002@1:1");
    CHECK(test::parseText("\xFF\xFEM\0O\0D\0"s).codes() == "RAP1003@1:1");
    CHECK(test::parseText("\xFE\xFF\0M\0O\0D"s).codes() == "RAP1003@1:1");
    std::string junk;
    for (int i = 0; i < 100000; ++i)
        junk.push_back(static_cast<char>(1 + i * 7919 % 251));
    const test::Parsed parsed = test::parseText(junk);
    CHECK(parsed.sink.errorCount() <= 2); // not UTF-8, and no module
    CHECK(syntax::printSource(*parsed.tree) == parsed.tree->source->text());
}

TEST_CASE("lines end with LF, CR or CRLF, columns count characters", "[syntax][source]") {
    const SourceFile file("a.modx", "ab\r\ncd\refé🤖x\n\n");
    CHECK(file.lineCount() == 5);
    CHECK(file.lineText(1) == "ab");
    CHECK(file.lineText(2) == "cd");
    CHECK(file.lineText(3) == "efé🤖x");
    CHECK(file.lineText(4).empty());
    CHECK(file.lineText(5).empty());
    const auto x = static_cast<uint32_t>(file.text().find('x'));
    CHECK(file.lineColumn(x).line == 3);
    CHECK(file.lineColumn(x).column == 5);
    CHECK(file.lineColumn(4).line == 2);
    CHECK(file.lineColumn(static_cast<uint32_t>(file.text().size())).line == 5);
    CHECK(SourceFile("a.modx", "").lineCount() == 1);
}
