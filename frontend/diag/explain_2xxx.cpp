// What the diagnostics of names, types, data and assignment mean. The examples run as tests.

#include "frontend/diag/explain.h"

#include <array>

namespace rapid::diag {

namespace {

using Kind = ExampleKind;

// clang-format off
constexpr auto kExplanations = std::to_array<Explanation>({
    {2001, Kind::Body,
     "Data must be declared before it can be used, except predefined data and loop variables (manual "
     "1.2.2). Look for a spelling mistake first; the message suggests a near name. Routine data is "
     "known only in its routine, LOCAL data only in its module. Signals come from the configuration: "
     "pass it with --config=EIO.cfg.",
     "reg1 := coutner;",
     "VAR num counter;\n"
     "reg1 := counter;"},
    {2002, Kind::Module,
     "The name of the data type is neither predefined nor declared by RECORD or ALIAS in a module of "
     "the task (manual 1.2.1).",
     "VAR robtraget p10;",
     "VAR robtarget p10;"},
    {2003, Kind::Body,
     "The name at the beginning of an instruction is neither a predefined instruction nor a procedure "
     "of the task. A LOCAL procedure can be called only in its own module (manual 1.1.5).",
     "TPWrit \"hello\";",
     "TPWrite \"hello\";"},
    {2004, Kind::Body,
     "The name before '(' is neither a predefined function nor a function of the task. A LOCAL "
     "function can be called only in its own module (manual 1.1.5).",
     "reg1 := Sqtr(2);",
     "reg1 := Sqrt(2);"},
    {2005, Kind::Body,
     "The record type has no component of this name; its components are those of its RECORD "
     "declaration (manual 1.2.1).",
     "VAR pos p;\n"
     "p.w := 1;",
     "VAR pos p;\n"
     "p.z := 1;"},
    {2006, Kind::Module,
     "CONNECT needs a trap routine of the task, declared by TRAP (manual 1.11).",
     "VAR intnum i1;\n"
     "PROC main()\n"
     "  CONNECT i1 WITH alarm;\n"
     "ENDPROC",
     "VAR intnum i1;\n"
     "PROC main()\n"
     "  CONNECT i1 WITH alarm;\n"
     "ENDPROC\n"
     "TRAP alarm\n"
     "  TPWrite \"alarm\";\n"
     "ENDTRAP"},
    {2007, Kind::Body,
     "GOTO jumps only to a label of the same routine. A label is a name followed by ':' (manual 1.5).",
     "GOTO done;",
     "GOTO done;\n"
     "done:"},
    {2008, Kind::File,
     "LOCAL data, routines and types are known only in their own module (manual 1.1.5, 1.2.2).",
     "MODULE tools\n"
     "  LOCAL VAR num count;\n"
     "ENDMODULE\n"
     "MODULE work\n"
     "  PROC run()\n"
     "    count := 1;\n"
     "  ENDPROC\n"
     "ENDMODULE",
     "MODULE tools\n"
     "  VAR num count;\n"
     "ENDMODULE\n"
     "MODULE work\n"
     "  PROC run()\n"
     "    count := 1;\n"
     "  ENDPROC\n"
     "ENDMODULE"},
    {2009, Kind::Files,
     "Some modules of the task cannot be read: they are encrypted, were not saved with the backup or "
     "are missing. The name may be declared there, so it cannot be judged.",
     R"ex($ rapidc check cell
cell/main.mod:
  MODULE MainModule
    PROC main()
      parts := parts + 1;
    ENDPROC
  ENDMODULE
cell/counting.sys (bytes FC 86 41 07 00 9E 22 51):)ex",
     R"ex($ rapidc check cell
cell/main.mod:
  MODULE MainModule
    PROC main()
      parts := parts + 1;
    ENDPROC
  ENDMODULE
cell/counting.sys:
  MODULE counting(SYSMODULE)
    PERS num parts := 0;
  ENDMODULE)ex"},
    {2010, Kind::Module,
     "A name may be declared only once in a module, whatever it names: a routine, data and a type "
     "cannot share it, and letter case makes no difference (manual 1.1.5, 1.2.2).",
     "VAR num work;\n"
     "PROC Work()\n"
     "ENDPROC",
     "VAR num work;\n"
     "PROC DoWork()\n"
     "ENDPROC"},
    {2011, Kind::File,
     "Global data, routines and types of all modules of a task share one set of names (manual 1.1.5, "
     "1.2.2). Rename one of the two, or declare LOCAL what only its own module needs.",
     "MODULE a\n"
     "  VAR num total;\n"
     "ENDMODULE\n"
     "MODULE b\n"
     "  VAR num total;\n"
     "ENDMODULE",
     "MODULE a\n"
     "  VAR num total;\n"
     "ENDMODULE\n"
     "MODULE b\n"
     "  LOCAL VAR num total;\n"
     "ENDMODULE"},
    {2012, Kind::Module,
     "Parameters and data of a routine share one set of names (manual 1.2.2).",
     "PROC work(num a)\n"
     "  VAR bool a;\n"
     "ENDPROC",
     "PROC work(num a)\n"
     "  VAR bool b;\n"
     "ENDPROC"},
    {2013, Kind::File,
     "Modules of a task must have different names (manual 1.1.3). The same module may have been given "
     "twice under two file names.",
     "MODULE a\n"
     "ENDMODULE\n"
     "MODULE A\n"
     "ENDMODULE",
     "MODULE a\n"
     "ENDMODULE\n"
     "MODULE b\n"
     "ENDMODULE"},
    {2014, Kind::File,
     "A module must not have the name of a global routine or of global data (manual 1.1.3). Rename "
     "one of them or declare the other LOCAL.",
     "MODULE work\n"
     "  PROC work()\n"
     "  ENDPROC\n"
     "ENDMODULE",
     "MODULE work_module\n"
     "  PROC work()\n"
     "  ENDPROC\n"
     "ENDMODULE"},
    {2015, Kind::Body,
     "A label may stand only once in a routine: GOTO would not know where to go.",
     "again:\n"
     "reg1 := 1;\n"
     "again:",
     "again:\n"
     "reg1 := 1;\n"
     "finished:"},
    {2016, Kind::Module,
     "The components of a record must have different names (manual 1.2.1).",
     "RECORD part\n"
     "  num x;\n"
     "  num X;\n"
     "ENDRECORD",
     "RECORD part\n"
     "  num x;\n"
     "  num y;\n"
     "ENDRECORD"},
    {2017, Kind::Body,
     "Labels share the names of the routine's data and parameters (manual 1.2.2).",
     "VAR num count;\n"
     "count:",
     "VAR num count;\n"
     "start:"},
    {2020, Kind::Module,
     "A data type is expected, but the name means something else. A name can hide a predefined type "
     "only as another type does.",
     "VAR num height;\n"
     "VAR height h;",
     "ALIAS num height;\n"
     "VAR height h;"},
    {2021, Kind::Body,
     "Only procedures can be called as an instruction. A variable or parameter of the same name hides "
     "the procedure.",
     "VAR num counter;\n"
     "counter;",
     "VAR num counter;\n"
     "counter := counter + 1;"},
    {2022, Kind::Module,
     "Only functions give a value. To index an array use braces: list{1}.",
     "VAR num list{3};\n"
     "PROC main()\n"
     "  reg1 := list(1);\n"
     "ENDPROC",
     "VAR num list{3};\n"
     "PROC main()\n"
     "  reg1 := list{1};\n"
     "ENDPROC"},
    {2023, Kind::Body,
     "A function gives a value, which an instruction would lose (manual 1.1.5). Assign it or use it "
     "in an expression.",
     "Abs reg1;",
     "reg1 := Abs(reg1);"},
    {2024, Kind::Body,
     "A function call has parentheses even without arguments (manual 1.3.4).",
     "reg1 := OpMode;",
     "reg1 := OpMode();"},
    {2025, Kind::Body,
     "The name of a procedure, trap, type or module stands where a value or data is expected.",
     "reg1 := pos;",
     "VAR pos p;\n"
     "reg1 := p.x;"},
    {2026, Kind::Module,
     "Trap routines are called by the system when their interrupt occurs, never by the program "
     "(manual 1.1.5, 1.11). Put what both need into a procedure.",
     "PROC main()\n"
     "  alarm;\n"
     "ENDPROC\n"
     "TRAP alarm\n"
     "ENDTRAP",
     "PROC main()\n"
     "  alarm;\n"
     "ENDPROC\n"
     "PROC alarm()\n"
     "ENDPROC"},
    {2027, Kind::Module,
     "CONNECT needs a trap routine; procedures and functions cannot be connected to an interrupt "
     "(manual 1.11).",
     "VAR intnum i1;\n"
     "PROC main()\n"
     "  CONNECT i1 WITH alarm;\n"
     "ENDPROC\n"
     "PROC alarm()\n"
     "ENDPROC",
     "VAR intnum i1;\n"
     "PROC main()\n"
     "  CONNECT i1 WITH alarm;\n"
     "ENDPROC\n"
     "TRAP alarm\n"
     "ENDTRAP"},
    {2030, Kind::Module,
     "A record cannot contain itself, neither directly nor through other records or aliases: it would "
     "have no end.",
     "RECORD node\n"
     "  num value;\n"
     "  node next;\n"
     "ENDRECORD",
     "RECORD node\n"
     "  num value;\n"
     "  num next_index;\n"
     "ENDRECORD"},
    {2031, Kind::Module,
     "switch exists only as an optional parameter, anytype only in predefined routines. Neither can "
     "be the type of data (manual 1.1.5).",
     "VAR switch fast;",
     "VAR bool fast;"},
    {2032, Kind::Module,
     "A switch can only be given or left out, so it must be optional (manual 1.1.5).",
     "PROC move(switch fast)\n"
     "ENDPROC",
     "PROC move(\\switch fast)\n"
     "ENDPROC"},
    {2033, Kind::Module,
     "Non-value data cannot be copied, so it cannot be passed as IN (manual 1.2.1). Pass it as VAR or "
     "INOUT.",
     "PROC measure(clock watch)\n"
     "ENDPROC",
     "PROC measure(VAR clock watch)\n"
     "ENDPROC"},
    {2034, Kind::Module,
     "A function returns a value, which data of non-value and semi-value types is not (manual 1.2.1).",
     "FUNC signaldi input()\n"
     "  RETURN 1;\n"
     "ENDFUNC",
     "FUNC num input()\n"
     "  RETURN 1;\n"
     "ENDFUNC"},
    {2035, Kind::Body,
     "Data of non-value and semi-value types cannot have an initial value (manual 1.2.1); "
     "instructions such as Open, SocketCreate or AliasIO give it its content.",
     "VAR iodev file := 1;",
     "VAR iodev file;"},
    {2040, Kind::Body,
     "Persistents belong to modules: data of a routine is gone when it returns (manual 1.2.2).",
     "PERS num total := 0;",
     "VAR num total := 0;"},
    {2041, Kind::Module,
     "LOCAL and TASK persistents must have an initial value. Only system global ones may omit it, "
     "because another task can bring it (manual 1.2.2).",
     "LOCAL PERS num total;",
     "LOCAL PERS num total := 0;"},
    {2042, Kind::Module,
     "The dimensions of an array are constant expressions of type num (manual 1.2.2).",
     "VAR num size := 3;\n"
     "VAR num list{size};",
     "CONST num size := 3;\n"
     "VAR num list{size};"},
    {2043, Kind::Module,
     "The dimensions of an array are integers greater than 0 (manual 1.2.2).",
     "VAR num list{0};",
     "VAR num list{1};"},
    {2044, Kind::Module,
     "Arrays have one to three dimensions (manual 1.2.2).",
     "VAR num block{2, 2, 2, 2};",
     "VAR num block{2, 2, 4};"},
    {2045, Kind::Module,
     "The array would not fit into the memory of a controller. Check the dimensions.",
     "VAR num block{100000, 100000};",
     "VAR num block{100, 100};"},
    {2046, Kind::Module,
     "A constant has a value, which data of non-value and semi-value types has not (manual 1.2.1).",
     "CONST clock watch := 0;",
     "VAR clock watch;"},
    {2047, Kind::Files,
     "Records and aliases that refer to each other form a chain of hundreds of types. Nobody writes "
     "this by hand: look at what generated the module.",
     R"ex($ rapidc check m.modx
m.modx:
  MODULE m
  RECORD part<N> part<N+1> inner; ENDRECORD     (N = 1 to 600)
  RECORD part601 num weight; ENDRECORD
  ENDMODULE)ex",
     R"ex($ rapidc check m.modx
m.modx:
  MODULE m
  RECORD part num weight; ENDRECORD
  RECORD pallet part inner; ENDRECORD
  ENDMODULE)ex"},
    {2048, Kind::Module,
     "LOCAL and TASK persistents must have an initial value (manual 1.2.2), and data of non-value and "
     "semi-value types cannot have one (manual 1.2.1).",
     "LOCAL PERS clock watch;",
     "LOCAL VAR clock watch;"},
    {2104, Kind::Body,
     "The value must have the type of the data it is assigned to; an alias counts as the type it "
     "stands for, and arrays must have the same dimensions (manual 1.2.1, 1.3.2). Convert with "
     "functions such as NumToStr, StrToVal or ValToStr.",
     "VAR string text;\n"
     "text := 5;",
     "VAR string text;\n"
     "text := NumToStr(5, 0);"},
    {2105, Kind::Body,
     "num and dnum are different types and are never converted by themselves (manual 1.3.1). Literals "
     "take the type that their context needs.",
     "VAR dnum exact;\n"
     "exact := reg1;",
     "VAR dnum exact;\n"
     "exact := NumToDnum(reg1);"},
    {2106, Kind::Body,
     "Everything that is done with the data or function would be right if its declaration named the other type "
     "(manual 1.2.1), so it is told once, at the declaration; the notes name the places. Where one use fits the "
     "declaration, two of them need different types, or there are fewer than five, each wrong use is reported by itself.",
     "VAR string count;\n"
     "count := 5;\n"
     "WHILE count > 3 DO\n"
     "  count := count - 1;\n"
     "  WaitTime count;\n"
     "ENDWHILE\n"
     "reg1 := count;",
     "VAR num count;\n"
     "count := 5;\n"
     "WHILE count > 3 DO\n"
     "  count := count - 1;\n"
     "  WaitTime count;\n"
     "ENDWHILE\n"
     "reg1 := count;"},
});
// clang-format on

} // namespace

std::span<const Explanation> explanations2xxx() {
    return kExplanations;
}

} // namespace rapid::diag
