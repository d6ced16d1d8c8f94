// What the diagnostics of flow and use of data mean. The examples run as tests.

#include "frontend/diag/explain.h"

#include <array>

namespace rapid::diag {

namespace {

using Kind = ExampleKind;

// clang-format off
constexpr auto kExplanations = std::to_array<Explanation>({
    {5001, Kind::Module,
     "The value of a constant cannot be changed by the program (manual 1.2.2). Declare the data VAR "
     "or PERS.",
     "CONST num limit := 5;\n"
     "PROC main()\n"
     "  limit := 6;\n"
     "ENDPROC",
     "VAR num limit := 5;\n"
     "PROC main()\n"
     "  limit := 6;\n"
     "ENDPROC"},
    {5002, Kind::Body,
     "FOR declares the loop variable and alone changes it (manual 1.5). To leave a loop early use "
     "BREAK, to count otherwise use WHILE.",
     "FOR i FROM 1 TO 10 DO\n"
     "  i := 10;\n"
     "ENDFOR",
     "FOR i FROM 1 TO 10 DO\n"
     "  BREAK;\n"
     "ENDFOR"},
    {5003, Kind::Body,
     "System variables such as ERRNO and INTNO are set by the system only (manual 1.11, 1.12).",
     "ERRNO := 0;",
     "reg1 := ERRNO;"},
    {5004, Kind::Body,
     "Data of non-value types cannot be assigned (manual 1.2.1).",
     "VAR clock a;\n"
     "VAR clock b;\n"
     "a := b;",
     "VAR clock a;\n"
     "ClkReset a;"},
    {5005, Kind::Module,
     "A signal is set by instructions: SetDO, Set, Reset, PulseDO, SetGO, SetAO; a signal variable is "
     "connected by AliasIO (manual 1.9).",
     "PROC light(VAR signaldo lamp)\n"
     "  lamp := 1;\n"
     "ENDPROC",
     "PROC light(VAR signaldo lamp)\n"
     "  SetDO lamp, 1;\n"
     "ENDPROC"},
    {5006, Kind::Module,
     "The name of a function is no variable in it. RETURN ends the function and gives its value (manual 1.1.5, 1.4.4).",
     "FUNC num Twice(num x)\n"
     "  Twice := 2 * x;\n"
     "ENDFUNC",
     "FUNC num Twice(num x)\n"
     "  RETURN 2 * x;\n"
     "ENDFUNC"},
    {5010, Kind::Module,
     "Only functions return a value (manual 1.1.5). A procedure can give results through INOUT or VAR "
     "parameters.",
     "PROC work()\n"
     "  RETURN 1;\n"
     "ENDPROC",
     "FUNC num work()\n"
     "  RETURN 1;\n"
     "ENDFUNC"},
    {5011, Kind::Module,
     "RETURN in a function must have a value (manual 1.1.5).",
     "FUNC num work()\n"
     "  RETURN;\n"
     "ENDFUNC",
     "FUNC num work()\n"
     "  RETURN 0;\n"
     "ENDFUNC"},
    {5012, Kind::Module,
     "The value after RETURN must have the type of the function (manual 1.1.5).",
     "FUNC num work()\n"
     "  RETURN \"1\";\n"
     "ENDFUNC",
     "FUNC string work()\n"
     "  RETURN \"1\";\n"
     "ENDFUNC"},
    {5013, Kind::Module,
     "A function must end with RETURN and a value (manual 1.1.5).",
     "FUNC num work()\n"
     "  reg1 := 1;\n"
     "ENDFUNC",
     "FUNC num work()\n"
     "  RETURN 1;\n"
     "ENDFUNC"},
    {5014, Kind::Module,
     "Some way through the function does not meet a RETURN. If the program goes that way, "
     "ERR_FNCNORET is raised (manual 1.1.5).",
     "FUNC num sign(num a)\n"
     "  IF a > 0 RETURN 1;\n"
     "ENDFUNC",
     "FUNC num sign(num a)\n"
     "  IF a > 0 RETURN 1;\n"
     "  RETURN 0;\n"
     "ENDFUNC"},
    {5015, Kind::Module,
     "An optional parameter that was left out must not be used (manual 1.1.5). Ask Present first.",
     "PROC work(\\num level)\n"
     "  reg1 := level;\n"
     "ENDPROC",
     "PROC work(\\num level)\n"
     "  IF Present(level) reg1 := level;\n"
     "ENDPROC"},
    {5016, Kind::Module,
     "Present tells whether an optional parameter was given. A required one always is, so the answer is TRUE "
     "(manual 1.1.5). Leave out the test, or declare the parameter with '\\'.",
     "PROC tell(num level)\n"
     "  IF Present(level) reg1 := level;\n"
     "ENDPROC",
     "PROC tell(\\num level)\n"
     "  IF Present(level) reg1 := level;\n"
     "ENDPROC"},
    {5020, Kind::Body,
     "RETRY and TRYNEXT refer to the instruction that raised the error, which is known only in an "
     "ERROR handler (manual 1.12).",
     "TRYNEXT;",
     "reg1 := 1;\n"
     "ERROR\n"
     "TRYNEXT;"},
    {5021, Kind::Body,
     "RAISE without a number passes on the present error, which exists only in an ERROR handler "
     "(manual 1.12).",
     "RAISE;",
     "RAISE 5;"},
    {5022, Kind::Body,
     "Programs raise the numbers 1 to 90, numbers booked with BookErrNo, and predefined errors "
     "(manual 1.12).",
     "RAISE 100;",
     "RAISE 90;"},
    {5023, Kind::Body,
     "Stop, DebugBreak, RAISE and RETURN are ignored in an UNDO handler, with a warning in the event "
     "log (manual 1.13).",
     "reg1 := 1;\n"
     "UNDO\n"
     "Stop;",
     "reg1 := 1;\n"
     "UNDO\n"
     "TPWrite \"undo\";"},
    {5024, Kind::Body,
     "The robot must not move in an UNDO handler (manual 1.13).",
     "reg1 := 1;\n"
     "UNDO\n"
     "MoveAbsJ CJointT(), v100, fine, tool0;",
     "reg1 := 1;\n"
     "UNDO\n"
     "TPWrite \"undo\";"},
    {5025, Kind::Files,
     "Movement instructions can execute only in a motion task; STATIC and SEMISTATIC tasks run in the "
     "background (manual 1.20).",
     R"ex($ rapidc check main.mod --task=T_WATCH:STATIC=watch.mod
main.mod:
  MODULE MainModule
    PROC main()
    ENDPROC
  ENDMODULE
watch.mod:
  MODULE watch
    PROC main()
      MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
    ENDPROC
  ENDMODULE)ex",
     R"ex($ rapidc check main.mod --task=T_WATCH:STATIC=watch.mod
main.mod:
  MODULE MainModule
    PROC main()
      MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]], v100, fine, tool0;
    ENDPROC
  ENDMODULE
watch.mod:
  MODULE watch
    PROC main()
      TPWrite "watching";
    ENDPROC
  ENDMODULE)ex"},
    {5026, Kind::Module,
     "The list after ERROR names the errors that the handler is for: error constants, the numbers 1 to 90 "
     "that RAISE takes, or data that got a number from BookErrNo (manual 1.12).",
     "PROC main()\n"
     "  reg1 := 1 / reg2;\n"
     "ERROR (0)\n"
     "  RETURN;\n"
     "ENDPROC",
     "PROC main()\n"
     "  reg1 := 1 / reg2;\n"
     "ERROR (ERR_DIVZERO)\n"
     "  RETURN;\n"
     "ENDPROC"},
    {5027, Kind::File,
     "RaiseToUser lets the handler of the user's routine deal with an error of a library: it is executed in the ERROR "
     "handler of a routine whose module is NOSTEPIN, and goes to the nearest calling routine that is not (manual 1.12). "
     "Elsewhere use RAISE.",
     "MODULE m\n"
     "  PROC grip()\n"
     "    reg1 := 1 / reg2;\n"
     "  ERROR\n"
     "    RaiseToUser \\Continue;\n"
     "  ENDPROC\n"
     "ENDMODULE",
     "MODULE m(NOSTEPIN)\n"
     "  PROC grip()\n"
     "    reg1 := 1 / reg2;\n"
     "  ERROR\n"
     "    RaiseToUser \\Continue;\n"
     "  ENDPROC\n"
     "ENDMODULE"},
    {5028, Kind::File,
     "\\Continue: RETRY and TRYNEXT in the user's handler are carried out in this routine. \\BreakOff: this routine is left, "
     "they are carried out at the call in the user's routine (manual 1.12).",
     "MODULE m(NOSTEPIN)\n"
     "  PROC grip()\n"
     "    reg1 := 1 / reg2;\n"
     "  ERROR\n"
     "    RaiseToUser;\n"
     "  ENDPROC\n"
     "ENDMODULE",
     "MODULE m(NOSTEPIN)\n"
     "  PROC grip()\n"
     "    reg1 := 1 / reg2;\n"
     "  ERROR\n"
     "    RaiseToUser \\BreakOff;\n"
     "  ENDPROC\n"
     "ENDMODULE"},
    {5030, Kind::Body,
     "BREAK leaves a loop and CONTINUE begins its next turn; there is none here (manual 1.5). The BREAK of older "
     "programs, which stops for debugging, is DebugBreak since RobotWare 7.1.",
     "BREAK;",
     "WHILE TRUE DO\n"
     "  BREAK;\n"
     "ENDWHILE"},
    {5031, Kind::Body,
     "GOTO may leave IF, TEST, FOR and WHILE, but not enter them: their conditions would not have "
     "been evaluated.",
     "GOTO inside;\n"
     "IF reg1 = 1 THEN\n"
     "  inside:\n"
     "ENDIF",
     "GOTO behind;\n"
     "IF reg1 = 1 THEN\n"
     "ENDIF\n"
     "behind:"},
    {5032, Kind::Body,
     "The body and the handlers of a routine are separate: GOTO cannot jump from one to another. "
     "RETRY and TRYNEXT lead from an ERROR handler back to the body (manual 1.12).",
     "start:\n"
     "reg1 := 1;\n"
     "ERROR\n"
     "GOTO start;",
     "start:\n"
     "reg1 := 1;\n"
     "ERROR\n"
     "RETRY;"},
    {5033, Kind::Body,
     "FOR adds STEP to the loop variable until that has passed the end value (manual 1.5). Adding 0 never gets "
     "there; without STEP the loop counts by 1.",
     "FOR i FROM 1 TO 10 STEP 0 DO\n"
     "  reg1 := i;\n"
     "ENDFOR",
     "FOR i FROM 1 TO 10 STEP 2 DO\n"
     "  reg1 := i;\n"
     "ENDFOR"},
    {5040, Kind::Module,
     "CONNECT stores the identity of the interrupt in a variable of type intnum (manual 1.11).",
     "VAR num i1;\n"
     "PROC main()\n"
     "  CONNECT i1 WITH alarm;\n"
     "ENDPROC\n"
     "TRAP alarm\n"
     "ENDTRAP",
     "VAR intnum i1;\n"
     "PROC main()\n"
     "  CONNECT i1 WITH alarm;\n"
     "ENDPROC\n"
     "TRAP alarm\n"
     "ENDTRAP"},
    {5041, Kind::Module,
     "CONNECT writes the identity of the interrupt, so it needs a variable (manual 1.11).",
     "CONST intnum i1 := 1;\n"
     "PROC main()\n"
     "  CONNECT i1 WITH alarm;\n"
     "ENDPROC\n"
     "TRAP alarm\n"
     "ENDTRAP",
     "VAR intnum i1;\n"
     "PROC main()\n"
     "  CONNECT i1 WITH alarm;\n"
     "ENDPROC\n"
     "TRAP alarm\n"
     "ENDTRAP"},
    {5042, Kind::Module,
     "Data of a routine is gone when it returns, but the interrupt goes on; nobody could delete it "
     "(manual 1.11, 1.2.2).",
     "PROC main()\n"
     "  VAR intnum i1;\n"
     "  CONNECT i1 WITH alarm;\n"
     "ENDPROC\n"
     "TRAP alarm\n"
     "ENDTRAP",
     "VAR intnum i1;\n"
     "PROC main()\n"
     "  CONNECT i1 WITH alarm;\n"
     "ENDPROC\n"
     "TRAP alarm\n"
     "ENDTRAP"},
    {5050, Kind::Body,
     "A placeholder stands for something not yet written (manual 1.1.2). The program can be loaded; "
     "when execution comes to the placeholder, it stops.",
     "<SMT>",
     "reg1 := 1;"},
    {5060, Kind::Body,
     "The first CASE with the value is taken, so this one never is (manual 1.5).",
     "TEST reg1\n"
     "CASE 1, 2:\n"
     "  reg2 := 1;\n"
     "CASE 2:\n"
     "  reg2 := 2;\n"
     "ENDTEST",
     "TEST reg1\n"
     "CASE 1, 2:\n"
     "  reg2 := 1;\n"
     "CASE 3:\n"
     "  reg2 := 2;\n"
     "ENDTEST"},
});
// clang-format on

} // namespace

std::span<const Explanation> explanations5xxx() {
    return kExplanations;
}

} // namespace rapid::diag
