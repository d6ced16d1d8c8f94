#!/usr/bin/env python3
"""Runs clang-tidy over sources, those only that changed since they were found clean.

run_tidy.py --build DIR [-j N] FILE...
A clean source leaves a stamp in DIR/tidy; it counts until the source, a header it includes, or .clang-tidy is newer.
"""

import argparse
import concurrent.futures
import os
import subprocess
import sys
import time


def headers_of(build):
    """Sources and the files each includes, as ninja recorded them at the last build."""
    listing = subprocess.run(["ninja", "-C", build, "-t", "deps"], capture_output=True, text=True, check=False).stdout
    found, files = {}, []
    for line in listing.splitlines():
        if line.startswith(" "):
            files.append(os.path.normpath(os.path.join(build, line.strip())))
            if len(files) == 1:
                found[files[0]] = files
        else:
            files = []
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", required=True)
    parser.add_argument("-j", type=int, default=os.cpu_count() or 2)
    parser.add_argument("files", nargs="+")
    options = parser.parse_args()
    build = os.path.abspath(options.build)
    stamps = os.path.join(build, "tidy")
    os.makedirs(stamps, exist_ok=True)
    includes = headers_of(build)

    def stamp_of(file):
        return os.path.join(stamps, file.replace("/", "_") + ".clean")

    def is_clean(file):
        path = os.path.abspath(file)
        if path not in includes or not os.path.exists(stamp_of(file)):
            return False
        since = os.path.getmtime(stamp_of(file))
        return all(os.path.exists(f) and os.path.getmtime(f) <= since for f in [*includes[path], ".clang-tidy"])

    def tidy(file):
        begun = time.time()
        done = subprocess.run(["clang-tidy-19", "-p", build, "--quiet", file], capture_output=True, text=True,
                              check=False)
        if done.returncode == 0:
            with open(stamp_of(file), "w", encoding="utf-8"):
                pass
            os.utime(stamp_of(file), (begun, begun))  # what was changed meanwhile is newer
        return file, done.returncode, done.stdout

    todo = [file for file in options.files if not is_clean(file)]
    print(f"{len(todo)} of {len(options.files)} sources to look at", file=sys.stderr)
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(options.j) as pool:
        for number, (file, status, said) in enumerate(pool.map(tidy, todo), 1):
            if status != 0:
                failed += 1
                print(said.strip() or f"{file}: clang-tidy ended with status {status}", flush=True)
            if number % 20 == 0:
                print(f"{number} of {len(todo)}", file=sys.stderr, flush=True)
    print(f"{failed} sources with findings" if failed else "no findings", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
