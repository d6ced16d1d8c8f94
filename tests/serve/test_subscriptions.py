"""Subscriptions and event sockets (contract 41 to 45, controller.md 2.4)."""

import time
import urllib.parse

from serve_testing import SLOW, ServeCase, main

OPMODE = "/rw/panel/opmode"
SPEED = "/rw/panel/speedratio"
MODULE = """MODULE MainModule
  PERS num count := 0;
  VAR num hidden := 1;
  PERS string long{16} := ["","","","","","","","","","","","","","","",""];
  PROC main()
    WHILE TRUE DO
      WaitTime 0.1;
    ENDWHILE
  ENDPROC
ENDMODULE
"""
EIO = """EIO:CFG_1.0:6:0::
#
EIO_SIGNAL:
      -Name "do1" -SignalType "DO" -Access "All"
      -Name "do2" -SignalType "DO" -Access "All"
""" + "".join(f'      -Name "v{i}" -SignalType "DO" -Access "All"\n' for i in range(100))


def signal(name):
    return f"/rw/iosystem/signals/{name};state"


class SubscriptionCase(ServeCase):
    MODULE = MODULE
    FILES = {"EIO.cfg": EIO}

    def set_signal(self, client, name, value):
        response = client.act(f"/rw/iosystem/signals/{name}", "set", {"lvalue": str(value)}, "set-value")
        self.assertEqual(response.status, 204, response)

    def set_speed(self, client, value):
        """Speed needs mastership in RWS 2.0 (contract 38): a client of RWS 1.0 sets it."""
        self.assertEqual(client.post(SPEED + "?action=setspeedratio", {"speed-ratio": str(value)}).status, 204)

    def open(self, client, *resources):
        response = client.subscribe(*resources)
        self.assertEqual(response.status, 201, response)
        socket = self.socket(client, response)
        self.assertEqual(socket.status, 101)
        return response, socket

    @staticmethod
    def anchor(event):
        return event.links["self"]


class LargeValues(SubscriptionCase):
    def test_event_of_a_large_value(self):
        """controller.md 2.4: an event is under 1 KiB; a longer value is read at the address in the event (docs/serve.md)."""
        for client in self.both():
            path = ("/rw/rapid/symbol/data/RAPID/T_ROB1/MainModule/long" if client.dialect == 1
                    else "/rw/rapid/symbol/RAPID/T_ROB1/MainModule/long/data")
            _, socket = self.open(client, (path + ";value", 1))
            writer = self.client(1)
            target = "/rw/rapid/symbol/data/RAPID/T_ROB1/MainModule/long?action=set"
            for length, fits in ((79, False), (5, True)):
                value = "[" + ",".join(f'"{"a" * length}{client.dialect}"' for _ in range(16)) + "]"
                self.assertEqual(writer.post(target, {"value": value}).status, 204)
                event = socket.event()  # fails when it has 1 KiB or more
                self.assertEqual(self.anchor(event), path + ";value")
                self.assertEqual("value" in event.values, fits)
                self.assertEqual(client.get(path).values()["value"], value)
            writer.close()


class StatesWithoutReports(SubscriptionCase):
    """2.4: networks, devices, system parameters, the privilege of manual mode."""

    FILES = {"EIO.cfg": EIO + '#\nINDUSTRIAL_NETWORK:\n      -Name "Net"\n#\nDEVICENET_DEVICE:\n      -Name "Board" -Address 10\n'}

    def test_devices(self):
        for client in self.both():
            title = client.get("/rw/iosystem/devices/Board").entries()[0].title
            for path, type_, state in (("/rw/iosystem/devices/Board", "ios-devicestate-ev", "disable"),
                                       (f"/rw/iosystem/devices/{title}", "ios-devicestate-ev", "disable"),
                                       (f"/rw/iosystem/networks/{title.split('/')[0]}", "ios-networkstate-ev", "stop")):
                response, socket = self.open(client, (path + ";state", 1))
                first = response.values(type_)["lstate"]
                self.assertEqual(client.act(path, "set", {"lstate": state}, "set-lstate").status, 204)
                event = socket.event()
                self.assertEqual((event.type, self.anchor(event)), (type_, path + ";state"))
                self.assertNotEqual(event.values["lstate"], first)
                back = {"disable": "enable", "stop": "start"}[state]
                self.assertEqual(client.act(path, "set", {"lstate": back}, "set-lstate").status, 204)
                self.assertEqual(socket.event().values["lstate"], first)
            self.assertIn(client.subscribe("/rw/iosystem/devices/None;state").status, (400, 404))

    def test_parameters_and_privilege(self):
        writer = self.client(1)
        for client in self.both():
            _, socket = self.open(client, ("/rw/cfg/eio", 1), ("/users/rmmp", 1))
            label = f"label{client.dialect}"
            self.assertEqual(writer.post("/rw/cfg/EIO/EIO_SIGNAL/instances/do1?action=set", {"Label": label}).status, 204)
            event = socket.event()
            self.assertEqual((event.type, event.values["name"], self.anchor(event)), ("cfg-domain-ev", "EIO", "/rw/cfg/eio"))
            self.assertIn(writer.post("/users/rmmp", {"privilege": "modify"}).status, (200, 201, 202, 204))
            self.assertEqual(socket.event().values["privilege"], "modify")
            self.assertIn(writer.post("/users/rmmp?action=cancel").status, (200, 204))
            self.assertEqual(socket.event().values["privilege"], "none")
        writer.close()


class RareStates(SubscriptionCase):
    """RWS documentation 3HAC050973, its subscription pages: states that a group may name, with the class and the values of each."""

    DOCUMENTED = {  # path: class, title and values of the first entry; None: no first entry
        "/rw/motionsystem/mechunits;mechunitmodechangecount": ("motionsystem-ev", "mechunit-statechange", {"change-count": "0"}),
        "/rw/motionsystem/errorstate;erroreventchange": None,
        "/rw/rapid/taskselection;taskpanelchange": ("rap-taskpanel-ev", "taskpanel", {"change-count": "0"}),
        "/rw/rapid/execution;hdtrun": None,
        "/rw/rapid/tasks;buildlogchange": None,
        "/rw/rapid/tasks/T_ROB1;syncstatechange": ("rap-syncstate-ev", "syncstatechange", {"sync-state": "on"}),
        "/rw/system/energy": ("sys-energy-ev", "energy", {"energy-state": "not-paused"}),
    }

    def test_one_group_with_all(self):
        for client in self.both():
            response, _ = self.open(client, OPMODE, *self.DOCUMENTED)
            found = {self.anchor(entry): (entry.type, entry.title, entry.values) for entry in response.entries()}
            self.assertEqual(found.pop(OPMODE)[0], "pnl-opmode-ev")
            self.assertEqual(found, {path: entry for path, entry in self.DOCUMENTED.items() if entry})
            self.assertIn(client.subscribe("/rw/rapid/tasks/T_NONE;syncstatechange").status, (400, 404))

    def test_changes_of_the_configuration(self):
        writer = self.client(1)
        for client in self.both():
            response, socket = self.open(client, "/rw/cfg")
            first = response.values("cfg-prop-ev")["cc"]
            label = {"Label": f"rare{client.dialect}"}
            self.assertEqual(writer.post("/rw/cfg/EIO/EIO_SIGNAL/instances/do2?action=set", label).status, 204)
            event = socket.event()
            self.assertEqual((event.type, event.title, self.anchor(event)), ("cfg-prop-ev", "change-count", "/rw/cfg"))
            self.assertGreater(int(event.values["cc"]), int(first))

    def test_the_task_panel(self):
        writer = self.client(1)
        self.assertEqual(writer.post("/rw/rapid/execution?action=stop", {"stopmode": "stop"}).status, 204)
        self.eventually(lambda: writer.get("/rw/rapid/execution").values()["ctrlexecstate"] == "stopped")
        for client in self.both():
            _, socket = self.open(client, "/rw/rapid/taskselection;taskpanelchange")
            for count, action in (("1", "deactivate"), ("2", "activate")):
                self.assertEqual(writer.post(f"/rw/rapid/tasks/T_ROB1?action={action}").status, 204)
                self.assertEqual(socket.event().values, {"change-count": count})


class Creating(SubscriptionCase):
    def test_response(self):
        """controller.md 2.4: 201, Location, anchors with end tags, numeric ID, initial values."""
        for client in self.both(form="xhtml"):
            response = client.subscribe(OPMODE, signal("do1"))
            self.assertEqual(response.status, 201)
            scheme = "ws" if client.dialect == 1 else "wss"
            self.assertRegex(response.header("location"), rf"^{scheme}://127\.0\.0\.1:{client.port}/poll/\d+$")
            self.assertEqual(response.links()["self"], response.header("location"))
            number = response.header("location").rsplit("/", 1)[1]
            self.assertEqual(response.links()["group"], f"subscription/{number}")
            self.assertNotRegex(response.body.decode(), r"<a [^>]*/>")
            entries = {entry.type: entry for entry in response.entries()}
            self.assertEqual(entries["pnl-opmode-ev"].values, {"opmode": "AUTO"})
            self.assertEqual(self.anchor(entries["pnl-opmode-ev"]), OPMODE)
            self.assertEqual(entries["ios-signalstate-ev"].values["lvalue"], "0")
            self.assertEqual(self.anchor(entries["ios-signalstate-ev"]), signal("do1"))

    def test_json(self):
        for client in (self.client(1, form="json"), self.client(2)):
            response = client.subscribe(OPMODE)
            self.assertEqual(response.status, 201)
            self.assertEqual(response.values("pnl-opmode-ev"), {"opmode": "AUTO"})

    def test_forms_of_clients(self):
        """controller.md 2.4: numbers from 0, repeated resources, escaped paths, panel resources with and without name."""
        for client in self.both():
            for text in (OPMODE, OPMODE + ";opmode", urllib.parse.quote(OPMODE, safe="")):
                for number in ("0", "1", "7"):
                    response = client.post("/subscription", [("resources", number), (number, text), (number + "-p", "1")])
                    self.assertEqual(response.status, 201, text)
                    self.assertEqual(self.anchor(response.entries()[0]), text)  # contract 44
                    group = "/subscription/" + response.header("location").rsplit("/", 1)[1]
                    self.assertEqual(client.delete(group).status, 200)

    def test_what_cannot_be_subscribed(self):
        """Contract 43: 400 or 404; and nothing of the request is subscribed."""
        for client in self.both():
            for text in ("/rw/unknown", "/rw/iosystem/signals/none;state", "/rw/iosystem/signals/do1;colour", "rw/panel/opmode", ";", "/",
                         "/rw/rapid/symbol/data/RAPID/T_ROB1/MainModule/none;value"):
                self.assertIn(client.subscribe(text).status, (400, 404), text)
                self.assertIn(client.subscribe(OPMODE, text).status, (400, 404), text)
            for fields in ([], [("resources", "1")], [("resources", "1"), ("1", "")], [("x", "y")],
                           [("resources", "1"), ("1", OPMODE), ("1-p", "3")], [("resources", "1"), ("1", OPMODE), ("1-p", "-1")],
                           [("resources", "1"), ("1", OPMODE), ("1-p", "high")]):
                self.assertEqual(client.post("/subscription", fields).status, 400, fields)

    def test_at_most_64_of_high_priority(self):
        """Contract 42."""
        for client in self.both():
            many = [(signal(f"v{i}"), 2) for i in range(65)]
            self.assertEqual(client.subscribe(*many).status, 400)
            self.assertEqual(client.subscribe(*many[:64]).status, 201)
            low = [(name, 1) for name, _ in many]
            self.assertEqual(client.subscribe(*low).status, 201)


class Upgrades(SubscriptionCase):
    def test_protocols(self):
        """Contract 43, controller.md 2.1."""
        for client in self.both():
            response = client.subscribe(OPMODE)
            other = "rws_subscription" if client.dialect == 1 else "robapi2_subscription"
            for protocol in (other, "chat"):
                self.assertEqual(self.socket(client, response, protocol=protocol).status, 400)
            socket = self.socket(client, response)
            self.assertEqual(socket.status, 101)
            self.assertEqual(socket.protocol, "robapi2_subscription" if client.dialect == 1 else "rws_subscription")

    def test_who_may_open(self):
        """Contract 43: unknown ID, another session's cookie, no cookie."""
        for client in self.both():
            response = client.subscribe(OPMODE)
            other = self.client(client.dialect)
            other.get(OPMODE)
            for path in ("/poll/999999", "/poll/", "/poll/x", "/poll/0", "/poll/-1", "/rw/panel/opmode"):
                self.assertIn(self.socket(client, response, path=path).status, (400, 404), path)
            self.assertIn(self.socket(other, response).status, (403, 404))
            stranger = self.server.client(client.dialect)
            stranger.cookies = {"x": "y"}
            self.assertIn(self.socket(stranger, response).status, (401, 403))
            self.assertEqual(self.socket(client, response).status, 101)

    def test_opening_again(self):
        """Contract 43: a dropped socket of 1.0 may be opened again, one of 2.0 may not."""
        for client in self.both():
            response, socket = self.open(client, OPMODE)
            socket.close()
            time.sleep(0.2)
            self.assertEqual(self.socket(client, response).status == 101, client.dialect == 1)

    def test_events_between_sockets_are_kept(self):
        client, other = self.client(1), self.client(1)
        response, socket = self.open(client, (signal("do1"), 2))
        socket.close()
        time.sleep(0.2)
        self.set_signal(other, "do1", 1)
        self.assertEqual(self.socket(client, response).event().values["lvalue"], "1")
        self.set_signal(other, "do1", 0)

    def test_a_second_socket_takes_the_place_of_the_first(self):
        client, other = self.client(1), self.client(1)
        response, first = self.open(client, (signal("do2"), 2))
        second = self.socket(client, response)
        self.assertEqual(second.status, 101)
        self.assertIsNone(first.text())
        first.close()
        time.sleep(0.2)
        self.set_signal(other, "do2", 1)
        self.assertEqual(second.event().values["lvalue"], "1")
        self.set_signal(other, "do2", 0)

    def test_clients_that_send(self):
        """controller.md 2.4: 1.0 answers pings; 2.0 closes with 1008 when a client sends data."""
        for client in self.both():
            _, socket = self.open(client, OPMODE)
            socket.send_frame(9, b"are you there")
            self.assertEqual(socket.frame(), (10, b"are you there"))
            socket.send_frame(1, b"hello")
            if client.dialect == 2:
                self.assertIsNone(socket.text())
                self.assertEqual(socket.close_code, 1008)
            else:
                socket.send_frame(9, b"x")
                self.assertEqual(socket.frame(), (10, b"x"))

    def test_protocol_errors(self):
        """Contract 45: they close the socket, and the server lives on."""
        for client in self.both():
            for opcode, data, options in ((3, b"", {}), (1, b"x", {"mask": False}), (9, b"x" * 126, {}), (0, b"x", {}), (8, b"\x00", {})):
                _, socket = self.open(client, OPMODE)
                socket.send_frame(opcode, data, **options)
                self.assertIsNone(socket.text())
            self.assertEqual(client.get(OPMODE).status, 200)

    def test_farewell(self):
        client = self.client(1)
        _, socket = self.open(client, OPMODE)
        socket.send_frame(8, b"\x03\xe8")
        self.assertIsNone(socket.text())
        self.assertEqual(socket.close_code, 1000)


class Pings(SubscriptionCase):
    def test_pings(self):
        """controller.md 2.4: clients give up 40 s after the last frame, so a ping comes at least every 30 s."""
        sockets = [self.open(client, OPMODE)[1] for client in self.both()]
        begin = time.monotonic()
        for socket in sockets:
            opcode, data = socket.frame(30)
            self.assertEqual(opcode, 9)
            socket.send_frame(10, data)
        self.assertGreater(time.monotonic() - begin, 5)


class Events(SubscriptionCase):
    def test_high_priority_sends_every_change_in_order(self):
        """Contract 42."""
        for client in self.both():
            other = self.client(client.dialect)
            other.get(OPMODE)
            _, socket = self.open(client, (signal("do1"), 2), (signal("do2"), 2))
            begin = time.monotonic()
            for i in range(50):
                self.set_signal(other, "do1", 1 - i % 2)
            events = [socket.event() for _ in range(50)]
            self.assertEqual([event.values["lvalue"] for event in events], ["1", "0"] * 25)
            self.assertEqual({self.anchor(event) for event in events}, {signal("do1")})
            self.assertEqual({event.type for event in events}, {"ios-signalstate-ev"})
            self.assertLess(time.monotonic() - begin, 5 * SLOW)
            sent = time.monotonic()
            self.set_signal(other, "do2", 1)
            self.assertEqual(self.anchor(socket.event()), signal("do2"))
            self.assertLess(time.monotonic() - sent, 0.2 * SLOW)
            self.set_signal(other, "do2", 0)

    def test_middle_priority_merges(self):
        """Contract 42: one each 200 ms, and the last value always comes."""
        for client in self.both():
            other = self.client(1)
            _, socket = self.open(client, (SPEED, 1))
            begin = time.monotonic()
            for value in range(1, 61):
                self.set_speed(other, value)
            needed = time.monotonic() - begin
            values = []
            while not values or values[-1] != "60":
                values.append(socket.event().values["speedratio"])
            self.assertLessEqual(len(values), needed / 0.17 + 2)
            self.assertEqual(values, sorted(values, key=int))
            self.set_speed(other, 100)

    def test_low_priority_comes_within_five_seconds(self):
        client, other = self.client(2), self.client(1)
        _, socket = self.open(client, (SPEED, 0))
        begin = time.monotonic()
        for value in (11, 12, 13):
            self.set_speed(other, value)
        last = None
        while last != "13":
            last = socket.event(6 * SLOW).values["speedratio"]
        self.assertLess(time.monotonic() - begin, 5 * SLOW)
        self.set_speed(other, 100)

    def test_persistents(self):
        for client in self.both():
            path = "/rw/rapid/symbol/data/RAPID/T_ROB1/MainModule/count" if client.dialect == 1 else \
                "/rw/rapid/symbol/RAPID/T_ROB1/MainModule/count/data"
            _, socket = self.open(client, (path + ";value", 2))
            writer = self.client(1)
            for value in ("5", "7"):
                response = writer.post("/rw/rapid/symbol/data/RAPID/T_ROB1/MainModule/count?action=set", {"value": value})
                self.assertEqual(response.status, 204)
                event = socket.event()
                self.assertEqual(self.anchor(event), path + ";value")
                if "value" in event.values:
                    self.assertEqual(event.values["value"], value)

    def test_execution(self):
        for client in self.both():
            _, socket = self.open(client, "/rw/rapid/execution;ctrlexecstate")
            writer = self.client(1)
            writer.post("/rw/rapid/execution?action=stop", {"stopmode": "stop"})
            self.assertEqual(socket.event().values["ctrlexecstate"], "stopped")
            writer.post("/rw/rapid/execution?action=start", {
                "regain": "continue", "execmode": "continue", "cycle": "forever", "condition": "none", "stopatbp": "disabled",
                "alltaskbytsp": "false"})
            self.assertEqual(socket.event().values["ctrlexecstate"], "running")

    def test_event_log(self):
        """Contract 41: elog/0; the message is named by its address."""
        for client in self.both():
            _, socket = self.open(client, "/rw/elog/0")
            writer = self.client(1)
            writer.post("/rw/rapid/execution?action=stop", {"stopmode": "stop"})
            event = socket.event()
            self.assertEqual(event.type, "elog-message-ev")
            self.assertGreater(int(event.values["seqnum"]), 0)
            writer.post("/rw/rapid/execution?action=start", {
                "regain": "continue", "execmode": "continue", "cycle": "forever", "condition": "none", "stopatbp": "disabled",
                "alltaskbytsp": "false"})


class Changing(SubscriptionCase):
    def test_delete_ends_the_socket(self):
        """Contract 45."""
        for client in self.both():
            response, socket = self.open(client, OPMODE)
            group = "/subscription/" + response.header("location").rsplit("/", 1)[1]
            stranger = self.client(client.dialect)
            self.assertIn(stranger.delete(group).status, (403, 404))
            self.assertEqual(client.delete(group).status, 200)
            self.assertIsNone(socket.text())
            self.assertIn(client.delete(group).status, (400, 404))

    def test_the_reply_to_delete_comes_before_the_close(self):
        """A client that deletes its group in order to close the socket takes a close before the reply for a lost connection."""
        for client in self.both():
            response, socket = self.open(client, OPMODE)
            begin = time.monotonic()
            self.assertEqual(client.delete("/subscription/" + response.header("location").rsplit("/", 1)[1]).status, 200)
            replied = time.monotonic()
            self.assertIsNone(socket.text())
            closed = time.monotonic()
            self.assertGreater(closed - begin, 0.14)  # 150 ms after the group has ended, which the reply says
            self.assertLess(replied, closed)

    def test_put_adds_and_delete_removes(self):
        for client in self.both():
            response, socket = self.open(client, (signal("do1"), 2))
            other = self.client(client.dialect)
            other.get(OPMODE)
            group = "/subscription/" + response.header("location").rsplit("/", 1)[1]
            added = client.put(group, fields=[("resources", "1"), ("1", signal("do2")), ("1-p", "2")])
            self.assertIn(added.status, (200, 201, 204))
            self.set_signal(other, "do2", 1)
            self.assertEqual(self.anchor(socket.event()), signal("do2"))
            self.assertEqual(client.delete(group + signal("do1")).status, 200)
            self.set_signal(other, "do1", 1)
            self.set_signal(other, "do2", 0)
            self.assertEqual(self.anchor(socket.event()), signal("do2"))
            self.assertIn(client.delete(group + signal("do1")).status, (400, 404))
            self.assertIn(client.put(group, fields=[("resources", "1"), ("1", "/rw/unknown"), ("1-p", "1")]).status, (400, 404))
            self.set_signal(other, "do1", 0)

    def test_priorities_change(self):
        client, other = self.client(2), self.client(1)
        response, socket = self.open(client, (signal("do1"), 0))
        group = "/subscription/" + response.header("location").rsplit("/", 1)[1]
        self.assertEqual(client.put(group, fields=[("resources", "1"), ("1", signal("do1")), ("1-p", "2")]).status, 200)
        begin = time.monotonic()
        self.set_signal(other, "do1", 1)
        self.assertEqual(socket.event().values["lvalue"], "1")
        self.assertLess(time.monotonic() - begin, 1 * SLOW)
        self.set_signal(other, "do1", 0)


class SlowReaders(SubscriptionCase):
    def test_a_reader_that_does_not_read(self):
        """Contract 45: it costs others nothing."""
        lazy, reader, writer = self.client(1), self.client(1), self.client(1)
        many = [(signal("do1"), 2)]
        self.open(lazy, *many)
        _, socket = self.open(reader, *many)
        for i in range(400):
            self.set_signal(writer, "do1", 1 - i % 2)
            self.assertEqual(socket.event().values["lvalue"], str(1 - i % 2))
            if i % 250 == 249:
                time.sleep(1)  # contract 14: 300 requests in a second


if __name__ == "__main__":
    main()
