"""Waiting times of an editor: answers of `rapidc lsp` in a module of 10,000 lines, alone and among half a million lines."""

import json
import os
import shutil
import statistics
import subprocess
import time

import generate_project

GOAL_EDIT_MS, GOAL_COMPLETION_MS, GOAL_INITIALIZE_S, GOAL_JUDGED_S, GOAL_MB = 50, 30, 3, 5, 1024


class Server:
    """As few words of the protocol as the measurements need; nothing is kept, as a client would wait."""

    def __init__(self, rapidc):
        self.process = subprocess.Popen([rapidc, "lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.number = 0

    def send(self, method, params, number=None):
        body = json.dumps({"jsonrpc": "2.0", "method": method, "params": params, **({"id": number} if number else {})}).encode()
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
        self.process.stdin.flush()

    def take(self):
        length = 0
        while (line := self.process.stdout.readline()).strip():
            if line.lower().startswith(b"content-length"):
                length = int(line.split(b":")[1])
        return json.loads(self.process.stdout.read(length))

    def request(self, method, params):
        self.number += 1
        self.send(method, params, self.number)
        while (message := self.take()).get("id") != self.number:
            pass
        return message["result"]

    def published(self, uri, version):
        while True:
            message = self.take()
            params = message.get("params", {})
            if message.get("method") == "textDocument/publishDiagnostics" and params["uri"] == uri and params.get("version") == version:
                return

    def peak_mb(self):
        with open(f"/proc/{self.process.pid}/status", encoding="utf-8") as status:
            return next(int(line.split()[1]) for line in status if line.startswith("VmHWM")) / 1024

    def end(self):
        self.request("shutdown", None)
        self.send("exit", None)
        self.process.wait()


def seconds(work):
    start = time.monotonic()
    work()
    return time.monotonic() - start


def measure(rapidc, folder, path):
    server = Server(rapidc)
    with open(path, encoding="utf-8") as file:
        text = file.read()
    uri = "file://" + path
    start = time.monotonic()
    server.request("initialize", {"capabilities": {}, "workspaceFolders": [{"uri": "file://" + folder, "name": "bench"}]})
    initialized = time.monotonic() - start
    server.send("initialized", {})
    server.send("textDocument/didOpen", {"textDocument": {"uri": uri, "languageId": "rapid", "version": 1, "text": text}})
    server.published(uri, 1)
    judged = time.monotonic() - start
    places = [i for i, line in enumerate(text.split("\n")) if "Move" in line]
    version, edits, completions = 1, [], []

    def change(line, end, new):
        nonlocal version
        version += 1
        server.send("textDocument/didChange", {
            "textDocument": {"uri": uri, "version": version},
            "contentChanges": [{"range": {"start": {"line": line, "character": 0}, "end": {"line": line, "character": end}},
                                "text": new}]})

    for i in range(40):
        def edit(line=places[i * 37 % len(places)]):
            change(line, 0, '    TPWrite "edited";\n')
            server.published(uri, version)
        edits.append(seconds(edit))
    for i in range(10):
        for word in ("    Mo", "    MoveL ", "    MoveL p10, v"):
            line = places[i * 37 % len(places)]
            change(line, 0, word)
            where = {"textDocument": {"uri": uri}, "position": {"line": line, "character": len(word)}}
            completions.append(seconds(lambda where=where: server.request("textDocument/completion", where)))
            change(line, len(word), "")
    memory = server.peak_mb()
    server.end()
    return initialized, judged, statistics.median(edits) * 1e3, statistics.median(completions) * 1e3, memory


def run(rapidc, work):
    print(f"language server: a module of 10,000 lines (goals: edit to diagnostics {GOAL_EDIT_MS} ms, completion {GOAL_COMPLETION_MS} "
          f"ms, initialize {GOAL_INITIALIZE_S} s, open file judged {GOAL_JUDGED_S} s, {GOAL_MB} MB)\n")
    print(f"{'among lines':>12} {'initialize s':>13} {'judged s':>9} {'edit ms':>8} {'completion ms':>14} {'MB':>6}")
    fine = True
    for lines in (0, 500_000):
        folder = os.path.join(work, f"lsp_{lines}")
        shutil.rmtree(folder, ignore_errors=True)
        os.makedirs(folder)
        if lines:
            generate_project.generate(folder, lines, "mixed")
        rapid = os.path.join(folder, "rapid")
        os.makedirs(rapid, exist_ok=True)
        path = os.path.join(rapid, "large.modx")
        generate_project.write_large_module(path, "code")
        initialized, judged, edit, completion, memory = measure(rapidc, rapid, path)
        print(f"{lines + 10_000:12,} {initialized:13.3f} {judged:9.3f} {edit:8.1f} {completion:14.1f} {memory:6.0f}", flush=True)
        fine = (fine and initialized <= GOAL_INITIALIZE_S and judged <= GOAL_JUDGED_S and edit <= GOAL_EDIT_MS
                and completion <= GOAL_COMPLETION_MS and memory <= GOAL_MB)
    print(f"\ngoals: {'met' if fine else 'NOT MET'}")
