"""/rw/panel (controller.md 2.3 Panel; contract 22, 31, 38, 39, 44)."""

from rapid_testing import RapidCase
from serve_testing import main


def motors(dialect):
    return "/rw/panel/ctrlstate" if dialect == 1 else "/rw/panel/ctrl-state"


class Panel(RapidCase):
    def set_motors(self, client, state):
        path = motors(client.dialect) + ("?action=setctrlstate" if client.dialect == 1 else "")
        return client.post(path, {"ctrl-state": state}).status

    def test_states_in_all_forms(self):
        """2.3: classes and spans; contract 5: with --no-program-start motors are off, mode AUTO; contract 21."""
        for span, path1, path2, value in (
                ("ctrlstate", "/rw/panel/ctrlstate", "/rw/panel/ctrl-state", "motoroff"),
                ("opmode", "/rw/panel/opmode", "/rw/panel/opmode", "AUTO"),
                ("speedratio", "/rw/panel/speedratio", "/rw/panel/speedratio", "100"),
                ("coldetstate", "/rw/panel/coldetstate", "/rw/panel/coldetstate", "INIT")):
            with self.subTest(span=span):
                for entries in self.in_all_forms(path1, path2).values():
                    self.assertEqual([(entry.type, entry.values[span]) for entry in entries[:1]], [(f"pnl-{span}", value)])

    def test_mode_and_its_lock(self):
        """A client of RWS 2.0 takes the first of several entries of the mode; the second one leads to the lock."""
        entries = self.client(2).get("/rw/panel/opmode").entries()
        self.assertEqual([entry.type for entry in entries], ["pnl-opmode", "pnl-opmode-lockstate-li"])
        self.assertEqual(self.client(2).get(entries[1].links["self"]).values()["lockstate"], "unlocked")

    def test_motors(self):
        for client in self.both():
            self.assertEqual(self.set_motors(client, "motoron"), 204)
            self.assertEqual(client.get(motors(client.dialect)).values()["ctrlstate"], "motoron")
            self.assertEqual(self.set_motors(client, "motoroff"), 204)
            self.assertEqual(client.get(motors(client.dialect)).values()["ctrlstate"], "motoroff")
            for wrong in ("on", "", "MOTORON"):
                self.assertEqual(self.set_motors(client, wrong), 400)

    def test_speed_ratio(self):
        """2.3: 0..100, ?action=setspeedratio in both dialects, in 2.0 also without (contract 31)."""
        path = "/rw/panel/speedratio?action=setspeedratio"
        for client in self.masters():
            for ratio in ("50", "0", "100"):
                self.assertEqual(client.post(path, {"speed-ratio": ratio}).status, 204)
                self.assertEqual(client.get("/rw/panel/speedratio").values("pnl-speedratio")["speedratio"], ratio)
            for wrong in ("101", "-1", "fast", "", "1e1"):
                self.assertEqual(client.post(path, {"speed-ratio": wrong}).status, 400, wrong)
            self.assertEqual(client.get("/rw/panel/speedratio").values()["speedratio"], "100")
        client = self.master(2)
        self.assertEqual(client.post("/rw/panel/speedratio", {"speed-ratio": "40"}).status, 204)
        self.assertEqual(client.post("/rw/panel/speedratio", {"speed-ratio": "100"}).status, 204)

    def test_mode(self):
        """Contract 39: man gives MANR, motors off. 2.3: auto, man, manfs, manf."""
        for client in self.both():
            self.assertEqual(self.set_motors(client, "motoron"), 204)
            for word, mode in (("man", "MANR"), ("manf", "MANF"), ("auto", "AUTO"), ("manfs", "MANF")):
                self.assertEqual(client.post("/rw/panel/opmode", {"opmode": word}).status, 204)
                self.assertEqual(client.get("/rw/panel/opmode").values("pnl-opmode")["opmode"], mode)
                self.assertEqual(client.get(motors(client.dialect)).values()["ctrlstate"], "motoroff")
            self.assertEqual(client.post("/rw/panel/opmode", {"opmode": "AUTO"}).status, 400)
            self.assertEqual(client.post("/rw/panel/opmode", {"opmode": "auto"}).status, 204)

    def test_stops_and_lock(self):
        """2.3: what virtual controllers have; state=off engages a stop."""
        client = self.client(2)
        for path, state in (("emergency-stop", "emergencystop"), ("general-stop", "guardstop"), ("auto-stop", "guardstop")):
            with self.subTest(path=path):
                self.assertEqual(client.post(f"/rw/panel/{path}", {"state": "off"}).status, 204)
                self.assertEqual(client.get("/rw/panel/ctrl-state").values()["ctrlstate"], state)
                self.assertEqual(self.set_motors(client, "motoron"), 403)
                self.assertEqual(client.post(f"/rw/panel/{path}", {"state": "on"}).status, 204)
                self.assertEqual(client.get("/rw/panel/ctrl-state").values()["ctrlstate"], "motoroff")
                self.assertEqual(client.post(f"/rw/panel/{path}", {"state": "half"}).status, 400)
        self.assertEqual(client.post("/rw/panel/opmode/lock", {"pin": "1234", "permanent": "false"}).status, 204)
        self.assertEqual(client.post("/rw/panel/opmode", {"opmode": "man"}).status, 403)
        self.assertEqual(client.get("/rw/panel/opmode/lock-state").values()["lockstate"], "locked")
        self.assertEqual(client.post("/rw/panel/opmode/unlock").status, 204)
        self.assertEqual(client.post("/rw/panel/opmode", {"opmode": "auto"}).status, 204)

    def test_events(self):
        """2.4 and contract 44: both spellings, and the anchor is what was subscribed."""
        for client in self.both():
            name = "ctrlstate" if client.dialect == 1 else "ctrl-state"
            for resource in (f"/rw/panel/{name}", f"/rw/panel/{name};{name}"):
                with self.subTest(resource=resource):
                    response = client.subscribe(resource)
                    self.assertEqual(response.status, 201)
                    self.assertEqual(response.values("pnl-ctrlstate-ev")["ctrlstate"], "motoroff")
                    socket = self.socket(client, response)
                    for state in ("motoron", "motoroff"):
                        self.assertEqual(self.set_motors(client, state), 204)
                        event = socket.event()
                        self.assertEqual((event.type, event.values["ctrlstate"]), ("pnl-ctrlstate-ev", state))
                        self.assertEqual(event.links["self"], resource)

    def test_events_of_mode_and_speed(self):
        client = self.client(1)
        response = client.subscribe("/rw/panel/opmode", "/rw/panel/speedratio;speedratio", "/rw/panel/coldetstate")
        self.assertEqual(sorted(entry.type for entry in response.entries()),
                         ["pnl-coldetstate-ev", "pnl-opmode-ev", "pnl-speedratio-ev"])
        socket = self.socket(client, response)
        client.post("/rw/panel/speedratio?action=setspeedratio", {"speed-ratio": "70"})
        self.assertEqual(socket.event().values["speedratio"], "70")
        client.post("/rw/panel/opmode", {"opmode": "man"})
        self.assertEqual(socket.event().values["opmode"], "MANR")
        client.post("/rw/panel/opmode", {"opmode": "auto"})
        client.post("/rw/panel/speedratio?action=setspeedratio", {"speed-ratio": "100"})


class Restart(RapidCase):
    def test_restart(self):
        """Contract 31: addresses stay, back within 10 s."""
        client = self.client(1)
        self.assertEqual(client.post("/rw/panel?action=restart", {"restart-mode": "wrong"}).status, 400)
        self.assertIn(client.post("/rw/panel?action=restart", {"restart-mode": "restart"}).status, (200, 202, 204))
        self.eventually(lambda: self.reader().get("/rw/panel/ctrlstate").status == 200, seconds=10)


if __name__ == "__main__":
    main()
