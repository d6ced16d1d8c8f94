"""A client of the language server for tests: starts `rapidc lsp`, speaks the protocol, waits for answers.

A test is a case of unittest; `python3 tests/lsp/test_x.py` runs a file of them, with RAPIDC naming the executable (by default the
one of the build folder).
"""

import json
import os
import pathlib
import queue
import shutil
import subprocess
import tempfile
import threading
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
RAPIDC = os.environ.get("RAPIDC", str(ROOT / "build" / "rapidc"))
# An answer that takes longer hangs; generous, because other work may slow the machine down.
HANGS_AFTER_S = int(os.environ.get("LSP_TEST_PATIENCE", "60"))

CAPABILITIES = {
    "general": {"positionEncodings": ["utf-16"]},
    "textDocument": {
        "publishDiagnostics": {"relatedInformation": True, "versionSupport": True, "codeDescriptionSupport": True,
                               "tagSupport": {"valueSet": [1, 2]}},
        "completion": {"completionItem": {"snippetSupport": True, "documentationFormat": ["markdown", "plaintext"]}},
        "hover": {"contentFormat": ["markdown", "plaintext"]},
        "documentSymbol": {"hierarchicalDocumentSymbolSupport": True},
        "codeAction": {"codeActionLiteralSupport": {"codeActionKind": {"valueSet": ["quickfix", "refactor", "source"]}}},
        "rename": {"prepareSupport": True},
        "definition": {"linkSupport": False},
    },
    "workspace": {"workspaceEdit": {"documentChanges": True}, "workspaceFolders": True},
}


class ServerError(Exception):
    """The answer to a request is an error."""

    def __init__(self, error):
        super().__init__(error["message"])
        self.code = error["code"]


class Client:
    """One conversation. Requests of the server are answered by `answers`: method -> function of the parameters."""

    def __init__(self, arguments=(), environment=None):
        self.process = subprocess.Popen([RAPIDC, "lsp", *arguments], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        stderr=(None if os.environ.get("LSP_STDERR") else subprocess.PIPE), env={**os.environ, **(environment or {})})
        self.messages = queue.Queue()
        self.notifications = []
        self.answers = {}
        self.asked = []
        self.last_id = 0
        self.diagnostics = {}
        self.responses = {}
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        stream = self.process.stdout
        while True:
            length = None
            while (line := stream.readline()).strip():
                name, _, value = line.decode().partition(":")
                if name.lower() == "content-length":
                    length = int(value)
            if length is None:
                self.messages.put(None)
                return
            self.messages.put(json.loads(stream.read(length).decode("utf-8")))

    def send_bytes(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send_body(self, body):
        if isinstance(body, str):
            body = body.encode("utf-8")
        self.send_bytes(b"Content-Length: %d\r\n\r\n" % len(body) + body)

    def send(self, message):
        self.send_body(json.dumps({"jsonrpc": "2.0", **message}))

    def notify(self, method, params=None):
        self.send({"method": method, "params": {} if params is None else params})

    def start(self, method, params=None):
        """Sends a request; its id."""
        self.last_id += 1
        self.send({"id": self.last_id, "method": method, **({} if params is None else {"params": params})})
        return self.last_id

    def take(self):
        """The next message, after what has to be done with it. None at the end."""
        message = self.messages.get(timeout=HANGS_AFTER_S)
        if message is None:
            return None
        if "method" in message and "id" in message:
            self.asked.append(message)
            answer = self.answers.get(message["method"], lambda params: None)(message.get("params"))
            self.send({"id": message["id"], "result": answer})
        elif "method" in message:
            self.notifications.append(message)
            if message["method"] == "textDocument/publishDiagnostics":
                self.diagnostics[message["params"]["uri"]] = message["params"]
        else:
            self.responses[message["id"]] = message
        return message

    def response(self, number):
        """The whole answer to a request."""
        while number not in self.responses:
            if self.take() is None:
                raise AssertionError(f"the server ended: {self.process.stderr.read().decode(errors='replace')}")
        return self.responses.pop(number)

    def request(self, method, params=None):
        answer = self.response(self.start(method, params))
        if "error" in answer:
            raise ServerError(answer["error"])
        return answer["result"]

    def initialize(self, folders=(), capabilities=None, **more):
        result = self.request("initialize", {
            "processId": os.getpid(), "rootUri": None, "capabilities": CAPABILITIES if capabilities is None else capabilities,
            "workspaceFolders": [{"uri": uri(f), "name": os.path.basename(f)} for f in folders] or None, **more})
        self.notify("initialized")
        return result

    def open(self, path, text, version=1, language="rapid"):
        name = path if ":" in str(path) else uri(path)
        self.notify("textDocument/didOpen", {"textDocument": {"uri": name, "languageId": language, "version": version,
                                                              "text": text}})
        return name

    def change(self, document, version, *changes):
        """Changes: a whole text, or (start, end, text) with positions (line, character)."""
        self.notify("textDocument/didChange", {
            "textDocument": {"uri": document, "version": version},
            "contentChanges": [{"text": c} if isinstance(c, str) else
                               {"range": span(c[0], c[1]), "text": c[2]} for c in changes]})

    def close(self, document):
        self.notify("textDocument/didClose", {"textDocument": {"uri": document}})

    def published(self, document, version=None):
        """Waits until diagnostics of that version have come (of any when None and none came yet)."""
        while document not in self.diagnostics or (version is not None
                                                   and self.diagnostics[document].get("version") != version):
            if self.take() is None:
                raise AssertionError("the server ended")
        return self.diagnostics[document]["diagnostics"]

    def next_published(self, document):
        """The next diagnostics for a document, whatever came before."""
        self.diagnostics.pop(document, None)
        return self.published(document)

    def settle(self):
        """Everything that was sent is done, and what follows from it was said: the server works in order and publishes only when
        nothing waits, so that a request after the publication shows both."""
        self.request("workspace/symbol", {"query": "there is no such name"})

    def stop(self):
        """Shutdown and exit; the exit status."""
        self.request("shutdown")
        self.notify("exit")
        return self.wait()

    def wait(self):
        status = self.process.wait(timeout=HANGS_AFTER_S)
        for stream in filter(None, (self.process.stdin, self.process.stdout, self.process.stderr)):
            try:
                stream.close()
            except BrokenPipeError:
                pass
        return status

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
        self.wait()


def uri(path):
    return pathlib.Path(path).as_uri()


def span(start, end):
    return {"start": {"line": start[0], "character": start[1]}, "end": {"line": end[0], "character": end[1]}}


def place(text, word, nth=1, offset=0):
    """Line and character (ASCII texts) of the nth occurrence of a word."""
    at = -1
    for _ in range(nth):
        at = text.index(word, at + 1)
    at += offset
    before = text[:at]
    return {"line": before.count("\n"), "character": at - (before.rfind("\n") + 1)}


def at(document, text, word, nth=1, offset=0):
    """TextDocumentPositionParams."""
    return {"textDocument": {"uri": document}, "position": place(text, word, nth, offset)}


def part(text, where):
    """The text of a range (ASCII texts)."""
    lines = text.split("\n")
    start, end = where["start"], where["end"]
    if start["line"] == end["line"]:
        return lines[start["line"]][start["character"]:end["character"]]
    return "\n".join([lines[start["line"]][start["character"]:], *lines[start["line"] + 1:end["line"]],
                      lines[end["line"]][:end["character"]]])


def edited(text, edits):
    """A text after TextEdits (ASCII texts)."""
    lines = text.split("\n")
    starts = [0]
    for line in lines:
        starts.append(starts[-1] + len(line) + 1)

    def offset(position):
        if position["line"] >= len(lines):
            return len(text)
        return starts[position["line"]] + min(position["character"], len(lines[position["line"]]))

    for edit in sorted(edits, key=lambda e: offset(e["range"]["start"]), reverse=True):
        begin, end = offset(edit["range"]["start"]), offset(edit["range"]["end"])
        text = text[:begin] + edit["newText"] + text[end:]
    return text


def changes_of(edit):
    """The TextEdits of a WorkspaceEdit by URI."""
    if "documentChanges" in edit:
        return {c["textDocument"]["uri"]: c["edits"] for c in edit["documentChanges"]}
    return edit["changes"]


class LspCase(unittest.TestCase):
    """A case with a folder of its own and any number of clients."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="rapidc-lsp-")
        self.addCleanup(shutil.rmtree, self.folder, True)
        self.cache = os.path.join(self.folder, "cache")

    def connect(self, *arguments):
        client = Client(arguments, {"XDG_CACHE_HOME": self.cache, "RAPIDC_CACHE": ""})
        self.addCleanup(client.end)
        return client

    def write(self, name, text, encoding="utf-8"):
        path = os.path.join(self.folder, "work", name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding=encoding, newline="") as file:
            file.write(text)
        return path

    def work(self):
        os.makedirs(os.path.join(self.folder, "work"), exist_ok=True)
        return os.path.join(self.folder, "work")

    def opened(self, text, name="m.modx", folders=True):
        """A client with one module open in a folder; the client and the URI."""
        path = self.write(name, text)
        client = self.connect()
        client.initialize([self.work()] if folders else [])
        return client, client.open(path, text)

    def check(self, *arguments):
        """What `rapidc check --format=json` says."""
        done = subprocess.run([RAPIDC, "check", "--format=json", *arguments], capture_output=True, text=True, check=False)
        return json.loads(done.stdout)

    def codes(self, diagnostics):
        return sorted(d["code"] for d in diagnostics)
