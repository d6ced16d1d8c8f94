"""killed_files.py RAPIDC MODULE OPTION...: kills a run with --state and files in HOME: at random moments until it ends by itself.

After each kill: the state is whole; every line that the state counts is in the file; a configuration that SaveCfgData writes and
a copy that CopyFile makes are whole or absent. Prints what the last run prints."""

import json
import os
import random
import re
import sys
import tempfile

from killed_run import killed_run

rapidc, module, *options = sys.argv[1:]
choose = random.Random(23)
LARGE = bytes(range(256)) * 40000


def check(home, state_file, saved):
    with open(state_file, encoding="utf-8") as file:
        state = json.load(file)
    counted = float(state["persistents"]["WRITTEN"]["value"])
    lines = ""
    if os.path.exists(os.path.join(home, "lines.txt")):
        with open(os.path.join(home, "lines.txt"), encoding="utf-8") as file:
            lines = file.read()
    numbers = [int(number) for number in re.findall(r"^line (\d+)$", lines, re.MULTILINE)]
    if max(numbers, default=0) < counted:
        sys.exit(f"the state counts {counted} lines, the file has {max(numbers, default=0)}")
    if len(set(numbers)) < counted:
        sys.exit("a line is missing")
    names = [name for name in os.listdir(home) if not name.startswith(".")]
    for name in names:
        with open(os.path.join(home, name), "rb") as file:
            content = file.read()
        if name == "copy.bin" and content != LARGE:
            sys.exit(f"a part of a copy: {len(content)} bytes")
        if name == "moc.cfg" and saved.setdefault(name, content) != content:
            sys.exit(f"a part of a configuration: {len(content)} bytes")


def main():
    kills, saved = 0, {}
    with tempfile.TemporaryDirectory() as folder:
        home, state = os.path.join(folder, "home"), os.path.join(folder, "state")
        os.mkdir(home)
        with open(os.path.join(home, "large.bin"), "wb") as file:
            file.write(LARGE)
        state_file = os.path.join(state, "state.json")
        for _ in range(60):
            command = [rapidc, "run", module, "--rate=unlimited", "--realtime", f"--home={home}", f"--state={state}"]
            process, out, err, killed = killed_run([*command, *options], state_file, choose.random() * 0.4)
            kills += killed
            if process.returncode > 0:
                sys.exit(err)
            check(home, state_file, saved)
            if process.returncode >= 0:
                break
        left = [name for name in os.listdir(home) if name.startswith(".")]
        print("whole" if kills > 2 else f"only {kills} kills", f"status {process.returncode}", f"left {len(left)}")
        print(out if process.returncode == 0 else err, end="")


main()
