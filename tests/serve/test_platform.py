"""Resources around robot, signals and program, and those that a virtual controller lacks (facts 2.3, 2.5; RWS documentation)."""

import os
import ssl
import tempfile
import time
import unittest
import unittest.mock

from serve_testing import SLOW, Serve, ServeCase, main


SYS_WITH_HOME = """SYS:CFG_1.0:7:0::
#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -MotionTask

      -Name "T_BACK" -Type "SEMISTATIC"
#
CAB_TASK_MODULES:

      -File "HOME:/lib/Back.modx" -ModName "Back" -Task "T_BACK"
"""

SYS_OF_TWO = """SYS:CFG_1.0:7:0::
#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -MotionTask

      -Name "T_AUX" -Type "NORMAL"
#
CAB_TASK_MODULES:

      -File "HOME:/A.mod" -ModName "A" -Task "T_ROB1"

      -File "HOME:/B.mod" -ModName "B" -Task "T_AUX"
"""
MODULE_OF_TWO = """MODULE {0}
  PERS num n{0} := 0;
  PROC main()
    n{0} := n{0} + 1;
    WaitTime 0.1;
    n{0} := n{0} + 10;
    WaitTime 0.1;
  ENDPROC
  PROC other()
    n{0} := 100;
    WaitTime 0.2;
    n{0} := 200;
  ENDPROC
ENDMODULE
"""

class LargeRoutines(unittest.TestCase):
    """Contract 2: the line with the addresses is printed when the controller can be used; common clients wait 0.4 s for an answer."""

    CASE = """      CASE {0}:
        t := NumToStr(n + {0}, 2);
        IF StrLen(t) > {1} THEN
          i := StrFind(t, 1, "{1}");
          n := Round(Sqrt(Abs(i * {0}) + {0}) \\Dec:=2);
        ELSE
          n := Trunc(Pow({1} + 1, 2));
        ENDIF
"""
    MODULE = """MODULE M{0}
  LOCAL VAR num n := 0;
  PROC main()
    VAR string t;
    VAR num i;
    WHILE TRUE DO
      TEST n
{1}      ENDTEST
      WaitTime 0.1;
    ENDWHILE
  ERROR
    TRYNEXT;
  ENDPROC
ENDMODULE
"""

    def test_a_client_at_once(self):
        with tempfile.TemporaryDirectory(prefix="rapidc-serve-test-") as folder:
            paths = []
            for task in range(2):
                cases = "".join(self.CASE.format(1000 * task + number, number % 7) for number in range(300))
                paths.append(os.path.join(folder, f"M{task}.mod"))
                with open(paths[-1], "w", encoding="utf-8") as file:
                    file.write(self.MODULE.format(task, cases))
            # nothing that an earlier run has compiled
            with unittest.mock.patch.dict(os.environ, RAPIDC_CACHE=os.path.join(folder, "cache")):
                server = Serve(paths[0], options=(f"--task=T_AUX={paths[1]}",))
            try:
                client = server.client(1)
                start = time.monotonic()
                self.assertEqual(client.get("/rw/panel/opmode").status, 200)
                self.assertLess(time.monotonic() - start, 0.8 * SLOW) # it was 1.3 s on an idle machine
                client.close()
            finally:
                server.stop()


class Platform(ServeCase):
    OPTIONS = ("--no-program-start",)

    def test_safety_of_rws_2(self):
        # A7 reads four figures of the violation info as whole numbers, A10 the mode.
        client = self.client(2)
        violation = client.get("/ctrl/safety/violation").values("safety-violationinfo")
        for name in ("unsynchronized", "tool-pos-violation-status", "upper-arm-violation-status", "axis-range-violation-status"):
            self.assertEqual(violation[name], "0", name)
        self.assertEqual(client.get("/ctrl/safety/mode").values("safetymodestatus")["safetymode"], "active")
        startup = client.get("/ctrl/safety/config/startupstatus").values("startup-safety-config-load-satus")
        self.assertEqual(startup["config-status-at-startup"], "SCORCH_CONFIG_LOADED_AT_STARTUP")

    def test_brake_check_needs_a_drive_module(self):
        client = self.client(2)
        self.assertIn("status", client.get("/ctrl/safety/cbc?drivenum=1").values("cbc-status"))
        for query in ("", "?drivenum=0", "?drivenum=9", "?drivenum=x"):
            self.assertEqual(client.get("/ctrl/safety/cbc" + query).status, 400, query)

    def test_devices_are_a_tree(self):
        # A10: RWS 1.0 has the parts in the list "devices" of one entry, RWS 2.0 as entries; class dev-id-li in both.
        for client in self.both():
            def parts(path, client=client):
                entries = client.get("/rw/devices" + path).entries()
                if client.dialect == 1:
                    self.assertEqual(len(entries), 1)
                    entries = entries[0].nested
                self.assertEqual({entry.type for entry in entries}, {"dev-id-li"})
                return [entry.title for entry in entries]
            self.assertEqual(parts(""), ["HW_DEVICES", "SW_RESOURCES"])
            self.assertEqual(parts("/HW_DEVICES"), ["CONTROLLER", "MECHANICAL_UNITS"])
            self.assertEqual(parts("/hw_devices/mechanical_units"), ["ROB_1"])
            unit = client.get("/rw/devices/HW_DEVICES/MECHANICAL_UNITS/ROB_1").entries()
            properties = unit[0].nested if client.dialect == 1 else unit
            self.assertIn(("Kind", "Robot"), [(entry.values["name"], entry.values["value"]) for entry in properties])
            self.assertEqual(client.get("/rw/devices/HW_DEVICES/none").status, 404)
            found = client.act("/rw/devices", "search", {"property": "HW_DEVICES/CONTROLLER"}, "search")
            self.assertIn("CONTROLLER", [entry.title for entry in found.entries("dev-id-li")])
            self.assertEqual(client.act("/rw/devices", "search", {}, "search").status, 400)

    def test_certificate_store_holds_the_certificate_of_https(self):
        client = self.client(2)
        stores = [entry.values["store-name"] for entry in client.get("/ctrl/certstore").entries("ctrl-certstore-li")]
        self.assertEqual(stores, ["controller", "system"])
        inner = [entry.values["store-name"] for entry in client.get("/ctrl/certstore/system").entries("ctrl-certstore-li")]
        self.assertEqual(inner, ["robapi_store", "rws_store"])
        shown = client.get("/ctrl/certstore/system/rws_store").values("ctrl-certstore-cert")["cert-pem"]
        seen = ssl.get_server_certificate(("127.0.0.1", self.server.port("https")))
        self.assertEqual(shown.split(), seen.split())
        self.assertEqual(client.get("/ctrl/certstore/controller/trust_ca_store").entries(), [])
        self.assertEqual(client.get("/ctrl/certstore/nowhere").status, 404)
        self.assertEqual(client.delete("/ctrl/certstore/system").status, 403)

    def test_network_shows_where_clients_connect(self):
        # RWS 1.0: ctrl-netw with addr, mask and name
        interface = self.client(1).get("/ctrl/network").values("ctrl-netw")
        self.assertEqual((interface["addr"], interface["mask"]), ("127.0.0.1", "255.0.0.0"))

    def test_what_a_virtual_controller_does_not_support(self):
        for client in self.both():
            for path in ("/ctrl/compatibility/7", "/ctrl/syslog", "/ctrl/env", "/ctrl/systems", "/ctrl/compress"):
                response = client.get(path)
                self.assertEqual((response.status, response.code()), (404, -1073445885), path)
            self.assertEqual(client.get("/ctrl/diagnostics").status, 400)
            for path in ("/users/remoteuser",) + (("/rw/rapid/tasks/T_ROB1/execution", "/ctrl/backup/info") if client.dialect == 1 else ()):
                response = client.get(path)
                self.assertEqual((response.status, response.code()), (404, -1073445885), path)
        client = self.client(2)
        self.assertEqual(client.post("/ctrl/system/info", {"path": "x", "file-type": "y"}).status, 403)
        self.assertEqual(client.get("/uas/ldap/configuration").status, 403)
        self.assertEqual(len(client.get("/uas/ldap").entries()), 6)
        self.assertEqual(client.post("/rw/motionsystem/collisionavoidance/loadconfig").status, 403)

    def test_energy_is_not_measured(self):
        for client in self.both():
            before = client.get("/rw/system/energy").values("sys-energy-state")
            self.assertEqual((before["state"], before["accumulated-energy"]), ("-1", "0"))
            self.assertEqual(client.act("/rw/system/energy", "reset").status, 204)
            after = client.get("/rw/system/energy").values("sys-energy-state")
            self.assertEqual(int(after["change-count"]), int(before["change-count"]) + 1)

    def test_cameras_and_panel(self):
        for client in self.both():
            self.assertEqual(client.get("/rw/vision").values("number-of-cameras-li")["number-of-cameras"], "0")
            self.assertEqual(client.get("/rw/vision/Eye").status, 404)
        self.assertEqual(self.client(2).get("/rw/panel/enreq").values("pnl-enreq")["state"], "off")

    def test_instructions_by_subject(self):
        # A10: pallet-head has Name and Number, pallet/N the instructions with their parameters.
        client = self.client(2)
        heads = {entry.values["Name"]: entry.values["Number"] for entry in client.get("/rw/rapid/tasks/T_ROB1/pallet-head").entries("rap-pallet-head")}
        found = {entry.values["Name"]: entry.values["Parameter"]
                 for entry in client.get(f"/rw/rapid/tasks/T_ROB1/pallet/{heads['Move']}").entries("rap-pallet")}
        self.assertTrue(found["MoveL"].startswith("\\Conc ToPoint"), found["MoveL"])
        self.assertEqual(client.get("/rw/rapid/tasks/T_ROB1/pallet/999").status, 404)

    def test_options_names_the_methods_of_a_path(self):
        for client in self.both():
            response = client.request("OPTIONS", "/rw/panel/opmode")
            self.assertEqual((response.status, response.body), (204, b""))
            self.assertEqual(set(response.header("allow").split(",")), {"GET", "POST", "OPTIONS"})
            self.assertEqual(client.request("OPTIONS", "/rw/nowhere").status, 404)

    def test_every_return_code_is_listed(self):
        """Documentation of RWS 1.0, librws: li err-desc-li in the list, li err-desc for one code."""
        for client in self.both():
            codes = {entry.values["code"]: entry.values["name"] for entry in client.get("/rw/retcode").entries("err-desc-li")}
            self.assertEqual(codes["-1073445862"], "SYS_CTRL_E_RESOURCE_HELD")
            self.assertEqual(codes["-1073442816"], "SYS_CTRL_E_NO_SUCH_SYMBOL")
            self.assertEqual(codes["-1073445859"], "SYS_CTRL_E_MASTER_REJECT")
            one = client.get("/rw/retcode?code=-1073445859").values("err-desc")
            self.assertEqual(one["name"], codes["-1073445859"])

    def test_language_is_an_environment_variable(self):
        """Clients of 2.5, A8 (App SDK): pages for a pendant ask for $LANGUAGE before they show anything."""
        for client, member in zip(self.both(), ("_value", "value")):
            self.assertEqual(client.get("/ctrl/%24LANGUAGE").values("ctrl-env")[member], "en")
            self.assertEqual(client.get("/ctrl/$NOWHERE").status, 404)

    def test_virtual_time_counts_cycles(self):
        for client in self.both():
            slice_ = client.get("/ctrl/virtualtime/vttimeslice").values("ctrl-vttimeslice")
            self.assertEqual(slice_["vttimeslice"], "4")
            self.assertEqual((slice_["cycles"], slice_["missed-cycles"]), ("0", "0"))  # nothing has moved

    def test_documented_forms_of_virtual_time(self):
        client = self.client(1)  # RWS 1.0: POST without action, vtspeed= and vtstate=VT...
        self.assertEqual(client.post("/ctrl/virtualtime/vtspeed", {"vtspeed": "200"}).status, 204)
        self.assertEqual(client.get("/ctrl/virtualtime/vtspeed").values()["vtcurrspeed"], "200")
        self.assertEqual(client.post("/ctrl/virtualtime/vtspeed", {"vtspeed": "100"}).status, 204)
        self.assertEqual(client.post("/ctrl/virtualtime/vtstate", {"vtstate": "VTSTOP"}).status, 204)
        self.assertEqual(client.get("/ctrl/virtualtime/vtstate").values()["vtcurrstate"], "stopped")
        self.assertEqual(client.post("/ctrl/virtualtime/vtstate", {"vtstate": "VTFREERUN"}).status, 204)
        self.assertEqual(client.post("/ctrl/virtualtime/vtstate", {"vtstate": "VTX"}).status, 400)


class Kept(ServeCase):
    """These outlive the process: the certificate and changed system parameters (contract 4, 9)."""
    OPTIONS = ("--no-program-start",)

    def setUp(self):
        os.makedirs(f"{self.folder}/system", exist_ok=True)

    def run_once(self, action):
        server = Serve(self.inputs(), options=(f"--home={self.home}", f"--system-dir={self.folder}/system", "--no-program-start",
                                               f"--certificate-dir={self.folder}/certificate"))
        try:
            client = server.client(2)
            result = action(server, client)
            client.close()
            return result
        finally:
            self.assertEqual(server.stop(), 143)

    def inputs(self):
        return os.path.join(self.folder, "inputs")

    def test_two_normal_tasks(self):
        """Facts 2.3, pcp: each task has a pointer of its own; a step is one of every active NORMAL task, and ends when all have made it."""
        tasks = {"T_ROB1": "A", "T_AUX": "B"}
        os.makedirs(f"{self.home}", exist_ok=True)
        for name, text in (("SYS.cfg", SYS_OF_TWO), *((f"HOME/{m}.mod", MODULE_OF_TWO.format(m)) for m in tasks.values())):
            path = os.path.join(self.inputs(), "two", name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        server = Serve(os.path.join(self.inputs(), "two"), options=("--no-program-start", "--motors-on"))
        self.addCleanup(server.stop)
        client = server.client(2)
        order = lambda path, **fields: self.assertEqual(client.post(path, fields).status, 204)  # noqa: E731

        def state():
            pointers = [client.get(f"/rw/rapid/tasks/{task}/pcp").values("pcp-info")["beginposition"] for task in tasks]
            values = [client.get(f"/rw/rapid/symbol/RAPID/{task}/{m}/n{m}/data").values()["value"] for task, m in tasks.items()]
            return [int(each.split(",")[0]) for each in pointers], values

        def step():
            order("/rw/rapid/execution/start", regain="continue", execmode="stepover", cycle="forever", condition="none", stopatbp="enabled",
                  alltaskbytsp="false")
            self.eventually(lambda: client.get("/rw/rapid/execution").values()["ctrlexecstate"] == "stopped")

        order("/rw/mastership/edit/request")
        order("/rw/rapid/tasks/T_AUX/pcp/routine", module="B", routine="other", userlevel="FALSE")
        self.assertEqual(state(), ([4, 10], ["0", "0"]))
        order("/rw/rapid/tasks/T_ROB1/pcp/cursor", **{"module": "A", "begin-position-row": "6", "begin-position-col": "5"})
        self.assertEqual(state()[0], [6, 10])
        step()
        self.assertEqual(state(), ([7, 11], ["10", "100"]))
        step()  # WaitTime 0.1 and 0.2: the shorter one does not end the longer one
        self.assertEqual(state()[0][1], 12)
        order("/rw/rapid/tasks/deactivate", task="T_AUX")
        before = state()
        step()
        self.assertEqual((state()[0][1], state()[1][1]), (before[0][1], before[1][1]))
        self.assertNotEqual(state()[0][0], before[0][0])
        client.close()

    def test_certificate(self):
        def certificate(server, _):
            return ssl.get_server_certificate(("127.0.0.1", server.port("https")))
        self.assertEqual(self.run_once(certificate), self.run_once(certificate))
        self.assertEqual(os.stat(f"{self.folder}/certificate/server.pem").st_mode & 0o777, 0o600)

    def test_modules_that_the_configuration_loads_from_home(self):
        """6.2: CAB_TASK_MODULES with File "HOME:/x"; contract 4: $HOME is the folder of --home."""
        inputs, home = f"{self.folder}/configured", f"{self.folder}/own_home"
        texts = {f"{inputs}/SYS.cfg": SYS_WITH_HOME, f"{inputs}/Main.modx": "MODULE Main_1\n  PROC main()\n    Stop;\n  ENDPROC\nENDMODULE\n",
                 f"{home}/lib/Back.modx": "MODULE Back\n  PROC main()\n    WaitTime 1;\n  ENDPROC\nENDMODULE\n"}
        for name, text in texts.items():
            os.makedirs(os.path.dirname(name), exist_ok=True)
            with open(name, "w", encoding="utf-8") as file:
                file.write(text)
        server = Serve(inputs, options=(f"--home={home}", "--no-program-start"))
        client = server.client(1)
        try:
            self.assertEqual([entry.title for entry in client.get("/rw/rapid/tasks").entries("rap-task-li")], ["T_ROB1", "T_BACK"])
            modules = client.get("/rw/rapid/modules?task=T_BACK").entries("rap-module-info-li")
            self.assertIn("Back", [entry.values["name"] for entry in modules])
        finally:
            client.close()
            self.assertEqual(server.stop(), 143)

    def test_system_parameters(self):
        def create(_, client):
            self.assertEqual(client.post("/rw/mastership/edit/request").status, 204)
            made = client.post("/rw/cfg/EIO/EIO_SIGNAL/instances/create-default", {"name": "kept_do"})
            self.assertIn(made.status, (200, 201))
            changed = client.post("/rw/cfg/EIO/EIO_SIGNAL/instances/kept_do", {"SignalType": "[DO,1]"})
            self.assertEqual(changed.status, 204)
        def signal(_, client):
            return client.get("/rw/iosystem/signals/kept_do").status
        self.run_once(create)
        self.assertEqual(self.run_once(signal), 200)
        os.remove(f"{self.folder}/system/SYSPAR/EIO.cfg")  # docs/serve.md: back to the input's own
        self.assertEqual(self.run_once(signal), 404)


if __name__ == "__main__":
    main()
