"""peak_growth.py COMMAND...: runs a command; says whether its memory grew in the second half of its run."""

import os
import subprocess
import sys
import time


def resident(pid):
    try:
        with open(f"/proc/{pid}/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE") // 1024
    except (OSError, IndexError):
        return 0


process = subprocess.Popen(sys.argv[1:], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
samples = []
while process.poll() is None:
    samples.append(resident(process.pid))
    time.sleep(0.02)
samples = [sample for sample in samples if sample > 0]
print(process.stdout.read().decode(), end="")
print("status", process.returncode)
growth = max(samples[-10:], default=0) - samples[len(samples) // 2] if samples else 0
print("flat" if growth < 15000 else f"{growth} KB more in the second half")
