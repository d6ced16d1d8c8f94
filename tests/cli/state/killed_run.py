"""A run with --state that is killed after its state was written."""

import os
import signal
import subprocess
import time


def killed_run(command, state_file, delay):
    """Kills the command `delay` seconds after it has written the state for the first time, unless it has ended before.
    Returns (process, its standard output, its standard error, whether it was killed)."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    before = os.stat(state_file).st_mtime_ns if os.path.exists(state_file) else 0
    end = time.monotonic() + 60
    while process.poll() is None and time.monotonic() < end:
        if os.path.exists(state_file) and os.stat(state_file).st_mtime_ns != before:
            break
        time.sleep(0.01)
    time.sleep(delay)
    killed = process.poll() is None
    if killed:
        process.send_signal(signal.SIGKILL)
    out, err = process.communicate()
    return process, out, err, killed
