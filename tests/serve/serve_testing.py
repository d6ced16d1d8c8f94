"""Starts `rapidc serve` for protocol tests, and clients for it: both dialects, raw sockets, WebSockets.

    class Panel(ServeCase):
        MODULE = "MODULE m\\n PROC main()\\n  WaitTime 1;\\n ENDPROC\\nENDMODULE\\n"
        def test_mode(self):
            for client in self.both():
                self.assertEqual(client.get("/rw/panel/opmode").values()["opmode"], "AUTO")

Nothing but the standard library; all on the loopback interface.
"""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import urllib.parse

from rws_client import RawClient, RwsClient, SocketClient  # noqa: F401  (for the tests)

RAPIDC = os.environ.get("RAPIDC") or os.path.join(os.path.dirname(__file__), "..", "..", "build", "rapidc")
SLOW = float(os.environ.get("RAPIDC_TEST_SLOWNESS", "1"))  # of sanitizers and busy machines
IDLE_MODULE = """MODULE MainModule
  PERS num count := 0;
  PROC main()
    WHILE TRUE DO
      WaitTime 0.1;
      count := count + 1;
    ENDWHILE
  ENDPROC
ENDMODULE
"""


class Serve:
    """One `rapidc serve` process on free ports."""

    def __init__(self, *inputs, options=(), wait=True):
        self.errors = tempfile.TemporaryFile()
        if folder := os.environ.get("RAPIDC_ERRORS"):  # scripts/check_error_tests.py wants to see which errors are raised
            options = (*options, f"--errors={folder}/{os.getpid()}-{id(self)}.csv")
        environment = dict(os.environ, XDG_STATE_HOME=os.path.join(tempfile.gettempdir(), "rapidc-serve-test-state"))
        self.process = subprocess.Popen([RAPIDC, "serve", *inputs, *options], stdout=subprocess.PIPE, stderr=self.errors,
                                        env=environment)
        self.addresses = {}
        if wait:
            self.wait_ready()

    def wait_ready(self, seconds=20 * SLOW):
        """Reads the line with the addresses."""
        timer = threading.Timer(seconds, self.process.kill)
        timer.start()
        line = self.process.stdout.readline()
        timer.cancel()
        if not line:
            raise AssertionError(f"rapidc serve did not begin: {self.stderr_text()}")
        self.addresses = json.loads(line)

    def stderr_text(self):
        self.errors.seek(0)
        return self.errors.read().decode("utf-8", "replace")

    def port(self, kind="http"):
        return urllib.parse.urlsplit(self.addresses[kind]).port

    def client(self, dialect=1, **options):
        return RwsClient(self.addresses["http" if dialect == 1 else "https"], dialect, **options)

    def raw(self, kind="http"):
        return RawClient(self.port(kind), secure=kind == "https")

    def stop(self, sent=signal.SIGTERM, seconds=2 * SLOW + 8):
        """Ends the process; its exit status (negative: it was killed by a signal)."""
        if self.process.poll() is None:
            self.process.send_signal(sent)
        try:
            status = self.process.wait(seconds)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            raise AssertionError("rapidc serve did not end after the signal") from None
        finally:
            self.process.stdout.close()
        return status


class ServeCase(unittest.TestCase):
    """A test class with a server of its own."""

    MODULE = IDLE_MODULE  # of the task; None: FILES say it all
    FILES = {}            # further input files: name -> text
    OPTIONS = ()

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="rapidc-serve-test-")
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.home = os.path.join(cls.folder, "home")
        inputs = os.path.join(cls.folder, "inputs")
        os.makedirs(cls.home)
        os.makedirs(inputs)
        files = dict(cls.FILES)
        if cls.MODULE is not None:
            files["MainModule.modx"] = cls.MODULE
        for name, text in files.items():
            with open(os.path.join(inputs, name), "w", encoding="utf-8") as file:
                file.write(text)
        cls.server = Serve(inputs, options=(f"--home={cls.home}", *cls.OPTIONS))
        cls.addClassCleanup(cls._end)

    @classmethod
    def _end(cls):
        alive = cls.server.process.poll() is None
        status = cls.server.stop()
        if not alive:
            raise AssertionError(f"rapidc serve ended by itself with {status}: {cls.server.stderr_text()}")
        cls.server.errors.close()

    def client(self, dialect=1, **options):
        """A client that is logged off and closed after the test."""
        client = self.server.client(dialect, **options)
        self.addCleanup(client.close)
        return client

    def both(self, **options):
        """A client of each dialect, for what both have in common."""
        return [self.client(dialect, **options) for dialect in (1, 2)]

    def socket(self, client, response, **options):
        """The event socket of a subscription."""
        socket = client.open_events(response, **options)
        self.addCleanup(socket.close)
        return socket

    def eventually(self, condition, seconds=5, message="it did not happen"):
        """Asks again and again until the condition holds; its value."""
        end = time.monotonic() + seconds * SLOW
        while True:
            value = condition()
            if value:
                return value
            if time.monotonic() > end:
                self.fail(message)
            time.sleep(0.02)


def main():
    unittest.main(argv=sys.argv, verbosity=1)
