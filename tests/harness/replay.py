#!/usr/bin/env python3
"""Runs a replay program of a fuzz target over its kept inputs: a folder, and the archive beside it if there is one.

  replay.py build/rapidc_replay_parser tests/fuzz/corpus/parser
"""
import os
import subprocess
import sys
import tarfile
import tempfile


def main():
    program, folder = sys.argv[1:]
    folders = [folder]
    with tempfile.TemporaryDirectory() as scratch:
        if os.path.exists(folder + ".tar.gz"):
            with tarfile.open(folder + ".tar.gz") as archive:
                archive.extractall(scratch)
            folders.append(scratch)
        done = subprocess.run([program, *folders], capture_output=True, text=True, errors="replace", check=False)
    if done.returncode != 0:
        print("\n".join(done.stderr.splitlines()[-5:]))
        print(f"ended with {done.returncode} at the input named above")
        return 1
    print(done.stdout, end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
