"""generate.py FILE: writes a module with one procedure of 2,400 instructions."""

import sys

COUNT = 400
lines = ["MODULE Huge", "  VAR num sum := 0;", "  VAR num calls := 0;", "  VAR num errors := 0;",
         "  PROC add(num n)", "    calls := calls + 1;", "    sum := sum + n;", "  ENDPROC",
         "  FUNC num divided(num a, num b)", "    RETURN a / b;", "  ERROR", "    RAISE;", "  ENDFUNC",
         "  PROC main()", "    VAR num x := 0;"]
for i in range(1, COUNT + 1):
    lines += [f"    add {i};", "    x := sum / 2;", f"    IF x > {i} sum := sum + 0;",
              f"    FOR k FROM 1 TO 2 DO\n      x := x + k;\n    ENDFOR",
              f"    x := divided(x, {i % 100});"]  # fails four times
lines += ["    TPWrite \"sum \" + NumToStr(sum, 0) + \" calls \" + NumToStr(calls, 0) + \" errors \" + NumToStr(errors, 0);",
          "  ERROR", "    errors := errors + 1;", "    IF ERRNO = ERR_DIVZERO TRYNEXT;", "    RAISE;", "  ENDPROC", "ENDMODULE"]
with open(sys.argv[1], "w", encoding="utf-8") as file:
    file.write("\n".join(lines) + "\n")
