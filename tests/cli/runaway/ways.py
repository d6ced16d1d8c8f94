"""ways.py RAPIDC MODULE WAY...: these kinds of endless recursion, within a limit of memory; prints what is wrong.

A way that ends with s is run in the stepping profile.
"""

import os
import resource
import subprocess
import sys
import tempfile

with open(sys.argv[1], "rb") as file:
    SANITIZED = b"__asan_init" in file.read()  # its shadow memory takes more addresses than any limit


def limited():
    if not SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (2 << 30, 2 << 30))


def run(command, way, profile):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=120, check=False,
                          preexec_fn=limited)
    text = done.stdout.decode() + done.stderr.decode("utf-8", "replace")
    if way == 11:
        good = done.returncode == 0 and "300 rounds" in text
    elif way == 5:  # EXIT ends the program; the UNDO handler is broken off
        good = done.returncode == 0 and "UNDO aborted" in text and "the rest" not in done.stdout.decode()
    else:
        good = done.returncode == 1 and "Stack overflow" in text and "not reached" not in done.stdout.decode()
    if not good:
        print(f"way {way} {profile}: status {done.returncode}\n{text[:2000]}")
    return good


with open(sys.argv[2], encoding="utf-8") as file:
    source = file.read()
fine = True
with tempfile.TemporaryDirectory() as folder:
    path = os.path.join(folder, "recursion.modx")
    for word in sys.argv[3:]:
        number, profile = int(word.rstrip("s")), ["--stepping"] if word.endswith("s") else []
        with open(path, "w", encoding="utf-8") as file:
            file.write(source.replace("VAR intnum tick;", f"VAR intnum tick;\n  CONST num way := {number};"))
        fine = run([sys.argv[1], "run", *profile, path], number, " ".join(profile)) and fine
print("fine" if fine else "")
