"""killed_lines.py RAPIDC MODULE LAST: kills a run with --state at random moments until it ends by itself. Of its numbered lines
none may be missing; what came after the last saved moment may come again. Prints the lines without number."""

import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import time

rapidc, module, last = sys.argv[1], sys.argv[2], int(sys.argv[3])
choose = random.Random(11)
number, kills, rest = 0, 0, []
with tempfile.TemporaryDirectory() as folder:
    for _ in range(40):
        process = subprocess.Popen([rapidc, "run", "--realtime", module, "--state=" + folder], stdout=subprocess.PIPE,
                                   stderr=subprocess.DEVNULL, text=True)
        state_file = os.path.join(folder, "state.json")
        before = os.stat(state_file).st_mtime_ns if os.path.exists(state_file) else 0
        end = time.monotonic() + 60
        while process.poll() is None and time.monotonic() < end:
            if os.path.exists(state_file) and os.stat(state_file).st_mtime_ns != before:
                break
            time.sleep(0.01)  # until it is written for the first time
        time.sleep(choose.random() * 1.4)
        if process.poll() is None:
            process.send_signal(signal.SIGKILL)
            kills += 1
        for line in process.communicate()[0].splitlines():
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
