"""session.py NAME MODULE COMMAND...: runs a command on a copy of the module, and is the other side of its sockets.

In the module, 5000 becomes a port that is free; {program} in the command is the copy. Commands before a `--` are run first.
NAME is a function below; it gets that port and prints what it sees. The output of the command follows, then its exit status.
"""

import os
import resource
import socket
import struct
import subprocess
import sys
import tempfile
import time

LIMIT = 30  # s; whatever takes longer hangs


def free_port(kind=socket.SOCK_STREAM):
    with socket.socket(socket.AF_INET, kind) as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def connect(port):
    """To a server that may not listen yet."""
    end = time.monotonic() + LIMIT
    while True:
        try:
            return socket.create_connection(("127.0.0.1", port), LIMIT)
        except ConnectionRefusedError:
            if time.monotonic() > end:
                raise
            time.sleep(0.02)


def listener(port):
    server = socket.create_server(("127.0.0.1", port))
    server.settimeout(LIMIT)
    return server


def take(connection, count):
    data = b""
    while len(data) < count:
        piece = connection.recv(count - len(data))
        if not piece:
            break
        data += piece
    return data


def reset(connection):
    connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    connection.close()


def server_session(port):
    """A client: text, every byte, pieces, a long message, half a message."""
    with connect(port) as client:
        client.sendall(b"hello")
        print("answer", take(client, 8))
        every = bytes(range(256))
        client.sendall(every)
        print("bytes come back", take(client, 256) == every)
        for piece in (b"12", b"34", b"5678"):
            client.sendall(piece)
            time.sleep(0.05)
        print("pieces", take(client, 8))
        client.sendall(b"x" * 79 + "über".encode())
        print("text", take(client, 84) == b"x" * 79 + "über".encode())
        client.sendall(b"half")


def reset_session(port):
    """A client that resets its connection, one that leaves at once, one that stays."""
    client = connect(port)
    client.sendall(b"first")
    print("answer", take(client, 5))
    reset(client)
    connect(port).close()
    with connect(port) as client:
        client.sendall(b"end")
        print("answer", take(client, 3))


def many_connections(port):
    for i in range(200):
        with connect(port) as client:
            client.sendall(b"%d" % i)
            if client.recv(8) != b"%d" % i:
                print("wrong answer", i)


def few_files():
    """A command that does not close its connections runs out of them."""
    resource.setrlimit(resource.RLIMIT_NOFILE, (64, 64))


def late_server(port):
    """Listens some time after the program wants to connect."""
    time.sleep(0.5)
    with listener(port) as server:
        connection, _ = server.accept()
        with connection:
            print("got", take(connection, 5))
            connection.sendall(b"welcome")


def deaf_server(port):
    """Closes the connection while the program sends on."""
    with listener(port) as server:
        connection, _ = server.accept()
        print("got", take(connection, 3))
        reset(connection)


def slow_server(port):
    """Answers late: the virtual clock of the program keeps step."""
    with listener(port) as server:
        connection, _ = server.accept()
        with connection:
            take(connection, 3)
            time.sleep(0.5)
            connection.sendall(b"late")


def port_in_use(port):
    with socket.socket() as other:
        other.bind(("127.0.0.1", port))
        other.listen()
        yield


def datagrams(port):
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client:
        client.bind(("127.0.0.1", 0))
        client.settimeout(0.1)
        for _ in range(LIMIT * 10):  # until the program has bound its socket
            client.sendto(b"hello", ("127.0.0.1", port))
            try:
                answer, sender = client.recvfrom(100)
                break
            except (TimeoutError, ConnectionRefusedError):
                continue
        print("answer", answer, sender[1] == port)
        client.sendto(b"", sender)
        client.settimeout(LIMIT)
        answer = b"hello"
        while answer == b"hello":
            answer = client.recv(100)
        print("answer", answer)


def polled(port):
    """Comes some time after the program has begun to look."""
    time.sleep(0.5)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as client:
        client.settimeout(0.5)
        for _ in range(LIMIT):
            client.sendto(b"hello", ("127.0.0.1", port))
            try:
                client.recv(10)
                break
            except (TimeoutError, ConnectionRefusedError):
                continue
    time.sleep(0.3)
    connect(port).close()


def nothing(_port):
    pass


def main():
    name, module, command = sys.argv[1], sys.argv[2], sys.argv[3:]
    port = free_port(socket.SOCK_DGRAM if name in ("datagrams", "polled") else socket.SOCK_STREAM)
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, os.path.basename(module))
        with open(module, encoding="utf-8") as source, open(program, "w", encoding="utf-8") as copy:
            copy.write(source.read().replace("5000", str(port)))
        holder = port_in_use(port) if name == "port_in_use" else None
        if holder is not None:
            next(holder)
        command = [part.replace("{program}", program) for part in command]
        while "--" in command:
            subprocess.run(command[:command.index("--")], check=True)
            command = command[command.index("--") + 1:]
        few = few_files if name == "many_connections" else None
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=few) as process:
            try:
                if holder is None:
                    globals()[name](port)
                out, err = process.communicate(timeout=LIMIT)
            except (OSError, subprocess.TimeoutExpired) as problem:
                process.kill()
                out, err = process.communicate()
                print("given up:", problem)
        sys.stdout.write(out.decode(errors="replace").replace(str(port), "PORT"))
        sys.stderr.write(err.decode(errors="replace").replace(str(port), "PORT"))
        print("status", process.returncode)


main()
