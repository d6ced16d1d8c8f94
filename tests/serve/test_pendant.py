"""The web page's port: files, security, and the WebSocket protocol of docs/pendant.md. "N" = line N of the serve contract."""

import contextlib

from pendant_client import Pendant, PendantError
from serve_testing import ServeCase, main

MODULE = """MODULE MainModule
  PERS tooldata tGripper := [TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
  PERS robtarget pHere := [[400,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget jHome := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget jAway := [[60,10,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PERS num count := 0;
  PERS num table{3} := [1,2,3];
  CONST num limit := 7;
  VAR string note := "none";
  PROC main()
    count := count + 1;
    MoveAbsJ jHome, v1000, fine, tool0;
    MoveAbsJ jAway, v1000, fine, tool0;
    helper count;
  ENDPROC
  PROC helper(num value)
    note := ValToStr(value);
    TPWrite note;
  ENDPROC
  PROC ask()
    VAR num answer;
    TPReadFK answer, "Continue?", "Yes", "", "No", "", "";
    count := answer;
  ENDPROC
  PROC teach()
    MoveJ pHere, v1000, fine, tool0;
  ENDPROC
ENDMODULE
"""
EIO = """EIO:CFG_1.0:5:0::
EIO_SIGNAL:
  -Name "doLamp" -SignalType "DO"
  -Name "diSensor" -SignalType "DI" -Label "a sensor"
  -Name "goStep" -SignalType "GO" -DeviceMap "0-3"
  -Name "doFixed" -SignalType "DO" -Access "ReadOnly"
"""
TASK = {"task": "T_ROB1"}
MAIN = {"task": "T_ROB1", "module": "MainModule"}


def line_of(text):
    return 1 + next(i for i, line in enumerate(MODULE.splitlines()) if text in line)


class PendantCase(ServeCase):
    MODULE = MODULE
    FILES = {"EIO.cfg": EIO}
    OPTIONS = ("--no-program-start",)

    def setUp(self):
        self.page = self.connect()
        self.page.call("panel.emergencyStop", pressed=False)
        self.page.call("run.stop")
        self.eventually(lambda: not self.panel()["running"])
        self.page.call("breakpoints.clear")
        self.page.call("run.pointerToMain")
        self.page.call("panel.mode", mode="auto")
        self.page.call("panel.motors", on=True)

    def connect(self, **options):
        page = Pendant(self.server.port("web"), **options)
        self.addCleanup(page.close)
        return page

    def panel(self):
        return self.page.call("state")["panel"]

    def task(self):
        return self.page.call("state")["tasks"][0]

    def refused(self, code, method, params=None, **more):
        """The error of a request that must be refused with that code."""
        with self.assertRaises(PendantError) as caught:
            self.page.call(method, params, **more)
        self.assertEqual(caught.exception.code, code, str(caught.exception))
        return caught.exception

    def value(self, name):
        return self.page.call("data.read", paths=[f"T_ROB1/MainModule/{name}"])["values"][0]["value"]


class Files(PendantCase):
    def get(self, path="/", host=None, headers="", method="GET"):
        raw = self.server.raw("web")
        self.addCleanup(raw.close)
        port = self.server.port("web")
        raw.send(f"{method} {path} HTTP/1.1\r\nHost: {host or f'127.0.0.1:{port}'}\r\n{headers}\r\n")
        return raw.read()

    def test_page(self):  # 10
        response = self.get()
        self.assertEqual(response.status, 200)
        self.assertTrue(response.header("content-type").startswith("text/html"))
        policy = response.header("content-security-policy")
        self.assertTrue("default-src" in policy or "script-src" in policy)
        for forbidden in ("unsafe-eval", "unsafe-inline", "*", "http:", "https:", "//"):
            self.assertNotIn(forbidden, policy)
        self.assertIn("frame-ancestors 'none'", policy)
        self.assertEqual(response.header("x-content-type-options"), "nosniff")

    def test_every_answer_is_secured(self):  # 10: also errors are pages of this origin
        for path, status in (("/", 200), ("/nothing", 404), ("/../etc/passwd", 404), ("/api", 426)):
            response = self.get(path)
            self.assertEqual(response.status, status, path)
            self.assertIn("default-src 'none'", response.header("content-security-policy"))

    def test_no_other_host(self):  # 10
        body = self.get().body
        text = body if isinstance(body, str) else body.decode()
        self.assertNotIn("http://", text)
        self.assertNotIn("https://", text)

    def test_names_of_the_server(self):  # 17: a name that somebody else owns is not the server's
        port = self.server.port("web")
        for host in (f"127.0.0.1:{port}", f"localhost:{port}", f"[::1]:{port}"):
            self.assertEqual(self.get(host=host).status, 200, host)
        for host in (f"evil.example:{port}", "127.0.0.1:1", "evil.example", f"127.0.0.1.evil.example:{port}", f"10.0.0.1:{port}"):
            self.assertEqual(self.get(host=host).status, 403, host)

    def test_other_origins(self):  # 17
        port = self.server.port("web")
        for origin in ("http://evil.example", "null", f"http://127.0.0.1:{port + 1}", f"https://127.0.0.1:{port}"):
            page = Pendant(port, hello=False, headers={"Origin": origin})
            self.assertEqual(page.status, 403, origin)
            page.close()
        page = Pendant(port, headers={"Origin": f"http://127.0.0.1:{port}"})
        self.assertEqual(page.status, 101)
        page.close()

    def test_methods(self):
        for method in ("POST", "PUT", "DELETE", "OPTIONS"):
            self.assertEqual(self.get(method=method, headers="Content-Length: 0\r\n").status, 405, method)


class Messages(PendantCase):
    """Messages: what is malformed is answered, and nothing else happens."""

    def raw_answer(self, text):
        self.page.socket.send_frame(1, text)
        while True:
            message = self.page.take()
            if "event" not in message:
                return message

    def test_malformed(self):
        for text in ("", "{", "[]", "1", '"x"', '{"id":-1,"method":"state"}', '{"method":"state"}', '{"id":1.5,"method":"state"}',
                     "[" * 100_000, '{"id":' + "9" * 400 + "}", "\x00"):
            answer = self.raw_answer(text)
            self.assertIsNone(answer["id"], text[:40])
            self.assertEqual(answer["error"]["code"], "bad_request")
        for rest in ('', ',"method":1', ',"method":"state","params":[]', ',"method":"state","params":"x"'):
            answer = self.raw_answer('{"id":5' + rest + "}")
            self.assertEqual((answer["id"], answer["error"]["code"]), (5, "bad_request"), rest)
        self.assertIn("panel", self.page.call("state"))

    def test_unknown_method(self):
        self.refused("unknown_method", "panel.explode")

    def test_parameters(self):
        for method, params in (("panel.speed", {}), ("panel.speed", {"percent": 101}), ("panel.speed", {"percent": "50"}),
                               ("panel.speed", {"percent": 1.5}), ("panel.mode", {"mode": "AUTO"}), ("panel.motors", {"on": 1}),
                               ("run.start", {"mode": "backwards"}), ("time.set", {"pace": -1}), ("data.read", {"paths": "x"}),
                               ("signals.list", {"count": 0}), ("modules.text", {"task": "T_ROB1", "module": "a\u0000b"})):
            error = self.refused("bad_request", method, params)
            self.assertTrue(error.message)
            self.assertFalse(error.message.endswith("."))

    def test_hello_first(self):
        page = self.connect(hello=False)
        with self.assertRaises(PendantError) as caught:
            page.call("state")
        self.assertEqual(caught.exception.code, "login")
        self.assertEqual(page.call("hello")["version"], 1)
        self.assertIn("units", page.call("state"))

    def test_binary_closes(self):
        self.page.socket.send_frame(2, b"\x01\x02")
        self.assertIsNone(self.page.take())
        self.assertEqual(self.page.socket.close_code, 1002)

    def test_too_large_message_closes(self):
        with contextlib.suppress(ConnectionError):  # it may end before all has been sent
            self.page.socket.send_frame(1, "x" * (1024 * 1024 + 1))
        with contextlib.suppress(ConnectionError):
            while self.page.take() is not None:
                pass
        self.assertEqual(self.connect().status, 101)

    def test_many_requests(self):  # Messages: busy
        numbers = [self.page.send("state") for _ in range(500)]
        results = []
        for number in numbers:
            try:
                results.append("panel" in self.page.answer(number))
            except PendantError as error:
                self.assertEqual(error.code, "busy")
        self.assertGreaterEqual(len(results), 64)
        self.assertIn("panel", self.page.call("state"))

    def test_many_pages(self):
        pages = [self.connect(hello=False) for _ in range(40)]
        states = [page.status for page in pages]
        self.assertIn(503, states)
        self.assertGreaterEqual(states.count(101), 20)
        for page in pages:
            page.close()
        self.eventually(lambda: self.connect(hello=False).status == 101)


class Panel(PendantCase):
    def test_state(self):
        state = self.page.call("state")
        self.assertEqual(state["panel"], {"motors": "on", "mode": "auto", "speed": 100, "cycle": "forever", "running": False,
                                          "emergencyStop": False})
        task = state["tasks"][0]
        self.assertEqual((task["name"], task["type"], task["unit"], task["active"]), ("T_ROB1", "normal", "ROB_1", True))
        self.assertEqual(len(state["units"][0]["joints"]), 6)
        self.assertEqual(state["time"]["pace"], 100)

    def test_changes_reach_other_pages(self):
        other = self.connect()
        self.page.call("panel.speed", percent=40)
        self.assertEqual(other.wait("panel", lambda panel: panel["speed"] == 40)["speed"], 40)
        self.page.call("panel.speed", percent=100)
        other.wait("panel", lambda panel: panel["speed"] == 100)

    def test_mode_switches_motors_off(self):  # controller.md 2.2: the motors go off when the mode changes
        self.page.call("panel.mode", mode="manual")
        panel = self.page.wait("panel", lambda panel: panel["mode"] == "manual" and panel["motors"] == "off")
        self.assertFalse(panel["running"])

    def test_emergency_stop(self):
        self.page.call("run.start")
        self.page.call("panel.emergencyStop", pressed=True)
        self.page.wait("panel", lambda panel: panel["emergencyStop"] and not panel["running"])
        self.assertIn("elease", self.refused("refused", "panel.motors", on=True).remedy)
        self.page.call("panel.emergencyStop", pressed=False)
        self.page.call("panel.motors", on=True)
        self.page.wait("panel", lambda panel: panel["motors"] == "on")

    def test_motors_off_refuses_start(self):
        self.page.call("panel.motors", on=False)
        error = self.refused("refused", "run.start")
        self.assertIn("motors", error.message)
        self.assertTrue(error.remedy)

    def test_virtual_time(self):
        self.page.call("time.set", running=False)
        first = self.page.call("state")["time"]["t"]
        self.assertFalse(self.page.wait("time")["running"])
        self.assertEqual(self.page.call("state")["time"]["t"], first)
        self.page.call("time.set", running=True, pace=1000)
        self.eventually(lambda: self.page.call("state")["time"]["t"] > first)
        self.page.call("time.set", pace=100)


if __name__ == "__main__":
    main()
