"""killed_in_loop.py RAPIDC MODULE: kills runs with --state in a loop of assignments; each later run continues inside."""

import os
import signal
import subprocess
import sys
import tempfile
import time

begun = continued = 0
with tempfile.TemporaryDirectory() as folder:
    for _ in range(4):
        process = subprocess.Popen([sys.argv[1], "run", sys.argv[2], "--state=" + folder], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
        state_file = os.path.join(folder, "state.json")
        before = os.stat(state_file).st_mtime_ns if os.path.exists(state_file) else 0
        end = time.monotonic() + 60
        while time.monotonic() < end and (not os.path.exists(state_file) or os.stat(state_file).st_mtime_ns == before):
            time.sleep(0.01)  # until it is written for the first time
        process.send_signal(signal.SIGKILL)
        out, err = process.communicate()
        begun += out.count("begin")
        continued += err.count(" 20925:")
print(f"begun {begun} time, continued {continued} times")
