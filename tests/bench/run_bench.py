#!/usr/bin/env python3
"""Benchmarks: RAPID compiled by rapidc beside the same algorithm in C (clang-19 -O2), the start-up time of
`rapidc run`, and the speed of `rapidc check`.

Both programs of a pair run in turns, several rounds; the ratio is that of the medians of their processor time. Their
outputs must be equal.
"""

import argparse
import math
import os
import shutil
import statistics
import subprocess
import sys
import time

GOAL_MEAN, GOAL_WORST, GOAL_HELLO_MS, GOAL_LINES = 1.3, 2.0, 80, 500_000
HERE = os.path.dirname(os.path.abspath(__file__))
PROGRAMS = os.path.join(HERE, "programs")


def run_timed(command):
    """(processor seconds, wall seconds, stdout)"""
    start = time.perf_counter()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    out = process.stdout.read()
    err = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    process.stdout.close()
    process.stderr.close()
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with status {process.returncode}\n{err.decode(errors='replace')}")
    return usage.ru_utime + usage.ru_stime, wall, out.decode()


def must(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")


def build(name, rapidc, work):
    rapid, c = os.path.join(work, name + ".rapid"), os.path.join(work, name + ".c.exe")
    must([rapidc, "build", os.path.join(PROGRAMS, name + ".modx"), "-o", rapid])
    objects = []
    for source in (name, name + "_library"):
        path = os.path.join(PROGRAMS, source + ".c")
        if os.path.exists(path):
            objects.append(os.path.join(work, source + ".o"))
            must(["clang-19", "-O2", "-std=c11", "-ffp-contract=off", "-c", path, "-o", objects[-1]])
    must(["clang-19", "-O2", *objects, "-lm", "-o", c])
    return rapid, c


def compare(names, rapidc, work, rounds, rate):
    print(f"compiled RAPID beside C, {rounds} rounds in turns, processor time (median)\n")
    print(f"{'program':16} {'RAPID s':>9} {'C s':>9} {'ratio':>7}")
    ratios, wrong = {}, []
    pairs = {name: build(name, rapidc, work) for name in names}
    for name, (rapid, c) in pairs.items():
        times = ([], [])
        outputs = ["", ""]
        for _ in range(rounds):
            for side, command in enumerate(([rapid, f"--rate={rate}"], [c])):
                seconds, _, outputs[side] = run_timed(command)
                times[side].append(seconds)
        if outputs[0] != outputs[1]:
            wrong.append(f"{name}: RAPID prints {outputs[0]!r}, C prints {outputs[1]!r}")
        medians = [statistics.median(t) for t in times]
        ratios[name] = medians[0] / medians[1]
        print(f"{name:16} {medians[0]:9.3f} {medians[1]:9.3f} {ratios[name]:7.2f}"
              f"{'  <-- above ' + str(GOAL_WORST) if ratios[name] > GOAL_WORST else ''}", flush=True)
    mean = math.exp(statistics.mean(math.log(r) for r in ratios.values()))
    worst = max(ratios, key=ratios.get)
    print(f"\ngeometric mean {mean:.2f} (goal: at most {GOAL_MEAN}), worst {ratios[worst]:.2f} in {worst} "
          f"(goal: at most {GOAL_WORST})")
    for line in wrong:
        print("DIFFERENT RESULTS", line)
    return not wrong


def start_up(rapidc, work):
    path = os.path.join(work, "hello.modx")
    with open(path, "w", encoding="utf-8") as file:
        file.write('MODULE Hello\n  PROC main()\n    TPWrite "Hello";\n  ENDPROC\nENDMODULE\n')
    walls = sorted(run_timed([rapidc, "run", path])[1] for _ in range(21))
    print(f"hello world by rapidc run: median {1000 * statistics.median(walls):.1f} ms, best {1000 * walls[0]:.1f} ms "
          f"(goal: at most {GOAL_HELLO_MS} ms)")


def generated_module(number):
    """About 1000 lines of ordinary RAPID."""
    lines = [f"MODULE Generated{number}", f"  LOCAL VAR num counter{number} := 0;",
             f"  PERS tooldata tool{number} := [TRUE, [[0, 0, 100], [1, 0, 0, 0]], [1, [0, 0, 50], [1, 0, 0, 0], "
             "0, 0, 0]];"]
    routine = 0
    while len(lines) < 990:
        name = f"r{number}_{routine}"
        previous = f"r{number}_{routine - 1}" if routine else None
        lines += [
            f"  CONST robtarget p{name} := [[{300 + routine}, {routine}, 400], [0, 0, 1, 0], [0, 0, 0, 0],",
            "      [9E9, 9E9, 9E9, 9E9, 9E9, 9E9]];",
            "",
            f"  ! Routine {routine} of module {number}",
            f"  PROC {name}(num a, INOUT num b \\switch fast)",
            "    VAR num i;",
            "    VAR num list{10};",
            '    VAR string text := "value";',
            "    FOR k FROM 1 TO 10 DO",
            "      list{k} := a * k + b / 2;",
            "      IF list{k} > 100 AND k < 9 THEN",
            "        b := b + Abs(list{k} - 100);",
            "      ELSEIF Present(fast) THEN",
            f"        counter{number} := counter{number} + 1;",
            "      ENDIF",
            "    ENDFOR",
            "    i := 0;",
            "    WHILE i < 5 DO",
            "      Incr i;",
            '      text := text + NumToStr(i, 0) + ",";',
            "    ENDWHILE",
            f"    MoveL Offs(p{name}, 0, 0, a), v500, z10, tool{number};",
            "    TEST i",
            "    CASE 1, 2:",
            "      TPWrite text;",
            "    DEFAULT:",
            '      TPWrite "b=" \\Num:=b;',
            "    ENDTEST",
            f"    {previous} a - 1, b \\fast?fast;" if previous else "    b := a;",
            "  ERROR",
            "    IF ERRNO = ERR_DIVZERO TRYNEXT;",
            "    RAISE;",
            "  ENDPROC",
            "",
        ]
        routine += 1
    # data must stand before routines
    data = [i for i, line in enumerate(lines) if line.startswith("  CONST")]
    taken = {j for i in data for j in (i, i + 1)}
    head, body = lines[:3], [line for j, line in enumerate(lines) if j >= 3 and j not in taken]
    return head + [lines[j] for j in sorted(taken)] + body + ["ENDMODULE"]


def checker(rapidc, work):
    folder = os.path.join(work, "generated")
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    lines = 0
    number = 0
    while lines < 100_000:
        module = generated_module(number)
        lines += len(module)
        with open(os.path.join(folder, f"g{number}.modx"), "w", encoding="utf-8") as file:
            file.write("\n".join(module) + "\n")
        number += 1
    walls = sorted(run_timed([rapidc, "check", folder])[1] for _ in range(5))
    median = statistics.median(walls)
    print(f"rapidc check of {lines} lines in {number} modules: median {median:.3f} s, "
          f"{lines / median:,.0f} lines/s, best {lines / walls[0]:,.0f} (goal: at least {GOAL_LINES:,})")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="only these programs")
    parser.add_argument("--rapidc", default=os.path.join(HERE, "..", "..", "build", "rapidc"))
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--rate", default="unlimited", help="instructions per virtual millisecond")
    options = parser.parse_args()
    rapidc = os.path.abspath(options.rapidc)
    if not os.access(rapidc, os.X_OK):
        sys.exit(f"{rapidc} is not there; build it first (./dev build)")
    work = os.path.join(os.path.dirname(rapidc), "bench")
    os.makedirs(work, exist_ok=True)
    known = sorted(name[:-5] for name in os.listdir(PROGRAMS) if name.endswith(".modx"))
    unknown = [name for name in options.names if name not in known]
    if unknown:
        sys.exit(f"no benchmark named {', '.join(unknown)}; there are {', '.join(known)}")
    fine = compare(options.names or known, rapidc, work, options.rounds, options.rate)
    if not options.names:
        print()
        start_up(rapidc, work)
        checker(rapidc, work)
    return 0 if fine else 1


if __name__ == "__main__":
    sys.exit(main())
