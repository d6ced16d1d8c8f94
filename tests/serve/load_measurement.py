"""Measures `rapidc serve` under load: requests (issue 20: ten clients, 40 requests/s each) and events (1,000 signals, ten sockets).

    python3 tests/serve/load_measurement.py [SECONDS]

Prints numbers; not a test, because they depend on the machine.
"""

import os
import shutil
import sys
import tempfile
import threading
import time

from rws_client import RwsClient
from serve_testing import Serve

POLL = ["/rw/system", "/ctrl", "/rw/panel/ctrlstate", "/rw/panel/opmode", "/rw/rapid/execution", "/rw/rapid/tasks",
        "/rw/motionsystem/mechunits/ROB_1?resource=dynamic", "/rw/motionsystem/mechunits/ROB_1/jointtarget"]
MODULE = """MODULE MainModule
  CONST jointtarget a := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget b := [[40,20,10,30,60,50],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    WHILE TRUE DO
      MoveAbsJ a, v500, z10, tool0;
      MoveAbsJ b, v500, fine, tool0;
    ENDWHILE
  ENDPROC
ENDMODULE
"""
SIGNALS = 1000
EIO = "EIO:CFG_1.0:6:0::\n#\nEIO_SIGNAL:\n" + "".join(
    f'      -Name "s{i}" -SignalType "AO" -Access "All" -MaxLog 1000000 -MaxPhys 1000000\n' for i in range(SIGNALS))
CHANGES = "MODULE MainModule\n  VAR num n := 0;\n  PROC main()\n    WHILE TRUE DO\n      n := n + 1;\n" + "".join(
    f"      SetAO s{i}, n;\n" for i in range(SIGNALS)) + "      WaitTime 0.01;\n    ENDWHILE\n  ENDPROC\nENDMODULE\n"


def memory_of(process):
    with open(f"/proc/{process.pid}/status", encoding="ascii") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("VmRSS"))


def seconds_of(process):
    with open(f"/proc/{process.pid}/stat", encoding="ascii") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def percentile(values, part):
    return sorted(values)[min(len(values) - 1, int(len(values) * part))] * 1000


def requests(server, seconds, rate=40):
    times, errors, lock = [], [], threading.Lock()

    def run(number):
        client = RwsClient(server.addresses["http" if number % 2 == 0 else "https"], 1 + number % 2)
        own, begin = [], time.monotonic()
        client.get(POLL[2])
        for i in range(int(seconds * rate)):
            wait = begin + i / rate - time.monotonic()
            if wait > 0:
                time.sleep(wait)
            path = POLL[i % len(POLL)]
            if number % 2:
                path = path.replace("ctrlstate", "ctrl-state")
            sent = time.monotonic()
            status = client.get(path).status
            own.append(time.monotonic() - sent)
            if status != 200:
                with lock:
                    errors.append((path, status))
        with lock:
            times.extend(own)
        client.close()

    threads = [threading.Thread(target=run, args=(i,)) for i in range(10)]
    counter = RwsClient(server.addresses["http"], 1)
    cycles = lambda: [int(counter.get("/ctrl/virtualtime/vttimeslice").values()[name]) for name in ("cycles", "missed-cycles")]  # noqa: E731
    cycles_before = cycles()
    before, memory, begin = seconds_of(server.process), memory_of(server.process), time.monotonic()
    for thread in threads:
        thread.start()
    next_look = begin + 60
    while any(thread.is_alive() for thread in threads):
        threads[0].join(1)
        if time.monotonic() > next_look:
            next_look += 60
            print(f"  after {time.monotonic() - begin:.0f} s: memory {memory_of(server.process)} KiB, load {os.getloadavg()[0]:.1f}", flush=True)
    needed = time.monotonic() - begin
    ran, missed = (after - earlier for after, earlier in zip(cycles(), cycles_before))
    counter.close()
    print(f"cycles of 4 ms: {ran}, missed {missed} ({100 * missed / max(1, ran):.3f} %), load average {os.getloadavg()[0]:.1f}")
    print(f"requests: {len(times) / needed:.0f}/s, p50 {percentile(times, 0.5):.2f} ms, p99 {percentile(times, 0.99):.2f} ms, "
          f"longest {max(times) * 1000:.1f} ms; processor {(seconds_of(server.process) - before) / needed:.0%}, "
          f"memory {memory} -> {memory_of(server.process)} KiB; other than 200: {sorted(set(errors))[:5]}")


def throughput(server, seconds=3):
    """One client after the other, as fast as it goes (the limit of a session is below 500 requests/s: several of them)."""
    clients = [RwsClient(server.addresses["http"], 1) for _ in range(8)]
    for client in clients:
        client.get("/rw/panel/opmode")
    count, begin = 0, time.monotonic()
    while time.monotonic() - begin < seconds:
        if clients[count % 8].get("/rw/panel/opmode").status == 200:
            count += 1
    print(f"one request at a time: {count / (time.monotonic() - begin):.0f}/s")
    for client in clients:
        client.close()


def frames_of(data):
    """The texts in the bytes of a socket (frames of the server are not masked)."""
    at = 0
    while at + 2 <= len(data):
        size, head = data[at + 1] & 127, 2
        if size == 126:
            size, head = int.from_bytes(data[at + 2:at + 4], "big"), 4
        if at + head + size > len(data):
            return
        if data[at] & 15 == 1:
            yield data[at + head:at + head + size]
        at += head + size


def value_in(text):
    return float(text.split(b'class="lvalue">')[1].split(b"<")[0])


def events(server, seconds):
    """Ten clients subscribe to all signals with middle priority, which merges the changes of 200 ms: how many events each gets,
    whether they are in order, and whether the last value of each signal came."""
    clients = [RwsClient(server.addresses["http"], 1) for _ in range(10)]
    names = [f"/rw/iosystem/signals/s{i};state" for i in range(SIGNALS)]
    begin = time.monotonic()
    sockets = [client.open_events(client.subscribe(*names)) for client in clients]
    print(f"ten subscriptions to {SIGNALS} signals: {time.monotonic() - begin:.2f} s")
    received = [bytearray(sock.raw.rest) for sock in sockets]
    end = time.monotonic() + seconds

    def read(number):
        while time.monotonic() < end:
            received[number] += sockets[number].raw.socket.recv(1 << 20)
        stopped.wait()
        sockets[number].raw.socket.settimeout(1)  # five times what the last changes may take
        try:
            while more := sockets[number].raw.socket.recv(1 << 20):
                received[number] += more
        except TimeoutError:
            pass

    stopped = threading.Event()

    before, memory, start = seconds_of(server.process), memory_of(server.process), time.monotonic()
    threads = [threading.Thread(target=read, args=(i,)) for i in range(10)]
    for thread in threads:
        thread.start()
    time.sleep(end - time.monotonic())
    needed = time.monotonic() - start
    used = seconds_of(server.process) - before
    assert clients[0].post("/rw/rapid/execution?action=stop", {"stopmode": "stop"}).status in (200, 204)
    stopped.set()
    for thread in threads:
        thread.join()
    values = [value_in(clients[number % 10].get(f"/rw/iosystem/signals/s{number}").body) for number in range(SIGNALS)]
    counts, disorder, missing = [], 0, 0
    for data in received:
        last, count = {}, 0
        for text in frames_of(bytes(data)):
            name = text.split(b'" rel="self"')[0].rsplit(b'href="', 1)[1]
            value = value_in(text)
            disorder += value < last.get(name, 0)
            last[name] = value
            count += 1
        counts.append(count)
        missing += sum(last.get(f"/rw/iosystem/signals/s{i};state".encode()) != value for i, value in enumerate(values))
    print(f"signals: {max(values) / (time.monotonic() - begin):.0f} changes/s each, {missing} last values did not come")
    print(f"events: {sum(counts) / needed:.0f}/s in all, {min(counts)} to {max(counts)} for a client, {disorder} out of order; "
          f"processor {used / needed:.0%}, memory {memory} -> {memory_of(server.process)} KiB")


def serve(module, cfg, run, options=()):
    folder = tempfile.mkdtemp()
    try:
        for name, text in (("MainModule.modx", module), ("EIO.cfg", cfg)):
            if text:
                with open(os.path.join(folder, name), "w", encoding="ascii") as file:
                    file.write(text)
        server = Serve(folder, options=options)
        before, begin = seconds_of(server.process), time.monotonic()
        time.sleep(3)
        print(f"no clients: processor {(seconds_of(server.process) - before) / (time.monotonic() - begin):.0%}")
        run(server)
        server.stop()
    finally:
        shutil.rmtree(folder)


def main():
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 20
    serve(MODULE, None, lambda server: (requests(server, seconds), throughput(server)))
    serve(CHANGES, EIO, lambda server: events(server, min(seconds, 10)), ["--rate=unlimited"])


if __name__ == "__main__":
    main()
