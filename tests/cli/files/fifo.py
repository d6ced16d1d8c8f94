"""Runs a command whose serial channel is a pair of FIFOs, and is the device at the other end of it."""

import os
import subprocess
import sys

folder, *command = sys.argv[1:]
os.makedirs(folder)
paths = [os.path.join(folder, name) for name in ("in", "out")]
for path in paths:
    os.mkfifo(path)
# Both ways, so that opening does not wait for the other side.
to, back = (os.open(path, os.O_RDWR) for path in paths)
program = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
received = b""
while not received.endswith(b"\n"):
    received += os.read(back, 1)
os.write(to, b"hello\n")
# Bytes after the line that arrived with it would be read together with them: wait until the line was taken.
while program.stdout.readline() != "hello\n":
    pass
os.write(to, bytes(range(256)))
echo = b""
while len(echo) < 256:
    echo += os.read(back, 256)
out, err = program.communicate()
print("received", received.decode().strip())
print("echo", echo == bytes(range(256)))
print(out, end="")
print("status", program.returncode)
print(err, end="", file=sys.stderr)
