#!/usr/bin/env python3
"""Makes a RAPID project of the size of a large cell and, line for line, the same text in C.

One module in three is a list of taught points, the others are procedures, loops, tests, calls and moves. The C side has a
struct literal where RAPID has an aggregate and a function where RAPID has a routine, with as many operands a line, so
that lines per second of `rapidc check` and of `clang -fsyntax-only` can be put side by side.
"""

import argparse
import os
import random

LINES_PER_MODULE = 1000

C_HEADER = """\
typedef struct { double x, y, z; } pos;
typedef struct { double q1, q2, q3, q4; } orient;
typedef struct { pos trans; orient rot; } pose;
typedef struct { double cf1, cf4, cf6, cfx; } confdata;
typedef struct { double eax_a, eax_b, eax_c, eax_d, eax_e, eax_f; } extjoint;
typedef struct { pos trans; orient rot; confdata robconf; extjoint extax; } robtarget;
typedef struct { double mass; pos cog; orient aom; double ix, iy, iz; } loaddata;
typedef struct { _Bool robhold; pose tframe; loaddata tload; } tooldata;
typedef struct { double v_tcp, v_ori, v_leax, v_reax; } speeddata;
typedef struct { _Bool finep; double pzone_tcp, pzone_ori, pzone_eax; } zonedata;
typedef struct { char text[81]; } string;
typedef _Bool bool;
#define TRUE 1
#define FALSE 0
extern const speeddata v500, v1000;
extern const zonedata z10, fine;
extern int ERRNO;
enum { ERR_DIVZERO = 1, ERR_WAIT_MAXTIME = 2 };
robtarget Offs(robtarget p, double x, double y, double z);
void MoveL(robtarget to, speeddata v, zonedata z, const tooldata *tool);
void MoveJ(robtarget to, speeddata v, zonedata z, const tooldata *tool);
void TPWrite(const char *text, ...);
void WaitTime(double s);
void SetDO(int signal, double value);
void Incr(double *n);
string Append(string a, string b);
string NumToStr(double n, double decimals);
double Abs(double n);
double Sqrt(double n);
double Distance(pos a, pos b);
void TryNext(void);
void Raise(void);
"""


class Writer:
    """Pairs of lines, RAPID and C."""

    def __init__(self):
        self.rapid, self.c = [], []

    def add(self, rapid, c=None):
        self.rapid.append(rapid)
        self.c.append(rapid if c is None else c)


def number(rng):
    return f"{rng.uniform(-1500, 1500):.{rng.choice((0, 1, 2, 2, 3))}f}"


def target(rng):
    q = ",".join(f"{rng.uniform(-1, 1):.6f}" for _ in range(4))
    xyz = ",".join(number(rng) for _ in range(3))
    conf = ",".join(str(rng.randint(-2, 2)) for _ in range(3))
    return f"[{xyz}],[{q}],[{conf},0],[9E9,9E9,9E9,9E9,9E9,9E9]"


def braces(text):
    return text.replace("[", "{").replace("]", "}")


def points_module(w, n, rng, lines=LINES_PER_MODULE):
    """Taught points, as RobotStudio and the pendant write them, and the paths through them."""
    w.add(f"MODULE Points{n}", f"/* Points{n} */")
    w.add("", "")
    paths = []
    count = 0
    while len(w.rapid) < lines * 4 // 5:
        names = []
        for _ in range(rng.randint(10, 60)):
            count += 1
            names.append(f"p{n}_{count * 10}")
            value = target(rng)
            w.add(f"    CONST robtarget {names[-1]}:=[{value}];",
                  f"    static const robtarget {names[-1]}={{{braces(value)}}};")
        paths.append(names)
        w.add(f"    ! path {len(paths)}", f"    // path {len(paths)}")
    for i, names in enumerate(paths):
        if len(w.rapid) > lines:
            break
        w.add(f"    PROC Path{n}_{i}()", f"    void Path{n}_{i}(void) {{")
        for name in names:
            move, speed, zone = rng.choice(("MoveL", "MoveL", "MoveJ")), rng.choice(("v500", "v1000")), \
                rng.choice(("z10", "z10", "fine"))
            w.add(f"        {move} {name},{speed},{zone},tWeld\\WObj:=wobj0;",
                  f"        {move}({name},{speed},{zone},&tWeld);")
        w.add("    ENDPROC", "    }")
    w.add("ENDMODULE", "")


def statements(w, rng, n, routine):
    """A few instructions of each common kind."""
    kind = rng.randint(0, 9)
    a, b = rng.randint(1, 99), rng.randint(1, 9)
    if kind == 0:
        w.add(f"    FOR k FROM 1 TO {b} DO", f"    for (int k = 1; k <= {b}; ++k) {{")
        w.add(f"      list{{k}} := a * k + b / {a};", f"      list[k - 1] = a * k + *b / {a};")
        w.add(f"      IF list{{k}} > {a} AND k < {b} THEN", f"      if (list[k - 1] > {a} && k < {b}) {{")
        w.add(f"        b := b + Abs(list{{k}} - {a});", f"        *b = *b + Abs(list[k - 1] - {a});")
        w.add("      ELSEIF ready THEN", "      } else if (ready) {")
        w.add(f"        counter{n} := counter{n} + 1;", f"        counter{n} = counter{n} + 1;")
        w.add("      ENDIF", "      }")
        w.add("    ENDFOR", "    }")
    elif kind == 1:
        w.add("    i := 0;", "    i = 0;")
        w.add(f"    WHILE i < {b} DO", f"    while (i < {b}) {{")
        w.add("      Incr i;", "      Incr(&i);")
        w.add('      text := text + NumToStr(i, 0);', '      text = Append(text, NumToStr(i, 0));')
        w.add("    ENDWHILE", "    }")
    elif kind in (2, 3):
        w.add(f"    MoveL Offs(pHome{n}, 0, {b}, a), v500, z10, tWeld;",
              f"    MoveL(Offs(pHome{n}, 0, {b}, a), v500, z10, &tWeld);")
        w.add(f"    MoveJ pHome{n}, v1000, fine, tWeld;", f"    MoveJ(pHome{n}, v1000, fine, &tWeld);")
    elif kind == 4:
        w.add("    TEST i", "    switch ((int)i) {")
        w.add(f"    CASE {a}, {a + 1}:", f"    case {a}: case {a + 1}:")
        w.add("      TPWrite \"part \" \\Num:=i;", "      TPWrite(\"part \", i); break;")
        w.add(f"    CASE {a + 2}:", f"    case {a + 2}:")
        w.add(f"      i := {b};", f"      i = {b}; break;")
        w.add("    DEFAULT:", "    default:")
        w.add("      TPWrite \"other\";", "      TPWrite(\"other\");")
        w.add("    ENDTEST", "    }")
    elif kind == 5:
        w.add(f"    IF a > {a} ready := TRUE;", f"    if (a > {a}) ready = TRUE;")
        w.add(f"    IF NOT ready b := b - {b};", f"    if (!ready) *b = *b - {b};")
    elif kind == 6:
        w.add(f"    i := (a + {a}) * (b - {b}) / 2;", f"    i = (a + {a}) * (*b - {b}) / 2;")
        w.add(f"    place := pHome{n};", f"    place = pHome{n};")
        w.add(f"    place.trans.z := place.trans.z + {a};", f"    place.trans.z = place.trans.z + {a};")
        w.add(f"    i := Distance(place.trans, pHome{n}.trans);",
              f"    i = Distance(place.trans, pHome{n}.trans);")
    elif kind == 7:
        w.add(f"    ! wait for the gripper of station {a}", f"    // wait for the gripper of station {a}")
        w.add(f"    WaitTime 0.{a};", f"    WaitTime(0.{a});")
        w.add("", "")
    elif kind == 8 and routine:
        w.add(f"    r{n}_{routine - 1} a - {b}, i;", f"    r{n}_{routine - 1}(a - {b}, &i);")
    else:
        w.add(f"    counter{n} := Sqrt(Abs(a)) + {a}.{b};", f"    counter{n} = Sqrt(Abs(a)) + {a}.{b};")


def code_module(w, n, rng, lines=LINES_PER_MODULE):
    w.add(f"MODULE Code{n}", f"/* Code{n} */")
    w.add(f"  LOCAL VAR num counter{n} := 0;", f"  static double counter{n} = 0;")
    value = target(rng)
    w.add(f"  CONST robtarget pHome{n} := [{value}];",
          f"  static const robtarget pHome{n} = {{{braces(value)}}};")
    routine = 0
    while len(w.rapid) < lines - 30:
        w.add("", "")
        w.add(f"  ! Routine {routine}: picks, checks and places a part", f"  // Routine {routine}: picks, checks")
        w.add(f"  PROC r{n}_{routine}(num a, INOUT num b)", f"  void r{n}_{routine}(double a, double *b) {{")
        w.add("    VAR num i := 0;", "    double i = 0;")
        w.add("    VAR num list{10};", "    double list[10];")
        w.add('    VAR string text := "";', '    string text = {""};')
        w.add("    VAR robtarget place;", "    robtarget place;")
        w.add("    VAR bool ready := FALSE;", "    bool ready = FALSE;")
        w.add("", "")
        for _ in range(rng.randint(4, 14)):
            statements(w, rng, n, routine)
        w.add("  ERROR", "    if (0) {")
        w.add("    IF ERRNO = ERR_DIVZERO TRYNEXT;", "    if (ERRNO == ERR_DIVZERO) TryNext();")
        w.add("    RAISE;", "    Raise(); }")
        w.add("  ENDPROC", "  }")
        routine += 1
    w.add("ENDMODULE", "")


def tool_module(w):
    value = "[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]"
    w.add("MODULE Tools", "/* Tools */")
    w.add(f"  PERS tooldata tWeld := [TRUE,[{value}];",
          f"  static tooldata tWeld = {{TRUE,{{{braces(value)}}};")
    w.add("ENDMODULE", "")


def generate(folder, lines, kind="mixed"):
    """Writes FOLDER/rapid/*.modx and FOLDER/all.c; gives the numbers of lines in RAPID and C and of modules. The kind is
    mixed, code or points."""
    os.makedirs(os.path.join(folder, "rapid"), exist_ok=True)
    everything = C_HEADER.splitlines()
    total = modules = 0
    while total < lines:
        w, rng = Writer(), random.Random(modules)
        if modules == 0:
            tool_module(w)
        elif kind == "points" or (kind == "mixed" and modules % 3 == 1):
            points_module(w, modules, rng)
        else:
            code_module(w, modules, rng)
        with open(os.path.join(folder, "rapid", f"m{modules:04}.modx"), "w", encoding="utf-8") as file:
            file.write("\n".join(w.rapid) + "\n")
        everything += w.c
        total += len(w.rapid)
        modules += 1
    with open(os.path.join(folder, "all.c"), "w", encoding="utf-8") as file:
        file.write("\n".join(everything) + "\n")
    return total, len(everything), modules


def write_large_module(path, kind, lines=10_000):
    """One more module for a generated project: code or points."""
    w, rng = Writer(), random.Random(kind)
    (code_module if kind == "code" else points_module)(w, 90_000, rng, lines)
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(w.rapid) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--lines", type=int, default=500_000)
    parser.add_argument("--kind", choices=("mixed", "code", "points"), default="mixed")
    options = parser.parse_args()
    lines, _, modules = generate(options.folder, options.lines, options.kind)
    print(f"{lines} lines in {modules} modules")


if __name__ == "__main__":
    main()
