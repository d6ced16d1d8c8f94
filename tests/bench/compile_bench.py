"""How long people wait for the compiler: the first line that a large program prints, executables, edits, long procedures."""

import os
import re
import resource
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
    """Seconds until the first line comes; seconds of processor time and peak memory in MB of the whole run."""
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
    return seconds, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def wall(command, **environment):
    """Seconds of wall and of processor time, those of all threads and of the linker together: beside each other they show how
    much of a bad figure is the work of others on the machine."""
    start, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **environment})
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} failed:\n{done.stderr[-2000:]}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.perf_counter() - start, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def large_program(rapidc, work):
    folder = os.path.join(work, "generated_large")
    shutil.rmtree(folder, ignore_errors=True)
    lines, c_lines, _ = generate_project.generate(folder, LINES, "mixed")
    rapid, program = os.path.join(folder, "rapid"), os.path.join(folder, "program")
    lines += write_main(rapid)
    seconds, processor, megabytes = min(first_line([rapidc, "run", rapid]) for _ in range(3))
    print(f"{lines:,} lines: first line printed after {seconds:.2f} s ({processor:.2f} s CPU in all), {megabytes:.0f} MB "
          f"(goal: at most {GOAL_FIRST_S} s)", flush=True)
    cache = os.path.join(folder, "cache")
    built, processor = wall([rapidc, "build", rapid, "-o", program], RAPIDC_CACHE=cache)
    clang, clang_processor = wall(["clang-19", "-O2", "-w", "-c", os.path.join(folder, "all.c"), "-o", os.path.join(folder, "all.o")])
    print(f"build: {built:.1f} s ({processor:.1f} s CPU), {lines / built:,.0f} lines/s (goal: {GOAL_LINES:,}); clang-19 -O2 -c: "
          f"{c_lines / clang:,.0f} lines/s ({clang_processor:.1f} s CPU); ratio {lines / built / (c_lines / clang):.2f} (goal: {GOAL_CLANG})", flush=True)
    edited = os.path.join(rapid, "m0002.modx")
    with open(edited, encoding="utf-8") as file:
        text = file.read()
    with open(edited, "w", encoding="utf-8") as file:
        file.write(text.replace("counter2 + 1", "counter2 + 2", 1))
    again, processor = wall([rapidc, "build", rapid, "-o", program], RAPIDC_CACHE=cache)
    print(f"build after a one-line edit: {again:.1f} s ({processor:.1f} s CPU) (goal: at most {GOAL_EDIT_S})", flush=True)


def branches(first, more, count, last):
    """A statement with `count` branches, each of which assigns a number."""
    return first + "".join(more.format(i + 10) + f"      x := {i};\n" for i in range(count)) + last


HUGE = {
    "MoveL to one target": (100_000, lambda n: "    MoveL p, v500, z10, tool0;\n" * n),
    "MoveL to named targets": (100_000, lambda n: "".join(f"    MoveL p{i}, v500, z10, tool0;\n" for i in range(n))),
    "MoveL of real programs": (3_500, lambda n: "".join(f"    MoveL p{i}, v500, z10, tool0;\n" for i in range(n))),
    "assignments": (1_000_000, lambda n: "    x := x * 3 + 1;\n" * n),
    "compact IF": (200_000, lambda n: "    IF x = 5 x := 4;\n" * n),
    "ELSEIF": (500_000, lambda n: branches("    IF x = 0 THEN\n      x := 1;\n", "    ELSEIF x = {0} THEN\n", n, "    ENDIF\n")),
    "CASE": (500_000, lambda n: branches("    TEST x\n", "    CASE {0}:\n", n, "    ENDTEST\n")),
}


def write_huge(path, count, body):
    target = "[[{0},{1},800],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]"
    with open(path, "w", encoding="utf-8") as file:
        file.write("MODULE Long\n  CONST robtarget p := " + target.format(600, 0) + ";\n")
        if "p0," in body:
            file.writelines(f"  CONST robtarget p{i} := {target.format(600 + i % 97, i % 89)};\n" for i in range(count))
        file.write('  PROC main()\n    path 2;\n  ENDPROC\n  PROC path(num x)\n    TPWrite "first";\n    IF x = 2 RETURN;\n'
                   + body + "  ENDPROC\nENDMODULE\n")


def time_of(command):
    """Seconds of wall and of processor time, and peak memory in MB, until the command ends."""
    start = time.perf_counter()
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with status {process.returncode}")
    return time.perf_counter() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def huge_procedures(rapidc, work):
    """One procedure of many statements, compiled because it is called."""
    path, program = os.path.join(work, "long.modx"), os.path.join(work, "long")
    print(f"\none procedure of N statements (goal: {GOAL_LONG_S} s, {GOAL_LONG_MB} MB)\n")
    for kind, (count, body) in HUGE.items():
        write_huge(path, count, body(count))
        for command in (["run"], ["run", "--stepping"], ["build", "--no-cache", "-o", program]):
            seconds, processor, megabytes = time_of([rapidc, *command, path])
            met = "" if seconds <= GOAL_LONG_S and megabytes <= GOAL_LONG_MB else "  missed"
            print(f"{kind:23}{count:8,} {' '.join(command[:2] if command[0] == 'run' else command[:1]):15}{seconds:7.2f} s "
                  f"({processor:.2f} s CPU) {megabytes:6.0f} MB{met}", flush=True)


def run(rapidc, work):
    large_program(rapidc, work)
    huge_procedures(rapidc, work)
