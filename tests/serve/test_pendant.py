"""The web page's port: files, security, and the WebSocket protocol of docs/pendant.md. "N" = line N of the serve contract."""

import contextlib
import time
import urllib.parse

from pendant_client import Pendant, PendantError
from serve_testing import SLOW, Serve, ServeCase, main

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
  VAR listitem parts{3} := [["", "Cover"], ["", "Shaft"], ["", ""]];
  PROC enter()
    count := UINumEntry(\\Header:="Parts" \\InitValue:=12 \\MinValue:=1 \\MaxValue:=40 \\AsInteger);
    TPWrite UIAlphaEntry(\\Header:="Batch" \\InitString:="B-1");
    count := UIListView(\\Header:="Part", parts \\Buttons:=btnOK \\DefaultIndex:=2);
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

    def restart(self, method, **params):
        """A request that restarts the controller: it is answered, then all sockets end (decision 132), and the page connects again."""
        others = [self.page, self.connect()]
        self.page.call(method, **params)
        for page in others:
            while page.take() is not None:
                pass
            self.assertEqual(page.socket.close_code, 1012)
        self.page = self.connect()

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

    def test_names_of_the_server(self):  # 17: a name of another owner is not the server's
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


class Load(PendantCase):
    def test_reader_that_does_not_read(self):  # 45: it costs others nothing, and its queue is bounded
        slow = self.connect()
        slow.socket.raw.socket.settimeout(20)
        frames = 0
        with contextlib.suppress(ConnectionError, TimeoutError):
            for frames in range(30_000):
                slow.send("state")
                if frames % 1000 == 0:
                    begun = time.monotonic()
                    self.assertIn("panel", self.page.call("state"))
                    self.assertLess(time.monotonic() - begun, 2)
        self.assertLess(self.memory(), 400 * 1024)  # kB: 30,000 answers alone would be more than 100 MB on top
        self.assertIn("panel", self.page.call("state"))
        with contextlib.suppress(ConnectionError, TimeoutError):
            while slow.take() is not None:  # what was sent before the socket was cut off
                pass

    def memory(self):
        """Resident memory of the server, kB."""
        with open(f"/proc/{self.server.process.pid}/status", encoding="ascii") as status:
            return next(int(line.split()[1]) for line in status if line.startswith("VmRSS"))

    def test_ends_while_pages_listen(self):  # 3
        self.page.call("signals.subscribe", all=True)
        self.page.call("run.start")
        self.page.wait("motion")
        status = self.server.stop(seconds=2 * SLOW)
        self.assertEqual(status, 143)
        self.server.errors.close()
        type(self).server = Serve(f"{self.folder}/inputs", options=(f"--home={self.home}", *self.OPTIONS))


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


class Execution(PendantCase):
    def test_runs_and_stops(self):
        self.page.call("run.start")
        self.page.wait("panel", lambda panel: panel["running"])
        self.page.wait("task", lambda task: task["state"] == "running")
        self.assertEqual(self.refused("refused", "run.start").message, "The program is executing already")
        self.page.call("run.stop")
        self.page.wait("panel", lambda panel: not panel["running"])

    def test_steps(self):  # manual 1.21: a step over a call executes all of it
        self.page.call("run.start", mode="stepIn")
        self.eventually(lambda: (self.task()["pointer"] or {}).get("line") == line_of("MoveAbsJ jHome"))
        self.page.call("run.pointerToLine", {**MAIN, "line": line_of("helper count")})
        self.eventually(lambda: (self.task()["pointer"] or {}).get("line") == line_of("helper count"))
        self.page.call("run.start", mode="stepIn")
        self.eventually(lambda: self.task()["pointer"]["routine"] == "helper")
        self.assertEqual(self.task()["pointer"]["line"], line_of("note := ValToStr"))
        self.page.call("run.start", mode="stepOut")
        self.eventually(lambda: self.task()["state"] != "running" and (self.task()["pointer"] or {}).get("routine") != "helper")

    def test_start_at_once_begins_at_the_line(self):  # docs/pendant.md: a start right after run.pointerToLine begins there
        for line in ("jAway, v1000", "helper count") * 5:
            self.page.send("run.pointerToLine", {**MAIN, "line": line_of(line)})
            self.page.call("run.start", mode="stepIn")
            expected = line_of("helper count" if "jAway" in line else "note := ValToStr")
            self.eventually(lambda: (self.task()["pointer"] or {}).get("line") == expected and not self.panel()["running"])

    def test_orders_for_the_pointer_one_after_the_other(self):  # docs/pendant.md: the last one counts, none is refused
        for _ in range(5):
            self.page.call("run.pointerToLine", {**MAIN, "line": line_of("TPReadFK answer")})
            self.page.call("run.pointerToRoutine", {**MAIN, "routine": "ask"})
            self.page.call("run.pointerToLine", {**MAIN, "line": line_of("helper count")})
            self.page.call("run.pointerToMain")
            self.page.call("run.start", mode="stepIn")
            self.eventually(lambda: (self.task()["pointer"] or {}).get("line") == line_of("MoveAbsJ jHome"))

    def test_pointer_to_routine(self):
        self.page.call("run.pointerToRoutine", {**MAIN, "routine": "ask"})
        self.page.call("run.start", mode="stepIn")
        self.eventually(lambda: (self.task()["pointer"] or {}).get("routine") == "ask")
        self.refused("refused", "run.pointerToRoutine", {**MAIN, "routine": "nothing"})
        self.refused("not_found", "run.pointerToLine", {"task": "T_ROB1", "module": "None", "line": 1})
        self.refused("not_found", "run.pointerToRoutine", {"task": "T_X", "routine": "main"})

    def test_breakpoint(self):
        line = line_of("helper count")
        self.assertEqual(self.page.call("breakpoints.set", {**MAIN, "line": line}), {**MAIN, "line": line, "verified": True})
        self.page.wait("breakpoints", lambda data: len(data["breakpoints"]) == 1)
        self.page.call("breakpoints.set", {**MAIN, "line": line})  # it is one breakpoint
        self.assertEqual(len(self.page.call("breakpoints.list")["breakpoints"]), 1)
        self.page.call("run.start")
        self.page.wait("pointers", lambda data: (data["pointer"] or {}).get("line") == line, seconds=20)
        self.eventually(lambda: not self.panel()["running"])
        self.assertEqual(self.task()["pointer"]["line"], line)
        self.page.call("breakpoints.clear", {**MAIN, "line": line})
        self.assertEqual(self.page.call("breakpoints.list")["breakpoints"], [])
        self.refused("not_found", "breakpoints.clear", {**MAIN, "line": line})
        self.refused("refused", "breakpoints.set", {**MAIN, "line": 100_000})

    def test_breakpoints_are_those_of_all_clients(self):
        """One list: what a client of RWS sets, pages see at once, and the other way round (docs/pendant.md)."""
        line = line_of("helper count")
        client = self.client(2)
        path = "/rw/rapid/tasks/T_ROB1/program/breakpoints"
        place = {"module": MAIN["module"], "row": str(line), "column": "1"}
        self.assertEqual(client.post("/rw/mastership/edit/request").status, 204)
        self.assertEqual(client.post(path, place).status, 204)
        self.page.wait("breakpoints", lambda data: [mark["line"] for mark in data["breakpoints"]] == [line])
        self.page.call("breakpoints.set", {**MAIN, "line": line})  # it is one breakpoint
        self.assertEqual([entry.values["row"] for entry in client.get(path).entries()], [str(line)])
        self.page.call("breakpoints.clear")
        self.assertEqual(client.get(path).entries(), [])
        self.page.call("breakpoints.set", {**MAIN, "line": line})
        self.assertEqual(client.delete(path + "?" + urllib.parse.urlencode(place)).status, 204)
        self.assertEqual(self.page.call("breakpoints.list")["breakpoints"], [])
        self.assertEqual(client.post("/rw/mastership/edit/release").status, 204)

    def test_motion(self):  # at most 60 a second, and a last one at rest
        self.page.call("run.start")
        samples = self.page.gather("motion", 2)
        self.assertGreater(len(samples), 20)
        self.assertLessEqual(len(samples), 2 * 63)
        times = [sample["t"] for sample in samples]
        self.assertEqual(times, sorted(times))
        for sample in samples:
            index, joints, _, tcp, flange, speed, moving = sample["units"][0]
            self.assertEqual((index, len(joints), len(tcp), len(flange)), (0, 6, 7, 7))
            self.assertGreaterEqual(speed, 0)
            self.assertIn(moving, (0, 1))
        self.page.call("run.stop")
        last = self.page.wait("motion", lambda data: data["units"][0][6] == 0)["units"][0]
        position = self.page.call("units.positions")["units"][0]
        self.assertEqual(position["joints"], last[1])

    def test_planned_path(self):
        self.page.call("run.start")
        path = self.eventually(lambda: (lambda found: found if found["moves"] else None)(
            self.page.call("path.planned", unit="ROB_1")))
        self.assertEqual(path["moves"][0]["kind"], "joint")
        self.assertEqual(path["moves"][0]["module"], "MainModule")
        self.assertGreater(len(path["points"]), 1)
        self.refused("not_found", "path.planned", unit="ROB_9")

    def test_restart(self):
        self.page.call("data.write", path="T_ROB1/MainModule/count", value="41")
        self.page.call("breakpoints.set", {**MAIN, "line": line_of("helper count")})
        self.restart("restart", mode="warm")
        self.assertEqual(self.value("count"), "41")
        self.assertTrue(self.page.call("breakpoints.list")["breakpoints"][0]["verified"])


class Programs(PendantCase):
    def test_modules(self):
        modules = self.page.call("modules.list", TASK)["modules"]
        self.assertEqual([(m["name"], m["kind"]) for m in modules], [("MainModule", "program")])
        self.assertEqual(self.page.call("modules.text", MAIN)["text"], MODULE)
        names = [r["name"] for r in self.page.call("modules.routines", TASK)["routines"]]
        self.assertEqual(names, ["main", "helper", "enter", "ask", "teach"])
        self.refused("not_found", "modules.text", {"task": "T_ROB1", "module": "Nothing"})

    def test_load_save_unload(self):
        with open(f"{self.home}/part.modx", "w", encoding="utf-8") as file:
            file.write("MODULE Part\n  PERS num size := 1;\nENDMODULE\n")
        self.page.call("modules.load", TASK, path="HOME:/part.modx")
        self.page.call("data.write", path="T_ROB1/Part/size", value="12")
        self.assertEqual(self.page.call("modules.save", {"task": "T_ROB1", "module": "Part"})["path"], "HOME:/part.modx")
        with open(f"{self.home}/part.modx", encoding="utf-8") as file:
            self.assertIn("size := 12;", file.read())
        self.refused("refused", "modules.load", TASK, path="HOME:/part.modx")
        self.page.call("modules.load", TASK, path="HOME:/part.modx", replace=True)
        self.page.call("modules.unload", {"task": "T_ROB1", "module": "Part"})
        self.refused("not_found", "modules.text", {"task": "T_ROB1", "module": "Part"})

    def test_paths_stay_inside(self):
        for path in ("/etc/passwd", "HOME:/../../etc/passwd", "NOVOLUME:/x.mod", "HOME:/..", ""):
            self.refused("bad_request", "modules.load", TASK, path=path)
            self.refused("bad_request", "modules.save", MAIN, path=path)
        self.refused("bad_request", "modules.save", MAIN, path="HOME:/notes.txt")

    def test_text_with_mistakes_changes_nothing(self):
        error = self.refused("bad_request", "modules.setText", MAIN, text=MODULE.replace("count + 1", "count + nothing"))
        self.assertIn("nothing", error.message)
        self.assertEqual(self.page.call("modules.text", MAIN)["text"], MODULE)

    def test_set_text(self):
        before = self.page.call("modules.text", MAIN)
        self.page.call("modules.setText", MAIN, text=MODULE.replace("count + 1", "count + 100"), changes=before["changes"])
        self.page.wait("generation")
        self.assertIn("count + 100", self.page.call("modules.text", MAIN)["text"])
        self.refused("refused", "modules.setText", MAIN, text=MODULE, changes=before["changes"])
        self.page.call("modules.setText", MAIN, text=MODULE)
        self.page.wait("generation")

    def test_program_and_backup(self):
        self.assertEqual(self.page.call("program.save", TASK, folder="HOME:/saved", name="line1")["path"], "HOME:/saved/line1.pgf")
        names = {entry["name"] for entry in self.page.call("files.list", folder="HOME:/saved")["entries"]}
        self.assertEqual(names, {"line1.pgf", "MainModule.modx"})
        self.page.call("program.load", TASK, path="HOME:/saved/line1.pgf")
        self.page.wait("generation")
        self.assertEqual(self.page.call("backup.create", name="b1")["path"], "BACKUP:/b1")
        names = {entry["name"] for entry in self.page.call("files.list", folder="BACKUP:/b1")["entries"]}
        self.assertLessEqual({"BACKINFO", "HOME", "RAPID", "SYSPAR"}, names)
        self.refused("refused", "backup.create", name="b1")
        for name in ("../x", "", "a/b", ".hidden"):
            self.refused("bad_request", "backup.create", name=name)
        self.refused("not_found", "backup.restore", name="nothing")
        self.restart("backup.restore", name="b1")
        self.assertEqual(self.page.call("state")["tasks"][0]["name"], "T_ROB1")

    def test_running_program_is_not_changed(self):
        self.page.call("run.start")
        self.refused("refused", "modules.setText", MAIN, text=MODULE + "\n")
        self.refused("refused", "modules.unload", MAIN)


class Signals(PendantCase):
    def signal(self, name):
        return self.page.call("signals.list", filter=name)["signals"][0]

    def test_list(self):
        answer = self.page.call("signals.list", type="DI")
        self.assertEqual([s["name"] for s in answer["signals"]], ["diSensor"])
        self.assertEqual(self.page.call("signals.list", filter="SENSOR")["total"], 1)  # name or label, in any case
        page = self.page.call("signals.list", start=1, count=2)
        self.assertEqual((len(page["signals"]), page["total"] >= 4), (2, True))

    def test_set_and_simulate(self):  # 34
        self.page.call("signals.set", name="DOLAMP", value=1)
        self.assertEqual(self.signal("doLamp")["value"], 1)
        self.page.call("signals.simulate", name="diSensor", on=True)
        self.page.call("signals.set", name="diSensor", value=1)
        self.assertEqual((self.signal("diSensor")["value"], self.signal("diSensor")["simulated"]), (1, True))
        self.page.call("signals.simulate", name="diSensor", on=False)
        for name, value in (("doLamp", 2), ("doLamp", 0.5), ("goStep", 16), ("goStep", 1.5)):
            self.refused("bad_request", "signals.set", name=name, value=value)
        self.refused("refused", "signals.set", name="doFixed", value=1)
        self.refused("not_found", "signals.set", name="doNothing", value=1)

    def test_changes_come_in_order(self):
        self.page.call("signals.set", name="goStep", value=0)
        self.page.gather("signal", 0.2)
        self.assertEqual(self.page.call("signals.subscribe", names=["goStep"])["signals"][0]["value"], 0)
        for value in range(1, 16):
            self.page.call("signals.set", name="goStep", value=value)
        self.page.call("signals.set", name="doLamp", value=1)  # is not subscribed to
        changes = [change for data in self.page.gather("signal", 0.5) for change in data]
        self.assertEqual([change[:3] for change in changes], [["goStep", value, 0] for value in range(1, 16)])
        self.page.call("signals.subscribe", names=[])
        self.page.call("signals.set", name="goStep", value=0)
        self.assertEqual(self.page.gather("signal", 0.3), [])

    def test_subscription_stays_with_another_program(self):
        self.page.call("signals.subscribe", names=["goStep"])
        self.page.call("modules.setText", MAIN, text=MODULE + "\n")
        self.page.wait("generation")
        self.page.call("signals.set", name="goStep", value=9)
        self.page.wait("signal", lambda data: ["goStep", 9, 0] in [change[:3] for change in data])


class Data(PendantCase):
    def test_list(self):
        data = {entry["name"]: entry for entry in self.page.call("data.list", MAIN)["data"]}
        self.assertEqual((data["count"]["type"], data["count"]["kind"], data["count"]["line"]), ("num", "pers", line_of("PERS num count")))
        self.assertEqual(data["table"]["dims"], [3])
        self.assertEqual(data["limit"]["kind"], "const")
        targets = self.page.call("data.list", TASK, type="robtarget")["data"]
        self.assertEqual([entry["path"] for entry in targets], ["T_ROB1/MainModule/pHere"])

    def test_read_and_write(self):  # 35
        self.page.call("data.write", path="T_ROB1/MainModule/table{2}", value="5")
        self.assertEqual(self.value("table"), "[1,5,3]")
        self.assertEqual(self.value("pHere.trans.x"), "400")
        for path, value in (("table", "[1,2]"), ("count", "TRUE"), ("note", '"' + "x" * 81 + '"'), ("table{4}", "1")):
            with self.assertRaises(PendantError):
                self.page.call("data.write", path=f"T_ROB1/MainModule/{path}", value=value)
        self.refused("refused", "data.write", path="T_ROB1/MainModule/limit", value="8")
        self.assertEqual(self.value("table"), "[1,5,3]")
        answer = self.page.call("data.read", paths=["T_ROB1/MainModule/nothing", "///", "T_ROB1/MainModule/limit"])["values"]
        self.assertEqual(["error" in entry for entry in answer], [True, True, False])

    def test_watch(self):
        path = "T_ROB1/MainModule/count"
        self.page.call("data.watch", paths=[path, "T_ROB1/MainModule/nothing"])
        other = self.connect()
        other.call("data.write", path=path, value="77")
        self.page.wait("data", lambda data: [path, "77"] in data)
        self.page.call("run.start")  # main adds one
        self.page.wait("data", lambda data: [path, "78"] in data)
        self.assertEqual(other.gather("data", 0.2), [])

    def test_stack(self):
        self.page.call("breakpoints.set", {**MAIN, "line": line_of("TPWrite note")})
        self.page.call("run.start")
        self.eventually(lambda: not self.panel()["running"], seconds=20)
        stack = self.page.call("data.stack", TASK)
        self.assertEqual([frame["routine"] for frame in stack["frames"]], ["helper", "main"])
        self.assertEqual([(entry["name"], entry["type"]) for entry in stack["data"]], [("value", "num")])


class Operator(PendantCase):
    def ask(self):
        self.page.call("run.pointerToRoutine", {**MAIN, "routine": "ask"})
        self.page.call("run.start")
        return self.page.wait("dialog", lambda data: "opened" in data)["opened"]

    def test_dialog(self):
        dialog = self.ask()
        self.assertEqual((dialog["instruction"], dialog["kind"], dialog["choices"][:3]), ("TPReadFK", "choice", ["Yes", "", "No"]))
        self.assertEqual(self.page.call("dialogs.list")["dialogs"], [dialog])
        for wrong in ({}, {"choice": 0}, {"choice": 2}, {"choice": 6}, {"text": "Yes"}):  # 2: no button
            self.refused("bad_request", "dialogs.answer", id=dialog["id"], **wrong)
        self.page.call("panel.cycle", cycle="once")
        self.addCleanup(self.page.call, "panel.cycle", cycle="forever")
        self.page.call("dialogs.answer", id=dialog["id"], choice=3)
        self.page.wait("dialog", lambda data: data.get("closed") == dialog["id"])
        self.eventually(lambda: not self.panel()["running"])
        self.assertEqual(self.value("count"), "3")
        self.refused("not_found", "dialogs.answer", id=dialog["id"], choice=3)

    def test_limits_of_an_entry(self):
        """docs/pendant.md, Dialog: the value that an entry begins with, limits of a number, whole numbers."""
        self.page.call("run.pointerToRoutine", {**MAIN, "routine": "enter"})
        self.page.call("run.start")
        number = self.page.wait("dialog", lambda data: "opened" in data)["opened"]
        self.assertEqual([number[key] for key in ("kind", "initial", "minimum", "maximum", "wholeNumbers")], ["number", "12", 1, 40, True])
        self.assertNotIn("increment", number)
        self.page.call("dialogs.answer", id=number["id"], number=7)
        text = self.page.wait("dialog", lambda data: "opened" in data)["opened"]
        self.assertEqual((text["kind"], text["initial"], "minimum" in text), ("text", "B-1", False))
        self.page.call("panel.cycle", cycle="once")
        self.addCleanup(self.page.call, "panel.cycle", cycle="forever")
        self.page.call("dialogs.answer", id=text["id"], text="B-2")
        items = self.page.wait("dialog", lambda data: data.get("opened", {}).get("kind") == "list")["opened"]
        self.assertEqual((items["items"], items["initial"]), (["Cover", "Shaft", ""], "2"))  # the argument DefaultIndex
        for wrong in ({"item": 0}, {"item": 3}, {"item": 4}, {"item": 3, "choice": 1}, {"choice": 2}, {}):  # 3: an empty item is not shown
            self.refused("bad_request", "dialogs.answer", id=items["id"], **wrong)
        self.page.call("dialogs.answer", id=items["id"], choice=1)  # OK alone takes it
        self.eventually(lambda: not self.panel()["running"])

    def test_display(self):
        self.page.call("run.pointerToLine", {**MAIN, "line": line_of("helper count")})
        self.page.call("data.write", path="T_ROB1/MainModule/count", value="4711")
        self.page.call("run.start")
        self.page.wait("display", lambda data: data.get("line") == "4711")
        self.assertIn("4711", self.page.call("display.read")["lines"])

    def test_events(self):
        self.page.call("panel.motors", on=False)
        event = self.page.wait("event", lambda event: event["code"] == 10010)  # controller.md 7: motors off
        newest = self.page.call("events.list", count=1)
        self.assertEqual((newest["events"][0]["number"], newest["more"]), (event["number"], True))
        details = self.page.call("events.details", number=event["number"])
        self.assertEqual((details["code"], details["type"]), (10010, "state"))
        self.assertTrue(details["description"])
        older = self.page.call("events.list", before=event["number"], count=1)["events"][0]
        self.assertLess(older["number"], event["number"])
        self.refused("not_found", "events.details", number=10**9)


class ByHand(PendantCase):
    def manual(self):
        self.page.call("panel.mode", mode="manual")
        self.page.call("panel.motors", on=True)

    def joints(self):
        return self.page.call("units.positions")["units"][0]["joints"]

    def test_jog_joint_by_increment(self):
        self.manual()
        before = self.joints()
        self.page.call("jog.start", unit="ROB_1", kind="joint", values=[0, 0, 0, 0, 0, 1], increment=2)
        self.page.wait("jog", lambda data: not data["moving"])
        after = self.joints()
        self.assertAlmostEqual(after[5], before[5] + 2, delta=0.001)
        self.assertEqual(after[:5], before[:5])

    def test_jog_linear_by_increment(self):
        self.manual()
        before = self.page.call("units.positions")["units"][0]["world"]
        self.page.call("jog.start", unit="ROB_1", kind="linear", frame="world", values=[0, 0, -1], increment=5)
        self.page.wait("jog", lambda data: not data["moving"])
        after = self.page.call("units.positions")["units"][0]["world"]
        for i, way in enumerate((0, 0, -5)):
            self.assertAlmostEqual(after[i], before[i] + way, delta=0.05)

    def test_dead_man(self):  # without repetition the arm stops by itself
        self.manual()
        self.page.call("jog.start", unit="ROB_1", kind="joint", values=[0, 0, 0, 0, 0, 0.5])
        self.page.wait("jog", lambda data: not data["moving"], seconds=5)

    def test_jogging_is_refused(self):  # 39
        order = {"unit": "ROB_1", "kind": "joint", "values": [1]}
        self.assertIn("manual", self.refused("refused", "jog.start", order).remedy)
        self.page.call("panel.mode", mode="manual")
        self.refused("refused", "jog.start", order)  # motors off
        self.page.call("panel.motors", on=True)
        self.refused("not_found", "jog.start", {**order, "unit": "ROB_9"})
        for wrong in ({"values": [2]}, {"values": [1] * 8}, {"kind": "linear"}, {"kind": "sideways"}, {"increment": 0},
                      {"increment": 1e9}, {"values": ["x"]}):
            self.refused("bad_request", "jog.start", {**order, **wrong})

    def test_tool(self):
        frames = self.page.call("units.frames", unit="ROB_1")
        self.assertEqual([tool["name"] for tool in frames["tools"]], ["tool0", "tGripper"])
        tool = self.page.call("jog.tool", unit="ROB_1", tool="tGripper")["tool"]
        self.assertEqual(tool["pose"], [0, 0, 100, 1, 0, 0, 0])
        world = self.page.call("units.positions")["units"][0]
        self.assertEqual(world["tool"], "tGripper")
        self.refused("refused", "jog.tool", unit="ROB_1", tool="tNothing")
        self.page.call("jog.tool", unit="ROB_1", tool="tool0")

    def test_teach(self):
        line = {**MAIN, "line": line_of("MoveJ pHere")}
        self.refused("refused", "teach.modify", line)  # automatic mode
        self.manual()
        self.assertEqual(self.page.call("teach.modify", line), {"inText": False})
        place = self.page.call("units.positions")["units"][0]["world"]
        self.assertAlmostEqual(float(self.value("pHere.trans.z")), place[2], delta=0.01)
        target = self.page.call("teach.read", unit="ROB_1", kind="robtarget")["value"]
        self.page.call("data.write", path="T_ROB1/MainModule/pHere", value=target)
        self.refused("refused", "teach.modify", {**MAIN, "line": line_of("TPWrite note")})  # no position there
        joints = self.page.call("teach.read", unit="ROB_1", kind="jointtarget")["value"]
        self.assertTrue(joints.startswith("[[") and joints.endswith("9E+09]]"), joints)


class Zones(ServeCase):
    MODULE = """MODULE MainModule
  VAR wztemporary wzLamp;
  VAR wztemporary wzStop;
  PROC main()
    VAR shapedata box;
    VAR shapedata ball;
    WZBoxDef \\Inside, box, [400,0,300], [300,200,100];
    WZDOSet \\Temp, wzLamp \\Inside, box, doLamp, 1;
    WZSphDef \\Outside, ball, [0,0,0], 2000;
    WZLimSup \\Temp, wzStop, ball;
    WZDisable wzLamp;
    WHILE TRUE DO
      WaitTime 0.1;
    ENDWHILE
  ENDPROC
ENDMODULE
"""
    FILES = {"EIO.cfg": EIO}

    def test_zones(self):  # manual 2.9; corners in order, as they are drawn
        page = Pendant(self.server.port("web"))
        self.addCleanup(page.close)
        zones = self.eventually(lambda: (lambda found: found if len(found) == 2 and not found[0]["active"] else None)(
            page.call("zones.list")["zones"]))
        box, ball = zones
        self.assertEqual((box["kind"], box["inside"], box["stops"], box["signal"]), ("box", True, False, "doLamp"))
        self.assertEqual(box["box"], {"from": [300, 0, 100], "to": [400, 200, 300]})
        self.assertEqual((ball["kind"], ball["inside"], ball["stops"], ball["signal"]), ("sphere", False, True, ""))
        self.assertEqual(ball["sphere"], {"centre": [0, 0, 0], "radius": 2000})
        self.assertEqual(page.call("state")["zones"], zones)


if __name__ == "__main__":
    main()
