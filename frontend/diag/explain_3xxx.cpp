// What the diagnostics of expressions and constants mean. The examples run as tests.

#include "frontend/diag/explain.h"

#include <array>

namespace rapid::diag {

namespace {

using Kind = ExampleKind;

// clang-format off
constexpr auto kExplanations = std::to_array<Explanation>({
    {3001, Kind::Body,
     "The operator is not defined for operands of these types; the table of operators is in manual "
     "1.3.1.",
     "VAR string text;\n"
     "text := \"parts: \" + 5;",
     "VAR string text;\n"
     "text := \"parts: \" + NumToStr(5, 0);"},
    {3002, Kind::Body,
     "NOT takes bool; the signs + and - take num, dnum and pos (manual 1.3.1).",
     "VAR bool ready;\n"
     "ready := NOT reg1;",
     "VAR bool ready;\n"
     "ready := NOT (reg1 = 1);"},
    {3003, Kind::Body,
     "Both operands must be num or both dnum (manual 1.3.1). Literals fit either.",
     "VAR dnum exact;\n"
     "exact := exact + reg1;",
     "VAR dnum exact;\n"
     "exact := exact + NumToDnum(reg1);"},
    {3004, Kind::Body,
     "Only values of equivalent types can be compared (manual 1.3.1).",
     "VAR bool same;\n"
     "same := reg1 = \"1\";",
     "VAR bool same;\n"
     "same := NumToStr(reg1, 0) = \"1\";"},
    {3005, Kind::Module,
     "Whole arrays are compared when their sizes are known and equal. The size of an array parameter is known at "
     "run time only (manual 1.1.5): compare element by element in a loop.",
     "PROC main()\n"
     "ENDPROC\n"
     "FUNC bool Same(num a{*}, num b{*})\n"
     "  RETURN a = b;\n"
     "ENDFUNC",
     "PROC main()\n"
     "ENDPROC\n"
     "FUNC bool Same(num a{*}, num b{*})\n"
     "  FOR i FROM 1 TO Dim(a, 1) DO\n"
     "    IF a{i} <> b{i} RETURN FALSE;\n"
     "  ENDFOR\n"
     "  RETURN TRUE;\n"
     "ENDFUNC"},
    {3006, Kind::Body,
     "Data of non-value types is used only through instructions and functions made for it (manual "
     "1.2.1).",
     "VAR clock watch;\n"
     "reg1 := watch;",
     "VAR clock watch;\n"
     "reg1 := ClkRead(watch);"},
    {3007, Kind::Body,
     "A condition must be of type bool; numbers are not taken for TRUE or FALSE (manual 1.5).",
     "IF reg1 THEN\n"
     "ENDIF",
     "IF reg1 <> 0 THEN\n"
     "ENDIF"},
    {3008, Kind::Module,
     "A switch has no value that could be read or assigned: it is present or not (manual 1.1.5).",
     "PROC move(\\switch fast)\n"
     "  IF fast = TRUE reg1 := 1;\n"
     "ENDPROC",
     "PROC move(\\switch fast)\n"
     "  IF Present(fast) reg1 := 1;\n"
     "ENDPROC"},
    {3010, Kind::Body,
     "Only arrays can be indexed.",
     "reg1 := reg2{1};",
     "VAR num list{3};\n"
     "reg1 := list{1};"},
    {3011, Kind::Body,
     "An element has as many indexes as the array has dimensions (manual 1.3.2).",
     "VAR num grid{2, 3};\n"
     "reg1 := grid{1};",
     "VAR num grid{2, 3};\n"
     "reg1 := grid{1, 3};"},
    {3012, Kind::Body,
     "An index is of type num (manual 1.3.2).",
     "VAR num list{3};\n"
     "VAR dnum i := 1;\n"
     "reg1 := list{i};",
     "VAR num list{3};\n"
     "VAR dnum i := 1;\n"
     "reg1 := list{DnumToNum(i)};"},
    {3013, Kind::Body,
     "Indexes count from 1 to the declared dimension (manual 1.3.2). At run time a wrong index raises "
     "an error; here it is known already.",
     "VAR num list{3};\n"
     "reg1 := list{4};",
     "VAR num list{3};\n"
     "reg1 := list{3};"},
    {3014, Kind::Module,
     "The first element of an array has index 1 (manual 1.3.2).",
     "PROC work(num list{*})\n"
     "  reg1 := list{0};\n"
     "ENDPROC",
     "PROC work(num list{*})\n"
     "  reg1 := list{1};\n"
     "ENDPROC"},
    {3015, Kind::Body,
     "Only records have components (manual 1.2.1).",
     "reg1 := reg2.x;",
     "VAR pos p;\n"
     "reg1 := p.x;"},
    {3016, Kind::Body,
     "A component belongs to one record: name the element of the array first (manual 1.3.2).",
     "VAR pos path{4};\n"
     "reg1 := path.x;",
     "VAR pos path{4};\n"
     "reg1 := path{2}.x;"},
    {3020, Kind::Body,
     "An aggregate such as [1,2,3] has no type of its own; its context must give it one: assignment, "
     "initial value, argument, RETURN, comparison or calculation with data (manual 1.3.3).",
     "VAR pos p;\n"
     "p := [1, 2, 3] + [0, 0, 100];",
     "VAR pos p := [1, 2, 3];\n"
     "p := p + [0, 0, 100];"},
    {3021, Kind::Body,
     "An aggregate has one member for each component of the record or each element of the array "
     "(manual 1.3.3).",
     "VAR pos p;\n"
     "p := [1, 2];",
     "VAR pos p;\n"
     "p := [1, 2, 0];"},
    {3022, Kind::Body,
     "Only records and arrays are written as aggregates (manual 1.3.3).",
     "reg1 := [5];",
     "reg1 := 5;"},
    {3023, Kind::Body,
     "Each member of an aggregate must have the type of the component or element it stands for "
     "(manual 1.3.3).",
     "VAR pos p;\n"
     "p := [1, \"2\", 3];",
     "VAR pos p;\n"
     "p := [1, 2, 3];"},
    {3030, Kind::Module,
     "The value of a constant, the initial value of a variable in a module and a dimension are "
     "constant expressions: literals, constants and operators, but no variables and no function calls "
     "(manual 1.2.2). Assign other values when the program runs.",
     "VAR num start := 1;\n"
     "CONST num limit := start + 10;",
     "CONST num start := 1;\n"
     "CONST num limit := start + 10;"},
    {3031, Kind::Module,
     "The initial value of a persistent is written out: one value, or an aggregate of values, without "
     "names and operators except a sign (manual 1.2.2).",
     "PERS num limit := 2 * 5;",
     "PERS num limit := 10;"},
    {3032, Kind::Module,
     "The values of constants refer to each other in a circle, so none can be computed.",
     "CONST num a := b + 1;\n"
     "CONST num b := a - 1;",
     "CONST num a := b + 1;\n"
     "CONST num b := 1;"},
    {3033, Kind::Module,
     "A constant expression divides by zero.",
     "CONST num share := 100 / 0;",
     "CONST num share := 100 / 4;"},
    {3034, Kind::Body,
     "The divisor is always zero: the instruction raises ERR_DIVZERO, and the routine has no ERROR "
     "handler that could deal with it (manual 1.12).",
     "reg1 := 100 / 0;",
     "reg1 := 100 / 4;"},
    {3035, Kind::Body,
     "DIV and MOD are integer operations; operands with decimals are not allowed (manual 1.3.1).",
     "reg1 := 7.5 MOD 2;",
     "reg1 := 7 MOD 2;"},
    {3036, Kind::Body,
     "num holds numbers up to about 3.4E38, dnum up to about 1.8E308 (manual 1.3.1).",
     "reg1 := 1E40;",
     "VAR dnum large;\n"
     "large := 1E40;"},
    {3037, Kind::Module,
     "The value of the constant expression is too large for its type. Use dnum, or a smaller value.",
     "CONST num big := 1E38;\n"
     "CONST num more := big * 10;",
     "CONST dnum big := 1E38;\n"
     "CONST dnum more := big * 10;"},
    {3038, Kind::Module,
     "A string holds at most 80 bytes, also when it is put together from parts (manual 1.1.2).",
     "CONST string half := \"0123456789012345678901234567890123456789\";\n"
     "CONST string whole := half + half + \"!\";",
     "CONST string half := \"0123456789012345678901234567890123456789\";\n"
     "CONST string whole := half + half;"},
    {3039, Kind::Files,
     "Constants that refer to each other, each to one declared later, form a chain of hundreds. "
     "Declare them in the order in which they are computed.",
     R"ex($ rapidc check m.modx
m.modx:
  MODULE m
  CONST num step<N> := step<N+1> + 1;     (N = 1 to 900)
  CONST num step901 := 1;
  ENDMODULE)ex",
     R"ex($ rapidc check m.modx
m.modx:
  MODULE m
  CONST num step1 := 1;
  CONST num step<N+1> := step<N> + 1;     (N = 1 to 900)
  ENDMODULE)ex"},
    {3040, Kind::Module,
     "The initial value must have the type of the data it initialises (manual 1.2.2).",
     "VAR string name := 5;",
     "VAR string name := \"5\";"},
    {3041, Kind::Body,
     "The values after CASE must have the type of the value after TEST (manual 1.5).",
     "TEST reg1\n"
     "CASE \"1\":\n"
     "  reg2 := 1;\n"
     "ENDTEST",
     "TEST reg1\n"
     "CASE 1:\n"
     "  reg2 := 1;\n"
     "ENDTEST"},
    {3042, Kind::Body,
     "TEST compares one value with others; whole arrays and non-value data cannot be compared (manual "
     "1.2.1, 1.5).",
     "VAR num list{3};\n"
     "TEST list\n"
     "CASE 1:\n"
     "ENDTEST",
     "VAR num list{3};\n"
     "TEST list{1}\n"
     "CASE 1:\n"
     "ENDTEST"},
    {3043, Kind::Body,
     "Start value, end value and step of FOR are of type num, and so is the loop variable (manual "
     "1.5).",
     "VAR dnum last := 3;\n"
     "FOR i FROM 1 TO last DO\n"
     "ENDFOR",
     "VAR dnum last := 3;\n"
     "FOR i FROM 1 TO DnumToNum(last) DO\n"
     "ENDFOR"},
    {3044, Kind::Body,
     "Error numbers are numbers: 1 to 90, numbers booked with BookErrNo, or the predefined ERR_ "
     "constants (manual 1.12).",
     "RAISE \"broken\";",
     "RAISE 17;"},
    {3045, Kind::Body,
     "The name between percent signs is a string that names a procedure (manual 1.1.5).",
     "%reg1%;",
     "%\"proc\" + NumToStr(reg1, 0)%;"},
});
// clang-format on

} // namespace

std::span<const Explanation> explanations3xxx() {
    return kExplanations;
}

} // namespace rapid::diag
