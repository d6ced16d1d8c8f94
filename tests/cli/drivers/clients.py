"""clients.py NAME COMMAND...: runs a server of this folder and is its client.

The modules that COMMAND names are copied, with free ports in the place of 5000 and 5001. NAME is a function below, which prints what the
server answers. The output of the server follows, then its exit status.
"""

import json
import math
import os
import re
import socket
import struct
import subprocess
import sys
import tempfile
import threading
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


def exactly(client, count):
    data = b""
    while len(data) < count:
        piece = client.recv(count - len(data))
        if not piece:
            raise ConnectionError("closed in the middle of a message")
        data += piece
    return data


def text(port, _):
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


def binary(port, _):
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


def trajectory(port, state_port):
    """A path is downloaded and executed, another one broken off; the state is read meanwhile; the client leaves and comes again."""
    seen = []

    def read(client):
        try:
            while True:
                seen.append(struct.unpack("<3f", exactly(client, 12)))
        except OSError:
            pass

    def send(client, sequence, joints=(0,) * 6, duration=0.5, kind=11):
        data = struct.pack("<3i i10f2f", kind, 2, 0, sequence, *joints, 0, 0, 0, 0, 1, duration)
        message = struct.pack("<I", len(data)) + data
        client.sendall(message[:30])  # messages come in pieces
        client.sendall(message[30:])
        return struct.unpack("<I3i", exactly(client, 16))

    def stands(joints):
        end = time.monotonic() + LIMIT
        while time.monotonic() < end:
            if seen and all(abs(is_ - wanted) < 1e-4 for is_, wanted in zip(seen[-1], joints)):
                return True
            time.sleep(0.02)
        return False

    state = connect(state_port)
    reader = threading.Thread(target=read, args=(state,), daemon=True)
    reader.start()
    with connect(port) as client:
        print(*send(client, -1))
        for i in range(1, 5):
            send(client, i, (0.1 * i, 0.05 * i, 0, 0, 0.5, -0.1 * i))
        print(*send(client, -3, (0.5, 0.25, 0, 0, 0.5, -0.5)))
        print("there", stands((0.5, 0.25, -0.5)), "seen on the way", any(0.05 < each[0] < 0.45 for each in seen))
        send(client, -1)
        print(*send(client, -3, (-1.5, 0, 0, 0, 0.5, 0), 6))
        time.sleep(1.5)
        print(*send(client, -4))
    time.sleep(0.5)
    before = seen[-1]
    time.sleep(0.5)
    print("broken off", seen[-1] == before, -1.4 < before[0] < 0.49)
    with connect(port) as client:
        send(client, -1)
        send(client, -3, (0, 0, 0, 0, math.radians(30), 0), 1)
        print("home", stands((0, 0, 0)))
        print(*send(client, 0, kind=99))
    state.close()
    reader.join(LIMIT)


def objects(port, _):
    """Commands as JSON, wrong ones, and a client that comes again."""

    def ask(client, **command):
        client.sendall(json.dumps(command, separators=(",", ":")).encode() if command else b"hello")
        answer = json.loads(until(client, b"\n"))
        print(answer["status"], answer["text"])

    with connect(port) as client:
        ask(client, cmd="ping")
        ask(client, cmd="speed", val=50)
        ask(client, cmd="movej", val=[10, 0, 0, 0, 30, 20])
        ask(client, cmd="where")  # is answered when the robot is there
        ask(client)
        ask(client, cmd="dance")
        ask(client, cmd="movej", val="x")
    with connect(port) as client:
        ask(client, cmd="movej", val=[-10, 0, 0, 0, 30, 0])
        ask(client, cmd="where")
        ask(client, cmd="end")


def free_ports(count):
    probes = [socket.socket() for _ in range(count)]
    for probe in probes:
        probe.bind(("127.0.0.1", 0))
    ports = [probe.getsockname()[1] for probe in probes]
    for probe in probes:
        probe.close()
    return ports


def main():
    name, command = sys.argv[1], sys.argv[2:]
    ports = free_ports(2)
    with tempfile.TemporaryDirectory() as folder:

        def copied(match):
            program = os.path.join(folder, os.path.basename(match[0]))
            with open(match[0], encoding="utf-8") as source, open(program, "w", encoding="utf-8") as copy:
                copy.write(source.read().replace("5000;", f"{ports[0]};").replace("5001;", f"{ports[1]};"))
            return program

        command = [re.sub(r"[^=]+\.modx$", copied, part) for part in command]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            try:
                globals()[name](*ports)
                out, err = process.communicate(timeout=LIMIT)
            except (OSError, ValueError, struct.error, subprocess.TimeoutExpired) as problem:
                process.kill()
                out, err = process.communicate()
                print("given up:", problem)
        sys.stdout.write(out.decode(errors="replace"))
        sys.stderr.write(err.decode(errors="replace"))
        print("status", process.returncode)


main()
