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

import compile_bench
import generate_project
import lsp_bench

GOAL_MEAN, GOAL_WORST = 1.15, 2.0  # beside C
SPECIAL = ("error_loop", "handled_errors", "late_binding", "late_states")  # raised errors, late binding: C has neither
GOAL_SPECIAL = dict.fromkeys(SPECIAL, 2.5)
GOAL_OVERFLOW = 1.03  # checked arithmetic beside the same without checks, in the mean
GOAL_HELLO_MS, GOAL_LIGHT_MS = 25, 10  # a program; commands that compile nothing
ALONE = (["check"], ["tasks"], ["sockets"], ["start"], ["overflow"], ["compile"], ["huge"], ["files"], ["lsp"])  # parts that can be asked for by name
GOAL_LINES, GOAL_CLANG, GOAL_MB, GOAL_EDIT_MS = 1_000_000, 10, 1024, 10
GOAL_WRITE_MB_S = 20
GOAL_PACK_NS = 60
GOAL_ROUND_US = 1
GOAL_SOCKET_US = 3
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
        goal = GOAL_SPECIAL.get(name, GOAL_WORST)
        print(f"{name:16} {medians[0]:9.3f} {medians[1]:9.3f} {ratios[name]:7.2f}"
              f"{'  <-- above ' + str(goal) if ratios[name] > goal else ''}", flush=True)
    mean = math.exp(statistics.mean(math.log(r) for r in ratios.values()))
    worst = max(ratios, key=ratios.get)
    print(f"\ngeometric mean {mean:.2f} (goal: at most {GOAL_MEAN}), worst {ratios[worst]:.2f} in {worst} "
          f"(goal: at most {GOAL_WORST}; {', '.join(GOAL_SPECIAL)}: {max(GOAL_SPECIAL.values())})")
    for line in wrong:
        print("DIFFERENT RESULTS", line)
    return not wrong


def overflow(names, rapidc, work, rounds, rate):
    """The cost of noticing results out of range: all programs with and without the checks."""
    print(f"checks of overflow, {rounds} rounds in turns, processor time (best)\n")
    print(f"{'program':16} {'with s':>9} {'without s':>9} {'ratio':>7}")
    ratios = []
    for name in names:
        source, checked = os.path.join(PROGRAMS, name + ".modx"), os.path.join(work, name + ".rapid")
        unchecked = os.path.join(work, name + ".unchecked")
        must([rapidc, "build", source, "-o", checked])
        must([rapidc, "build", source, "--without-overflow-checks", "-o", unchecked])
        times = ([], [])
        for _ in range(rounds):
            for side, program in enumerate((checked, unchecked)):
                times[side].append(run_timed([program, f"--rate={rate}"])[0])
        best = [min(t) for t in times]
        ratios.append(best[0] / best[1])
        print(f"{name:16} {best[0]:9.3f} {best[1]:9.3f} {ratios[-1]:7.2f}", flush=True)
    mean = math.exp(statistics.mean(math.log(r) for r in ratios))
    print(f"\ngeometric mean {mean:.3f} (goal: at most {GOAL_OVERFLOW})")


def start_up(rapidc, work):
    path = os.path.join(work, "hello.modx")
    with open(path, "w", encoding="utf-8") as file:
        file.write('MODULE Hello\n  PROC main()\n    TPWrite "Hello";\n  ENDPROC\nENDMODULE\n')
    # "true" shows what starting any process costs in this run.
    for name, command, goal in (("true", ["true"], None), ("rapidc run", [rapidc, "run", path], GOAL_HELLO_MS),
                                ("rapidc check", [rapidc, "check", path], GOAL_LIGHT_MS),
                                ("rapidc fmt", [rapidc, "fmt", path], GOAL_LIGHT_MS),
                                ("rapidc explain", [rapidc, "explain", "RAP2001"], GOAL_LIGHT_MS),
                                ("rapidc builtins", [rapidc, "builtins", "StrLen"], GOAL_LIGHT_MS)):
        runs = [run_timed(command) for _ in range(21)]
        walls = sorted(run[1] for run in runs)
        wanted = f" (goal: at most {goal} ms)" if goal else ""
        print(f"hello world, {name:15} median {1000 * statistics.median(walls):5.1f} ms, "
              f"best {1000 * walls[0]:5.1f} ms, processor {1000 * statistics.median(run[0] for run in runs):5.1f} ms{wanted}")


def measure(command):
    """(processor seconds, peak memory in MB) of a command that must succeed."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    err = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.stderr.close()
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with status {process.returncode}\n{err.decode(errors='replace')[:2000]}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def checker(rapidc, work, rounds):
    """Both compilers look for mistakes in the same half million lines; one process each, one core, in turns.

    The best run counts: what a machine needs to find fresh memory (up to twice the rest on a virtual one) only adds. So each
    runs twice in succession: the second run finds the memory that the first has given back.
    """
    print(f"rapidc check beside clang-19 -fsyntax-only, {rounds} rounds of two runs in turns, processor time (best; median)\n")
    print(f"{'project':8} {'lines':>8} {'check s':>9} {'lines/s':>10} {'MB':>6} {'clang s':>9} {'lines/s':>10} {'ratio':>7}")
    fine = True
    for kind in ("mixed", "code", "points"):
        folder = os.path.join(work, "generated_" + kind)
        shutil.rmtree(folder, ignore_errors=True)
        lines, c_lines, _ = generate_project.generate(folder, 500_000, kind)
        sides = ([rapidc, "check", os.path.join(folder, "rapid")],
                 ["clang-19", "-fsyntax-only", os.path.join(folder, "all.c")])
        results = ([], [])
        for _ in range(rounds):
            for side, command in enumerate(sides):
                results[side].extend((measure(command), measure(command)))
        seconds = [min(r[0] for r in side) for side in results]
        medians = [statistics.median(r[0] for r in side) for side in results]
        memory = max(r[1] for r in results[0])
        speeds = lines / seconds[0], c_lines / seconds[1]
        print(f"{kind:8} {lines:8} {seconds[0]:9.3f} {speeds[0]:10,.0f} {memory:6.0f} {seconds[1]:9.3f} "
              f"{speeds[1]:10,.0f} {speeds[0] / speeds[1]:7.1f}   medians {medians[0]:.3f} and {medians[1]:.3f}", flush=True)
        if kind == "mixed":
            fine = speeds[0] >= GOAL_LINES and memory <= GOAL_MB and speeds[0] >= GOAL_CLANG * speeds[1]
    print(f"\ngoals on the mixed project: {GOAL_LINES:,} lines/s, {GOAL_CLANG} times clang, at most {GOAL_MB} MB: "
          f"{'met' if fine else 'NOT MET'}")


def recheck(program, work):
    """A one-line edit of a module of 10,000 lines, in a project of half a million lines and by itself."""
    if not os.access(program, os.X_OK):
        print(f"{program} is not there: nothing measured for edits")
        return
    print("\nsession: check again after a one-line edit of 10,000 lines, processor time in ms (goal: at most "
          f"{GOAL_EDIT_MS} in a body)\n")
    print(f"{'module':8} {'among lines':>12} {'in a body':>10} {'worst':>7} {'seen by others':>15} {'worst':>7}")
    for kind in ("code", "points"):
        for project in ("alone", "mixed"):
            folder = os.path.join(work, "edited_" + project)
            shutil.rmtree(folder, ignore_errors=True)
            if project == "mixed":
                shutil.copytree(os.path.join(work, "generated_mixed", "rapid"), folder)
            else:
                os.makedirs(folder)
                shutil.copy(os.path.join(work, "generated_mixed", "rapid", "m0000.modx"), folder)
            path = os.path.join(folder, "large.modx")
            generate_project.write_large_module(path, kind)
            done = subprocess.run([program, folder, path], capture_output=True, text=True, check=False)
            if done.returncode != 0:
                sys.exit(f"{program} ended with status {done.returncode}\n{done.stderr}")
            _, lines, *times = done.stdout.split()
            print(f"{kind:8} {int(lines):12,} {times[0]:>10} {times[1]:>7} {times[2]:>15} {times[3]:>7}", flush=True)


def scheduler(rapidc, work, rounds):
    """The cost of tasks and interrupts that wait while one task runs a million rounds of the scheduler."""
    tasks = os.path.join(HERE, "tasks")
    million, waiting = (os.path.join(tasks, name + ".modx") for name in ("rounds", "waiting"))
    armed = os.path.join(work, "armed.modx")
    with open(million, encoding="utf-8") as file:
        text = file.read()
    count = 100
    declarations = "".join(f"  VAR intnum i{k};\n" for k in range(count)) + '  TRAP never\n    TPWrite "trap";\n  ENDTRAP\n'
    orders = "".join(f"    CONNECT i{k} WITH never;\n    ISignalDI di{k % 2 + 1}, 1, i{k};\n" for k in range(count))
    with open(armed, "w", encoding="utf-8") as file:
        file.write(text.replace("  PROC main()\n", declarations + "  PROC main()\n" + orders))
    command = [rapidc, "run", "--config", os.path.join(tasks, "EIO.cfg"), "--rate=unlimited"]
    others = [option for i in range(19) for option in ("--task", f"T_WAIT{i}={waiting}")]
    variants = {"alone": [million], "19 waiting tasks": [million, *others], "100 armed interrupts": [armed]}
    times = {name: [] for name in variants}
    for _ in range(rounds):
        for name, inputs in variants.items():
            times[name].append(run_timed(command + inputs)[0])
    best = {name: min(t) for name, t in times.items()}
    print(f"\na million idle rounds of the scheduler, {rounds} rounds in turns, processor time (best)\n")
    for name, items in (("alone", 1), ("19 waiting tasks", 19), ("100 armed interrupts", count)):
        extra = best[name] - (best["alone"] if name != "alone" else 0)
        print(f"{name:22} {best[name]:7.3f} s   {extra / items:7.4f} us each (goal: below {GOAL_ROUND_US})", flush=True)


def files(rapidc, work, rounds):
    """Lines written to a file, and values packed into rawbytes, less what the loops around them cost."""
    folder = os.path.join(HERE, "files")
    best = {}
    for name in ("lines", "no_lines", "packing", "no_packing"):
        executable = os.path.join(work, name + ".exe")
        must([rapidc, "build", os.path.join(folder, name + ".modx"), "-o", executable])
        best[name] = min(run_timed([executable, "--rate=unlimited"])[0] for _ in range(rounds))
    seconds = best["lines"] - best["no_lines"]
    print(f"\nfiles, {rounds} rounds, processor time (best)\n")
    print(f"10 MB of text line by line {10 / seconds:8.0f} MB/s (goal: at least {GOAL_WRITE_MB_S})")
    print(f"PackRawBytes               {(best['packing'] - best['no_packing']) * 1e9 / 1e7:8.1f} ns   "
          f"(goal: at most {GOAL_PACK_NS})", flush=True)


def sockets(rapidc, work, rounds):
    """The cost of a message from task to task and back."""
    tasks = os.path.join(HERE, "tasks")
    talk, messages = os.path.join(work, "talk"), 100_000
    must([rapidc, "build", os.path.join(tasks, "socket_client.modx"),
          f"--task=T_SERVER:STATIC={os.path.join(tasks, 'socket_server.modx')}", "-o", talk])
    times = []
    for _ in range(rounds):
        seconds, _, out = run_timed([talk, "--offline", "--rate=unlimited"])
        if out != f"{messages * 30}\n":
            sys.exit(f"the client of the socket benchmark prints {out!r}")
        times.append(seconds)
    print(f"\na message over a socket between two tasks and back, {rounds} rounds, processor time (best): "
          f"{min(times) / messages * 1e6:.2f} us (goal: at most {GOAL_SOCKET_US})", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", help="only these programs; start: only the start-up; "
                                                 "overflow: only what the checks of overflow cost; compile: only the time that compiling takes; huge: only that of huge procedures; check: only the checker; "
                                                 "tasks: only the scheduler; files: only files and rawbytes; sockets: only messages between tasks; lsp: only the language server")
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
    unknown = [name for name in options.names if name not in known and options.names not in ALONE]
    if unknown:
        sys.exit(f"no benchmark named {', '.join(unknown)}; there are {', '.join(known)}")
    session = os.path.join(os.path.dirname(rapidc), "recheck_bench")
    if options.names == ["start"]:
        start_up(rapidc, work)
        return 0
    if options.names == ["compile"]:
        compile_bench.run(rapidc, work)
        return 0
    if options.names == ["huge"]:
        compile_bench.huge_procedures(rapidc, work)
        return 0
    if options.names == ["lsp"]:
        lsp_bench.run(rapidc, work)
        return 0
    if options.names == ["overflow"]:
        overflow(known, rapidc, work, options.rounds, options.rate)
        return 0
    if options.names == ["tasks"]:
        scheduler(rapidc, work, options.rounds)
        return 0
    if options.names == ["files"]:
        files(rapidc, work, options.rounds)
        return 0
    if options.names == ["sockets"]:
        sockets(rapidc, work, options.rounds)
        return 0
    if options.names == ["check"]:
        checker(rapidc, work, options.rounds)
        recheck(session, work)
        return 0
    fine = compare(options.names or known, rapidc, work, options.rounds, options.rate)
    if not options.names:
        print()
        overflow(known, rapidc, work, options.rounds, options.rate)
        print()
        start_up(rapidc, work)
        print()
        compile_bench.run(rapidc, work)
        scheduler(rapidc, work, options.rounds)
        files(rapidc, work, options.rounds)
        sockets(rapidc, work, options.rounds)
        print()
        checker(rapidc, work, options.rounds)
        recheck(session, work)
        print()
        lsp_bench.run(rapidc, work)
    return 0 if fine else 1


if __name__ == "__main__":
    sys.exit(main())
