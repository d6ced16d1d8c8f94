#!/usr/bin/env python3
"""Runs the tests that are files: golden programs, tasks, diagnostics, phases, command line, samples,
documents.

A test's name is its path: golden/strings/strlen. Formats: tests/README.md.

  run_tests.py                      all of them
  run_tests.py golden/strings       those below a path
  run_tests.py --quick              what needs neither several processes nor seconds, unit tests as well, programs in memory only
  run_tests.py --update golden/x    writes the new output as expectation, after review (say why in the commit)
"""

import argparse
import concurrent.futures
import os
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import cases  # noqa: E402
import registry  # noqa: E402
from discovery import discover  # noqa: E402


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
    parser.add_argument("--quick", action="store_true", help="the tests that need neither several processes nor seconds, unit tests as well")
    parser.add_argument("--update", action="store_true", help="rewrite expected output")
    parser.add_argument("--modes", help="modes of running programs (default: $RAPIDC_TEST_MODES, else jit for --quick, else jit parts aot step)")
    parser.add_argument("-j", type=int, default=os.cpu_count() or 2)
    parser.add_argument("--within", metavar="SECONDS", type=float,
                        help="begin no further test after this time; exit status 124 when that leaves some out")
    options = parser.parse_args()
    modes = (options.modes or os.environ.get("RAPIDC_TEST_MODES") or ("jit" if options.quick else "jit parts aot step")).split()
    if unknown := [mode for mode in modes if mode not in cases.MODES]:
        parser.error(f"unknown modes {' '.join(unknown)}; the modes are {' '.join(cases.MODES)}, separated by blanks")

    source = os.path.abspath(options.source)
    build = os.path.abspath(options.build or os.path.join(source, "build"))
    if options.write_ctest:
        registry.write_ctest(options.write_ctest, source, build)
        return 0
    context = cases.Context(source=source, build=build,
                            rapidc=os.path.abspath(options.rapidc or os.path.join(build, "rapidc")),
                            update=options.update, modes=modes)
    found = discover(source, options.one.partition("/")[0] if options.one else None)
    if options.quick:
        found = registry.quick_tests(found, source, build)
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
        names = [name for name in found if not prefixes or any(name.startswith(p) for p in prefixes)]
        if not options.quick:  # those begin with the longest
            names.sort()
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
