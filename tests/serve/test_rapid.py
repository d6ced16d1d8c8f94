"""Execution, tasks, pointers, modules, programs, breakpoints, dialogs, queues (controller.md 2.2 to 2.4; contract 22, 25, 31, 36, 41)."""

import os
import urllib.parse

from rapid_testing import RapidCase, data, program
from serve_testing import main

MODULE = """

MODULE M
  PERS num count := 0;
  PROC main()
    VAR num inner := 1;
    inner := inner + 1;
    count := inner;
    part;
    Stop;
    count := 10;
  ENDPROC
  PROC part()
    count := 5;
    WaitTime 0.3;
  ENDPROC
ENDMODULE
"""
EXTRA = "MODULE Extra\n  PERS num saved := 1;\n  PROC helper()\n    Stop;\n  ENDPROC\nENDMODULE\n"
TASK = "/rw/rapid/tasks/T_ROB1"


class States(RapidCase):
    MODULE = MODULE

    def test_states_in_all_forms(self):
        """2.3: rap-execution: ctrlexecstate cycle; tasks: rap-task-li; contract 21, 25, 26."""
        found = self.in_all_forms("/rw/rapid/execution", "/rw/rapid/execution")
        for entries in found.values():
            self.assertEqual(entries[0].type, "rap-execution")
            self.assertEqual(entries[0].values["ctrlexecstate"], "stopped")
            self.assertEqual(entries[0].values["cycle"], "forever")
        found = self.in_all_forms("/rw/rapid/tasks", "/rw/rapid/tasks")
        for dialect, wanted in ((1, ("norm", "link", "read")), (2, ("normal", "linked", "ready"))):
            entry = found[dialect][0]
            self.assertEqual(entry.type, "rap-task-li")
            self.assertEqual((entry.values["type"], entry.values["taskstate"], entry.values["excstate"]), wanted)
            self.assertEqual([entry.values[name] for name in ("name", "active", "motiontask")], ["T_ROB1", "On", "TRUE"])
        self.assertEqual([entry.type for entry in found[2]], ["rap-task-li", "rap-tasks-spy-li"])
        self.in_all_forms(TASK, TASK)
        self.assertEqual(self.client(2).get(TASK).json()["state"][0]["_type"], "rap-task")
        self.assertEqual(len(self.client(2).get("/rw/rapid/tasks").json()["_embedded"]["resources"]), 2)
        self.assertEqual(self.client(2).get("/rw/rapid/tasks/T_NONE").status, 404)


class Execution(RapidCase):
    MODULE = MODULE

    def position(self, client, title="progpointer"):
        entry = next(entry for entry in client.get(f"{TASK}/pcp").entries("pcp-info") if entry.title == title)
        return entry.values

    def wait_position(self, client, position):
        self.eventually(lambda: self.position(client)["beginposition"] == position, message=f"the pointer is not at {position}")

    def reset(self, client):
        self.assertEqual(client.act("/rw/rapid/execution", "resetpp").status, 204)
        self.wait_position(client, "7,5")

    def test_pointers(self):
        """25: two li pcp-info; positions are those of the instruction that comes next; 2.3: modulemame."""
        for client in self.masters():
            self.reset(client)
            entries = client.get(f"{TASK}/pcp").entries()
            self.assertEqual([(entry.type, entry.title) for entry in entries], [("pcp-info", "progpointer"), ("pcp-info", "motionpointer")])
            self.assertEqual([entries[0].values[name] for name in ("modulemame", "routinename", "beginposition", "endposition")],
                             ["M", "main", "7,5", "7,23"])
            self.assertEqual(self.start(client, cycle="once").status, 204)
            self.wait_stopped(client)
            self.wait_position(client, "11,5")  # after the Stop in line 10
            self.assertEqual(client.act("/rw/rapid/execution", "start", {"regain": "continue"}).status, 204)
            self.eventually(lambda: self.value("T_ROB1/M/count") == "10")
            self.reset(client)
        self.in_all_forms(f"{TASK}/pcp", f"{TASK}/pcp")

    def test_moving_the_pointer(self):
        """31: set-pp-routine | pcp/routine, pcp/cursor (module, begin-position-row, begin-position-col), pcp/reset."""
        for client in self.masters():
            self.reset(client)
            frame = client.get(f"{TASK}/activation-record?stackframe=0").values()
            self.assertEqual((frame["modulename"], frame["routinename"], frame["begposition"]), ("M", "main", "7,5"))
            self.assertEqual(client.get(f"{TASK}/activation-record?stackframe=9").status, 400)
            for form in ({"module": "M", "routine": "part", "userlevel": "false"}, {"routine": "main"}):
                self.assertEqual(client.act(f"{TASK}/pcp", "set-pp-routine", form, "routine").status, 204)
                self.eventually(lambda: self.position(client)["routinename"] == form["routine"])
            url = {"routineurl": "RAPID/T_ROB1/M/part"}
            self.assertEqual(client.act(f"{TASK}/pcp", "set-pp-routine-from-url", url, "routine-from-url").status, 204)
            self.wait_position(client, "14,5")
            for form in ({"module": "M", "routine": "none"}, {"module": "M"}, {}):
                self.assertEqual(client.act(f"{TASK}/pcp", "set-pp-routine", form, "routine").status, 400)
            self.assertEqual(self.start(client, cycle="once").status, 204)
            self.wait_stopped(client)
            self.reset(client)
            form = {"module": "M", "begin-position-row": "9", "begin-position-col": "5"}
            self.assertEqual(client.act(f"{TASK}/pcp", "set-pp-cursor", form, "cursor").status, 204)
            self.wait_position(client, "9,5")
            for name, value in (("begin-position-row", "1"), ("begin-position-row", "x"), ("module", "None")):
                self.assertEqual(client.act(f"{TASK}/pcp", "set-pp-cursor", {**form, name: value}, "cursor").status, 400)
        client = self.master(2)
        self.assertEqual(client.post(f"{TASK}/pcp/reset").status, 204)
        self.wait_position(client, "7,5")

    def test_to_the_next_and_the_previous_instruction(self):
        """RWS documentation: pcp?action=set-pp-next-inst and set-pp-prev-inst."""
        client = self.master(1)
        self.reset(client)
        first = self.position(client)["beginposition"]
        self.assertEqual(client.act(f"{TASK}/pcp", "set-pp-next-inst").status, 204)
        self.eventually(lambda: self.position(client)["beginposition"] != first)
        self.assertEqual(client.act(f"{TASK}/pcp", "set-pp-prev-inst").status, 204)
        self.eventually(lambda: self.position(client)["beginposition"] == first)

    def test_questions_about_a_task(self):
        """RWS documentation: tasks/T?resource=task-sync-state, pallet-head and pallet; execution?action=holdtorun-state."""
        client = self.client(1)
        for path in ("/rw/rapid/tasks", TASK):
            for which, span in (("program-pointer", "Program-Pointer-State"), ("motion-pointer", "Motion-Pointer-State")):
                found = client.get(f"{path}?resource=task-sync-state&type={which}").values("rap-sync-state")
                self.assertEqual(found, {span: "On"})
            self.assertEqual(client.get(f"{path}?resource=task-sync-state").status, 400)
        heads = [entry.values for entry in client.get(f"{TASK}?resource=pallet-head").entries("rap-pallet-head")]
        self.assertEqual([head["Number"] for head in heads], [str(number + 1) for number in range(len(heads))])
        names = [entry.values["Name"] for head in heads
                 for entry in client.get(f"{TASK}?resource=pallet&number={head['Number']}").entries("rap-pallet")]
        self.assertIn("MoveJ", names)
        self.assertEqual(client.get(f"{TASK}?resource=pallet&number=0").status, 404)
        self.assertEqual(client.get(f"{TASK}?resource=odd").status, 400)
        self.assertEqual(client.post("/rw/rapid/execution?action=holdtorun-state", {"state": "press"}).status, 204)

    def test_to_a_line_right_after_to_another_routine(self):
        """25 and 31: pcp/cursor holds whatever the order before it was, and pcp shows it at once."""
        client = self.master(1)
        self.reset(client)
        for _ in range(30):
            form = {"module": "M", "routine": "part"}
            self.assertEqual(client.act(f"{TASK}/pcp", "set-pp-routine", form).status, 204)
            form = {"module": "M", "begin-position-row": "7", "begin-position-col": "5"}
            self.assertEqual(client.act(f"{TASK}/pcp", "set-pp-cursor", form).status, 204)
            self.assertEqual(self.position(client)["beginposition"], "7,5")
        self.wait_stopped(client)
        self.wait_position(client, "7,5")

    def test_start_and_stop(self):
        """2.3: forms of start and stop; 2.2: -1073442809 start refused (400)."""
        for client in self.masters():
            self.reset(client)
            path = "/rw/panel/ctrlstate?action=setctrlstate" if client.dialect == 1 else "/rw/panel/ctrl-state"
            client.post(path, {"ctrl-state": "motoroff"})
            response = client.act("/rw/rapid/execution", "start", {"regain": "continue", "execmode": "continue"})
            self.assertEqual((response.status, response.code()), (400, -1073442809))
            for name, value in (("execmode", "jump"), ("regain", "x"), ("cycle", "twice"), ("condition", "x"), ("stopatbp", "x"),
                                ("alltaskbytsp", "x")):
                self.assertEqual(self.start(client, **{name: value}).status, 400, name)
            self.assertEqual(client.act("/rw/rapid/execution", "stop", {"stopmode": "jump"}).status, 400)
            self.assertEqual(client.act("/rw/rapid/execution", "stop", {"stopmode": "stop", "usetsp": "normal"}).status, 204)
            self.assertEqual(self.start(client).status, 204)
            self.wait_stopped(client)
            for cycle in ("once", "forever"):
                self.assertEqual(client.act("/rw/rapid/execution", "setcycle", {"cycle": cycle}, "cycle").status, 204)
                self.assertEqual(self.state(client, "/rw/rapid/execution", "cycle"), cycle)
            self.assertEqual(client.act("/rw/rapid/execution", "setcycle", {"cycle": "x"}, "cycle").status, 400)
            self.assertEqual(client.act("/rw/rapid/execution", "startprodentry").status, 204)
            self.eventually(lambda: self.value("T_ROB1/M/count") == "5")
            self.wait_stopped(client)

    def test_steps(self):
        """controller.md 5: RWS step modes give remote clients the steps of a debugger."""
        client = self.client(1)
        self.reset(client)
        self.assertEqual(self.start(client, execmode="stepin").status, 204)
        self.wait_position(client, "8,5")
        self.wait_stopped(client)
        self.assertEqual(client.act("/rw/rapid/execution", "start", {"execmode": "stepover"}).status, 204)
        self.wait_position(client, "9,5")
        self.wait_stopped(client)
        self.assertEqual(client.act("/rw/rapid/execution", "start", {"execmode": "stepin"}).status, 204)
        self.wait_position(client, "14,5")
        self.wait_stopped(client)
        self.assertEqual(client.act("/rw/rapid/execution", "start", {"execmode": "stepout"}).status, 204)
        self.wait_position(client, "10,5")
        self.wait_stopped(client)
        self.reset(client)

    def test_breakpoints(self):
        """31: (2.0) POST program/breakpoints module row column, DELETE with the same in the query."""
        client = self.master(2)
        path = f"{TASK}/program/breakpoints"
        self.reset(client)
        self.assertEqual(client.get(path).entries(), [])
        self.assertEqual(client.post(path, {"module": "M", "row": "9", "column": "1"}).status, 204)
        for wrong in ({"module": "M", "row": "1", "column": "1"}, {"module": "N", "row": "9"}, {"module": "M", "row": "x"}):
            self.assertEqual(client.post(path, wrong).status, 400)
        found = client.get(path).values("rap-breakpoint-li")
        self.assertEqual([found[name] for name in ("module", "row", "column")], ["M", "9", "1"])
        self.assertEqual(self.start(client, stopatbp="enabled").status, 204)
        self.wait_position(client, "9,5")
        self.wait_stopped(client)
        self.reset(client)  # stopatbp=disabled is of one start
        self.assertEqual(self.start(client, stopatbp="disabled").status, 204)
        self.wait_stopped(client)
        self.assertEqual(self.position(client)["beginposition"], "11,5")  # after Stop
        self.reset(client)
        self.assertEqual(self.start(client).status, 204)
        self.wait_stopped(client)
        self.assertEqual(self.position(client)["beginposition"], "9,5")
        self.assertEqual(client.delete(path + "?module=M&row=9&column=1").status, 204)
        self.assertEqual(client.delete(path + "?module=M&row=9&column=1").status, 400)
        self.assertEqual(client.get(path).entries(), [])

    def test_link_and_build_need_a_task(self):
        """2.3: what is named in the path and is not there is an error."""
        for client in self.masters():
            for name in ("link", "build"):
                self.assertEqual(client.act(TASK, name, {}, name).status, 204)
                self.assertIn(client.act("/rw/rapid/tasks/T_NONE", name, {}, name).status, (400, 404))

    def test_activation(self):
        """31: tasks/T ?action=activate | tasks/activate form task."""
        for client in self.masters():
            self.reset(client)
            for name, state in (("deactivate", "Off"), ("activate", "On")):
                if client.dialect == 1:
                    response = client.post(f"{TASK}?action={name}")
                else:
                    response = client.post(f"/rw/rapid/tasks/{name}", {"task": "T_ROB1"})
                self.assertEqual(response.status, 204)
                self.assertEqual(client.get("/rw/rapid/tasks").values("rap-task-li")["active"], state)
        self.assertEqual(self.client(1).post("/rw/rapid/tasks/T_NONE?action=activate").status, 404)
        self.assertEqual(self.client(1).post("/rw/rapid/tasks?action=activate").status, 204)

    def test_events(self):
        """2.4, 41: ctrlexecstate, rapidexeccycle, programpointerchange, taskchange."""
        for client in self.both():
            writer = self.client(1)
            self.reset(writer)
            writer.post("/rw/rapid/execution?action=setcycle", {"cycle": "forever"})
            response = client.subscribe(("/rw/rapid/execution;ctrlexecstate", 2), ("/rw/rapid/execution;rapidexeccycle", 2),
                                        f"{TASK}/pcp;programpointerchange", f"{TASK};taskchange", "/rw/rapid/tasks;taskchange")
            self.assertEqual(response.status, 201, response)
            first = {entry.type: entry.values for entry in response.entries()}
            self.assertEqual(first["rap-ctrlexecstate-ev"]["ctrlexecstate"], "stopped")
            self.assertEqual(first["rap-execcycle-ev"]["rapidexeccycle"], "forever")
            self.assertEqual((first["rap-pp-ev"]["module-name"], first["rap-pp-ev"]["BegPosLine"]), ("M", "7"))
            socket = self.socket(client, response)
            self.assertEqual(self.start(writer, cycle="once").status, 204)
            seen = []
            while ("rap-ctrlexecstate-ev", "stopped") not in seen:
                event = socket.event()
                seen.append((event.type, event.values.get("ctrlexecstate") or event.values.get("rapidexeccycle") or
                             event.values.get("BegPosLine") or event.values.get("excstate")))
            self.assertIn(("rap-ctrlexecstate-ev", "running"), seen)
            self.assertIn(("rap-execcycle-ev", "once"), seen)
            self.eventually(lambda: any(event.type == "rap-pp-ev" for event in socket.events_within(0.3)) or
                            ("rap-pp-ev", "11") in seen)

    def test_event_of_a_pointer_that_is_moved(self):
        """2.4: tasks/T/pcp;programpointerchange, even when a client moves the pointer of a stopped program."""
        for client in self.both():
            writer = self.client(1)
            self.reset(writer)
            socket = self.socket(client, client.subscribe(f"{TASK}/pcp;programpointerchange"))
            for routine in ("part", "main", "part"):
                form = {"module": "M", "routine": routine, "userlevel": "TRUE"}
                self.assertEqual(writer.post(f"{TASK}/pcp?action=set-pp-routine", form).status, 204)
                event = socket.event()
                self.assertEqual((event.type, event.values["routine-name"]), ("rap-pp-ev", routine))

    def test_count_of_resources(self):
        """2.5, A10: its clients write the number of resources into the field `resources`."""
        for client in self.both():
            panel = "/rw/panel/ctrlstate" if client.dialect == 1 else "/rw/panel/ctrl-state"
            response = client.post("/subscription", {"resources": "3", "1": "/rw/rapid/execution;ctrlexecstate", "1-p": "1",
                                                     "2": panel, "2-p": "1", "3": f"{TASK};taskchange", "3-p": "1"})
            self.assertEqual(sorted(entry.type for entry in response.entries()),
                             ["pnl-ctrlstate-ev", "rap-ctrlexecstate-ev", "rap-task-change-ev"])

    def test_counters_and_routines(self):
        """22: (2.0) structural-changecount rap-task-struc-change-count: change-count; 2.3: serviceroutine, builderror."""
        client = self.client(2)
        self.assertRegex(client.get(f"{TASK}/structural-changecount").values("rap-task-struc-change-count")["change-count"], r"^\d+$")
        names = [entry.values["routine-name"] for entry in client.get(f"{TASK}/serviceroutine").entries("rap-task-routine")]
        self.assertEqual(sorted(names), ["main", "part"])
        self.assertEqual(client.get(f"{TASK}/builderror").entries(), [])
        for path in ("/rw/rapid", "/rw/rapid/symbols", "/rw/rapid/uiinstr", "/rw/dipc"):
            for each in self.both():
                self.assertEqual(each.get(path).status, 200, path)


class StepsTogether(RapidCase):
    """Two robots between SyncMoveOn and SyncMoveOff."""
    MODULE = program("together1.modx")
    OPTIONS = (*RapidCase.OPTIONS, "--task=T_ROB2=" + os.path.join(os.path.dirname(__file__), "programs", "together2.modx"))

    def line(self, client, task):
        entries = client.get(f"/rw/rapid/tasks/{task}/pcp").entries("pcp-info")
        return int(next(entry for entry in entries if entry.title == "progpointer").values["beginposition"].split(",")[0])

    def test_step_back(self):
        """Decision 131: one stepback is one step of each task; those whose robots move together come back together."""
        for client in self.masters():
            self.assertEqual(client.act("/rw/rapid/execution", "resetpp").status, 204)
            self.assertEqual(self.start(client).status, 204)
            stop = program("together1.modx").splitlines().index("    Stop \\AllMoveTasks;") + 1
            self.wait_stopped(client)
            # The pointers go above the third movement; the next step moves the robots. Both modules have the movements in the same lines.
            for line in (stop - 2, stop - 3):
                self.assertEqual(self.start(client, execmode="stepback").status, 204)
                self.wait_stopped(client)
                for task in ("T_ROB1", "T_ROB2"):
                    self.eventually(lambda: self.line(client, task) == line, message=f"{task} is not in line {line}")


class Modules(RapidCase):
    MODULE = MODULE
    FILES = {"Sys.sysx": "MODULE Sys(SYSMODULE)\n  PERS num x := 1;\nENDMODULE\n"}

    def setUp(self):
        super().setUp()
        for name, text in (("Extra.mod", EXTRA), ("Wrong.mod", "MODULE Wrong\n  PROC wrong()\n    none := 1;\n  ENDPROC\nENDMODULE\n")):
            with open(os.path.join(self.home, name), "w", encoding="utf-8") as file:
                file.write(text)

    def path(self, client, module=None):
        if client.dialect == 1:
            return "/rw/rapid/modules" + (f"/{module}" if module else "") + "?task=T_ROB1"
        return f"{TASK}/modules" + (f"/{module}" if module else "")

    def names(self, client):
        return [entry.values["name"] for entry in client.get(self.path(client)).entries("rap-module-info-li")]

    def test_list_and_text(self):
        """2.3: rap-module-info-li: name, type; rap-module-text: module-text exact, leading blank lines kept."""
        for client in self.both():
            found = {entry.values["name"]: entry.values["type"] for entry in client.get(self.path(client)).entries()}
            self.assertEqual(found, {"M": "ProgMod", "Sys": "SysMod"})
            text = client.get(self.path(client, "M") + ("&resource=module-text" if client.dialect == 1 else "/text"))
            self.assertEqual(text.values("rap-module-text")["module-text"], MODULE)
            self.assertRegex(text.values()["change-count"], r"^\d+$")
            response = client.get(self.path(client, "None"))
            self.assertEqual((response.status, response.code()), (400, -1073442813))
            self.assertEqual(client.get(self.path(client, "M")).values("rap-module")["modname"], "M")
        client = self.client(2)
        path = f"{TASK}/modules/M/text"
        self.assertEqual(client.get(f"{path}/range?startrow=3&startcol=1&endrow=3&endcol=6").values("rap-mod-text")["text"], "MODULE")
        found = client.get(f"{path}/search?text=count").entries("rap-text-position")
        self.assertEqual((found[0].values["Row"], found[0].values["Column"]), ("4", "12"))
        self.in_all_forms("/rw/rapid/modules?task=T_ROB1", f"{TASK}/modules")

    def test_loading(self):
        """36: without replace=true, with mistakes, without a file: 400; the program stays as it was."""
        for client in self.masters():
            def load(path, **more):
                return client.act(TASK, "loadmod", {"modulepath": path, **more})
            volume = "$HOME/" if client.dialect == 1 else "HOME/"
            before = self.names(client)
            self.assertEqual(load(volume + "Wrong.mod").status, 400)
            for path in (volume + "none.mod", volume + "../Extra.mod", "NONE/Extra.mod", volume + "%2e%2e/x", volume, ""):
                response = load(path)
                self.assertEqual(response.status, 400, path)
            self.assertEqual(load(volume + "none.mod").code(), -1073438708)
            self.assertEqual(self.names(client), before)
            self.assertEqual(load(volume + "Extra.mod").status, 204)
            self.assertEqual(self.names(client), before + ["Extra"])
            self.assertEqual(load(volume + "Extra.mod").status, 400)
            self.assertEqual(load(volume + "Extra.mod", replace="false").status, 400)
            self.assertEqual(load(volume + "Extra.mod", replace="true").status, 204)
            self.assertEqual(self.value("T_ROB1/Extra/saved"), "1")
            self.assertEqual(client.act(TASK, "unloadmod", {"module": "Extra"}).status, 204)
            response = client.act(TASK, "unloadmod", {"module": "Extra"})
            self.assertEqual(response.status, 400)
            self.assertEqual(self.names(client), before)

    def test_saving(self):
        """31: module ?action=save form name, path | tasks/T/modules/M/save; clients: .mod | .modx; values of persistents are saved."""
        for client in self.masters():
            self.assertEqual(client.act(TASK, "loadmod", {"modulepath": "$HOME/Extra.mod"}).status, 204)
            self.reader().post(data(1, "T_ROB1/Extra/saved") + "?action=set", {"value": "7"}) if client.dialect == 1 else \
                client.post(data(2, "T_ROB1/Extra/saved"), {"value": "7"})
            form = {"name": f"Copy{client.dialect}", "path": "$HOME" if client.dialect == 1 else "HOME:"}
            self.assertEqual(client.act(self.path(client, "Extra"), "save", form).status, 204)
            name = "Copy1.mod" if client.dialect == 1 else "Copy2.modx"
            with open(os.path.join(self.home, name), encoding="utf-8") as file:
                self.assertEqual(file.read(), EXTRA.replace("saved := 1", "saved := 7"))
            for wrong in ({"name": "a/b", "path": "$HOME"}, {"name": "x", "path": "$NONE"}, {"name": "x", "path": "$HOME/.."}):
                self.assertEqual(client.act(self.path(client, "Extra"), "save", wrong).status, 400)
            self.assertEqual(client.act(TASK, "unloadmod", {"module": "Extra"}).status, 204)

    def test_changing_text(self):
        """2.3: text GET and set, ranges; what has mistakes is refused and the text stays."""
        for client in self.masters():
            path = self.path(client, "M")
            read = path + ("&resource=module-text" if client.dialect == 1 else "/text")
            write = path + ("&action=set-module-text" if client.dialect == 1 else "/text")
            changed = MODULE.replace("count := 10", "count := 11")
            self.assertEqual(client.post(write, {"task": "T_ROB1", "text": MODULE.replace("ENDMODULE", "")}).status, 400)
            self.assertEqual(client.get(read).values()["module-text"], MODULE)
            self.assertEqual(client.post(write, {"task": "T_ROB1", "text": changed}).status, 204)
            self.assertEqual(client.get(read).values()["module-text"], changed)
            write = path + ("&action=set-text-range" if client.dialect == 1 else "/text/range")
            form = {"task": "T_ROB1", "replace-mode": "Replace", "query-mode": "Force", "startrow": "11", "startcol": "14", "endrow": "11",
                    "endcol": "15", "text": "10"}
            self.assertEqual(client.post(write, form).status, 204)
            self.assertEqual(client.get(read).values()["module-text"], MODULE)
            self.assertEqual(client.post(write, {**form, "startrow": "99"}).status, 400)

    def test_loaded_modules_stay(self):
        """Program memory outlives a change of another module and a warm restart (issue 20, section 1: warm, cold), with values of persistents;
        only an unload, another program or a cold restart takes a module away."""
        for client in self.masters():
            self.assertEqual(client.act(TASK, "loadmod", {"modulepath": "$HOME/Extra.mod"}).status, 204)
            symbol = data(client.dialect, "T_ROB1/Extra/saved")
            form = symbol + ("?action=set" if client.dialect == 1 else "")
            self.assertEqual(client.post(form, {"value": "7"}).status, 204)
            write = self.path(client, "M") + ("&action=set-module-text" if client.dialect == 1 else "/text")
            self.assertEqual(client.post(write, {"task": "T_ROB1", "text": MODULE + "! changed\n"}).status, 204)
            self.eventually(lambda: "changed" in self.text(client, "M"))
            self.assertIn("Extra", self.names(client))
            self.assertEqual(self.value("T_ROB1/Extra/saved"), "7")
            restart = "/rw/panel?action=restart" if client.dialect == 1 else "/ctrl/restart"
            self.assertEqual(client.post(restart, {"restart-mode": "restart"}).status, 204)
            client = self.master(client.dialect)
            self.eventually(lambda: "Extra" in self.names(client))
            self.assertEqual(client.get(symbol).values("rap-data")["value"], "7")
            self.assertEqual(self.text(client, "Extra"), EXTRA)
            self.assertEqual(client.act(TASK, "unloadmod", {"module": "Extra"}).status, 204)
            self.assertNotIn("Extra", self.names(client))
            self.assertEqual(client.post(write, {"task": "T_ROB1", "text": MODULE}).status, 204)

    def text(self, client, module):
        return client.get(self.path(client, module) + ("&resource=module-text" if client.dialect == 1 else "/text")).values()["module-text"]

    def test_programs(self):
        """2.3: program load progpath loadmode, save; 22: rap-program: name entrypoint."""
        for client in self.masters():
            program = f"{TASK}/program"
            self.assertEqual(client.get(program).values("rap-program")["entrypoint"], "main")
            folder = f"$HOME/saved{client.dialect}"
            self.assertEqual(client.act(program, "setname", {"name": "Shop"}, "name").status, 204)
            self.assertEqual(client.act(program, "save", {"path": folder}).status, 204)
            self.assertEqual(sorted(os.listdir(os.path.join(self.home, folder[6:]))),
                             ["M.mod" if client.dialect == 1 else "M.modx", "Shop.pgf"])
            self.assertEqual(client.act(program, "loadprog", {"progpath": "$HOME/none.pgf"}, "load").status, 400)
            form = {"progpath": folder + "/Shop.pgf", "loadmode": "replace"}
            self.assertEqual(client.act(program, "loadprog", form, "load").status, 204)
            self.eventually(lambda: sorted(self.names(client)) == ["M", "Sys"])
            self.assertEqual(client.get(program).values()["name"], "Shop")
            for name in ("First", "first.pgf"):  # a name, with its extension or without, beside the path
                self.assertEqual(client.act(program, "save", {"path": folder, "name": name}).status, 204)
            if client.dialect == 2:
                self.assertEqual(client.post(program + "/save?name=First", {"path": folder}).status, 204)
            self.assertEqual(len([file for file in os.listdir(os.path.join(self.home, folder[6:])) if file.endswith(".pgf")]), 3)
            for wrong in ("../x", "a/b", ".x", "x" * 90):
                self.assertEqual(client.act(program, "save", {"path": folder, "name": wrong}).status, 400)

    def test_routine_of_a_place(self):
        """RWS 1.0 documentation, Get Routine information: rap-routine-prop with name, symtyp, named, local, npar."""
        client = self.client(1)
        rows = MODULE.split("\n")
        path = "/rw/rapid/modules/M/routine?task=T_ROB1&column=1&row="
        for text, name in (("count := inner", "main"), ("PROC part()", "part"), ("WaitTime", "part")):
            row = 1 + next(i for i, line in enumerate(rows) if text in line)
            values = client.get(path + str(row)).values("rap-routine-prop")
            self.assertEqual([values[key] for key in ("name", "symtyp", "named", "local", "npar")], [name, "prc", "true", "false", "0"])
        outside = 1 + next(i for i, line in enumerate(rows) if "PERS num count" in line)
        self.assertEqual((client.get(path + str(outside)).status, client.get(path + "0").status), (404, 400))
        self.assertEqual(client.get(path + "8&resource=routine-args").status, 404)


class LargeModule(RapidCase):
    """controller.md 2.3: module-text, or file-path when the module is large; the client reads that file, then deletes it."""
    MODULE = "MODULE M\n  PROC main()\n  ENDPROC\n" + "! a comment that makes the module large, a line of it\n" * 12000 + "ENDMODULE\n"

    def test_text_by_file(self):
        for client in self.both():
            path = ("/rw/rapid/modules/M?task=T_ROB1&resource=module-text" if client.dialect == 1
                    else f"{TASK}/modules/M/text")
            values = client.get(path).values("rap-module-text")
            self.assertNotIn("module-text", values)
            file = "/fileservice/" + values["file-path"]
            self.assertEqual(client.get(file).body.decode(), self.MODULE)
            self.assertEqual(client.delete(file).status, 204)


class Entries(RapidCase):
    """RWS documentation: set the entry point of a task, unload its program."""
    MODULE = """MODULE M
  PERS num main_runs := 0;
  PERS num other_runs := 0;
  PROC main()
    main_runs := main_runs + 1;
  ENDPROC
  PROC Other()
    other_runs := other_runs + 1;
  ENDPROC
  FUNC num NoEntry()
    RETURN 1;
  ENDFUNC
ENDMODULE
"""

    def test_entry_point(self):
        for client in self.masters():
            program = f"{TASK}/program"
            for wrong in ("None", "NoEntry", ""):
                reply = client.act(program, "setentrypoint", {"routine": wrong}, "entrypoint")
                self.assertEqual(reply.status, 400, wrong)
            self.assertEqual(client.act(program, "setentrypoint", {"routine": "Other"}, "entrypoint").status, 204)
            self.eventually(lambda: client.get(program).values("rap-program")["entrypoint"].lower() == "other")
            before = (float(self.value("T_ROB1/M/main_runs")), float(self.value("T_ROB1/M/other_runs")))
            self.assertEqual(client.act("/rw/rapid/execution", "resetpp").status, 204)
            self.assertEqual(self.start(client, cycle="once").status, 204)
            self.eventually(lambda: float(self.value("T_ROB1/M/other_runs")) == before[1] + 1)
            self.wait_stopped(client)
            self.assertEqual(float(self.value("T_ROB1/M/main_runs")), before[0])
            self.assertEqual(client.act(program, "setentrypoint", {"routine": "main"}, "entrypoint").status, 204)
            self.eventually(lambda: client.get(program).values("rap-program")["entrypoint"] == "main")

    def test_unloading_a_program(self):
        for client in self.masters():
            program = f"{TASK}/program"
            self.assertEqual(client.act(program, "save", {"path": "$HOME/kept"}).status, 204)
            self.assertEqual(client.act(program, "unloadprog", {}, "unload").status, 204)
            self.eventually(lambda: client.get(program).status == 204)  # RWS documentation: no program
            symbol = data(client.dialect, "T_ROB1/M/main_runs")
            self.assertEqual(client.get(symbol).status, 400)
            name = next(entry for entry in os.listdir(os.path.join(self.home, "kept")) if entry.endswith(".pgf"))
            self.assertEqual(client.act(program, "loadprog", {"progpath": f"$HOME/kept/{name}"}, "load").status, 204)
            self.eventually(lambda: client.get(symbol).status == 200)


class Dialogs(RapidCase):
    MODULE = """MODULE M
  PERS num answer := 0;
  PERS string entered := "";
  PROC main()
    VAR btnres button;
    WHILE TRUE DO
      UIMsgBox "Continue?" \\Buttons:=btnYesNo \\Result:=button;
      answer := button;
      entered := UIAlphaEntry(\\Header:="Name" \\Message:="Who?");
    ENDWHILE
  ENDPROC
ENDMODULE
"""
    OPTIONS = ()

    def test_dialogs(self):
        """22: uiinstr/active: instr event stack execlv msg; 31: Result of UIMsgBox: the button's number, 1 = yes; 41: uievent."""
        active = "/rw/rapid/uiinstr/active"
        for client in self.both():
            self.eventually(lambda: client.get(active).status == 200 and client.get(active).values()["instr"] == "UIMsgBox")
            found = client.get(active).values()
            self.assertEqual(set(found), {"instr", "event", "stack", "execlv", "msg"})
            self.assertEqual((found["event"], found["msg"]), ("SEND", "Continue?"))
            self.assertRegex(found["stack"], r"^RAPID/T_ROB1/%\$\d+$")
            response = client.subscribe("/rw/rapid/uiinstr;uievent")
            self.assertEqual(response.values("rap-ui-ev")["instr"], "UIMsgBox")
            socket = self.socket(client, response)

            def answer(stack, value, whole=False):
                quoted = urllib.parse.quote(stack, safe="" if whole else "/")
                path = f"{active}/param/{quoted}/Result" + ("?action=set" if client.dialect == 1 else "")
                return client.post(path, {"value": value}).status
            for wrong in ("9", "maybe", ""):
                self.assertEqual(answer(found["stack"], wrong), 400)
            self.assertEqual(answer("RAPID/T_ROB1/%$999", "1"), 404)
            self.assertEqual(answer(found["stack"], "1", whole=True), 204)
            events = [socket.event().values for _ in range(2)]
            self.assertEqual([(event["instr"], event["event"]) for event in events], [("UIMsgBox", "ABORT"), ("UIAlphaEntry", "SEND")])
            self.assertEqual(self.value("T_ROB1/M/answer"), "6")  # resYes
            stack = client.get(active).values()["stack"]
            parameters = {entry.title: entry.values["value"] for entry in
                          client.get(f"{active}/params/{urllib.parse.quote(stack)}").entries("rap-uiparams-li")}
            self.assertEqual(parameters["Header"], '"Name"')
            self.assertEqual(answer(stack, "Ada"), 204)
            self.eventually(lambda: self.value("T_ROB1/M/entered") == '"Ada"')


class Entries(RapidCase):
    MODULE = """MODULE M
  CONST listitem parts{3} := [["", "Bolt"], ["", "Nut"], ["", "Plate"]];
  PERS num count := 0;
  PERS num share := 0;
  PERS num item := 0;
  PERS num button := 0;
  PROC main()
    VAR btnres pressed;
    WHILE TRUE DO
      count := UINumEntry(\\Header:="Count" \\InitValue:=5 \\MinValue:=1 \\MaxValue:=20 \\AsInteger);
      share := UINumEntry(\\Header:="Share" \\MinValue:=0.1 \\MaxValue:=0.7);
      item := UIListView(\\Result:=pressed \\Header:="Part", parts \\Buttons:=btnOKCancel \\DefaultIndex:=2);
      button := pressed;
    ENDWHILE
  ENDPROC
ENDMODULE
"""
    OPTIONS = ()

    def test_answers_that_do_not_fit(self):
        """RAPID manual: UINumEntry takes numbers from MinValue to MaxValue, with AsInteger whole ones, and the limit itself though it is no
        binary fraction; UIListView: an item, a button or both. Another answer is 400, and the same dialog stays open."""
        active = "/rw/rapid/uiinstr/active"
        for client in self.both():
            self.eventually(lambda: client.get(active).status == 200)

            def stack():
                return client.get(active).values()["stack"]

            def answer(value):
                path = f"{active}/param/{urllib.parse.quote(stack())}/Result" + ("?action=set" if client.dialect == 1 else "")
                return client.post(path, {"value": value}).status
            for refused, taken, checked in ((("0", "21", "3.5", "1E300"), "20", {"count": "20"}), (("0.09", "0.71"), "0.7", {"share": "0.7"}),
                                            (("0", "4", "1.5", "1 Yes", "Help"), "3 Cancel", {"item": "3", "button": "5"})):
                before = stack()
                for wrong in refused:
                    self.assertEqual((wrong, answer(wrong), stack()), (wrong, 400, before))
                shown = {entry.title: entry.values["value"] for entry in
                         client.get(f"{active}/params/{urllib.parse.quote(before)}").entries("rap-uiparams-li")}
                if "count" in checked:
                    self.assertEqual([shown[name] for name in ("InitValue", "MinValue", "MaxValue")], ["5", "1", "20"])
                self.assertEqual(answer(taken), 204)
                for name, value in checked.items():
                    self.eventually(lambda: self.value("T_ROB1/M/" + name) == value)
                self.eventually(lambda: client.get(active).status == 200 and stack() != before)


class Queues(RapidCase):
    MODULE = """MODULE M
  PROC main()
    VAR rmqslot slot;
    VAR rmqmessage message;
    VAR rmqheader header;
    VAR num value;
    WHILE TRUE DO
      RMQReadWait message \\TimeOut:=60;
      RMQGetMsgData message, value;
      value := value + 1;
      RMQFindSlot slot, "PC";
      RMQSendMessage slot, value;
    ENDWHILE
  ENDPROC
ENDMODULE
"""
    OPTIONS = ()

    def test_a_round_trip(self):
        """31: queues ?action=create | POST /rw/dipc, send, ?action=read&timeout= | GET; 2.4: dipc-msg-ev."""
        for client in self.both():
            form = {"dipc-queue-name": "PC", "dipc-queue-size": "4440", "dipc-max-msg-size": "444"}
            if client.dialect == 1:
                form = {"dipc-queue-name": "PC", "dipc-max-size": "444", "dipc-max-number-of-messages": "10"}
            create = "/rw/dipc?action=create" if client.dialect == 1 else "/rw/dipc"
            self.assertIn(client.post(create, form).status, (200, 201))
            response = client.post(create, form)
            self.assertEqual((response.status, response.code()), (400, -1073445879))
            names = [entry.title for entry in client.get("/rw/dipc").entries("dipc-queue-li")]
            self.assertEqual(names, ["RMQ_T_ROB1", "PC"])
            slot = client.get("/rw/dipc/PC" + ("" if client.dialect == 1 else "/information")).values("dipc-queue")["queue-slot-id"]
            response = client.subscribe("/rw/dipc/PC;nomessage")
            without = self.socket(client, response)
            response = client.subscribe("/rw/dipc/PC")
            self.assertEqual(response.status, 201)
            socket = self.socket(client, response)
            message = {"dipc-src-queue-name": "PC", "dipc-cmd": "111", "dipc-userdef": "1", "dipc-msgtype": "1", "dipc-data": "num;41"}
            self.assertIn(client.act("/rw/dipc/RMQ_T_ROB1", "send", message).status, (200, 204))
            event = socket.event()
            self.assertEqual((event.type, event.title, event.values["dipc-data"]), ("dipc-msg-ev", "msg", "num;42"))
            self.assertEqual(event.values["dipc-slotid"], slot)
            event = without.event()  # RWS documentation: the slot only
            self.assertEqual((event.type, event.values), ("dipc-msg-ev", {"dipc-slotid": slot}))
            read = "/rw/dipc/PC?action=read&timeout=5000" if client.dialect == 1 else "/rw/dipc/PC?dipc-timeout=5000"
            found = client.get(read).values("dipc-read-li" if client.dialect == 1 else "dipc-read")
            self.assertEqual((found["dipc-data"], found["queue-name"]), ("num;42", "RMQ_T_ROB1"))
            self.assertEqual((found["queue-sid"], found["queue-did"], found["dipc-msgtype"]), (slot, "1", "IPC_PACKAGE"))
            self.assertEqual(client.get(read.split("timeout")[0] + "timeout=0").entries(), [])
            for wrong in ({"dipc-data": "42"}, {"dipc-data": 'num;"x"'}, {"dipc-userdef": "x"}, {"dipc-msgtype": "x"}):
                self.assertEqual(client.act("/rw/dipc/RMQ_T_ROB1", "send", {**message, **wrong}).status, 400)
            self.assertEqual(client.act("/rw/dipc/PC", "send", {**message, "dipc-data": "x" * 445}).status, 400)
            self.assertEqual(client.delete("/rw/dipc/PC").status, 204)
            self.assertEqual(client.delete("/rw/dipc/PC").status, 404)
            self.assertEqual(client.delete("/rw/dipc/RMQ_T_ROB1").status, 403)


class QueuesAfterRestart(RapidCase):
    """Decision 132: a restart empties the queues of tasks, ends those of clients, and no interrupt reports a message that is gone."""

    MODULE = """MODULE M
  PERS num received := 0;
  PERS num last := 0;
  VAR intnum came;
  PROC main()
    VAR num value;
    CONNECT came WITH onMessage;
    IRMQMessage value, came;
    WHILE TRUE DO
      WaitTime 0.1;
    ENDWHILE
  ENDPROC
  TRAP onMessage
    VAR rmqmessage message;
    VAR num data;
    RMQGetMessage message;
    RMQGetMsgData message, data;
    received := received + 1;
    last := data;
  ENDTRAP
ENDMODULE
"""
    OPTIONS = ()

    def send(self, client, value):
        message = {"dipc-src-queue-name": "", "dipc-cmd": "111", "dipc-userdef": "1", "dipc-msgtype": "1", "dipc-data": f"num;{value}"}
        self.assertIn(client.act("/rw/dipc/RMQ_T_ROB1", "send", message).status, (200, 204))

    def test_restart(self):
        client = self.client(1)
        create = {"dipc-queue-name": "PC", "dipc-queue-size": "10", "dipc-max-msg-size": "444"}
        self.assertEqual(client.post("/rw/dipc?action=dipc-create", create).status, 201)
        self.send(client, 5)
        self.eventually(lambda: self.value("T_ROB1/M/received") == "1")
        self.assertEqual(client.act("/rw/rapid/execution", "stop", {"stopmode": "stop"}).status, 204)
        self.wait_stopped(client)
        self.send(client, 6)
        self.send(client, 7)
        self.assertEqual(client.post("/rw/panel?action=restart", {"restart-mode": "restart"}).status, 204)
        self.assertEqual([entry.title for entry in client.get("/rw/dipc").entries("dipc-queue-li")], ["RMQ_T_ROB1"])
        self.assertEqual(client.post("/rw/dipc?action=dipc-create", create).status, 201)
        self.eventually(lambda: client.get("/rw/rapid/execution").values()["ctrlexecstate"] == "running")
        self.send(client, 8)
        self.eventually(lambda: self.value("T_ROB1/M/last") == "8")
        self.assertEqual(self.value("T_ROB1/M/received"), "2", "6 and 7 were lost with the restart")
        self.assertEqual(client.get("/rw/rapid/execution").values()["ctrlexecstate"], "running")


class InvalidMessages(RapidCase):
    MODULE = None
    FILES = {"invalid_messages.modx": program("invalid_messages.modx")}
    OPTIONS = ()

    def queue(self, client, name):
        self.assertIn(client.post("/rw/dipc?action=create", {"dipc-queue-name": name, "dipc-max-size": "444",
                                                             "dipc-max-number-of-messages": "10"}).status, (200, 201))

    def send(self, client, source, value):
        message = {"dipc-src-queue-name": source, "dipc-cmd": "111", "dipc-userdef": "1", "dipc-msgtype": "1",
                   "dipc-data": f"num;{value}"}
        self.assertIn(client.act("/rw/dipc/RMQ_T_ROB1", "send", message).status, (200, 204))

    def counts(self):
        return self.value("T_ROB1/InvalidMessages/good"), self.value("T_ROB1/InvalidMessages/invalid")

    def test_messages_of_clients_that_do_not_exist(self):
        """Manual 1.10, rmqmessage: a message from a client that does not exist raises ERR_RMQ_INVMSG where it is read."""
        client = self.client(1)
        self.queue(client, "PC")
        self.send(client, "PC", 1)
        self.eventually(lambda: self.counts() == ("1", "0"))
        self.send(client, "never_there", 2)  # read by RMQReadWait
        self.eventually(lambda: self.counts() == ("1", "1"))
        self.send(client, "PC", 7)  # RMQGetMessage reads the next one
        self.eventually(lambda: self.value("T_ROB1/InvalidMessages/waiting") == '"RMQGetMessage"')
        self.send(client, "never_there", 3)
        self.eventually(lambda: self.counts() == ("2", "2"))

    def test_sender_that_has_gone(self):
        """The same for a client whose queue was removed before its message was read."""
        client = self.client(1)
        self.queue(client, "gone")
        good, invalid = (int(count) for count in self.counts())
        self.assertEqual(client.act("/rw/rapid/execution", "stop", {"stopmode": "stop"}).status, 204)
        self.wait_stopped(client)
        self.send(client, "gone", 4)
        self.assertEqual(client.delete("/rw/dipc/gone").status, 204)
        self.assertEqual(self.start(client).status, 204)
        self.eventually(lambda: self.counts() == (str(good), str(invalid + 1)))


if __name__ == "__main__":
    main()
