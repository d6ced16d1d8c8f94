"""Expressions in watches, hovers and the console; conditions, hit counts and log messages."""

from dap_client import equal, holds, line_of, main, path

FIRST = line_of("part.modx", "! first")
INSIDE = line_of("part.modx", "! inside")
LOOP = line_of("part.modx", "! loop")
TWICE = line_of("part.modx", "! twice")


def at_inside(a):
    a.start("part.modx", [INSIDE])
    a.stopped("breakpoint", INSIDE)


def test_names_and_parts(a):
    """Contract 11: components, elements, any case."""
    at_inside(a)
    for expression, value in (("what", '"abc"'), ("WHAT", '"abc"'), ("here.Y", "2"), ("counts{2}", "8"),
                              ("grid{2, 3}", "6"), ("reg", "[0,0,0,0]"), ("limit", "10"), ("box.PLACE", "[1.5,2,3]"),
                              ("total", "0"), ("secret", '"hidden"')):
        equal(a.value(expression), value, expression)


def test_hidden_data_can_be_evaluated(a):
    """Contract 10: evaluateName leads to the variable itself, although a parameter hides its name."""
    a.start("hides.modx", [line_of("hides.modx", "! inner")])
    a.stopped("breakpoint")
    for scope, value in (("Module", "1"), ("Parameters", "5")):
        found = a.scope(scope)["level"]
        equal((found["value"], a.value(found["evaluateName"])), (value, value), scope)


def test_operators_and_calls(a):
    at_inside(a)
    for expression, value in (("1 + 2 * 3", "7"), ("count * 2 + 1", "5"), ("count = 2 AND NOT busy", "TRUE"),
                              ('what + "def"', '"abcdef"'), ("7 DIV 2", "3"), ("7 MOD 4", "3"), ("here + here", "[2,4,6]"),
                              ("Abs(-5)", "5"), ("STRLEN(what)", "3"), ("Present(count)", "TRUE"),
                              ("Present(loud)", "FALSE"), ("counts{count}", "8"), ("grid{count, 1 + 1}", "5"),
                              ("hiddenSum(count, 40)", "42"), ("twice(21)", "42"), ("secret", '"hidden"'),
                              ('secret + "!"', '"hidden!"'), ("LIMIT > 9", "TRUE"), ("box.place.x * 2", "3"),
                              ("-count", "-2"), ("(1 + 1) * 2", "4")):
        equal(a.value(expression), value, expression)
    body = a.ask("evaluate", expression="here + here", frameId=a.top(), context="watch")
    equal(body["type"], "pos")
    parts = a.children(body["variablesReference"])
    equal([(p["name"], p["value"]) for p in parts], [("x", "2"), ("y", "4"), ("z", "6")])


def test_what_is_wrong(a):
    at_inside(a)
    for expression in ("nothing", "1 +", "here.q", "grid{3,1}", "count +", "what + 1", "", "counts{0}", "1 / 0",
                       "twice(", "1; total := 5", "n", ") ENDPROC", "ENDMODULE", "TPWrite", "! comment"):
        message = a.refused("evaluate", expression=expression, frameId=a.top(), context="watch")
        holds("rapidc_" not in message and "ValToStr" not in message, message)
    holds("ERR_DIVZERO" in a.refused("evaluate", expression="1 / 0", frameId=a.top()), "the name of the error")
    equal(a.value("total"), "0")


def test_messages_speak_of_the_text_of_the_user(a):
    """The text is put into a routine; a message does not name what follows it there."""
    at_inside(a)
    for expression, message in (("1 +", "'1 +' is not complete"), ("twice(", "'twice(' is not complete"),
                                ("total := 5", "'total := 5' is an instruction: an expression is expected"),
                                ("TPWrite what", "'TPWrite what' is an instruction: an expression is expected")):
        for context in ("watch", "hover"):
            equal(a.refused("evaluate", expression=expression, frameId=a.top(), context=context), message)
    equal(a.value("total"), "0")


def test_frames_have_scopes_of_their_own(a):
    at_inside(a)
    outer = a.frames()[1]["id"]
    equal(a.value("n + 1", frame=outer), "3")
    equal(a.value('text + "d"', frame=outer), '"abcd"')
    a.refused("evaluate", expression="count", frameId=outer)
    equal(a.value("total + LIMIT", frame=None), "10")
    a.refused("evaluate", expression="count")


def test_hover_changes_nothing(a):
    at_inside(a)
    equal(a.value("count", "hover"), "2")
    equal(a.value("count + Abs(-1)", "hover"), "3")
    for expression in ("twice(2)", "forever()", "total := 5", "total := 5;", "ReadNum(dev)", 'TPWrite "x";', "change"):
        a.refused("evaluate", expression=expression, frameId=a.top(), context="hover")
    equal(a.value("total"), "0")
    equal(a.lines(), ["abc"] * 0)


def test_console_executes_instructions(a):
    at_inside(a)
    frame = a.top()
    for text in ('TPWrite "from the console";', "count := 41", "total := total + count + 1;", "here.z := 30",
                 "change", "IF total = 77 THEN\n reg{2} := 5;\nENDIF", 'TPWrite "two"; TPWrite "three";'):
        equal(a.ask("evaluate", expression=text, frameId=frame, context="repl")["result"], "", text)
    equal(a.value("count"), "41")
    equal(a.value("total"), "77")
    equal(a.value("here"), "[1,2,30]")
    equal(a.value("reg{2}"), "5")
    equal(a.value("count + 1", "repl"), "42")
    equal(a.lines(), ["from the console", "two", "three"])
    a.refused("evaluate", expression="LIMIT := 3;", frameId=frame, context="repl")
    a.refused("evaluate", expression="count := nothing;", frameId=frame, context="repl")
    holds("ERR_DIVZERO" in a.refused("evaluate", expression="count := 1 / 0;", frameId=frame, context="repl"), "error")
    a.ask("setBreakpoints", source={"path": path("part.modx")}, breakpoints=[])
    a.go()
    equal(a.run_out()[3:5], ["abc", "count 41"])


def test_console_evaluates_functions_with_optional_arguments(a):
    """Contract 11: an expression, although `:=` is in its parentheses."""
    at_inside(a)
    equal(a.value("CPos(\\Tool:=tool0 \\WObj:=wobj0) = CPos()", "repl"), "TRUE")
    equal(a.value('Abs(-5) + Distance(CPos(\\Tool:=tool0), CPos())', "repl"), "5")


def test_evaluation_without_end(a):
    """A function that does not return: pause ends the evaluation, and the program is where it was."""
    at_inside(a)
    frame = a.top()
    endless = a.send("evaluate", {"expression": "forever()", "frameId": frame, "context": "watch"})
    a.refused("continue", threadId=1)
    equal(a.ask("threads")["threads"][0]["name"], "T_ROB1")
    a.go("pause")
    try:
        a.answer(endless)
    except Exception as refusal:  # pylint: disable=broad-exception-caught
        holds("broken off" in str(refusal), str(refusal))
    equal(a.value("count + 1", frame=frame), "3")
    a.ask("setBreakpoints", source={"path": path("part.modx")}, breakpoints=[])
    a.go()
    equal(a.run_out(), ["abc", "count 2", "total 30"])


def test_errors_of_the_program_stay(a):
    """ERRNO is that of the program, whatever was evaluated."""
    a.start("errors.modx", [line_of("errors.modx", '"in handler"')], filters=[])
    a.stopped("breakpoint")
    holds("ERROR" in a.frames()[0]["name"], "the frame of a handler")
    equal(a.value("ERRNO = ERR_DIVZERO"), "TRUE")
    a.refused("evaluate", expression='StrToByte("x")', frameId=a.top(), context="watch")
    equal(a.value("ERRNO = ERR_DIVZERO"), "TRUE")
    a.go()
    a.run_out(1)


def test_conditions(a):
    """Contract 12."""
    made = a.start("part.modx", [{"line": TWICE, "condition": "x = 3"}])
    equal(made[0]["verified"], True)
    a.stopped("breakpoint", TWICE)
    equal(a.value("x"), "3")
    made = a.set_lines("part.modx", [{"line": TWICE, "condition": "nothing = 3"}, {"line": LOOP, "condition": "i"},
                                     {"line": TWICE, "condition": "X >= 5 AND total > 0"}])
    equal([m["verified"] for m in made], [False, False, True])
    holds(made[0]["message"] and made[1]["message"], "messages")
    a.go()
    a.stopped("breakpoint", TWICE)
    equal(a.value("x"), "5")
    a.go()
    a.run_out()


def test_hit_counts(a):
    a.start("part.modx", [{"line": TWICE, "hitCondition": "3"}])
    a.stopped("breakpoint", TWICE)
    equal(a.value("x"), "3")
    made = a.set_lines("part.modx", [{"line": TWICE, "hitCondition": ">= 2"}, {"line": LOOP, "hitCondition": "often"}])
    equal([m["verified"] for m in made], [True, False])
    a.go()
    a.stopped("breakpoint", TWICE)
    equal(a.value("x"), "5")
    a.go()
    a.run_out()


def test_hit_count_with_condition(a):
    """Only the times count when the condition holds."""
    a.start("part.modx", [{"line": TWICE, "condition": "x MOD 2 = 1", "hitCondition": "2"}])
    a.stopped("breakpoint", TWICE)
    equal(a.value("x"), "3")
    a.go()
    a.run_out()


def test_log_messages(a):
    made = a.start("part.modx", [{"line": TWICE, "logMessage": "x is {x}, twice {2 * x}, {counts{1}} {box.name}",
                                  "condition": "x > 3"}, {"line": LOOP, "logMessage": "wrong {nothing}"}])
    equal([m["verified"] for m in made], [True, False])
    a.run_out()
    logged = [m["body"] for m in a.seen if m.get("event") == "output" and "twice" in m["body"]["output"]]
    equal([m["output"].strip() for m in logged], ["x is 4, twice 8, 7 box", "x is 5, twice 10, 7 box"])
    equal([m["line"] for m in logged], [TWICE, TWICE])
    holds(all(m["category"] != "stdout" for m in logged), "category")


def test_completions(a):
    at_inside(a)
    frame = a.top()
    def labels(text):
        return [t["label"] for t in a.ask("completions", text=text, column=len(text) + 1, frameId=frame)["targets"]]
    holds("count" in labels("cou"), "a parameter")
    holds("total" in labels("1 + TO"), "any case")
    holds("twice" in labels("tw") and "TPWrite" in labels("tpw"), "routines")
    equal(labels("box."), ["name", "weight", "place"])
    equal(labels("box.place.y"), ["y"])
    target = a.ask("completions", text="1 + tot", column=8, frameId=frame)["targets"][0]
    equal((target["start"], target["length"]), (5, 3))


if __name__ == "__main__":
    main(globals())
