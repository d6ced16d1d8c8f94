"""killed_in_loop.py RAPIDC MODULE: kills runs with --state in a loop of assignments; each later run continues inside."""

import os
import sys
import tempfile

from killed_run import killed_run

begun = continued = 0
with tempfile.TemporaryDirectory() as folder:
    for _ in range(4):
        command = [sys.argv[1], "run", sys.argv[2], "--state=" + folder]
        _, out, err, _ = killed_run(command, os.path.join(folder, "state.json"), 0)
        begun += out.count("begin")
        continued += err.count(" 20925:")
print(f"begun {begun} time, continued {continued} times")
