#!/usr/bin/env python3
"""Runs the tests that are files: golden programs, tasks, diagnostics, command line, samples, blocks in documents.

A test's name is its path: golden/strings/strlen. Formats: tests/README.md.

  run_tests.py                      all of them
  run_tests.py golden/strings       those below a path
  run_tests.py --update golden/x    writes what the program printed as the new expectation (say why in the commit)
"""

import argparse
import concurrent.futures
import os
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import cases  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    here = os.path.dirname(os.path.abspath(__file__))
    parser.add_argument("paths", nargs="*", help="only tests whose name starts with one of these")
    parser.add_argument("--source", default=os.path.join(here, "..", ".."))
    parser.add_argument("--build", help="build folder, for scratch files (default: SOURCE/build)")
    parser.add_argument("--rapidc", help="the executable under test (default: BUILD/rapidc)")
    parser.add_argument("--list", action="store_true", help="print the names")
    parser.add_argument("--one", help="run exactly this test")
    parser.add_argument("--update", action="store_true", help="rewrite expected output")
    parser.add_argument("--modes", default="jit aot", help="modes of running programs")
    parser.add_argument("-j", type=int, default=os.cpu_count() or 2)
    options = parser.parse_args()

    source = os.path.abspath(options.source)
    build = os.path.abspath(options.build or os.path.join(source, "build"))
    context = cases.Context(source=source, build=build,
                            rapidc=os.path.abspath(options.rapidc or os.path.join(build, "rapidc")),
                            update=options.update, modes=options.modes.split())
    found = cases.discover(source)
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

    def run(name):
        with tempfile.TemporaryDirectory(dir=scratch_root) as scratch:
            try:
                return name, found[name].run(context, scratch)
            except cases.BadTest as problem:
                return name, [f"the test itself is wrong: {problem}"]

    failed = 0
    with concurrent.futures.ThreadPoolExecutor(options.j) as pool:
        for name, problems in pool.map(run, names):
            if problems:
                failed += 1
                print(f"FAILED {name}")
                for problem in problems:
                    print("    " + problem.replace("\n", "\n    "))
            elif options.one or len(names) < 20:
                print(f"passed {name}")
    print(f"{len(names) - failed} of {len(names)} passed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
