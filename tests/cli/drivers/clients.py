"""clients.py NAME MODULE COMMAND...: runs a server of this folder, as a copy with a free port, and is its client.

NAME is a function below, which prints what the server answers. The output of the server follows, then its exit status.
"""

import os
import socket
import struct
import subprocess
import sys
import tempfile
import time

LIMIT = 30  # s; whatever takes longer hangs


def connect(port):
    end = time.monotonic() + LIMIT
    while True:
        try:
            return socket.create_connection(("127.0.0.1", port), LIMIT)
        except ConnectionRefusedError:
            if time.monotonic() > end:
                raise
            time.sleep(0.02)


def until(client, end):
    data = b""
    while not data.endswith(end):
        piece = client.recv(1024)
        if not piece:
            break
        data += piece
    return data.decode()


def text(port):
    """One statement, several in a message, one that is cut, a text in quotes, a code that nothing answers to."""
    with connect(port) as client:
        print(until(client, b";"))
        client.sendall(b"@1 2 250;")
        print(until(client, b"@1 2;"))
        client.sendall(b"@2 1 400 100 550;@3 4;")
        print(until(client, b"@3 4;"))
        for piece in (b"@4 3 ", b'"two wo', b'rds" 7;@5 1 40', b"0 0 500;@6 4", b";"):
            client.sendall(piece)
            time.sleep(0.05)
        print(until(client, b"@6 4;"))
        client.sendall(b"@7 77;")
        print(until(client, b"@7 77;"))
        client.sendall(b"@8 9;")
        print(until(client, b"@8 9;"))


def binary(port):
    """Requests of any length, an unknown code, a client that leaves and comes again."""

    def ask(client, code, *values):
        client.sendall(struct.pack("<HH%df" % len(values), len(values), code, *values))
        data = client.recv(1024)
        print(*struct.unpack(">HH", data[:4]), *struct.unpack(">%df" % (len(data) // 4 - 1), data[4:]))

    with connect(port) as client:
        ask(client, 0)
        ask(client, 1, 400, 100, 550)
        ask(client, 2)
        ask(client, 50, *range(12))
    time.sleep(0.2)
    with connect(port) as client:
        ask(client, 2)
        ask(client, 9)


def main():
    name, module, command = sys.argv[1], sys.argv[2], sys.argv[3:]
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, os.path.basename(module))
        with open(module, encoding="utf-8") as source, open(program, "w", encoding="utf-8") as copy:
            copy.write(source.read().replace("5000;", f"{port};"))
        command = [part.replace("{program}", program) for part in command]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            try:
                globals()[name](port)
                out, err = process.communicate(timeout=LIMIT)
            except (OSError, struct.error, subprocess.TimeoutExpired) as problem:
                process.kill()
                out, err = process.communicate()
                print("given up:", problem)
        sys.stdout.write(out.decode(errors="replace"))
        sys.stderr.write(err.decode(errors="replace"))
        print("status", process.returncode)


main()
