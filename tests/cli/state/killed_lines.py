"""killed_lines.py RAPIDC MODULE LAST: kills a run with --state at random moments until it ends by itself. Of its numbered lines
none may be missing; what came after the last saved moment may come again. Prints the lines without number."""

import os
import random
import re
import sys
import tempfile

from killed_run import killed_run

rapidc, module, last = sys.argv[1], sys.argv[2], int(sys.argv[3])
choose = random.Random(11)
number, kills, rest = 0, 0, []
with tempfile.TemporaryDirectory() as folder:
    for _ in range(40):
        command = [rapidc, "run", "--realtime", module, "--state=" + folder]
        process, out, _, killed = killed_run(command, os.path.join(folder, "state.json"), choose.random() * 1.4)
        kills += killed
        for line in out.splitlines():
            found = re.fullmatch(r"line (\d+)", line)
            if not found:
                rest.append(line)
            elif int(found[1]) > number + 1:
                sys.exit(f"line {number + 1} is missing before line {found[1]}")
            else:
                number = int(found[1])
        if process.returncode == 0:
            break
print("every line" if number == last and kills > 0 else f"ended with line {number} after {kills} kills")
print("\n".join(rest))
