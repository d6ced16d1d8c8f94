// What the diagnostics of lexer and parser mean.

#include "frontend/diag/explain.h"

#include <array>

namespace rapid::diag {

namespace {

using Kind = ExampleKind;

constexpr auto kExplanations = std::to_array<Explanation>({
    {1001, Kind::Body,
     "The character has no meaning in RAPID outside strings and comments. Names consist of letters of ISO "
     "8859-1, digits "
     "and '_', and begin with a letter (manual 1.1.2).",
     "reg1 := 5 @ 3;", "reg1 := 5 + 3;"},
    {1002, Kind::Files,
     "The file contains bytes that no text has. Modules that were encrypted by a controller look like this, "
     "and so do "
     "pictures or archives with a wrong name. Export the module as text.",
     R"ex($ rapidc check main.modx
main.modx (bytes 89 50 4E 47 0D 0A 1A 0A 00 00 00 0D 49 48 44 52):)ex",
     R"ex($ rapidc check main.modx
main.modx:
  MODULE MainModule
  ENDMODULE)ex"},
    {1003, Kind::Files,
     "Each character takes two bytes: the file was saved as UTF-16. Controllers of RobotWare 7 read UTF-8 "
     "without a byte "
     "order mark (manual 1.1.3).",
     R"ex($ rapidc check main.modx
main.modx (bytes FF FE 4D 00 4F 00 44 00 55 00 4C 00 45 00 20 00 6D 00):)ex",
     R"ex($ rapidc check main.modx
main.modx:
  MODULE MainModule
  ENDMODULE)ex"},
    {1004, Kind::Files,
     "Files named .modx and .sysx are UTF-8 (manual 1.1.3). Renaming a .mod file is not enough: its letters "
     "beyond ASCII "
     "have other bytes. Save the file as UTF-8, or keep the name .mod or .sys, which is read as ISO 8859-1.",
     R"ex($ rapidc check main.modx
main.modx (ISO 8859-1):
  MODULE MainModule
    ! Größe
  ENDMODULE)ex",
     R"ex($ rapidc check main.modx old.mod
main.modx:
  MODULE MainModule
    ! Größe
  ENDMODULE
old.mod (ISO 8859-1):
  MODULE old
    ! Größe
  ENDMODULE)ex"},
    {1005, Kind::File,
     "The file begins with the bytes EF BB BF. The manual asks for UTF-8 without them (1.1.3); rapidc reads "
     "the file, a "
     "controller may not.",
     "\xEF\xBB\xBFMODULE m\nENDMODULE", "MODULE m\nENDMODULE"},
    {1006, Kind::Body,
     "A string ends in the line in which it begins. A quotation mark inside a string is written twice. "
     "Longer texts are "
     "put together with +.",
     "TPWrite \"open the door;", "TPWrite \"open the door\";"},
    {1007, Kind::Body,
     "In a string '\\' begins a character code of two hexadecimal digits; the character itself is written "
     "'\\\\' "
     "(manual 1.1.2).",
     "Open \"C:\\temp\", f;", "Open \"C:\\\\temp\", f;"},
    {1008, Kind::Body,
     "A string holds at most 80 bytes, and characters beyond ASCII take more than one (manual 1.1.2). Show "
     "longer texts in "
     "several lines.",
     "TPWrite \"The gripper could not take the part: check the air supply, then press the green button.\";",
     "TPWrite \"The gripper could not take the part:\";\nTPWrite \"check the air supply, then press the "
     "green button.\";"},
    {1009, Kind::Module, "Names have at most 32 characters, all of which count (manual 1.1.2).",
     "VAR num number_of_parts_on_the_left_pallet;", "VAR num parts_on_left_pallet;"},
    {1010, Kind::Body,
     "A number is followed directly by letters, or it has two points or an unfinished exponent or prefix. "
     "Numbers are "
     "written 3, 3.5, .5, 1E-3, 0xFF, 0o17 or 0b101, and separated from the next word (manual 1.1.2).",
     "WaitTime 5s;", "WaitTime 5;"},
    {1011, Kind::Body, "The number is larger than the largest dnum, about 1.8E308.", "x := 1E400;",
     "x := 1E38;"},
    {1012, Kind::File,
     "A file may begin with a header between two lines '%%%' (manual 1.1.2). The second one is missing.",
     "%%%\nVERSION:1\nMODULE m\nENDMODULE", "%%%\nVERSION:1\nLANGUAGE:ENGLISH\n%%%\nMODULE m\nENDMODULE"},
    {1013, Kind::Body, "A name begins with a letter; letters, digits and underscores follow (manual 1.1.2).",
     "VAR num _count;", "VAR num count_;"},
    {1014, Kind::File,
     "Comments must not occur outside a module declaration (manual 1.1.2): the controller may refuse "
     "the file, or lose them when it saves the module.",
     "! tools of cell 3\n"
     "MODULE m\n"
     "ENDMODULE",
     "MODULE m\n"
     "  ! tools of cell 3\n"
     "ENDMODULE"},
    {1099, Kind::Files,
     "The file has more than 200 mistakes of lexing and parsing, or more than 1,000 errors or warnings in "
     "all. The first ones are shown; often they are the "
     "cause of the "
     "others.",
     R"ex($ rapidc check m.modx
m.modx:
  MODULE m
  VAR num x;
  PROC main()
    x := ) 1;     (N = 1 to 201)
  ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check m.modx
m.modx:
  MODULE m
  VAR num x;
  PROC main()
    x := 1;       (N = 1 to 201)
  ENDPROC
  ENDMODULE)ex"},
    {1101, Kind::Body,
     "The text does not follow the grammar here. The message says what could stand in this place.",
     "x := 1 + ;", "x := 1 + 2;"},
    {1102, Kind::Body,
     "The word belongs to the language and cannot be the name of anything (manual 1.1.2). Case makes no "
     "difference.",
     "VAR num step;", "VAR num stepSize;"},
    {1103, Kind::Body,
     "A bracket, a parenthesis or the '%' of a late-bound call is not closed. A note shows where it begins.",
     "x := 2 * (a + b;", "x := 2 * (a + b);"},
    {1104, Kind::Body,
     "A sign stands only before the first term of a sum (manual 1.3.6). After another operator the signed "
     "operand needs "
     "parentheses.",
     "x := 2 * -3;", "x := 2 * (-3);"},
    {1105, Kind::Body,
     "A relation compares two values; its result is a bool (manual 1.3.6). Write two relations and AND.",
     "ok := 1 < x < 3;", "ok := 1 < x AND x < 3;"},
    {1106, Kind::Body,
     "NOT stands before a whole relation, never between an operator and its operand (manual 1.3.6).",
     "ok := a = NOT b;", "ok := a = (NOT b);"},
    {1107, Kind::Body,
     "Only variables, persistents and constants have components and elements in the grammar, not the result "
     "of a function "
     "(manual 1.3.6).",
     "x := CRobT().trans.x;", "here := CRobT();\nx := here.trans.x;"},
    {1108, Kind::Body,
     "An index follows the name of an array. Components of records cannot be arrays (manual 1.2.1, 1.3.2).",
     "x := data.list{1};", "x := list{1};"},
    {1109, Kind::Files,
     "Parentheses, blocks or operators are nested beyond what rapidc reads. Nobody writes this by hand: look "
     "at the program "
     "that made the text.",
     R"ex($ rapidc check m.modx
m.modx:
  MODULE m
  VAR num x :=
    (     (N = 1 to 1200)
    1
    )     (N = 1 to 1200)
    ;
  ENDMODULE)ex",
     R"ex($ rapidc check m.modx
m.modx:
  MODULE m
  VAR num x := (1);
  ENDMODULE)ex"},
    {1110, Kind::Files,
     "The arguments of a procedure or an instruction stand without parentheses (manual 1.1.5). Only function "
     "calls have "
     "them.",
     R"ex($ rapidc check m.modx
m.modx:
  MODULE m
  PROC main()
    TPErase();
    TPWrite("count", \Num:=3);
  ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check m.modx
m.modx:
  MODULE m
  PROC main()
    TPErase;
    TPWrite "count", \Num:=3;
  ENDPROC
  ENDMODULE)ex"},
    {1111, Kind::Module, "The placeholder stands for another part of the program (manual 1.1.2).",
     "PROC p(<ALT>)\nENDPROC", "PROC p(<PAR>)\nENDPROC"},
    {1112, Kind::Body,
     "This is how other languages write it. RAPID compares with '=' and '<>', joins with AND, OR and "
     "NOT, begins comments with '!', puts strings between double quotes and indexes between braces "
     "(manual 1.1.2, 1.3.1, 1.3.2).",
     "IF a == 1 THEN\n"
     "ENDIF",
     "IF a = 1 THEN\n"
     "ENDIF"},
    {1113, Kind::Files,
     "BREAK and CONTINUE have been instructions since RobotWare 7.12, UNDO a word of routines since "
     "RobotWare "
     "5. Programs of older systems, in files with the endings .mod, .sys and .prg, may use them as names. "
     "They "
     "are read as such where they cannot be anything else; before the program moves to a newer controller "
     "they "
     "need other names (manual 1.1.2).",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    VAR bool continue := TRUE;
    PROC main()
      IF continue TPWrite "on";
      continue := FALSE;
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check main.mod
main.mod:
  MODULE MainModule
    VAR bool goOn := TRUE;
    PROC main()
      IF goOn TPWrite "on";
      goOn := FALSE;
    ENDPROC
  ENDMODULE)ex"},
    {1201, Kind::Body,
     "Instructions and declarations end with ';'. The place is the end of the unfinished one, not the "
     "beginning of the "
     "next.",
     "x := 1\ny := 2;", "x := 1;\ny := 2;"},
    {1202, Kind::Body,
     "A block, a routine or the module is not closed before something that cannot be inside it. A note shows "
     "where it "
     "begins.",
     "IF x > 1 THEN\n  Stop;", "IF x > 1 THEN\n  Stop;\nENDIF"},
    {1203, Kind::Body,
     "The word closes or continues a block that was not opened, or is closed already. A frequent cause is an "
     "IF "
     "without THEN, which ends with one instruction.",
     "x := 1;\nENDIF", "IF x > 1 THEN\n  x := 1;\nENDIF"},
    {1204, Kind::Body, "A word of IF, FOR or WHILE is missing: THEN, FROM, TO or DO.",
     "WHILE x < 3\n  x := x + 1;\nENDWHILE", "WHILE x < 3 DO\n  x := x + 1;\nENDWHILE"},
    {1205, Kind::Body, "A value is assigned with ':='. A single '=' compares.", "x = 1;", "x := 1;"},
    {1206, Kind::Body, "The line looks like a misspelt word of the block that is open.",
     "IF a THEN\n  Stop;\nEND IF", "IF a THEN\n  Stop;\nENDIF"},
    {1207, Kind::Body, "Data of a routine are declared before its first instruction (manual 1.1.5).",
     "x := 1;\nVAR num y;\ny := x;", "VAR num y;\nx := 1;\ny := x;"},
    {1208, Kind::Body,
     "The parts of a routine follow each other in the order BACKWARD, ERROR, UNDO (manual 1.1.5).",
     "x := 1;\nUNDO\n  Reset do1;\nERROR\n  RETRY;", "x := 1;\nERROR\n  RETRY;\nUNDO\n  Reset do1;"},
    {1209, Kind::Body,
     "A routine has at most one BACKWARD and one UNDO part. Only ERROR (numbers) may be repeated.",
     "x := 1;\nUNDO\n  Reset do1;\nUNDO\n  Reset do2;", "x := 1;\nUNDO\n  Reset do1;\n  Reset do2;"},
    {1210, Kind::Module, "Backward execution is defined for procedures only (manual 1.21).",
     "FUNC num one()\n  RETURN 1;\nBACKWARD\nENDFUNC", "FUNC num one()\n  RETURN 1;\nENDFUNC"},
    {1211, Kind::Body, "DEFAULT is the last branch of TEST.",
     "TEST x\nDEFAULT:\n  Stop;\nCASE 1:\n  y := 1;\nENDTEST",
     "TEST x\nCASE 1:\n  y := 1;\nDEFAULT:\n  Stop;\nENDTEST"},
    {1212, Kind::Body, "Instructions in TEST belong to a CASE or to DEFAULT.",
     "TEST x\n  y := 0;\nCASE 1:\n  y := 1;\nENDTEST", "y := 0;\nTEST x\nCASE 1:\n  y := 1;\nENDTEST"},
    {1213, Kind::Body, "ELSE is the last branch of IF.",
     "IF a THEN\n  x := 1;\nELSE\n  x := 2;\nELSEIF b THEN\n  x := 3;\nENDIF",
     "IF a THEN\n  x := 1;\nELSEIF b THEN\n  x := 3;\nELSE\n  x := 2;\nENDIF"},
    {1214, Kind::Module,
     "Declarations of routines cannot be nested (manual 1.1.5), and data types are declared at module "
     "level only (manual 1.2.1).",
     "PROC outer()\n"
     "  PROC inner()\n"
     "  ENDPROC\n"
     "  inner;\n"
     "ENDPROC",
     "PROC outer()\n"
     "  inner;\n"
     "ENDPROC\n"
     "PROC inner()\n"
     "ENDPROC"},
    {1215, Kind::Body, "A condition compares with '='; ':=' assigns and gives no value (manual 1.3.1).",
     "IF n := 1 THEN\n"
     "ENDIF",
     "IF n = 1 THEN\n"
     "ENDIF"},
    {1301, Kind::File, "A RAPID file contains one or more modules (manual 1.1.3).", "! only a comment",
     "MODULE m\n  ! a comment\nENDMODULE"},
    {1302, Kind::File, "Only comments may stand before, between and after modules.",
     "MODULE m\nENDMODULE\nVAR num x;", "MODULE m\n  VAR num x;\nENDMODULE"},
    {1303, Kind::File,
     "Modules have the attributes SYSMODULE, NOVIEW, NOSTEPIN, VIEWONLY and READONLY (manual 1.1.3).",
     "MODULE m(SYSTEM)\nENDMODULE", "MODULE m(SYSMODULE)\nENDMODULE"},
    {1304, Kind::File, "Module attributes stand in a fixed order (manual 1.1.3).",
     "MODULE m(NOSTEPIN, SYSMODULE)\nENDMODULE", "MODULE m(SYSMODULE, NOSTEPIN)\nENDMODULE"},
    {1305, Kind::File, "An attribute is given once.", "MODULE m(NOSTEPIN, NOSTEPIN)\nENDMODULE",
     "MODULE m(NOSTEPIN)\nENDMODULE"},
    {1306, Kind::File, "NOVIEW stands alone or with SYSMODULE (manual 1.1.3).",
     "MODULE m(NOVIEW, READONLY)\nENDMODULE", "MODULE m(SYSMODULE, NOVIEW)\nENDMODULE"},
    {1307, Kind::Module, "Procedures and functions have a parameter list, be it empty (manual 1.1.5).",
     "PROC start\n  Stop;\nENDPROC", "PROC start()\n  Stop;\nENDPROC"},
    {1308, Kind::Module, "A trap routine is called by the system and has no parameters (manual 1.11).",
     "TRAP alarm()\n  Stop;\nENDTRAP", "TRAP alarm\n  Stop;\nENDTRAP"},
    {1309, Kind::Module,
     "Instructions stand in routines. A frequent cause is an ENDPROC too many, or a misspelt word before a "
     "declaration.",
     "x := 1;\nPROC p()\nENDPROC", "PROC p()\n  x := 1;\nENDPROC"},
    {1310, Kind::Body,
     "LOCAL and TASK belong to declarations of the module; data of a routine are always local (manual "
     "1.2.2).",
     "LOCAL VAR num x;\nx := 1;", "VAR num x;\nx := 1;"},
    {1311, Kind::Module, "A record has at least one component (manual 1.2.1).", "RECORD part\nENDRECORD",
     "RECORD part\n  num weight;\nENDRECORD"},
    {1312, Kind::Module, "Components of a record are of atomic or record type, not arrays (manual 1.2.1).",
     "RECORD part\n  num size{3};\nENDRECORD", "RECORD part\n  pos size;\nENDRECORD"},
    {1313, Kind::Module, "A constant gets its value in the declaration (manual 1.2.2).", "CONST num limit;",
     "CONST num limit := 5;"},
    {1314, Kind::Module,
     "An array parameter takes arrays of any size: each dimension is '*', and Dim gives its size at run time "
     "(manual "
     "1.1.5).",
     "PROC p(num list{10})\nENDPROC", "PROC p(num list{*})\nENDPROC"},
    {1315, Kind::Module, "Alternatives are optional parameters: they begin with '\\' (manual 1.1.5).",
     "PROC p(num a | num b)\nENDPROC", "PROC p(\\num a | num b)\nENDPROC"},
    {1316, Kind::Module,
     "TASK gives each task its own persistent or variable of a shared module. Constants, routines and "
     "types have no use for it (manual 1.2.2).",
     "TASK CONST num limit := 5;", "CONST num limit := 5;"},
    {1317, Kind::Module,
     "A declaration is global, LOCAL to its module or TASK global, not two of these at once (manual "
     "1.2.2).",
     "LOCAL TASK PERS num count := 0;", "TASK PERS num count := 0;"},
    {1318, Kind::Module,
     "Procedures give no value and traps are called by the system, so only FUNC has a data type "
     "before its name (manual 1.1.5).",
     "PROC num count()\n"
     "ENDPROC",
     "PROC count()\n"
     "ENDPROC"},
    {1319, Kind::Module,
     "The type of the value stands between FUNC and the name of the function (manual 1.1.5).",
     "FUNC half(num x)\n"
     "  RETURN x / 2;\n"
     "ENDFUNC",
     "FUNC num half(num x)\n"
     "  RETURN x / 2;\n"
     "ENDFUNC"},
    {1320, Kind::Module,
     "A function returns a value of any value type, but never an array (manual 1.1.5). Pass an array "
     "as VAR or INOUT parameter instead.",
     "FUNC num{3} zeros()\n"
     "  RETURN 0;\n"
     "ENDFUNC",
     "PROC zeros(VAR num a{*})\n"
     "  a{1} := 0;\n"
     "ENDPROC"},
    {1321, Kind::Module,
     "The access mode VAR, PERS or INOUT stands before the data type of the parameter (manual 1.1.5).",
     "PROC reset(num VAR count)\n"
     "  count := 0;\n"
     "ENDPROC",
     "PROC reset(VAR num count)\n"
     "  count := 0;\n"
     "ENDPROC"},
    {1322, Kind::Module,
     "A parameter has no default value (manual 1.1.5). Make it optional and test it with Present.",
     "PROC pick(num speed := 5)\n"
     "ENDPROC",
     "PROC pick(\\num speed)\n"
     "  VAR num used := 5;\n"
     "  IF Present(speed) used := speed;\n"
     "ENDPROC"},
    {1323, Kind::Module,
     "A component of a record is a data type and a name; VAR, PERS and CONST belong to data "
     "declarations (manual 1.2.1).",
     "RECORD part\n"
     "  VAR num width;\n"
     "ENDRECORD",
     "RECORD part\n"
     "  num width;\n"
     "ENDRECORD"},
    {1324, Kind::Module,
     "Instructions and declarations of data end with ';'. ENDPROC, ENDFUNC, ENDTRAP, ENDRECORD and ENDMODULE "
     "end what "
     "they name by themselves (manual 1.1.3, 1.1.5).",
     "PROC p()\nENDPROC;", "PROC p()\nENDPROC"},
    {1325, Kind::Module,
     "A declaration names the data type before the name; so does each parameter, also the second one of the "
     "same type "
     "(manual 1.1.5, 1.2.5).",
     "PROC main()\n"
     "  VAR counter;\n"
     "  counter := 1;\n"
     "ENDPROC",
     "PROC main()\n"
     "  VAR num counter;\n"
     "  counter := 1;\n"
     "ENDPROC"},
});

} // namespace

std::span<const Explanation> explanations1xxx() {
    return kExplanations;
}

} // namespace rapid::diag
