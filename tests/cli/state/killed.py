"""killed.py RAPIDC MODULE: kills a run with --state at random moments; the state must be whole, and never go back."""

import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time

choose = random.Random(7)
last = 0
with tempfile.TemporaryDirectory() as folder:
    for _ in range(4):
        process = subprocess.Popen([sys.argv[1], "run", "--rate=unlimited", sys.argv[2], "--state=" + folder],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        state_file = os.path.join(folder, "state.json")
        before = os.stat(state_file).st_mtime_ns if os.path.exists(state_file) else 0
        end = time.monotonic() + 30
        while time.monotonic() < end and (not os.path.exists(state_file) or os.stat(state_file).st_mtime_ns == before):
            time.sleep(0.01)  # until it is written for the first time
        time.sleep(choose.random() * 1.3)
        process.send_signal(signal.SIGKILL)
        process.wait()
        with open(state_file, encoding="utf-8") as file:
            state = json.load(file)
        count = float(state["persistents"]["COUNT"]["value"])
        if count < last:
            print(f"went back from {last} to {count}")
            break
        last = count
    else:
        print("whole" if last > 0 else "nothing was kept")
