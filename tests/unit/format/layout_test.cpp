// The form of formatted text: one case a rule of docs/formatting.md.

#include "format_testing.h"

#include <catch2/catch.hpp>

using namespace rapid;
using format::CommaSpacing;
using format::FormatRequest;
using format::KeywordCase;
using format::Spacing;
using test::formatText;

namespace {

/// The lines of a procedure body, formatted; the module and the procedure around them are taken off again.
std::string body(const std::string& lines, const FormatRequest& request = {}) {
    std::string text = formatText("MODULE m\nPROC p()\n" + lines + "\nENDPROC\nENDMODULE\n", request);
    const std::string head = "MODULE m\n   PROC p()\n", tail = "\n   ENDPROC\nENDMODULE\n";
    if (!text.starts_with(head) || !text.ends_with(tail)) return text;
    return text.substr(head.size(), text.size() - head.size() - tail.size());
}

template <class Change> FormatRequest with(const Change& change) {
    FormatRequest request;
    change(request.settings);
    return request;
}

} // namespace

TEST_CASE("blocks are moved in by three columns and keywords are in upper case", "[format]") {
    CHECK(formatText("module m(sysmodule)\nrecord r\nnum a;\nendrecord\nalias num x;\ntask pers num t:=1;\n"
                     "local func num f(num a,inout bool b\\switch On|Switch Off)\nvar num v;\nif a=1 then\n"
                     "v:=true;\nelseif b then\nreturn 1;\nelse\nfor i from 1 to 3 step 2 do\nwhile not b do\n"
                     "stop;\nendwhile\nendfor\nendif\nerror(1)\nretry;\nundo\nexit;\nendfunc\nendmodule\n") ==
          "MODULE m(SYSMODULE)\n"
          "   RECORD r\n"
          "      num a;\n"
          "   ENDRECORD\n"
          "   ALIAS num x;\n"
          "   TASK PERS num t:=1;\n"
          "   LOCAL FUNC num f(num a,INOUT bool b\\switch On|switch Off)\n"
          "      VAR num v;\n"
          "      IF a=1 THEN\n"
          "         v:=TRUE;\n"
          "      ELSEIF b THEN\n"
          "         RETURN 1;\n"
          "      ELSE\n"
          "         FOR i FROM 1 TO 3 STEP 2 DO\n"
          "            WHILE NOT b DO\n"
          "               stop;\n"
          "            ENDWHILE\n"
          "         ENDFOR\n"
          "      ENDIF\n"
          "   ERROR (1)\n"
          "      RETRY;\n"
          "   UNDO\n"
          "      EXIT;\n"
          "   ENDFUNC\n"
          "ENDMODULE\n");
}

TEST_CASE("CASE and DEFAULT stand under TEST, or one level in", "[format]") {
    const std::string text = "TEST n\n! first\nCASE 1,2:a;\nCASE 3:\ndefault:\nb;\nENDTEST";
    CHECK(body(text) == "      TEST n\n"
                        "      ! first\n"
                        "      CASE 1,2:\n"
                        "         a;\n"
                        "      CASE 3:\n"
                        "      DEFAULT:\n"
                        "         b;\n"
                        "      ENDTEST");
    CHECK(body(text, with([](auto& s) { s.indentCase = true; })) == "      TEST n\n"
                                                                    "         ! first\n"
                                                                    "         CASE 1,2:\n"
                                                                    "            a;\n"
                                                                    "         CASE 3:\n"
                                                                    "         DEFAULT:\n"
                                                                    "            b;\n"
                                                                    "      ENDTEST");
}

TEST_CASE("handlers one level in, declarations of a module not", "[format]") {
    const auto request = with([](auto& s) { s.indentHandlers = true, s.indentModule = false, s.indent = 2; });
    CHECK(formatText("MODULE m\nPROC p()\na;\nERROR\nb;\nUNDO\nc;\nENDPROC\nENDMODULE", request) ==
          "MODULE m\nPROC p()\n  a;\n  ERROR\n    b;\n  UNDO\n    c;\nENDPROC\nENDMODULE\n");
}

TEST_CASE("each instruction is on a line of its own", "[format]") {
    CHECK(body("a;b; IF x THEN c; ENDIF here: GOTO here;") == "      a;\n"
                                                              "      b;\n"
                                                              "      IF x THEN\n"
                                                              "         c;\n"
                                                              "      ENDIF\n"
                                                              "here:\n"
                                                              "      GOTO here;");
}

TEST_CASE("labels stand in the first column, or with the code", "[format]") {
    const std::string text = "a;\n  ! again\nagain: b;\nGOTO again;";
    CHECK(body(text) == "      a;\n      ! again\nagain:\n      b;\n      GOTO again;");
    CHECK(body(text, with([](auto& s) { s.labels = format::LabelPlace::Code; })) ==
          "      a;\n      ! again\n      again:\n      b;\n      GOTO again;");
}

TEST_CASE("a compact IF stays on its line, and its instruction one level in on the next", "[format]") {
    CHECK(body("IF a   b;\nIF a\nb;\nIF a IF c\nd;\nIF a\nIF c THEN\nd;\nENDIF\ne;") == "      IF a b;\n"
                                                                                        "      IF a\n"
                                                                                        "         b;\n"
                                                                                        "      IF a IF c\n"
                                                                                        "         d;\n"
                                                                                        "      IF a\n"
                                                                                        "         IF c THEN\n"
                                                                                        "            d;\n"
                                                                                        "         ENDIF\n"
                                                                                        "      e;");
}

TEST_CASE("semicolons follow directly what they end", "[format]") {
    CHECK(body("a ;\nb\n;\nIF x THEN ENDIF ;\n;") == "      a;\n      b;\n      IF x THEN\n      ENDIF;;");
    CHECK(body("a ! why\n;") == "      a ! why\n            ;");
}

TEST_CASE("spaces as RobotStudio writes them", "[format]") {
    CHECK(body("MoveL   Offs( p1 , 0,0 , 10 ) , v100, fine,tool0 \\WObj := wobj0;") ==
          "      MoveL Offs(p1,0,0,10),v100,fine,tool0\\WObj:=wobj0;");
    CHECK(body("a{ 1 , 2 } . x := - b * ( - 1 + c ) DIV 2;") == "      a{1,2}.x:=-b*(-1+c) DIV 2;");
    CHECK(body("TPWrite  (\"a\"+b);WaitTime\\InPos , 0;Stop \\ NoRegain;") ==
          "      TPWrite (\"a\"+b);\n      WaitTime\\InPos,0;\n      Stop\\NoRegain;");
    CHECK(body("IF NOT(a) AND b <> - 1 OR [1,2] = c RETURN - 1;") ==
          "      IF NOT (a) AND b<>-1 OR [1,2]=c RETURN -1;");
    CHECK(body("% \"p\" + x % a , b \\ c ? d;%\"q\"%;") == "      %\"p\"+x% a,b\\c?d;\n      %\"q\"%;");
    CHECK(body("foo -1,- a;foo [1];foo \"s\";foo +1;") ==
          "      foo -1,-a;\n      foo [1];\n      foo \"s\";\n      foo +1;");
    CHECK(body("CONNECT  irq WITH t;FOR i FROM - 1 TO n DO ENDFOR RAISE  ERR_X;") ==
          "      CONNECT irq WITH t;\n      FOR i FROM -1 TO n DO\n      ENDFOR\n      RAISE ERR_X;");
}

TEST_CASE("spaces by the settings", "[format]") {
    CHECK(body("a:=b*c;", with([](auto& s) { s.assignments = Spacing::Spaced; })) == "      a := b*c;");
    CHECK(body("a:=b*c<d;", with([](auto& s) { s.operators = Spacing::Spaced; })) == "      a:=b * c < d;");
    CHECK(body("a :=b* c;", with([](auto& s) { s.operators = s.assignments = Spacing::Keep; })) ==
          "      a :=b* c;");
    const std::string lists = "MoveL f(p,1),[1,2],a{1,2} \\X:=1;";
    CHECK(body(lists, with([](auto& s) { s.commas = CommaSpacing::Arguments; })) ==
          "      MoveL f(p, 1), [1,2], a{1,2}\\X:=1;");
    CHECK(body(lists, with([](auto& s) { s.commas = CommaSpacing::Spaced; })) ==
          "      MoveL f(p, 1), [1, 2], a{1, 2}\\X:=1;");
    CHECK(body(lists, with([](auto& s) { s.optionalArguments = Spacing::Spaced; })) ==
          "      MoveL f(p,1),[1,2],a{1,2} \\X:=1;");
}

TEST_CASE("words used as names keep their case", "[format]") {
    CHECK(body("RaiseToUser \\Continue;RaiseToUser \\break;Continue;") ==
          "      RaiseToUser\\Continue;\n      RaiseToUser\\break;\n      CONTINUE;");
    CHECK(body("if a Return;", with([](auto& s) { s.keywords = KeywordCase::Keep; })) ==
          "      if a Return;");
    CHECK(formatText("MODULE m\nVAR num a;\nENDMODULE\n", with([](auto& s) {
                         s.keywords = KeywordCase::Lower;
                     })) == "module m\n   var num a;\nendmodule\n");
}

TEST_CASE("predefined names are spelt as declared, if wanted, unless the file declares them", "[format]") {
    const format::NameTable names = {{"movel", "MoveL"}, {"num", "num"}, {"tool0", "tool0"}, {"abs", "Abs"}};
    auto request = with([](auto& s) { s.names = format::NameCase::Canonical; });
    request.names = &names;
    CHECK(body("VAR NUM Abs2;\nMOVEL p1,TOOL0;x:=ABS(y)+r.ABS;", request) ==
          "      VAR num Abs2;\n      MoveL p1,tool0;\n      x:=Abs(y)+r.ABS;");
    CHECK(body("VAR num ABS;\nabs:=1;movel ABS;", request) ==
          "      VAR num ABS;\n      abs:=1;\n      MoveL ABS;");
}

TEST_CASE("blank lines are kept up to a number, and the file ends with one line end", "[format]") {
    CHECK(formatText("\n\n! head\n\n\n\n\nMODULE m\n\nVAR num a;\n\n\n\n\nENDMODULE\n\n\n") ==
          "! head\n\n\nMODULE m\n\n   VAR num a;\n\n\nENDMODULE\n");
    CHECK(formatText("MODULE m\n\nENDMODULE", with([](auto& s) { s.maxBlankLines = 0; })) ==
          "MODULE m\nENDMODULE\n");
}

TEST_CASE("line ends and encodings are kept", "[format]") {
    CHECK(formatText("MODULE m\r\nVAR num a;VAR num b;\r\nENDMODULE") ==
          "MODULE m\r\n   VAR num a;\r\n   VAR num b;\r\nENDMODULE\r\n");
    CHECK(formatText("MODULE m\rVAR num a;\rENDMODULE\r") == "MODULE m\r   VAR num a;\rENDMODULE\r");
    CHECK(formatText("\xEF\xBB\xBFMODULE m\n! \xC3\xB6\nENDMODULE\n") ==
          "\xEF\xBB\xBFMODULE m\n   ! \xC3\xB6\nENDMODULE\n");
    CHECK(formatText("MODULE m\n! \xF6  \nENDMODULE\n", {}, "m.mod") == "MODULE m\n   ! \xF6\nENDMODULE\n");
}

TEST_CASE("the file header stays as it is", "[format]") {
    CHECK(formatText("%%%\n  VERSION:1\n  LANGUAGE:ENGLISH\n%%%\n\nmodule m\nendmodule\n") ==
          "%%%\n  VERSION:1\n  LANGUAGE:ENGLISH\n%%%\n\nMODULE m\nENDMODULE\n");
}

TEST_CASE("comments stand with the code they precede", "[format]") {
    CHECK(body("!first\n  a;\n!@ second\nIF x THEN\n!! in\nb;\n!last\nENDIF") == "      !first\n"
                                                                                 "      a;\n"
                                                                                 "      !@ second\n"
                                                                                 "      IF x THEN\n"
                                                                                 "         !! in\n"
                                                                                 "         b;\n"
                                                                                 "         !last\n"
                                                                                 "      ENDIF");
    // Set under the word that ends the block by somebody who moves blocks in.
    CHECK(body("IF x THEN\n  b;\n  ! b\n! otherwise\nELSE\n  c;\nENDIF") == "      IF x THEN\n"
                                                                            "         b;\n"
                                                                            "         ! b\n"
                                                                            "      ! otherwise\n"
                                                                            "      ELSE\n"
                                                                            "         c;\n"
                                                                            "      ENDIF");
    CHECK(body("!old\n a;", with([](auto& s) { s.keepCommentsInFirstColumn = true; })) == "!old\n      a;");
}

TEST_CASE("each of many comments before the end of a block is judged for itself", "[format]") {
    CHECK(body("IF x THEN\n  b;\n! else 1\n  ! b 1\n! else 2\n  ! b 2\nELSE\n  c;\n  ! c\n! end 1\n! end "
               "2\nENDIF") == "      IF x THEN\n"
                              "         b;\n"
                              "      ! else 1\n"
                              "         ! b 1\n"
                              "      ! else 2\n"
                              "         ! b 2\n"
                              "      ELSE\n"
                              "         c;\n"
                              "         ! c\n"
                              "      ! end 1\n"
                              "      ! end 2\n"
                              "      ENDIF");
    std::string written = "IF x THEN\n  b;\n", expected = "      IF x THEN\n         b;\n";
    for (int i = 0; i < 2000; ++i) {
        written += i % 2 ? "! end\n" : "  ! b\n";
        expected += i % 2 ? "      ! end\n" : "         ! b\n";
    }
    CHECK((body(written + "ENDIF") == expected + "      ENDIF"));
}

TEST_CASE("comments after code keep their column when they share one", "[format]") {
    CHECK(body("a;! x\nbcd;      ! y") == "      a; ! x\n      bcd; ! y");
    CHECK(body("a;     ! x\nbcd;   ! y\n       ! more") ==
          "      a;     ! x\n      bcd;   ! y\n             ! more");
    CHECK(body("a := 1;  ! x\nbcd;     ! y") == "      a:=1;  ! x\n      bcd;   ! y");
}

TEST_CASE("breaks inside instructions are kept", "[format]") {
    CHECK(body("MoveL p1,\nv100,\n   fine,tool0;") ==
          "      MoveL p1,\n            v100,\n            fine,tool0;");
    CHECK(body("a:=[[1,2],\n[3,\n4]];") == "      a:=[[1,2],\n          [3,\n           4]];");
    CHECK(body("a:=[\n[1,2],\n[3,4]\n];") == "      a:=[\n         [1,2],\n         [3,4]\n      ];");
    CHECK(body("a:=f(b,\nc\n);") == "      a:=f(b,\n           c\n          );");
    CHECK(body("x:=a\n+b ! why\n+c;", with([](auto& s) { s.continuation = 2; })) ==
          "      x:=a\n        +b ! why\n        +c;");
}

TEST_CASE("long lines are broken after commas, the outermost first, if wanted", "[format]") {
    const auto request = with([](auto& s) { s.maxLineLength = 30; });
    CHECK(body("MoveL Offs(p1,100,200,300),v1000,fine,tool0;", request) ==
          "      MoveL Offs(p1,100,200,\n                 300),v1000,\n            fine,tool0;");
    CHECK(body("a:=[[1,2,3],[4,5,6],[7,8,9]];", request) ==
          "      a:=[[1,2,3],[4,5,6],\n          [7,8,9]];");
}

TEST_CASE("tabs, if wanted", "[format]") {
    CHECK(formatText("MODULE m\nPROC p()\na 1,\n2;\nENDPROC\nENDMODULE", with([](auto& s) {
                         s.tabs = true, s.indent = 4;
                     })) == "MODULE m\n\tPROC p()\n\t\ta 1,\n\t\t        2;\n\tENDPROC\nENDMODULE\n");
}

TEST_CASE("placeholders and several modules", "[format]") {
    CHECK(formatText(
              "MODULE a\n<ddn>\nPROC p()\n<DDN>\n<smt>\nIF <EXP> THEN\n<EIT>\nENDIF\nIF x <SMT>\nENDPROC\n"
              "<RDN>\nENDMODULE MODULE b\nENDMODULE") == "MODULE a\n"
                                                         "   <DDN>\n"
                                                         "   PROC p()\n"
                                                         "      <DDN>\n"
                                                         "      <SMT>\n"
                                                         "      IF <EXP> THEN\n"
                                                         "      <EIT>\n"
                                                         "      ENDIF\n"
                                                         "      IF x <SMT>\n"
                                                         "   ENDPROC\n"
                                                         "   <RDN>\n"
                                                         "ENDMODULE\n"
                                                         "MODULE b\n"
                                                         "ENDMODULE\n");
}

TEST_CASE("a range of lines changes these lines only", "[format]") {
    FormatRequest request;
    request.firstLine = 3;
    request.lastLine = 4;
    CHECK(
        formatText("MODULE m\nVAR num a;  \nvar num b;  \n VAR num  c;  \nvar num d;\nENDMODULE", request) ==
        "MODULE m\nVAR num a;  \n   VAR num b;\n   VAR num c;\nvar num d;\nENDMODULE");
    // The lines of the file header count.
    request.firstLine = request.lastLine = 6;
    CHECK(formatText("%%%\nVERSION:1\n%%%\nMODULE m\nVAR  num a;\nVAR  num b;\nVAR  num c;\nVAR  num d;\n"
                     "VAR  num e;\nENDMODULE\n",
                     request) ==
          "%%%\nVERSION:1\n%%%\nMODULE m\nVAR  num a;\n   VAR num b;\nVAR  num c;\nVAR  num d;\n"
          "VAR  num e;\nENDMODULE\n");
    request.firstLine = 3;
    request.lastLine = 4;
    // A line that shares an instruction with lines outside keeps its breaks.
    CHECK(formatText("MODULE m\nVAR\nnum b;VAR num c\n;\nVAR num d;\nENDMODULE", request) ==
          "MODULE m\nVAR\n         num b;\n   VAR num c;\nVAR num d;\nENDMODULE");
}

TEST_CASE("what is right does not become wrong on a line of its own", "[format]") {
    // Words that could stand for keywords if they were alone in their line.
    for (const std::string call :
         {"ENDSUB", "Repeat", "Loop", "Begin", "Try", "ENDPROG", "Errors", "Undos", "ENDIFS"}) {
        for (const std::string argument :
             {"5", "\"text\"", "(a)", "[1,2]", "\\a", "-a", "NOT a", "n:=5", "a", "a,b"}) {
            const std::string text =
                "MODULE m\nPROC p()\nVAR num n;" + call + "\n" + argument + ";\nENDPROC\nENDMODULE\n";
            INFO(text);
            const std::string formatted = formatText(text);
            if (formatted == "refused: the file has mistakes") continue; // read so before and after
            CHECK(formatText(formatted) == formatted);
            CHECK(formatted.find("      " + call + "\n") != std::string::npos);
        }
    }
    CHECK(formatText("MODULE m\nPROC p()\nx:=1;Errors (1);\nIF a Them\n1;\nENDPROC\nENDMODULE\n") ==
          "MODULE m\n   PROC p()\n      x:=1;\n      Errors (1);\n      IF a Them\n            1;\n"
          "   ENDPROC\nENDMODULE\n");
}

TEST_CASE("a range that cuts an instruction leaves it as it is", "[format]") {
    FormatRequest request;
    request.firstLine = 4;
    request.lastLine = 8;
    // Further in than n, Foo would end its line.
    CHECK(formatText("MODULE m\nPROC q()\nENDPROC\nPROC r()\nx :=1;\nENDPROC\nPROC p()\nFoo\n n := 1;\n"
                     "ENDPROC\nENDMODULE\n",
                     request) ==
          "MODULE m\nPROC q()\nENDPROC\n   PROC r()\n      x:=1;\n   ENDPROC\nPROC p()\nFoo\n n := 1;\n"
          "ENDPROC\nENDMODULE\n");
}

TEST_CASE("modules with mistakes are refused, or formatted around them", "[format]") {
    const std::string text =
        "MODULE m\nvar num a;\nPROC p()\n  a := ;\n IF a THEN\nENDPROC\nproc q()\na;\nENDPROC\nENDMODULE\n";
    CHECK(formatText(text) == "refused: the file has mistakes");
    FormatRequest request;
    request.keepErrors = true;
    CHECK(formatText(text, request) == "MODULE m\n   VAR num a;\nPROC p()\n  a := ;\n IF a THEN\nENDPROC\n"
                                       "   PROC q()\n      a;\n   ENDPROC\nENDMODULE\n");
    CHECK(formatText("hello", request).starts_with("refused"));
    // A misspelt word that touches another declaration.
    CHECK(formatText("MODULE m\nVAR num h <CSE>\n;NDMODULE\n", request) ==
          "MODULE m\nVAR num h <CSE>\n;\nNDMODULE\n");
    // The end of the file ends a line.
    CHECK(formatText("MODULE m\nPROC p()\n a := ;\nEND", request) == "MODULE m\nPROC p()\n a := ;\nEND\n");
    const std::string unfinished = "MODULE m\nVAR num  a;\nPROC a;d;\n";
    CHECK(formatText(unfinished, request) == "MODULE m\n   VAR num a;\nPROC a;d;\n");
    CHECK(formatText(unfinished.substr(0, unfinished.size() - 1), request) ==
          "MODULE m\n   VAR num a;\nPROC a;d;\n");
    // A mistake at the end of the line of another declaration.
    CHECK(formatText("MODULE m\nVAR num n;ENDSUB\nn := a + a;\nPROC  p()\nENDPROC\nENDMODULE\n", request) ==
          "MODULE m\nVAR num n;ENDSUB\nn := a + a;\n   PROC p()\n   ENDPROC\nENDMODULE\n");
    // A stray semicolon: on the line of the misspelt word it would change what that is.
    CHECK(formatText("MODULE m\nRECORD r\nnum a;\nEDREORD\n;\nENDMODULE\n", request) ==
          "MODULE m\nRECORD r\nnum a;\nEDREORD\n;\nENDMODULE\n");
    // The text after an unreadable character is read the same on a line of its own: a space is one.
    CHECK(formatText("MODULE f;\xC2\x9C"
                     "ENDMODULE\u00A0",
                     request) == "MODULE f;\xC2\x9C\nENDMODULE\n");
    CHECK(formatText("\xFC\x01\x02", {}, "m.mod") == "refused: the file is encrypted or binary");
}
