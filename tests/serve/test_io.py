"""Signals, networks and devices (contract 24, 26, 31, 34, 41, 42, 44; facts 2.3 I/O)."""

import re

from serve_testing import IDLE_MODULE, ServeCase, main

EIO = """EIO:CFG_1.0:7:0::
#
EIO_ACCESS:

      -Name "Locked" -Rapid
#
INDUSTRIAL_NETWORK:

      -Name "ProfNet" -Label "plant"
#
PROFINET_DEVICE:

      -Name "Board1" -Network "ProfNet"
#
EIO_SIGNAL:

      -Name "doFlag" -SignalType "DO"

      -Name "diFlag" -SignalType "DI"

      -Name "diDoor" -SignalType "DI" -Device "Board1" -DeviceMap "0"

      -Name "doLamp" -SignalType "DO" -Device "Board1" -DeviceMap "1"\\
      -Category "Lamps"

      -Name "goByte" -SignalType "GO" -Device "Board1" -DeviceMap "8-15"

      -Name "aoSpeed" -SignalType "AO" -MaxLog 10

      -Name "doSafe" -SignalType "DO" -Access "ReadOnly"

      -Name "doOwn" -SignalType "DO" -Access "Locked"

      -Name "diMirror" -SignalType "DI"
""" + "".join(f'\n      -Name "doMany{i:03}" -SignalType "DO"\n' for i in range(150)) + """#
EIO_CROSS:

      -Name "mirror" -Res "diMirror" -Act1 "doFlag"
"""
SIGNALS = "/rw/iosystem/signals"


class Io(ServeCase):
    MODULE = IDLE_MODULE
    FILES = {"EIO.cfg": EIO}
    COUNT = 159

    def value(self, client, name):
        return client.get(f"{SIGNALS}/{name}").values()["lvalue"]

    def set(self, client, name, value, **more):
        return client.act(f"{SIGNALS}/{name}", "set", {"lvalue": value, **more}, action2="set-value")

    def state(self, client, name, state):
        return client.act(f"{SIGNALS}/{name}", "set-lstate", {"lstate": state})

    def test_list_is_paged(self):
        """Line 24: at most 100 on a page, rel=next leads to the rest; 26: 2.0 puts them into resources."""
        for client in self.both():
            titles, path, pages = [], SIGNALS, 0
            while path:
                response = client.get(path)
                self.assertEqual(response.status, 200)
                entries = response.entries("ios-signal-li")
                self.assertLessEqual(len(entries), 100)
                titles += [entry.title for entry in entries]
                path = response.following()
                pages += 1
            self.assertEqual(len(titles), self.COUNT)
            self.assertEqual(len(set(titles)), self.COUNT)
            self.assertEqual(pages, 2)
        client = self.client(2)
        self.assertEqual(len(client.get(SIGNALS + "?limit=7").json()["_embedded"]["resources"]), 7)
        self.assertEqual(client.get(SIGNALS + "?start=9999").status, 400)
        self.assertEqual(client.get(SIGNALS + "?limit=0").status, 400)

    def test_addresses_count_from_the_base(self):
        """Recorded answers of controllers: the base of the I/O system is /rw/iosystem/, the addresses are signals/.., devices/.. and
        networks/.., in JSON of RWS 1.0 with ?json=1. Clients put the base in front of them."""
        for client in self.both():
            for query in ("", "?json=1") if client.dialect == 1 else ("",):
                for kind in ("signals", "networks", "devices"):
                    response = client.get(f"/rw/iosystem/{kind}{query}")
                    self.assertTrue(response.base().endswith("/rw/iosystem/"))
                    for entry in response.entries()[:5]:
                        address = entry.links["self"]
                        self.assertRegex(address, rf"^{kind}/[^?]+{re.escape(query)}$")
                        self.assertEqual(client.get("/rw/iosystem/" + address).entries()[0].title, entry.title)

    def test_values_in_json(self):
        """Recorded answers of controllers with RobotWare 6: in JSON the value is a number in the list of signals, and a text where one
        signal is read."""
        client = self.client(1)
        for name, text, number in (("doFlag", "1", 1), ("goByte", "200", 200), ("aoSpeed", "2.5", 2.5)):
            self.assertEqual(self.set(client, name, text).status, 204)
            listed = {state["name"]: state["lvalue"] for state in client.get(SIGNALS + "?json=1").json()["_embedded"]["_state"]}
            self.assertEqual(listed[name], number)
            self.assertNotIsInstance(listed[name], str)
            one = client.get(f"{SIGNALS}/{name}?json=1").json()["_embedded"]["_state"][0]
            self.assertEqual(one["lvalue"], text)

    def test_titles(self):
        """Line 24: net/dev/name with a device, the bare name without one; both addresses."""
        for client in self.both():
            entries = {entry.title: entry for entry in client.get(SIGNALS).entries()}
            self.assertIn("doFlag", entries)
            self.assertIn("ProfNet/Board1/diDoor", entries)
            for path in ("diDoor", "ProfNet/Board1/diDoor", "profnet/board1/DIDOOR"):
                values = client.get(f"{SIGNALS}/{path}").values("ios-signal")
                self.assertEqual((values["name"], values["type"]), ("diDoor", "DI"))
            self.assertEqual(entries["ProfNet/Board1/doLamp"].values["category"], "Lamps")
            self.assertEqual(client.get(f"{SIGNALS}/Wrong/Board1/diDoor").status, 404)

    def test_unknown_signal(self):
        """Facts 2.2: -1073445866, 404."""
        for client in self.both():
            response = client.get(f"{SIGNALS}/noSuch")
            self.assertEqual((response.status, response.code()), (404, -1073445866))
            self.assertEqual(self.set(client, "noSuch", 1).status, 404)

    def test_set(self):
        """Lines 31 and 34: an output or a virtual input may be set."""
        for client in self.both():
            for name in ("doFlag", "diFlag", "ProfNet/Board1/doLamp"):
                for value in ("1", "0"):
                    self.assertEqual(self.set(client, name, value).status, 204)
                    self.assertEqual(self.value(client, name), value)
            self.assertEqual(self.set(client, "goByte", 255).status, 204)
            self.assertEqual(self.value(client, "goByte"), "255")
            self.assertEqual(self.set(client, "aoSpeed", 2.5).status, 204)
            self.assertEqual(self.value(client, "aoSpeed"), "2.5")

    def test_refused_values(self):
        """Line 34: 2 for a digital and 256 for 8 bits are 4xx, and nothing changes."""
        for client in self.both():
            for name, value in (("doFlag", 2), ("goByte", 256), ("goByte", -1), ("goByte", 1.5), ("aoSpeed", 11), ("doFlag", "x"),
                                ("doFlag", "nan"), ("aoSpeed", "inf"), ("doFlag", "")):
                before = self.value(client, name)
                response = self.set(client, name, value)
                self.assertIn(response.status // 100, (4,), (name, value))
                self.assertEqual(self.value(client, name), before)

    def test_read_only(self):
        """Line 34: Access ReadOnly is 403; a level that lets only RAPID write is, too."""
        for client in self.both():
            self.assertEqual(self.set(client, "doSafe", 1).status, 403)
            self.assertEqual(self.set(client, "doOwn", 1).status, 403)
            self.assertEqual(self.value(client, "doSafe"), "0")

    def test_simulation(self):
        """Line 31: an input of a device is simulated first; while it is, its value is the client's, and then the plant's again."""
        for client in self.both():
            door = "ProfNet/Board1/diDoor"
            self.assertEqual(self.set(client, door, 1).status, 403)
            self.assertEqual(self.state(client, door, "simulated").status, 204)
            self.assertEqual(client.get(f"{SIGNALS}/{door}").values()["lstate"], "simulated")
            self.assertEqual(self.set(client, door, 1).status, 204)
            self.assertEqual(self.value(client, door), "1")
            self.assertEqual(self.state(client, door, "not simulated").status, 204)
            self.assertEqual(self.value(client, door), "0")
            self.assertEqual(client.get(f"{SIGNALS}/{door}").values()["lstate"], "not simulated")
            self.assertEqual(self.state(client, door, "perhaps").status, 400)

    def test_simulated_cross_connection(self):
        """A simulated input does not follow its cross connection; afterwards it has the value of that."""
        client = self.client(2)
        self.set(client, "doFlag", 0)
        self.assertEqual(self.set(client, "diMirror", 1).status, 403)
        self.state(client, "diMirror", "simulated")
        self.set(client, "doFlag", 1)
        self.assertEqual(self.value(client, "diMirror"), "0")
        self.state(client, "diMirror", "not simulated")
        self.assertEqual(self.value(client, "diMirror"), "1")
        self.set(client, "doFlag", 0)
        self.assertEqual(self.value(client, "diMirror"), "0")

    def test_mode_of_rws_1(self):
        """Line 31: form lvalue with mode=simulated or mode=value."""
        client = self.client(1)
        door = f"{SIGNALS}/diDoor"
        self.assertEqual(client.post(door + "?action=set", {"lvalue": 1, "mode": "simulated"}).status, 204)
        self.assertEqual((self.value(client, "diDoor"), client.get(door).values()["lstate"]), ("1", "simulated"))
        self.assertEqual(client.post(door + "?action=set", {"lvalue": 0, "mode": "value"}).status, 204)
        self.assertEqual(self.value(client, "diDoor"), "0")
        self.assertEqual(client.post(door + "?action=set", {"lvalue": 0, "mode": "odd"}).status, 400)
        self.assertEqual(self.state(client, "diDoor", "not simulated").status, 204)

    def test_search(self):
        """Line 31: name is a substring, the second set narrows."""
        for client in self.both():
            def names(response):
                self.assertEqual(response.status, 200)
                return {entry.values["name"] for entry in response.entries("ios-signal-li")}

            plain = ("signal-search", "signal-search")
            second = ("signal-searchex", "signal-search-ex")
            act = lambda action, fields: client.act(SIGNALS, action[0], fields, action2=action[1])  # noqa: E731
            self.assertEqual(names(act(plain, {"name": "lamp"})), {"doLamp"})
            self.assertEqual(names(act(plain, {"device": "Board1", "type": "GO"})), {"goByte"})
            self.assertEqual(names(act(plain, {"network": "ProfNet"})), {"diDoor", "doLamp", "goByte"})
            self.assertEqual(names(act(plain, {"name": "*"})), set())
            self.assertEqual(names(act(second, {"name": "o", "device": "Board1", "name2": "Lamp"})), {"doLamp"})
            self.assertEqual(len(names(act(plain, {}))), 100)

    def test_one_signal_of_2_0_has_both_classes(self):
        """Decision 129: clients of RWS 2.0 look for ios-signal (facts 2.3) or for ios-signal-li; both have the same spans."""
        for form in ("hal", "xhtml"):
            first, second = self.client(2, form=form).get(f"{SIGNALS}/doLamp").entries()
            self.assertEqual((first.type, second.type), ("ios-signal", "ios-signal-li"))
            self.assertEqual((first.title, first.values), (second.title, second.values))
        self.assertEqual([entry.type for entry in self.client(1).get(f"{SIGNALS}/doLamp").entries()], ["ios-signal"])

    def test_networks_and_devices(self):
        """Facts 2.3: li ios-network-li, ios-device-li; line 24: devices answer to both paths."""
        for client in self.both():
            self.assertIn("ProfNet", [entry.title for entry in client.get("/rw/iosystem/networks").entries("ios-network-li")])
            devices = {entry.title: entry for entry in client.get("/rw/iosystem/devices").entries("ios-device-li")}
            self.assertEqual(devices["ProfNet/Board1"].values["lstate"], "enabled")
            for path in ("Board1", "ProfNet/Board1"):
                self.assertEqual(client.get(f"/rw/iosystem/devices/{path}").values()["name"], "Board1")
            ending = "-li" if client.dialect == 2 else ""  # App SDK: one network or device of 2.0 has the class of lists
            self.assertEqual(client.get("/rw/iosystem/devices/ProfNet/Board1").entries()[0].type, "ios-device" + ending)
            self.assertEqual(client.get("/rw/iosystem/networks/ProfNet").entries()[0].type, "ios-network" + ending)
            self.assertEqual(client.get("/rw/iosystem/devices/None1").status, 404)
            self.assertEqual(client.get("/rw/iosystem/devices?network=ProfNet").entries()[0].title, "ProfNet/Board1")

    def test_device_can_be_disabled(self):
        client = self.client(2)
        device = "/rw/iosystem/devices/ProfNet/Board1"
        self.assertEqual(client.post(device + "/set-lstate", {"lstate": "disable"}).status, 204)
        self.assertEqual(client.get(device).values()["lstate"], "disabled")
        self.assertEqual(client.get(f"{SIGNALS}/diDoor").values()["quality"], "bad")
        self.assertEqual(client.post(device + "/set-lstate", {"lstate": "enable"}).status, 204)
        self.assertEqual(client.get(f"{SIGNALS}/diDoor").values()["quality"], "good")

    def test_subscription(self):
        """Lines 41, 42, 44: the initial value in the 201, then every change in order with priority 2."""
        for client in self.both():
            self.set(client, "doFlag", 0)
            response = client.subscribe((f"{SIGNALS}/doFlag;state", 2))
            self.assertEqual(response.status, 201)
            socket = self.socket(client, response)
            for value in ("1", "0", "1"):
                self.set(client, "doFlag", value)
            for value in ("1", "0", "1"):
                event = socket.event()
                self.assertEqual((event.type, event.values["lvalue"]), ("ios-signalstate-ev", value))
                self.assertEqual(event.values["lstate"], "not simulated")
            self.assertEqual(client.subscribe((f"{SIGNALS}/noSuch;state", 2)).status // 100, 4)

    def test_both_forms_are_the_same(self):
        """Line 21: XHTML and JSON of one resource have the same entries."""
        for dialect, forms in ((1, ("xhtml", "json")), (2, ("xhtml", "hal"))):
            first, second = (self.client(dialect, form=form) for form in forms)
            for path in (SIGNALS, f"{SIGNALS}/diDoor", "/rw/iosystem/devices", "/rw/iosystem/networks"):
                self.assertEqual(first.get(path).entries(), second.get(path).entries(), path)


class Alias(ServeCase):
    """RWS documentation, /rw/rapid/aliasio: signal variables that AliasIO has connected."""
    MODULE = """MODULE MainModule
  VAR signaldo lamp;
  VAR signaldi idle;
  PROC main()
    AliasIO doLamp, lamp;
    Stop;
    AliasIOReset lamp;
    Stop;
  ENDPROC
ENDMODULE
"""
    FILES = {"EIO.cfg": EIO}

    def test_alias_signals(self):
        def aliases(client):
            return [(entry.values["alias-name"], entry.values["signal-name"], entry.values["type"])
                    for entry in client.get("/rw/rapid/aliasio").entries("rap-alias-io")]
        clients = self.both()
        for client in clients:
            self.eventually(lambda: aliases(client) == [("lamp", "doLamp", "DO")])  # pylint: disable=cell-var-from-loop
        form = {"regain": "continue", "execmode": "continue", "cycle": "asis", "condition": "none",
                "stopatbp": "enabled", "alltaskbytsp": "true"}
        self.eventually(lambda: clients[0].get("/rw/rapid/execution").values()["ctrlexecstate"] == "stopped")
        self.assertEqual(clients[0].act("/rw/rapid/execution", "start", form).status, 204)
        for client in clients:
            self.eventually(lambda: aliases(client) == [])  # pylint: disable=cell-var-from-loop


if __name__ == "__main__":
    main()
