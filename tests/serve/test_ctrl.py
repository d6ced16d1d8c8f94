"""The controller itself: system, identity, clock, virtual time, backup, restart (contract 6, 22, 23, 26, 27, 31; facts 2.3, 6.3)."""

import os
import re
import subprocess
import time

from serve_testing import RAPIDC, SLOW, Serve, ServeCase, main

MODULE = """MODULE MainModule
  PERS num count := 5;
  PERS string label := "old";
  PROC main()
    VAR num turn;
    label := "new";
    count := 42;
    WHILE TRUE DO
      WaitTime 0.1;
      turn := turn + 1;
    ENDWHILE
  ENDPROC
ENDMODULE
"""


class System(ServeCase):
    def test_system(self):
        """Line 6: 1.0 says RobotWare 6 with four numbers; facts 2.3: the values of /rw/system."""
        for client in self.both():
            response = client.get("/rw/system")
            first = client.dialect == 1
            values = response.values("sys-system-li" if first else "sys-system")
            self.assertRegex(values["rwversionname"], r"^6\.\d+\.\d+\.\d+$" if first else r"^7\.\d+\.\d+$")
            self.assertRegex(values["sysid"], r"^\{[0-9A-F]{8}(-[0-9A-F]{4}){3}-[0-9A-F]{12}\}$")
            self.assertRegex(values["starttm"], r"^\d{4}-\d\d-\d\d T \d\d:\d\d:\d\d$")
            self.assertTrue(values["name"])
            if first:
                self.assertTrue(response.values("sys-option-li")["option"])
            else:
                options = response.entries("sys-options-li")[0]
                self.assertEqual({each.type for each in options.nested}, {"sys-options"})
                self.assertTrue(all(each.values["option"] for each in options.nested))

    def test_robot_type(self):
        """Line 22: sys-robottype: robot-type."""
        for client in self.both():
            self.assertIn("IRB 120", client.get("/rw/system/robottype").values("sys-robottype")["robot-type"])

    def test_identity(self):
        """Line 22: ctrl-identity-info; 26: /ctrl in resources, identity in state."""
        for client in self.both():
            for path in ("/ctrl", "/ctrl/identity"):
                self.assertEqual(client.get(path).values()["ctrl-type"], "Virtual Controller")
            self.assertRegex(client.get("/ctrl").entries()[1].values["datetime"], r"^\d{4}-\d\d-\d\d T \d\d:\d\d:\d\d$")
        client = self.client(2)
        # A8 looks for ctrl-identity-info-li among the entries of /ctrl
        self.assertEqual([entry.type for entry in client.get("/ctrl").entries()], ["ctrl-identity-info-li", "ctrl-clock-info-li"])
        self.assertIn("resources", client.get("/ctrl").json()["_embedded"])
        self.assertIn("state", client.get("/ctrl/identity").json())

    def test_return_codes(self):
        """Line 22: /rw/retcode?code=N: name code severity description."""
        for client in self.both():
            values = client.get("/rw/retcode?code=-1073445862").values()
            self.assertEqual((values["code"], values["severity"]), ("-1073445862", "Error"))
            self.assertTrue(values["name"] and values["description"])
            self.assertEqual(client.get("/rw/retcode?code=1").status, 404)
            self.assertEqual(client.get("/rw/retcode?code=x").status, 400)

    def test_clock(self):
        """Facts 2.3: /ctrl/clock GET and PUT."""
        for client in self.both():
            fields = dict(zip(("year", "month", "day", "hour", "min", "sec"), (2031, 2, 3, 4, 5, 6)))
            fields = {f"sys-clock-{name}": value for name, value in fields.items()}
            self.assertEqual(client.put("/ctrl/clock", fields=fields).status, 204)
            self.assertRegex(client.get("/ctrl/clock").values("ctrl-clock-info")["datetime"], r"^2031-02-03 T 04:05:\d\d$")
            self.assertEqual(client.put("/ctrl/clock", fields={**fields, "sys-clock-month": 13}).status, 400)
            self.assertEqual(client.put("/ctrl/clock", fields={**fields, "sys-clock-day": 30}).status, 400)

    def test_virtual_time(self):
        """Line 23."""
        for client in self.both():
            base = "/ctrl/virtualtime"

            def now(client=client):
                return int(client.get(base + "/vttime").values("ctrl-vttime")["vtcounter"])

            def state(running, client=client):
                if client.dialect == 1:
                    return client.post(f"{base}/vtstate?action={'run' if running else 'pause'}")
                return client.post(base + "/vtstate", {"vtcurrstate": "running" if running else "stopped"})

            def speed(value, client=client):
                return client.post(base + "/vtspeed" + ("?action=set" if client.dialect == 1 else ""), {"vtcurrspeed": value})

            self.assertEqual(client.get(base + "/vtstate").values()["vtcurrstate"], "running")
            self.assertEqual(client.get(base + "/vtspeed").values()["vtcurrspeed"], "100")
            self.assertTrue(client.get(base + "/vttimeslice").values()["vttimeslice"])
            self.assertEqual(state(False).status, 204)
            self.assertEqual(client.get(base + "/vtstate").values()["vtcurrstate"], "stopped")
            before = now()
            time.sleep(0.2)
            self.assertEqual(now(), before)
            self.assertEqual(state(True).status, 204)
            self.eventually(lambda: now() > before)
            self.assertEqual(speed(1000).status, 204)
            self.assertEqual(client.get(base + "/vtspeed").values()["vtcurrspeed"], "1000")
            virtual, wall = now(), time.monotonic()
            self.eventually(lambda: now() - virtual > 3000)
            self.assertLess(time.monotonic() - wall, 2.5 * SLOW)  # ten times as fast as the wall clock
            self.assertEqual(speed(100).status, 204)
            self.assertEqual(speed(-1).status, 400)


class Versions(ServeCase):
    OPTIONS = ("--robotware=8",)

    def test_robotware_8(self):
        """Line 6: --robotware chooses what 2.0 says; 1.0 always says 6."""
        self.assertRegex(self.client(2).get("/rw/system").values()["rwversionname"], r"^8\.")
        self.assertRegex(self.client(1).get("/rw/system").values()["rwversionname"], r"^6\.")


class Backup(ServeCase):
    MODULE = MODULE
    FILES = {"EIO.cfg": 'EIO:CFG_1.0:7:0::\n#\nEIO_SIGNAL:\n\n      -Name "doKept" -SignalType "DO"\n\n'
                        '      -Name "doBusy" -SignalType "DO"\n#\nSYSSIG_OUT:\n\n      -Status "BackupInProgress" -Signal "doBusy"\n',
             "tool.sysx": "MODULE tool(SYSMODULE)\n  PERS tooldata grip := [TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];\nENDMODULE\n"}

    def make(self, client, name):
        with open(os.path.join(self.home, "note.txt"), "w") as file:
            file.write("in HOME")
        self.eventually(lambda: self.client(1).get("/rw/rapid/symbol/data/RAPID/T_ROB1/MainModule/count").values()["value"] == "42")
        response = client.act("/ctrl/backup", "backup", {"backup": f"/fileservice/$BACKUP/{name}"}, action2="create")
        self.assertEqual(response.status, 202)
        return response

    def state(self, client):
        path = "/ctrl/backup?action=backupstate" if client.dialect == 1 else "/ctrl/backup/state"
        return client.get(path).values()["backup-state"]

    def test_backup(self):
        """Facts 2.3: 202 with Location of a progress resource, states; 6.3: the parts of a backup."""
        for client in self.both():
            name = f"copy{client.dialect}"
            response = self.make(client, name)
            location = re.sub(r"^\w+://[^/]*", "", response.header("location"))
            self.assertTrue(location.startswith("/progress/"))
            self.assertIn(self.state(client), ("Backup in Progress", "Backup Ready"))
            self.eventually(lambda: client.get(location).values()["state"] == "ready", 20)
            self.assertEqual(self.state(client), "Backup Ready")
            volume = "$BACKUP" if client.dialect == 1 else "BACKUP"
            files = {path: client.get(f"/fileservice/{volume}/{name}/{path}") for path in (
                "BACKINFO/backinfo.txt", "BACKINFO/version.xml", "BACKINFO/system.guid", "HOME/note.txt", "system.xml",
                "RAPID/TASK1/PROGMOD/MainModule.modx", "RAPID/TASK1/SYSMOD/tool.sysx", "SYSPAR/EIO.cfg", "SYSPAR/SYS.cfg")}
            for path, file in files.items():
                self.assertEqual(file.status, 200, path)
            module = files["RAPID/TASK1/PROGMOD/MainModule.modx"].body.decode()
            self.assertIn("PERS num count := 42;", module)
            self.assertIn('PERS string label := "new";', module)
            self.assertIn("doKept", files["SYSPAR/EIO.cfg"].body.decode())
            info = files["BACKINFO/backinfo.txt"].body.decode()
            for text in (">>SYSTEM_ID:", ">>TASK1: (T_ROB1,", "PROGMOD/MainModule.modx @", "SYSMOD/tool.sysx @", ">>EOF:"):
                self.assertIn(text, info)
            again = client.act("/ctrl/backup", "backup", {"backup": f"/fileservice/$BACKUP/{name}"}, action2="create")
            self.assertEqual(again.status, 409)

    def test_wrong_places(self):
        for client in self.both():
            for place in ("name", "/fileservice/$BACKUP", "/fileservice/$BACKUP/../../x", "/fileservice/$NOTHING/x", "",
                          "/fileservice/$BACKUP/no/such/x", "/tmp/x"):
                response = client.act("/ctrl/backup", "backup", {"backup": place}, action2="create")
                self.assertEqual(response.status // 100, 4, place)

    def test_system_output_of_a_backup(self):
        """docs/system_signals.md: BackupInProgress is 1 while a backup is being written."""
        client = self.client(1)
        response = client.subscribe(("/rw/iosystem/signals/doBusy;state", 2))
        socket = self.socket(client, response)
        self.make(client, "busy")
        self.assertEqual([socket.event().values["lvalue"] for _ in range(2)], ["1", "0"])

    def test_a_backup_runs(self):
        """Issue 20: a backup is taken by rapidc serve and rapidc run as one of a controller, with the same data."""
        client = self.client(2)
        self.make(client, "whole")
        self.eventually(lambda: self.state(client) == "Backup Ready", 20)
        folder = os.path.join(self.folder, "whole")
        self.fetch(client, "/fileservice/BACKUP/whole", folder)
        checked = subprocess.run([RAPIDC, "check", folder], capture_output=True, text=True)
        self.assertEqual(checked.returncode, 0, checked.stderr)
        server = Serve(folder, options=("--no-program-start",))
        try:
            other = server.client(1)
            self.assertEqual(other.get("/rw/rapid/symbol/data/RAPID/T_ROB1/MainModule/count").values()["value"], "42")
            self.assertEqual(other.get("/rw/iosystem/signals/doKept").status, 200)
            self.assertEqual(other.get("/fileservice/$HOME/note.txt").body, b"in HOME")
            own, copied = (each.get("/rw/system/robottype").values() for each in (self.client(1), other))
            self.assertEqual(own, copied)
            other.close()
        finally:
            server.stop()
            server.errors.close()

    def test_restore(self):
        """Issue 20 section 2: backup and restore. The program, the configuration and the files of HOME are those of the backup."""
        client = self.client(2)
        self.make(client, "back")
        self.eventually(lambda: self.state(client) == "Backup Ready", 20)
        self.assertEqual(client.post("/ctrl/backup/check-restore", {"backup": "/fileservice/$BACKUP/back"}).status, 200)
        self.assertEqual(client.post("/ctrl/backup/check-restore", {"backup": "/fileservice/$HOME/none"}).status, 404)
        self.assertEqual(client.put("/fileservice/HOME/note.txt", "other", headers={"Content-Type": "text/plain;v=2.0"}).status, 200)
        self.assertEqual(client.post("/ctrl/backup/restore", {"backup": "/fileservice/$BACKUP/back"}).status, 204)
        self.eventually(lambda: client.get("/fileservice/HOME/note.txt").body == b"in HOME", 10)
        self.eventually(lambda: client.get("/rw/iosystem/signals/doKept").status == 200, 10)
        value = lambda: self.client(1).get("/rw/rapid/symbol/data/RAPID/T_ROB1/MainModule/label").values()["value"]  # noqa: E731
        self.eventually(lambda: value() == '"new"', 10)

    def fetch(self, client, path, folder):
        os.makedirs(folder)
        for entry in client.get(path).entries():
            target = os.path.join(folder, entry.title)
            if entry.type == "fs-dir":
                self.fetch(client, f"{path}/{entry.title}", target)
                continue
            with open(target, "wb") as file:
                file.write(client.get(f"{path}/{entry.title}").body)


class Restart(ServeCase):
    FILES = {"EIO.cfg": 'EIO:CFG_1.0:7:0::\n#\nEIO_SIGNAL:\n\n      -Name "doOld" -SignalType "DO"\n'}

    def test_restart(self):
        """Line 31: the addresses stay, and the controller is back within 10 s; facts 2.3: changed parameters hold then."""
        client = self.client(2)
        client.post("/rw/mastership/edit/request")
        made = client.post("/rw/cfg/eio/EIO_SIGNAL/instances/create-default", {"name": "doNew"})
        self.assertEqual(made.status, 201)
        self.assertEqual(client.post("/rw/cfg/eio/EIO_SIGNAL/instances/doNew", {"SignalType": "[DO,1]"}).status, 204)
        self.assertEqual(client.get("/rw/iosystem/signals/doNew").status, 404)
        begin = time.monotonic()
        self.assertEqual(client.post("/ctrl/restart", {"restart-mode": "restart"}).status, 204)
        self.eventually(lambda: self.client(1).get("/rw/iosystem/signals/doNew").status == 200, 10)
        self.assertLess(time.monotonic() - begin, 10 * SLOW)
        other = self.client(1)
        self.assertEqual(other.get("/rw/iosystem/signals/doNew").values()["type"], "DO")
        self.assertEqual(other.get("/rw/iosystem/signals/doOld").status, 200)
        response = other.subscribe(("/rw/iosystem/signals/doNew;state", 2))
        socket = self.socket(other, response)
        other.act("/rw/iosystem/signals/doNew", "set", {"lvalue": 1})
        self.assertEqual(socket.event().values["lvalue"], "1")


class RestartThatFails(ServeCase):
    FILES = {"EIO.cfg": Restart.FILES["EIO.cfg"]}
    MODULE = "MODULE M\n  PROC main()\n    SetDO doOld, 1;\n    WaitTime 100;\n  ENDPROC\nENDMODULE\n"

    def test_the_program_needs_what_was_deleted(self):
        """Line 31: a restart is answered before the programs are compiled for the changed configuration. What has mistakes then is
        not taken (line 36): the controller stays as it was, and the event log says why."""
        client = self.client(2)
        self.assertEqual(client.post("/rw/mastership/edit/request").status, 204)
        signal = "/rw/cfg/eio/EIO_SIGNAL/instances/doOld"
        deleted = client.delete(signal)
        self.assertEqual(deleted.status, 204, deleted.body)
        self.assertEqual(client.post("/ctrl/restart", {"restart-mode": "restart"}).status, 204)

        def reason():
            entries = self.client(1).get("/rw/elog/0?lang=en").entries("elog-message-li")
            return next((entry.values["desc"] for entry in entries if entry.values["code"] == "10921"), "")
        self.eventually(lambda: "doOld" in reason(), 10)
        # Decision 132: sessions stay when the restart is refused.
        self.assertEqual(client.get("/rw/iosystem/signals/doOld", login=False).values()["lvalue"], "1")


if __name__ == "__main__":
    main()
