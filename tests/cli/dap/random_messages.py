"""Random and malformed messages: every request gets exactly one answer, a refusal has a message, and the adapter ends in order.

  random_messages.py [SEED [ROUNDS]]
"""

import json
import random
import sys

from dap_client import Adapter, Failed, equal, holds, path

COMMANDS = ["initialize", "launch", "attach", "configurationDone", "threads", "stackTrace", "scopes", "variables", "setVariable",
            "setExpression", "evaluate", "continue", "next", "stepIn", "stepOut", "stepBack", "reverseContinue", "pause",
            "goto", "gotoTargets", "setBreakpoints", "setFunctionBreakpoints", "setDataBreakpoints", "dataBreakpointInfo",
            "setExceptionBreakpoints", "breakpointLocations", "exceptionInfo", "completions", "loadedSources", "modules",
            "source", "restart", "restartFrame", "rapidcAnswerDialog", "cancel", "terminate", "nonsense", ""]
TEXTS = ["", "n", "total + 1", "twice(3)", "box", "counts{2}", "TPWrite \"x\";", "1 / 0", "\"", "{", "ENDPROC", "é\u0000\n",
         "x" * 3000, "total := total + 1;", "grid{1,*}", "((((", "T_ROB1", "unhandled", "all", "report", "watched", "total",
         "%" * 50, "!", "LIMIT := 1;", "here := [1,2,3];", "RETURN;", "EXIT;", "Stop;", "WaitTime 1;"]
NAMES = ["threadId", "frameId", "variablesReference", "expression", "context", "name", "value", "line", "column", "text",
         "targetId", "filter", "start", "count", "startFrame", "levels", "granularity", "singleThread", "sourceReference",
         "dataId", "filters", "filterOptions", "breakpoints", "lines", "source", "condition", "hitCondition", "logMessage",
         "id", "answer", "endLine", "accessType", "startModule", "moduleCount"]


def scalar(dice):
    return dice.choice([None, True, False, 0, 1, 2, 3, -1, 1.5, 1e300, 2**63, -2**63, 2**40, 7, 12, 26, 31, dice.choice(TEXTS),
                        dice.choice(TEXTS), path("part.modx")])


def value(dice, depth=0):
    if depth < 3 and dice.random() < 0.15:
        return [value(dice, depth + 1) for _ in range(dice.randrange(4))]
    if depth < 3 and dice.random() < 0.15:
        return {dice.choice(NAMES): value(dice, depth + 1) for _ in range(dice.randrange(4))}
    return scalar(dice)


def likely(dice, name):
    """A value of the type that the protocol wants."""
    if name in ("source",):
        return {"path": path("part.modx")}
    if name == "breakpoints":
        return [{"line": dice.randrange(1, 60), "condition": dice.choice(["", "x = 2", "1", "n >"]), "name": "twice",
                 "dataId": "total", "logMessage": dice.choice(["", "{x}", "{"])} for _ in range(dice.randrange(3))]
    if name in ("filters", "lines"):
        return ["all"] if name == "filters" else [30]
    if name == "filterOptions":
        return [{"filterId": "all", "condition": "ERR_DIVZERO"}]
    if name == "context":
        return dice.choice(["watch", "hover", "repl", "clipboard"])
    if name in ("expression", "text", "name", "value", "dataId"):
        return dice.choice(TEXTS)
    if name == "granularity":
        return dice.choice(["statement", "line", "move"])
    if name == "singleThread":
        return dice.random() < 0.5
    return dice.randrange(0, 40)


def arguments(dice):
    if dice.random() < 0.05:
        return value(dice)
    names = NAMES if dice.random() < 0.7 else dice.sample(NAMES, dice.randrange(8))
    result = {name: likely(dice, name) if dice.random() < 0.85 else value(dice) for name in names}
    if dice.random() < 0.8:
        result["threadId"] = 1
    return result


def session(seed):
    dice = random.Random(seed)
    adapter = Adapter()
    try:
        talk(adapter, dice)
    except Failed as failure:
        adapter.process.kill()
        raise Failed(f"seed {seed}: {failure}; {adapter.process.stderr.read()}") from failure


def talk(adapter, dice):
    asked = []
    if dice.random() < 0.9:
        asked.append(adapter.send("initialize", {"adapterID": "x", "linesStartAt1": dice.random() < 0.5}))
        launch = {"program": path(dice.choice(["part.modx", "errors.modx", "moves.modx", "endless.modx"])),
                  "stopOnEntry": dice.random() < 0.7}
        asked.append(adapter.send("launch", launch))
        if dice.random() < 0.5:
            asked.append(adapter.send("setExceptionBreakpoints", {"filters": ["all", "unhandled"]}))
        asked.append(adapter.send("configurationDone"))
    for _ in range(60):
        chance = dice.random()
        if chance < 0.05:
            body = dice.choice([b"", b"{", b"[]", b"null", b"5", b'"x"', b"\xff\xfe", b'{"type":"request"}', b"{}" * 3,
                                b'{"type":"response"}', b'{"seq":"a","type":"request","command":5}', b"[" * 5000])
            adapter.write(b"Content-Length: %d\r\nX-Other: 1\r\n\r\n" % len(body) + body)
        else:
            asked.append(adapter.send(dice.choice(COMMANDS), arguments(dice)))
        if dice.random() < 0.2:
            wait_for(adapter, asked)
    last = adapter.send("disconnect")
    adapter.answer(last)
    for seq in asked:
        holds(seq in adapter.answers, f"request {seq} has no answer")
        message = adapter.answers[seq]
        holds(message["success"] or message.get("message"), f"a refusal without a message: {message}")
    numbers = [m["request_seq"] for m in adapter.seen if m["type"] == "response" and m["request_seq"] != 0]
    equal(len(numbers), len(set(numbers)), "answers for one request")
    equal([m["seq"] for m in adapter.seen], list(range(1, len(adapter.seen) + 1)), "seq")
    json.dumps(adapter.seen)
    adapter.ended()


def wait_for(adapter, asked):
    """Until the last request but evaluations is answered."""
    for seq in asked:
        while seq not in adapter.answers:
            if any(m.get("request_seq") == asked[-1] for m in adapter.seen):
                return
            adapter._take()  # pylint: disable=protected-access


def main():
    first = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 12
    for seed in range(first, first + rounds):
        session(seed)
    print(f"ok {rounds} sessions")


if __name__ == "__main__":
    main()
