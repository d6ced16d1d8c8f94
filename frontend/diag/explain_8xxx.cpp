// What the warnings of 8xxx mean. The examples run as tests.

#include "frontend/diag/explain.h"

#include <array>

namespace rapid::diag {

namespace {

using Kind = ExampleKind;

// clang-format off
constexpr auto kExplanations = std::to_array<Explanation>({
    {8001, Kind::Body,
     "A comment `! rapidc:`, the project file rapidc.json or the option -W names a warning that there "
     "is none of. Every warning shows its name in parentheses behind its text.",
     "reg1 := 1; ! rapidc: ignore unused-varable",
     "reg1 := 1; ! rapidc: ignore unused-variable"},
    {8002, Kind::Body,
     "`! rapidc: ignore NAME` is for its line, or for the next one when it stands alone; `! rapidc: "
     "off NAME` and `! rapidc: on NAME` enclose a range.",
     "reg1 := 1; ! rapidc: disable unused-variable",
     "reg1 := 1; ! rapidc: ignore unused-variable"},
    {8003, Kind::Body,
     "Nothing in the program names this data. It is left over, or another name was meant somewhere. "
     "Data at module level are judged when the whole program is known; persistents only when they are "
     "LOCAL, because displays and other computers read the others.",
     "VAR num count;\n"
     "reg1 := 1;",
     "VAR num count := 1;\n"
     "reg1 := count;"},
    {8004, Kind::Module,
     "The routine does not use what it is given: the parameter is left over, or other data are used "
     "in its place.",
     "PROC main()\n"
     "  paint 3;\n"
     "ENDPROC\n"
     "PROC paint(num colour)\n"
     "  TPWrite \"painting\";\n"
     "ENDPROC",
     "PROC main()\n"
     "  paint 3;\n"
     "ENDPROC\n"
     "PROC paint(num colour)\n"
     "  TPWrite \"painting \" \\Num:=colour;\n"
     "ENDPROC"},
    {8005, Kind::Module,
     "Nothing in the program calls the routine. Global procedures without parameters are not judged: "
     "operators and events may call them; nor are procedures of a program that calls some by their "
     "names.",
     "PROC main()\n"
     "  reg1 := 1;\n"
     "ENDPROC\n"
     "FUNC num half(num x)\n"
     "  RETURN x / 2;\n"
     "ENDFUNC",
     "PROC main()\n"
     "  reg1 := half(4);\n"
     "ENDPROC\n"
     "FUNC num half(num x)\n"
     "  RETURN x / 2;\n"
     "ENDFUNC"},
    {8006, Kind::Body,
     "A label without GOTO has no effect: it is left over, a GOTO is missing, or ':' stands in place of "
     "the ';' of a call.",
     "again:\n"
     "reg1 := reg1 + 1;",
     "again:\n"
     "reg1 := reg1 + 1;\n"
     "IF reg1 < 5 GOTO again;"},
    {8007, Kind::Module,
     "No data, parameter or component is of this type.",
     "LOCAL RECORD part\n"
     "  num width;\n"
     "ENDRECORD\n"
     "PROC main()\n"
     "  reg1 := 1;\n"
     "ENDPROC",
     "LOCAL RECORD part\n"
     "  num width;\n"
     "ENDRECORD\n"
     "PROC main()\n"
     "  VAR part p;\n"
     "  p.width := 3;\n"
     "  reg1 := p.width;\n"
     "ENDPROC"},
    {8008, Kind::Body,
     "The variable gets values that nobody reads: the rest of a change, or another name was meant. A "
     "variable that takes the result of a function is not judged, because RAPID wants a place for "
     "every result.",
     "VAR num speed;\n"
     "speed := 200;",
     "VAR num speed;\n"
     "speed := 200;\n"
     "reg1 := speed;"},
    {8010, Kind::Body,
     "The instruction before it never goes on here: RETURN, EXIT, RAISE, GOTO, BREAK, a loop without "
     "end.",
     "EXIT;\n"
     "TPWrite \"done\";",
     "TPWrite \"done\";\n"
     "EXIT;"},
    {8011, Kind::Body,
     "The loop runs for ever and leaves no time to others: there is no BREAK, RETURN or EXIT in it, "
     "and nothing in it waits or moves. On a controller it takes the time of background tasks (manual "
     "5).",
     "WHILE TRUE DO\n"
     "  reg1 := reg1 + 1;\n"
     "ENDWHILE",
     "WHILE TRUE DO\n"
     "  reg1 := reg1 + 1;\n"
     "  WaitTime 0.1;\n"
     "ENDWHILE"},
    {8012, Kind::Module,
     "Nothing in the loop (WHILE, or IF with a GOTO back) changes its condition: it waits for something outside, and takes all the "
     "time while it does (manual 5: events instead of polling).",
     "PERS bool ready := FALSE;\n"
     "PROC main()\n"
     "  WHILE ready = FALSE DO\n"
     "  ENDWHILE\n"
     "ENDPROC",
     "PERS bool ready := FALSE;\n"
     "PROC main()\n"
     "  WaitUntil ready;\n"
     "ENDPROC"},
    {8013, Kind::Module,
     "The value comes from outside: a parameter, a signal, a function, ERRNO. When no CASE lists it, "
     "TEST does nothing, and nobody notices. A DEFAULT says what shall happen then.",
     "PROC main()\n"
     "  choose 1;\n"
     "ENDPROC\n"
     "PROC choose(num side)\n"
     "  TEST side\n"
     "  CASE 1: reg1 := 1;\n"
     "  CASE 2: reg1 := 2;\n"
     "  ENDTEST\n"
     "ENDPROC",
     "PROC main()\n"
     "  choose 1;\n"
     "ENDPROC\n"
     "PROC choose(num side)\n"
     "  TEST side\n"
     "  CASE 1: reg1 := 1;\n"
     "  CASE 2: reg1 := 2;\n"
     "  DEFAULT: TPWrite \"no such side\";\n"
     "  ENDTEST\n"
     "ENDPROC"},
    {8014, Kind::Body,
     "With this STEP the loop is past its end before it begins. Without STEP, FOR counts up or down "
     "as it needs (manual 1.5).",
     "FOR i FROM 10 TO 1 STEP 1 DO\n"
     "  reg1 := i;\n"
     "ENDFOR",
     "FOR i FROM 10 TO 1 STEP -1 DO\n"
     "  reg1 := i;\n"
     "ENDFOR"},
    {8015, Kind::Body,
     "The branches of IF are tried in order, so the earlier one with the same condition takes its "
     "place.",
     "IF reg1 = 1 THEN\n"
     "  reg2 := 1;\n"
     "ELSEIF reg1 = 1 THEN\n"
     "  reg2 := 2;\n"
     "ENDIF",
     "IF reg1 = 1 THEN\n"
     "  reg2 := 1;\n"
     "ELSEIF reg1 = 2 THEN\n"
     "  reg2 := 2;\n"
     "ENDIF"},
    {8020, Kind::Body,
     "On every way to this place nothing was assigned to the variable, so it has the value that all "
     "data begin with. If that is meant, write it as initial value.",
     "VAR num offset;\n"
     "reg1 := offset;",
     "VAR num offset := 0;\n"
     "reg1 := offset;"},
    {8021, Kind::Module,
     "An IN parameter is a copy: what the routine assigns to it is lost when it returns (manual "
     "1.1.5).",
     "PROC main()\n"
     "  reg1 := 1;\n"
     "  double reg1;\n"
     "ENDPROC\n"
     "PROC double(num value)\n"
     "  value := value * 2;\n"
     "ENDPROC",
     "PROC main()\n"
     "  reg1 := 1;\n"
     "  double reg1;\n"
     "ENDPROC\n"
     "PROC double(INOUT num value)\n"
     "  value := value * 2;\n"
     "ENDPROC"},
    {8022, Kind::Module,
     "Where this declaration is seen, the predefined thing of that name cannot be used (manual "
     "1.1.2). Data that a controller declares in modules of its own, such as tool0, may be declared "
     "again.",
     "PROC main()\n"
     "  VAR num pi := 3;\n"
     "  reg1 := pi;\n"
     "ENDPROC",
     "PROC main()\n"
     "  VAR num roughPi := 3;\n"
     "  reg1 := roughPi;\n"
     "ENDPROC"},
    {8023, Kind::Body,
     "The assignment changes nothing: another name was meant on one side.",
     "reg1 := reg1;",
     "reg1 := reg2;"},
    {8024, Kind::Module,
     "The routine asks Present for the parameter, but not on every way to this place, or it got the answer no, or the "
     "condition holds without it as well (Present(x) OR ...). An optional parameter that was left out must not be used (manual 1.1.5).",
     "PROC work(\\num level)\n"
     "  IF Present(level) TPWrite \"level given\";\n"
     "  reg1 := level;\n"
     "ENDPROC",
     "PROC work(\\num level)\n"
     "  IF NOT Present(level) RETURN;\n"
     "  reg1 := level;\n"
     "ENDPROC"},
    {8030, Kind::Body,
     "num has 23 binary digits: most fractions, such as 0.1, are stored rounded, and a calculated "
     "value differs in the last digit (manual 1.2.1). Compare whether the difference is small.",
     "IF reg1 = 0.1 TPWrite \"there\";",
     "IF Abs(reg1 - 0.1) < 0.001 TPWrite \"there\";"},
    {8031, Kind::Body,
     "num stores most fractions rounded, and FOR adds the step each time: the last round may be "
     "missing.",
     "FOR x FROM 0 TO 1 STEP 0.1 DO\n"
     "  reg1 := x;\n"
     "ENDFOR",
     "FOR i FROM 0 TO 10 DO\n"
     "  reg1 := i / 10;\n"
     "ENDFOR"},
    {8032, Kind::Body,
     "The result does not depend on the data: another name was meant on one side.",
     "IF reg1 = reg1 TPWrite \"equal\";",
     "IF reg1 = reg2 TPWrite \"equal\";"},
    {8033, Kind::Module,
     "A digital signal is 0 or 1; a group of signals has larger values.",
     "PROC work(VAR signaldi gate)\n"
     "  IF gate = 2 TPWrite \"open\";\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  VAR signaldi gate;\n"
     "  AliasIO \"diGate\", gate;\n"
     "  work gate;\n"
     "ENDPROC",
     "PROC work(VAR signaldi gate)\n"
     "  IF gate = 1 TPWrite \"open\";\n"
     "ENDPROC\n"
     "PROC main()\n"
     "  VAR signaldi gate;\n"
     "  AliasIO \"diGate\", gate;\n"
     "  work gate;\n"
     "ENDPROC"},
    {8034, Kind::Body,
     "A string has room for 80 bytes; a longer one raises ERR_STRTOOLNG (manual 1.2.1). The parts "
     "whose length is known are too long together; shorten them or write two texts.",
     "TPWrite \"The gripper has not reached its position in the time that it is allowed, \" + CDate();",
     "TPWrite \"The gripper has not reached its position in time, \" + CDate();"},
    {8035, Kind::Body,
     "num has 24 bits for the digits of a number: whole numbers are exact up to 16777216 (manual 1.2.1). This one is written "
     "where a num is wanted, so it is rounded. dnum holds whole numbers up to 9007199254740992.",
     "reg1 := 16777217;",
     "VAR dnum parts;\n"
     "parts := 16777217;\n"
     "TPWrite DnumToStr(parts, 0);"},
    {8040, Kind::Module,
     "Zone 0 at a fly-by point makes the robot brake hard at speeds above 70 mm/s (manual 5). Stop "
     "there with fine, or choose a larger zone.",
     "CONST robtarget p1 := [[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
     "PROC main()\n"
     "  MoveL p1, v500, z0, tool0;\n"
     "ENDPROC",
     "CONST robtarget p1 := [[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
     "PROC main()\n"
     "  MoveL p1, v500, z5, tool0;\n"
     "ENDPROC"},
    {8041, Kind::Module,
     "Behind a fly-by point the program goes on before the robot is there (manual 2.3). A wait then "
     "begins too early, and when it lasts the robot stops somewhere in the corner. Move to a stop "
     "point, or wait with \\InPos.",
     "CONST robtarget p1 := [[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
     "PROC main()\n"
     "  MoveL p1, v500, z10, tool0;\n"
     "  WaitTime 1;\n"
     "ENDPROC",
     "CONST robtarget p1 := [[600,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
     "PROC main()\n"
     "  MoveL p1, v500, fine, tool0;\n"
     "  WaitTime 1;\n"
     "ENDPROC"},
    {8042, Kind::Module,
     "A trap routine runs only when CONNECT has given it an interrupt (manual 1.11).",
     "PROC main()\n"
     "  reg1 := 1;\n"
     "ENDPROC\n"
     "TRAP alarm\n"
     "  TPWrite \"alarm\";\n"
     "ENDTRAP",
     "VAR intnum alarmInt;\n"
     "PROC main()\n"
     "  CONNECT alarmInt WITH alarm;\n"
     "  ITimer 5, alarmInt;\n"
     "ENDPROC\n"
     "TRAP alarm\n"
     "  TPWrite \"alarm\";\n"
     "ENDTRAP"},
    {8043, Kind::Module,
     "An interrupt variable has no interrupt number before CONNECT gives it one and a trap routine; "
     "to order the interrupt then raises ERR_UNKINO (manual 1.11).",
     "VAR intnum alarmInt;\n"
     "PROC main()\n"
     "  ITimer 5, alarmInt;\n"
     "ENDPROC",
     "VAR intnum alarmInt;\n"
     "PROC main()\n"
     "  CONNECT alarmInt WITH alarm;\n"
     "  ITimer 5, alarmInt;\n"
     "ENDPROC\n"
     "TRAP alarm\n"
     "  TPWrite \"alarm\";\n"
     "ENDTRAP"},
    {8044, Kind::Body,
     "When a handler reaches its end, the system handler takes over and stops the program: the "
     "routine that called is not asked (manual 1.12). Say how to go on: RETRY, TRYNEXT, RETURN, RAISE "
     "for the caller, or EXIT.",
     "reg1 := 1 / reg2;\n"
     "ERROR\n"
     "  TPWrite \"division by zero\";",
     "reg1 := 1 / reg2;\n"
     "ERROR\n"
     "  TPWrite \"division by zero\";\n"
     "  TRYNEXT;"},
    {8045, Kind::Module,
     "The BACKWARD handler says how a call is executed backwards. Its movements mirror kind and order of those in the "
     "body; a circular movement keeps the order of its two points. Otherwise the robot takes another path back: a "
     "linear piece may become a circle (manual 1.21).",
     "PROC moveTo()\n"
     "  MoveJ Offs(CRobT(), 0, 0, 9), v500, z10, tool0;\n"
     "  MoveL CRobT(), v500, fine, tool0;\n"
     "BACKWARD\n"
     "  MoveJ CRobT(), v500, z10, tool0;\n"
     "  MoveL Offs(CRobT(), 0, 0, 9), v500, fine, tool0;\n"
     "ENDPROC",
     "PROC moveTo()\n"
     "  MoveJ Offs(CRobT(), 0, 0, 9), v500, z10, tool0;\n"
     "  MoveL CRobT(), v500, fine, tool0;\n"
     "BACKWARD\n"
     "  MoveL CRobT(), v500, z10, tool0;\n"
     "  MoveJ Offs(CRobT(), 0, 0, 9), v500, fine, tool0;\n"
     "ENDPROC"},
    {8046, Kind::Module,
     "An error in a routine without error handler stops the program at once. It goes to the caller's handler only when a "
     "handler in the routine passes it on with RAISE, or when a handler lists its number, as ERROR (ERR_MAXTIME) "
     "does (manual 1.12). The handler here names an error that comes from a routine without error handler, so it never sees "
     "it.",
     "PROC waitForPart()\n"
     "  IF reg1 = 0 RAISE 12;\n"
     "ENDPROC\n"
     "PROC work()\n"
     "  waitForPart;\n"
     "ERROR\n"
     "  IF ERRNO = 12 TRYNEXT;\n"
     "  RAISE;\n"
     "ENDPROC",
     "PROC waitForPart()\n"
     "  IF reg1 = 0 RAISE 12;\n"
     "ERROR\n"
     "  RAISE;\n"
     "ENDPROC\n"
     "PROC work()\n"
     "  waitForPart;\n"
     "ERROR\n"
     "  IF ERRNO = 12 TRYNEXT;\n"
     "  RAISE;\n"
     "ENDPROC"},
});
// clang-format on

} // namespace

std::span<const Explanation> explanations8xxx() {
    return kExplanations;
}

} // namespace rapid::diag
