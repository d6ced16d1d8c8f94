#!/usr/bin/env python3
"""Runs the tests that are files: golden programs, tasks, diagnostics, phases, command line, samples,
documents.

A test's name is its path: golden/strings/strlen. Formats: tests/README.md.

  run_tests.py                      all of them
  run_tests.py golden/strings       those below a path
  run_tests.py --update golden/x    writes the new output as expectation, after review (say why in the commit)
"""

import argparse
import concurrent.futures
import os
import re
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import cases  # noqa: E402
from discovery import discover  # noqa: E402


def bracket(text):
    """A CMake argument that is taken literally."""
    return f"[==[{text}]==]"


def unit_cases(program):
    """(name, tags) of the Catch2 cases in the unit test program; none when it is not built."""
    if not os.access(program, os.X_OK):
        return []

    def listing(option):
        return subprocess.run([program, option], capture_output=True, text=True, check=False).stdout.splitlines()

    names = [line for line in listing("--list-test-names-only") if line.strip()]
    # --list-tests has the same order, but wraps long names: a case begins with two blanks, its tags with six.
    tags = []
    for line in listing("--list-tests"):
        if re.match(r"^  \S", line):
            tags.append([])
        elif re.match(r"^      \[", line) and tags:
            tags[-1] += re.findall(r"\[(\w[^\]]*)\]", line)
    return list(zip(names, tags if len(tags) == len(names) else [[] for _ in names]))


def case_filter(name):
    """The name as a Catch2 test spec that matches it and nothing else."""
    for character in '\\,[':
        name = name.replace(character, "\\" + character)
    return name


# Groups that `./dev test --quick` leaves out: each of their tests starts several processes, or needs seconds.
NOT_QUICK = {"cli", "errors", "fuzz", "interpreted"}
# Folders whose programs run interpreted, too: what leaves a routine or enters it elsewhere than at its beginning.
INTERPRETED = ("golden/errors", "golden/flow", "golden/interrupts", "golden/stop", "cli/state", "cli/step")
# Unit tests with these tags need seconds.
SLOW_TAGS = {"random", "large"}


def write_ctest(path, source, build):
    """Registers all tests. Labels: the group (unit, golden, diag ...), for unit tests their tags as well, and `quick`."""
    lines = []

    def add(name, command, timeout, tags=()):
        group = name.partition("/")[0]
        labels = [group, *sorted(set(tags) - {group})]
        if group not in NOT_QUICK and not SLOW_TAGS & set(tags):
            labels.append("quick")
        lines.append(f"add_test({bracket(name)} {' '.join(bracket(word) for word in command)})")
        lines.append(f"set_tests_properties({bracket(name)} PROPERTIES TIMEOUT {timeout} "
                     f"WORKING_DIRECTORY {bracket(build)} LABELS {bracket(';'.join(labels))})")

    program = os.path.join(build, "rapidc_unit_tests")
    known = unit_cases(program)
    if not known:  # the test fails, because the program is missing
        add("unit/rapidc_unit_tests is not built; build the target rapidc_tests", [program], 60)
    for name, tags in known:
        add("unit/" + name, [program, "-w", "NoTests", case_filter(name)], 240, tags)
    runner = os.path.join(source, "tests", "harness", "run_tests.py")
    for name in sorted(discover(source)):
        add(name, [sys.executable, runner, "--source", source, "--build", build, "--one", name], 120)
    for folder in INTERPRETED:
        add("interpreted/" + folder, [sys.executable, runner, "--source", source, "--build", build, "--modes", "words stepwords",
                                      folder], 600)
    corpora = os.path.join(source, "tests", "fuzz", "corpus")
    for entry in sorted(os.scandir(corpora), key=lambda entry: entry.name):
        if entry.is_dir():
            add("fuzz/" + entry.name, [sys.executable, os.path.join(source, "tests", "harness", "replay.py"),
                                       os.path.join(build, "rapidc_replay_" + entry.name), entry.path], 240)
    add("fuzz/tasks_random", [os.path.join(build, "rapidc_replay_tasks"), "-random=8"], 240)
    scripts = os.path.join(source, "scripts")
    add("layers/layering", [sys.executable, os.path.join(scripts, "check_layering.py"), "--source", source], 60)
    layers = os.path.join(source, "tests", "layers")
    add("layers/layering_test", [sys.executable, os.path.join(layers, "layering_test.py")], 60)
    add("layers/classes", [sys.executable, os.path.join(scripts, "check_classes.py"), "--source", source], 60)
    add("layers/runtime_alone", [os.path.join(build, "rapidc_runtime_alone")], 60)
    add("stdlib/names", [sys.executable, os.path.join(scripts, "check_stdlib.py"),
                         "--builtins", os.path.join(build, "generated", "stdlib", "builtins.json"),
                         "--rapidc", os.path.join(build, "rapidc")], 60)
    add("errors/every_constant", [sys.executable, os.path.join(scripts, "check_error_tests.py"), "--rapidc",
                                  os.path.join(build, "rapidc")], 900)
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    here = os.path.dirname(os.path.abspath(__file__))
    parser.add_argument("paths", nargs="*", help="only tests whose name starts with one of these")
    parser.add_argument("--source", default=os.path.join(here, "..", ".."))
    parser.add_argument("--build", help="build folder, for scratch files (default: SOURCE/build)")
    parser.add_argument("--rapidc", help="the executable under test (default: BUILD/rapidc)")
    parser.add_argument("--list", action="store_true", help="print the names")
    parser.add_argument("--write-ctest", metavar="FILE", help="write a ctest file that registers all tests")
    parser.add_argument("--one", help="run exactly this test")
    parser.add_argument("--update", action="store_true", help="rewrite expected output")
    parser.add_argument("--modes", default=os.environ.get("RAPIDC_TEST_MODES", "jit parts aot step"),
                        help="modes of running programs (default: $RAPIDC_TEST_MODES, else jit parts aot step)")
    parser.add_argument("-j", type=int, default=os.cpu_count() or 2)
    parser.add_argument("--within", metavar="SECONDS", type=float,
                        help="begin no further test after this time; exit status 124 when that leaves some out")
    options = parser.parse_args()
    modes = options.modes.split()
    if unknown := [mode for mode in modes if mode not in cases.MODES]:
        parser.error(f"unknown modes {' '.join(unknown)}; the modes are {' '.join(cases.MODES)}, separated by blanks")

    source = os.path.abspath(options.source)
    build = os.path.abspath(options.build or os.path.join(source, "build"))
    if options.write_ctest:
        write_ctest(options.write_ctest, source, build)
        return 0
    context = cases.Context(source=source, build=build,
                            rapidc=os.path.abspath(options.rapidc or os.path.join(build, "rapidc")),
                            update=options.update, modes=modes)
    found = discover(source)
    if options.list:
        print("\n".join(sorted(found)))
        return 0
    if options.one:
        if options.one not in found:
            print(f"there is no test named {options.one}")
            return 1
        names = [options.one]
    else:
        prefixes = [path.removeprefix("tests/").rstrip("/") for path in options.paths]
        names = sorted(name for name in found if not prefixes or any(name.startswith(p) for p in prefixes))
    if not names:
        print("no test matches")
        return 1
    if not os.access(context.rapidc, os.X_OK):
        print(f"{context.rapidc} is not there; build it first (./dev build)")
        return 1

    scratch_root = os.path.join(build, "test-scratch")
    os.makedirs(scratch_root, exist_ok=True)

    end = None if options.within is None else time.monotonic() + options.within

    def run(name):
        if end is not None and time.monotonic() >= end:
            return name, None
        with tempfile.TemporaryDirectory(dir=scratch_root) as scratch:
            try:
                return name, found[name].run(context, scratch)
            except cases.BadTest as problem:
                return name, [f"the test itself is invalid: {problem}"]

    failed = left_out = 0
    with concurrent.futures.ThreadPoolExecutor(options.j) as pool:
        for name, problems in pool.map(run, names):
            if problems is None:
                left_out += 1
            elif problems:
                failed += 1
                print(f"FAILED {name}")
                for problem in problems:
                    print("    " + problem.replace("\n", "\n    "))
            elif options.one or len(names) < 20:
                print(f"passed {name}")
    print(f"{len(names) - failed - left_out} of {len(names)} passed" + (f", {left_out} left out" if left_out else ""))
    if failed:
        return 1
    return 124 if left_out else 0


if __name__ == "__main__":
    sys.exit(main())
