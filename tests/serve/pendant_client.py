"""The web page's side of the pendant's WebSocket (docs/pendant.md), for tests."""

import json
import time

from rws_client import SocketClient


class PendantError(Exception):
    """The error of an answer."""

    def __init__(self, error):
        super().__init__(f"{error['code']}: {error['message']}")
        self.code = error["code"]
        self.message = error["message"]
        self.remedy = error.get("remedy", "")


class Pendant:
    """A page that is connected. `call` answers the result of a method; notifications that came meanwhile are kept."""

    def __init__(self, port, hello=True, headers=None, path="/api"):
        self.socket = SocketClient(port, path, None, headers or {})
        self.status = self.socket.status
        self.last = 0
        self.events = []   # (name, data), in order
        self.answers = {}  # id -> message
        if hello and self.status == 101:
            self.greeting = self.call("hello")

    def send(self, method, params=None):
        """Sends a request; its id."""
        self.last += 1
        self.socket.send_frame(1, json.dumps({"id": self.last, "method": method, "params": params or {}}))
        return self.last

    def take(self, seconds=10):
        """Reads one message; a dict, or None when the socket has been closed."""
        text = self.socket.text(seconds)
        if text is None:
            return None
        message = json.loads(text)
        if "event" in message:
            self.events.append((message["event"], message["data"]))
        else:
            self.answers[message["id"]] = message
        return message

    def answer(self, number, seconds=10):
        """The result of the request with that id; raises PendantError."""
        end = time.monotonic() + seconds
        while number not in self.answers:
            if self.take(max(0.001, end - time.monotonic())) is None:
                raise AssertionError(f"the socket has ended ({self.socket.close_code})")
        message = self.answers.pop(number)
        if "error" in message:
            raise PendantError(message["error"])
        return message["result"]

    def call(self, method, params=None, **more):
        return self.answer(self.send(method, {**(params or {}), **more}))

    def wait(self, name, condition=lambda data: True, seconds=10):
        """The data of the next notification of that name for which the condition holds; those before it are dropped."""
        end = time.monotonic() + seconds
        while True:
            while self.events:
                event, data = self.events.pop(0)
                if event == name and condition(data):
                    return data
            if self.take(max(0.001, end - time.monotonic())) is None:
                raise AssertionError(f"the socket has ended ({self.socket.close_code})")

    def gather(self, name, seconds):
        """The data of all notifications of that name that come in that time."""
        end = time.monotonic() + seconds
        try:
            while time.monotonic() < end:
                if self.take(max(0.001, end - time.monotonic())) is None:
                    break
        except TimeoutError:
            pass
        found = [data for event, data in self.events if event == name]
        self.events = []
        return found

    def close(self):
        self.socket.close()
