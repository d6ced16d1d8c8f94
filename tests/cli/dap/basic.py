"""Launching, breakpoints, the call stack, data, stepping, the end."""

import os
import tempfile

from dap_client import Refused, equal, holds, line_of, main, path

FIRST = line_of("part.modx", "! first")
CALL = line_of("part.modx", "! call")
INSIDE = line_of("part.modx", "! inside")
LOOP = line_of("part.modx", "! loop")
TWICE = line_of("part.modx", "! twice")


def test_capabilities(a):
    """Contract 4 and 5."""
    body = a.initialize()
    for name in ("ConfigurationDoneRequest", "StepBack", "ConditionalBreakpoints", "HitConditionalBreakpoints",
                 "LogPoints", "FunctionBreakpoints", "SetVariable", "EvaluateForHovers", "ExceptionInfoRequest",
                 "GotoTargetsRequest", "RestartRequest", "TerminateRequest", "DelayedStackTraceLoading",
                 "DataBreakpoints"):
        holds(body.get("supports" + name) is True, name)
    filters = {f["filter"]: f.get("default", False) for f in body["exceptionBreakpointFilters"]}
    equal(filters, {"unhandled": True, "all": False})


def test_runs_to_its_end(a):
    """Contract 14: TPWrite is stdout, then exited and one terminated."""
    a.start("part.modx")
    equal(a.run_out(), ["abc", "count 2", "total 30"])
    for command in ("loadedSources", "terminate"):
        equal(a.refused(command), "the program has ended")


def test_stop_on_entry(a):
    a.start("part.modx", stopOnEntry=True)
    stop = a.stopped("entry", routine="main")
    equal(stop["allThreadsStopped"], True)
    equal(stop["frame"]["line"], line_of("part.modx", "! entry"))
    threads = a.ask("threads")["threads"]
    equal([t["name"] for t in threads], ["T_ROB1"])
    a.go()
    a.run_out()


def test_breakpoint_and_stack(a):
    """Contract 8: frames with routine, file, line; totalFrames exact."""
    made = a.start("part.modx", [INSIDE])
    equal((made[0]["verified"], made[0]["line"]), (True, INSIDE))
    stop = a.stopped("breakpoint", INSIDE, "report")
    equal(stop["hitBreakpointIds"], [made[0]["id"]])
    body = a.ask("stackTrace", threadId=1)
    equal(body["totalFrames"], 2)
    equal([f["line"] for f in body["stackFrames"]], [INSIDE, CALL])
    equal(body["stackFrames"][0]["source"]["path"], path("part.modx"))
    one = a.ask("stackTrace", threadId=1, startFrame=1, levels=1)
    equal((len(one["stackFrames"]), one["totalFrames"]), (1, 2))
    equal(one["stackFrames"][0]["id"], body["stackFrames"][1]["id"])
    holds("main" in one["stackFrames"][0]["name"], "name of the caller")


def test_breakpoint_below_a_comment(a):
    """The nearest statement at or below the line; none below the last one."""
    made = a.start("part.modx", [1, 1000])
    equal(made[0]["verified"], True)
    equal(made[0]["line"], line_of("part.modx", "! entry"))
    equal(made[1]["verified"], False)
    holds(made[1]["message"], "a message")


def test_stepping(a):
    a.start("part.modx", [FIRST])
    a.stopped("breakpoint", FIRST)
    a.go("next")
    a.stopped("step", CALL, "main")
    a.go("stepIn")
    a.stopped("step", INSIDE, "report")
    a.go("next")
    a.stopped("step", INSIDE + 1)
    a.go("stepOut")
    stop = a.stopped("step", routine="main")
    holds(stop["frame"]["line"] > CALL, "after the call")
    a.ask("setBreakpoints", source={"path": path("part.modx")}, breakpoints=[])
    a.go()
    equal(a.run_out(), ["abc", "count 2", "total 30"])


def test_next_passes_over_calls(a):
    a.start("part.modx", [CALL])
    a.stopped("breakpoint", CALL)
    a.go("next")
    a.stopped("step", routine="main")
    equal(a.lines(), ["abc", "count 2"])


def test_scopes(a):
    """Contract 9."""
    a.start("part.modx", [INSIDE])
    a.stopped("breakpoint")
    names = [s["name"] for s in a.ask("scopes", frameId=a.top())["scopes"]]
    equal(names, ["Locals", "Parameters", "Module", "Task", "Persistents"])
    local = a.scope("Locals")
    equal((local["here"]["value"], local["here"]["type"]), ("[1,2,3]", "pos"))
    parameters = a.scope("Parameters")
    equal(parameters["what"]["value"], '"abc"')
    equal(parameters["count"]["value"], "2")
    module = a.scope("Module")
    equal(module["reg"]["value"], "[0,0,0,0]")
    equal(module["secret"]["value"], '"hidden"')
    holds("total" not in module, "persistents have a scope of their own")
    equal(module["LIMIT"]["value"], "10")
    persistents = a.scope("Persistents")
    equal(persistents["total"]["value"], "0")
    equal((persistents["busy"]["value"], persistents["busy"]["type"]), ("FALSE", "bool"))
    equal(a.scope("Locals", a.frames()[1]["id"])["n"]["value"], "2")


def test_values_have_parts(a):
    """Contract 10."""
    a.start("part.modx", [INSIDE])
    a.stopped("breakpoint")
    box = a.scope("Module")["box"]
    equal((box["value"], box["type"]), ('["box",4,[1.5,2,3]]', "item"))
    parts = {v["name"]: v for v in a.children(box["variablesReference"])}
    equal(list(parts), ["name", "weight", "place"])
    equal(parts["place"]["evaluateName"], "box.place")
    counts = a.scope("Module")["counts"]
    equal(counts["indexedVariables"], 3)
    elements = a.children(counts["variablesReference"], filter="indexed", start=1, count=2)
    equal([(v["name"], v["value"], v["evaluateName"]) for v in elements],
          [("{2}", "8", "counts{2}"), ("{3}", "9", "counts{3}")])
    equal(a.children(counts["variablesReference"], filter="named"), [])
    boxes = a.scope("Module")["boxes"]
    second = a.children(boxes["variablesReference"])[1]
    equal((second["value"], second["evaluateName"]), ('["b",2,[4,5,6]]', "boxes{2}"))
    place = a.children(a.children(second["variablesReference"])[2]["variablesReference"])[0]
    equal((place["name"], place["value"], place["evaluateName"]), ("x", "4", "boxes{2}.place.x"))
    equal(a.value("BOXES{1 + 1}.PLACE.X"), "4")
    grid = a.scope("Module")["grid"]
    rows = a.children(grid["variablesReference"])
    equal([r["value"] for r in rows], ["[1,2,3]", "[4,5,6]"])
    cells = a.children(rows[1]["variablesReference"])
    equal([(c["value"], c["evaluateName"]) for c in cells],
          [("4", "grid{2,1}"), ("5", "grid{2,2}"), ("6", "grid{2,3}")])
    for cell in cells:
        equal(a.value(cell["evaluateName"]), cell["value"])
    equal(a.value(rows[1]["evaluateName"]), "[4,5,6]")


def test_references_end(a):
    """Contract 15: ids mean nothing any more when the program has gone on."""
    a.start("part.modx", [FIRST, LOOP])
    a.stopped("breakpoint")
    frame = a.top()
    scopes = a.ask("scopes", frameId=frame)["scopes"]
    a.go()
    a.stopped("breakpoint", LOOP)
    a.refused("scopes", frameId=frame)
    a.refused("variables", variablesReference=scopes[0]["variablesReference"])
    a.refused("evaluate", expression="n", frameId=frame)
    a.refused("stackTrace", threadId=99)
    a.refused("variables", variablesReference=123456)


def test_set_variable(a):
    """Contract 11: literals; constants and wrong types are refused."""
    a.start("part.modx", [INSIDE, LOOP + 2])
    a.stopped("breakpoint")
    scopes = {s["name"]: s["variablesReference"] for s in a.ask("scopes", frameId=a.top())["scopes"]}
    body = a.ask("setVariable", variablesReference=scopes["Parameters"], name="what", value='"new"')
    equal(body["value"], '"new"')
    a.ask("setVariable", variablesReference=scopes["Parameters"], name="count", value="41.5")
    a.refused("setVariable", variablesReference=scopes["Parameters"], name="count", value='"text"')
    a.refused("setVariable", variablesReference=scopes["Parameters"], name="nothing", value="1")
    a.refused("setVariable", variablesReference=scopes["Module"], name="LIMIT", value="11")
    body = a.ask("setVariable", variablesReference=scopes["Module"], name="reg", value="[1,2,3,4]")
    equal(body["value"], "[1,2,3,4]")
    a.refused("setVariable", variablesReference=scopes["Module"], name="reg", value="[1,2,3]")
    for value in ("256", "-1", "1.5"):  # a byte is a whole number from 0 to 255 (1.15)
        problem = a.refused("setVariable", variablesReference=scopes["Module"], name="code", value=value)
        equal(problem, f"{value} is not a byte: give a whole number from 0 to 255")
        equal(a.refused("setExpression", expression="code", value=value, frameId=a.top()), problem)
    a.refused("setVariable", variablesReference=scopes["Module"], name="codes", value="[1,256]")
    equal(a.value("code"), "65")
    equal(a.ask("setVariable", variablesReference=scopes["Module"], name="codes", value="[0,255]")["value"], "[0,255]")
    a.ask("setVariable", variablesReference=scopes["Persistents"], name="total", value="100")
    a.go()
    a.stopped("breakpoint", LOOP + 2)
    equal(a.lines(), ["new", "count 41.5"])
    equal(a.value("total"), "130")
    body = a.ask("setExpression", expression="box.place.x", value="9", frameId=a.top())
    equal(body["value"], "9")
    equal(a.value("box.place"), "[9,2,3]")


def test_lines_from_zero(a):
    """Contract 8: as the client counts."""
    a.initialize(linesStartAt1=False, columnsStartAt1=False)
    launched = a.send("launch", {"program": path("part.modx")})
    a.event("initialized")
    made = a.set_lines("part.modx", [FIRST - 1])
    equal(made[0]["line"], FIRST - 1)
    a.ask("configurationDone")
    a.answer(launched)
    stop = a.stopped("breakpoint")
    equal((stop["frame"]["line"], stop["frame"]["column"]), (FIRST - 1, 4))


def test_pause_of_an_endless_loop(a):
    a.start("endless.modx")
    a.refused("next", threadId=1)
    a.refused("continue", threadId=1)
    a.refused("stackTrace", threadId=1)
    a.go("pause")
    stop = a.stopped("pause", routine="main")
    equal(stop["threadId"], 1)
    a.go("pause")  # docs/debugging.md: at a stop, the stop is reported again
    a.stopped("pause", routine="main")
    a.go("next")
    a.stopped("step")
    a.ask("evaluate", expression="n := -5;", context="repl", frameId=a.top())
    a.go()
    equal(a.run_out(), ["left"])


def test_disconnect_while_it_runs(a):
    a.start("endless.modx")
    a.ask("disconnect")
    a.ended()


def test_end_of_input(a):
    a.start("endless.modx")
    a.process.stdin.close()
    a.ended()


def test_client_dies_in_a_message(a):
    a.initialize()
    a.write(b"Content-Length: 100\r\n\r\n{\"seq\":")
    a.process.stdin.close()
    a.ended()


def test_terminate(a):
    """DAP: `exited` has the exit code of the program, once, before `terminated`. One that the client ends did not fail: 0."""
    a.start("endless.modx")
    a.ask("terminate")
    a.run_out(0)
    a.refused("continue", threadId=1)


def test_restart(a):
    a.start("part.modx", [INSIDE])
    a.stopped("breakpoint", INSIDE)
    a.ask("restart")
    a.stopped("breakpoint", INSIDE)
    equal(a.lines(), [])
    a.go()
    equal(a.run_out(), ["abc", "count 2", "total 30"])


def test_launches_that_fail(a):
    """Contract 3."""
    a.refused("launch", program=path("part.modx"))  # before initialize
    a.initialize()
    a.refused("initialize", adapterID="rapid")
    a.refused("attach")
    a.refused("nonsense")
    a.refused("launch")
    a.refused("launch", program=5)
    a.refused("launch", program=path("missing.modx"))
    a.refused("launch", program=path("part.modx"), stopOnEntry="yes")
    a.refused("launch", program=path("part.modx"), config="x.cfg")
    a.refused("launch", program=path("part.modx"), tasks=[1])
    holds("FANUC" in a.refused("launch", program=path("part.modx"), robot="FANUC"), "the robot's name")
    with tempfile.TemporaryDirectory() as folder:
        wrong = os.path.join(folder, "wrong.modx")
        with open(wrong, "w", encoding="utf-8") as file:
            file.write("MODULE Wrong\n  PROC main()\n    nothing := 1;\n  ENDPROC\nENDMODULE\n")
        a.refused("launch", program=wrong)
        report = a.event("output", line=3)
        holds("RAP" in report["output"] and "wrong.modx:3" in report["output"], f"diagnostic: {report}")
        with open(wrong, "w", encoding="utf-8") as file:
            file.write("MODULE Wrong\n  PROC other()\n  ENDPROC\nENDMODULE\n")
        holds("main" in a.refused("launch", program=wrong), "main is missing")
    # The session is still good.
    launched = a.send("launch", {"program": path("part.modx")})
    a.event("initialized")
    a.ask("configurationDone")
    a.answer(launched)
    a.run_out()


def test_no_debug(a):
    made = a.start("part.modx", [INSIDE], noDebug=True)
    equal(made[0]["verified"], False)
    equal(a.run_out(), ["abc", "count 2", "total 30"])


def test_operator_dialog(a):
    """A dialog is output of another category, with its place; the stimulus answers it."""
    a.start("asks.modx", stimulus=path("asks.csv"))
    equal(a.run_out(), ["answer 12"])
    asked = [m["body"] for m in a.seen if m.get("event") == "output" and "How many?" in m["body"]["output"]]
    equal((asked[0]["category"], asked[0]["line"]), ("important", line_of("asks.modx", "! asks")))


def test_operator_dialog_answered_by_the_client(a):
    """docs/debugging.md: with operatorDialogs an event rapidcDialog asks, and the request rapidcAnswerDialog answers."""
    a.start("asks.modx", operatorDialogs=True)
    asked = a.event("rapidcDialog")["opened"]
    equal((asked["instruction"], asked["kind"], asked["threadId"]), ("TPReadNum", "number", 1))
    holds("How many?" in asked["lines"], str(asked))
    a.refused("rapidcAnswerDialog", id=asked["id"], answer="many")
    a.refused("rapidcAnswerDialog", id=asked["id"] + 1, answer="7")
    a.refused("rapidcAnswerDialog", id=asked["id"])
    a.ask("rapidcAnswerDialog", id=asked["id"], answer="7")
    equal(a.event("rapidcDialog")["closed"], asked["id"])
    a.refused("rapidcAnswerDialog", id=asked["id"], answer="8")
    equal(a.run_out(), ["answer 7"])


def test_kinds_of_dialogs(a):
    """Keys are answered by number or by their text; the time of \\MaxTime passes with the clock while a dialog is open."""
    a.start("dialogs.modx", operatorDialogs=True)
    asked = a.event("rapidcDialog")["opened"]
    equal((asked["kind"], asked["choices"][:2]), ("choice", ["left", "right"]))
    a.refused("rapidcAnswerDialog", id=asked["id"], answer="middle")
    a.ask("rapidcAnswerDialog", id=asked["id"], answer="right")
    asked = a.event("rapidcDialog", closed=None)["opened"]
    equal(asked["kind"], "text")
    a.refused("rapidcAnswerDialog", id=asked["id"], answer="x" * 81)
    a.ask("rapidcAnswerDialog", id=asked["id"], answer="12 apples")
    asked = a.event("rapidcDialog", closed=None)["opened"]
    equal(a.event("rapidcDialog", closed=asked["id"]), {"closed": asked["id"]})
    equal(a.run_out(), ["key 2", "text 12 apples", "too late"])


def test_requests_that_make_no_sense(a):
    """Contract 15: never silent."""
    a.initialize()
    for command in ("threads",):
        a.ask(command)
    for command in ("continue", "next", "stepIn", "stepOut", "stepBack", "reverseContinue", "pause", "goto", "stackTrace",
                    "scopes", "variables", "setVariable", "evaluate", "exceptionInfo", "restart", "terminate",
                    "setExpression", "completions", "gotoTargets", "breakpointLocations", "dataBreakpointInfo", "source"):
        a.refused(command)
        a.refused(command, threadId=1, frameId=1, variablesReference=1, expression="1", text="a", column=1, name="n",
                  value="1", targetId=1, source={"path": "x"}, line=1)
    for command in ("setFunctionBreakpoints", "setDataBreakpoints", "setExceptionBreakpoints"):
        a.refused(command)  # the protocol requires the list
    for arguments in ({"threadId": "one"}, {"threadId": 1.5}, {"threadId": None}, [1]):
        seq = a.send("continue", arguments)
        try:
            a.answer(seq)
            raise AssertionError(arguments)
        except Refused:
            pass


if __name__ == "__main__":
    main(globals())
