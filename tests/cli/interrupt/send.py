"""send.py SIGNAL TIMES COMMAND...: sends a signal to the command once its temporary HOME: is there, tells how it ends.

SIGNAL `close` closes the command's output after its first line instead; `seen-NAME` sends the signal when that line has come.
"""

import os
import signal
import subprocess
import sys
import tempfile
import time

LIMIT = 15  # s; a command that takes longer hangs
SETTLE = 1  # s from the making of the folder until the program runs, however busy the machine is


def main():
    name, times, command = sys.argv[1], int(sys.argv[2]), sys.argv[3:]
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)  # tests in the background of a shell begin with SIGINT ignored
    with tempfile.TemporaryDirectory() as folder:
        process = subprocess.Popen(command, env=dict(os.environ, TMPDIR=folder), stdout=subprocess.PIPE)
        if name == "close":
            process.stdout.readline()
            process.stdout.close()
        elif name.startswith("seen-"):
            print("seen: " + process.stdout.readline().decode().strip())
            process.send_signal(getattr(signal, name.removeprefix("seen-")))
        else:
            end = time.monotonic() + LIMIT
            while not os.listdir(folder) and process.poll() is None and time.monotonic() < end:
                time.sleep(0.01)
            time.sleep(SETTLE)
            for _ in range(times):
                process.send_signal(getattr(signal, name))
                time.sleep(0.2)
        try:
            status = process.wait(LIMIT)
        except subprocess.TimeoutExpired:
            process.kill()
            status = "none: it had to be killed"
        if name != "close":
            sys.stdout.write(process.stdout.read().decode())
        print(f"status {status}")
        for left in os.listdir(folder):
            print(f"not removed: {left}")


main()
