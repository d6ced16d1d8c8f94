"""Drivers in RAPID that clients command through Robot Web Services: a state machine, and programs as files (controller.md 4.3, 4.4)."""

import re
import struct
import time

from rapid_testing import data
from serve_testing import ServeCase, main


def patient(request, *arguments, **options):
    """A session has only so many requests within a second (contract 16)."""
    while (response := request(*arguments, **options)).status == 503:
        time.sleep(0.1)
    return response


SIGNALS = """EIO:CFG_1.0:7:0::
#
EIO_SIGNAL:

      -Name "RUN_ROUTINE" -SignalType "DI" -Access "All"

      -Name "STATIONARY" -SignalType "DO"
#
SYSSIG_OUT:

      -Status "MechUnitNotMoving" -Signal "STATIONARY" -Arg1 "ROB_1"
"""

MACHINE = """MODULE StateMachine
  CONST num idle := 0;
  CONST num begins := 1;
  CONST num runs := 2;
  VAR num state := begins;
  LOCAL VAR errnum change := -1;
  LOCAL VAR intnum ordered;
  LOCAL VAR string routine := "";
  LOCAL VAR jointtarget target;
  LOCAL VAR speeddata speed := [100, 10, 100, 10];
  LOCAL VAR string path := "";

  ! The trap leaves the wait of the idle state by an error that main handles.
  PROC main()
    BookErrNo change;
    target := CJointT();
    IDelete ordered;
    CONNECT ordered WITH onOrder;
    ISignalDI RUN_ROUTINE, 1, ordered;
    state := idle;
    WHILE TRUE DO
      TEST state
      CASE idle:
        WaitUntil FALSE;
      CASE runs:
        execute;
        state := idle;
      ENDTEST
    ENDWHILE
  ERROR (change)
    TRYNEXT;
  ENDPROC

  LOCAL TRAP onOrder
    IF routine = "" OR state <> idle RETURN;
    state := runs;
    RAISE change;
  ERROR (change)
    RAISE change;
  ENDTRAP

  LOCAL PROC execute()
    TEST routine
    CASE "move":
      MoveAbsJ target, speed, fine, tool0;
    CASE "load":
      Load path;
    CASE "unload":
      UnLoad path;
    DEFAULT:
      %routine%;
    ENDTEST
    routine := "";
  ERROR
    ErrWrite \\W, "Routine failed", routine;
    routine := "";
    TRYNEXT;
  ENDPROC
ENDMODULE
"""

EXTRA = """MODULE Extra
  PERS num calls := 0;
  PROC count()
    calls := calls + 1;
  ENDPROC
ENDMODULE
"""


class StateMachine(ServeCase):
    """Symbols are the inputs and the state, a signal orders: as libraries for such a machine use it."""

    MODULE = MACHINE
    FILES = {"EIO.cfg": SIGNALS}

    def setUp(self):
        self.rws = self.client(1, form="json")

    def symbol(self, name):
        return patient(self.rws.get, data(1, f"T_ROB1/StateMachine/{name}") + "?json=1").values("rap-data")["value"]

    def put(self, name, value):
        status = patient(self.rws.post, data(1, f"T_ROB1/StateMachine/{name}") + "?action=set", {"value": value}).status
        self.assertEqual(status, 204, name)

    def signal(self, value):
        self.assertEqual(patient(self.rws.post, "/rw/iosystem/signals/RUN_ROUTINE?action=set", {"lvalue": value}).status, 204)

    def order(self, routine):
        self.eventually(lambda: self.symbol("state") == "0", message="not idle")
        self.put("routine", f'"{routine}"')
        self.signal("1")
        self.signal("0")
        self.eventually(lambda: self.symbol("routine") == '""', seconds=20, message=f"{routine} does not end")
        self.eventually(lambda: self.symbol("state") == "0", message="not idle again")

    def test_orders(self):
        unused = "[9E+09,9E+09,9E+09,9E+09,9E+09,9E+09]"
        self.eventually(lambda: self.symbol("state") == "0", message="main has not set its data")
        self.put("speed", "[300,300,300,300]")
        self.put("target", f"[[20,0,0,0,50,0],{unused}]")
        self.order("move")
        self.eventually(lambda: patient(self.rws.get, "/rw/iosystem/signals/STATIONARY").values()["lvalue"] == "1", message="moves")
        joints = patient(self.rws.get, "/rw/motionsystem/mechunits/ROB_1/jointtarget").values("ms-jointtarget")
        self.assertEqual([round(float(joints[f"rax_{i}"]), 2) for i in range(1, 7)], [20, 0, 0, 0, 50, 0])
        # a module from a file of the controller, a routine of it by its name, and without it again
        self.assertIn(patient(self.rws.request, "PUT", "/fileservice/$home/extra.mod", body=EXTRA.encode()).status, (200, 201))
        self.put("path", '"HOME:/extra.mod"')
        self.order("load")
        self.order("count")
        self.order("count")
        self.assertEqual(patient(self.rws.get, data(1, "T_ROB1/Extra/calls")).values("rap-data")["value"], "2")
        self.order("unload")
        self.order("count")
        titles = [entry.values.get("title") for entry in patient(self.rws.get, "/rw/elog/8?lang=en").entries()]
        self.assertIn("Routine failed", titles)


FILE_PROGRAM = """MODULE FileProgram
  VAR iodev file;
  VAR iodev log;
  VAR rawbytes bytes;
  VAR num values{4};
  VAR jointtarget target := [[0, 0, 0, 0, 30, 0], [9E9, 9E9, 9E9, 9E9, 9E9, 9E9]];

  PROC main()
    VAR num moves := 0;
    ErrWrite \\I, "Log opened", "Log opened with the name log-7.csv";
    Open "TEMP:" \\File:="log-7.csv", log \\Write;
    Open "TEMP:" \\File:="program.bin", file \\Read \\Bin;
    WHILE more() DO
      moves := moves + 1;
      target.robax.rax_1 := values{1};
      target.robax.rax_6 := values{2};
      MoveAbsJ target, v1000, fine, tool0;
      Write log, ValToStr(moves) + "," \\Num:=values{1};
    ENDWHILE
    Close file;
    Close log;
    ErrWrite \\I, "Log closed", "";
  ENDPROC

  ! Two numbers of the program; the end of the file comes with the last, shorter piece.
  FUNC bool more()
    FOR i FROM 1 TO 2 DO
      ClearRawBytes bytes;
      FOR k FROM 1 TO 4 DO
        values{3} := ReadBin(file);
        IF values{3} = EOF_BIN RETURN FALSE;
        PackRawBytes values{3}, bytes, k \\IntX:=USINT;
      ENDFOR
      UnpackRawBytes bytes, 1, values{i} \\Float4;
    ENDFOR
    RETURN TRUE;
  ENDFUNC
ENDMODULE
"""


class FileProgram(ServeCase):
    """A client writes the file, sets the program to main, runs it once, and finds the log by the event that names it."""

    MODULE = FILE_PROGRAM
    OPTIONS = ("--no-program-start",)

    def test_a_program(self):
        rws = self.client(1, form="json")
        self.assertEqual(patient(rws.post, "/rw/panel/ctrlstate?action=setctrlstate", {"ctrl-state": "motoron"}).status, 204)
        before = int(patient(rws.get, "/rw/elog/0?lang=en").entries()[0].title.rsplit("/", 1)[1])
        program = b"".join(struct.pack("<2f", angle, -angle) for angle in (5, 10, 15))
        self.assertEqual(patient(rws.post, "/rw/rapid/execution?action=resetpp").status, 204)
        written = patient(rws.request, "PUT", "/fileservice/$temp/program.bin", body=program)
        self.assertIn(written.status, (200, 201))
        started = patient(rws.post, "/rw/rapid/execution?action=start",
                          {"regain": "continue", "execmode": "continue", "cycle": "once", "condition": "none",
                           "stopatbp": "disabled", "alltaskbytsp": "false"})
        self.assertEqual(started.status, 204)
        self.eventually(lambda: patient(rws.get, "/rw/rapid/execution").values()["ctrlexecstate"] == "stopped", seconds=20,
                        message="does not end")
        new = [state for state in patient(rws.get, "/rw/elog/0?lang=en").json()["_embedded"]["_state"]
               if int(state["_title"].rsplit("/", 1)[1]) > before]
        arguments = {each["argv"][0]["value"]: each["argv"][1]["value"] for each in new if each["code"] == "80003"}
        self.assertIn("Log closed", arguments)
        name = re.search(r"log-\d+\.csv", arguments["Log opened"])[0]
        log = patient(rws.get, f"/fileservice/$temp/{name}")
        self.assertEqual((log.status, log.body.decode()), (200, "1,5\n2,10\n3,15\n"))
        self.assertIn(patient(rws.request, "DELETE", f"/fileservice/$temp/{name}").status, (200, 204))


if __name__ == "__main__":
    main()
