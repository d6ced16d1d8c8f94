"""pieces.py RAPIDC SECONDS [OPTION...] INPUT: runs a program in one process, then in pieces of so many seconds of virtual
time, each in a process of its own with the same --state. Together they must print the same. Says in how many pieces."""

import subprocess
import sys
import tempfile

rapidc, seconds, *rest = sys.argv[1:]


def run(*options):
    done = subprocess.run([rapidc, "run", rest[-1], *rest[:-1], *options], capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout, done.stderr


_, whole, _ = run()
if not whole:
    sys.exit("the program prints nothing")
with tempfile.TemporaryDirectory() as folder:
    pieces, printed, log = 0, "", ""
    status = 4
    while status == 4 and pieces < 400 and "moved to main" not in log:
        status, out, err = run("--state=" + folder, "--max-time=" + seconds)
        printed += out
        log += err
        pieces += 1
if printed == whole and "moved to main" not in log:
    print(f"same in {'many' if pieces > 3 else 'few'} pieces, status {status}")
else:
    print(f"{pieces} pieces, status {status}\n--- in one process\n{whole}--- in pieces\n{printed}{log[-3000:]}")
