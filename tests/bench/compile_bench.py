"""How long people wait for the compiler: the first line that a large program prints, executables, edits, long procedures."""

import os
import re
import shutil
import subprocess
import sys
import time

import generate_project

GOAL_FIRST_S, GOAL_LINES, GOAL_CLANG, GOAL_EDIT_S = 1.0, 8_000, 2, 3.0
GOAL_LONG_S, GOAL_LONG_MB = 10, 1024
LINES = 100_000
PROCEDURE = re.compile(r"^\s*PROC (\w+)\(num a, INOUT num b\)", re.MULTILINE)
CALLS_IN_ONE = 50


def write_main(folder):
    """A module whose main prints a line and calls none of the procedures, but could call all of them."""
    names = []
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name), encoding="utf-8") as file:
            names += PROCEDURE.findall(file.read())
    groups = [names[i:i + CALLS_IN_ONE] for i in range(0, len(names), CALLS_IN_ONE)]
    lines = ["MODULE MainModule", "  VAR num x;", "  PROC main()", '    TPWrite "first";', "    IF x > 0 all0;", "  ENDPROC"]
    for number, group in enumerate(groups):
        lines += [f"  PROC all{number}()", *(f"    {name} 1, x;" for name in group)]
        lines += [f"    all{number + 1};"] if number + 1 < len(groups) else []
        lines += ["  ENDPROC"]
    with open(os.path.join(folder, "main_module.modx"), "w", encoding="utf-8") as file:
        file.write("\n".join([*lines, "ENDMODULE", ""]))
    return len(lines) + 1


def first_line(command):
    """Seconds until the first line comes, and peak memory in MB of the whole run."""
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    line = process.stdout.readline()
    seconds = time.perf_counter() - start
    process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.stdout.close()
    process.returncode = os.waitstatus_to_exitcode(status)
    if line != b"first\n" or process.returncode != 0:
        sys.exit(f"{' '.join(command)} printed {line!r} and ended with status {process.returncode}")
    return seconds, usage.ru_maxrss / 1024


def wall(command, **environment):
    start = time.perf_counter()
    done = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **environment})
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} failed:\n{done.stderr[-2000:]}")
    return time.perf_counter() - start


def large_program(rapidc, work):
    folder = os.path.join(work, "generated_large")
    shutil.rmtree(folder, ignore_errors=True)
    lines, c_lines, _ = generate_project.generate(folder, LINES, "mixed")
    rapid, program = os.path.join(folder, "rapid"), os.path.join(folder, "program")
    lines += write_main(rapid)
    seconds, megabytes = min(first_line([rapidc, "run", rapid]) for _ in range(3))
    print(f"{lines:,} lines: first line printed after {seconds:.2f} s, {megabytes:.0f} MB (goal: at most {GOAL_FIRST_S} s)",
          flush=True)
    cache = os.path.join(folder, "cache")
    built = wall([rapidc, "build", rapid, "-o", program], RAPIDC_CACHE=cache)
    clang = wall(["clang-19", "-O2", "-w", "-c", os.path.join(folder, "all.c"), "-o", os.path.join(folder, "all.o")])
    print(f"build: {built:.1f} s, {lines / built:,.0f} lines/s (goal: {GOAL_LINES:,}); clang-19 -O2 -c: "
          f"{c_lines / clang:,.0f} lines/s; ratio {lines / built / (c_lines / clang):.2f} (goal: {GOAL_CLANG})", flush=True)
    edited = os.path.join(rapid, "m0002.modx")
    with open(edited, encoding="utf-8") as file:
        text = file.read()
    with open(edited, "w", encoding="utf-8") as file:
        file.write(text.replace("counter2 + 1", "counter2 + 2", 1))
    again = wall([rapidc, "build", rapid, "-o", program], RAPIDC_CACHE=cache)
    print(f"build after a one-line edit: {again:.1f} s (goal: at most {GOAL_EDIT_S})", flush=True)


def long_procedures(rapidc, work):
    """One procedure of many statements, compiled because it is called."""
    path = os.path.join(work, "long.modx")
    kinds = {"MoveL": "    MoveL p, v500, z10, tool0;\n", "assignment": "    x := x * 3 + 1;\n",
             "compact IF": "    IF x = 5 x := 4;\n"}
    print(f"\none procedure of N statements, run until its end (goal for 100,000: {GOAL_LONG_S} s, {GOAL_LONG_MB} MB)\n")
    for kind, statement in kinds.items():
        for count in (5_000, 20_000, 80_000):
            with open(path, "w", encoding="utf-8") as file:
                file.write("MODULE Long\n  CONST robtarget p := [[600,0,800],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
                           '  PROC main()\n    path 2;\n  ENDPROC\n  PROC path(num x)\n    TPWrite "first";\n    IF x = 2 RETURN;\n'
                           + statement * count + "  ENDPROC\nENDMODULE\n")
            seconds, megabytes = first_line([rapidc, "run", path])
            print(f"{kind:12} {count:8,} {seconds:8.2f} s {megabytes:8.0f} MB", flush=True)


def run(rapidc, work):
    large_program(rapidc, work)
    long_procedures(rapidc, work)
