"""A small client of the debug adapter protocol, and what its test sessions share.

A session is a Python file whose functions `test_...` are run one after the other, each with an adapter of its own (`main`). It
prints "ok NAME" for each; the first failure ends it with status 1.
"""

import json
import os
import queue
import subprocess
import sys
import threading
import traceback

TIMEOUT_S = float(os.environ.get("DAP_TIMEOUT", "30"))
HERE = os.path.dirname(os.path.abspath(__file__))


class Failed(Exception):
    """The adapter did something else than the protocol says."""


class Refused(Exception):
    """A response with success false."""


class Adapter:
    """A running `rapidc dap`."""

    def __init__(self):
        self.process = subprocess.Popen([os.environ.get("RAPIDC", "rapidc"), "dap"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE)
        self.messages = queue.Queue()
        self.seen = []  # every message, in order
        self.events = []  # those that nobody has taken yet
        self.answers = {}
        self.seq = 0
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self):
        out = self.process.stdout
        while True:
            length = None
            while True:
                line = out.readline()
                if not line:
                    self.messages.put(None)
                    return
                if line in (b"\r\n", b"\n"):
                    break
                name, _, value = line.decode("ascii").partition(":")
                if name.lower() == "content-length":
                    length = int(value)
            self.messages.put(json.loads(out.read(length)))

    def write(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, command, arguments=None, **fields):
        """Sends a request and returns its number."""
        self.seq += 1
        message = {"seq": self.seq, "type": "request", "command": command, **fields}
        if arguments is not None:
            message["arguments"] = arguments
        body = json.dumps(message).encode()
        self.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        return self.seq

    def _take(self):
        try:
            message = self.messages.get(timeout=TIMEOUT_S)
        except queue.Empty:
            raise Failed(f"nothing has come for {TIMEOUT_S} s; last: {self.seen[-3:]}") from None
        if message is None:
            raise Failed(f"the adapter has ended; last: {self.seen[-3:]}")
        self.seen.append(message)
        if message["type"] == "event":
            self.events.append(message)
        else:
            self.answers[message["request_seq"]] = message

    def answer(self, seq):
        """The body of the response to a request; Refused with its message when it failed."""
        while seq not in self.answers:
            self._take()
        message = self.answers.pop(seq)
        if not message["success"]:
            if not message.get("message"):
                raise Failed(f"a refusal without a message: {message}")
            raise Refused(message["message"])
        return message.get("body", {})

    def ask(self, command, **arguments):
        return self.answer(self.send(command, arguments or None))

    def refused(self, command, **arguments):
        """The message of a request that must fail."""
        try:
            body = self.ask(command, **arguments)
        except Refused as refusal:
            return str(refusal)
        raise Failed(f"{command} {arguments} succeeded: {body}")

    def event(self, name, **fields):
        """The body of the next event of that name (with these fields)."""
        while True:
            for i, message in enumerate(self.events):
                body = message.get("body", {})
                if message["event"] == name and all(body.get(k) == v for k, v in fields.items()):
                    del self.events[i]
                    return body
            self._take()

    def ended(self, wanted=0):
        """The process has ended by itself with that status."""
        status = self.process.wait(timeout=TIMEOUT_S)
        if status != wanted:
            raise Failed(f"exit status {status} instead of {wanted}: {self.process.stderr.read()}")

    # ---- What most sessions do

    def initialize(self, **arguments):
        return self.ask("initialize", adapterID="rapid", clientID="test", **arguments)

    def start(self, program, breakpoints=(), filters=None, initialize=None, **launch):
        """Launches a program; `breakpoints`: lines of it, or dictionaries. Returns the breakpoints."""
        self.initialize(**(initialize or {}))
        launched = self.send("launch", {"program": path(program), **launch})
        while not any(m["event"] == "initialized" for m in self.events):
            if launched in self.answers and not self.answers[launched]["success"]:
                self.answer(launched)
            self._take()
        self.event("initialized")
        result = []
        if breakpoints:
            result = self.set_lines(program, breakpoints)
        if filters is not None:
            self.ask("setExceptionBreakpoints", filters=filters)
        self.ask("configurationDone")
        self.answer(launched)
        return result

    def set_lines(self, program, breakpoints):
        lines = [b if isinstance(b, dict) else {"line": b} for b in breakpoints]
        return self.ask("setBreakpoints", source={"path": path(program)}, breakpoints=lines)["breakpoints"]

    def stopped(self, reason=None, line=None, routine=None):
        """Waits for a stop; returns the event with the top frame as "frame"."""
        body = self.event("stopped")
        if reason is not None:
            equal(body["reason"], reason, f"reason of {body}")
        frames = self.frames(body["threadId"])
        body["frame"] = frames[0] if frames else None
        if line is not None:
            equal(body["frame"]["line"], line, "line")
        if routine is not None:
            holds(routine.lower() in body["frame"]["name"].lower(), f"{routine} in {body['frame']['name']}")
        return body

    def frames(self, thread=1):
        return self.ask("stackTrace", threadId=thread)["stackFrames"]

    def top(self, thread=1):
        return self.frames(thread)[0]["id"]

    def scope(self, name, frame=None):
        """The variables of a scope by name."""
        scopes = self.ask("scopes", frameId=self.top() if frame is None else frame)["scopes"]
        reference = next(s["variablesReference"] for s in scopes if s["name"] == name)
        return {v["name"]: v for v in self.children(reference)}

    def children(self, reference, **arguments):
        return self.ask("variables", variablesReference=reference, **arguments)["variables"]

    def value(self, expression, context="watch", frame=True):
        arguments = {"frameId": self.top()} if frame is True else {} if frame is None else {"frameId": frame}
        return self.ask("evaluate", expression=expression, context=context, **arguments)["result"]

    def go(self, command="continue", thread=1, **arguments):
        return self.ask(command, threadId=thread, **arguments)

    def run_out(self, status=0):
        """Waits for the end of the program; the lines that it wrote."""
        equal(self.event("exited")["exitCode"], status, "exitCode")
        self.event("terminated")
        return self.lines()

    def lines(self, category="stdout"):
        outputs = [m["body"] for m in self.seen if m["type"] == "event" and m["event"] == "output"]
        text = "".join(o["output"] for o in outputs if o.get("category", "console") == category)
        return text.splitlines()

    def close(self):
        if self.process.poll() is None:
            self.ask("disconnect")
            self.ended()
        count = sum(1 for m in self.seen if m.get("event") == "terminated")
        holds(count <= 1, f"{count} events 'terminated'")


def path(name):
    return name if os.path.isabs(name) else os.path.join(HERE, name)


def equal(found, wanted, what="value"):
    if found != wanted:
        raise Failed(f"{what}: found {found!r}, expected {wanted!r}")


def holds(condition, what):
    if not condition:
        raise Failed(what)


def line_of(program, mark):
    """The line of a program that holds the text."""
    with open(path(program), encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            if mark in line:
                return number
    raise Failed(f"no line of {program} holds {mark!r}")


def main(namespace):
    """Runs the functions test_... of a session; names of some may be arguments."""
    wanted = sys.argv[1:]
    for name, test in list(namespace.items()):
        if not name.startswith("test_") or (wanted and name not in wanted):
            continue
        adapter = Adapter()
        try:
            test(adapter)
            adapter.close()
        except Exception:  # pylint: disable=broad-exception-caught
            print(f"FAILED {name}")
            traceback.print_exc(file=sys.stdout)
            adapter.process.kill()
            print(adapter.process.stderr.read().decode(errors="replace"))
            sys.exit(1)
        print("ok", name)
