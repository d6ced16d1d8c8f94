"""Stops of other kinds: routines, data, errors, backward execution, the program pointer, interrupts, several tasks."""

import os

from dap_client import HERE, equal, holds, line_of, main, path

TRAP = line_of("traps.modx", "! trap")
WAITS = line_of("traps.modx", "! waits")
UNHANDLED = line_of("errors.modx", "! unhandled")
HANDLED = line_of("errors.modx", "! handled")
P1, P2, P3 = (line_of("moves.modx", f"! to p{i}") for i in (1, 2, 3))
ADDED = line_of("home/added.modx", "! added")


def test_function_breakpoints(a):
    """Contract 7 and 12: ROUTINE or MODULE:ROUTINE, once for each call."""
    a.initialize()
    launched = a.send("launch", {"program": path("part.modx")})
    a.event("initialized")
    made = a.ask("setFunctionBreakpoints", breakpoints=[{"name": "TWICE", "condition": "x > 3"}, {"name": "Part:report"},
                                                        {"name": "nowhere"}, {"name": "Other:report"}])["breakpoints"]
    equal([m["verified"] for m in made], [True, True, False, False])
    a.ask("configurationDone")
    a.answer(launched)
    stop = a.stopped(routine="report")
    holds(stop["reason"] in ("function breakpoint", "breakpoint"), stop["reason"])
    equal(stop["hitBreakpointIds"], [made[1]["id"]])
    for wanted in ("4", "5"):
        a.go()
        a.stopped(routine="twice")
        equal(a.value("x"), wanted)
    a.go()
    a.run_out()


def test_data_breakpoints(a):
    """A persistent: the stop comes before the instruction after the write."""
    a.start("traps.modx", [WAITS], config=[path("io.cfg")])
    a.stopped("breakpoint")
    info = a.ask("dataBreakpointInfo", name="watched")
    holds(info["dataId"] and "write" in info["accessTypes"], str(info))
    signal = a.ask("dataBreakpointInfo", name="doPart")
    holds(signal["dataId"], str(signal))
    equal(a.ask("dataBreakpointInfo", name="nothing")["dataId"], None)
    made = a.ask("setDataBreakpoints", breakpoints=[{"dataId": info["dataId"], "accessType": "write"},
                                                    {"dataId": signal["dataId"]},
                                                    {"dataId": info["dataId"], "accessType": "read"}])["breakpoints"]
    equal([m["verified"] for m in made], [True, True, False])
    a.go()
    a.stopped("data breakpoint", line_of("traps.modx", "! after the write"))
    equal(a.value("watched"), "1")
    a.go()
    a.stopped("data breakpoint", line_of("traps.modx", "! after the signal"))
    equal(a.value("doPart"), "1")
    a.go()
    a.run_out()


def test_signals_are_completed(a):
    """The console takes the names of signals, so it offers them."""
    a.start("traps.modx", [WAITS], config=[path("io.cfg")])
    a.stopped("breakpoint")
    found = a.ask("completions", text="SetDO dop", column=10, frameId=a.top())["targets"]
    equal([(t["label"], t["detail"], t["start"], t["length"]) for t in found], [("doPart", "DO", 7, 3)])


def test_trap_lies_on_what_it_interrupts(a):
    """Contract 8."""
    a.start("traps.modx", [TRAP], config=[path("io.cfg")])
    a.stopped("breakpoint", TRAP, "onTime")
    frames = a.frames()
    equal([f["line"] for f in frames], [TRAP, WAITS])
    holds("main" in frames[1]["name"], frames[1]["name"])
    a.go("stepOut")
    a.stopped("step", routine="main")
    a.go()
    a.run_out()


def test_unhandled_error(a):
    """Contract 5: ERRNO by name; the faulty instruction is executed again."""
    a.start("errors.modx", filters=["unhandled"])
    stop = a.stopped("exception", UNHANDLED)
    holds("ERR_DIVZERO" in stop.get("text", "") + stop.get("description", ""), str(stop))
    info = a.ask("exceptionInfo", threadId=1)
    equal((info["exceptionId"], info["breakMode"]), ("ERR_DIVZERO", "unhandled"))
    equal(a.lines(), ["in handler", "next"])
    a.ask("setExpression", expression="divisor", value="4", frameId=a.top())
    a.go()
    equal(a.run_out(), ["in handler", "next", "share 3"])


def test_error_again(a):
    a.start("errors.modx", filters=["unhandled"])
    a.stopped("exception", UNHANDLED)
    a.go()
    a.stopped("exception", UNHANDLED)


def test_step_and_goto_after_an_error(a):
    """Contract 5: after a stop the faulty instruction is executed again, by a step, too: it stops with the error, not before. Goto: the
    program pointer leaves the faulty instruction, which is not executed."""
    a.start("errors.modx", filters=["unhandled"])
    a.stopped("exception", UNHANDLED)
    for request in ("next", "stepIn"):
        a.go(request)
        a.stopped("exception", UNHANDLED)
    target = a.ask("gotoTargets", source={"path": path("errors.modx")}, line=UNHANDLED + 1)["targets"][0]
    a.go("goto", targetId=target["id"])
    a.stopped("goto", UNHANDLED + 1)
    a.go()
    equal(a.run_out(), ["in handler", "next", "share 0"])


def test_every_error(a):
    a.start("errors.modx", filters=["all", "unhandled"])
    a.stopped("exception", HANDLED, "handled")
    info = a.ask("exceptionInfo", threadId=1)
    equal(info["exceptionId"], "ERR_DIVZERO")
    equal(a.value("zero"), "0")
    a.go("next")
    a.stopped("step", line_of("errors.modx", '"in handler"'))
    a.refused("exceptionInfo", threadId=1)
    a.go()
    a.stopped("exception", UNHANDLED)
    a.ask("terminate")
    a.event("terminated")


def test_every_error_means_unhandled_ones_too(a):
    """Contract 5: `all` stops at errors that a handler takes, and at those that none takes."""
    a.start("errors.modx", filters=["all"])
    a.stopped("exception", HANDLED, "handled")
    equal(a.ask("exceptionInfo", threadId=1)["breakMode"], "always")
    a.go()
    a.stopped("exception", UNHANDLED)
    equal(a.ask("exceptionInfo", threadId=1)["breakMode"], "unhandled")
    a.ask("setExceptionBreakpoints", filters=[])
    a.go()
    a.run_out(1)


def test_chosen_errors(a):
    a.initialize()
    launched = a.send("launch", {"program": path("errors.modx")})
    a.event("initialized")
    a.ask("setExceptionBreakpoints", filters=[], filterOptions=[{"filterId": "all", "condition": "ERR_ARGVALERR"},
                                                                {"filterId": "unhandled", "condition": "err_divzero"}])
    a.ask("configurationDone")
    a.answer(launched)
    a.stopped("exception", UNHANDLED)
    a.ask("setExceptionBreakpoints", filters=[])
    a.go()
    equal(a.run_out(1), ["in handler", "next"])


def test_unknown_filters(a):
    """DAP, SetExceptionBreakpointsResponse: an element for each of `filters`, then of `filterOptions`; `verified` says whether
    the filter is there and its condition valid, `message` why not. The two sets are additive."""
    a.initialize()
    launched = a.send("launch", {"program": path("errors.modx")})
    a.event("initialized")

    def answers(**arguments):
        return a.ask("setExceptionBreakpoints", **arguments)["breakpoints"]

    made = answers(filters=["raised", "unhandled"],
                   filterOptions=[{"filterId": "uncaught"}, {"filterId": "all", "condition": "ERR_DIVZERRO"},
                                  {"filterId": "all", "condition": "ERR_ARGVALERR 1003"},
                                  {"filterId": "all", "condition": "err_own"}])
    equal([m["verified"] for m in made], [False, True, False, False, True, True])
    for one, word in zip(made, ["raised", None, "uncaught", "ERR_DIVZERRO", None, None]):
        holds(word is None or word in one["message"], str(one))
        holds(word is not None or "message" not in one, str(one))
    equal([m["verified"] for m in answers(filters=[], exceptionOptions=[{"breakMode": "always"}])], [False])
    answers(filters=["all"], filterOptions=[{"filterId": "all", "condition": "ERR_ARGVALERR"}])
    a.ask("configurationDone")
    a.answer(launched)
    a.stopped("exception", HANDLED)
    equal(len(answers(filters=["nonsense"])), 1)
    a.go()
    equal(a.run_out(1), ["in handler", "next"])


def test_no_filter(a):
    """Contract 5: without filters the run ends with exit code 1."""
    a.start("errors.modx", filters=[])
    equal(a.run_out(1), ["in handler", "next"])
    errors = [m["body"] for m in a.seen if m.get("event") == "output" and "ERR_DIVZERO" in m["body"]["output"]]
    holds(errors and errors[-1]["line"] == UNHANDLED and errors[-1]["category"] != "stdout", str(errors))


def robot(a):
    return a.event("rapidcRobot")["tcp"]


def test_step_back(a):
    """Contract 13, manual 1.21: the arm moves back."""
    a.start("moves.modx", [line_of("moves.modx", "! end")])
    a.stopped("breakpoint")
    robot(a)
    a.go("stepBack")
    a.stopped("step", P2 + 1)
    for _ in range(2):
        a.go("stepBack")
        a.stopped("step")
    places = []
    for _ in range(3):
        places.append(robot(a))
    equal(places[-1][1], 100, "y of the arm")


def test_protocol_events_only(a):
    """docs/debugging.md: with robotEvents false, a client gets the events of the protocol and no others."""
    a.start("moves.modx", [line_of("moves.modx", "! end")], robotEvents=False)
    a.stopped("breakpoint")
    a.go("stepBack")
    a.stopped("step")
    own = [m["event"] for m in a.seen if m["type"] == "event" and m["event"].startswith("rapidc")]
    equal(own, [], "events of rapidc's own")


def test_reverse_continue(a):
    """To the beginning of the routine, or a breakpoint."""
    a.start("moves.modx", [line_of("moves.modx", "! end")])
    a.stopped("breakpoint")
    a.go("reverseContinue")
    a.stopped("step", P1)
    tcp = [robot(a) for _ in range(2)][-1]
    equal(tcp[1], 0, "y of the arm")


def test_reverse_continue_to_a_breakpoint(a):
    """Contract 7 and 13: the stop is that of the breakpoint, with its number."""
    end = line_of("moves.modx", "! end")
    a.start("moves.modx", [end])
    a.stopped("breakpoint")
    number = a.set_lines("moves.modx", [P2, end])[0]["id"]
    a.go("reverseContinue")
    equal(a.stopped("breakpoint", P2)["hitBreakpointIds"], [number])
    a.go("reverseContinue")
    a.stopped("step", P1)


def test_step_by_move(a):
    a.start("moves.modx", stopOnEntry=True)
    a.stopped("entry", P1)
    a.go("next", granularity="move")
    a.stopped("step", P2)
    a.go("next", granularity="move")
    a.stopped("step", P3)
    a.refused("next", threadId=1, granularity="nonsense")
    a.go()
    equal(a.run_out(), ["end"])


def test_goto(a):
    """The program pointer moves; nothing between is executed."""
    a.start("part.modx", [line_of("part.modx", "! first")])
    a.stopped("breakpoint")
    call = line_of("part.modx", "! call")
    targets = a.ask("gotoTargets", source={"path": path("part.modx")}, line=call)["targets"]
    equal(targets[0]["line"], call)
    a.go("goto", targetId=targets[0]["id"])
    a.stopped("goto", call)
    equal(a.value("n"), "1")
    a.refused("goto", threadId=1, targetId=12345)
    inside = a.ask("gotoTargets", source={"path": path("part.modx")}, line=line_of("part.modx", "! inside"))["targets"]
    a.refused("goto", threadId=1, targetId=inside[0]["id"])
    a.go()
    equal(a.run_out(), ["abc", "count 1", "total 30"])


def test_breakpoint_in_a_module_to_be_loaded(a):
    """Contract 12: it waits, and an event says when it is verified."""
    added = path("home/added.modx")
    a.initialize()
    launched = a.send("launch", {"program": path("loads.modx"), "home": os.path.join(HERE, "home")})
    a.event("initialized")
    made = a.set_lines(added, [ADDED])
    equal(made[0]["verified"], False)
    a.ask("configurationDone")
    a.answer(launched)
    a.stopped("breakpoint", ADDED, "addedProc")
    event = a.event("breakpoint")
    equal((event["breakpoint"]["id"], event["breakpoint"]["verified"]), (made[0]["id"], True))
    equal(a.frames()[0]["source"]["path"], added)
    equal(a.value("inner + 1"), "5")
    names = [m["name"] for m in a.ask("modules")["modules"]]
    equal(sorted(names), ["Added", "Loads"])
    paths = [s["path"] for s in a.ask("loadedSources")["sources"]]
    equal(sorted(paths), sorted([path("loads.modx"), added]))
    holds("PROC addedProc" in a.ask("source", source={"path": added}, sourceReference=0)["content"], "text")
    a.refused("source", source={"path": "/etc/passwd"}, sourceReference=0)
    a.refused("source", sourceReference=99999)
    a.go()
    equal(a.run_out(), ["added"])


def test_breakpoint_in_a_module_loaded_without_device(a):
    """Manual, Load: a path without device is one of HOME:. The frame in such a module has its file."""
    added = path("home/added.modx")
    a.initialize()
    launched = a.send("launch", {"program": path("loads_plain.modx"), "home": os.path.join(HERE, "home")})
    a.event("initialized")
    equal(a.set_lines(added, [ADDED])[0]["verified"], False)
    a.ask("configurationDone")
    a.answer(launched)
    equal(a.stopped("breakpoint", ADDED)["frame"]["source"]["path"], added)
    equal(a.event("breakpoint")["breakpoint"]["verified"], True)
    a.go()
    a.run_out()


def test_loaded_source_events(a):
    """Protocol, event loadedSource: a source is new or removed; here by Load and UnLoad."""
    added = path("home/added.modx")
    a.start("loads.modx", [line_of("loads.modx", "addedProc")], home=os.path.join(HERE, "home"))
    a.stopped("breakpoint")
    equal(a.event("loadedSource"), {"reason": "new", "source": {"name": "added.modx", "path": added}})
    a.go()
    equal(a.run_out(), ["added"])
    changes = [m["body"] for m in a.seen if m.get("event") == "loadedSource"]
    equal([(c["reason"], c["source"]["path"]) for c in changes], [("new", added), ("removed", added)])


def test_restart_frame(a):
    """Protocol, request restartFrame: the response, then a stop with reason restart. Manual 1.2.2: the program pointer may be moved
    within the routine in progress, whose data keep their values, or to a procedure without parameters."""
    inside = line_of("frames.modx", "! inside")
    a.start("frames.modx", [inside])
    holds(a.seen[0]["body"]["supportsRestartFrame"], "capability")
    a.stopped("breakpoint", inside)
    frames = a.frames()
    equal([f["name"] for f in frames], ["inner", "middle", "main"])
    equal(a.value("count"), "1")
    a.refused("restartFrame", frameId=frames[1]["id"])
    a.refused("restartFrame", frameId=99999)
    a.ask("restartFrame", frameId=frames[0]["id"])
    a.stopped("restart", line_of("frames.modx", "! begins"), "inner")
    equal(len(a.frames()), 3)
    a.go()
    a.stopped("breakpoint", inside)
    equal(a.value("count"), "2")
    a.set_lines("frames.modx", [])
    a.ask("restartFrame", frameId=a.frames()[2]["id"])
    a.stopped("restart", line_of("frames.modx", "! main begins"), "main")
    equal(len(a.frames()), 1)
    a.go()
    equal(a.run_out(), ["main", "main", "count 3"])


def test_restart_of_the_outermost_frame(a):
    """Manual 1.2.2, what happens at each event: after PP to routine variables have their initial values, persistents keep theirs."""
    inside = line_of("frames.modx", "! inside")
    a.start("frames.modx", [inside])
    a.stopped("breakpoint", inside)
    for variable in ("reset", "count"):
        a.ask("evaluate", expression=f"{variable} := 7;", context="repl", frameId=a.frames()[0]["id"])
    a.ask("restartFrame", frameId=a.frames()[2]["id"])
    a.stopped("restart", line_of("frames.modx", "! main begins"), "main")
    equal(a.value("reset"), "1")
    equal(a.value("count"), "7")


def test_breakpoint_locations(a):
    a.start("part.modx", stopOnEntry=True)
    a.stopped("entry")
    first = line_of("part.modx", "! inside")
    found = a.ask("breakpointLocations", source={"path": path("part.modx")}, line=first, endLine=first + 2)["breakpoints"]
    equal(sorted({f["line"] for f in found}), [first, first + 1, first + 2])


def test_several_tasks(a):
    """Contract 6: threads are tasks; a stop stops all, continue continues all."""
    line_a, line_b = line_of("two_a.modx", "! a"), line_of("two_b.modx", "! b")
    a.start("two_a.modx", [line_a], tasks=["T_B=" + path("two_b.modx")])
    stop = a.stopped("breakpoint", line_a)
    threads = {t["name"]: t["id"] for t in a.ask("threads")["threads"]}
    equal(sorted(threads), ["T_B", "T_ROB1"])
    equal(stop["threadId"], threads["T_ROB1"])
    equal(stop["allThreadsStopped"], True)
    other = threads["T_B"]
    holds(a.ask("stackTrace", threadId=other)["totalFrames"] in (0, 1), "frames of the other task")
    a.set_lines("two_a.modx", [])
    a.set_lines("two_b.modx", [{"line": line_b, "condition": "own = 2"}])
    a.go()
    stop = a.stopped("breakpoint", line_b)
    equal(stop["threadId"], other)
    equal(a.ask("evaluate", expression="own + 1", frameId=a.top(other))["result"], "3")
    a.refused("evaluate", expression="own", frameId=a.top(threads["T_ROB1"]))
    a.go("next", thread=other)
    a.stopped("step")
    a.go()
    equal(sorted(a.run_out()), ["a ends", "b ends"])


def test_step_back_together(a):
    """Contract 13, decision 131: a step back of one thread is one of all threads whose robots move together."""
    last = line_of("together_a.modx", "! end")
    a.start("together_a.modx", [last], tasks=["T_ROB2=" + path("together_b.modx")])
    a.stopped("breakpoint", last)
    threads = {t["name"]: t["id"] for t in a.ask("threads")["threads"]}
    lines = lambda: [a.ask("stackTrace", threadId=threads[name])["stackFrames"][0]["line"] for name in ("T_ROB1", "T_ROB2")]
    a.go("stepBack", thread=threads["T_ROB2"])
    equal(a.stopped("step")["threadId"], threads["T_ROB2"])
    equal(lines(), [line_of("together_a.modx", "! 2"), line_of("together_b.modx", "! 2")])
    a.go("stepBack", thread=threads["T_ROB2"])
    equal(a.stopped("step")["threadId"], threads["T_ROB2"])
    equal(lines(), [line_of("together_a.modx", "! 1"), line_of("together_b.modx", "! 1")])
    a.go("reverseContinue", thread=threads["T_ROB1"])  # to the first synchronised movement, which SyncMoveOn lies before
    a.stopped("step")
    equal(lines(), [line_of("together_a.modx", "! on"), line_of("together_b.modx", "! on")])
    a.refused("stepBack", threadId=threads["T_ROB1"])
    a.set_lines("together_a.modx", [])
    a.go()
    equal(sorted(a.run_out()), ["a ends", "b ends"])


def test_background_task(a):
    """A STATIC task is a thread as well: it stops at breakpoints and can be stepped."""
    line_b = line_of("two_b.modx", "! b")
    a.start("two_a.modx", tasks=["T_B:STATIC=" + path("two_b.modx")])
    a.run_out()
    a.close()
    b = type(a)()
    b.start("two_a.modx", tasks=["T_B:STATIC=" + path("two_b.modx")], stopOnEntry=True)
    b.stopped("entry")
    b.set_lines("two_b.modx", [line_b])
    b.go()
    stop = b.stopped("breakpoint", line_b)
    b.go("next", thread=stop["threadId"])
    b.stopped("step", line_b + 1)
    b.set_lines("two_b.modx", [])
    b.go()
    b.run_out()
    b.close()


def test_entry_after_a_stop_of_a_background_task(a):
    """Launch argument stopOnEntry: the program stops before its first instruction, though a STATIC task has stopped at a
    breakpoint while an event routine was executed. Two tasks have one stop at the entry."""
    line_b = line_of("two_b.modx", "! b")
    a.initialize()
    a.set_lines("two_b.modx", [{"line": line_b, "condition": "own = 0"}])
    launched = a.send("launch", {"program": path("starts.modx"), "tasks": ["T_B:STATIC=" + path("two_b.modx")],
                                 "config": [path("start.cfg")], "stopOnEntry": True})
    a.event("initialized")
    a.ask("configurationDone")
    a.answer(launched)
    a.stopped("breakpoint", line_b)
    a.go()
    a.stopped("entry", line_of("starts.modx", "! entry"))
    a.go()
    a.run_out()
    a.close()
    b = type(a)()
    b.start("two_a.modx", tasks=["T_B=" + path("two_b.modx")], stopOnEntry=True)
    b.stopped("entry")
    b.go()
    equal(sorted(b.run_out()), ["a ends", "b ends"])
    b.close()


def test_realtime_wait_can_be_paused(a):
    a.start("waits.modx", realtime=True)
    a.event("output", output="waiting\n")
    a.go("pause")
    a.stopped("pause", line_of("waits.modx", "! long"))
    a.ask("disconnect")
    a.ended()


def test_pause_while_a_log_point_writes(a):
    """Contract 12 and 15: a log message in an endless loop keeps no request waiting."""
    a.start("endless.modx", [{"line": 5, "logMessage": "n is {n}"}])
    a.event("output")
    a.ask("pause", threadId=1)
    a.stopped("pause")


def test_condition_without_end(a):
    """pause ends the evaluation, and the program stops at the breakpoint."""
    line = line_of("part.modx", "! call")
    before = line_of("part.modx", "! first")
    a.start("part.modx", [{"line": before, "logMessage": "before"}, {"line": line, "condition": "forever() = 1"}])
    a.event("output", output="before\n")  # a pause that comes earlier stops the program before the breakpoint
    a.go("pause")
    a.stopped("breakpoint", line)
    a.set_lines("part.modx", [])
    a.go()
    a.run_out()


def test_end_in_a_condition(a):
    a.start("part.modx", [{"line": line_of("part.modx", "! call"), "condition": "forever() = 1"}])
    a.ask("threads")
    a.ask("disconnect")
    a.ended()


def test_goto_another_routine(a):
    """Procedures without parameters: the pointer is at their first instruction."""
    a.start("errors.modx", stopOnEntry=True)
    a.stopped("entry")
    line = line_of("errors.modx", "! handled")
    targets = a.ask("gotoTargets", source={"path": path("errors.modx")}, line=line)["targets"]
    a.go("goto", targetId=targets[0]["id"])
    a.stopped("goto", line, "handled")
    equal(a.value("zero + 1"), "1")
    a.go()
    equal(a.run_out(), ["in handler", "next"])


def test_breakpoints_before_launch(a):
    """They are not verified yet; an event follows."""
    a.initialize()
    made = a.set_lines("part.modx", [line_of("part.modx", "! first"), {"line": 1000}])
    equal([m["verified"] for m in made], [False, False])
    launched = a.send("launch", {"program": path("part.modx")})
    a.event("initialized")
    equal(a.event("breakpoint")["breakpoint"]["verified"], True)
    a.ask("configurationDone")
    a.answer(launched)
    a.stopped("breakpoint", line_of("part.modx", "! first"))


def test_pause_of_waits(a):
    """A loop of waits in virtual time."""
    a.start("two_a.modx", tasks=["T_B=" + path("polls.modx")])
    a.event("output", output="a ends\n")
    threads = {t["name"]: t["id"] for t in a.ask("threads")["threads"]}
    a.go("pause", thread=threads["T_B"])
    stop = a.stopped("pause")
    equal(stop["threadId"], threads["T_B"])
    a.ask("evaluate", expression="left := TRUE", frameId=a.top(threads["T_B"]), context="repl")
    a.go()
    a.run_out()


def test_constants_of_routines(a):
    a.start("polls.modx", stopOnEntry=True)
    a.stopped("entry")
    local = a.scope("Locals")
    equal((local["SPAN"]["value"], local["SPAN"]["type"]), ("0.5", "num"))
    equal(local["NAMES"]["value"], '["a","b"]')
    equal(a.value("SPAN * 2"), "1")
    scopes = {s["name"]: s["variablesReference"] for s in a.ask("scopes", frameId=a.top())["scopes"]}
    a.refused("setVariable", variablesReference=scopes["Locals"], name="SPAN", value="1")


if __name__ == "__main__":
    main(globals())
