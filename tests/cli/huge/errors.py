"""errors.py FILE [SECONDS]: writes a module whose procedures `path` and `taker` and whose trap are long enough to be interpreted; the
rest is compiled. Errors go from one kind to the other. SECONDS: how long the second half of the first call of `path` waits."""

import sys

SECONDS = sys.argv[2] if len(sys.argv) > 2 else "0"
LONG = ["    WaitTime 0;"] * 700  # takes no time

PATH = [
    "  PROC path(num kind)", "    VAR num n := 100;", "    Incr entered;", *LONG,
    "    IF kind = 1 n := n / divisor;",      # fails once: RETRY
    "    IF kind = 2 n := n DIV zero;",       # fails: TRYNEXT leaves n
    "    IF kind = 3 n := short(n);",         # a compiled function fails and passes on: RETRY
    "    IF kind = 4 RAISE own;",             # to the caller
    "    IF kind = 5 deep;",                  # a long jump past this routine
    "    IF kind = 6 n := list{Round(n)};",   # fails: to the caller
    f"    IF kind = 1 WaitTime {SECONDS};", *LONG,
    "    TPWrite \"path \" + NumToStr(kind, 0) + \" n \" + NumToStr(n, 0);",
    "  ERROR",
    "    TPWrite \"path's handler \" + NumToStr(kind, 0);",
    "    IF kind = 1 OR kind = 3 THEN", "      divisor := 4;", "      RETRY;", "    ENDIF",
    "    IF kind = 2 TRYNEXT;",
    "    RAISE;",
    "  UNDO", "    TPWrite \"undo path \" + NumToStr(kind, 0);", "  ENDPROC"]
TAKER = [
    "  PROC taker()", "    VAR num calls := 0;", *LONG, "    Incr calls;", "    middle;", *LONG,
    "    TPWrite \"taker continues, calls \" + NumToStr(calls, 0);",
    "  ERROR (far)", "    TPWrite \"taker takes it\";", "    fails := FALSE;", "    RETRY;", "  ENDPROC"]
TRAP = ["  TRAP tick", *LONG, "    Incr ticks;", "    ticks := ticks / zero;",
        "  ERROR", "    Incr trapErrors;", "    TRYNEXT;", "  ENDTRAP"]
SHORT = """\
  PROC main()
    BookErrNo own;
    BookErrNo far;
    CONNECT timer WITH tick;
    ITimer \\Single, 0.05, timer;
    WaitTime 0.1;
    TPWrite "ticks " + NumToStr(ticks, 0) + " errors " + NumToStr(trapErrors, 0);
    FOR i FROM 1 TO 6 DO
      divisor := 0;
      IF i = 5 THEN
        lister;
      ELSE
        outer i;
      ENDIF
    ENDFOR
    taker;
    TPWrite "entered " + NumToStr(entered, 0);
  ENDPROC
  PROC outer(num kind)
    path kind;
    TPWrite "outer continues";
  ERROR
    TPWrite "outer's handler " + ValToStr(ERRNO = own) + " " + ValToStr(ERRNO = ERR_OUTOFBND);
    TRYNEXT;
  ENDPROC
  PROC lister()
    path 5;
  ERROR (56)
    TPWrite "lister takes " + NumToStr(ERRNO, 0);
    TRYNEXT;
  ENDPROC
  PROC deep()
    RAISE 56;
  ENDPROC
  PROC middle()
    IF fails RAISE far;
    TPWrite "middle returns";
  UNDO
    TPWrite "undo middle";
  ENDPROC
  FUNC num short(num a)
    RETURN a / divisor;
  ERROR
    TPWrite "short passes on";
    RAISE;
  ENDFUNC
"""
DATA = ["MODULE Mixed", "  VAR errnum own := -1;", "  VAR errnum far := -1;", "  VAR intnum timer;", "  VAR bool fails := TRUE;",
        "  VAR num list{3} := [1, 2, 3];", *(f"  VAR num {name} := 0;" for name in ("divisor", "zero", "entered", "ticks", "trapErrors"))]

with open(sys.argv[1], "w", encoding="utf-8") as file:
    file.write("\n".join([*DATA, *PATH, *TAKER, *TRAP, SHORT + "ENDMODULE", ""]))
