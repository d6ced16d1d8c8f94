"""Mastership, RMMP, control stations (contract 22, 37 to 40; controller.md 2.1)."""

from rapid_testing import RapidCase, data
from serve_testing import main

HELD, NONE = -1073445862, -1073445859


class Mastership(RapidCase):
    MODULE = "MODULE M\n PERS num x := 1;\n PROC main()\n  Stop;\n ENDPROC\nENDMODULE\n"

    def write(self, client):
        return client.post(data(client.dialect, "T_ROB1/M/x") + ("?action=set" if client.dialect == 1 else ""), {"value": "2"})

    def test_domains(self):
        """controller.md 2.3: cfg, motion, rapid | edit, motion; contract 22: msh-resource: mastership; 38: nomaster."""
        for dialect, names in ((1, ["cfg", "motion", "rapid"]), (2, ["edit", "motion"])):
            client = self.client(dialect)
            self.assertEqual([entry.title for entry in client.get("/rw/mastership").entries("msh-resource-li")], names)
            for name in names:
                self.assertEqual(client.get(f"/rw/mastership/{name}").values("msh-resource")["mastership"], "nomaster")
            self.assertEqual(client.get("/rw/mastership/other").status, 404)
        self.in_all_forms("/rw/mastership/motion", "/rw/mastership/motion")

    def test_one_table(self):
        """Contract 37: 2.0's edit is 1.0's cfg and rapid; held by another session: 403, -1073445862."""
        old, new, other = self.client(1), self.client(2), self.client(2)
        self.assertEqual(new.post("/rw/mastership/edit/request").status, 204)
        for name, state in (("cfg", "remote"), ("rapid", "remote"), ("motion", "nomaster")):
            self.assertEqual(old.get(f"/rw/mastership/{name}").values()["mastership"], state)
        for response in (old.post("/rw/mastership/rapid?action=request"), old.post("/rw/mastership?action=request"),
                         other.post("/rw/mastership/edit/request"), self.write(old), self.write(other)):
            self.assertEqual((response.status, response.code()), (403, HELD))
        self.assertEqual(self.write(new).status, 204)
        self.assertEqual(old.post("/rw/mastership/motion?action=request").status, 204)
        self.assertEqual(new.post("/rw/mastership/motion/request").status, 403)
        self.assertEqual(new.post("/rw/mastership/edit/release").status, 204)
        self.assertEqual(old.get("/rw/mastership/cfg").values()["mastership"], "nomaster")
        self.assertEqual(old.post("/rw/mastership/motion?action=release").status, 204)

    def test_old_clients_need_none(self):
        """Contract 38: 1.0 writes while no other client holds the domain; 2.0 needs edit: 403, -1073445859."""
        self.assertEqual(self.write(self.client(1)).status, 204)
        response = self.write(self.client(2))
        self.assertEqual((response.status, response.code()), (403, NONE))

    def test_it_ends_with_the_connection(self):
        """Contract 38: in 1.0 mastership ends with the TCP connection."""
        client, other = self.client(1), self.client(1)
        self.assertEqual(client.post("/rw/mastership/rapid?action=request").status, 204)
        self.assertEqual(self.write(other).status, 403)
        client.disconnect()
        self.eventually(lambda: other.get("/rw/mastership/rapid").values()["mastership"] == "nomaster")
        self.assertEqual(self.write(other).status, 204)

    def test_it_ends_with_logout(self):
        """Contract 12: logout ends the session's mastership."""
        other = self.client(1)
        for client in self.both():
            name = "rapid" if client.dialect == 1 else "edit"
            self.assertEqual(client.act(f"/rw/mastership/{name}", "request").status, 204)
            self.assertEqual(self.write(other).status, 403)
            client.get("/logout", login=False)
            client.cookies = {}
            self.eventually(lambda: other.get("/rw/mastership/rapid").values()["mastership"] == "nomaster")

    def test_with_an_id(self):
        """Contract 38: request-with-id answers mastership-id and outlives the session."""
        client, other = self.client(2), self.client(2)
        number = client.post("/rw/mastership/edit/request-with-id").values()["mastership-id"]
        self.assertRegex(number, r"^\d+$")
        client.close()
        self.assertEqual(other.post("/rw/mastership/edit/request").status, 403)
        self.assertEqual(other.post("/rw/mastership/edit/release-with-id", {"mastershipid": "0"}).status, 400)
        self.assertEqual(other.post("/rw/mastership/edit/release-with-id", {"mastershipid": number}).status, 204)
        self.assertEqual(other.post("/rw/mastership/edit/request").status, 204)
        self.assertEqual(other.post("/rw/mastership/edit/release").status, 204)

    def test_names_of_other_versions(self):
        """37: one table for both dialects; A11 asks RobotWare 7 for "rapid". The id is released by the name that the reply has, too."""
        client = self.client(2)
        self.assertEqual(client.post("/rw/mastership/rapid/request").status, 204)
        self.assertEqual(self.client(1).get("/rw/mastership/rapid").values()["mastership"], "remote")
        self.assertEqual(self.client(1).get("/rw/mastership/cfg").values()["mastership"], "nomaster")
        self.assertEqual(client.post("/rw/mastership/rapid/release").status, 204)
        number = client.post("/rw/mastership/motion/request-with-id").values()["mastership-id"]
        self.assertEqual(client.post("/rw/mastership/motion/release-with-id", {"mastership-id": number}).status, 204)
        self.assertEqual(client.get("/rw/mastership/motion").values()["mastership"], "nomaster")

    def test_implicit(self):
        """controller.md 2.1, clients: ?mastership=implicit takes it for one request."""
        client = self.client(2)
        path = data(2, "T_ROB1/M/x") + "?mastership=implicit"
        self.assertEqual(client.post(path, {"value": "3"}).status, 204)
        other = self.client(1)
        self.assertEqual(other.post("/rw/mastership/rapid?action=request").status, 204)
        self.assertEqual(client.post(path, {"value": "4"}).status, 403)
        self.assertEqual(other.post("/rw/mastership/rapid?action=release").status, 204)

    def test_all_at_once(self):
        client = self.client(2)
        self.assertEqual(client.post("/rw/mastership/request").status, 204)
        self.assertEqual(client.get("/rw/mastership/motion").values()["mastership"], "remote")
        self.assertEqual(client.post("/rw/mastership/watchdog").status, 204)
        self.assertEqual(client.post("/rw/mastership/release").status, 204)
        self.assertEqual(client.get("/rw/mastership/motion").values()["mastership"], "nomaster")

    def test_what_needs_none_in_the_new_dialect(self):
        """Contract 38: none for start, stop, motors, mode; edit for program pointer, resetpp, cycle, modules, activate, breakpoints."""
        client = self.client(2)
        for path, form in (("/rw/panel/ctrl-state", {"ctrl-state": "motoron"}), ("/rw/rapid/execution/start", {}),
                           ("/rw/rapid/execution/stop", {"stopmode": "stop"}), ("/rw/panel/ctrl-state", {"ctrl-state": "motoroff"}),
                           ("/rw/panel/opmode", {"opmode": "auto"})):
            self.assertEqual(client.post(path, form).status, 204, path)
        task = "/rw/rapid/tasks/T_ROB1"
        for path, form in (("/rw/rapid/execution/resetpp", {}), ("/rw/rapid/execution/cycle", {"cycle": "once"}),
                           (f"{task}/pcp/routine", {"routine": "main"}), (f"{task}/loadmod", {"modulepath": "HOME/x.mod"}),
                           (f"{task}/unloadmod", {"module": "M"}), ("/rw/rapid/tasks/deactivate", {"task": "T_ROB1"}),
                           ("/rw/panel/speedratio", {"speed-ratio": "50"}),
                           (f"{task}/program/breakpoints", {"module": "M", "row": "4", "column": "1"}),
                           (f"{task}/modules/M/text", {"text": "x"})):
            response = client.post(path, form)
            self.assertEqual((response.status, response.code()), (403, NONE), path)

    def test_events(self):
        """Contract 41: mastership/D."""
        for client in self.both():
            name = "motion"
            response = client.subscribe(f"/rw/mastership/{name}")
            self.assertEqual(response.status, 201)
            self.assertEqual(response.values()["mastership"], "nomaster")
            socket = self.socket(client, response)
            client.act(f"/rw/mastership/{name}", "request")
            self.assertEqual(socket.event().values["mastership"], "remote")
            client.act(f"/rw/mastership/{name}", "release")
            self.assertEqual(socket.event().values["mastership"], "nomaster")

    def test_manual_mode(self):
        """Contract 39: in manual mode writes need the privilege of /users/rmmp, which is granted at once."""
        client = self.client(1)
        self.assertEqual(client.post("/rw/panel/opmode", {"opmode": "man"}).status, 204)
        self.addCleanup(client.post, "/rw/panel/opmode", {"opmode": "auto"})
        self.assertEqual(self.write(client).status, 403)
        self.assertEqual(self.write(self.master(2)).status, 403)
        self.assertIn(client.post("/users/rmmp", {"privilege": "modify"}).status, (200, 202, 204))
        self.assertEqual(client.get("/users/rmmp/poll").values("user-rmmp-poll")["status"], "GRANTED")
        self.assertEqual(client.get("/users/rmmp").values()["privilege"], "modify")
        self.assertEqual(client.post("/users/rmmp", {"privilege": "all"}).status, 400)


class ControlStation(RapidCase):
    """Contract 40."""

    OPTIONS = ("--no-program-start", "--robotware=8")
    MODULE = Mastership.MODULE

    def register(self, client, number="0"):
        return client.post("/rw/controlstation/register/remote", {
            "control-station-name": f"PC{number}", "pincode": "1234",
            "control-station-id": "{01234567-89ab-cdef-0123-456789abcde%s}" % number}).status

    def test_stations(self):
        client, other = self.client(2), self.client(2)
        for path in ("/rw/mastership", "/rw/mastership/edit"):
            self.assertEqual(client.get(path).status, 410)
        self.assertEqual(client.post("/rw/mastership/edit/request").status, 410)

        def write(who):
            return who.post(data(2, "T_ROB1/M/x"), {"value": "2"})
        codes = range(-1073435873, -1073435869)
        for register in (lambda: None, lambda: self.register(client)):
            register()
            response = write(client)
            self.assertEqual(response.status, 403)
            self.assertIn(response.code(), codes)
        self.assertEqual(client.post("/rw/controlstation/writeaccess/request").status, 204)
        self.assertEqual(write(client).status, 204)
        status = client.get("/rw/controlstation/writeaccess/status").values()
        self.assertEqual(status["control-station-write-access-held"], "true")
        self.assertEqual(status["held-by-control-station-name"], "PC0")
        self.assertEqual(self.register(other, "1"), 204)
        for response in (other.post("/rw/controlstation/writeaccess/request"), write(other)):
            self.assertEqual(response.status, 403)
            self.assertIn(response.code(), codes)
        self.assertEqual(client.post("/rw/controlstation/writeaccess/release").status, 204)
        self.assertEqual(other.post("/rw/controlstation/writeaccess/request").status, 204)
        self.assertEqual(other.post("/rw/controlstation/writeaccess/release").status, 204)

    def test_bad_registrations(self):
        client = self.client(2)
        good = {"control-station-name": "PC", "control-station-id": "{01234567-89ab-cdef-0123-456789abcdef}", "pincode": "1"}
        for name, value in (("control-station-id", "01234567-89ab-cdef-0123-456789abcdef"), ("control-station-name", ""),
                            ("pincode", "one")):
            self.assertEqual(client.post("/rw/controlstation/register/remote", {**good, name: value}).status, 400)

    def test_old_clients_see_robotware_6(self):
        self.assertEqual(self.client(1).get("/rw/mastership/rapid").values()["mastership"], "nomaster")


class WithoutStations(RapidCase):
    def test_below_8(self):
        """Contract 40: below 8: 404."""
        client = self.client(2)
        self.assertEqual(client.get("/rw/controlstation/writeaccess/status").status, 404)
        self.assertEqual(client.post("/rw/controlstation/writeaccess/request").status, 404)


if __name__ == "__main__":
    main()
